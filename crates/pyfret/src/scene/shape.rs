//! Shapes of the undeformed surfaces.

use contact_core::scene as core;
use pyo3::prelude::*;

/// The contact plane itself.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Flat;

#[pymethods]
impl Flat {
    #[new]
    fn new() -> Self {
        Self
    }

    #[expect(clippy::unused_self, reason = "Python passes it")]
    fn __repr__(&self) -> &'static str {
        "Flat()"
    }
}

/// A sphere, taken as a paraboloid.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Sphere {
    #[pyo3(get)]
    R: f64,
}

#[pymethods]
impl Sphere {
    #[new]
    #[pyo3(signature = (*, R))]
    fn new(R: f64) -> Self {
        Self { R }
    }

    fn __repr__(&self) -> String {
        format!("Sphere(R={:?})", self.R)
    }
}

/// Any shape, on its way in or out.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum Shape {
    Flat(Flat),
    Sphere(Sphere),
}

impl Shape {
    pub(crate) fn repr(&self) -> String {
        match self {
            Self::Flat(flat) => flat.__repr__().into(),
            Self::Sphere(sphere) => sphere.__repr__(),
        }
    }
}

impl From<Shape> for core::Shape {
    fn from(shape: Shape) -> Self {
        match shape {
            Shape::Flat(_) => Self::Flat,
            Shape::Sphere(Sphere { R }) => Self::Sphere { R },
        }
    }
}

impl From<&core::Shape> for Shape {
    fn from(shape: &core::Shape) -> Self {
        match *shape {
            core::Shape::Flat => Self::Flat(Flat),
            core::Shape::Sphere { R } => Self::Sphere(Sphere { R }),
        }
    }
}
