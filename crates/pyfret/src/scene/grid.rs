//! The mesh of the contact plane.

use contact_core::scene as core;

use crate::document::has_unit;
use crate::error::Answer;
use crate::hints::Numbers;
use crate::prelude::*;

/// Distance of points or cells along x and y, or the same along both.
pub(crate) struct Pitch(pub(crate) (f64, f64));

impl<'py> FromPyObject<'_, 'py> for Pitch {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::PITCH;

    /// Takes one length for both axes, or a pair.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(both) = number(&value) {
            return Ok(Self((both, both)));
        }
        if has_unit(&value)? {
            let extent = Given::extent(&value)?;
            return Ok(Self((extent, extent)));
        }
        if let Ok((x, y)) = value.extract::<(Bound<'_, PyAny>, Bound<'_, PyAny>)>()
            && (has_unit(&x)? || has_unit(&y)?)
        {
            return Ok(Self((Given::extent(&x)?, Given::extent(&y)?)));
        }
        let allowed = "a length in m, or one along x and one along y, such as (2e-6, 2e-6)";
        number(&value)
            .map(Self)
            .map_err(|_| must_be(&value, allowed))
    }
}

/// Number of cells along x and y, or the same along both.
struct Cells((usize, usize));

impl<'py> FromPyObject<'_, 'py> for Cells {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::CELLS;

    /// Takes one number of cells for both axes, or a pair.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(both) = number(&value) {
            return Ok(Self((both, both)));
        }
        let allowed = "a whole number of cells, or one along x and one along y, such as (128, 128)";
        number(&value)
            .map(Self)
            .map_err(|_| must_be(&value, allowed))
    }
}

/// Number of cells along one direction.
struct Count(usize);

impl<'py> FromPyObject<'_, 'py> for Count {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::INT;

    /// Takes a number of cells.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let count = number(&value).map(Self);
        count.map_err(|_| must_be(&value, "a whole number of cells >= 1, such as 128"))
    }
}

/// Rectangular cells around the initial point of contact; tractions are constant on each.
///
/// Arrays over the grid have the shape (nx, ny), x first.
///
/// Parameters
/// ----------
/// nx, ny : int
///     Number of cells along x and along y.
/// dx, dy : float
///     Cell length along x and along y [m].
/// plane_strain : bool
///     Whether the cells are without end along y (default False): `ny` is 1 and `dy` the width that
///     forces are those on.
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Grid(pub(crate) core::Grid);

parts!(Grid: nx, ny, dx, dy, plane_strain);
takes!(Grid, "a grid, such as Grid.centred(width=1e-3, n=128)");

#[pymethods]
impl Grid {
    #[new]
    #[pyo3(signature = (*, nx, ny, dx: "Length", dy: "Length", plane_strain = false))]
    fn new(
        nx: Count,
        ny: Count,
        #[pyo3(from_py_with = Given::dx)] dx: f64,
        #[pyo3(from_py_with = Given::dy)] dy: f64,
        plane_strain: bool,
    ) -> Answer<Self> {
        let grid = core::Grid {
            nx: nx.0,
            ny: ny.0,
            dx,
            dy,
            plane_strain,
        };
        grid.check()?;
        Ok(Self(grid))
    }

    /// Place `n` by `n` cells on a square of side `width` [m]; a rectangle by pairs (x, y).
    #[staticmethod]
    #[pyo3(signature = (*, width, n))]
    fn centred(width: Pitch, n: Cells) -> Answer<Self> {
        let ((x, y), (nx, ny)) = (width.0, n.0);
        Ok(Self(core::Grid::from_spacing(
            (nx, ny),
            (x / nx as f64, y / ny as f64),
        )?))
    }

    /// `n` = (nx, ny) cells of size `spacing` = (dx, dy) [m].
    #[staticmethod]
    fn from_spacing(n: Cells, spacing: Pitch) -> Answer<Self> {
        Ok(Self(core::Grid::from_spacing(n.0, spacing.0)?))
    }

    /// Plane strain: `n` cells over the length `extent` [m] along x, without end along y.
    ///
    /// Forces, moments and energies are those on the width `width` [m]; displacements are
    /// relative to the points at the distance `extent` from a load.
    #[staticmethod]
    #[pyo3(signature = (*, extent: "Length", n, width: "Length" = 1.0))]
    fn strip(
        #[pyo3(from_py_with = Given::extent)] extent: f64,
        n: Count,
        #[pyo3(from_py_with = Given::width)] width: f64,
    ) -> Answer<Self> {
        Ok(Self(core::Grid::strip(extent, n.0, width)?))
    }

    /// Unit of a number of a run on this grid, by its unit in three dimensions.
    ///
    /// On a strip one metre wide forces are in N/m, energies in J/m, areas in m^2/m.
    fn unit_of<'a>(&self, unit: &'a str) -> &'a str {
        self.0.unit_of(unit)
    }

    /// Centres of the cells along x [m], shape (nx,).
    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> Numbers<'py> {
        let x: Vec<f64> = (0..self.0.nx).map(|i| self.0.x(i)).collect();
        x.to_pyarray(py).into()
    }

    /// Centres of the cells along y [m], shape (ny,).
    #[getter]
    fn y<'py>(&self, py: Python<'py>) -> Numbers<'py> {
        let y: Vec<f64> = (0..self.0.ny).map(|j| self.0.y(j)).collect();
        y.to_pyarray(py).into()
    }

    pub(crate) fn __repr__(&self) -> String {
        let core::Grid {
            nx,
            ny,
            dx,
            dy,
            plane_strain,
        } = self.0;
        if plane_strain {
            let extent = self.0.extent().0;
            return format!("Grid.strip(extent={extent:?}, n={nx}, width={dy:?})");
        }
        format!("Grid.from_spacing(({nx}, {ny}), ({dx:?}, {dy:?}))")
    }
}

attributes!(Grid, self:
    /// Whether the cells are without end along y.
    plane_strain: bool = self.0.plane_strain;
    /// Number of cells along x.
    nx: usize = self.0.nx;
    /// Number of cells along y.
    ny: usize = self.0.ny;
    /// Cell length along x [m].
    dx: f64 = self.0.dx;
    /// Cell length along y [m].
    dy: f64 = self.0.dy;
    /// Area of a cell [m^2].
    cell_area: f64 = self.0.cell_area();
);
