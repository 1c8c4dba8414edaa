//! Plastic strain below a contact: the volume grid of a body, what is left of stress, the imprint.

use contact_core::scene::Grid;
use contact_core::yielding::{Yielded, Yielding};
use contact_store::{YIELDED, from_rows};
use contact_subsurface as core;
use contact_subsurface::{Depth, EigenstressSolver};
use eigenstrain::{COMPONENTS, Mesh};
use ndarray::{Array2, Array3, Array4, ArrayView1};
use numpy::{PyArray1, PyArray2};

use crate::error::Answer;
use crate::prelude::*;
use crate::scene::Scene;

/// Plastic strain, and the residual stress that it leaves.
#[pyclass(frozen, module = "pyfret")]
#[derive(Clone)]
pub(crate) struct Eigenstress(pub(crate) core::Eigenstress);

#[pymethods]
impl Eigenstress {
    /// Plastic strain at points x, y, z [m] in their layers, of shape (points, 6).
    ///
    /// Components are xx, yy, zz, xy, xz, yz.
    #[pyo3(signature = (x: "Sequence[float]", y: "Sequence[float]", z: "Sequence[float]", layer: "Sequence[int]") -> "NDArray[np.float64]")]
    fn plastic_strain<'py>(
        &self,
        py: Python<'py>,
        x: List<f64>,
        y: List<f64>,
        z: List<f64>,
        layer: List<usize>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let points = z.len();
        if [x.len(), y.len(), layer.len()] != [points; 3] {
            refuse!("x, y, layer: must be {points} each, as many as z");
        }
        let mut tensor = Array2::zeros((points, COMPONENTS));
        for (n, mut row) in tensor.outer_iter_mut().enumerate() {
            let (z, layer) = (z[n], layer[n]);
            let strain = self.0.plastic_strain(x[n], y[n], Depth { z, layer });
            row.assign(&ArrayView1::from(&strain));
        }
        Ok(tensor.into_pyarray(py))
    }
}

/// Names of the columns of the points that have yielded, in their order.
#[pyfunction]
pub(crate) fn yielded_columns() -> Vec<&'static str> {
    YIELDED.iter().map(|of| of.name).collect()
}

/// Eigenstress of each state; none where nothing has yielded.
pub(crate) fn of_states(
    given: Option<List<Option<Py<Eigenstress>>>>,
) -> Vec<Option<core::Eigenstress>> {
    let to_stress = |of: Option<Py<Eigenstress>>| of.map(|of| of.get().0.clone());
    given
        .unwrap_or_default()
        .into_iter()
        .map(to_stress)
        .collect()
}

/// A body of a scene that may yield, with its volume grid; use :meth:`Snapshot.plastic`.
///
/// The points that have yielded are given as columns, in the order of :func:`yielded_columns`.
#[pyclass(frozen, module = "pyfret")]
pub(crate) struct PlasticBody {
    number: usize,
    grid: Grid,
    of: EigenstressSolver,
}

/// Centres of the cells along a side of the grid \[m\].
fn centres(cells: usize, length: f64) -> Vec<f64> {
    let middle = 0.5 * (cells as f64 - 1.0);
    (0..cells).map(|i| (i as f64 - middle) * length).collect()
}

/// The plastic state from columns.
fn read(rows: List<List<f64>>) -> PyResult<Yielded> {
    let rows: Vec<Vec<f64>> = rows.into_iter().map(|column| column.0).collect();
    let count = rows.first().map_or(0, Vec::len);
    if rows.len() != YIELDED.len() || rows.iter().any(|column| column.len() != count) {
        refuse!(
            "points that have yielded: must be {} columns of equal length",
            YIELDED.len()
        );
    }
    Ok(from_rows(&rows))
}

impl PlasticBody {
    /// Calls `work` with the bodies that yield, on the volume grid of a state.
    fn with_bodies<T: Send>(
        &self,
        py: Python<'_>,
        yielded: &Yielded,
        work: impl FnOnce(&mut Yielding) -> T + Send,
    ) -> Answer<T> {
        let answer = py.detach(|| self.of.with_yielding(yielded, work))?;
        Ok(answer.ok_or_else(|| self.stays_elastic())?)
    }

    /// The error for a body that cannot yield.
    fn stays_elastic(&self) -> PyErr {
        PyValueError::new_err(format!(
            "body{} stays elastic: give its material plastic=Plastic(s_y=..)",
            self.number
        ))
    }
}

#[pymethods]
impl PlasticBody {
    #[new]
    #[pyo3(signature = (scene, body_number: "int"))]
    fn new(scene: Scene, #[pyo3(from_py_with = number)] body_number: u8) -> PyResult<Self> {
        let side = side(body_number)?;
        let made = Self {
            number: body_number.into(),
            grid: scene.0.grid,
            of: EigenstressSolver::new(&scene.0, side),
        };
        if side.body(&scene.0).yields() {
            Ok(made)
        } else {
            Err(made.stays_elastic())
        }
    }

    /// Depth and height of each plane of the volume grid [m], its layer, x, y of its cells.
    ///
    /// Of the grid that holds the points; `place` is the cell of each of them, x first.
    #[pyo3(signature = (rows: "Sequence[NDArray[np.float64]]") -> "dict[str, Any]")]
    fn grid<'py>(&self, py: Python<'py>, rows: List<List<f64>>) -> PyResult<Bound<'py, PyDict>> {
        let number = self.number;
        let yielded = read(rows)?;
        let of_mesh = |mesh: &Mesh| {
            let coordinates =
                |of: &dyn Fn(usize) -> f64| (0..mesh.planes()).map(of).collect::<Vec<f64>>();
            (
                coordinates(&|n| mesh.depth(n)),
                coordinates(&|n| mesh.weight(n)),
                (0..mesh.planes())
                    .map(|n| mesh.layer(n))
                    .collect::<Vec<_>>(),
                mesh.cells,
            )
        };
        let states = yielded.bodies.iter().filter(|state| state.body == number);
        let points: Vec<u32> = states
            .flat_map(|state| &state.points)
            .map(|point| point.cell)
            .collect();
        let indices = self.with_bodies(py, &yielded, |yielding| {
            let cells = points.iter();
            let cells = cells.filter_map(|cell| yielding.volume().cell(*cell));
            let cells: Vec<usize> = cells.collect();
            yielding.mesh(number).map(|mesh| (of_mesh(mesh), cells))
        })?;
        let ((z, height, layer, cells), place) = indices.ok_or_else(|| self.stays_elastic())?;
        let table = PyDict::new(py);
        table.set_item("z", PyArray1::from_vec(py, z))?;
        table.set_item("height", PyArray1::from_vec(py, height))?;
        table.set_item("layer", PyArray1::from_vec(py, layer))?;
        table.set_item("x", PyArray1::from_vec(py, centres(cells.nx, cells.dx)))?;
        table.set_item("y", PyArray1::from_vec(py, centres(cells.ny, cells.dy)))?;
        table.set_item("area", cells.area())?;
        table.set_item("place", PyArray1::from_vec(py, place))?;
        Ok(table)
    }

    /// Equivalent plastic strain, plastic strain and stress over planes, components and cells.
    ///
    /// The stress with the tractions and the bulk stress `sigma_B` of the body, and the residual
    /// stress without [Pa].
    #[pyo3(signature = (rows: "Sequence[NDArray[np.float64]]", p, q_x, q_y, *, sigma_B: "float" = 0.0) -> "dict[str, NDArray[np.float64]]")]
    fn fields<'py>(
        &self,
        py: Python<'py>,
        rows: List<List<f64>>,
        p: Field<'py>,
        q_x: Field<'py>,
        q_y: Field<'py>,
        #[pyo3(from_py_with = number)] sigma_B: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let yielded = read(rows)?;
        let shape = (self.grid.nx, self.grid.ny);
        let tractions = [p, q_x, q_y].map(|f| f.as_array().to_owned());
        if tractions.iter().any(|f| f.dim() != shape) {
            refuse!("p, q_x, q_y: must be of the shape of the grid, {shape:?}");
        }
        let body = self.number;
        let stresses = self.with_bodies(py, &yielded, |yielding| {
            let [p, q_x, q_y] = &tractions;
            let loaded = yielding.stress(&yielded, Some([p, q_x, q_y]), (body, sigma_B));
            let residual = yielding.stress(&yielded, None, (body, 0.0));
            let mesh = yielding.mesh(body);
            let shape = mesh.map(|mesh| (mesh.planes(), mesh.cells.nx, mesh.cells.ny));
            (loaded, residual, shape, yielding.points(&yielded, body))
        })?;
        let (Some(loaded), Some(left), Some((planes, nx, ny)), points) = stresses else {
            return Err(self.stays_elastic());
        };
        let mut equivalent = Array3::<f64>::zeros((planes, nx, ny));
        let mut strain = Array4::<f64>::zeros((planes, COMPONENTS, nx, ny));
        for (plane, cell, point) in points {
            let (i, j) = (cell / ny, cell % ny);
            equivalent[(plane, i, j)] = point.equivalent;
            for (c, value) in point.strain.iter().enumerate() {
                strain[(plane, c, i, j)] = *value;
            }
        }
        let stress = |values: Vec<f64>| {
            Array4::from_shape_vec((planes, COMPONENTS, nx, ny), values)
                .unwrap_or_else(|_| Array4::zeros((planes, COMPONENTS, nx, ny)))
        };
        let table = PyDict::new(py);
        table.set_item("equivalent", equivalent.into_pyarray(py))?;
        table.set_item("strain", strain.into_pyarray(py))?;
        table.set_item("stress", stress(loaded).into_pyarray(py))?;
        table.set_item("residual_stress", stress(left).into_pyarray(py))?;
        Ok(table)
    }

    /// Displacements that the surfaces have without tractions, on the grid of the contact [m].
    ///
    /// Growth of the gap by both bodies, u(2) - u(1) along x and y; the depth of this body.
    #[pyo3(signature = (rows: "Sequence[NDArray[np.float64]]") -> "dict[str, NDArray[np.float64]]")]
    fn imprint<'py>(&self, py: Python<'py>, rows: List<List<f64>>) -> PyResult<Bound<'py, PyDict>> {
        let yielded = read(rows)?;
        let body = self.number;
        let answers = self.with_bodies(py, &yielded, |yielding| {
            let whole = yielding.completed(&yielded);
            let residual = yielding.residual_of(&whole);
            let mut body_state = whole;
            body_state.bodies.retain(|state| state.body == body);
            (residual, yielding.residual_of(&body_state).gap)
        })?;
        let (both, depth) = answers;
        let table = PyDict::new(py);
        let on_grid = |field: Array2<f64>| field.into_pyarray(py);
        let [u_x, u_y] = both.u;
        table.set_item("imprint", on_grid(both.gap))?;
        table.set_item("residual_x", on_grid(u_x))?;
        table.set_item("residual_y", on_grid(u_y))?;
        table.set_item("depth", on_grid(depth))?;
        Ok(table)
    }

    /// Whether the stress without tractions yields nowhere.
    #[pyo3(signature = (rows: "Sequence[NDArray[np.float64]]"))]
    fn unloads_elastically(&self, py: Python<'_>, rows: List<List<f64>>) -> Answer<bool> {
        let yielded = read(rows)?;
        self.with_bodies(py, &yielded, |yielding| {
            yielding.unloads_elastically(&yielded)
        })
    }

    /// The residual stress, for :class:`Subsurface`; None where nothing has yielded.
    #[pyo3(signature = (rows: "Sequence[NDArray[np.float64]]"))]
    fn eigenstress(&self, py: Python<'_>, rows: List<List<f64>>) -> Answer<Option<Eigenstress>> {
        let yielded = read(rows)?;
        let eigenstress = py.detach(|| self.of.eigenstress(Some(&yielded)));
        Ok(eigenstress?.map(Eigenstress))
    }
}
