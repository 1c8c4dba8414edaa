//! Friction laws that are functions of Python.

use contact_core::scene::{self as core, CellHistory, LawError};
use ndarray::IxDyn;
use pyo3::exceptions::PyTypeError;

use crate::error::InvalidSceneError;
use crate::prelude::*;
use crate::python::from_python;

/// The word for a law of which only that it exists is known.
pub(crate) const OWN: &str = "own";

/// Fields of the exposed surfaces that a function gets if its signature names them.
const SURFACE: [&str; 6] = ["worn1", "worn2", "layer1", "layer2", "bed", "aerated"];

/// A callable on arrays, and the fields of the exposed surfaces that it takes.
#[derive(Debug)]
struct Own(Py<PyAny>, Vec<&'static str>);

impl core::FrictionLaw for Own {
    /// Calls the function with the fields of the cells that it takes; its exception becomes the error.
    fn coefficients(&self, cells: &CellHistory<'_>, mu: &mut [f64]) -> Result<(), LawError> {
        let call = |py: Python<'_>| -> PyResult<()> {
            let fields = [cells.x, cells.y, cells.p, cells.slip, cells.dissipated];
            let [x, y, p, slip, dissipated] = fields.map(|field| field.to_pyarray(py));
            let exposed = PyDict::new(py);
            let ([worn1, worn2], [layer1, layer2]) = (cells.worn, cells.layer);
            let surface = [worn1, worn2, layer1, layer2, cells.bed, cells.aerated];
            for (name, field) in SURFACE.iter().zip(surface) {
                if self.1.contains(name) {
                    exposed.set_item(name, field.to_pyarray(py))?;
                }
            }
            let law = self.0.bind(py);
            let answer = law.call((x, y, p, slip, dissipated), Some(&exposed))?;
            let array: Array<'_, IxDyn> = answer.extract().map_err(|why: PyErr| {
                let why = why.value(py);
                if why.is_instance_of::<PyValueError>() {
                    return InvalidSceneError::new_err(format!(
                        "friction.law = {answer}: must be a finite coefficient >= 0 in each cell: {why}"
                    ));
                }
                PyTypeError::new_err(format!(
                    "friction law {}: gave {answer}, must be an array of real numbers, a coefficient for each cell, \
                     or one number: {why}",
                    self.0,
                ))
            })?;
            let values = array.as_array();
            match (values.ndim(), values.len()) {
                (0, _) => mu.fill(values.sum()),
                (1, n) if n == mu.len() => {
                    for (mu, values) in mu.iter_mut().zip(values) {
                        *mu = *values;
                    }
                }
                _ => {
                    refuse!(
                        "friction law {}: gave an array of shape {:?}, must be ({},), a coefficient for each \
                         cell, or one number",
                        self.0,
                        values.shape(),
                        mu.len()
                    );
                }
            }
            Ok(())
        };
        Python::attach(call).map_err(|raised| Arc::new(raised) as LawError)
    }

    /// The address of the function.
    fn identity(&self) -> usize {
        self.0.as_ptr() as usize
    }

    /// The law for a downcast.
    fn as_any(&self) -> Option<&dyn std::any::Any> {
        Some(self)
    }
}

/// Makes a law of a function, or of the word that stands for a missing one.
pub(crate) fn own_law(given: &Bound<'_, PyAny>) -> PyResult<core::UserFriction> {
    if given.extract::<&str>().is_ok_and(|word| word == OWN) {
        return Ok(core::UserFriction::unavailable());
    }
    if given.is_callable() {
        let names = from_python(given.py(), "accepted_keywords")?;
        let names: Vec<String> = names.call1((given, SURFACE.to_vec()))?.extract()?;
        let taken = SURFACE
            .into_iter()
            .filter(|name| names.iter().any(|n| n == name));
        return Ok(core::UserFriction::new(Own(
            given.clone().unbind(),
            taken.collect(),
        )));
    }
    Err(crate::error::must_be(
        given,
        "a function of the arrays (x, y, p, slip, dissipated) that gives the coefficient of each cell",
    ))
}

/// The function of a law, or the word for a missing one.
pub(crate) fn function<'py>(py: Python<'py>, law: &core::UserFriction) -> Bound<'py, PyAny> {
    let python_law = law.0.as_any().and_then(|law| law.downcast_ref::<Own>());
    python_law.map_or_else(
        || pyo3::types::PyString::new(py, OWN).into_any(),
        |python_law| python_law.0.bind(py).clone(),
    )
}
