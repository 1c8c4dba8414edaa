//! The loads at one moment.

use serde::{Deserialize, Serialize};

use super::Friction;
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
    /// Bulk stress along x of body 2, away from the contact \[Pa\], tension positive: a fatigue load.
    pub sigma_B: f64,
    /// The same of body 1.
    pub sigma_B1: f64,
    /// Way that the contact has rolled along x over both bodies \[m\].
    pub rolled: f64,
    /// Motions that are given. The load that goes with each is what the solution says; in a path
    /// its value has no meaning.
    pub given: Given,
}

/// Rigid motions of body 1 against body 2 that are given; `None` where the load is. Without a word
/// the forces are given and the bodies do not rotate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Given {
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

impl Default for Given {
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

/// Names of the loads and of the motions that they drive, in the order of [`Loads::forces`].
pub const LOADS: [&str; 6] = ["W", "M_x", "M_y", "T_x", "T_y", "M_z"];
/// Names of the rigid motions, in the order of [`LOADS`].
pub const MOTIONS: [&str; 6] = ["delta_z", "phi_x", "phi_y", "delta_x", "delta_y", "phi_z"];

impl Loads {
    /// The six loads: W, M_x, M_y across the contact plane, T_x, T_y, M_z in it.
    pub fn forces(&self) -> [f64; 6] {
        [self.W, self.M_x, self.M_y, self.T_x, self.T_y, self.M_z]
    }

    /// The same with other loads, as in [`Self::forces`], and motions given.
    #[must_use]
    pub fn with_forces(self, forces: [f64; 6], given: Given) -> Self {
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

impl Given {
    /// The six motions in the order of [`MOTIONS`].
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

    /// The motions of [`Self::motions`].
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
    pub(crate) fn check(
        &self,
        key: &dyn Fn(&str) -> String,
        friction: &Friction,
    ) -> Result<(), Error> {
        let (forces, given) = (self.forces(), self.given.motions());
        for k in 0..6 {
            match given[k] {
                Some(motion) if !motion.is_finite() => {
                    let unit = if MOTIONS[k].starts_with("phi") {
                        "rotation in rad"
                    } else {
                        "shift in m"
                    };
                    return Err(Error::invalid(
                        key(MOTIONS[k]),
                        motion,
                        format!("a finite {unit}"),
                    ));
                }
                None if !forces[k].is_finite() => {
                    let unit = if LOADS[k].starts_with('M') {
                        "moment in N m"
                    } else {
                        "force in N"
                    };
                    return Err(Error::invalid(
                        key(LOADS[k]),
                        forces[k],
                        format!("a finite {unit}"),
                    ));
                }
                _ => {}
            }
        }
        if given[0].is_some() {
            return Ok(());
        }
        if self.W < 0.0 {
            return Err(Error::invalid(
                key("W"),
                self.W,
                "a finite compressive force >= 0 in N",
            ));
        }
        for k in 1..6 {
            if self.W == 0.0 && given[k].is_none() && forces[k] != 0.0 {
                return Err(Error::invalid(
                    key(LOADS[k]),
                    forces[k],
                    "0 where W = 0: the bodies part",
                ));
            }
        }
        let part = |k: usize| if given[k].is_none() { forces[k] } else { 0.0 };
        let (T_x, T_y) = (part(3), part(4));
        let Some(limit) = friction.limit(self.W) else {
            return Ok(());
        };
        let T = T_x.hypot(T_y);
        if T > limit * (1.0 + 1e-12) {
            return Err(Error::invalid(
                key(if T_x.abs() >= T_y.abs() { "T_x" } else { "T_y" }),
                T,
                format!("|T| <= mu W = {limit} N, the largest force that friction can carry"),
            ));
        }
        Ok(())
    }
}
