//! Bodies.

use crate::hints::sequence_of;
use contact_core::scene as core;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use pyo3::{PyTypeInfo, type_hint_union};

use super::shape::{Flat, Shape};
use crate::error::{must_be, takes};
use crate::material::{Coating, Elastic};
use crate::parts::parts;
use crate::quantity::known;

/// An elastic half-space under its coatings and a gently curved surface.
///
/// Parameters
/// ----------
/// substrate : Elastic
///     Material below the coatings.
/// coatings : sequence of Coating
///     Layers from the surface down: ``coatings[0]`` is the outermost (default: none).
/// shape : Flat, Sphere, Ellipsoid, Cylinder, ... or a sum of them
///     Undeformed surface (default: flat).
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Body(pub(crate) core::Body);

parts!(Body: substrate, coatings, shape);
takes!(
    Body,
    "a body, such as Body(Elastic(E=210e9, nu=0.3), shape=Sphere(R=5e-3))"
);

#[pymethods]
impl Body {
    #[new]
    #[pyo3(
        signature = (substrate, *, coatings = Coatings(Vec::new()), shape = Shape::Flat(Flat), **unknown),
        text_signature = "(substrate, *, coatings=..., shape=...)"
    )]
    fn new(
        substrate: Elastic,
        coatings: Coatings,
        shape: Shape,
        unknown: Option<&Bound<'_, PyDict>>,
    ) -> PyResult<Self> {
        known("Body", unknown, &["substrate", "coatings", "shape"])?;
        Ok(Self(core::Body {
            substrate: substrate.0,
            bonds: coatings.bonds(),
            plastic: coatings.plastic(substrate),
            coatings: coatings.0.into_iter().map(|c| c.0).collect(),
            shape: shape.into(),
        }))
    }

    /// Material below the coatings.
    #[getter]
    fn substrate(&self) -> Elastic {
        Elastic(self.0.substrate, self.0.plastic(self.0.coatings.len()))
    }

    /// Whether a layer of it may yield.
    #[getter]
    fn yields(&self) -> bool {
        self.0.yields()
    }

    /// Layers from the surface down.
    #[getter]
    fn coatings(&self) -> Vec<Coating> {
        let layers = self.0.coatings.iter().enumerate();
        layers
            .map(|(n, c)| Coating(*c, self.0.bond(n), self.0.plastic(n)))
            .collect()
    }

    /// Undeformed surface.
    #[getter]
    fn shape(&self) -> Shape {
        (&self.0.shape).into()
    }

    pub(crate) fn __repr__(&self) -> String {
        let mut parts = vec![self.substrate().__repr__()];
        if !self.0.coatings.is_empty() {
            let layers: Vec<_> = self.coatings().iter().map(Coating::__repr__).collect();
            parts.push(format!("coatings=[{}]", layers.join(", ")));
        }
        if self.0.shape != core::Shape::Flat {
            parts.push(format!("shape={}", self.shape().repr()));
        }
        format!("Body({})", parts.join(", "))
    }
}

/// Layers from the surface down, or a single one.
struct Coatings(Vec<Coating>);

impl Coatings {
    /// How the layers yield, the substrate last; none where all stay elastic.
    fn plastic(&self, substrate: Elastic) -> Vec<Option<core::Plastic>> {
        let laws = self.0.iter().map(|c| c.2).chain([substrate.1]);
        if laws.clone().all(|law| law.is_none()) {
            return Vec::new();
        }
        laws.collect()
    }

    /// Their bonds; none where all are perfect.
    fn bonds(&self) -> Vec<core::Bond> {
        let bonds = self.0.iter().map(|c| c.1);
        if bonds.clone().all(|bond| bond == core::Bond::PERFECT) {
            return Vec::new();
        }
        bonds.collect()
    }
}

impl<'py> FromPyObject<'_, 'py> for Coatings {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr =
        type_hint_union!(Coating::TYPE_HINT, sequence_of!(Coating::TYPE_HINT));

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(one) = value.extract::<Coating>() {
            return Ok(Self(vec![one]));
        }
        let layers = value.try_iter().map_err(|_| {
            must_be(
                &value,
                "a list of coatings, the outermost first, such as [Coating(..)]",
            )
        })?;
        let layer = |layer: PyResult<Bound<'_, PyAny>>| layer?.extract::<Coating>();
        Ok(Self(layers.map(layer).collect::<PyResult<_>>()?))
    }
}
