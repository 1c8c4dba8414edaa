//! How a scene is solved: a dataclass of Python, which comes and goes as the tables of a scene file.

use contact_core::scene as core;

use crate::document::{Document, to_dict};
use crate::error::{Answer, to_python};
use crate::prelude::*;
use crate::python::from_python;

/// The settings, on their way in or out.
#[derive(Clone, Default)]
pub(crate) struct Settings(pub(crate) core::Settings);

impl<'py> FromPyObject<'_, 'py> for Settings {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = crate::hints::SETTINGS;

    /// Takes an instance of the Python class by its document.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        let class = from_python(value.py(), "Settings")?;
        if !value.is_instance(&class)? {
            return Err(must_be(
                &value,
                "settings, such as Settings(tolerance=1e-8)",
            ));
        }
        let tables: Document = value.call_method0("document")?.extract()?;
        let settings = core::Settings::from_table(&tables.0).map_err(to_python)?;
        Ok(Self(settings))
    }
}

impl<'py> IntoPyObject<'py> for Settings {
    type Target = PyAny;
    type Output = Bound<'py, PyAny>;
    type Error = PyErr;

    const OUTPUT_TYPE: PyStaticExpr = crate::hints::SETTINGS;

    /// Makes an instance of the Python class.
    fn into_pyobject(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let tables: Bound<'py, PyDict> = to_dict(&self.0.to_table(), py)?;
        from_python(py, "Settings")?.call_method1("of", (tables,))
    }
}

/// Fails if a setting has no meaning.
#[pyfunction]
pub(crate) fn check_settings(settings: Settings) {
    drop(settings);
}

/// Reads which increments keep their fields, as in a scene file.
pub(crate) fn save_fields(save: &Bound<'_, PyAny>) -> Answer<core::SaveFields> {
    let output = PyDict::new(save.py());
    output.set_item("save", save)?;
    let tables = PyDict::new(save.py());
    tables.set_item("output", output)?;
    let tables: Document = tables.extract()?;
    let settings = core::Settings::from_table(&tables.0)?;
    Ok(settings.save)
}
