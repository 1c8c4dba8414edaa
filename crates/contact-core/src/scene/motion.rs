//! The six rigid motions of body 1 against body 2, each prescribed or driven by its load.

/// A rigid motion of body 1 against body 2; the first three lie across the contact plane, the
/// others in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RigidMotion {
    /// Approach `delta_z`, which the normal force W drives.
    DeltaZ,
    /// Tilt `phi_x` about x, which M_x drives.
    PhiX,
    /// Tilt `phi_y` about y, which M_y drives.
    PhiY,
    /// Shift `delta_x` along x, which T_x drives.
    DeltaX,
    /// Shift `delta_y` along y, which T_y drives.
    DeltaY,
    /// Rotation `phi_z` about z, which the torsional moment M_z drives.
    PhiZ,
}

/// Prescribed part of a rigid motion: either the load that drives it, and the motion is free to
/// balance that load, or the motion itself, and its load follows from the solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prescribed {
    /// A force \[N\] or moment \[N m\].
    Load(f64),
    /// A shift \[m\] or rotation \[rad\].
    Motion(f64),
}

impl RigidMotion {
    /// All six, in the order of every array of six loads or motions.
    pub const ALL: [Self; 6] = [
        Self::DeltaZ,
        Self::PhiX,
        Self::PhiY,
        Self::DeltaX,
        Self::DeltaY,
        Self::PhiZ,
    ];

    /// Index in [`Self::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// The name of the motion.
    pub const fn name(self) -> &'static str {
        match self {
            Self::DeltaZ => "delta_z",
            Self::PhiX => "phi_x",
            Self::PhiY => "phi_y",
            Self::DeltaX => "delta_x",
            Self::DeltaY => "delta_y",
            Self::PhiZ => "phi_z",
        }
    }

    /// The name of the load that drives it.
    pub const fn load_name(self) -> &'static str {
        match self {
            Self::DeltaZ => "W",
            Self::PhiX => "M_x",
            Self::PhiY => "M_y",
            Self::DeltaX => "T_x",
            Self::DeltaY => "T_y",
            Self::PhiZ => "M_z",
        }
    }

    /// The names of all loads and of all motions.
    pub fn names() -> [&'static str; 12] {
        std::array::from_fn(|n| match Self::ALL.get(n) {
            Some(motion) => motion.load_name(),
            None => Self::ALL[n - Self::ALL.len()].name(),
        })
    }

    /// Returns the motion with this name, or driven by the load with this name, and the prescribed value.
    pub fn from_quantity(quantity: &str, value: f64) -> Option<(Self, Prescribed)> {
        Self::ALL.into_iter().find_map(|motion| {
            if quantity == motion.load_name() {
                Some((motion, Prescribed::Load(value)))
            } else if quantity == motion.name() {
                Some((motion, Prescribed::Motion(value)))
            } else {
                None
            }
        })
    }

    /// Whether it is a rotation \[rad\], driven by a moment \[N m\], and not a shift \[m\], driven
    /// by a force \[N\].
    pub const fn is_rotation(self) -> bool {
        matches!(self, Self::PhiX | Self::PhiY | Self::PhiZ)
    }

    /// Whether it and its load lie in the contact plane.
    pub const fn is_in_plane(self) -> bool {
        matches!(self, Self::DeltaX | Self::DeltaY | Self::PhiZ)
    }

    /// Whether it and its load change their sign under the reflection y -> -y.
    pub const fn is_odd_in_y(self) -> bool {
        matches!(self, Self::PhiX | Self::DeltaY | Self::PhiZ)
    }
}

impl Prescribed {
    /// The value of the load or the motion, whichever is prescribed.
    pub const fn value(self) -> f64 {
        match self {
            Self::Load(value) | Self::Motion(value) => value,
        }
    }

    /// Whether the motion is prescribed, and not its load.
    pub const fn is_motion(self) -> bool {
        matches!(self, Self::Motion(_))
    }

    /// The name of the prescribed motion or load.
    pub const fn name(self, motion: RigidMotion) -> &'static str {
        match self {
            Self::Load(_) => motion.load_name(),
            Self::Motion(_) => motion.name(),
        }
    }

    /// Applies a function to the value.
    #[must_use]
    pub fn map(self, f: impl FnOnce(f64) -> f64) -> Self {
        match self {
            Self::Load(value) => Self::Load(f(value)),
            Self::Motion(value) => Self::Motion(f(value)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Prescribed, RigidMotion};
    use crate::scene::Loads;

    #[test]
    fn prescribing_a_load_frees_its_motion() {
        for (k, motion) in RigidMotion::ALL.into_iter().enumerate() {
            assert_eq!(motion.index(), k);
            let mut loads = Loads::default();
            for prescribed in [
                Prescribed::Motion(2.0),
                Prescribed::Load(3.0),
                Prescribed::Motion(4.0),
            ] {
                loads.prescribe(motion, prescribed);
                assert_eq!(loads.prescribed(motion), prescribed);
                let others = RigidMotion::ALL
                    .into_iter()
                    .filter(|other| *other != motion);
                for other_motion in others {
                    assert_eq!(
                        loads.prescribed(other_motion),
                        Loads::default().prescribed(other_motion)
                    );
                }
                let parsed =
                    RigidMotion::from_quantity(prescribed.name(motion), prescribed.value());
                assert_eq!(parsed, Some((motion, prescribed)));
            }
        }
        assert_eq!(RigidMotion::from_quantity("sigma_B", 1.0), None);
    }
}
