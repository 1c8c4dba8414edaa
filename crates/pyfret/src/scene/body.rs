//! Bodies and their coatings.

use contact_core::scene as core;
use pyo3::prelude::*;

use super::material::Elastic;
use super::shape::{Flat, Shape};

/// A layer of constant thickness, perfectly bonded to what is below it.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Coating(pub(crate) core::Coating);

#[pymethods]
impl Coating {
    #[new]
    #[pyo3(signature = (material, *, thickness))]
    fn new(material: Elastic, thickness: f64) -> Self {
        Self(core::Coating {
            material: material.0,
            thickness,
        })
    }

    #[getter]
    fn material(&self) -> Elastic {
        Elastic(self.0.material)
    }

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
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Body(pub(crate) core::Body);

#[pymethods]
impl Body {
    #[new]
    #[pyo3(signature = (substrate, *, coatings = Vec::new(), shape = Shape::Flat(Flat)))]
    fn new(substrate: Elastic, coatings: Vec<Coating>, shape: Shape) -> Self {
        Self(core::Body {
            substrate: substrate.0,
            coatings: coatings.into_iter().map(|c| c.0).collect(),
            shape: shape.into(),
        })
    }

    #[getter]
    fn substrate(&self) -> Elastic {
        Elastic(self.0.substrate)
    }

    #[getter]
    fn coatings(&self) -> Vec<Coating> {
        self.0.coatings.iter().copied().map(Coating).collect()
    }

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
