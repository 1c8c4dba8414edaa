//! The two methods to solve a cycle, behind one interface.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::convolution::Convolutions;
use contact_core::scene::Scene;
use serde::{Deserialize, Serialize};

use super::loss::{Loss, Worn};
use super::marched::{Marched, MarchedState};
use super::pressing::Pressing;
use super::settings::{Cycling, Wear};
use super::sliding::{JumpEnd, Sliding};

/// Method to solve the contact of a cycle.
pub(crate) enum Model {
    Sliding(Box<Sliding>),
    Marched(Box<Marched>),
}

/// The state of a model between jumps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum ModelState {
    /// Pressures at the places of the stroke \[Pa\].
    Sliding(Vec<Vec<f64>>),
    Marched(Box<MarchedState>),
}

impl ModelState {
    /// The pressures at all places of a stroke; fails for the state of a march.
    fn sliding(self) -> Result<Vec<Vec<f64>>, Error> {
        match self {
            Self::Sliding(p) => Ok(p),
            Self::Marched(_) => Err(Self::wrong_state()),
        }
    }

    /// The state of a march; fails for the state of a stroke.
    fn marched(self) -> Result<MarchedState, Error> {
        match self {
            Self::Sliding(_) => Err(Self::wrong_state()),
            Self::Marched(state) => Ok(*state),
        }
    }

    /// The error of a state that belongs to the other method.
    fn wrong_state() -> Error {
        Error::invalid("state", "of another way to cycle", "one of this run")
    }
}

/// The results of the last cycle, for output.
pub(crate) struct CycleOutput<'a> {
    /// Pressure in the middle of the stroke, or the mean one of the cycle \[Pa\].
    pub(crate) p: &'a [f64],
    /// Shift of the bodies at that pressure \[m\].
    pub(crate) shift: f64,
    /// Way over which that pressure is the mean \[m\].
    pub(crate) shift_length: f64,
    /// Aerated share; empty without a model of the air.
    pub(crate) aerated: &'a [f64],
    pub(crate) stick: Option<&'a [bool]>,
    pub(crate) stick_ratio: f64,
    pub(crate) dissipated_per_cycle: f64,
    /// Mean coefficient of friction, and its error by the cells, over it.
    pub(crate) mu: f64,
    pub(crate) mu_error: f64,
    /// delta_x, T_x, delta_y, T_y along the loop \[m, N\].
    pub(crate) corners: Vec<[f64; 4]>,
}

impl Model {
    /// Solves the first cycle on surfaces worn so far, or continues from a state.
    pub(crate) fn new(
        scene: &Scene,
        wear: &Wear,
        state: Option<ModelState>,
        worn: &Worn,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        match wear.cycling {
            Cycling::Sliding => {
                let p = state.map(ModelState::sliding).transpose()?;
                let sliding = Sliding::new(scene, wear, p, worn, stop)?;
                Ok(Self::Sliding(Box::new(sliding)))
            }
            // Settled runs have a method.
            Cycling::Auto | Cycling::March => {
                let state = state.map(ModelState::marched).transpose()?;
                let marched = Marched::new(scene, wear, state, worn, stop)?;
                Ok(Self::Marched(Box::new(marched)))
            }
        }
    }

    /// The normal problem of the contact.
    pub(crate) fn pressing(&self) -> &Pressing {
        match self {
            Self::Sliding(s) => &s.pressing,
            Self::Marched(m) => &m.pressing,
        }
    }

    /// Ends of the stroke \[m\]; `None` in a march.
    pub(crate) fn stroke(&self) -> Option<[f64; 2]> {
        let Self::Sliding(s) = self else { return None };
        let shifts = s.places.iter().flat_map(|place| {
            [
                place.shift - 0.5 * place.length,
                place.shift + 0.5 * place.length,
            ]
        });
        Some(shifts.fold([0.0, 0.0], |[low, high], d: f64| [low.min(d), high.max(d)]))
    }

    /// Number of kept cells.
    pub(crate) fn cells(&self) -> usize {
        self.pressing().cells()
    }

    /// A copy of the state, to resume or to repeat from.
    pub(crate) fn state(&self) -> ModelState {
        match self {
            Self::Sliding(s) => ModelState::Sliding(s.p.clone()),
            Self::Marched(m) => ModelState::Marched(Box::new(m.state.clone())),
        }
    }

    /// Goes back to a state of this model.
    pub(crate) fn restore(&mut self, state: &ModelState) {
        match (self, state) {
            (Self::Sliding(s), ModelState::Sliding(p)) => s.restore(p),
            (Self::Marched(m), ModelState::Marched(state)) => m.state.clone_from(state),
            _ => {}
        }
    }

    /// Solves the contact on the surfaces worn so far, so that the results belong to them.
    pub(crate) fn settle(&mut self, worn: &Worn) -> Result<(), Error> {
        match self {
            Self::Sliding(s) => s.settle(worn),
            Self::Marched(m) => m.settle(worn),
        }
    }

    /// The loss of both bodies in a jump of n cycles. If `implicit`, it follows from the pressure at its end,
    /// otherwise from the pressure at its start.
    pub(crate) fn jump(&mut self, worn: &Worn, n: f64, implicit: bool) -> Result<Loss, Error> {
        match self {
            Self::Sliding(s) => s.jump(worn, n, implicit),
            Self::Marched(m) => m.jump(worn, n, implicit),
        }
    }

    /// The end of the last jump, if it had a third body in gross slip.
    pub(crate) fn take_end(&mut self) -> Option<JumpEnd> {
        match self {
            Self::Sliding(s) => s.take_end(),
            Self::Marched(_) => None,
        }
    }

    /// Starts the iterations of the next jump a `part` of the way to the end of a longer one.
    pub(crate) fn start_towards(&mut self, end: Option<&JumpEnd>, part: f64) {
        if let (Self::Sliding(s), Some(end)) = (self, end) {
            s.start_towards(end, part);
        }
    }

    /// Error of the worn depth by the place of the border of the stick zone within its cell, for
    /// the limit of endless wear \[m\].
    pub(crate) fn border_error(&mut self, worn: &Worn) -> Result<f64, Error> {
        match self {
            Self::Sliding(_) => Ok(0.0),
            Self::Marched(m) => m.border_error(worn),
        }
    }

    /// The pressures at the end of the last jump.
    pub(crate) fn pressures(&self) -> Vec<f64> {
        match self {
            Self::Sliding(s) => s.p.concat(),
            Self::Marched(m) => m.p.clone(),
        }
    }

    /// Work of the normal problems, cycles solved.
    pub(crate) fn work(&self) -> (Convolutions, usize) {
        match self {
            Self::Sliding(s) => (s.pressing.work(), 0),
            Self::Marched(m) => (m.pressing.work(), m.cycles_solved),
        }
    }

    /// The fields and numbers of the last cycle for the results.
    pub(crate) fn output(&self) -> CycleOutput<'_> {
        match self {
            Self::Sliding(s) => {
                let middle = s.middle();
                CycleOutput {
                    p: &s.p[middle],
                    shift: s.places[middle].shift,
                    shift_length: s.places[middle].length,
                    aerated: s.aerated(),
                    stick: None,
                    stick_ratio: 0.0,
                    dissipated_per_cycle: s.dissipated_per_cycle(),
                    mu: s.mean_mu(),
                    mu_error: s.mu_error,
                    corners: s
                        .corners
                        .iter()
                        .map(|[u, _, T]| [*u, s.force_factor() * T, 0.0, 0.0])
                        .collect(),
                }
            }
            Self::Marched(m) => {
                let cycled = m.cycled();
                let area = m.pressing.cell_area();
                let dissipated = cycled.dissipated.iter().sum::<f64>();
                let loading = cycled.pressure_times_slip.iter().sum::<f64>();
                CycleOutput {
                    p: &cycled.p,
                    shift: 0.0,
                    shift_length: 0.0,
                    aerated: &m.aerated,
                    stick: Some(&cycled.stick),
                    stick_ratio: cycled.stick_ratio,
                    dissipated_per_cycle: dissipated * area,
                    mu: if loading > 0.0 {
                        dissipated / loading
                    } else {
                        m.nominal_mu
                    },
                    mu_error: m.mu_error,
                    corners: cycled.corners.clone(),
                }
            }
        }
    }
}
