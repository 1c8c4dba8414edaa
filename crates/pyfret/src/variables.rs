//! Variables of a run as xarray takes them: dimensions, values, attributes.

use contact_core::march::{Fields, Increment};
use contact_core::scene::Grid;
use contact_store::{
    AXES, Columns, FIELDS, FieldView, KeptField, Kind, POINTS, SCALARS, STATUS_MEANINGS,
    StoredVariable, YIELDED, to_rows,
};
use ndarray::{Array1, Array2, Array3, ArrayD, Axis, IxDyn};
use numpy::{Element, PyArray1};
use pyo3::exceptions::PyRuntimeError;
use pyo3::types::PyTuple;

use crate::prelude::*;

/// Collects the variables by their names.
pub(crate) struct Variables<'py>(Bound<'py, PyDict>);

impl<'py> Variables<'py> {
    /// A dict without a variable.
    pub(crate) fn new(py: Python<'py>) -> Self {
        Self(PyDict::new(py))
    }

    /// The dict.
    pub(crate) fn finish(self) -> Bound<'py, PyDict> {
        self.0
    }

    /// Adds a variable: dimensions, values, unit and meaning.
    fn put(
        &self,
        name: &str,
        dims: &[&str],
        values: Bound<'py, PyAny>,
        (units, long_name): (&str, &str),
    ) -> PyResult<()> {
        let py = self.0.py();
        let attributes = PyDict::new(py);
        attributes.set_item("units", units)?;
        attributes.set_item("long_name", long_name)?;
        if name == "status" {
            attributes.set_item("flag_values", [0, 1, 2, 3])?;
            attributes.set_item("flag_meanings", STATUS_MEANINGS)?;
        }
        let dims = PyTuple::new(py, dims)?;
        self.0.set_item(name, (dims, values, attributes))
    }

    /// Adds the coordinates of the cells.
    pub(crate) fn cells(&self, grid: &Grid) -> PyResult<()> {
        for axis in AXES.iter().filter(|axis| axis.dim != "saved") {
            let places: Vec<f64> = if axis.name == "x" {
                (0..grid.nx).map(|i| grid.x(i)).collect()
            } else {
                (0..grid.ny).map(|j| grid.y(j)).collect()
            };
            let values = PyArray1::from_vec(self.0.py(), places).into_any();
            self.put(axis.name, &[axis.dim], values, (axis.units, axis.long_name))?;
        }
        Ok(())
    }

    /// Adds the scalars of one increment, without a dimension.
    pub(crate) fn increment(&self, increment: &Increment, grid: &Grid) -> PyResult<()> {
        for scalar in SCALARS.iter().map(|scalar| scalar.for_grid(grid)) {
            let value = ArrayD::from_elem(IxDyn(&[]), (scalar.value)(increment));
            let values = self.typed(scalar.kind, value);
            self.put(scalar.name, &[], values, (scalar.units, scalar.long_name))?;
        }
        Ok(())
    }

    /// Adds the columns of the yielded points.
    fn points(&self, columns: Vec<Vec<f64>>) -> PyResult<()> {
        for (of, values) in YIELDED.iter().zip(columns) {
            let values = self.typed(of.kind, Array1::from_vec(values).into_dyn());
            self.put(of.name, &[POINTS], values, (of.units, of.long_name))?;
        }
        Ok(())
    }

    /// Adds the fields of one increment over (x, y).
    pub(crate) fn fields(&self, increment: usize, fields: &Fields) -> PyResult<()> {
        let py = self.0.py();
        if let Some(yielded) = &fields.yielded {
            self.points(to_rows(increment, yielded))?;
        }
        for field in FIELDS {
            let values = match (field.values)(fields) {
                FieldView::Real(values) => values.to_pyarray(py).into_any(),
                FieldView::Mask(values) => values.to_pyarray(py).into_any(),
            };
            self.put(
                field.name,
                &["x", "y"],
                values,
                (field.units, field.long_name),
            )?;
        }
        Ok(())
    }

    /// Adds the scalars of all increments, and the fields of those that are kept.
    pub(crate) fn columns(&self, columns: Columns, grid: &Grid) -> PyResult<()> {
        let py = self.0.py();
        self.points(columns.points)?;
        let on_grid = SCALARS.iter().map(|scalar| scalar.for_grid(grid));
        for (scalar, values) in on_grid.zip(columns.scalars) {
            let values = self.typed(scalar.kind, Array1::from_vec(values).into_dyn());
            self.put(
                scalar.name,
                &["increment"],
                values,
                (scalar.units, scalar.long_name),
            )?;
        }
        for axis in AXES.iter().filter(|axis| axis.dim == "saved") {
            let coordinate = |(index, t): &(usize, f64)| match axis.kind {
                Kind::Count => *index as f64,
                _ => *t,
            };
            let values: Vec<f64> = columns.saved.iter().map(coordinate).collect();
            let values = self.typed(axis.kind, Array1::from_vec(values).into_dyn());
            self.put(axis.name, &[axis.dim], values, (axis.units, axis.long_name))?;
        }
        for (field, kept) in FIELDS.iter().zip(columns.fields) {
            let values = match kept {
                KeptField::Real(kept) => stacked(py, kept, (grid.nx, grid.ny)),
                KeptField::Mask(kept) => stacked(py, kept, (grid.nx, grid.ny)),
            };
            self.put(
                field.name,
                &["saved", "x", "y"],
                values,
                (field.units, field.long_name),
            )?;
        }
        Ok(())
    }

    /// Adds a variable of a run of wear.
    pub(crate) fn in_memory(&self, of: StoredVariable) -> PyResult<()> {
        let words = |key: &str| of.attributes[key].as_str().unwrap_or_default();
        let dims = of.attributes["_ARRAY_DIMENSIONS"].as_array();
        let dims: Vec<&str> = dims
            .into_iter()
            .flatten()
            .filter_map(serde_json::Value::as_str)
            .collect();
        let values = ArrayD::from_shape_vec(IxDyn(&of.shape), of.values)
            .map_err(|e| PyRuntimeError::new_err(format!("{}: {e}", of.name)))?;
        let values = self.typed(of.kind, values);
        self.put(of.name, &dims, values, (words("units"), words("long_name")))
    }

    /// Converts numbers to the type that a store has for their kind.
    fn typed(&self, kind: Kind, values: ArrayD<f64>) -> Bound<'py, PyAny> {
        let py = self.0.py();
        match kind {
            Kind::Real => values.into_pyarray(py).into_any(),
            Kind::Count => values.mapv(|v| v as i32).into_pyarray(py).into_any(),
            Kind::Code => values.mapv(|v| v as i8).into_pyarray(py).into_any(),
            Kind::Flag => values.mapv(|v| v != 0.0).into_pyarray(py).into_any(),
        }
    }
}

/// Stacks fields to an array over (saved, x, y); each is freed as soon as it is copied.
fn stacked<T: Element + Copy + Default>(
    py: Python<'_>,
    kept: Vec<Array2<T>>,
    (nx, ny): (usize, usize),
) -> Bound<'_, PyAny> {
    let mut fields = Array3::from_elem((kept.len(), nx, ny), T::default());
    for (mut here, values) in fields.axis_iter_mut(Axis(0)).zip(kept) {
        here.assign(&values);
    }
    fields.into_pyarray(py).into_any()
}
