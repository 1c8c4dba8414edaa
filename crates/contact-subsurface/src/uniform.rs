//! Stress that a body has without the tractions: its bulk stress, the residual stress of its layers, and
//! that of its plastic strain.

use contact_core::Error;
use contact_core::scene::{Body, Grid};
use stress_tensor::StressTensor;

use super::{Depth, Eigenstress};

/// The stress without tractions of a body under each of several states.
#[derive(Clone, Debug, Default)]
pub(super) struct Uniform {
    sigma_B: Vec<f64>,
    plane_strain: bool,
    /// Of every layer.
    residual: Vec<f64>,
    /// Of the plastic strain in each state.
    eigenstress: Vec<Option<Eigenstress>>,
}

impl Uniform {
    /// Bulk stress of each state and residual stress of each layer \[Pa\], what plastic strain leaves in each
    /// of `states`; fails where the body yields and this is not said.
    pub(super) fn new(
        (body, grid): (&Body, &Grid),
        sigma_B: &[f64],
        residual: &[f64],
        eigenstress: &[Option<Eigenstress>],
        states: usize,
    ) -> Result<Self, Error> {
        if body.yields() && eigenstress.len() < states {
            let allowed = "left out for the stress of elastic bodies under tractions; take the stress of bodies that \
                           yield from their run, which has the plastic strain";
            return Err(Error::invalid("plastic", "given", allowed));
        }
        Ok(Self {
            sigma_B: sigma_B.to_vec(),
            plane_strain: grid.plane_strain,
            residual: residual_of_layers(body, residual)?,
            eigenstress: eigenstress.to_vec(),
        })
    }

    /// s_xx and s_yy of a state that are the same all over a layer of the body \[Pa\].
    pub(super) fn stress(&self, body: &Body, state: usize, layer: usize) -> [f64; 2] {
        let sigma_B = self.sigma_B.get(state).copied().unwrap_or(0.0);
        let residual = self.residual.get(layer).copied().unwrap_or(0.0);
        body.bulk_stress(sigma_B, self.plane_strain, layer)
            .map(|s| s + residual)
    }

    /// What plastic strain leaves in a state, at a place \[Pa\]; `None` where nothing has yielded.
    pub(super) fn left(
        &self,
        state: usize,
        (x, y): (f64, f64),
        depth: Depth,
    ) -> Option<StressTensor> {
        let left = self.eigenstress.get(state)?.as_ref()?;
        Some(left.stress(x, y, depth))
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
