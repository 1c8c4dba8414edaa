//! Any shape, and several on top of one another: a sum is made of shapes, and is one.

use contact_core::scene as core;
use pyo3::{PyTypeInfo, type_hint_union};

use super::edged::{Cone, Flat, FlatPunch, Wedge};
use super::map::SurfaceMap;
use super::ridges::{Ridges, Ring};
use super::rough::Rough;
use super::round::{CrownedRoller, Cylinder, Ellipsoid, Sphere};
use super::waviness::Waviness;

use crate::prelude::*;

/// Several shapes on top of one another, made by adding them.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.shapes")]
#[derive(Clone, PartialEq)]
pub(crate) struct Sum(Vec<core::Shape>);

parts!(Sum: parts);

impl Sum {
    /// Joins the parts of two shapes to one sum.
    fn concat(one: Shape, other: Shape) -> Self {
        let parts = |shape| match core::Shape::from(shape) {
            core::Shape::Sum(parts) => parts,
            shape => vec![shape],
        };
        Self([parts(one), parts(other)].concat())
    }
}

#[pymethods]
impl Sum {
    #[new]
    #[pyo3(signature = (parts: "Sequence[Flat | Sphere | Ellipsoid | Cylinder | CrownedRoller | Cone | Wedge | FlatPunch | Ring | Ridges | Waviness | Rough | SurfaceMap | Sum]"))]
    fn new(parts: List<Shape>) -> Self {
        Self(parts.into_iter().map(core::Shape::from).collect())
    }

    fn __repr__(&self) -> String {
        let parts: Vec<_> = self.0.iter().map(|part| Shape::from(part).repr()).collect();
        parts.join(" + ")
    }
}

attributes!(Sum, self:
    /// The shapes.
    parts: Vec<Shape> = self.0.iter().map(Shape::from).collect();
);

/// `+` of each class: it lies on top of another shape.
macro_rules! adds {
    ($($class:ident)*) => {
        $(#[pymethods]
        impl $class {
            fn __add__(&self, other: Shape) -> Sum {
                Sum::concat(Shape::$class(self.clone()), other)
            }
        })*
    };
}
adds!(
    Flat Sphere Ellipsoid Cylinder CrownedRoller Cone Wedge FlatPunch Ring Ridges Waviness Rough SurfaceMap Sum
);

/// Any shape, on its way in or out.
#[derive(IntoPyObject)]
pub(crate) enum Shape {
    Flat(Flat),
    Sphere(Sphere),
    Ellipsoid(Ellipsoid),
    Cylinder(Cylinder),
    CrownedRoller(CrownedRoller),
    Cone(Cone),
    Wedge(Wedge),
    FlatPunch(FlatPunch),
    Ring(Ring),
    Ridges(Ridges),
    Waviness(Waviness),
    SurfaceMap(SurfaceMap),
    Rough(Rough),
    Sum(Sum),
}

/// The ways in and out, from each class with its fields and each class with the core's variant.
macro_rules! shapes {
    ($($name:ident { $($field:ident),* })*; $($class:ident($variant:ident))*) => {
        impl Shape {
            /// The shape of an object of one of these classes; none for others.
            fn found(value: &Bound<'_, PyAny>) -> Option<Self> {
                $(if let Ok(shape) = value.extract() {
                    return Some(Self::$name(shape));
                })*
                $(if let Ok(shape) = value.extract() {
                    return Some(Self::$class(shape));
                })*
                None
            }

            const HINT: PyStaticExpr =
                type_hint_union!($($name::TYPE_HINT,)* $($class::TYPE_HINT),*);

            /// The text of an expression that makes it.
            pub(crate) fn repr(&self) -> String {
                match self {
                    $(Self::$name(shape) => shape.__repr__(),)*
                    $(Self::$class(shape) => shape.__repr__(),)*
                }
            }
        }

        impl From<Shape> for core::Shape {
            fn from(shape: Shape) -> Self {
                match shape {
                    $(Shape::$name(shape) => shape.into(),)*
                    $(Shape::$class(shape) => Self::$variant(shape.0),)*
                }
            }
        }

        impl From<&core::Shape> for Shape {
            fn from(shape: &core::Shape) -> Self {
                match shape.clone() {
                    $(core::Shape::$name { $($field),* } => Self::$name($name { $($field),* }),)*
                    $(core::Shape::$variant(of) => Self::$class($class(of)),)*
                }
            }
        }
    };
}

shapes!(
    Flat {} Sphere { R } Ellipsoid { R_x, R_y, angle } Cylinder { R, length, angle }
    CrownedRoller { R, length, crown, angle } Cone { slope } Wedge { slope, angle }
    FlatPunch { radius, edge } Ring { radius, R } Ridges { R, spacing, count, angle } Waviness { amplitude, wavelength, angle, phase };
    Rough(Rough) SurfaceMap(HeightMap) Sum(Sum)
);

impl<'py> FromPyObject<'_, 'py> for Shape {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = Self::HINT;

    /// Takes an object of a class of shapes.
    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        Self::found(&value).ok_or_else(|| {
            must_be(
                &value,
                "a shape, such as Sphere(R=5e-3), Flat(), Cylinder(R=5e-3), SurfaceMap(heights, spacing=1e-6), \
                 or a sum of them",
            )
        })
    }
}
