//! Criteria with their numbers.

use std::collections::BTreeMap;
use std::ffi::{CStr, CString};
use std::hash::{DefaultHasher, Hash, Hasher};

use fatigue as core;
use pyo3::exceptions::PyTypeError;
use pyo3::types::{PyCFunction, PyString, PyTuple};

use super::Material;
use crate::error::Answer;
use crate::prelude::*;

/// Argument of a criterion that gives the numbers which are left out.
const MATERIAL: &str = "material";

/// A criterion by its name, one of :data:`pyfret.fatigue.CRITERIA`, and its numbers by theirs.
///
/// Examples
/// --------
/// >>> Criterion.findley(k=0.3) == Criterion("findley", k=0.3)
/// True
/// >>> Criterion.fatemi_socie(material="7075").name
/// 'fatemi_socie'
#[pyclass(frozen, eq, from_py_object, module = "pyfret.fatigue")]
#[derive(Clone, PartialEq)]
pub(crate) struct Criterion(pub(super) core::Criterion);

/// Adds a static method to the class for each criterion of the core: `Criterion.findley(k=0.3)`.
pub(crate) fn add_criteria(py: Python<'_>) -> PyResult<()> {
    let class = py.get_type::<Criterion>();
    let text = |text: String| {
        Ok::<&'static CStr, PyErr>(Box::leak(CString::new(text)?.into_boxed_c_str()))
    };
    for definition in core::CRITERIA {
        let make = |args: &Bound<'_, PyTuple>, numbers: Option<&Bound<'_, PyDict>>| {
            if !args.is_empty() {
                let message = format!("{}() takes its numbers by name only", definition.name);
                return Err(PyTypeError::new_err(message));
            }
            Ok(Criterion::new(definition.name, numbers)?)
        };
        let names = definition.parameters.iter().map(|one| one.name);
        let doc = format!(
            "Give {}.\n\n{}.\nIts numbers: {}. ``{MATERIAL}``, a Material or its name, gives\nthose that \
             are left out.",
            definition.equation,
            definition.source,
            names.collect::<Vec<_>>().join(", ")
        );
        let name = text(definition.name.to_owned())?;
        let function = PyCFunction::new_closure(py, Some(name), Some(text(doc)?), make)?;
        class.setattr(definition.name, function)?;
    }
    Ok(())
}

#[pymethods]
impl Criterion {
    #[new]
    #[pyo3(signature = (name, /, **numbers: "float | Material | str"))]
    fn new(name: &str, numbers: Option<&Bound<'_, PyDict>>) -> Answer<Self> {
        let mut values: BTreeMap<String, f64> = BTreeMap::new();
        for (key, value) in numbers.into_iter().flatten() {
            let key: String = key.extract()?;
            if key == MATERIAL {
                let criterion = Self::from_material(name, &value)?;
                for (number, value) in criterion.0.numbers() {
                    values.entry(number.to_owned()).or_insert(value);
                }
            } else {
                values.insert(key, number(&value)?);
            }
        }
        let pairs: Vec<_> = values.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        let made = core::Criterion::new(name, &pairs)?;
        Ok(Self(made))
    }

    /// The criterion of a name with the numbers of a material.
    ///
    /// Parameters
    /// ----------
    /// name : str
    ///     One of :data:`pyfret.fatigue.CRITERIA`.
    /// material : Material or str
    ///     The material, or its name in the table that comes with the package. A ValueError names a
    ///     number that it lacks.
    ///
    /// Examples
    /// --------
    /// >>> Criterion.of("fatemi_socie", "7075") == Criterion.fatemi_socie(material="7075")
    /// True
    #[staticmethod]
    #[pyo3(name = "of", signature = (name, material: "Material | str"))]
    fn from_material(name: &str, material: &Bound<'_, PyAny>) -> Answer<Self> {
        let material = if material.is_instance_of::<PyString>() {
            let called: String = material.extract()?;
            let materials = core::materials();
            core::find(&materials, &called).cloned().ok_or_else(|| {
                let names: Vec<_> = materials.keys().map(String::as_str).collect();
                let message = format!(
                    "material = {called:?}: must be a Material, or one of {}",
                    names.join(", ")
                );
                PyValueError::new_err(message)
            })?
        } else {
            let allowed = "a Material, or the name of one";
            let refused = |_| {
                let refusal = must_be(material, allowed);
                PyTypeError::new_err(format!("material = {}", refusal.value(material.py())))
            };
            material.extract::<Material>().map_err(refused)?.0
        };
        let assessment = core::Assessment::from_name(name, &material)?;
        Ok(Self(assessment.criterion))
    }

    fn __getnewargs_ex__<'py>(&self, py: Python<'py>) -> PyResult<((&str,), Bound<'py, PyDict>)> {
        Ok(((self.name(),), self.numbers(py)?))
    }

    /// Its numbers by their names.
    #[getter]
    fn numbers<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let numbers = PyDict::new(py);
        for (name, value) in self.0.numbers() {
            numbers.set_item(name, value)?;
        }
        Ok(numbers)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.name().hash(&mut hasher);
        for (_, value) in self.0.numbers() {
            // -0 equals 0.
            (value + 0.0).to_bits().hash(&mut hasher);
        }
        hasher.finish()
    }

    pub(super) fn __repr__(&self) -> String {
        format!("Criterion.{:?}", self.0)
    }
}

attributes!(Criterion, self:
    /// Name of the criterion.
    name: &'static str = self.0.name();
    /// Unit of its value: Pa, or 1 for strains.
    unit: &'static str = self.0.unit();
    /// Whether it takes strains, and not the stress alone.
    takes_strain: bool = self.0.takes_strain();
    /// Whether it has a critical plane.
    has_plane: bool = self.0.has_plane();
);

/// Names of the criteria, and how they are written in figures.
#[pyfunction]
pub(crate) fn criteria() -> Vec<(&'static str, &'static str)> {
    core::CRITERIA.iter().map(|d| (d.name, d.title)).collect()
}
