//! Shapes of the undeformed surfaces.

use std::path::PathBuf;
use std::sync::Arc;

use contact_core::scene as core;
use numpy::{PyArray2, PyReadonlyArray2, ToPyArray};
use pyo3::prelude::*;

use crate::error::to_python;

/// A shape class with numbers for fields, and its way to and from the core's variant.
macro_rules! elementary {
    ($(#[$doc:meta])* $name:ident { $($field:ident),* }, ($($signature:tt)*)) => {
        $(#[$doc])*
        #[pyclass(frozen, eq, from_py_object, module = "pyfret")]
        #[derive(Clone, Copy, PartialEq)]
        pub(crate) struct $name {
            $(#[pyo3(get)] $field: f64,)*
        }

        #[pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = ($($signature)*))]
            fn new($($field: f64),*) -> Self {
                Self { $($field),* }
            }

            fn __add__(&self, other: Shape) -> Sum {
                Sum::of(Shape::$name(*self), other)
            }

            fn __repr__(&self) -> String {
                let fields: &[String] = &[$(format!(concat!(stringify!($field), "={:?}"), self.$field)),*];
                format!(concat!(stringify!($name), "({})"), fields.join(", "))
            }
        }

        impl From<$name> for core::Shape {
            fn from(shape: $name) -> Self {
                let $name { $($field),* } = shape;
                Self::$name { $($field),* }
            }
        }
    };
}

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
    fn __add__(&self, other: Shape) -> Sum {
        Sum::of(Shape::Flat(Self), other)
    }

    #[expect(clippy::unused_self, reason = "Python passes it")]
    fn __repr__(&self) -> &'static str {
        "Flat()"
    }
}

elementary!(
    /// A sphere, taken as a paraboloid.
    Sphere { R }, (*, R)
);
elementary!(
    /// Two principal radii.
    Ellipsoid { R_x, R_y, angle }, (*, R_x, R_y, angle = 0.0)
);
elementary!(
    /// A cylinder with sharp ends.
    Cylinder { R, length, angle }, (*, R, length = f64::INFINITY, angle = 0.0)
);
elementary!(
    /// A cylinder with rounded ends.
    CrownedRoller { R, length, crown, angle }, (*, R, length, crown, angle = 0.0)
);
elementary!(
    /// A cone.
    Cone { slope }, (*, slope)
);
elementary!(
    /// Two flanks that meet in an edge.
    Wedge { slope, angle }, (*, slope, angle = 0.0)
);
elementary!(
    /// A round flat punch with a rounded edge.
    FlatPunch { radius, edge }, (*, radius, edge)
);
elementary!(
    /// A wave.
    Waviness { amplitude, wavelength, angle, phase },
    (*, amplitude, wavelength, angle = 0.0, phase = 0.0)
);

/// A random self-affine surface.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Rough(core::Rough);

#[pymethods]
impl Rough {
    #[new]
    #[pyo3(signature = (*, rms, hurst, longest, shortest, seed = 0))]
    fn new(rms: f64, hurst: f64, longest: f64, shortest: f64, seed: u32) -> Self {
        Self(core::Rough {
            rms,
            hurst,
            longest,
            shortest,
            seed,
        })
    }

    #[getter]
    fn rms(&self) -> f64 {
        self.0.rms
    }

    #[getter]
    fn hurst(&self) -> f64 {
        self.0.hurst
    }

    #[getter]
    fn longest(&self) -> f64 {
        self.0.longest
    }

    #[getter]
    fn shortest(&self) -> f64 {
        self.0.shortest
    }

    #[getter]
    fn seed(&self) -> u32 {
        self.0.seed
    }

    fn __add__(&self, other: Shape) -> Sum {
        Sum::of(Shape::Rough(*self), other)
    }

    fn __repr__(&self) -> String {
        let core::Rough {
            rms,
            hurst,
            longest,
            shortest,
            seed,
        } = self.0;
        format!(
            "Rough(rms={rms:?}, hurst={hurst:?}, longest={longest:?}, shortest={shortest:?}, seed={seed})"
        )
    }
}

/// Numbers over the contact plane; as a shape, heights.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct SurfaceMap(pub(crate) core::SurfaceMap);

#[pymethods]
impl SurfaceMap {
    #[new]
    #[pyo3(signature = (values, *, spacing))]
    fn new(values: PyReadonlyArray2<'_, f64>, spacing: (f64, f64)) -> Self {
        Self(core::SurfaceMap {
            values: Arc::new(values.as_array().to_owned()),
            spacing,
        })
    }

    #[staticmethod]
    #[pyo3(signature = (path, *, spacing))]
    fn from_file(path: PathBuf, spacing: (f64, f64)) -> PyResult<Self> {
        core::SurfaceMap::from_file(&path, spacing)
            .map(Self)
            .map_err(to_python)
    }

    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.0.values.to_pyarray(py)
    }

    #[getter]
    fn spacing(&self) -> (f64, f64) {
        self.0.spacing
    }

    fn __add__(&self, other: Shape) -> Sum {
        Sum::of(Shape::HeightMap(self.clone()), other)
    }

    fn __repr__(&self) -> String {
        let (nx, ny) = self.0.values.dim();
        format!(
            "SurfaceMap({nx} x {ny} numbers, spacing={:?})",
            self.0.spacing
        )
    }
}

/// Several shapes on top of one another.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Sum(Vec<core::Shape>);

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
    #[getter]
    fn parts(&self) -> Vec<Shape> {
        self.0.iter().map(Shape::from).collect()
    }

    fn __add__(&self, other: Shape) -> Self {
        Self::of(Shape::Sum(self.clone()), other)
    }

    fn __repr__(&self) -> String {
        let parts: Vec<_> = self.0.iter().map(|part| Shape::from(part).repr()).collect();
        parts.join(" + ")
    }
}

/// Any shape, on its way in or out.
#[derive(FromPyObject, IntoPyObject)]
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
