//! Cells at the border of a zone, and the part of them that belongs to it.

use super::level::Level;

/// A cell at the border of a zone.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    /// The level of the zone; none where it cannot be extrapolated.
    pub(crate) level: Option<Level>,
    /// Whether the cell is in the zone.
    pub(crate) inside: bool,
}

impl Edge {
    /// The same border as that of the zone on its other side; `inside`: whether the cell is in that.
    pub(crate) fn other_side(self, inside: bool) -> Self {
        let level = self.level.map(|level| Level {
            bias: -level.bias,
            middle: -level.middle,
            gradient: level.gradient.map(|g| -g),
            ..level
        });
        Self { level, inside }
    }

    /// The part of the cell that belongs to the zone, 0 to 1; all or nothing without a level.
    pub(crate) fn share(&self) -> f64 {
        match self.level {
            Some(level) => {
                let slope = level.gradient[0].hypot(level.gradient[1]);
                half_plane(level.middle - level.bias * slope, level.gradient)
            }
            None => f64::from(u8::from(self.inside)),
        }
    }
}

/// The part of the unit square about the origin where f + g . x > 0.
fn half_plane(f: f64, g: [f64; 2]) -> f64 {
    let [small, large] = [g[0].abs().min(g[1].abs()), g[0].abs().max(g[1].abs())];
    let beyond = 0.5 * (small + large) - f.abs();
    // The part on the other side of the line from the origin.
    let other = if beyond <= 0.0 {
        0.0
    } else if beyond < small {
        0.5 * beyond * beyond / (small * large)
    } else {
        0.5 - f.abs() / large
    };
    if f > 0.0 { 1.0 - other } else { other }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_cuts_a_square() {
        for (f, g, share) in [
            (0.0, [1.0, 0.3], 0.5),
            (0.25, [1.0, 0.0], 0.75),
            (-0.25, [0.0, 1.0], 0.25),
            (2.0, [1.0, 1.0], 1.0),
            (-0.5, [1.0, 1.0], 0.125),
            (-0.5, [-1.0, 1.0], 0.125),
        ] {
            assert!((half_plane(f, g) - share).abs() < 1e-15, "{f} {g:?}");
        }
    }
}
