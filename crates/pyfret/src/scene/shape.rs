//! Shapes of the undeformed surfaces.

use std::path::PathBuf;

use contact_core::Error;
use contact_core::scene as core;
use numpy::{PyArray2, ToPyArray};
use pyo3::prelude::*;

use super::Pitch;
use crate::arguments::Field;
use crate::error::{must_be, to_python};
use crate::parts::parts;

/// A shape class with numbers for fields, and its way to and from the core's variant.
macro_rules! elementary {
    ($(#[$doc:meta])* $name:ident { $($(#[$about:meta])* $field:ident),* }, ($($signature:tt)*)) => {
        $(#[$doc])*
        #[pyclass(frozen, eq, from_py_object, module = "pyfret")]
        #[derive(Clone, Copy, PartialEq)]
        pub(crate) struct $name {
            $($(#[$about])* #[pyo3(get)] $field: f64,)*
        }

        #[pymethods]
        impl $name {
            #[new]
            #[pyo3(signature = ($($signature)*))]
            fn new($($field: f64),*) -> PyResult<Self> {
                let shape = Self { $($field),* };
                core::Shape::from(shape).check("shape").map_err(to_python)?;
                Ok(shape)
            }

            fn __add__(&self, other: Shape) -> Sum {
                Sum::of(Shape::$name(*self), other)
            }

            fn __repr__(&self) -> String {
                let fields: &[String] = &[$(format!(concat!(stringify!($field), "={:?}"), self.$field)),*];
                format!(concat!(stringify!($name), "({})"), fields.join(", "))
            }
        }

        parts!($name: $($field),*);

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

parts!(Flat:);

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
    /// A sphere, taken as the paraboloid r^2/(2 R) as in Hertz's theory.
    ///
    /// Parameters
    /// ----------
    /// R : float
    ///     Radius [m]; negative for a hollow.
    Sphere {
        /// Radius [m].
        R
    },
    (R)
);
elementary!(
    /// Two principal radii, each a parabola as in Hertz's theory.
    ///
    /// Parameters
    /// ----------
    /// R_x : float
    ///     Principal radius in the direction `angle` [m]; negative for a hollow.
    /// R_y : float
    ///     Principal radius across it [m].
    /// angle : float
    ///     Direction of the first one, from x towards y [rad].
    Ellipsoid {
        /// Principal radius in the direction `angle` [m]; negative for a hollow.
        R_x,
        /// Principal radius across it [m].
        R_y,
        /// Direction of the first one, from x towards y [rad].
        angle
    },
    (*, R_x, R_y, angle = 0.0)
);
elementary!(
    /// A cylinder with sharp ends; its axis is y turned by `angle`.
    ///
    /// Parameters
    /// ----------
    /// R : float
    ///     Radius [m]; negative for a hollow.
    /// length : float
    ///     Length along the axis [m]; infinite for one that leaves the grid.
    /// angle : float
    ///     Turn of the axis from y [rad].
    Cylinder {
        /// Radius [m]; negative for a hollow.
        R,
        /// Length along the axis [m]; infinite for one that leaves the grid.
        length,
        /// Turn of the axis from y [rad].
        angle
    },
    (*, R, length = f64::INFINITY, angle = 0.0)
);
elementary!(
    /// A cylinder with rounded ends; its axis is y turned by `angle`.
    ///
    /// Parameters
    /// ----------
    /// R : float
    ///     Radius [m].
    /// length : float
    ///     Length of the straight part [m], 0 for a crown all along.
    /// crown : float
    ///     Radius along the axis beyond the straight part [m].
    /// angle : float
    ///     Turn of the axis from y [rad].
    CrownedRoller {
        /// Radius [m].
        R,
        /// Length of the straight part [m], 0 for a crown all along.
        length,
        /// Radius along the axis beyond the straight part [m].
        crown,
        /// Turn of the axis from y [rad].
        angle
    },
    (*, R, length, crown, angle = 0.0)
);
elementary!(
    /// A cone with its tip at the origin.
    ///
    /// Parameters
    /// ----------
    /// slope : float
    ///     Tangent of the angle between flank and contact plane.
    Cone {
        /// Tangent of the angle between flank and contact plane.
        slope
    },
    (*, slope)
);
elementary!(
    /// Two flanks that meet in an edge; it is y turned by `angle`.
    ///
    /// Parameters
    /// ----------
    /// slope : float
    ///     Tangent of the angle between flank and contact plane.
    /// angle : float
    ///     Turn of the edge from y [rad].
    Wedge {
        /// Tangent of the angle between flank and contact plane.
        slope,
        /// Turn of the edge from y [rad].
        angle
    },
    (*, slope, angle = 0.0)
);
elementary!(
    /// A round flat punch with a rounded edge.
    ///
    /// Parameters
    /// ----------
    /// radius : float
    ///     Radius of the flat [m].
    /// edge : float
    ///     Radius of the rounding beyond it [m].
    FlatPunch {
        /// Radius of the flat [m].
        radius,
        /// Radius of the rounding beyond it [m].
        edge
    },
    (*, radius, edge)
);
elementary!(
    /// A wave along the direction `angle`, a crest at the origin for phase 0; add it to a shape.
    ///
    /// Parameters
    /// ----------
    /// amplitude : float
    ///     Height of a crest above the mean [m].
    /// wavelength : float
    ///     Distance of the crests [m].
    /// angle : float
    ///     Direction, from x towards y [rad].
    /// phase : float
    ///     Phase at the origin [rad].
    Waviness {
        /// Height of a crest above the mean [m].
        amplitude,
        /// Distance of the crests [m].
        wavelength,
        /// Direction, from x towards y [rad].
        angle,
        /// Phase at the origin [rad].
        phase
    },
    (*, amplitude, wavelength, angle = 0.0, phase = 0.0)
);

/// A random self-affine surface; add it to a shape.
///
/// Its power falls like k^-(2 + 2 `hurst`) between two wavelengths and is level above the longer
/// one. The same seed gives the same surface on every grid of the same size, however fine.
///
/// Parameters
/// ----------
/// rms : float
///     Root-mean-square height [m].
/// hurst : float
///     Hurst exponent, above 0 and up to 1.
/// longest, shortest : float
///     Wavelengths between which it is self-affine [m]; the shortest is at least two cells.
/// seed : int
///     Seed of the phases (default 0).
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Rough(core::Rough);

parts!(Rough: rms, hurst, longest, shortest, seed);

#[pymethods]
impl Rough {
    #[new]
    #[pyo3(signature = (*, rms, hurst, longest, shortest, seed = 0))]
    fn new(rms: f64, hurst: f64, longest: f64, shortest: f64, seed: u32) -> PyResult<Self> {
        let rough = core::Rough {
            rms,
            hurst,
            longest,
            shortest,
            seed,
        };
        let shape = core::Shape::Rough(rough);
        shape.check("shape").map_err(to_python)?;
        Ok(Self(rough))
    }

    /// Root-mean-square height [m].
    #[getter]
    fn rms(&self) -> f64 {
        self.0.rms
    }

    /// Hurst exponent.
    #[getter]
    fn hurst(&self) -> f64 {
        self.0.hurst
    }

    /// Longest wavelength of the self-affine range [m].
    #[getter]
    fn longest(&self) -> f64 {
        self.0.longest
    }

    /// Shortest wavelength [m].
    #[getter]
    fn shortest(&self) -> f64 {
        self.0.shortest
    }

    /// Seed of the phases.
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

/// Numbers over the contact plane, the middle of the map over the origin.
///
/// As the shape of a body they are heights out of it, towards the other one [m]; in a friction law
/// they are factors of mu.
///
/// Parameters
/// ----------
/// values : array of shape (points along x, points along y)
///     The numbers.
/// spacing : float or (float, float)
///     Distance of the points along x and y [m]. In between they are interpolated linearly.
/// missing : "refuse", "crop" or "fill"
///     What becomes of points that are NaN: an error that says where they are; lines taken off the
///     edges; the mean of the neighbours.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct SurfaceMap(pub(crate) core::SurfaceMap);

parts!(SurfaceMap: values, spacing);

#[pymethods]
impl SurfaceMap {
    #[new]
    #[pyo3(signature = (values, *, spacing, missing = "refuse"))]
    fn new(values: Field<'_>, spacing: Pitch, missing: &str) -> PyResult<Self> {
        let values = values.as_array().to_owned();
        core::SurfaceMap::new(values, spacing.0, word(missing)?)
            .map(Self)
            .map_err(to_python)
    }

    /// Read numbers from a ``.npy`` array or from a table of text, one line per x.
    ///
    /// Parameters
    /// ----------
    /// path : path
    ///     An array of real or whole numbers of any size and byte order, or a table parted by
    ///     commas, semicolons, tabs or blanks, with or without a line of titles.
    /// spacing : float or (float, float)
    ///     Distance of the points, along x and y [m].
    /// missing : "refuse", "crop" or "fill"
    ///     What becomes of points without a number (blank or NaN): an error that says where they
    ///     are; lines taken off the edges; the mean of the neighbours.
    #[staticmethod]
    #[pyo3(signature = (path, *, spacing, missing = "refuse"))]
    fn from_file(path: PathBuf, spacing: Pitch, missing: &str) -> PyResult<Self> {
        core::SurfaceMap::from_file(&path, spacing.0, word(missing)?)
            .map(Self)
            .map_err(to_python)
    }

    /// The numbers.
    #[getter]
    fn values<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        self.0.values.to_pyarray(py)
    }

    /// Distance of the points along x and y [m].
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

/// What becomes of points without a number.
fn word(missing: &str) -> PyResult<core::Missing> {
    core::Missing::named(missing).ok_or_else(|| {
        let allowed = "\"refuse\", \"crop\" or \"fill\"";
        to_python(Error::invalid("missing", missing, allowed))
    })
}

/// Several shapes on top of one another, made by adding them.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
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
    fn new(parts: Vec<Shape>) -> Self {
        Self(parts.into_iter().map(core::Shape::from).collect())
    }

    /// The shapes.
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
