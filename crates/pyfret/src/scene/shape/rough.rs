//! A random rough surface.

use contact_core::scene as core;

use crate::error::Answer;
use crate::prelude::*;

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
#[pyclass(frozen, eq, from_py_object, module = "pyfret.shapes")]
#[derive(Clone, Copy, PartialEq)]
pub(crate) struct Rough(pub(super) core::Rough);

parts!(Rough: rms, hurst, longest, shortest, seed);

#[pymethods]
impl Rough {
    #[new]
    #[pyo3(signature = (*, rms: "Length", hurst: "float", longest: "Length", shortest: "Length", seed: "int" = 0))]
    fn new(
        #[pyo3(from_py_with = Given::rms)] rms: f64,
        #[pyo3(from_py_with = number)] hurst: f64,
        #[pyo3(from_py_with = Given::longest)] longest: f64,
        #[pyo3(from_py_with = Given::shortest)] shortest: f64,
        #[pyo3(from_py_with = number)] seed: u32,
    ) -> Answer<Self> {
        let rough = core::Rough {
            rms,
            hurst,
            longest,
            shortest,
            seed,
        };
        let shape = core::Shape::Rough(rough);
        shape.check("shape")?;
        Ok(Self(rough))
    }

    pub(super) fn __repr__(&self) -> String {
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

attributes!(Rough, self:
    /// Root-mean-square height [m].
    rms: f64 = self.0.rms;
    /// Hurst exponent.
    hurst: f64 = self.0.hurst;
    /// Longest wavelength of the self-affine range [m].
    longest: f64 = self.0.longest;
    /// Shortest wavelength [m].
    shortest: f64 = self.0.shortest;
    /// Seed of the phases.
    seed: u32 = self.0.seed;
);
