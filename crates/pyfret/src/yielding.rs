//! Plastic strain below a contact, for a march that goes on.

use contact_core::march::March;
use contact_core::scene::Grid;
use eigenstrain::{COMPONENTS, Mesh};
use ndarray::{Array2, Array3, Array4};
use numpy::{IntoPyArray, PyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Centres of cells along a side \[m\].
fn centres(cells: usize, length: f64) -> Vec<f64> {
    let middle = 0.5 * (cells as f64 - 1.0);
    (0..cells).map(|i| (i as f64 - middle) * length).collect()
}

/// The plastic strain of a body after the last increment, the stress there and the residual
/// displacement of the surfaces; None where the body stays elastic.
pub(crate) fn plastic<'py>(
    py: Python<'py>,
    march: &mut March,
    body: usize,
) -> PyResult<Option<Bound<'py, PyDict>>> {
    let Some(yielded) = march.state().yielded.clone() else {
        return Ok(None);
    };
    let (Some(residual), [p, q_x, q_y]) = (march.residual(), march.tractions()) else {
        return Ok(None);
    };
    let grid: Grid = march.scene().grid;
    let Some(yielding) = march.yielding() else {
        return Ok(None);
    };
    let (Some(loaded), Some(left)) = (
        yielding.stress(&yielded, Some([&p, &q_x, &q_y]), body),
        yielding.stress(&yielded, None, body),
    ) else {
        return Ok(None);
    };
    let Some(mesh) = yielding.mesh(body) else {
        return Ok(None);
    };
    let Some(state) = yielded.bodies.iter().find(|state| state.body == body) else {
        return Ok(None);
    };
    let (planes, nx, ny) = (mesh.planes(), mesh.cells.nx, mesh.cells.ny);
    let mut equivalent = Array3::<f64>::zeros((planes, nx, ny));
    let mut strain = Array4::<f64>::zeros((planes, COMPONENTS, nx, ny));
    for point in &state.points {
        let (plane, cell) = (point.plane as usize, point.cell as usize);
        let (i, j) = (cell / ny, cell % ny);
        equivalent[(plane, i, j)] = point.equivalent;
        for (c, value) in point.strain.iter().enumerate() {
            // z points into body 2 in the axes of the scene.
            let turned = body == 1 && c >= 4;
            strain[(plane, c, i, j)] = if turned { -value } else { *value };
        }
    }
    let stress = |values: Vec<f64>| {
        Array4::from_shape_vec((planes, COMPONENTS, nx, ny), values)
            .unwrap_or_else(|_| Array4::zeros((planes, COMPONENTS, nx, ny)))
    };
    let of_planes = |of: &dyn Fn(&Mesh, usize) -> f64| {
        PyArray1::from_vec(py, (0..planes).map(|n| of(mesh, n)).collect())
    };
    let found = PyDict::new(py);
    found.set_item("z", of_planes(&|mesh, n| mesh.depth(n)))?;
    found.set_item("height", of_planes(&|mesh, n| mesh.weight(n)))?;
    found.set_item("layer", of_planes(&|mesh, n| mesh.layer(n) as f64))?;
    found.set_item("x", PyArray1::from_vec(py, centres(nx, mesh.cells.dx)))?;
    found.set_item("y", PyArray1::from_vec(py, centres(ny, mesh.cells.dy)))?;
    found.set_item("area", mesh.cells.area())?;
    found.set_item("equivalent", equivalent.into_pyarray(py))?;
    found.set_item("strain", strain.into_pyarray(py))?;
    found.set_item("stress", stress(loaded).into_pyarray(py))?;
    found.set_item("residual_stress", stress(left).into_pyarray(py))?;
    let on_grid = |field: Array2<f64>| field.into_pyarray(py);
    let [u_x, u_y] = residual.u;
    found.set_item("imprint", on_grid(residual.gap))?;
    found.set_item("residual_x", on_grid(u_x))?;
    found.set_item("residual_y", on_grid(u_y))?;
    let cells = |n: usize, at: &dyn Fn(usize) -> f64| (0..n).map(at).collect::<Vec<f64>>();
    found.set_item(
        "grid_x",
        PyArray1::from_vec(py, cells(grid.nx, &|i| grid.x(i))),
    )?;
    found.set_item(
        "grid_y",
        PyArray1::from_vec(py, cells(grid.ny, &|j| grid.y(j))),
    )?;
    Ok(Some(found))
}
