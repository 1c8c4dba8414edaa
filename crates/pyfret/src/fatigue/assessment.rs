//! A criterion with its limit or its lives.

use fatigue as core;

use super::{Criterion, Material};
use crate::error::Answer;
use crate::prelude::*;

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
    ) -> Answer<Self> {
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
                curve.check()?;
                core::Judge::Life(curve)
            }
            _ => {
                refuse!("give a limit, a positive number in the unit of the criterion, or a curve");
            }
        };
        Ok(Self(core::Assessment {
            criterion: criterion.0,
            judge,
        }))
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

    /// Return the margins of a value with its error (low, best, high), and their 10 to 90 % range.
    ///
    /// The range has the scatter of the material; `scatter` replaces its default. The other parts
    /// are the ratio of this scatter, and notes.
    #[pyo3(signature = (value: "float", error: "float", material = None, *, scatter: "float | None" = None) -> "tuple[tuple[float, float, float], tuple[float, float, float], float, list[str]]")]
    #[expect(clippy::type_complexity, reason = "the parts of a range")]
    fn range_at(
        &self,
        #[pyo3(from_py_with = number)] value: f64,
        #[pyo3(from_py_with = number)] error: f64,
        material: Option<Material>,
        #[pyo3(from_py_with = number)] scatter: Option<f64>,
    ) -> Answer<((f64, f64, f64), (f64, f64, f64), f64, Vec<String>)> {
        let material = material.as_ref().map(|material| &material.0);
        let (factor, note) = self.0.scatter(material, scatter)?;
        let mean_stress_note = self.0.mean_stress_note(material);
        let number = self
            .0
            .life_range(self.0.margins(value, error), factor, None);
        let three = |of: core::Range| (of.low, of.best, of.high);
        Ok((
            three(number.stress),
            three(number.range),
            factor,
            mean_stress_note.into_iter().chain(note).collect(),
        ))
    }

    /// Note on a weight of the mean stress that is 0; None where mean stress counts.
    #[pyo3(signature = (material = None))]
    fn mean_stress_note(&self, material: Option<Material>) -> Option<String> {
        self.0.mean_stress_note(material.as_ref().map(|of| &of.0))
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

attributes!(Assessment, self:
    /// The criterion whose value is judged.
    criterion: Criterion = Criterion(self.0.criterion);
    /// The limit, or nothing where the criterion gives lives.
    limit: Option<f64> = match self.0.judge {
        core::Judge::Limit(limit) => Some(limit),
        core::Judge::Life(_) => None,
    };
);

#[pymethods]
impl Material {
    /// The criterion of that name with the limit or life curve of the material.
    fn assessment(&self, criterion: &str) -> Answer<Assessment> {
        let assessment = core::Assessment::from_name(criterion, &self.0)?;
        Ok(Assessment(assessment))
    }
}
