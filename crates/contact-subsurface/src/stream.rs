//! Stress over the load path, increment by increment, without keeping the increments.
//!
//! [`Stream`] collects the tractions of a few increments, computes their stresses together, since
//! they share the kernels, and passes them to an [`Accumulate`] depth by depth:
//! [`super::Envelope`], [`super::Largest`], or a pair of accumulators.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::march::{Increment, March, Observer};
use contact_core::scene::{Body, Grid, Profile, ResidualStress};
use ndarray::Array2;
use stress_tensor::StressTensor;

use super::{
    Border, Depth, Eigenstress, EigenstressSolver, Line, Points, Section, Side, Slices, States,
};

/// Increments whose stresses below a line are computed together: the kernels of a depth cost about
/// as much as the product with the tractions of ten increments.
const BATCH: usize = 32;
/// Increments that are computed together for whole planes, whose transforms fill the memory.
const BATCH_OF_PLANES: usize = 8;

/// A moment of the load path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Increment, from 1.
    pub increment: usize,
    /// Branch of the load path, from 0.
    pub branch: usize,
    /// Bulk stress of the body at that moment \[Pa\], part of the stress; 0 to leave it out.
    pub sigma_B: f64,
}

impl Moment {
    /// The end of an increment, in the body `side`.
    pub fn at_end(increment: &Increment, side: Side) -> Self {
        let loads = &increment.point.loads;
        Self {
            increment: increment.index,
            branch: increment.point.branch,
            sigma_B: match side {
                Side::Body1 => loads.sigma_B1,
                Side::Body2 => loads.sigma_B,
            },
        }
    }
}

/// A quantity accumulated over the stresses of a path.
pub trait Accumulate: Sync {
    /// The accumulator of one depth.
    type Accumulator: Send;

    /// Creates the accumulator before the first increment.
    fn start(&self, depth: Depth, places: usize) -> Self::Accumulator;

    /// Takes the stress of a moment, shape (6, places) \[Pa\]; the places are those along the line,
    /// or the cells of the plane in row-major order. Depths are worked on in parallel, the moments
    /// of each in order.
    fn add(&self, kept: &mut Self::Accumulator, moment: Moment, stress: &Array2<f64>);

    /// Takes the stress on the surface where the line of the moment last added crosses the rim of
    /// the contact and the border of the stick zone (default: ignores it).
    fn add_borders(&self, _kept: &mut Self::Accumulator, _borders: &[(Border, StressTensor)]) {}
}

impl<A: Accumulate, B: Accumulate> Accumulate for (A, B) {
    type Accumulator = (A::Accumulator, B::Accumulator);

    /// The accumulators of both parts.
    fn start(&self, depth: Depth, places: usize) -> Self::Accumulator {
        (self.0.start(depth, places), self.1.start(depth, places))
    }

    /// Adds the stress of a moment to both parts.
    fn add(&self, kept: &mut Self::Accumulator, moment: Moment, stress: &Array2<f64>) {
        self.0.add(&mut kept.0, moment, stress);
        self.1.add(&mut kept.1, moment, stress);
    }

    /// Adds the stress on borders to both parts.
    fn add_borders(&self, kept: &mut Self::Accumulator, borders: &[(Border, StressTensor)]) {
        self.0.add_borders(&mut kept.0, borders);
        self.1.add_borders(&mut kept.1, borders);
    }
}

/// A moment, its tractions q_x, q_y, p, the cells that stick, and the stress of the plastic strain.
type PendingMoment = (Moment, [Array2<f64>; 3], Array2<bool>, Option<Eigenstress>);

/// The stresses below a line, or on whole planes, over a load path. As an [`Observer`] it takes
/// every increment of a run; [`Self::push`] takes the increments of a store.
pub struct Stream<A: Accumulate> {
    body: Body,
    side: Side,
    grid: Grid,
    /// `None` for whole planes.
    line: Option<Line>,
    depths: Vec<Depth>,
    accumulate: A,
    kept: Vec<A::Accumulator>,
    /// True if the tractions belong to contacts.
    rim: bool,
    residual: ResidualStress,
    waiting: Vec<PendingMoment>,
    /// Set up with the first increment of a march.
    eigenstresses: Option<EigenstressSolver>,
    stop: Arc<AtomicBool>,
}

impl<A: Accumulate> Stream<A> {
    /// Below `line`, or on the whole planes without one, at the `depths` of the body `side` on a
    /// grid.
    pub fn new(
        body: &Body,
        side: Side,
        grid: &Grid,
        line: Option<Line>,
        depths: Vec<Depth>,
        accumulate: A,
    ) -> Result<Self, Error> {
        // Fails now instead of after a long run.
        if let Some(line) = line {
            Section::new(body, side, grid, line, States::default())?;
        } else {
            Slices::new(body, side, grid, States::default())?;
        }
        let places = line.map_or(grid.cells(), |line| line.places(grid).len());
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
            rim: false,
            residual: ResidualStress::from_body(body),
            waiting: Vec::with_capacity(BATCH),
            eigenstresses: None,
            stop: Arc::default(),
        })
    }

    /// Raising `flag` ends the computation with [`Error::Interrupted`]; the accumulators are then
    /// invalid.
    pub fn stop_on(&mut self, flag: Arc<AtomicBool>) {
        self.stop = flag;
    }

    /// Sets whether the tractions belong to contacts, with rims and stick borders ([`States::stick`]). By
    /// default they are constant in each cell.
    #[must_use]
    pub fn rim(mut self, rim: bool) -> Self {
        self.rim = rim;
        self
    }

    /// Sets the residual stress of every layer, which replaces the stress of the body:
    /// [`ResidualStress::from_profiles`].
    pub fn residual(mut self, residual: &[Profile]) -> Result<Self, Error> {
        self.residual = ResidualStress::from_profiles(&self.body, residual)?;
        Ok(self)
    }

    /// Takes the tractions q_x, q_y, p of a moment \[Pa\] and the cells that stick, each of shape
    /// (nx, ny), and the residual stress of plastic strain where the body has yielded.
    pub fn push(
        &mut self,
        moment: Moment,
        tractions: [Array2<f64>; 3],
        stick: Array2<bool>,
        eigenstress: Option<Eigenstress>,
    ) -> Result<(), Error> {
        let shape = (self.grid.nx, self.grid.ny);
        let [q_x, q_y, p] = &tractions;
        let shapes = [("q_x", q_x.dim()), ("q_y", q_y.dim()), ("p", p.dim())];
        for (key, found) in shapes.into_iter().chain([("stick", stick.dim())]) {
            if found != shape {
                let allowed = format!("of the shape of the grid, {shape:?}");
                return Err(Error::invalid(key, format!("of shape {found:?}"), allowed));
            }
        }
        self.waiting.push((moment, tractions, stick, eigenstress));
        let batch = if self.line.is_some() {
            BATCH
        } else {
            BATCH_OF_PLANES
        };
        if self.waiting.len() >= batch {
            self.flush()?;
        }
        Ok(())
    }

    /// The accumulator of each depth, with all that was pushed.
    pub fn finish(mut self) -> Result<(Vec<Depth>, Vec<A::Accumulator>), Error> {
        self.flush()?;
        Ok((self.depths, self.kept))
    }

    /// Computes the stresses of the moments that wait, and hands them to the accumulators.
    fn flush(&mut self) -> Result<(), Error> {
        if self.waiting.is_empty() {
            return Ok(());
        }
        let tractions: Vec<_> = self
            .waiting
            .iter()
            .map(|(_, [q_x, q_y, p], ..)| Tractions {
                q_x: q_x.as_slice(),
                q_y: q_y.as_slice(),
                p: p.as_slice(),
            })
            .collect();
        let sigma_B: Vec<f64> = self.waiting.iter().map(|(m, ..)| m.sigma_B).collect();
        let stick = self.waiting.iter().map(|(_, _, stick, _)| stick.as_slice());
        let stick: Vec<&[bool]> = stick.map(Option::unwrap_or_default).collect();
        let stresses = self.waiting.iter().map(|(.., stress)| stress.clone());
        let eigenstress: Vec<_> = stresses.collect();
        let states = States {
            tractions: &tractions,
            sigma_B: &sigma_B,
            residual: Some(&self.residual),
            eigenstress: &eigenstress,
            stick: self.rim.then_some(&stick[..]),
            stop: self.stop.clone(),
            continuations: &[],
        };
        let (body, side, grid) = (&self.body, self.side, &self.grid);
        let (depths, kept) = (&self.depths, &mut self.kept);
        let borders = match (self.line, depths.first()) {
            (Some(line), Some(first)) if self.rim && first.z <= 0.0 => {
                stress_on_borders(body, side, grid, line, &states)?
            }
            _ => Vec::new(),
        };
        let add = |kept: &mut A::Accumulator, depth: Depth, stresses: &[Array2<f64>]| {
            for (n, ((moment, ..), stress)) in self.waiting.iter().zip(stresses).enumerate() {
                self.accumulate.add(kept, *moment, stress);
                if let Some(borders) = borders.get(n).filter(|_| depth.z <= 0.0) {
                    self.accumulate.add_borders(kept, borders);
                }
            }
        };
        if let Some(line) = self.line {
            Section::new(body, side, grid, line, states)?.pass_stress(depths, kept, add)?;
        } else {
            Slices::new(body, side, grid, states)?.pass_stress(depths, kept, add)?;
        }
        self.waiting.clear();
        Ok(())
    }
}

/// The stress of every state on the surface where the line crosses the rim of the contact and the
/// border of its stick zone.
fn stress_on_borders(
    body: &Body,
    side: Side,
    grid: &Grid,
    line: Line,
    states: &States<'_>,
) -> Result<Vec<Vec<(Border, StressTensor)>>, Error> {
    let of_state = |(n, tractions): (usize, &Tractions<'_>)| {
        let stick = states.stick.and_then(|stick| stick.get(n));
        let one_state = States {
            tractions: std::slice::from_ref(tractions),
            sigma_B: states.sigma_B.get(n..=n).unwrap_or_default(),
            eigenstress: states.eigenstress.get(n..=n).unwrap_or_default(),
            stick: Some(stick.map_or(&[], std::slice::from_ref)),
            ..states.clone()
        };
        let points = Points::new(body, side, grid, one_state)?;
        let borders = points.borders(0, Some(line));
        let top = Depth { z: 0.0, layer: 0 };
        let places: Vec<_> = borders.iter().map(|b| (b.x, b.y, top)).collect();
        let stress = points.stress(&places)?.swap_remove(0);
        Ok(borders.into_iter().zip(stress).collect())
    };
    states.tractions.iter().enumerate().map(of_state).collect()
}

impl<A: Accumulate> Observer for Stream<A> {
    /// Takes the tractions, stick cells and plastic strain at the end of an increment.
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        let fields = march.fields();
        let moment = Moment::at_end(increment, self.side);
        let (side, scene) = (self.side, march.scene());
        let eigenstresses = self
            .eigenstresses
            .get_or_insert_with(|| EigenstressSolver::new(scene, side));
        let eigenstress = eigenstresses.eigenstress(fields.yielded.as_deref())?;
        let tractions = [fields.q_x, fields.q_y, fields.p];
        self.push(moment, tractions, fields.stick, eigenstress)
    }
}
