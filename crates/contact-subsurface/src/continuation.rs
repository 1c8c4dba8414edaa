//! The tractions of a state within its cells below a line, computed once for all questions about them.
//!
//! Sections, points and borders need the continued tractions of a state ([`Continued`]). On 128 x 128
//! cells they take as long as the stress of a state at ten points.

use std::ops::Range;
use std::sync::Arc;

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Grid};
use contact_core::zones::Continued;

use super::Line;
use super::borders::{Border, find_borders};
use super::loads::{Plane, snap_to_half_cells};

/// Cells on each side of a sample that are divided.
pub(super) const DIVIDED_CELLS: usize = 3;
/// Tractions are not continued to an assumed rim on a layer thinner than THIN cells with E/E_below
/// above CONTRAST or below 1/CONTRAST.
const THIN: f64 = 2.0;
const CONTRAST: f64 = 2.0;
/// Memory of the continued tractions of a cell \[bytes\].
const BYTES_PER_CELL: usize = 120;

/// Columns and rows of a grid.
pub(super) type Window = (Range<usize>, Range<usize>);

/// The tractions of one state within the cells below a line.
#[derive(Clone, Debug)]
pub struct Continuation {
    pub(super) tractions: Arc<Continued>,
    grid: Grid,
    window: Window,
}

impl Continuation {
    /// Continues the tractions of a contact of a body, for samples below a line. The tractions have the shape
    /// of the grid \[Pa\]. Without `stick` all cells at the rim slip.
    pub fn new(
        line: Line,
        (body, grid): (&Body, &Grid),
        tractions: &Tractions<'_>,
        stick: Option<&[bool]>,
    ) -> Result<Self, Error> {
        check_line(grid, line)?;
        let window = widen(&line_window(line, grid), grid);
        let tractions = continue_tractions(body, grid, tractions, stick, &window);
        Ok(Self {
            tractions: Arc::new(tractions),
            grid: *grid,
            window,
        })
    }

    /// Whether they are known in a window of columns and rows of a grid.
    pub(super) fn covers(&self, grid: &Grid, (columns, rows): &Window) -> bool {
        let within = |inner: &Range<usize>, outer: &Range<usize>| {
            outer.start <= inner.start && inner.end <= outer.end
        };
        self.grid == *grid && within(columns, &self.window.0) && within(rows, &self.window.1)
    }

    /// The places where the line crosses the rim of the contact and the border of its stick zone.
    pub fn borders(&self, line: Line) -> Vec<Border> {
        find_borders(&self.tractions, &self.grid, Some(line))
    }

    /// Memory \[bytes\].
    pub fn bytes(&self) -> usize {
        BYTES_PER_CELL * self.window.0.len() * self.window.1.len()
    }
}

/// The columns and rows of the cells below a line; all of them below an oblique line.
pub(super) fn line_window(line: Line, grid: &Grid) -> Window {
    let (x, y) = line.place(0.0);
    let ((i, j), _) = locate_cell(grid, x, y);
    match line {
        Line::AlongX(_) => (0..grid.nx, j..j + 1),
        Line::AlongY(_) => (i..i + 1, 0..grid.ny),
        Line::Through { .. } => (0..grid.nx, 0..grid.ny),
    }
}

/// Widens the columns and rows of samples by the cells around them that are divided, one cell for the
/// interpolation, and one for samples on a border.
pub(super) fn widen((columns, rows): &Window, grid: &Grid) -> Window {
    let wider = |cells: &Range<usize>, count: usize| {
        cells.start.saturating_sub(DIVIDED_CELLS + 2)..(cells.end + DIVIDED_CELLS + 2).min(count)
    };
    (wider(columns, grid.nx), wider(rows, grid.ny))
}

/// Continues the tractions of a state near rims and stick borders in a window of columns and rows.
pub(super) fn continue_tractions(
    body: &Body,
    grid: &Grid,
    tractions: &Tractions<'_>,
    stick: Option<&[bool]>,
    window: &Window,
) -> Continued {
    let cell = if grid.ny == 1 {
        grid.dx
    } else {
        grid.dx.max(grid.dy)
    };
    let below = body.coatings.iter().skip(1).map(|layer| layer.material);
    let below = below.chain([body.substrate]);
    let thin = body.coatings.iter().zip(below).any(|(layer, below)| {
        let ratio = layer.material.E / below.E;
        layer.thickness < THIN * cell && !(1.0 / CONTRAST..=CONTRAST).contains(&ratio)
    });
    Continued::new(grid, tractions, stick, window, thin)
}

/// The cell (column, row) nearest to a place x, y \[m\], and the offset of the place from its middle in
/// cells.
pub(super) fn locate_cell(grid: &Grid, x: f64, y: f64) -> ((usize, usize), (f64, f64)) {
    let Plane { n, d, .. } = Plane::new(grid, false);
    let along = |v: f64, n: usize, d: f64| {
        let position = v / d + (n - 1) as f64 / 2.0;
        let cell = position.round().clamp(0.0, (n - 1) as f64);
        (cell as usize, snap_to_half_cells(position - cell))
    };
    let ((i, s), (j, t)) = (along(x, n.0, d.0), along(y, n.1, d.1));
    ((i, j), (s, t))
}

/// Fails unless a line lies above the grid.
pub(super) fn check_line(grid: &Grid, line: Line) -> Result<(), Error> {
    if !matches!(line, Line::Through { .. }) {
        return check_above_grid(grid, line);
    }
    let (x, y) = line.place(0.0);
    check_above_grid(grid, Line::AlongX(y))?;
    check_above_grid(grid, Line::AlongY(x))
}

/// Fails unless a line along an axis lies above the grid.
fn check_above_grid(grid: &Grid, line: Line) -> Result<(), Error> {
    let (x, y) = line.place(0.0);
    let (key, place, half) = match line {
        Line::AlongY(_) => ("x", x, grid.extent().0 / 2.0),
        _ => ("y", y, Plane::new(grid, false).half_width()),
    };
    if place.is_nan() || place.abs() > half * (1.0 + 1e-9) {
        let allowed = format!("a place above the grid, {:e} to {half:e} m", -half);
        return Err(Error::invalid(key, place, allowed));
    }
    Ok(())
}
