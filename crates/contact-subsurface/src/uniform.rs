//! Stress of a body without tractions: its bulk stress, the residual stress of its layers, and the
//! residual stress of its plastic strain.

use contact_core::Error;
use contact_core::scene::{Body, Grid, ResidualStress};
use stress_tensor::StressTensor;

use super::{Depth, Eigenstress};

/// The stress without tractions of a body under each of several states.
#[derive(Clone, Debug, Default)]
pub(super) struct Uniform {
    sigma_B: Vec<f64>,
    plane_strain: bool,
    /// Residual stress of the layers, over depth.
    residual: ResidualStress,
    /// Residual stress of the plastic strain in each state.
    eigenstress: Vec<Option<Eigenstress>>,
}

impl Uniform {
    /// Combines the bulk stress of each state, the residual stress of the layers \[Pa\] (default:
    /// the stress of the body) and the stress of plastic strain in each of `states`. Fails if the
    /// body yields and no stress of plastic strain is given.
    pub(super) fn new(
        (body, grid): (&Body, &Grid),
        sigma_B: &[f64],
        residual: Option<&ResidualStress>,
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
            residual: residual
                .cloned()
                .unwrap_or_else(|| ResidualStress::from_body(body)),
            eigenstress: eigenstress.to_vec(),
        })
    }

    /// s_xx, s_yy, s_zz and s_xy of a state that are the same all over a depth of the body \[Pa\].
    pub(super) fn stress(&self, body: &Body, state: usize, depth: Depth) -> [f64; 4] {
        let sigma_B = self.sigma_B.get(state).copied().unwrap_or(0.0);
        let [xx, yy] = self.residual.stress_at(depth.layer, depth.z);
        let bulk = body.bulk_stress(sigma_B, self.plane_strain, (depth.layer, depth.z));
        [bulk[0] + xx, bulk[1] + yy, 0.0, bulk[2]]
    }

    /// The residual stress of plastic strain in a state, at a place \[Pa\]; `None` without plastic
    /// strain.
    pub(super) fn eigenstress_at(
        &self,
        state: usize,
        (x, y): (f64, f64),
        depth: Depth,
    ) -> Option<StressTensor> {
        let eigenstress = self.eigenstress.get(state)?.as_ref()?;
        Some(eigenstress.stress(x, y, depth))
    }
}
