//! Whether the cells of a grid resolve the contact.
//!
//! With one cell across the radius of a smooth contact pressure and energy are off by half and more,
//! with two by some 10 %, with eight by some per cent. Fewer than two are refused.
//!
//! Uneven surfaces touch in spots. A spot of one cell is the summit of an asperity: its pressure is off,
//! but the numbers of the whole contact are not. Whatever was solved of these is kept; the warning names
//! the asperities and the numbers that depend on them.

use plausible::UNITS;

use super::doubts::softest;
use super::{Grid, PathGrid, SaveFields, Scene};
use crate::error::Error;
use crate::hertz::hertz_ellipse;

/// Fewer cells across the radius of a contact (its half width) give no usable numbers.
pub const FEWEST_CELLS: f64 = 2.0;
/// Fewer cells across the radius of a contact give errors of more than some per cent.
pub const FEW_CELLS: f64 = 8.0;
/// Upper bound of the true number of cells over the Hertz estimate before the contact is solved.
const CERTAIN: f64 = 1.02;
/// Tolerance when a number of cells is rounded up.
const ROUNDING: f64 = 1e-6;
/// Required cells over the cells of the grid, above which its length is probably not in metres.
const FAR: f64 = 20.0;

impl Scene {
    /// Fails if even the contact of the softest material alone has fewer than [`FEWEST_CELLS`]
    /// across its radius.
    pub(super) fn check_resolution(&self) -> Result<(), Error> {
        self.max_cells_across_radius().map_or(Ok(()), |cells| {
            self.check_cells_across_radius(cells, CERTAIN)
        })
    }

    /// Doubts a contact with few cells across its radius, if that is certain before it is solved.
    pub(super) fn doubts_of_cells(&self) -> Vec<String> {
        self.max_cells_across_radius()
            .map_or_else(Vec::new, |cells| self.doubts_about_cells(cells, CERTAIN))
    }

    /// Fails if a contact with `cells` cells across its radius, or at most `factor` times as many, has fewer
    /// than [`FEWEST_CELLS`] on the grid or on the path grid.
    pub(crate) fn check_cells_across_radius(&self, cells: f64, factor: f64) -> Result<(), Error> {
        if self.is_uneven() {
            return Ok(());
        }
        if factor * cells < FEWEST_CELLS - ROUNDING {
            return Err(self.grid.error_of_coarse_grid(cells));
        }
        match self.cells_on_path_grid(cells) {
            Some((path_cells, cells)) if factor * cells < FEWEST_CELLS - ROUNDING => {
                Err(Error::invalid(
                    "solver.path_grid",
                    path_cells,
                    format!(
                        "\"auto\", \"same\" or more: on the path grid the contact has {} cells across its radius, and \
                     fewer than {FEWEST_CELLS} show nothing of it",
                        round_down(cells, 100.0)
                    ),
                ))
            }
            _ => Ok(()),
        }
    }

    /// Doubts a contact with `cells` cells across its radius, or at most `factor` times as many, that has
    /// fewer than [`FEW_CELLS`] on the grid, or on the path grid.
    pub(crate) fn doubts_about_cells(&self, cells: f64, factor: f64) -> Vec<String> {
        let grid_doubt =
            (factor * cells < FEW_CELLS).then(|| self.grid.warning_of_coarse_grid(cells));
        let cells_on_path = self.cells_on_path_grid(cells);
        let path_doubt = cells_on_path.filter(|(_, cells)| factor * cells < FEW_CELLS);
        let path_doubt = path_doubt.map(|(path_cells, cells)| {
            format!(
                "solver.path_grid = {path_cells}: on the path grid the contact has {} cells across its radius. With fewer than \
                 {FEW_CELLS} the path and its energies are off by more than some per cent. \"same\" has as many as the grid",
                round_down(cells, 10.0)
            )
        });
        grid_doubt.into_iter().chain(path_doubt).collect()
    }

    /// Returns nx of the path grid, and the cells there across the radius of a contact with `cells` on the grid.
    fn cells_on_path_grid(&self, cells: f64) -> Option<(usize, f64)> {
        let grid = self.path_grid()?;
        Some((grid.nx, cells * self.grid.dx / grid.dx))
    }

    /// The grid for the path where it is not the grid of the scene: none where the
    /// fields of every increment are kept.
    pub(crate) fn path_grid(&self) -> Option<Grid> {
        let PathGrid::Cells(cells) = self.settings.solver.path_grid else {
            return None;
        };
        if self.settings.save == SaveFields::All {
            return None;
        }
        let Grid { nx, ny, dx, dy, .. } = self.grid;
        let ratio = nx / cells;
        let length = ratio as f64;
        Some(Grid {
            nx: nx / ratio,
            ny: ny / ratio,
            dx: length * dx,
            dy: length * dy,
            ..self.grid
        })
    }

    /// Whether the contact may have [`FEW_CELLS`] across its radius on the path grid.
    pub(crate) fn is_resolved_on_path_grid(&self) -> bool {
        let max_cells = self.max_cells_across_radius();
        let on_path = max_cells.and_then(|cells| self.cells_on_path_grid(CERTAIN * cells));
        on_path.is_none_or(|(_, cells)| cells >= FEW_CELLS)
    }

    /// Largest possible number of cells across the radius of a contact of two paraboloids under the
    /// largest load of the path.
    fn max_cells_across_radius(&self) -> Option<f64> {
        let softest_scene = Self {
            body1: softest(&self.body1),
            body2: softest(&self.body2),
            ..self.clone()
        };
        let hertz = softest_scene
            .hertz()
            .filter(|_| self.is_sum_of_paraboloids())?;
        let Grid { dx, dy, .. } = self.grid;
        if self.grid.plane_strain {
            return Some(hertz.a / dx);
        }
        let (steep, shallow) = self.principal_curvatures();
        if steep - shallow <= 1e-9 * steep {
            return Some(hertz.a / dx.max(dy));
        }
        // The smaller semi-axis lies along the steepest direction of the gap, whose angle does not
        // depend on the axes of the grid.
        let ellipse = hertz_ellipse(1.0 / steep, 1.0 / shallow, hertz.E_star, hertz.W);
        let [cos, sin] = self.steepest_direction();
        Some(ellipse.a_x * (cos / dx).hypot(sin / dy))
    }

    /// Unit vector along which the gap is steepest.
    pub(super) fn steepest_direction(&self) -> [f64; 2] {
        let (first, second) = (self.body1.shape.curvature(), self.body2.shape.curvature());
        let [xx, xy, yy]: [f64; 3] = std::array::from_fn(|i| first[i] + second[i]);
        let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
        [angle.cos(), angle.sin()]
    }
}

impl Grid {
    /// Refuses a contact with too few cells across its radius; the message suggests enough cells.
    pub(crate) fn error_of_coarse_grid(&self, cells: f64) -> Error {
        let units = if FAR * cells < FEWEST_CELLS {
            format!("; {UNITS}")
        } else {
            String::new()
        };
        let (length, width) = self.extent();
        let extent = if self.plane_strain {
            format!("{length:.3e} m")
        } else {
            format!("{length:.3e} m x {width:.3e} m")
        };
        Error::invalid(
            "grid.n",
            format!("{} on {extent}", self.suggested_cells(1.0)),
            format!(
                "{} or more, or a shorter grid. The contact has {} cells across its radius, and fewer than {FEWEST_CELLS} \
                 show nothing of it. {} gives numbers within some per cent{units}",
                self.suggested_cells(FEWEST_CELLS / cells),
                round_down(cells, 100.0),
                self.suggested_cells(FEW_CELLS / cells),
            ),
        )
    }

    /// Warns of a contact with few cells across its radius.
    pub(crate) fn warning_of_coarse_grid(&self, cells: f64) -> String {
        format!(
            "the contact has {} cells across its radius. With fewer than {FEW_CELLS} its numbers are off by more than \
             some per cent. Use grid.n = {} or a shorter grid",
            round_down(cells, 10.0),
            self.suggested_cells(FEW_CELLS / cells)
        )
    }

    /// Readable grid with `factor` times the cells along x and y.
    fn suggested_cells(&self, factor: f64) -> String {
        let cells = |n: usize| (factor * n as f64 - ROUNDING).ceil();
        if self.plane_strain {
            cells(self.nx).to_string()
        } else {
            format!("[{}, {}]", cells(self.nx), cells(self.ny))
        }
    }
}

/// Rounds a number of cells down, so that a number below a limit is printed below it.
fn round_down(cells: f64, per_unit: f64) -> f64 {
    (per_unit * cells).floor() / per_unit
}
