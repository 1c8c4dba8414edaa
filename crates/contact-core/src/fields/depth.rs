//! Where in which body.

use crate::error::Error;
use crate::kernels::{Stack, refuse_rigid};
use crate::scene::Body;

/// A depth and the layer it is looked at from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Depth below the surface of the body \[m\].
    pub z: f64,
    /// Layer from the surface down; their number for the substrate.
    pub layer: usize,
}

/// Which of the two bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// The upper body: depth is counted upwards.
    Body1,
    /// The lower body, on which q_x and q_y act.
    #[default]
    Body2,
}

impl Side {
    /// Sign of the shear on the body, and of components with one index z, in the body's own frame
    /// (z into the body).
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Body1 => -1.0,
            Self::Body2 => 1.0,
        }
    }
}

/// The depths `z` \[m\] with their layers; on an interface both, the upper one first.
pub fn depths(body: &Body, z: &[f64]) -> Result<Vec<Depth>, Error> {
    body.check_alone()?;
    let stack = Stack::new(body);
    let mut all = Vec::with_capacity(z.len());
    for &z in z {
        let upper = stack.place(z, None)?.layer;
        refuse_rigid(body, upper)?;
        all.push(Depth { z, layer: upper });
        let next = upper + 1;
        if stack.place(z, Some(next)).is_ok() && refuse_rigid(body, next).is_ok() {
            all.push(Depth { z, layer: next });
        }
    }
    Ok(all)
}
