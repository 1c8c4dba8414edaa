//! The grid that a run in gross slip needs, from the volumes that it wears.
//!
//! In gross slip a cycle wears `V_b = k_b W s` off body b, whatever the pressure. Where a body keeps its place
//! under the contact, its surface comes to fit the other one: the gap h of the unworn surfaces is filled up to
//! a depth d. Where it slides below the contact over the interval from a to b of shifts, the filled part is
//! swept along:
//!
//! ```text
//! int (d_1 - h(x))+ dA = (1 - kept) V_1,   int (d_2 - min_(a <= s <= b) h(x - s))+ dA = (1 - kept) V_2
//! ```
//!
//! The contact lies where h < d_1 + d_2 (exact where one of the bodies wears, above it where both do). The
//! elastic contact adds its first half-width. For a ball of radius R whose cap wears alone this is
//! `V = pi b^4/(4 R)`, for a cylinder `2 b^3/(3 R)` per length.

use contact_core::bisection::bisect;
use contact_core::scene::{Grid, Scene};
use ndarray::Array2;

use super::stroke::Frame;

/// Lengths of grids that are tried, over the length of the present grid.
const LONGER: [f64; 14] = [
    1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0,
];
/// Cells beside the contact on the recommended grid, and its length over the estimate.
const MARGIN: f64 = 2.0;
const ROOM: f64 = 1.05;

/// A run in gross slip, with all that its scar depends on.
pub(crate) struct SweptScar<'a> {
    pub(crate) scene: &'a Scene,
    /// Volumes by which the wear of body 1 and body 2 opens the gap \[m^3\].
    pub(crate) volumes: [f64; 2],
    /// Ends of the stroke \[m\].
    pub(crate) ends: [f64; 2],
    /// Half-width of the first contact \[m\].
    pub(crate) half_width: f64,
}

impl SweptScar<'_> {
    /// Lengths along x and y of the grid that holds the scar, with room \[m\]; `None` where the shapes do
    /// not bound it.
    pub(crate) fn grid_lengths(&self) -> Option<[f64; 2]> {
        let [x, y] = LONGER.iter().find_map(|times| self.reach(*times))?;
        let grid = self.scene.grid;
        let away = self.ends.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        let room = |half: f64, cells: usize| {
            2.0 * ROOM * (half + self.half_width) / (1.0 - 2.0 * MARGIN / cells.max(8) as f64)
        };
        let across = if grid.plane_strain {
            grid.extent().1
        } else {
            room(y, grid.ny)
        };
        Some([room(x + away, grid.nx), across])
    }

    /// How far the worn contact reaches from the middle along x and y \[m\], on a grid that is `times` as long;
    /// `None` if it reaches the border of that grid.
    fn reach(&self, times: f64) -> Option<[f64; 2]> {
        let grid = Grid {
            dx: times * self.scene.grid.dx,
            dy: if self.scene.grid.plane_strain {
                1.0
            } else {
                times
            } * self.scene.grid.dy,
            ..self.scene.grid
        };
        let frame = Frame::new(self.scene);
        let moving = frame.moving_shape(self.scene).drop_shifted(&grid, 0.0)?;
        let fixed = match frame {
            Frame::Body1 => &self.scene.body1.shape,
            Frame::Body2 => &self.scene.body2.shape,
        };
        let h = fixed.drop_shifted(&grid, 0.0)? + moving;
        let [fixed_volume, swept_volume] = match frame {
            Frame::Body1 => self.volumes,
            Frame::Body2 => [self.volumes[1], self.volumes[0]],
        };
        let lowest = swept(&h, self.ends.map(|d| d / grid.dx));
        let depth = filled(&h, &grid, fixed_volume)? + filled(&lowest, &grid, swept_volume)?;
        let bottom = h.iter().fold(f64::INFINITY, |low, h| low.min(*h));
        let (mut reach, mut inside) = ([0.0_f64; 2], true);
        for ((i, j), h) in h.indexed_iter() {
            if h - bottom < depth {
                reach[0] = reach[0].max(grid.x(i).abs());
                reach[1] = reach[1].max(grid.y(j).abs());
                let along_y = !grid.plane_strain && (j == 0 || j + 1 == grid.ny);
                inside &= !(i == 0 || i + 1 == grid.nx || along_y);
            }
        }
        inside.then_some(reach)
    }
}

/// The least gap under each cell over a stroke between two shifts \[cells\].
fn swept(h: &Array2<f64>, [a, b]: [f64; 2]) -> Array2<f64> {
    let (nx, ny) = h.dim();
    let (low, high) = (a.min(b).floor() as isize, a.max(b).ceil() as isize);
    Array2::from_shape_fn((nx, ny), |(i, j)| {
        let from = (i as isize - high).clamp(0, nx as isize - 1) as usize;
        let to = (i as isize - low).clamp(0, nx as isize - 1) as usize;
        (from..=to).fold(f64::INFINITY, |least, k| least.min(h[(k, j)]))
    })
}

/// The depth to which a volume fills a gap \[m\]; `None` if it flows over the border of the grid.
fn filled(h: &Array2<f64>, grid: &Grid, volume: f64) -> Option<f64> {
    if volume <= 0.0 {
        return Some(0.0);
    }
    let bottom = h.iter().fold(f64::INFINITY, |low, h| low.min(*h));
    let (nx, ny) = h.dim();
    let border = h.indexed_iter().filter(|((i, j), _)| {
        let along_y = !grid.plane_strain && (*j == 0 || j + 1 == ny);
        *i == 0 || i + 1 == nx || along_y
    });
    let rim = border.fold(f64::INFINITY, |low, (_, h)| low.min(*h));
    let held = |depth: f64| {
        let above = h.iter().map(|h| (depth - (h - bottom)).max(0.0));
        above.sum::<f64>() * grid.cell_area()
    };
    let height = rim - bottom;
    (held(height) > volume).then(|| bisect(0.0, height, |depth| held(depth) - volume))
}
