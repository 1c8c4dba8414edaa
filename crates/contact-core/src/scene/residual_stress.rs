//! Residual stress of the layers of a body over depth: of peening, grinding or deposition.
//!
//! It is biaxial, s_xx and s_yy, and depends on depth alone. s_zz and the shear stresses are zero, so
//! that it is in balance in a body without end in the plane, and the tractions of an elastic contact do
//! not depend on it. In a body that yields it is the stress before the first load.

use super::{Body, Profile};
use crate::error::Error;

/// Residual stress of every layer of a body; zero by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ResidualStress {
    /// Depth of the top of each layer \[m\].
    tops: Vec<f64>,
    /// Profile of each layer from the surface down, the substrate last; missing ones have no stress.
    layers: Vec<Profile>,
}

impl ResidualStress {
    /// Returns the residual stress of a body.
    pub fn from_body(body: &Body) -> Self {
        Self {
            tops: std::iter::once(0.0).chain(body.interfaces()).collect(),
            layers: body.residual.clone(),
        }
    }

    /// Replaces the residual stress of a body by a profile for each layer; without profiles it is the one of the body.
    ///
    /// Fails for another number of layers, at a number without meaning, and where a layer yields: there
    /// the plastic strain of a run depends on the residual stress of its scene.
    pub fn from_profiles(body: &Body, layers: &[Profile]) -> Result<Self, Error> {
        if layers.is_empty() {
            return Ok(Self::from_body(body));
        }
        let count = body.coatings.len() + 1;
        if layers.len() != count {
            let allowed = format!(
                "one for each of the {count} layers from the surface down, the substrate last: \
                 each a stress or a table, [[0, -500e6], [1e-4, 0]]"
            );
            let message = format!("{} of them", layers.len());
            return Err(Error::invalid("residual", message, allowed));
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
            ..Self::from_body(body)
        })
    }

    /// Angles to the x axis of the larger of s_xx and s_yy \[rad\], each once: 0 and pi/2 where depths
    /// or layers differ, none where s_xx = s_yy everywhere.
    pub fn directions(&self) -> Vec<f64> {
        let rows = || self.layers.iter().flat_map(|layer| &layer.rows);
        let mut directions = Vec::new();
        if rows().any(|[_, xx, yy]| xx > yy) {
            directions.push(0.0);
        }
        if rows().any(|[_, xx, yy]| yy > xx) {
            directions.push(std::f64::consts::FRAC_PI_2);
        }
        directions
    }

    /// s_xx and s_yy of a layer at a depth below the surface of the body \[Pa\].
    pub fn stress_at(&self, layer: usize, z: f64) -> [f64; 2] {
        let Some(profile) = self.layers.get(layer) else {
            return [0.0; 2];
        };
        profile.stress_at(z - self.tops.get(layer).copied().unwrap_or(0.0))
    }

    /// Depths below the surface of the body at which a table of a layer has a row \[m\]: the stress has
    /// a kink there.
    pub fn kinks(&self) -> Vec<f64> {
        let mut kinks = Vec::new();
        for (n, profile) in self.layers.iter().enumerate() {
            let top = self.tops.get(n).copied().unwrap_or(0.0);
            let bottom = self.tops.get(n + 1).copied().unwrap_or(f64::INFINITY);
            let rows = profile.rows.iter().filter(|_| profile.rows.len() > 1);
            let depths = rows.map(|row| top + row[0]);
            kinks.extend(depths.filter(|z| top < *z && *z < bottom));
        }
        kinks
    }
}
