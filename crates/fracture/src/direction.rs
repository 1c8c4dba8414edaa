//! The direction in which a crack grows.

use std::f64::consts::{FRAC_PI_2, PI};

use super::crack::Intensity;

/// The criterion for the direction of growth over a cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// Largest range of the tangential stress ahead of the tip (F. Erdogan, G. C. Sih, J. Basic
    /// Eng. 85 (1963) 519-525, taken to the range of a cycle).
    #[default]
    TangentialStress,
    /// Largest range of K_I at the tip of a small kink.
    OpeningIntensity,
}

/// K_I and K_II at the tip of a small kink of the angle `turn` \[rad\], positive towards +x, as
/// factors of the crack's own: \[\[F_11, F_12\], \[F_21, F_22\]\].
///
/// M. Amestoy, J. B. Leblond, Int. J. Solids Struct. 29 (1992) 465-501, series in turn/pi.
pub fn kinked(turn: f64) -> [[f64; 2]; 2] {
    let m = turn / PI;
    let p = |n: i32| PI.powi(n);
    let series = |terms: &[(i32, f64)]| -> f64 { terms.iter().map(|(n, c)| c * m.powi(*n)).sum() };
    let F_11 = series(&[
        (0, 1.0),
        (2, -3.0 * p(2) / 8.0),
        (4, p(2) - 5.0 * p(4) / 128.0),
        (6, p(2) / 9.0 - 11.0 * p(4) / 72.0 + 119.0 * p(6) / 15360.0),
        (8, 5.077_90),
        (10, -2.883_12),
        (12, -0.0925),
        (14, 2.996),
        (16, -4.059),
        (18, 1.63),
        (20, 4.1),
    ]);
    let F_12 = series(&[
        (1, -3.0 * PI / 2.0),
        (3, 10.0 * PI / 3.0 + p(3) / 16.0),
        (5, -2.0 * PI - 133.0 * p(3) / 180.0 + 59.0 * p(5) / 1280.0),
        (7, 12.313_906),
        (9, -7.324_33),
        (11, 1.5793),
        (13, 4.0216),
        (15, -6.915),
        (17, 4.21),
        (19, 4.56),
    ]);
    let F_21 = series(&[
        (1, PI / 2.0),
        (3, -4.0 * PI / 3.0 - p(3) / 48.0),
        (
            5,
            -2.0 * PI / 3.0 + 13.0 * p(3) / 30.0 - 59.0 * p(5) / 3840.0,
        ),
        (7, -6.176_023),
        (9, 4.441_12),
        (11, -1.5340),
        (13, -2.0700),
        (15, 4.684),
        (17, -3.95),
        (19, -1.32),
    ]);
    let F_22 = series(&[
        (0, 1.0),
        (2, -4.0 - 3.0 * p(2) / 8.0),
        (4, 8.0 / 3.0 + 29.0 * p(2) / 18.0 - 5.0 * p(4) / 128.0),
        (
            6,
            -32.0 / 15.0 - 4.0 * p(2) / 9.0 - 1159.0 * p(4) / 7200.0 + 119.0 * p(6) / 15360.0,
        ),
        (8, 10.582_54),
        (10, -4.785_11),
        (12, -1.8804),
        (14, 7.280),
        (16, -7.591),
        (18, 0.25),
        (20, 12.5),
    ]);
    [[F_11, F_12], [F_21, F_22]]
}

impl Direction {
    /// The quantity that the direction maximises: the tangential stress ahead of the tip, or K_I of a small kink, at the
    /// angle `turn` \[rad\].
    fn opening(self, k: &Intensity, turn: f64) -> f64 {
        match self {
            Self::TangentialStress => {
                let half = turn / 2.0;
                let cos = half.cos();
                cos * (k.K_I * cos * cos - 1.5 * k.K_II * (2.0 * half).sin())
            }
            Self::OpeningIntensity => {
                let [[F_11, F_12], _] = kinked(turn);
                F_11 * k.K_I + F_12 * k.K_II
            }
        }
    }

    /// Positive part of the range of [`Self::opening`] \[Pa m^0.5\].
    fn range(self, cycle: &[Intensity], turn: f64) -> f64 {
        let values = cycle.iter().map(|k| self.opening(k, turn).max(0.0));
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), v| {
            (low.min(v), high.max(v))
        });
        high - low.min(high)
    }

    /// The turn of a crack under K over a cycle \[rad\], positive towards +x, and the range there
    /// \[Pa m^0.5\]; `None` if no kink opens.
    pub fn turn(self, cycle: &[Intensity]) -> Option<(f64, f64)> {
        const COARSE: i32 = 90;
        // Beyond 80 degrees the series of small kinks ends.
        let widest = 80.0 / 90.0 * FRAC_PI_2;
        let at = |n: i32| widest * f64::from(n) / f64::from(COARSE);
        let best = (-COARSE..=COARSE)
            .map(at)
            .map(|turn| (turn, self.range(cycle, turn)))
            .fold(
                (0.0, 0.0),
                |best, next| if next.1 > best.1 { next } else { best },
            );
        if !(best.1 > 0.0) {
            return None;
        }
        let ratio = (5.0_f64.sqrt() - 1.0) / 2.0;
        let (mut low, mut high) = (best.0 - at(1), best.0 + at(1));
        while high - low > 1e-9 {
            let (a, b) = (high - ratio * (high - low), low + ratio * (high - low));
            if self.range(cycle, a) > self.range(cycle, b) {
                high = b;
            } else {
                low = a;
            }
        }
        let turn = f64::midpoint(low, high);
        Some((turn, self.range(cycle, turn)))
    }
}
