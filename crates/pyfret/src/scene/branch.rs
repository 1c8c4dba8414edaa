//! A branch of the load history.

use contact_core::scene::{self as core, Prescribed, RigidMotion};

use super::forces::{Force, values_and_units};
use super::increments::Count;
use crate::parts::members;
use crate::prelude::*;

members!(
    /// How the increments of a branch are spaced.
    ///
    /// ``UNIFORM``: equal increments of force. ``EQUAL_RADIUS``: increments of equal contact radius
    /// of a paraboloid; natural for an indentation. ``SHORT_FIRST``: a short first increment, then
    /// equal ones; shows the stiffness and the stick zone right after a reversal.
    Spacing: Uniform = "UNIFORM", EqualRadius = "EQUAL_RADIUS", ShortFirst = "SHORT_FIRST"
);

/// One straight piece of a load history; most are made by the methods of :class:`LoadPath`.
///
/// Parameters
/// ----------
/// W, M_x, M_y, T_x, T_y, M_z : float, optional
///     Loads at its end [N, N m].
/// delta_z, phi_x, phi_y, delta_x, delta_y, phi_z : float, optional
///     Motions at its end [m, rad], in place of their loads. Without both the forces are 0 and
///     the bodies do not rotate.
/// sigma_B, sigma_B1, rolled : float
///     Bulk stresses [Pa] and the way rolled [m] at its end (default 0).
/// increments : int, optional
///     Their number (default: chosen).
/// spacing : Spacing
///     How they are spaced (default uniform).
/// t : float
///     Path time at its end.
/// path_error : float, optional
///     Estimated error that the increments leave in the shear, as known before a run; the error of
///     :meth:`Result.branches` contains what the run shows of it.
#[pyclass(frozen, eq, from_py_object, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct Branch(pub(super) core::Branch, pub(super) core::ForceUnits);

impl From<core::Branch> for Branch {
    fn from(branch: core::Branch) -> Self {
        Self(branch, core::ForceUnits::default())
    }
}

parts!(
    Branch: W, M_x, M_y, T_x, T_y, M_z, delta_z, phi_x, phi_y, delta_x, delta_y, phi_z, sigma_B,
    sigma_B1, rolled, increments, spacing, t, path_error
);

impl Branch {
    /// A load, `None` where its motion is prescribed.
    fn load(&self, of: RigidMotion) -> Option<f64> {
        match self.0.to.prescribed(of) {
            Prescribed::Load(load) => Some(load),
            Prescribed::Motion(_) => None,
        }
    }

    /// A motion, `None` where its load is prescribed.
    fn motion(&self, of: RigidMotion) -> Option<f64> {
        match self.0.to.prescribed(of) {
            Prescribed::Load(_) => None,
            Prescribed::Motion(motion) => Some(motion),
        }
    }
}

#[pymethods]
impl Branch {
    #[new]
    #[pyo3(signature = (
        *, W: "Force | None" = None, M_x: "Moment | None" = None, M_y: "Moment | None" = None, T_x: "Force | None" = None, T_y: "Force | None" = None, M_z: "Moment | None" = None, delta_z: "Length | None" = None,
        phi_x: "Angle | None" = None, phi_y: "Angle | None" = None, delta_x: "Length | None" = None, delta_y: "Length | None" = None, phi_z: "Angle | None" = None, sigma_B: "BulkStress" = 0.0,
        sigma_B1: "BulkStress" = 0.0, rolled: "Length" = 0.0, increments = None, spacing = Spacing::Uniform, t: "Time",
        path_error: "float | None" = None,
    ))]
    fn new(
        #[pyo3(from_py_with = Force::W)] W: Option<Force>,
        #[pyo3(from_py_with = Optional::M_x)] M_x: Option<f64>,
        #[pyo3(from_py_with = Optional::M_y)] M_y: Option<f64>,
        #[pyo3(from_py_with = Force::T_x)] T_x: Option<Force>,
        #[pyo3(from_py_with = Force::T_y)] T_y: Option<Force>,
        #[pyo3(from_py_with = Optional::M_z)] M_z: Option<f64>,
        #[pyo3(from_py_with = Optional::delta_z)] delta_z: Option<f64>,
        #[pyo3(from_py_with = Optional::phi_x)] phi_x: Option<f64>,
        #[pyo3(from_py_with = Optional::phi_y)] phi_y: Option<f64>,
        #[pyo3(from_py_with = Optional::delta_x)] delta_x: Option<f64>,
        #[pyo3(from_py_with = Optional::delta_y)] delta_y: Option<f64>,
        #[pyo3(from_py_with = Optional::phi_z)] phi_z: Option<f64>,
        #[pyo3(from_py_with = Given::sigma_B)] sigma_B: f64,
        #[pyo3(from_py_with = Given::sigma_B1)] sigma_B1: f64,
        #[pyo3(from_py_with = Given::rolled)] rolled: f64,
        increments: Option<Count>,
        spacing: Spacing,
        #[pyo3(from_py_with = Given::t)] t: f64,
        #[pyo3(from_py_with = number)] path_error: Option<f64>,
    ) -> Self {
        let ([W, T_x, T_y], units) = values_and_units([W, T_x, T_y]);
        let mut to = core::Loads {
            sigma_B,
            sigma_B1,
            rolled,
            ..core::Loads::default()
        };
        let loads = [W, M_x, M_y, T_x, T_y, M_z];
        let motions = [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z];
        for (of, (load, motion)) in RigidMotion::ALL
            .into_iter()
            .zip(loads.into_iter().zip(motions))
        {
            let load = load.map(Prescribed::Load);
            if let Some(prescribed) = motion.map(Prescribed::Motion).or(load) {
                to.prescribe(of, prescribed);
            }
        }
        let branch = core::Branch {
            spacing: spacing.into(),
            path_error,
            ..core::Branch::new(to, increments.and_then(|count| count.0), t)
        };
        Self(branch, units)
    }

    fn __repr__(&self) -> String {
        // Zero is worth a word only where it is not the default.
        let parts = RigidMotion::ALL.into_iter().filter_map(|of| {
            let prescribed = self.0.to.prescribed(of);
            let shown = match prescribed {
                Prescribed::Load(_) => of == RigidMotion::DeltaZ,
                Prescribed::Motion(_) => matches!(of, RigidMotion::DeltaZ | RigidMotion::DeltaX),
            };
            let value = prescribed.value();
            (value != 0.0 || shown).then(|| format!("{}={value:?}", prescribed.name(of)))
        });
        format!(
            "Branch({}, increments={}, t={:?})",
            parts.collect::<Vec<_>>().join(", "),
            self.0
                .increments
                .map_or_else(|| "\"auto\"".to_owned(), |n| n.to_string()),
            self.0.t_end
        )
    }
}

attributes!(Branch, self:
    /// Normal force at its end [N]; None where the approach is given.
    W: Option<f64> = self.load(RigidMotion::DeltaZ);
    /// Tilting moment about x at its end [N m]; None where the tilt is given.
    M_x: Option<f64> = self.load(RigidMotion::PhiX);
    /// Tilting moment about y at its end [N m]; None where the tilt is given.
    M_y: Option<f64> = self.load(RigidMotion::PhiY);
    /// Tangential force along x on body 2 at its end [N]; None where the shift is given.
    T_x: Option<f64> = self.load(RigidMotion::DeltaX);
    /// Tangential force along y on body 2 at its end [N]; None where the shift is given.
    T_y: Option<f64> = self.load(RigidMotion::DeltaY);
    /// Torsional moment on body 2 at its end [N m]; None where the rotation is given.
    M_z: Option<f64> = self.load(RigidMotion::PhiZ);
    /// Approach at its end [m]; None where W is given.
    delta_z: Option<f64> = self.motion(RigidMotion::DeltaZ);
    /// Shift along x at its end [m]; None where T_x is given.
    delta_x: Option<f64> = self.motion(RigidMotion::DeltaX);
    /// Shift along y at its end [m]; None where T_y is given.
    delta_y: Option<f64> = self.motion(RigidMotion::DeltaY);
    /// Tilt about x at its end [rad]; None where M_x is given.
    phi_x: Option<f64> = self.motion(RigidMotion::PhiX);
    /// Tilt about y at its end [rad]; None where M_y is given.
    phi_y: Option<f64> = self.motion(RigidMotion::PhiY);
    /// Rotation about z at its end [rad]; None where M_z is given.
    phi_z: Option<f64> = self.motion(RigidMotion::PhiZ);
    /// Bulk stress along x in body 2 at its end [Pa].
    sigma_B: f64 = self.0.to.sigma_B;
    /// Bulk stress along x in body 1 at its end [Pa].
    sigma_B1: f64 = self.0.to.sigma_B1;
    /// Way that the contact has rolled along x at its end [m].
    rolled: f64 = self.0.to.rolled;
    /// Number of increments; None: as many as the path tolerance asks for.
    increments: Option<usize> = self.0.increments;
    /// Estimated error that the increments leave in the shear, over the largest shear.
    path_error: Option<f64> = self.0.path_error;
    /// How the increments are spaced.
    spacing: Spacing = self.0.spacing.into();
    /// Path time at its end.
    t: f64 = self.0.t_end;
);
