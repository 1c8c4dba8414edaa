//! Largest value of a sampled field, between the samples.

use ndarray::Array2;

use super::Depth;

/// The largest value of a field below a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maximum {
    /// Value, of the parabola through the samples around.
    pub value: f64,
    /// Place along the line \[m\].
    pub along: f64,
    /// Depth and layer; a maximum on an interface or on the surface is that of the side named.
    pub depth: Depth,
    /// The sample next to it: index of the depth and of the place along the line.
    pub sample: (usize, usize),
}

/// The largest value of a field of shape (depths, places), refined by the quadratic through its
/// neighbours; depths of other layers are no neighbours, so that kinks stay kinks. `None` if
/// there is no number in it.
///
/// For smooth fields the place is right to the square of the sampling, the value to its fourth
/// power.
pub fn maximum(field: &Array2<f64>, depths: &[Depth], along: &[f64]) -> Option<Maximum> {
    let ((k, i), _) = field
        .indexed_iter()
        .filter(|(_, v)| !v.is_nan())
        .max_by(|a, b| a.1.total_cmp(b.1))?;
    let same_layer = |other: usize| {
        depths
            .get(other)
            .is_some_and(|d| d.layer == depths[k].layer)
    };
    let has_depths = k > 0 && same_layer(k - 1) && same_layer(k + 1);
    let has_places = i > 0 && i + 1 < along.len();
    let centre = field[(k, i)];
    // Slope and curvature along each axis from three samples.
    let quadratic = |low: (f64, f64), high: (f64, f64)| {
        let (a, b) = (low.0, high.0);
        let (left, right) = ((centre - low.1) / a, (high.1 - centre) / b);
        let curvature = 2.0 * (right - left) / (a + b);
        ((left * b + right * a) / (a + b), curvature)
    };
    let mut step = (0.0, 0.0);
    let mut gain = 0.0;
    let in_depth = has_depths.then(|| {
        quadratic(
            (depths[k].z - depths[k - 1].z, field[(k - 1, i)]),
            (depths[k + 1].z - depths[k].z, field[(k + 1, i)]),
        )
    });
    let in_place = has_places.then(|| {
        quadratic(
            (along[i] - along[i - 1], field[(k, i - 1)]),
            (along[i + 1] - along[i], field[(k, i + 1)]),
        )
    });
    match (in_depth, in_place) {
        (Some((g_z, h_zz)), Some((g_x, h_xx))) => {
            let span = (depths[k + 1].z - depths[k - 1].z) * (along[i + 1] - along[i - 1]);
            let h_xz = (field[(k + 1, i + 1)] - field[(k + 1, i - 1)] - field[(k - 1, i + 1)]
                + field[(k - 1, i - 1)])
                / span;
            let determinant = h_zz * h_xx - h_xz * h_xz;
            if h_zz < 0.0 && determinant > 0.0 {
                step = (
                    (h_xz * g_x - h_xx * g_z) / determinant,
                    (h_xz * g_z - h_zz * g_x) / determinant,
                );
                gain = f64::midpoint(g_z * step.0, g_x * step.1);
            }
        }
        (Some((g, h)), None) if h < 0.0 => {
            step.0 = -g / h;
            gain = g * step.0 / 2.0;
        }
        (None, Some((g, h))) if h < 0.0 => {
            step.1 = -g / h;
            gain = g * step.1 / 2.0;
        }
        _ => {}
    }
    // A step out of the neighbours' range means that they are no parabola: the sample stands.
    let range = |v: &dyn Fn(usize) -> f64, n: usize| (v(n) - v(n - 1)).min(v(n + 1) - v(n));
    let too_far = (has_depths && step.0.abs() > range(&|n| depths[n].z, k))
        || (has_places && step.1.abs() > range(&|n| along[n], i));
    if too_far {
        (step, gain) = ((0.0, 0.0), 0.0);
    }
    Some(Maximum {
        value: centre + gain,
        along: along[i] + step.1,
        depth: Depth {
            z: depths[k].z + step.0,
            layer: depths[k].layer,
        },
        sample: (k, i),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_top_of_a_quadratic_on_uneven_samples() {
        let z = [0.0, 0.7, 1.1, 1.9, 2.4, 3.0];
        let x = [-2.0, -1.0, -0.4, 0.5, 1.0, 1.6];
        let f = |x: f64, z: f64| {
            5.0 - (x - 0.2).powi(2) - 2.0 * (z - 1.6).powi(2) + 0.9 * (x - 0.2) * (z - 1.6)
        };
        let field = Array2::from_shape_fn((6, 6), |(k, i)| f(x[i], z[k]));
        let depths = z.map(|z| Depth { z, layer: 0 });
        let m = maximum(&field, &depths, &x).expect("numbers");
        // The mixed derivative on uneven samples is exact for quadratics.
        assert!((m.value - 5.0).abs() < 1e-12, "{m:?}");
        assert!((m.along - 0.2).abs() < 1e-12 && (m.depth.z - 1.6).abs() < 1e-12);
    }

    #[test]
    fn a_kink_at_an_interface_stays_there() {
        let depths = [(0.0, 0), (1.0, 0), (1.0, 1), (2.0, 1)].map(|(z, layer)| Depth { z, layer });
        let field = Array2::from_shape_fn((4, 3), |(k, i)| {
            [1.0, 4.0, 3.0, 1.0][k] - (i as f64 - 1.0).powi(2)
        });
        let m = maximum(&field, &depths, &[-1.0, 0.0, 1.0]).expect("numbers");
        assert_eq!((m.value, m.depth, m.sample), (4.0, depths[1], (1, 1)));
    }
}
