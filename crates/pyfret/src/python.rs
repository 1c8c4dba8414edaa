//! Functions of Python that the compiled module calls, and the module itself.

use pyo3::sync::PyOnceLock;

use crate::prelude::*;

static MODULE: PyOnceLock<Py<PyModule>> = PyOnceLock::new();

/// Keeps the module, when it is made, for [`own`].
pub(crate) fn keep(module: &Bound<'_, PyModule>) {
    let _ = MODULE.set(module.py(), module.clone().unbind());
}

/// A function or class of the compiled module by its name.
pub(crate) fn own<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    let module = MODULE
        .get(py)
        .ok_or_else(|| PyValueError::new_err("no module"))?;
    module.bind(py).getattr(name)
}

/// A function or class, by its name, of the one Python module that the compiled module imports.
pub(crate) fn from_python<'py>(py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("pyfret.called_from_rust")?.getattr(name)
}

/// The error of an attribute that an object does not have, with the nearest name.
pub(crate) fn missing_attribute(object: &Bound<'_, PyAny>, name: &str) -> PyErr {
    let refused =
        from_python(object.py(), "missing_attribute").and_then(|f| f.call1((object, name)));
    refused.map_or_else(|error| error, |_| PyValueError::new_err(name.to_owned()))
}

/// Make a pickled object again: call its maker, or a method of it, with keywords.
///
/// Without keywords return an attribute of the maker.
#[pyfunction]
#[pyo3(signature = (maker: "Any", method = None, keywords = None) -> "Any")]
pub(crate) fn remake<'py>(
    maker: Bound<'py, PyAny>,
    method: Option<&str>,
    keywords: Option<&Bound<'py, PyDict>>,
) -> PyResult<Bound<'py, PyAny>> {
    let call = match method {
        Some(method) => maker.getattr(method)?,
        None => maker,
    };
    match keywords {
        Some(keywords) => call.call((), Some(keywords)),
        None => Ok(call),
    }
}
