//! Bodies: a substrate, the coatings bonded to it, and a surface shape.

use super::Shape;
use crate::error::Error;
use crate::material::{Coating, Elastic};

/// One of the two bodies, an elastic half-space under a gently curved surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Material of the half-space below the coatings.
    pub substrate: Elastic,
    /// Layers from the surface down: `coatings[0]` is the outermost.
    pub coatings: Vec<Coating>,
    /// Shape of the undeformed surface.
    pub shape: Shape,
}

impl Body {
    /// A homogeneous body.
    pub fn homogeneous(material: Elastic, shape: Shape) -> Self {
        Self {
            substrate: material,
            coatings: Vec::new(),
            shape,
        }
    }

    /// The material at the surface.
    pub fn outermost(&self) -> Elastic {
        self.coatings.first().map_or(self.substrate, |c| c.material)
    }

    /// Whether every layer has the properties of the substrate.
    pub fn is_homogeneous(&self) -> bool {
        self.coatings.iter().all(|c| c.material == self.substrate)
    }

    /// Depths of the interfaces \[m\], from the surface down.
    pub fn interfaces(&self) -> Vec<f64> {
        let bottom = |depth: &mut f64, coating: &Coating| {
            *depth += coating.thickness;
            Some(*depth)
        };
        self.coatings.iter().scan(0.0, bottom).collect()
    }

    /// The elastic make-up: E, nu and thickness of each layer from the surface down, 0 for the
    /// substrate; with `shortcut` one of layers that all equal the substrate is the substrate alone.
    pub(crate) fn layers(&self, shortcut: bool) -> Vec<(f64, f64, f64)> {
        let coatings = if shortcut && self.is_homogeneous() {
            &[][..]
        } else {
            &self.coatings[..]
        };
        let coatings = coatings
            .iter()
            .map(|c| (c.material.E, c.material.nu, c.thickness));
        coatings
            .chain([(self.substrate.E, self.substrate.nu, 0.0)])
            .collect()
    }

    /// Fails if a material or a thickness is out of its range; `key` is `body1` or `body2`.
    pub(crate) fn check(&self, key: &str) -> Result<(), Error> {
        self.substrate.check(key)?;
        for (i, coating) in self.coatings.iter().enumerate() {
            coating.check(&format!("{key}.coatings[{i}]"))?;
        }
        self.shape.check(&format!("{key}.shape"))
    }
}
