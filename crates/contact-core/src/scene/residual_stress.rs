//! Residual stress of the layers of a body over depth: of peening, grinding or deposition.
//!
//! It is biaxial, s_xx and s_yy, and depends on depth alone. s_zz and the shear stresses are zero, so
//! that it is in balance in a body without end in the plane, and the tractions of an elastic contact do
//! not depend on it. In a body that yields it is the stress before the first load.

use super::{Body, Profile};
use crate::error::Error;

/// Residual stress of every layer of a body; that of none by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResidualStress {
    /// Depth of the top of each layer \[m\].
    tops: Vec<f64>,
    /// Of each layer from the surface down, the substrate last; missing ones have none.
    layers: Vec<Profile>,
}

impl ResidualStress {
    /// That which a body has.
    pub fn of(body: &Body) -> Self {
        Self {
            tops: std::iter::once(0.0).chain(body.interfaces()).collect(),
            layers: body.residual.clone(),
        }
    }

    /// One that is given in place of that of the body, for each layer; none is that of the body.
    ///
    /// Fails for another number of layers, at a number without meaning, and where a layer yields: there
    /// the plastic strain of a run depends on the stress that its scene has.
    pub fn given(body: &Body, layers: &[Profile]) -> Result<Self, Error> {
        if layers.is_empty() {
            return Ok(Self::of(body));
        }
        let count = body.coatings.len() + 1;
        if layers.len() != count {
            let allowed = format!(
                "one for each of the {count} layers from the surface down, the substrate last"
            );
            let found = format!("{} of them", layers.len());
            return Err(Error::invalid("residual", found, allowed));
        }
        for (n, layer) in layers.iter().enumerate() {
            layer.check(&format!("residual[{n}]"))?;
        }
        if body.yields() {
            let allowed = "left out here: in a body that yields it belongs to the scene, \
                           Body(..., residual=...), since yielding depends on it";
            return Err(Error::invalid("residual", "given", allowed));
        }
        Ok(Self {
            layers: layers.to_vec(),
            ..Self::of(body)
        })
    }

    /// s_xx and s_yy of a layer at a depth below the surface of the body \[Pa\].
    pub fn at(&self, layer: usize, z: f64) -> [f64; 2] {
        let Some(profile) = self.layers.get(layer) else {
            return [0.0; 2];
        };
        profile.at(z - self.tops.get(layer).copied().unwrap_or(0.0))
    }
}
