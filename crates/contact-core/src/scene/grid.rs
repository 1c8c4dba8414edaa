//! The rectangular mesh of the contact plane.

use ndarray::Array2;

use crate::error::Error;

/// Most cells of a grid: 16384 by 16384 take some 200 GB.
const MOST_CELLS: usize = 1 << 28;

/// `nx` by `ny` rectangular cells of `dx` by `dy`; tractions are constant on each.
///
/// Cell (i, j) is centred at (`x(i)`, `y(j)`); the grid's middle is the initial point of contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Number of cells along x.
    pub nx: usize,
    /// Number of cells along y.
    pub ny: usize,
    /// Cell length along x \[m\].
    pub dx: f64,
    /// Cell length along y \[m\].
    pub dy: f64,
    /// Plane strain: one row of cells that are infinitely long along y. Forces, moments and
    /// energies are integrals over the width `dy`.
    pub plane_strain: bool,
}

impl Grid {
    /// `n` by `n` cells on a square of side `extent` \[m\].
    pub fn centred(extent: f64, n: usize) -> Result<Self, Error> {
        Self::from_spacing((n, n), (extent / n as f64, extent / n as f64))
    }

    /// Returns the same cells, as many as fit on a rectangle of given sides \[m\]; none if not one does.
    pub(crate) fn fit_into(&self, sides: (f64, f64)) -> Option<Self> {
        let cells_along = |side: f64, cell: f64, limit: usize| {
            let cells = (side / cell * (1.0 + 1e-9)).floor();
            (cells >= 1.0).then(|| (cells as usize).min(limit))
        };
        Some(Self {
            nx: cells_along(sides.0, self.dx, self.nx)?,
            ny: cells_along(sides.1, self.dy, self.ny)?,
            ..*self
        })
    }

    /// Cells of given number and size \[m\].
    pub fn from_spacing(n: (usize, usize), d: (f64, f64)) -> Result<Self, Error> {
        let grid = Self {
            nx: n.0,
            ny: n.1,
            dx: d.0,
            dy: d.1,
            plane_strain: false,
        };
        grid.check()?;
        Ok(grid)
    }

    /// Plane strain: `n` cells over the length `extent` \[m\] along x, without end along y; forces
    /// are those on the width `width` \[m\].
    pub fn strip(extent: f64, n: usize, width: f64) -> Result<Self, Error> {
        let grid = Self {
            plane_strain: true,
            ..Self::from_spacing((n, 1), (extent / n as f64, width))?
        };
        grid.check()?;
        Ok(grid)
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.nx * self.ny
    }

    /// Area of a cell \[m^2\].
    pub fn cell_area(&self) -> f64 {
        self.dx * self.dy
    }

    /// Radius of the circle with this area \[m^2\]; in a line contact half the width \[m\].
    pub fn equivalent_radius(&self, area: f64) -> f64 {
        if self.plane_strain {
            area / (2.0 * self.dy)
        } else {
            (area / std::f64::consts::PI).sqrt()
        }
    }

    /// Unit of a result on this grid, given its unit in a contact of two directions. On a strip one
    /// metre wide, forces, moments, energies, areas, volumes and stiffnesses are per metre. On a
    /// strip of another width they are integrals over that width.
    pub fn unit_of<'a>(&self, unit: &'a str) -> &'a str {
        if !(self.plane_strain && self.dy == 1.0) {
            return unit;
        }
        match unit {
            "N" => "N/m",
            "N m" => "N m/m",
            "J" => "J/m",
            "m^2" => "m^2/m",
            "m^3" => "m^3/m",
            "N/m" => "N/m per m",
            "N m/rad" => "N m/rad per m",
            other => other,
        }
    }

    /// Length along x and along y \[m\].
    pub fn extent(&self) -> (f64, f64) {
        (self.nx as f64 * self.dx, self.ny as f64 * self.dy)
    }

    /// The longer side; of a line contact the length along x \[m\].
    pub(crate) fn longer_side(&self) -> f64 {
        let (x, y) = self.extent();
        if self.plane_strain { x } else { x.max(y) }
    }

    /// Coordinate of the centre of the i-th column of cells \[m\].
    pub fn x(&self, i: usize) -> f64 {
        (i as f64 - (self.nx - 1) as f64 / 2.0) * self.dx
    }

    /// Coordinate of the centre of the j-th row of cells \[m\].
    pub fn y(&self, j: usize) -> f64 {
        (j as f64 - (self.ny - 1) as f64 / 2.0) * self.dy
    }

    /// `f(x, y)` at every cell centre, shape (nx, ny).
    pub fn map(&self, mut f: impl FnMut(f64, f64) -> f64) -> Array2<f64> {
        Array2::from_shape_fn((self.nx, self.ny), |(i, j)| f(self.x(i), self.y(j)))
    }

    /// Refuses a grid that has no meaning: no cells, too many, or of no size.
    pub fn check(&self) -> Result<(), Error> {
        for (key, n) in [("grid.nx", self.nx), ("grid.ny", self.ny)] {
            if n == 0 {
                return Err(Error::invalid(key, n, "at least one cell"));
            }
        }
        if self.nx.checked_mul(self.ny).is_none_or(|n| n > MOST_CELLS) {
            return Err(Error::invalid(
                "grid.n",
                format!("[{}, {}]", self.nx, self.ny),
                format!("at most {MOST_CELLS} cells in all"),
            ));
        }
        if self.plane_strain && self.ny != 1 {
            return Err(Error::invalid(
                "grid.n",
                format!("[{}, {}]", self.nx, self.ny),
                "one row of cells, [n, 1], in plane strain",
            ));
        }
        for (key, d) in [("grid.dx", self.dx), ("grid.dy", self.dy)] {
            if !(d > 0.0 && d.is_finite()) {
                return Err(Error::invalid(key, d, "a positive cell size in m"));
            }
        }
        Ok(())
    }
}
