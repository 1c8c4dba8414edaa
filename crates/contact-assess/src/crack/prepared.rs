//! A contact in its states, prepared for cracks anywhere below it.

use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use contact_core::Error;
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_subsurface::{DoubledCells, Moments, Points, Side, States};

/// Cells of the tractions: the cells of the grid, or cells twice as large in one of two pairings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) enum Cells {
    Grid,
    Doubled(usize),
}

impl Cells {
    /// Both pairings.
    pub(super) const DOUBLED: [Self; 2] = [Self::Doubled(0), Self::Doubled(1)];
}

/// Points under tractions on a grid, and the middle of that grid \[m\].
pub(super) type PointsOnGrid = (Points, (f64, f64));

/// A body under the states of a contact. What cracks at several places need is computed once.
pub struct Prepared {
    pub(super) body: Body,
    pub(super) side: Side,
    pub(super) grid: Grid,
    moments: Moments,
    has_stick: bool,
    residual: ResidualStress,
    /// Depths at which the stress jumps or has a kink: interfaces, and rows of residual stress \[m\].
    pub(super) breaks: Vec<f64>,
    /// Once raised, ends the computation with [`Error::Interrupted`].
    pub(super) stop: Arc<AtomicBool>,
    points: Mutex<HashMap<Cells, Arc<PointsOnGrid>>>,
}

impl Prepared {
    /// Prepares a body under some states on a grid.
    pub fn new(body: &Body, side: Side, grid: &Grid, states: &States<'_>) -> Self {
        let residual = states
            .residual
            .map_or_else(|| ResidualStress::from_body(body), Clone::clone);
        Self {
            breaks: [body.interfaces(), residual.kinks()].concat(),
            body: body.clone(),
            side,
            grid: *grid,
            moments: Moments::from_states(states, grid),
            has_stick: states.stick.is_some(),
            residual,
            stop: states.stop.clone(),
            points: Mutex::default(),
        }
    }

    /// Whether it can still be used: no interruption has ended a computation with it.
    pub fn is_usable(&self) -> bool {
        !self.stop.load(Ordering::Relaxed)
    }

    /// The body under the states, by the tractions on `cells`; made at its first use.
    pub(super) fn points(&self, cells: Cells) -> Result<Arc<PointsOnGrid>, Error> {
        let mut points = self.points.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(points) = points.get(&cells) {
            return Ok(points.clone());
        }
        let on = |grid: &Grid, moments: &Moments| {
            moments.with_states(Some(&self.residual), &self.stop, |states| {
                let stick = states.stick.filter(|_| self.has_stick);
                Points::new(&self.body, self.side, grid, States { stick, ..states })
            })
        };
        let made = match cells {
            Cells::Grid => (on(&self.grid, &self.moments)?, (0.0, 0.0)),
            Cells::Doubled(pairing) => {
                let cells = &DoubledCells::new_pair(&self.grid)[pairing];
                (
                    on(&cells.grid, &self.moments.coarsened(cells))?,
                    cells.middle,
                )
            }
        };
        let made = Arc::new(made);
        points.insert(cells, made.clone());
        Ok(made)
    }
}
