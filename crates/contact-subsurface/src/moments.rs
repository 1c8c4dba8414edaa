//! The states of a contact at moments of a cycle.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::{Grid, ResidualStress};
use contact_core::zones::Outline;
use ndarray::Array2;

use crate::{DoubledCells, Eigenstress, Growth, Line, States};

/// Number of moments of a cycle from which its sections are chosen, about.
const SECTION_MOMENTS: usize = 16;

/// Tractions and bulk stress at several moments.
#[derive(Clone, Debug, Default)]
pub struct Moments {
    /// Tractions q_x, q_y, p \[Pa\] of each moment, of shape (nx, ny).
    pub tractions: Vec<[Array2<f64>; 3]>,
    /// The cells that stick.
    pub stick: Vec<Array2<bool>>,
    /// Bulk stress of the body \[Pa\].
    pub sigma_B: Vec<f64>,
    /// Plastic strain and its residual stress; empty for a body that stays elastic.
    pub eigenstress: Vec<Option<Eigenstress>>,
}

/// Plastic work of a cycle over its friction work, or without friction over the plastic work of the path,
/// below which bodies have shaken down.
pub const SHAKEN: f64 = 1e-3;

/// Work of plastic strain in a cycle, and the work that it is compared with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yielding {
    /// Plastic work \[J\].
    pub plastic: f64,
    /// Friction work, or without friction the plastic work of the whole path \[J\].
    pub beside: f64,
}

impl Yielding {
    /// Checks that plastic strain still grows.
    pub fn grows(&self) -> bool {
        self.plastic > SHAKEN * self.beside
    }
}

/// The moments of a cycle, read a few at a time.
pub trait CycleSource: Sync {
    /// Number of moments.
    fn count(&self) -> usize;
    /// The moments of these numbers, from 0.
    fn moments(&self, which: &[usize]) -> Result<Moments, Error>;
    /// The start of the cycle: the moment before its first, if stored.
    fn start(&self) -> Result<Option<Moments>, Error>;
    /// Largest error of the shear of the path by its increments, over the largest shear; `None` where
    /// the increments were given and not chosen.
    fn path_error(&self) -> Option<f64> {
        None
    }
    /// Plastic work of the cycle; `None` for a body that stays elastic.
    fn yielding(&self) -> Result<Option<Yielding>, Error> {
        Ok(None)
    }
}

impl Moments {
    /// Copies tractions, stick cells, bulk stress and plastic strain of states on a grid.
    pub fn from_states(states: &States<'_>, grid: &Grid) -> Self {
        let shape = (grid.nx, grid.ny);
        let field = |values: Option<&[f64]>| {
            Array2::from_shape_fn(shape, |(i, j)| values.map_or(0.0, |v| v[i * grid.ny + j]))
        };
        let mask = |stick: &&[bool]| Array2::from_shape_fn(shape, |(i, j)| stick[i * grid.ny + j]);
        Self {
            tractions: states
                .tractions
                .iter()
                .map(|of| [of.q_x, of.q_y, of.p].map(field))
                .collect(),
            stick: states.stick.unwrap_or_default().iter().map(mask).collect(),
            sigma_B: states.sigma_B.to_vec(),
            eigenstress: states.eigenstress.to_vec(),
        }
    }

    /// Calls `f` with the states of the body, with a residual stress that replaces the body's
    /// if given.
    pub fn with_states<T>(
        &self,
        residual: Option<&ResidualStress>,
        stop: &Arc<AtomicBool>,
        f: impl FnOnce(States<'_>) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let tractions: Vec<_> = self
            .tractions
            .iter()
            .map(|[q_x, q_y, p]| Tractions {
                q_x: q_x.as_slice(),
                q_y: q_y.as_slice(),
                p: p.as_slice(),
            })
            .collect();
        let stick: Vec<&[bool]> = self
            .stick
            .iter()
            .map(|stick| stick.as_slice().unwrap_or_default())
            .collect();
        f(States {
            tractions: &tractions,
            sigma_B: &self.sigma_B,
            residual,
            eigenstress: &self.eigenstress,
            stick: Some(&stick),
            stop: stop.clone(),
            continuations: &[],
        })
    }

    /// Averages on cells twice as large, and on points twice as far apart for plastic strain.
    #[must_use]
    pub fn coarsened(&self, cells: &DoubledCells) -> Self {
        let shape = (cells.grid.nx, cells.grid.ny);
        let mean = |field: &Array2<f64>| {
            let means = cells.mean(&field.iter().copied().collect::<Vec<_>>());
            Array2::from_shape_fn(shape, |(i, j)| means[i * shape.1 + j])
        };
        let any = |field: &Array2<bool>| {
            let marked = cells.any(&field.iter().copied().collect::<Vec<_>>());
            Array2::from_shape_fn(shape, |(i, j)| marked[i * shape.1 + j])
        };
        let coarsen = |eigenstress: &Option<Eigenstress>| {
            eigenstress
                .as_ref()
                .map(|eigenstress| eigenstress.coarsened(cells))
        };
        Self {
            tractions: self
                .tractions
                .iter()
                .map(|t| t.each_ref().map(mean))
                .collect(),
            stick: self.stick.iter().map(any).collect(),
            sigma_B: self.sigma_B.clone(),
            eigenstress: self.eigenstress.iter().map(coarsen).collect(),
        }
    }
}

/// Growth of the plastic strain over a cycle, from the moment before it to its last. If the moment
/// before was not stored, it is counted from the first moment.
pub fn plastic_growth(cycle: &dyn CycleSource) -> Result<Growth, Error> {
    let last = cycle.moments(&[cycle.count() - 1])?;
    let before = match cycle.start()? {
        Some(before) => before,
        None => cycle.moments(&[0])?,
    };
    let first_eigenstress = |moments: &Moments| moments.eigenstress.first().cloned().flatten();
    let after = first_eigenstress(&last);
    Ok(after.map_or_else(Growth::default, |after| {
        after.growth_since(first_eigenstress(&before).as_ref())
    }))
}

/// The sections in which a body is looked at over a cycle, where none is asked for:
/// [`Line::for_outlines`] of the outlines of its moments, with the directions of the bulk stress along
/// x and of the residual stress.
pub fn main_sections(
    cycle: &dyn CycleSource,
    grid: &Grid,
    residual: &ResidualStress,
) -> Result<Vec<Line>, Error> {
    let (outlines, stretched) = outlines(cycle, grid)?;
    let all: Vec<&Outline> = outlines.iter().collect();
    let mut beside = residual.directions();
    if stretched {
        beside.push(0.0);
    }
    Ok(Line::for_outlines(&all, &beside))
}

/// Half of the largest width of a contact over a cycle in the direction of a line \[m\]; 0 without a
/// contact.
pub fn half_width(cycle: &dyn CycleSource, grid: &Grid, line: Line) -> Result<f64, Error> {
    let (outlines, _) = outlines(cycle, grid)?;
    let widths = outlines.iter().map(|of| of.half_width(line.azimuth()));
    Ok(widths.fold(0.0, f64::max))
}

/// The outlines of a contact at the moments of a cycle that have one, and whether a bulk stress acts at any
/// moment.
fn outlines(cycle: &dyn CycleSource, grid: &Grid) -> Result<(Vec<Outline>, bool), Error> {
    let which: Vec<usize> = (0..cycle.count())
        .step_by((cycle.count() / SECTION_MOMENTS).max(1))
        .collect();
    let (mut outlines, mut stretched) = (Vec::new(), false);
    for n in which {
        let now = cycle.moments(&[n])?;
        for ([q_x, q_y, p], sigma_B) in now.tractions.iter().zip(&now.sigma_B) {
            let tractions = Tractions {
                q_x: q_x.as_slice(),
                q_y: q_y.as_slice(),
                p: p.as_slice(),
            };
            if let Some(outline) = Outline::new(grid, &tractions) {
                outlines.push(outline);
                stretched |= *sigma_B != 0.0;
            }
        }
    }
    Ok((outlines, stretched))
}

/// Part of the largest traction by which the ends of a cycle may differ without a note.
const UNSETTLED: f64 = 0.02;

/// A note on a cycle whose tractions at the end differ from those at its start by more than
/// 0.02 of the largest one. `None` if the increment before the cycle was not stored.
pub fn note_on_cycle(cycle: &dyn CycleSource) -> Result<Option<String>, Error> {
    let much = traction_drift(cycle)?.filter(|much| *much > UNSETTLED);
    Ok(much.map(|much| {
        format!(
            "the cycle does not end as it began: tractions differ by up to {:.0} % of the largest one. The number holds \
             for this cycle; one more cycle of the path shows what later cycles change",
            100.0 * much
        )
    }))
}

/// Difference of the tractions at the end and at the start of a cycle, over the largest of both:
/// 0 for a steady cycle. `None` if the increment before the cycle was not stored.
pub fn traction_drift(cycle: &dyn CycleSource) -> Result<Option<f64>, Error> {
    let Some(start) = cycle.start()? else {
        return Ok(None);
    };
    let end = cycle.moments(&[cycle.count() - 1])?;
    let (Some(before), Some(after)) = (start.tractions.first(), end.tractions.first()) else {
        return Ok(None);
    };
    let (mut change, mut largest) = (0.0_f64, 0.0_f64);
    // Pressure and shear are scaled separately.
    let mut worst = 0.0_f64;
    for (n, (before, after)) in before.iter().zip(after).enumerate() {
        for (a, b) in before.iter().zip(after) {
            change = change.max((a - b).abs());
            largest = largest.max(a.abs()).max(b.abs());
        }
        // q_x and q_y together.
        if n != 0 {
            worst = worst.max(if largest > 0.0 { change / largest } else { 0.0 });
            (change, largest) = (0.0, 0.0);
        }
    }
    Ok(Some(worst))
}
