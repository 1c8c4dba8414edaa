//! Bodies: a substrate, the coatings bonded to it, and a surface shape.

use super::{Profile, Shape};
use crate::error::Error;
use crate::material::{Bond, Coating, Elastic};
use plasticity::Plastic;

/// Fails at a number without meaning; `key` is the key of the law in the scene.
pub fn check_plastic_law(law: &Plastic, key: &str) -> Result<(), Error> {
    let checked = law.check(key);
    checked.map_err(|e| Error::invalid(e.key, e.value, e.allowed))
}

/// One of the two bodies, an elastic half-space under a gently curved surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Material of the half-space below the coatings.
    pub substrate: Elastic,
    /// Layers from the surface down: `coatings[0]` is the outermost.
    pub coatings: Vec<Coating>,
    /// Bond of each layer to the one below it; missing ones are perfect.
    pub bonds: Vec<Bond>,
    /// Yield law of each layer, from the surface down, the substrate last; missing ones stay elastic.
    pub plastic: Vec<Option<Plastic>>,
    /// Residual stress of each layer, from the surface down, the substrate last; missing ones have none.
    pub residual: Vec<Profile>,
    /// Largest pressure that the surface bears \[Pa\]; infinite for an elastic one.
    pub hardness: f64,
    /// Shape of the undeformed surface.
    pub shape: Shape,
    /// How its bulk stress acts.
    pub bulk: Bulk,
}

/// How the bulk stress of a body acts: its direction, and its course over depth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bulk {
    /// Azimuth of its direction, from x towards y \[rad\]; `None`: along the axis of a cylinder, else along x.
    pub azimuth: Option<f64>,
    /// Depth of the neutral plane of a bent body \[m\]: the bulk stress is given at the surface and falls to
    /// nothing there; `None`: the same at all depths. Negative where it grows with depth.
    pub neutral_depth: Option<f64>,
}

impl Body {
    /// A homogeneous body.
    pub fn homogeneous(material: Elastic, shape: Shape) -> Self {
        Self {
            substrate: material,
            coatings: Vec::new(),
            bonds: Vec::new(),
            plastic: Vec::new(),
            residual: Vec::new(),
            hardness: f64::INFINITY,
            shape,
            bulk: Bulk::default(),
        }
    }

    /// A body with layers on its substrate, the outermost first.
    pub fn coated(
        substrate: Elastic,
        coatings: impl IntoIterator<Item = Coating>,
        shape: Shape,
    ) -> Self {
        Self {
            coatings: coatings.into_iter().collect(),
            ..Self::homogeneous(substrate, shape)
        }
    }

    /// The material at the surface.
    pub fn surface_material(&self) -> Elastic {
        self.coatings.first().map_or(self.substrate, |c| c.material)
    }

    /// The bond of a layer to the one below it.
    pub fn bond(&self, layer: usize) -> Bond {
        self.bonds.get(layer).copied().unwrap_or_default()
    }

    /// Yield law of a layer, if it has one; the substrate is the last one.
    pub fn plastic(&self, layer: usize) -> Option<Plastic> {
        self.plastic.get(layer).copied().flatten()
    }

    /// Whether any layer may yield.
    pub fn yields(&self) -> bool {
        self.plastic.iter().any(Option::is_some)
    }

    /// Returns the body without its yield laws.
    #[must_use]
    pub fn elastic(&self) -> Self {
        Self {
            plastic: Vec::new(),
            hardness: f64::INFINITY,
            ..self.clone()
        }
    }

    /// Whether every layer has the properties of the substrate and is perfectly bonded.
    pub fn is_homogeneous(&self) -> bool {
        let all_equal = self.coatings.iter().all(|c| c.material == self.substrate);
        all_equal && self.bonds.iter().all(|bond| *bond == Bond::PERFECT)
    }

    /// Name of a layer, by its index from the surface down: coatings count from one.
    pub fn layer_name(&self, layer: usize) -> String {
        if layer < self.coatings.len() {
            format!("coating {}", layer + 1)
        } else {
            "the substrate".to_owned()
        }
    }

    /// Depths of the interfaces \[m\], from the surface down.
    pub fn interfaces(&self) -> Vec<f64> {
        let bottom = |depth: &mut f64, coating: &Coating| {
            *depth += coating.thickness;
            Some(*depth)
        };
        self.coatings.iter().scan(0.0, bottom).collect()
    }

    /// Returns E, nu, thickness and bond of each layer from the surface down, thickness 0 for the
    /// substrate. With `shortcut`, layers that all equal the substrate are left out.
    pub(crate) fn layers(&self, shortcut: bool) -> Vec<[f64; 5]> {
        let coatings = if shortcut && self.is_homogeneous() {
            &[][..]
        } else {
            &self.coatings[..]
        };
        let coatings = coatings.iter().enumerate().map(|(n, c)| {
            let Bond { normal, shear } = self.bond(n);
            [c.material.E, c.material.nu, c.thickness, normal, shear]
        });
        coatings
            .chain([[self.substrate.E, self.substrate.nu, 0.0, 0.0, 0.0]])
            .collect()
    }

    /// The key of a layer of the body `key`.
    pub(crate) fn layer_key(&self, layer: usize, key: &str) -> String {
        match self.coatings.get(layer) {
            Some(_) => format!("{key}.coatings[{layer}]"),
            None => key.to_owned(),
        }
    }

    /// Fails if a residual stress is not finite, or above the yield stress of its layer; `key` is the body's.
    pub fn check_residual(&self, key: &str) -> Result<(), Error> {
        let layers = self.coatings.len() + 1;
        if self.residual.len() > layers {
            let allowed = format!("{layers}, one for each layer, or fewer");
            let key = format!("{key}.residual");
            return Err(Error::invalid(key, self.residual.len(), allowed));
        }
        for (layer, profile) in self.residual.iter().enumerate() {
            let key = format!("{}.residual", self.layer_key(layer, key));
            profile.check(&key)?;
            let limit = self.plastic(layer).map_or(f64::INFINITY, |law| law.s_y);
            let von_mises = profile.von_mises();
            if von_mises > limit {
                let allowed = format!(
                    "within the yield stress of its layer, {limit:e} Pa: give the s_y that the layer has with it"
                );
                let stress = format!("{von_mises:e} Pa by von Mises");
                return Err(Error::invalid(key, stress, allowed));
            }
        }
        Ok(())
    }

    /// Fails if the hardness is no pressure, or given beside a law of yielding.
    pub fn check_hardness(&self, key: &str) -> Result<(), Error> {
        let key = format!("{key}.hardness");
        if !(self.hardness > 0.0) {
            return Err(Error::invalid(key, self.hardness, "a pressure above 0 Pa"));
        }
        if self.hardness < f64::INFINITY && self.yields() {
            let allowed = "left out where a layer has plastic: it yields in the volume, without a limit of the pressure";
            return Err(Error::invalid(key, self.hardness, allowed));
        }
        Ok(())
    }

    /// Fails if a layer yields by numbers without meaning, or in a body that this is not computed for.
    fn check_plastic(&self, key: &str) -> Result<(), Error> {
        let layers = self.coatings.len() + 1;
        if self.plastic.len() > layers {
            let allowed = format!("{layers}, one for each layer, or fewer");
            let key = format!("{key}.plastic");
            return Err(Error::invalid(key, self.plastic.len(), allowed));
        }
        if !self.yields() {
            return Ok(());
        }
        for layer in 0..layers {
            let key = self.layer_key(layer, key);
            let material = self
                .coatings
                .get(layer)
                .map_or(self.substrate, |c| c.material);
            if material.is_rigid() {
                let allowed =
                    "a finite modulus in a body of which a layer yields: leave plastic out";
                return Err(Error::invalid(format!("{key}.E"), material.E, allowed));
            }
            if material.nu >= 0.5 {
                let allowed = "below 0.5 in a body of which a layer yields, such as 0.49";
                return Err(Error::invalid(format!("{key}.nu"), material.nu, allowed));
            }
            if let Some(plastic) = self.plastic(layer) {
                check_plastic_law(&plastic, &format!("{key}.plastic"))?;
            }
            if self.bond(layer) != Bond::PERFECT {
                let allowed =
                    "left out in a body of which a layer yields: layers are bonded perfectly there";
                return Err(Error::invalid(format!("{key}.bond"), "compliant", allowed));
            }
        }
        Ok(())
    }

    /// Fails if a material or a thickness is out of its range; `key` is `body1` or `body2`.
    pub(crate) fn check(&self, key: &str) -> Result<(), Error> {
        self.substrate.check(key)?;
        for (i, coating) in self.coatings.iter().enumerate() {
            coating.check(&format!("{key}.coatings[{i}]"))?;
        }
        if self.bonds.len() > self.coatings.len() {
            let allowed = format!("{}, one for each coating, or fewer", self.coatings.len());
            return Err(Error::invalid(
                format!("{key}.bonds"),
                self.bonds.len(),
                allowed,
            ));
        }
        for (i, bond) in self.bonds.iter().enumerate() {
            bond.check(&format!("{key}.coatings[{i}].bond"))?;
        }
        self.check_hardness(key)?;
        self.check_plastic(key)?;
        self.check_residual(key)?;
        self.shape.check(&format!("{key}.shape"))
    }
}
