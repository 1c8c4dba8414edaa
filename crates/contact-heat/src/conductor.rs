//! Thermal properties: materials, and the layers of a body.

use contact_core::Error;

/// A material that conducts heat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Conductor {
    /// Conductivity K \[W/(m K)\], positive.
    pub conductivity: f64,
    /// Heat capacity of the volume C, density times specific heat \[J/(m^3 K)\], positive.
    pub heat_capacity: f64,
}

impl Conductor {
    /// Fails if conductivity or heat capacity is out of its range; `key` names the body.
    fn check(&self, key: &str) -> Result<(), Error> {
        for (name, value, unit) in [
            ("conductivity", self.conductivity, "W/(m K)"),
            ("heat_capacity", self.heat_capacity, "J/(m^3 K)"),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                let allowed = format!("positive and finite, in {unit}");
                return Err(Error::invalid(format!("{key}.{name}"), value, allowed));
            }
        }
        Ok(())
    }
}

/// The thermal layers of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Layers {
    /// Layers from the surface down, each with its thickness \[m\].
    pub(super) coatings: Vec<(Conductor, f64)>,
    /// The half-space below.
    pub(super) substrate: Conductor,
}

impl Layers {
    /// A conductor for each layer from the surface down, the substrate's last, and the thickness of
    /// each coating \[m\]; `key` names the body in errors.
    pub fn new(conductors: &[Conductor], thicknesses: &[f64], key: &str) -> Result<Self, Error> {
        for (i, conductor) in conductors.iter().enumerate() {
            conductor.check(&format!("{key}[{i}]"))?;
        }
        if let Some(h) = thicknesses.iter().find(|h| !(**h > 0.0 && h.is_finite())) {
            let allowed = "a positive thickness in m";
            return Err(Error::invalid(format!("{key}: thickness"), h, allowed));
        }
        let number = format!("{} conductors", conductors.len());
        let count = thicknesses.len() + 1;
        let allowed = format!(
            "one for each of the {count} layers of the body from the surface down, the substrate's last"
        );
        match conductors.split_last() {
            Some((&substrate, coatings)) if coatings.len() == thicknesses.len() => Ok(Self {
                coatings: std::iter::zip(coatings.iter().copied(), thicknesses.iter().copied())
                    .collect(),
                substrate,
            }),
            _ => Err(Error::invalid(key, number, allowed)),
        }
    }

    /// A half-space of one material.
    pub fn homogeneous(conductor: Conductor) -> Result<Self, Error> {
        Self::new(&[conductor], &[], "conductor")
    }

    /// The material at the surface.
    pub(super) fn outermost(&self) -> Conductor {
        self.coatings
            .first()
            .map_or(self.substrate, |layer| layer.0)
    }
}
