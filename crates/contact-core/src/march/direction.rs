//! The direction of the load path from one increment to the next.

use crate::scene::{Loads, PrescribedMotions};

/// Kinds of loads and motions that share a scale, in the order of `RigidMotion::ALL`: the two tilts
/// are one kind, and so are the forces or shifts along x and y.
const KIND: [usize; 6] = [0, 1, 1, 2, 2, 3];
/// Cosine of the largest angle between successive steps of a continued path: 60 degrees.
const TURN: f64 = 0.5;

impl Loads {
    /// The change of the given loads and motions from `before` and `motions` to these.
    pub(crate) fn since(&self, before: &Self, motions: [f64; 6]) -> Self {
        let forces = before.forces();
        let (to, given) = (self.forces(), self.given.motions());
        let force = |k: usize| given[k].map_or(to[k] - forces[k], |_| 0.0);
        let motion = |k: usize| given[k].map(|to| to - motions[k]);
        Self {
            sigma_B: self.sigma_B - before.sigma_B,
            sigma_B1: self.sigma_B1 - before.sigma_B1,
            rolled: self.rolled - before.rolled,
            ..Self::default()
        }
        .with_forces(
            std::array::from_fn(force),
            PrescribedMotions::from_motions(std::array::from_fn(motion)),
        )
    }

    /// The factor f of the projection f `other` of this change on the other one, if both are of the
    /// same kind and the path turns by 60 degrees at most: a straight branch, or chords of a smooth
    /// curve.
    pub(crate) fn projection_factor(&self, other: &Self) -> Option<f64> {
        let (a, b) = (self.given.motions(), other.given.motions());
        if (0..6).any(|k| a[k].is_some() != b[k].is_some()) {
            return None;
        }
        let (f, g) = (self.forces(), other.forces());
        let pair = |k: usize| a[k].zip(b[k]).unwrap_or((f[k], g[k]));
        // Forces, moments, lengths and angles are scaled by the larger of the two changes.
        let scale = |k: usize| {
            let alike = (0..6).filter(|&j| KIND[j] == KIND[k] && a[j].is_some() == a[k].is_some());
            alike
                .map(pair)
                .fold(0.0, |m: f64, (a, b)| m.max(a.abs()).max(b.abs()))
        };
        let others = [
            (self.sigma_B, other.sigma_B),
            (self.sigma_B1, other.sigma_B1),
            (self.rolled, other.rolled),
        ];
        let pairs = (0..6)
            .map(|k| (pair(k), scale(k)))
            .chain(others.map(|(a, b)| ((a, b), a.abs().max(b.abs()))));
        let (mut both, mut own, mut its) = (0.0, 0.0, 0.0);
        for ((a, b), scale) in pairs {
            if scale > 0.0 {
                let (a, b) = (a / scale, b / scale);
                both += a * b;
                own += a * a;
                its += b * b;
            }
        }
        let goes_on = both > 0.0 && both * both >= TURN * TURN * own * its;
        goes_on.then(|| both / its)
    }
}

#[cfg(test)]
mod tests {
    use super::Loads;

    fn step(W: f64, T_x: f64, T_y: f64) -> Loads {
        Loads {
            W,
            T_x,
            T_y,
            ..Loads::default()
        }
    }

    #[test]
    fn a_path_goes_on_up_to_a_turn_of_60_degrees() {
        let turned = |degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            step(0.0, 2.0 * cos, 2.0 * sin).projection_factor(&step(0.0, 4.0, 0.0))
        };
        for degrees in [0.0_f64, 1.0, 30.0, 59.0] {
            let factor = turned(degrees).expect("a path that goes on");
            assert!((factor - 0.5 * degrees.to_radians().cos()).abs() < 1e-12);
        }
        assert_eq!([61.0, 90.0, 180.0].map(turned), [None; 3]);
        // A load against another unit: each in its own measure.
        assert!(
            step(1e3, 1e-3, 0.0)
                .projection_factor(&step(1e3, 1.1e-3, 0.0))
                .is_some()
        );
        assert!(
            step(1e3, -1e-3, 0.0)
                .projection_factor(&step(1e3, 1e-3, 0.0))
                .is_none()
        );
    }
}
