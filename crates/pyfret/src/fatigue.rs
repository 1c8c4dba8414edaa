//! Fatigue criteria, yield and shakedown on plain stress histories.

use std::collections::BTreeMap;
use std::ffi::{CStr, CString};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::PathBuf;
use std::sync::Arc;

use contact_core::scene::text_of;
use fatigue as core;
use ndarray::{Array1, Array2, Ix2, Ix3};
use numpy::IntoPyArray;
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCFunction, PyDict, PyString, PyTuple};

use crate::arguments::{Array, List, number};
use crate::error::{of_criterion as refused, to_python};
use crate::interruptible::interruptible;
use crate::quantity::Given;

/// A number of what a criterion finds at a point.
type Number = fn(&core::AtPoint) -> f64;

/// The numbers of a criterion at a point, by the names that Python has for them.
pub(crate) const AT_POINT: [(&str, Number); 7] = [
    ("value", |p| p.value),
    ("missed", |p| p.missed),
    ("planes", |p| p.planes as f64),
    ("shear_amplitude", |p| p.shear_amplitude),
    ("shear_chord", |p| p.shear_chord),
    ("normal_max", |p| p.normal_max),
    ("normal_min", |p| p.normal_min),
];

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
pub(crate) struct Criterion(core::Criterion);

/// A static method of the class for every criterion of the core: `Criterion.findley(k=0.3)`.
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
            Criterion::new(definition.name, numbers)
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
        let of_class = py.import("builtins")?.getattr("staticmethod")?;
        class.setattr(definition.name, of_class.call1((function,))?)?;
    }
    Ok(())
}

#[pymethods]
impl Criterion {
    #[new]
    #[pyo3(signature = (name, /, **numbers: "float | Material | str"))]
    fn new(name: &str, numbers: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut given: BTreeMap<String, f64> = BTreeMap::new();
        for (key, value) in numbers.into_iter().flatten() {
            let key: String = key.extract()?;
            if key == MATERIAL {
                let of = Self::of(name, &value)?;
                for (number, value) in of.0.numbers() {
                    given.entry(number.to_owned()).or_insert(value);
                }
            } else {
                given.insert(key, number(&value)?);
            }
        }
        let given: Vec<_> = given.iter().map(|(n, v)| (n.as_str(), *v)).collect();
        let made = core::Criterion::new(name, &given).map_err(refused)?;
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
    #[pyo3(signature = (name, material: "Material | str"))]
    fn of(name: &str, material: &Bound<'_, PyAny>) -> PyResult<Self> {
        let material = if material.is_instance_of::<PyString>() {
            let called: String = material.extract()?;
            let all = core::materials();
            core::find(&all, &called).cloned().ok_or_else(|| {
                let names: Vec<_> = all.keys().map(String::as_str).collect();
                let message = format!(
                    "material = {called:?}: must be a Material, or one of {}",
                    names.join(", ")
                );
                PyValueError::new_err(message)
            })?
        } else {
            material.extract::<Material>()?.0
        };
        let found = core::Assessment::of(name, &material).map_err(refused)?;
        Ok(Self(found.criterion))
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

    /// Name of the criterion.
    #[getter]
    fn name(&self) -> &'static str {
        self.0.name()
    }

    /// Unit of its value: Pa, or 1 for strains.
    #[getter]
    fn unit(&self) -> &'static str {
        self.0.unit()
    }

    /// Whether it takes strains, and not the stress alone.
    #[getter]
    fn takes_strain(&self) -> bool {
        self.0.takes_strain()
    }

    /// Whether it has a critical plane.
    #[getter]
    fn has_plane(&self) -> bool {
        self.0.has_plane()
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

    fn __repr__(&self) -> String {
        format!("Criterion.{:?}", self.0)
    }
}

/// A criterion with its limit or its curve of lives.
///
/// Parameters
/// ----------
/// criterion : Criterion
///     Whose value is judged.
/// limit : float, optional
///     Limit for endless life, in the unit of the criterion.
/// curve : five floats, optional
///     Instead of it E [Pa], s_f' [Pa], b, e_f' and c of a strain-life curve.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.fatigue")]
#[derive(Clone, PartialEq)]
pub(crate) struct Assessment(pub(crate) core::Assessment);

#[pymethods]
impl Assessment {
    #[new]
    #[pyo3(signature = (criterion, *, limit: "float | None" = None, curve: "Sequence[float] | None" = None))]
    fn new(
        criterion: Criterion,
        #[pyo3(from_py_with = number)] limit: Option<f64>,
        #[pyo3(from_py_with = number)] curve: Option<[f64; 5]>,
    ) -> PyResult<Self> {
        let judge = match (limit, curve) {
            (Some(limit), None) if limit > 0.0 && limit.is_finite() => core::Judge::Limit(limit),
            (None, Some([E, coefficient, exponent, ductility, of_ductility])) => {
                let curve = core::CoffinManson {
                    E,
                    elastic: core::Basquin {
                        coefficient,
                        exponent,
                    },
                    ductility,
                    exponent: of_ductility,
                };
                curve.check().map_err(refused)?;
                core::Judge::Life(curve)
            }
            _ => {
                let message =
                    "give a limit, a positive number in the unit of the criterion, or a curve";
                return Err(PyValueError::new_err(message));
            }
        };
        Ok(Self(core::Assessment {
            criterion: criterion.0,
            judge,
        }))
    }

    /// The criterion whose value is judged.
    #[getter]
    fn criterion(&self) -> Criterion {
        Criterion(self.0.criterion)
    }

    /// E [Pa], s_f' [Pa], b, e_f' and c of the strain-life curve, or nothing with a limit.
    #[getter]
    fn curve(&self) -> Option<[f64; 5]> {
        let core::Judge::Life(of) = self.0.judge else {
            return None;
        };
        let core::Basquin {
            coefficient,
            exponent,
        } = of.elastic;
        Some([of.E, coefficient, exponent, of.ductility, of.exponent])
    }

    /// The limit, or nothing where the criterion gives lives.
    #[getter]
    fn limit(&self) -> Option<f64> {
        match self.0.judge {
            core::Judge::Limit(limit) => Some(limit),
            core::Judge::Life(_) => None,
        }
    }

    /// Low, best and high margin of a value with an error, and their range of 10 to 90 %.
    ///
    /// The range has the scatter of the material; `scatter` takes the place of its default.
    #[pyo3(signature = (value: "float", error: "float", material = None, *, scatter: "float | None" = None) -> "tuple[tuple[float, float, float], tuple[float, float, float], float, list[str]]")]
    #[expect(clippy::type_complexity, reason = "the parts of a range")]
    fn range_at(
        &self,
        #[pyo3(from_py_with = number)] value: f64,
        #[pyo3(from_py_with = number)] error: f64,
        material: Option<Material>,
        #[pyo3(from_py_with = number)] scatter: Option<f64>,
    ) -> PyResult<((f64, f64, f64), (f64, f64, f64), f64, Vec<String>)> {
        let material = material.as_ref().map(|material| &material.0);
        let (factor, note) = self.0.scatter(material, scatter).map_err(refused)?;
        let found = self.0.told(self.0.margins(value, error), factor, None);
        let three = |of: core::Range| (of.low, of.best, of.high);
        Ok((
            three(found.stress),
            three(found.range),
            factor,
            note.into_iter().collect(),
        ))
    }

    /// Factor by which the history may grow until the limit, for values of the criterion.
    #[pyo3(signature = (value: "float"))]
    fn safety_factor(&self, #[pyo3(from_py_with = number)] value: f64) -> f64 {
        self.0.safety_factor(value)
    }

    /// Cycles to failure for values of the criterion.
    #[pyo3(signature = (value: "float"))]
    fn life(&self, #[pyo3(from_py_with = number)] value: f64) -> f64 {
        self.0.life(value)
    }

    fn __getnewargs_ex__<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<((Criterion,), Bound<'py, PyDict>)> {
        let judge = PyDict::new(py);
        judge.set_item("limit", self.limit())?;
        judge.set_item("curve", self.curve())?;
        Ok(((self.criterion(),), judge))
    }

    fn __repr__(&self) -> String {
        let criterion = self.criterion().__repr__();
        match self.0.judge {
            core::Judge::Limit(limit) => format!("Assessment({criterion}, limit={limit:?})"),
            core::Judge::Life(_) => format!("Assessment({criterion}, lives)"),
        }
    }
}

/// A material and its numbers.
///
/// Parameters
/// ----------
/// name : str
///     Its key in tables.
/// numbers : list of (str, float, str)
///     Name, as in a file of materials, value in its SI unit, and where that is from.
/// title : str
///     What the material is (default: its name).
/// also : list of str
///     Other names that it is found by.
///
/// Examples
/// --------
/// >>> tests = "bending and torsion tests, report 2024-17"
/// >>> steel = Material("our_steel", [("s_D", 412e6, tests), ("t_D", 268e6, tests)])
#[pyclass(frozen, eq, from_py_object, module = "pyfret.fatigue")]
#[derive(Clone, PartialEq)]
pub(crate) struct Material(pub(crate) core::Material);

#[pymethods]
impl Material {
    #[new]
    #[pyo3(signature = (name, numbers: "Sequence[tuple[str, float, str]]", title = None, also: "Sequence[str]" = List::default()))]
    fn new(
        name: &str,
        numbers: List<(String, f64, String)>,
        title: Option<&str>,
        also: List<String>,
    ) -> PyResult<Self> {
        let made = core::Material::new(name, title.unwrap_or(name), numbers);
        let mut made = made.map_err(refused)?;
        made.also = also.0;
        Ok(Self(made))
    }

    #[expect(clippy::type_complexity, reason = "the arguments of the constructor")]
    fn __getnewargs__(&self) -> (&str, Vec<(&'static str, f64, String)>, &str, Vec<String>) {
        (self.name(), self.numbers(), self.title(), self.also())
    }

    /// Other names that it is found by.
    #[getter]
    fn also(&self) -> Vec<String> {
        self.0.also.clone()
    }

    /// Critical distance L = (dK_th/(2 s_D))^2/pi [m].
    ///
    /// ``dK_th`` is the threshold range of the stress intensity, and 2 ``s_D`` the range of the
    /// fatigue limit. Both are fully reversed. Source: D. Taylor, The Theory of Critical Distances,
    /// Elsevier (2007). A ValueError names the number that is missing.
    fn critical_distance(&self) -> PyResult<f64> {
        self.0.critical_distance().map_err(refused)
    }

    /// The material with the missing numbers that published rules can estimate.
    fn estimated(&self, family: &str) -> PyResult<Self> {
        let family = core::Family::named(family).map_err(refused)?;
        Ok(Self(core::estimated(&self.0, family)))
    }

    /// Whether the material has this name, whatever its case and the marks between letters.
    fn is_called(&self, name: &str) -> bool {
        let alone = BTreeMap::from([(self.0.name.clone(), self.0.clone())]);
        core::find(&alone, name).is_some()
    }

    /// Key of the material in its table.
    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    /// What the material is.
    #[getter]
    fn title(&self) -> &str {
        &self.0.title
    }

    /// Name, value and source of every number.
    fn numbers(&self) -> Vec<(&'static str, f64, String)> {
        let numbers = self.0.numbers.iter();
        numbers
            .map(|(name, of)| (*name, of.value, of.source.clone()))
            .collect()
    }

    /// A number of the material by its key.
    fn number(&self, name: &str) -> PyResult<f64> {
        self.0.number(name).map_err(refused)
    }

    /// Numbers that look like those of another unit, in words.
    fn doubts(&self) -> Vec<String> {
        self.0.doubts()
    }

    /// The criterion of that name with the limit or life curve of the material.
    fn assessment(&self, criterion: &str) -> PyResult<Assessment> {
        let found = core::Assessment::of(criterion, &self.0).map_err(refused)?;
        Ok(Assessment(found))
    }

    fn __repr__(&self) -> String {
        format!("Material({:?}, {:?})", self.0.name, self.0.title)
    }
}

/// The materials that come with the package, or those of a file.
#[pyfunction]
#[pyo3(signature = (file = None))]
pub(crate) fn materials(file: Option<PathBuf>) -> PyResult<Vec<Material>> {
    let found = match file {
        None => core::materials(),
        Some(file) => {
            let (text, name) = text_of(&file).map_err(to_python)?;
            core::read(&text, &name).map_err(refused)?
        }
    };
    Ok(found.into_values().map(Material).collect())
}

/// How a number of a material is known, by its source: "known", "estimate" or "recalled".
#[pyfunction]
#[pyo3(signature = (source) -> "Literal['known', 'estimate', 'recalled']")]
pub(crate) fn known_as(source: &str) -> &'static str {
    core::Known::of(source).name()
}

/// Names of the criteria, and how they are written in figures.
#[pyfunction]
pub(crate) fn criteria() -> Vec<(&'static str, &'static str)> {
    core::CRITERIA.iter().map(|d| (d.name, d.title)).collect()
}

/// Names, units and meanings of the numbers of materials.
#[pyfunction]
pub(crate) fn material_quantities() -> Vec<(&'static str, &'static str, &'static str)> {
    let label = |q: &core::Quantity| (q.name, q.unit, q.long_name);
    core::QUANTITIES.iter().map(label).collect()
}

/// A criterion on stresses of shape (time, points, 6): arrays over the points.
///
/// `plastic_strain` has that shape; without it the points stay elastic.
#[pyfunction]
#[pyo3(signature = (criterion, stress, plastic_strain = None, *, tolerance: "float") -> "dict[str, NDArray[np.float64]]")]
pub(crate) fn criterion_on<'py>(
    py: Python<'py>,
    criterion: Criterion,
    stress: Array<'py, Ix3>,
    plastic_strain: Option<Array<'py, Ix3>>,
    #[pyo3(from_py_with = number)] tolerance: f64,
) -> PyResult<Bound<'py, PyDict>> {
    let stop = Arc::default();
    let history = core::History {
        stress: stress.as_array(),
        plastic: plastic_strain.as_ref().map(|strain| strain.as_array()),
    };
    let search = core::Search {
        tolerance,
        ..core::Search::default()
    };
    let work = || core::evaluate(&criterion.0, &history, &search, &stop);
    let points = interruptible(py, &stop, work)?.map_err(refused)?;
    let of = |f: Number| {
        let values: Array1<f64> = points.iter().map(f).collect();
        values.into_pyarray(py)
    };
    let found = PyDict::new(py);
    for (name, number) in AT_POINT {
        found.set_item(name, of(number))?;
    }
    let normal = Array2::from_shape_fn((points.len(), 3), |(n, d)| points[n].normal[d]);
    found.set_item("normal", normal.into_pyarray(py))?;
    Ok(found)
}

/// Load factors of first yield and shakedown of stresses of shape (time, points, 6).
#[pyfunction]
#[pyo3(signature = (stress, *, s_y: "Quantity", constant: "tuple[float, float, float, float, float, float]") -> "dict[str, NDArray[np.float64]]")]
pub(crate) fn yielding_on<'py>(
    py: Python<'py>,
    stress: Array<'py, Ix3>,
    #[pyo3(from_py_with = Given::s_y)] s_y: f64,
    #[pyo3(from_py_with = number)] constant: [f64; 6],
) -> PyResult<Bound<'py, PyDict>> {
    let (view, stop) = (stress.as_array(), Arc::default());
    let work = || core::yielding(&view, s_y, &constant, &stop);
    let points = interruptible(py, &stop, work)?.map_err(refused)?;
    let of = |f: &dyn Fn(&core::Yield) -> f64| {
        let values: Array1<f64> = points.iter().map(f).collect();
        values.into_pyarray(py)
    };
    let found = PyDict::new(py);
    found.set_item("von_mises", of(&|p| p.von_mises))?;
    found.set_item("tresca", of(&|p| p.tresca))?;
    found.set_item("shakedown", of(&|p| p.shakedown))?;
    let residual = Array2::from_shape_fn((points.len(), 6), |(n, c)| points[n].residual[c]);
    found.set_item("residual", residual.into_pyarray(py))?;
    Ok(found)
}

/// The path of one point in Dang Van's plane.
///
/// From its stress of shape (time, 6): tau and hydrostatic stress at every instant.
#[pyfunction]
#[pyo3(signature = (stress) -> "NDArray[np.float64]")]
pub(crate) fn dang_van_path<'py>(
    py: Python<'py>,
    stress: Array<'py, Ix2>,
) -> PyResult<Bound<'py, numpy::PyArray2<f64>>> {
    let stress = stress.as_array();
    if stress.ncols() != 6 {
        let allowed = "6 long: xx, yy, zz, xy, xz, yz";
        let found = stress.ncols();
        let message = format!("last axis of stress = {found}: must be {allowed}");
        return Err(PyValueError::new_err(message));
    }
    let rows = stress.rows().into_iter();
    let stress: Vec<_> = rows.map(|s| std::array::from_fn(|c| s[c])).collect();
    let path = core::dang_van_path(&stress);
    let path = Array2::from_shape_fn(
        (path.len(), 2),
        |(t, k)| {
            if k == 0 { path[t].0 } else { path[t].1 }
        },
    );
    Ok(path.into_pyarray(py))
}
