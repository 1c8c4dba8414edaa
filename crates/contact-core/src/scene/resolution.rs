//! Whether the cells of a grid resolve the contact.
//!
//! With one cell across the radius of a contact pressure and energy are off by half and more, with
//! two by some 10 %, with eight by some per cent.

use plausible::UNITS;

use super::doubts::softest;
use super::{Grid, PathGrid, SaveFields, Scene};
use crate::error::Error;
use crate::hertz::hertz_ellipse;

/// Fewer cells across the radius of a contact (its half width) give no usable numbers.
pub const FEWEST_CELLS: f64 = 2.0;
/// Fewer cells across the radius of a contact give errors of more than some per cent.
pub const FEW_CELLS: f64 = 8.0;
/// Part of the cells of a Hertz contact that may be missing where it is known before it is solved.
const CERTAIN: f64 = 1.02;
/// Tolerance when a number of cells is rounded up.
const ROUNDING: f64 = 1e-6;
/// Missing cells over those of the grid, above which its length is probably not in metres.
const FAR: f64 = 20.0;

impl Scene {
    /// Fails if even the contact of the softest material alone has fewer than [`FEWEST_CELLS`]
    /// across its radius.
    pub(super) fn check_resolution(&self) -> Result<(), Error> {
        self.most_cells()
            .map_or(Ok(()), |cells| self.check_cells(cells, CERTAIN))
    }

    /// That the contact has few cells across its radius, if that is certain before it is solved.
    pub(super) fn doubts_of_cells(&self) -> Vec<String> {
        self.most_cells()
            .map_or_else(Vec::new, |cells| self.doubts_of(cells, CERTAIN))
    }

    /// Fails if a contact of so many cells across its radius, `more` times as many at most, has fewer
    /// than [`FEWEST_CELLS`] on the grid or on the path grid.
    pub(crate) fn check_cells(&self, cells: f64, more: f64) -> Result<(), Error> {
        if more * cells < FEWEST_CELLS - ROUNDING {
            return Err(self.grid.too_coarse(cells));
        }
        match self.cells_on_path_grid(cells) {
            Some((of, cells)) if more * cells < FEWEST_CELLS - ROUNDING => Err(Error::invalid(
                "solver.path_grid",
                of,
                format!(
                    "\"auto\", \"same\" or more: on the path grid the contact has {} cells across its radius, and \
                     fewer than {FEWEST_CELLS} show nothing of it",
                    fewer(cells, 100.0)
                ),
            )),
            _ => Ok(()),
        }
    }

    /// That a contact of so many cells across its radius, `more` times as many at most, has fewer than
    /// [`FEW_CELLS`] on the grid, or on the path grid.
    pub(crate) fn doubts_of(&self, cells: f64, more: f64) -> Vec<String> {
        let of_grid = (more * cells < FEW_CELLS).then(|| self.grid.coarse(cells));
        let on_path = self.cells_on_path_grid(cells);
        let of_path = on_path.filter(|(_, cells)| more * cells < FEW_CELLS);
        let of_path = of_path.map(|(of, cells)| {
            format!(
                "solver.path_grid = {of}: on the path grid the contact has {} cells across its radius. With fewer than \
                 {FEW_CELLS} the path and its energies are off by more than some per cent. \"same\" has as many as the grid",
                fewer(cells, 10.0)
            )
        });
        of_grid.into_iter().chain(of_path).collect()
    }

    /// The path grid, and the cells there across the radius of a contact with so many on the grid.
    fn cells_on_path_grid(&self, cells: f64) -> Option<(usize, f64)> {
        let grid = self.path_grid()?;
        Some((grid.nx, cells * self.grid.dx / grid.dx))
    }

    /// The grid that the path is solved on where that is not the grid of the scene: none where the
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
    pub(crate) fn resolves_on_path_grid(&self) -> bool {
        let most = self.most_cells();
        let on_path = most.and_then(|cells| self.cells_on_path_grid(CERTAIN * cells));
        on_path.is_none_or(|(_, cells)| cells >= FEW_CELLS)
    }

    /// Most cells that a contact of two paraboloids can have across its radius under the largest
    /// load of the path.
    fn most_cells(&self) -> Option<f64> {
        let soft = Self {
            body1: softest(&self.body1),
            body2: softest(&self.body2),
            ..self.clone()
        };
        let hertz = soft.hertz().filter(|_| self.is_plain())?;
        let Grid { dx, dy, .. } = self.grid;
        if self.grid.plane_strain {
            return Some(hertz.a / dx);
        }
        let (steep, shallow) = self.principal_curvatures();
        if steep - shallow <= 1e-9 * steep {
            return Some(hertz.a / dx.max(dy));
        }
        // The smaller semi-axis lies where the gap is steepest, the angle of that is free of the
        // cells' shape.
        let ellipse = hertz_ellipse(1.0 / steep, 1.0 / shallow, hertz.E_star, hertz.W);
        let [one, other] = self.steepest();
        Some(ellipse.a_x * (one / dx).hypot(other / dy))
    }

    /// The direction in which the gap is steepest.
    pub(super) fn steepest(&self) -> [f64; 2] {
        let (one, other) = (self.body1.shape.curvature(), self.body2.shape.curvature());
        let [xx, xy, yy]: [f64; 3] = std::array::from_fn(|i| one[i] + other[i]);
        let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
        [angle.cos(), angle.sin()]
    }
}

impl Grid {
    /// Refuses a contact of so many cells across its radius, with the cells that it takes.
    pub(crate) fn too_coarse(&self, cells: f64) -> Error {
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
            format!("{} on {extent}", self.of_cells(1.0)),
            format!(
                "{} or more, or a shorter grid. The contact has {} cells across its radius, and fewer than {FEWEST_CELLS} \
                 show nothing of it. {} gives numbers within some per cent{units}",
                self.of_cells(FEWEST_CELLS / cells),
                fewer(cells, 100.0),
                self.of_cells(FEW_CELLS / cells),
            ),
        )
    }

    /// The warning for a contact of so few cells across its radius.
    pub(crate) fn coarse(&self, cells: f64) -> String {
        format!(
            "the contact has {} cells across its radius. With fewer than {FEW_CELLS} its numbers are off by more than \
             some per cent. Use grid.n = {} or a shorter grid",
            fewer(cells, 10.0),
            self.of_cells(FEW_CELLS / cells)
        )
    }

    /// A readable grid of `times` the cells each way.
    fn of_cells(&self, times: f64) -> String {
        let more = |n: usize| (times * n as f64 - ROUNDING).ceil();
        if self.plane_strain {
            more(self.nx).to_string()
        } else {
            format!("[{}, {}]", more(self.nx), more(self.ny))
        }
    }
}

/// A number of cells, rounded down: one that is below a limit is printed below it.
fn fewer(cells: f64, per_unit: f64) -> f64 {
    (per_unit * cells).floor() / per_unit
}
