//! The loads at one moment.

use serde::{Deserialize, Serialize};

use super::{Friction, Prescribed, RigidMotion};
use crate::error::Error;

/// The loads that the contact transmits at one moment, on body 2, and the rigid motions that are
/// given instead of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Loads {
    /// Normal force W \[N\], compression positive.
    pub W: f64,
    /// Tangential force along x on body 2 \[N\].
    pub T_x: f64,
    /// Tangential force along y on body 2 \[N\].
    pub T_y: f64,
    /// Tilting moment about x, the sum of y p dA \[N m\].
    pub M_x: f64,
    /// Tilting moment about y, the sum of -x p dA \[N m\].
    pub M_y: f64,
    /// Torsional moment about z, the sum of (x q_y - y q_x) dA \[N m\].
    pub M_z: f64,
    /// Bulk stress along x of body 2, away from the contact \[Pa\], tension positive: a fatigue
    /// load.
    pub sigma_B: f64,
    /// Bulk stress along x of body 1 \[Pa\].
    pub sigma_B1: f64,
    /// Distance that the contact has rolled along x over both bodies \[m\].
    pub rolled: f64,
    /// Prescribed motions. The load of each follows from the solution, so that its value in a
    /// path has no meaning.
    pub given: PrescribedMotions,
}

/// Prescribed rigid motions of body 1 against body 2; `None` where the load is prescribed. By default
/// the forces are prescribed and the bodies do not rotate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PrescribedMotions {
    /// Approach \[m\], instead of W.
    pub delta_z: Option<f64>,
    /// Shift along x \[m\], instead of T_x.
    pub delta_x: Option<f64>,
    /// Shift along y \[m\], instead of T_y.
    pub delta_y: Option<f64>,
    /// Tilt about x \[rad\], instead of M_x (default 0).
    pub phi_x: Option<f64>,
    /// Tilt about y \[rad\], instead of M_y (default 0).
    pub phi_y: Option<f64>,
    /// Rotation about z \[rad\], instead of M_z (default 0).
    pub phi_z: Option<f64>,
}

impl Default for PrescribedMotions {
    /// Approach and shifts free, rotations held at zero.
    fn default() -> Self {
        Self {
            delta_z: None,
            delta_x: None,
            delta_y: None,
            phi_x: Some(0.0),
            phi_y: Some(0.0),
            phi_z: Some(0.0),
        }
    }
}

impl Loads {
    /// A motion or its load, whichever is prescribed.
    pub fn prescribed(&self, motion: RigidMotion) -> Prescribed {
        match self.given.motions()[motion.index()] {
            None => Prescribed::Load(self.forces()[motion.index()]),
            Some(motion) => Prescribed::Motion(motion),
        }
    }

    /// Prescribes a load, which frees its motion, or a motion, whose load has no value of its own
    /// then.
    pub fn prescribe(&mut self, motion: RigidMotion, prescribed: Prescribed) {
        let (mut forces, mut motions) = (self.forces(), self.given.motions());
        (forces[motion.index()], motions[motion.index()]) = match prescribed {
            Prescribed::Load(load) => (load, None),
            Prescribed::Motion(value) => (0.0, Some(value)),
        };
        *self = self.with_forces(forces, PrescribedMotions::from_motions(motions));
    }

    /// The six loads in the order of [`RigidMotion::ALL`].
    pub fn forces(&self) -> [f64; 6] {
        [self.W, self.M_x, self.M_y, self.T_x, self.T_y, self.M_z]
    }

    /// Returns the loads with other forces, in the order of [`Self::forces`], and prescribed motions.
    #[must_use]
    pub fn with_forces(self, forces: [f64; 6], given: PrescribedMotions) -> Self {
        let [W, M_x, M_y, T_x, T_y, M_z] = forces;
        Self {
            W,
            T_x,
            T_y,
            M_x,
            M_y,
            M_z,
            given,
            ..self
        }
    }
}

impl PrescribedMotions {
    /// The six motions in the order of [`RigidMotion::ALL`].
    pub fn motions(&self) -> [Option<f64>; 6] {
        [
            self.delta_z,
            self.phi_x,
            self.phi_y,
            self.delta_x,
            self.delta_y,
            self.phi_z,
        ]
    }

    /// Builds from the six motions in the order of [`Self::motions`].
    pub fn from_motions(motions: [Option<f64>; 6]) -> Self {
        let [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z] = motions;
        Self {
            delta_z,
            delta_x,
            delta_y,
            phi_x,
            phi_y,
            phi_z,
        }
    }
}

impl Loads {
    /// Fails at a number that is not finite and at a tensile W.
    pub(crate) fn check_values(&self, key: &dyn Fn(&str) -> String) -> Result<(), Error> {
        for (name, value) in [
            ("sigma_B", self.sigma_B),
            ("sigma_B1", self.sigma_B1),
            ("rolled", self.rolled),
        ] {
            if !value.is_finite() {
                return Err(Error::invalid(key(name), value, "a finite number"));
            }
        }
        for motion in RigidMotion::ALL {
            let prescribed = self.prescribed(motion);
            if !prescribed.value().is_finite() {
                let allowed = match (prescribed, motion.is_rotation()) {
                    (Prescribed::Load(_), true) => "a finite moment in N m",
                    (Prescribed::Load(_), false) => "a finite force in N",
                    (Prescribed::Motion(_), true) => "a finite rotation in rad",
                    (Prescribed::Motion(_), false) => "a finite shift in m",
                };
                let name = prescribed.name(motion);
                return Err(Error::invalid(key(name), prescribed.value(), allowed));
            }
        }
        if self.given.delta_z.is_none() && self.W < 0.0 {
            return Err(Error::invalid(
                key("W"),
                self.W,
                "a finite compressive force >= 0 in N",
            ));
        }
        Ok(())
    }

    /// Fails at loads that friction cannot carry; their values are checked.
    pub(crate) fn check(
        &self,
        key: &dyn Fn(&str) -> String,
        friction: &Friction,
    ) -> Result<(), Error> {
        if self.given.delta_z.is_some() {
            return Ok(());
        }
        // The load of a motion, zero where the motion is prescribed.
        let load = |motion: RigidMotion| match self.prescribed(motion) {
            Prescribed::Load(load) => load,
            Prescribed::Motion(_) => 0.0,
        };
        for rotation_or_shear in &RigidMotion::ALL[1..] {
            if self.W == 0.0 && load(*rotation_or_shear) != 0.0 {
                return Err(Error::invalid(
                    key(rotation_or_shear.load_name()),
                    load(*rotation_or_shear),
                    "0 where W = 0: the bodies part",
                ));
            }
        }
        let (T_x, T_y) = (load(RigidMotion::DeltaX), load(RigidMotion::DeltaY));
        let M_z = load(RigidMotion::PhiZ);
        if friction.mu == 0.0 && M_z != 0.0 {
            return Err(Error::invalid(
                key("M_z"),
                M_z,
                "0 without friction: nothing resists torsion",
            ));
        }
        let Some(limit) = friction.max_tangential_force(self.W) else {
            return Ok(());
        };
        let T = T_x.hypot(T_y);
        if T > limit * (1.0 + 1e-12) {
            return Err(Error::invalid(
                key(if T_x.abs() >= T_y.abs() { "T_x" } else { "T_y" }),
                T,
                format!("|T| <= mu W = {limit}, the largest force that friction can carry"),
            ));
        }
        Ok(())
    }
}
