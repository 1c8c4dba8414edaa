//! Bodies and their coatings.

use contact_core::scene as core;
use pyo3::prelude::*;

use super::material::Elastic;
use super::shape::{Flat, Shape};
use crate::error::{must_be, takes, to_python};

/// A layer of constant thickness, perfectly bonded to what is below it.
///
/// Parameters
/// ----------
/// material : Elastic
///     Material of the layer.
/// thickness : float
///     Thickness [m], positive.
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Coating(pub(crate) core::Coating);

takes!(
    Coating,
    "a coating, such as Coating(Elastic(E=300e9, nu=0.25), thickness=3e-6)"
);

#[pymethods]
impl Coating {
    #[new]
    #[pyo3(signature = (material, *, thickness))]
    fn new(material: Elastic, thickness: f64) -> PyResult<Self> {
        let coating = core::Coating {
            material: material.0,
            thickness,
        };
        coating.check("coating").map_err(to_python)?;
        Ok(Self(coating))
    }

    /// Material of the layer.
    #[getter]
    fn material(&self) -> Elastic {
        Elastic(self.0.material)
    }

    /// Thickness [m].
    #[getter]
    fn thickness(&self) -> f64 {
        self.0.thickness
    }

    fn __repr__(&self) -> String {
        format!(
            "Coating({}, thickness={:?})",
            self.material().__repr__(),
            self.0.thickness
        )
    }
}

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

takes!(
    Body,
    "a body, such as Body(Elastic(E=210e9, nu=0.3), shape=Sphere(R=5e-3))"
);

#[pymethods]
impl Body {
    #[new]
    #[pyo3(signature = (substrate, *, coatings = Coatings(Vec::new()), shape = Shape::Flat(Flat)))]
    fn new(substrate: Elastic, coatings: Coatings, shape: Shape) -> Self {
        Self(core::Body {
            substrate: substrate.0,
            coatings: coatings.0,
            shape: shape.into(),
        })
    }

    /// Material below the coatings.
    #[getter]
    fn substrate(&self) -> Elastic {
        Elastic(self.0.substrate)
    }

    /// Layers from the surface down.
    #[getter]
    fn coatings(&self) -> Vec<Coating> {
        self.0.coatings.iter().copied().map(Coating).collect()
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
struct Coatings(Vec<core::Coating>);

impl<'py> FromPyObject<'_, 'py> for Coatings {
    type Error = PyErr;

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        if let Ok(one) = value.extract::<Coating>() {
            return Ok(Self(vec![one.0]));
        }
        let layers = value.try_iter().map_err(|_| {
            must_be(
                &value,
                "a list of coatings, the outermost first, such as [Coating(..)]",
            )
        })?;
        let layer = |layer: PyResult<Bound<'_, PyAny>>| layer?.extract::<Coating>();
        Ok(Self(
            layers
                .map(|l| layer(l).map(|c| c.0))
                .collect::<PyResult<_>>()?,
        ))
    }
}
