//! Stress over the load path, increment by increment, without keeping the increments.
//!
//! [`Stream`] collects the tractions of a few increments, computes their stresses together, since
//! they share the kernels, and hands them on depth by depth. What becomes of them is an
//! [`Accumulate`]: [`super::Envelope`] is one; a fatigue criterion on critical planes is another.

use ndarray::Array2;

use super::{Depth, Line, Section, Side};
use crate::convolution::Tractions;
use crate::error::Error;
use crate::march::{Increment, March, Observer};
use crate::scene::{Body, Grid};

/// Increments whose stresses are computed together: the kernels of a depth cost about as much as
/// the product with the tractions of ten increments.
const BATCH: usize = 32;

/// Which moment of the load path a stress belongs to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Increment, from 1.
    pub increment: usize,
    /// Branch of the load path, from 0.
    pub branch: usize,
}

/// What is kept of the stresses that pass by.
pub trait Accumulate: Sync {
    /// What is kept of the line at one depth.
    type Kept: Send;

    /// Before the first increment.
    fn start(&self, depth: Depth, places: usize) -> Self::Kept;

    /// Takes the stress of a moment, shape (6, places along the line) \[Pa\]. Depths are worked on
    /// in parallel, the moments of each in order.
    fn add(&self, kept: &mut Self::Kept, moment: Moment, stress: &Array2<f64>);
}

/// The stresses below a line over a load path. As an [`Observer`] it takes every increment of a
/// run; [`Self::push`] takes those of a store.
pub struct Stream<A: Accumulate> {
    body: Body,
    side: Side,
    grid: Grid,
    line: Line,
    depths: Vec<Depth>,
    accumulate: A,
    kept: Vec<A::Kept>,
    waiting: Vec<(Moment, [Array2<f64>; 3])>,
}

impl<A: Accumulate> Stream<A> {
    /// Below `line` at the `depths` of the body `side` on a grid.
    pub fn new(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Line,
        depths: Vec<Depth>,
        accumulate: A,
    ) -> Result<Self, Error> {
        // Refuses now what would fail after a long run.
        Section::new(body, side, grid, line, &[])?;
        let places = match line {
            Line::AlongX(_) => grid.nx,
            Line::AlongY(_) => grid.ny,
        };
        let kept = depths
            .iter()
            .map(|d| accumulate.start(*d, places))
            .collect();
        Ok(Self {
            body: body.clone(),
            side,
            grid: *grid,
            line,
            depths,
            accumulate,
            kept,
            waiting: Vec::with_capacity(BATCH),
        })
    }

    /// Takes the tractions q_x, q_y, p of a moment, each of shape (nx, ny) \[Pa\].
    pub fn push(&mut self, moment: Moment, tractions: [Array2<f64>; 3]) -> Result<(), Error> {
        self.waiting.push((moment, tractions));
        if self.waiting.len() >= BATCH {
            self.flush()?;
        }
        Ok(())
    }

    /// What was kept at each depth, with all that was pushed.
    pub fn finish(mut self) -> Result<(Vec<Depth>, Vec<A::Kept>), Error> {
        self.flush()?;
        Ok((self.depths, self.kept))
    }

    fn flush(&mut self) -> Result<(), Error> {
        if self.waiting.is_empty() {
            return Ok(());
        }
        let states: Vec<_> = self
            .waiting
            .iter()
            .map(|(_, [q_x, q_y, p])| Tractions {
                q_x: q_x.as_slice(),
                q_y: q_y.as_slice(),
                p: p.as_slice(),
            })
            .collect();
        let section = Section::new(&self.body, self.side, &self.grid, self.line, &states)?;
        section.pass_stress(&self.depths, &mut self.kept, |kept, stresses| {
            for ((moment, _), stress) in self.waiting.iter().zip(stresses) {
                self.accumulate.add(kept, *moment, stress);
            }
        })?;
        self.waiting.clear();
        Ok(())
    }
}

impl<A: Accumulate> Observer for Stream<A> {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        let fields = march.fields();
        let moment = Moment {
            increment: increment.index,
            branch: increment.point.branch,
        };
        self.push(moment, [fields.q_x, fields.q_y, fields.p])
    }
}
