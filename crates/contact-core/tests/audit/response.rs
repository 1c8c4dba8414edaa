//! The displacements are those of the tractions.

use contact_core::convolution::{DcFft, Displacements, SurfaceOperator, Tractions};
use contact_core::kernels::pair_coefficients;
use contact_core::march::Fields;
use contact_core::plan::{Mirror, Plan};
use contact_core::scene::Scene;

use super::{Audit, Law, Misfit, Violations};

/// The bodies' response on the whole grid, in double precision.
pub(super) struct Response {
    op: DcFft,
    friction: bool,
}

impl Response {
    pub(super) fn new(scene: &Scene, plan: &Plan) -> Self {
        let pair = pair_coefficients(
            (&scene.body1, &scene.body2),
            &scene.grid,
            &scene.settings.kernel,
            scene.settings.skip.equal_layers,
            plan.kernels(),
            None,
        );
        Self {
            op: DcFft::new(&pair.expect("kernels"), Mirror::None, plan.coupling),
            friction: plan.friction,
        }
    }

    /// u_x, u_y, u_z of the tractions \[m\].
    pub(super) fn of(&mut self, fields: &Fields) -> [Vec<f64>; 3] {
        let mut u = [(); 3].map(|()| vec![0.0; fields.p.len()]);
        let [u_x, u_y, u_z] = &mut u;
        self.op.respond(
            Tractions {
                q_x: fields.q_x.as_slice().filter(|_| self.friction),
                q_y: fields.q_y.as_slice().filter(|_| self.friction),
                p: fields.p.as_slice(),
            },
            Displacements {
                u_x: self.friction.then_some(&mut u_x[..]),
                u_y: self.friction.then_some(&mut u_y[..]),
                u_z: Some(&mut u_z[..]),
            },
        );
        u
    }
}

impl Audit {
    /// Across the plane within the tolerance of the gap in every cell; in it within that of the
    /// slip, root mean square over the contact, which one cell anywhere may hold all of.
    pub(super) fn check_response(&mut self, now: &Fields, found: &mut Violations) {
        let [u_x, u_y, u_z] = self.response.of(now);
        let off = now
            .u_z
            .iter()
            .zip(&u_z)
            .map(|(one, other)| (one - other).abs());
        found.raise(Law::Response, off.fold(0.0, f64::max) / self.misfit.gap);
        if !self.response.friction {
            return;
        }
        let (mut squares, mut most) = (0.0, 0.0_f64);
        let pairs = now.u_x.iter().zip(&u_x).zip(now.u_y.iter().zip(&u_y));
        for (((x, of_x), (y, of_y)), touches) in pairs.zip(&now.contact) {
            let off = (x - of_x).hypot(y - of_y);
            most = most.max(off);
            squares += if *touches { off * off } else { 0.0 };
        }
        let off = squares.sqrt().max(most) / Misfit::root_of_cells(now);
        found.raise(Law::Response, off / self.misfit.slip);
    }
}
