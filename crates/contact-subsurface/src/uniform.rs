//! Stress that is uniform in a layer: the bulk stress of the body and residual stresses.

use contact_core::Error;
use contact_core::scene::{Body, Grid};

/// The uniform stress of the layers of a body under each of several states.
#[derive(Clone, Debug, Default)]
pub(super) struct Uniform {
    sigma_B: Vec<f64>,
    plane_strain: bool,
    /// Of every layer.
    residual: Vec<f64>,
}

impl Uniform {
    /// Bulk stress of each state and residual stress of each layer \[Pa\].
    pub(super) fn new(
        body: &Body,
        sigma_B: &[f64],
        residual: &[f64],
        grid: &Grid,
    ) -> Result<Self, Error> {
        if body.yields() {
            let allowed = "left out: this is the stress of elastic bodies; of bodies that yield a march has it";
            return Err(Error::invalid("plastic", "given", allowed));
        }
        Ok(Self {
            sigma_B: sigma_B.to_vec(),
            plane_strain: grid.plane_strain,
            residual: residual_of_layers(body, residual)?,
        })
    }

    /// s_xx and s_yy of a state in a layer of the body \[Pa\].
    pub(super) fn stress(&self, body: &Body, state: usize, layer: usize) -> [f64; 2] {
        let sigma_B = self.sigma_B.get(state).copied().unwrap_or(0.0);
        let residual = self.residual.get(layer).copied().unwrap_or(0.0);
        body.bulk_stress(sigma_B, self.plane_strain, layer)
            .map(|s| s + residual)
    }
}

/// Residual stress of every layer of a body from the surface down, the substrate's last \[Pa\]:
/// those given, or zero where none is.
///
/// It is biaxial, s_xx = s_yy, uniform in its layer, and has no effect on the contact. Fails for
/// another number of layers, and where a stress is not finite.
pub fn residual_of_layers(body: &Body, given: &[f64]) -> Result<Vec<f64>, Error> {
    let layers = body.coatings.len() + 1;
    if given.is_empty() {
        return Ok(vec![0.0; layers]);
    }
    if given.len() != layers {
        let allowed = format!(
            "one for each of the {layers} layers from the surface down, the substrate last"
        );
        let found = format!("{} numbers", given.len());
        return Err(Error::invalid("residual", found, allowed));
    }
    if let Some(n) = given.iter().position(|s| !s.is_finite()) {
        let key = format!("residual[{n}]");
        return Err(Error::invalid(key, given[n], "a finite stress in Pa"));
    }
    Ok(given.to_vec())
}
