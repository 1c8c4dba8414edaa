//! The two ways to solve a cycle, as the run sees them.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::loss::{Loss, Worn};
use super::marched::{Marched, MarchedState};
use super::pressing::Pressing;
use super::settings::{Cycling, Wear};
use super::sliding::Sliding;
use crate::error::Error;
use crate::scene::Scene;

/// How the contact of a cycle is solved.
pub(crate) enum Model {
    Sliding(Box<Sliding>),
    Marched(Box<Marched>),
}

/// What a model needs to go on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) enum ModelState {
    /// Pressures at the places of the stroke \[Pa\].
    Sliding(Vec<Vec<f64>>),
    Marched(Box<MarchedState>),
}

/// What is to be seen of the last cycle.
pub(crate) struct Seen<'a> {
    /// Pressure in the middle of the stroke, or the mean one of the cycle \[Pa\].
    pub(crate) p: &'a [f64],
    pub(crate) stick: Option<&'a [bool]>,
    pub(crate) stick_ratio: f64,
    pub(crate) dissipated_per_cycle: f64,
    /// delta_x, T_x, delta_y, T_y along the loop \[m, N\].
    pub(crate) corners: Vec<[f64; 4]>,
}

impl Model {
    pub(crate) fn new(
        scene: &Scene,
        wear: &Wear,
        state: Option<ModelState>,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        match (wear.cycling, state) {
            (Cycling::Sliding, None) => Ok(Self::Sliding(Box::new(Sliding::new(
                scene, wear, None, stop,
            )?))),
            (Cycling::Sliding, Some(ModelState::Sliding(p))) => Ok(Self::Sliding(Box::new(
                Sliding::new(scene, wear, Some(p), stop)?,
            ))),
            (Cycling::March, None) => Ok(Self::Marched(Box::new(Marched::new(
                scene, wear, None, stop,
            )?))),
            (Cycling::March, Some(ModelState::Marched(state))) => Ok(Self::Marched(Box::new(
                Marched::new(scene, wear, Some(*state), stop)?,
            ))),
            _ => Err(Error::invalid(
                "state",
                "of another way to cycle",
                "one of this run",
            )),
        }
    }

    pub(crate) fn pressing(&self) -> &Pressing {
        match self {
            Self::Sliding(s) => &s.pressing,
            Self::Marched(m) => &m.pressing,
        }
    }

    pub(crate) fn cells(&self) -> usize {
        self.pressing().cells()
    }

    pub(crate) fn state(&self) -> ModelState {
        match self {
            Self::Sliding(s) => ModelState::Sliding(s.p.clone()),
            Self::Marched(m) => ModelState::Marched(Box::new(m.state.clone())),
        }
    }

    pub(crate) fn restore(&mut self, state: &ModelState) {
        match (self, state) {
            (Self::Sliding(s), ModelState::Sliding(p)) => s.p.clone_from(p),
            (Self::Marched(m), ModelState::Marched(state)) => m.state.clone_from(state),
            _ => {}
        }
    }

    pub(crate) fn settle(&mut self, worn: &Worn) -> Result<(), Error> {
        match self {
            Self::Sliding(s) => s.settle(worn),
            Self::Marched(m) => m.settle(worn),
        }
    }

    pub(crate) fn jump(
        &mut self,
        worn: &Worn,
        cycles: f64,
        n: f64,
        implicit: bool,
    ) -> Result<Loss, Error> {
        match self {
            Self::Sliding(s) => s.jump(worn, cycles, n, implicit),
            Self::Marched(m) => m.jump(worn, cycles, n, implicit),
        }
    }

    /// The pressures at the end of the last jump.
    pub(crate) fn pressures(&self) -> Vec<f64> {
        match self {
            Self::Sliding(s) => s.p.concat(),
            Self::Marched(m) => m.p.clone(),
        }
    }

    /// Transforms of the normal problems, cycles solved.
    pub(crate) fn work(&self) -> (usize, usize) {
        match self {
            Self::Sliding(s) => (s.pressing.transforms(), 0),
            Self::Marched(m) => (m.pressing.transforms(), m.cycles_solved),
        }
    }

    pub(crate) fn seen(&self) -> Seen<'_> {
        match self {
            Self::Sliding(s) => {
                let middle = s.middle();
                Seen {
                    p: &s.p[middle],
                    stick: None,
                    stick_ratio: 0.0,
                    dissipated_per_cycle: s.dissipated_per_cycle(),
                    corners: s
                        .corners
                        .iter()
                        .map(|[u, _, T]| [*u, *T, 0.0, 0.0])
                        .collect(),
                }
            }
            Self::Marched(m) => {
                let cycled = m.cycled();
                let area = m.pressing.cell_area();
                Seen {
                    p: &cycled.p,
                    stick: Some(&cycled.stick),
                    stick_ratio: cycled.stick_ratio,
                    dissipated_per_cycle: cycled.dissipated.iter().sum::<f64>() * area,
                    corners: cycled.corners.clone(),
                }
            }
        }
    }
}
