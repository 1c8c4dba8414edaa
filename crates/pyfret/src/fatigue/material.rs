//! Materials and their numbers.

use contact_core::scene::read_text;
use fatigue as core;

use crate::error::Answer;
use crate::prelude::*;

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
/// kind : str
///     What it is: steel, metal, ceramic, coating or polymer (default: nothing).
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
    #[pyo3(signature = (name, numbers: "Sequence[tuple[str, float, str]]", title = None, also: "Sequence[str]" = List::default(), kind = ""))]
    fn new(
        name: &str,
        numbers: List<(String, f64, String)>,
        title: Option<&str>,
        also: List<String>,
        kind: &str,
    ) -> Answer<Self> {
        let made = core::Material::new(name, title.unwrap_or(name), numbers);
        let mut made = made?;
        made.also = also.0;
        kind.clone_into(&mut made.kind);
        Ok(Self(made))
    }

    #[expect(clippy::type_complexity, reason = "the arguments of the constructor")]
    fn __getnewargs__(
        &self,
    ) -> (
        &str,
        Vec<(&'static str, f64, String)>,
        &str,
        Vec<String>,
        &str,
    ) {
        (
            self.name(),
            self.numbers(),
            self.title(),
            self.also(),
            self.kind(),
        )
    }

    /// Critical distance L = (dK_th/(2 s_D))^2/pi [m].
    ///
    /// ``dK_th`` is the threshold range of the stress intensity, and 2 ``s_D`` the range of the
    /// fatigue limit. Both are fully reversed. Source: D. Taylor, The Theory of Critical Distances,
    /// Elsevier (2007). A ValueError names the number that is missing.
    fn critical_distance(&self) -> Answer<f64> {
        Ok(self.0.critical_distance()?)
    }

    /// The material with the missing numbers that published rules can estimate.
    fn estimated(&self, family: &str) -> Answer<Self> {
        let family = core::Family::named(family)?;
        Ok(Self(core::estimated(&self.0, family)))
    }

    /// Numbers that are estimates or from memory, in words; None where each has a source.
    #[pyo3(signature = (names: "Sequence[str]"))]
    fn estimate_of(&self, names: List<String>) -> Option<String> {
        let names: Vec<&str> = names.0.iter().map(String::as_str).collect();
        self.0.estimate_of(&names)
    }

    /// Name, value and source of every number.
    fn numbers(&self) -> Vec<(&'static str, f64, String)> {
        let numbers = self.0.numbers.iter();
        numbers
            .map(|(name, of)| (*name, of.value, of.source.clone()))
            .collect()
    }

    /// A number of the material by its key.
    fn number(&self, name: &str) -> Answer<f64> {
        Ok(self.0.number(name)?)
    }

    /// Numbers that look like numbers in another unit, in words.
    fn doubts(&self) -> Vec<String> {
        self.0.doubts()
    }

    fn __repr__(&self) -> String {
        let s_y = self.0.numbers.get("s_y").map_or_else(String::new, |of| {
            format!(", s_y = {:.4} MPa, {:?}", 1e-6 * of.value, of.source)
        });
        format!("Material({:?}, {:?}{s_y})", self.0.name, self.0.title)
    }
}

attributes!(Material, self:
    /// Other names that it is found by.
    also: Vec<String> = self.0.also.clone();
    /// Kind: steel, metal, ceramic, coating or polymer; empty where nothing is given.
    kind: &str = &self.0.kind;
    /// Key of the material in its table.
    name: &str = &self.0.name;
    /// Description of the material.
    title: &str = &self.0.title;
);

/// The materials that come with the package, or the materials of a file.
#[pyfunction]
#[pyo3(signature = (file = None))]
pub(crate) fn materials(file: Option<PathBuf>) -> Answer<Vec<Material>> {
    let materials = match file {
        None => core::materials(),
        Some(file) => {
            let (text, name) = read_text(&file)?;
            core::read(&text, &name)?
        }
    };
    Ok(materials.into_values().map(Material).collect())
}

/// The material of a name among some: of its key, or of another name, whatever the case.
///
/// The case counts in a formula, and in a name that differs from one in its case alone.
#[pyfunction]
#[pyo3(signature = (name, materials: "Sequence[Material]"))]
pub(crate) fn find_material(name: &str, materials: List<Material>) -> Option<Material> {
    let table = materials.into_iter().map(|of| (of.0.name.clone(), of.0));
    core::find(&table.collect(), name).cloned().map(Material)
}

/// Names of the materials nearest to an unknown name and of its kind, the nearest first.
#[pyfunction]
#[pyo3(signature = (name, materials: "Sequence[Material]", most: "int" = 3))]
pub(crate) fn nearest_materials(name: &str, materials: List<Material>, most: usize) -> Vec<String> {
    let table = materials.into_iter().map(|of| (of.0.name.clone(), of.0));
    core::nearest(&table.collect(), name, most)
}

/// How a number of a material is known, by its source: "known", "estimate" or "recalled".
#[pyfunction]
#[pyo3(signature = (source) -> "Literal['known', 'estimate', 'recalled']")]
pub(crate) fn known_as(source: &str) -> &'static str {
    core::Known::of(source).name()
}

/// Names, units and meanings of the numbers of materials.
#[pyfunction]
pub(crate) fn material_quantities() -> Vec<(&'static str, &'static str, &'static str)> {
    let label = |q: &core::Quantity| (q.name, q.unit, q.long_name);
    core::QUANTITIES.iter().map(label).collect()
}
