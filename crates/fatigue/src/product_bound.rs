//! An upper bound of Smith, Watson and Topper's product on a triangle of normals: [`Forms`] of the
//! strain amplitude and of the largest normal stress.

use crate::eight_planes::Instants;
use crate::forms::{EDGES, Forms, gather_corners, lower_bounds};
use crate::hemisphere::Face;
use crate::lanes::{LANES, Real};
use crate::plane_function::{BestPlane, Plane};
use crate::tangent::Tangent;

/// Lowers the bounds of faces for criteria that multiply a strain amplitude by a normal stress. With `strain` =
/// (a, b) the strain is a times the normal stress less b times the trace. `slack` bounds the rounding errors of
/// the two parts.
pub(crate) fn product_bounds<F: Real>(
    instants: &Instants<F>,
    strain: [f64; 2],
    slack: [f64; 2],
    (faces, planes): (&mut [Face], &[Plane]),
    known: &BestPlane,
) {
    for eight in faces.chunks_mut(LANES) {
        let corners = gather_corners(eight);
        let mixed = EDGES.map(|(i, j)| instants.mixed(&corners[i], &corners[j], Some(strain)));
        lower_bounds(eight, |l, face| {
            let edge = |k: usize| {
                let strain = mixed[k].strain_amplitude[l].wide() + slack[0];
                [strain, mixed[k].normal_max[l].wide() + slack[1]]
            };
            let parts = face.planes.map(|plane| planes[plane].parts);
            let forms = Forms::new(parts, [0, 1, 2].map(edge), &face.corners);
            let largest = [forms.max_part(0), forms.max_part(1)];
            // The bound is the value of the tangent at these parts, their product.
            let at_largest = Tangent::for_product(0.0, 1.0, largest);
            let proved = forms.smallest_proved(&known.values, &[known.tangent, at_largest]);
            let product = largest[0] * largest[1].max(0.0);
            proved.map_or(product, |value| value.min(product))
        });
    }
}
