//! Any shape, and several on top of one another: a sum is made of shapes, and is one.

use contact_core::scene as core;
use pyo3::inspect::PyStaticExpr;
use pyo3::prelude::*;
use pyo3::{PyTypeInfo, type_hint_union};

use super::edged::{Cone, FlatPunch, Wedge};
use super::flat::Flat;
use super::map::SurfaceMap;
use super::rough::Rough;
use super::round::{CrownedRoller, Cylinder, Ellipsoid, Sphere};
use super::waviness::Waviness;
use crate::arguments::List;
use crate::error::must_be;
use crate::parts::parts;

/// Several shapes on top of one another, made by adding them.
#[pyclass(frozen, eq, from_py_object, module = "pyfret.shapes")]
#[derive(Clone, PartialEq)]
pub(crate) struct Sum(Vec<core::Shape>);

parts!(Sum: parts);

impl Sum {
    fn of(one: Shape, other: Shape) -> Self {
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
    #[pyo3(signature = (parts: "Sequence[Flat | Sphere | Ellipsoid | Cylinder | CrownedRoller | Cone | Wedge | FlatPunch | Waviness | Rough | SurfaceMap | Sum]"))]
    fn new(parts: List<Shape>) -> Self {
        Self(parts.into_iter().map(core::Shape::from).collect())
    }

    /// The shapes.
    #[getter]
    fn parts(&self) -> Vec<Shape> {
        self.0.iter().map(Shape::from).collect()
    }

    fn __repr__(&self) -> String {
        let parts: Vec<_> = self.0.iter().map(|part| Shape::from(part).repr()).collect();
        parts.join(" + ")
    }
}

/// `+` of each class: it lies on top of another shape.
macro_rules! adds {
    ($($variant:ident: $class:ty),*) => {
        $(#[pymethods]
        impl $class {
            fn __add__(&self, other: Shape) -> Sum {
                Sum::of(Shape::$variant(self.clone()), other)
            }
        })*
    };
}
adds!(
    Flat: Flat, Sphere: Sphere, Ellipsoid: Ellipsoid, Cylinder: Cylinder,
    CrownedRoller: CrownedRoller, Cone: Cone, Wedge: Wedge, FlatPunch: FlatPunch,
    Waviness: Waviness, HeightMap: SurfaceMap, Rough: Rough, Sum: Sum
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
    Waviness(Waviness),
    HeightMap(SurfaceMap),
    Rough(Rough),
    Sum(Sum),
}

impl<'py> FromPyObject<'_, 'py> for Shape {
    type Error = PyErr;

    const INPUT_TYPE: PyStaticExpr = type_hint_union!(
        Flat::TYPE_HINT,
        Sphere::TYPE_HINT,
        Ellipsoid::TYPE_HINT,
        Cylinder::TYPE_HINT,
        CrownedRoller::TYPE_HINT,
        Cone::TYPE_HINT,
        Wedge::TYPE_HINT,
        FlatPunch::TYPE_HINT,
        Waviness::TYPE_HINT,
        Rough::TYPE_HINT,
        SurfaceMap::TYPE_HINT,
        Sum::TYPE_HINT
    );

    fn extract(value: Borrowed<'_, 'py, PyAny>) -> PyResult<Self> {
        macro_rules! first_of {
            ($($variant:ident: $class:ty),*) => {
                $(if let Ok(shape) = value.extract::<$class>() {
                    return Ok(Self::$variant(shape));
                })*
            };
        }
        first_of!(
            Flat: Flat, Sphere: Sphere, Ellipsoid: Ellipsoid, Cylinder: Cylinder,
            CrownedRoller: CrownedRoller, Cone: Cone, Wedge: Wedge, FlatPunch: FlatPunch,
            Waviness: Waviness, HeightMap: SurfaceMap, Rough: Rough, Sum: Sum
        );
        Err(must_be(
            &value,
            "a shape, such as Sphere(R=5e-3), Flat(), Cylinder(R=5e-3), SurfaceMap(heights, spacing=1e-6), \
             or a sum of them",
        ))
    }
}

impl Shape {
    pub(crate) fn repr(&self) -> String {
        match self {
            Self::Flat(s) => s.__repr__().into(),
            Self::Sphere(s) => s.__repr__(),
            Self::Ellipsoid(s) => s.__repr__(),
            Self::Cylinder(s) => s.__repr__(),
            Self::CrownedRoller(s) => s.__repr__(),
            Self::Cone(s) => s.__repr__(),
            Self::Wedge(s) => s.__repr__(),
            Self::FlatPunch(s) => s.__repr__(),
            Self::Waviness(s) => s.__repr__(),
            Self::HeightMap(s) => s.__repr__(),
            Self::Rough(s) => s.__repr__(),
            Self::Sum(s) => s.__repr__(),
        }
    }
}

impl From<Shape> for core::Shape {
    fn from(shape: Shape) -> Self {
        match shape {
            Shape::Flat(_) => Self::Flat,
            Shape::Sphere(s) => s.into(),
            Shape::Ellipsoid(s) => s.into(),
            Shape::Cylinder(s) => s.into(),
            Shape::CrownedRoller(s) => s.into(),
            Shape::Cone(s) => s.into(),
            Shape::Wedge(s) => s.into(),
            Shape::FlatPunch(s) => s.into(),
            Shape::Waviness(s) => s.into(),
            Shape::HeightMap(s) => Self::HeightMap(s.0),
            Shape::Rough(s) => Self::Rough(s.0),
            Shape::Sum(s) => Self::Sum(s.0),
        }
    }
}

impl From<&core::Shape> for Shape {
    fn from(shape: &core::Shape) -> Self {
        match shape.clone() {
            core::Shape::Flat => Self::Flat(Flat),
            core::Shape::Sphere { R } => Self::Sphere(Sphere { R }),
            core::Shape::Ellipsoid { R_x, R_y, angle } => {
                Self::Ellipsoid(Ellipsoid { R_x, R_y, angle })
            }
            core::Shape::Cylinder { R, length, angle } => {
                Self::Cylinder(Cylinder { R, length, angle })
            }
            core::Shape::CrownedRoller {
                R,
                length,
                crown,
                angle,
            } => Self::CrownedRoller(CrownedRoller {
                R,
                length,
                crown,
                angle,
            }),
            core::Shape::Cone { slope } => Self::Cone(Cone { slope }),
            core::Shape::Wedge { slope, angle } => Self::Wedge(Wedge { slope, angle }),
            core::Shape::FlatPunch { radius, edge } => Self::FlatPunch(FlatPunch { radius, edge }),
            core::Shape::Waviness {
                amplitude,
                wavelength,
                angle,
                phase,
            } => Self::Waviness(Waviness {
                amplitude,
                wavelength,
                angle,
                phase,
            }),
            core::Shape::HeightMap(map) => Self::HeightMap(SurfaceMap(map)),
            core::Shape::Rough(rough) => Self::Rough(Rough(rough)),
            core::Shape::Sum(parts) => Self::Sum(Sum(parts)),
        }
    }
}
