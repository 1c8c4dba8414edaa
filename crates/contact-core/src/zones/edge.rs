//! Cells at the border of a zone, and the part of them that belongs to it.

use super::laws::Power;
use super::level::{Level, Line, Stencil};
use crate::cells::Lattice;

/// A cell at the border of a zone.
#[derive(Clone, Copy, Debug)]
pub struct Edge {
    /// The level of the zone; none where it cannot be extrapolated.
    pub level: Option<Level>,
    /// Whether the cell is in the zone.
    pub(crate) inside: bool,
}

impl Edge {
    /// The border seen from the zone on its other side; `inside`: whether the cell is in that
    /// zone.
    pub(crate) fn complement(self, inside: bool) -> Self {
        let level = self.level.map(|level| Level {
            bias: -level.bias,
            middle: -level.middle,
            gradient: level.gradient.map(|g| -g),
            ..level
        });
        Self { level, inside }
    }

    /// The part of the cell that belongs to the zone, 0 to 1; all or nothing without a level.
    pub(crate) fn area_fraction(&self) -> f64 {
        match self.level {
            Some(level) => {
                let slope = level.gradient[0].hypot(level.gradient[1]);
                half_plane(level.middle - level.bias * slope, level.gradient)
            }
            None => f64::from(u8::from(self.inside)),
        }
    }
}

impl Lattice {
    /// Every cell at the border of a zone, in it or next to it, in order.
    ///
    /// `laws` of a line of cells gives K powers and a function for the value of a cell. The value
    /// to one of the powers is linear in the distance from the border; the straightest is taken and
    /// extrapolated by its stencil.
    pub fn edges<const K: usize, V: Fn(usize) -> f64>(
        self,
        zone: &[bool],
        stencils: [Stencil; K],
        laws: impl Fn(&mut Line) -> ([Power; K], V),
    ) -> Vec<(usize, Edge)> {
        let edge_of_cell = |n: usize| (n, self.edge_of_cell(n, zone, stencils, &laws));
        self.border(zone).into_iter().map(edge_of_cell).collect()
    }

    /// Extrapolates the level of one cell at the border.
    pub(crate) fn edge_of_cell<const K: usize, V: Fn(usize) -> f64>(
        self,
        n: usize,
        zone: &[bool],
        stencils: [Stencil; K],
        laws: &impl Fn(&mut Line) -> ([Power; K], V),
    ) -> Edge {
        Edge {
            level: self.extrapolate_level(n, zone, stencils, laws),
            inside: zone[n],
        }
    }
}

/// The part of the unit square about the origin where f + g . x > 0.
fn half_plane(f: f64, g: [f64; 2]) -> f64 {
    let [small, large] = [g[0].abs().min(g[1].abs()), g[0].abs().max(g[1].abs())];
    let corner_excess = 0.5 * (small + large) - f.abs();
    // The part on the other side of the line from the origin.
    let smaller_part = if corner_excess <= 0.0 {
        0.0
    } else if corner_excess < small {
        0.5 * corner_excess * corner_excess / (small * large)
    } else {
        0.5 - f.abs() / large
    };
    if f > 0.0 {
        1.0 - smaller_part
    } else {
        smaller_part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::Mirror;
    use crate::scene::Grid;

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

    /// Area over the area of the true zone for a level sampled at the centres.
    fn area_ratio(n: usize, (a, b): (f64, f64), mirror: Mirror) -> f64 {
        let grid = Grid::centred(2.4, n).expect("a grid");
        let f = mirror.fold(&grid.map(|x, y| 1.0 - (x / a).powi(2) - (y / b).powi(2)));
        let zone: Vec<bool> = f.iter().map(|&f| f > 0.0).collect();
        let lattice = Lattice::new(&grid, mirror);
        let cells_inside = zone.iter().filter(|&&inside| inside).count() as f64;
        let edges = lattice.edges(&zone, [Stencil::ROOT], |_| ([Power::One], |n: usize| f[n]));
        let corrections: f64 = edges
            .iter()
            .map(|(n, edge)| {
                // Sampled at the centres there is no bias.
                let level = edge.level.map(|level| Level { bias: 0.0, ..level });
                Edge { level, ..*edge }.area_fraction() - f64::from(u8::from(zone[*n]))
            })
            .sum();
        (cells_inside + corrections) * grid.cell_area() * mirror.multiplicity()
            / (std::f64::consts::PI * a * b)
    }

    #[test]
    fn ellipses_keep_their_area() {
        for n in [32, 33, 64, 65, 128] {
            // Within a cell the border is straight: its sagitta is d^2/(8 a).
            let d = 2.4 / n as f64;
            for axes in [(1.0, 1.0), (0.9, 0.5)] {
                // Within seven cells the border bends too much, and whole cells count at some
                // places.
                let part = d / axes.1;
                let allowed = if part > 1.0 / 8.0 {
                    0.25 * part
                } else {
                    part * part
                };
                let error = (area_ratio(n, axes, Mirror::None) - 1.0).abs();
                assert!(error < allowed, "{n} {axes:?} {error:e}");
            }
        }
    }

    #[test]
    fn half_the_grid_gives_the_same_area() {
        let [whole, half] = [Mirror::None, Mirror::Y].map(|m| area_ratio(64, (1.0, 0.7), m));
        assert!((whole - half).abs() < 1e-12, "{whole} {half}");
    }
}
