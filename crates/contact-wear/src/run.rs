//! The jumps of a run: their length, their errors, their end at an event.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use contact_core::Error;
use contact_core::plan::Plan;
use contact_core::scene::{History, Scene};

use super::attempt::Attempt;
use super::events::EventKind;
use super::events::{crossing, events, past_events, with_error};
use super::jump::Jump;
use super::loss::Worn;
use super::mixed_cells;
use super::model::Model;
use super::on_grid;
use super::passage::Passage;
use super::settings::{Jumps, Wear, WornThrough};
use super::slip_zone;
use super::spots;
use super::state::WearState;
use super::variable::FactorVariable;
use super::width::SweptScar;
use super::worn_start::WornStart;

/// The next length is CAUTIOUS (tol/error)^(1/2) times the last one, within SHORTER to LONGER.
const CAUTIOUS: f64 = 0.9;
const LONGER: f64 = 4.0;
const SHORTER: f64 = 0.2;
/// Depth of the first jump over the approach, about.
const FIRST_JUMP: f64 = 0.05;
/// Allowed change of the end pressure between a whole jump and two halves, over the tolerance of
/// the depth. It bounds the change of the pressure within a jump only: on the accepted surfaces the
/// pressure is solved anew.
const PRESSURE: f64 = 20.0;
/// Least length of a jump over all cycles.
const SHORTEST: f64 = 1e-9;
/// Growth of a grid whose need is not known.
const GRID_GROWTH: f64 = 1.4;
/// Most attempts of a jump, for its error and for the cycle of an event.
const TRIES: usize = 60;

/// A run over all cycles, jump by jump.
pub struct WearRun {
    pub(crate) scene: Scene,
    pub(crate) wear: Wear,
    pub(crate) model: Model,
    state: WearState,
    stop: Arc<AtomicBool>,
}

impl WearRun {
    /// Checks, chooses the open settings ([`Wear::complete`]), solves the lead-in and the first
    /// cycle; ends when `stop` is raised.
    pub fn new(scene: &Scene, wear: &Wear, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        Self::begin(scene, wear, None, stop)
    }

    /// Starts on worn surfaces; the count of their cycles continues.
    pub fn from_worn(
        scene: &Scene,
        wear: &Wear,
        start: &WornStart,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        Self::begin(scene, wear, Some(start), stop)
    }

    /// Starts a run on unworn surfaces, or on the given ones.
    fn begin(
        scene: &Scene,
        wear: &Wear,
        start: Option<&WornStart>,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let (scene, wear) = wear.complete(scene, stop)?;
        let mirror = Plan::new(&scene).mirror;
        let worn = match start {
            Some(start) => start.to_worn(&scene.grid, mirror)?,
            None => Worn::unworn(mirror.fold(&scene.h_init()).len()),
        };
        let events = past_events(&scene, &wear, &worn);
        let through = events.iter().any(|e| e.kind == EventKind::WornThrough);
        if through && wear.worn_through == WornThrough::Stop {
            let allowed = "\"go_on\" where a coating is worn through at the start";
            return Err(Error::invalid("wear.worn_through", "stop", allowed));
        }
        let model = Model::new(&scene, &wear, None, &worn, stop)?;
        let mut run = Self {
            state: WearState::new(
                worn,
                start.map_or(0.0, |start| start.dissipated),
                events,
                model.state(),
            ),
            scene,
            wear,
            model,
            stop: stop.clone(),
        };
        let before = run.state.to_jump(&run.model, &run.wear);
        run.state.lost_before = [before.depth, before.volume];
        run.state.next = run.first_jump()?;
        Ok(run)
    }

    /// Continues from a state of the same scene and wear, with the same bits as without the
    /// interruption.
    pub fn resume(
        scene: &Scene,
        wear: &Wear,
        state: WearState,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let (scene, wear) = wear.complete(scene, stop)?;
        let model = Model::new(&scene, &wear, Some(state.model.clone()), &state.worn, stop)?;
        if state.worn.depth.iter().any(|d| d.len() != model.cells()) {
            return Err(Error::invalid(
                "state",
                "of other cells",
                "one of this scene",
            ));
        }
        Ok(Self {
            scene,
            wear,
            model,
            state,
            stop: stop.clone(),
        })
    }

    /// The state after the last jump.
    pub fn state(&self) -> &WearState {
        &self.state
    }

    /// Cycles of the first jump, or of each jump if their number is given.
    fn first_jump(&mut self) -> Result<f64, Error> {
        let cycles = self.wear.cycles;
        match self.wear.jumps {
            Jumps::Number(n) | Jumps::Explicit(n) => Ok(cycles / n as f64),
            Jumps::Tolerance(_) => {
                let rate = self.rate()?;
                let first = if rate > 0.0 {
                    FIRST_JUMP * self.scene.reference_approach() / rate
                } else {
                    cycles
                };
                Ok(first.clamp(SHORTEST * cycles, cycles))
            }
        }
    }

    /// Largest growth of the gap in one cycle by the wear of one body \[m\].
    fn rate(&mut self) -> Result<f64, Error> {
        let loss = self.model.jump(&self.state.worn, 1.0, false)?;
        self.model.restore(&self.state.model);
        let deepest = loss.depth.iter().flatten().fold(0.0, |m: f64, w| m.max(*w));
        Ok(self.wear.opens() * deepest)
    }

    /// Does the next jump; returns `None` at the end. After an error the state is the state after
    /// the last jump.
    pub fn advance(&mut self) -> Option<Result<Jump, Error>> {
        let remaining = self.state.remaining(&self.wear);
        if self.state.ended || remaining <= SHORTEST * self.wear.cycles {
            return None;
        }
        let jump = self.jump(remaining);
        if jump.is_err() {
            self.model.restore(&self.state.model);
        }
        Some(jump.map_err(|error| self.explain_error(error)))
    }

    /// Adds the cycles done or the physical cause to an error.
    fn explain_error(&mut self, error: Error) -> Error {
        match error {
            Error::NotConverged {
                increment,
                solver,
                residual,
                tolerance,
                iterations,
                why,
            } if why.is_empty() => Error::NotConverged {
                why: self.explain_divergence(),
                increment,
                solver,
                residual,
                tolerance,
                iterations,
            },
            Error::OffGrid {
                extent_x,
                extent_y,
                needed,
                ..
            } => {
                // The touched side grows at least by as much as the contact alone asks.
                let grows = needed / extent_x.max(extent_y);
                let mut least = [extent_x, extent_y].map(|extent| extent * grows.max(GRID_GROWTH));
                if self.scene.grid.plane_strain {
                    least[1] = extent_y;
                }
                // An estimate that fits on the grid that the run has left leaves something out, such as the elastic
                // contact of many spots.
                let lengths = self.grid_lengths().filter(|lengths| {
                    lengths[0] > extent_x
                        || (lengths[1] > extent_y && !self.scene.grid.plane_strain)
                });
                let needed = lengths.map_or(least, |lengths| {
                    [lengths[0].max(extent_x), lengths[1].max(extent_y)]
                });
                Error::WornOffGrid {
                    cycles: self.state.cycles,
                    extent_x,
                    extent_y,
                    needed_x: needed[0],
                    needed_y: needed[1],
                }
            }
            error => error,
        }
    }

    /// Lengths of the grid that holds the scar of all cycles in gross slip, [`SweptScar::grid_lengths`]; `None`
    /// in a march.
    fn grid_lengths(&mut self) -> Option<[f64; 2]> {
        let ends = self.model.stroke()?;
        // The width that a bed leaves follows from the run alone.
        if self.wear.bed.is_some() {
            return None;
        }
        let cycle = self.model.jump(&self.state.worn, 1.0, false).ok()?;
        self.model.restore(&self.state.model);
        let area = self.model.pressing().cell_area();
        let times = self.wear.opens() * self.wear.cycles * area;
        let scar = SweptScar {
            scene: &self.scene,
            volumes: cycle
                .depth
                .each_ref()
                .map(|depth| times * depth.iter().sum::<f64>()),
            ends,
            half_width: self.wear.half_width,
        };
        scar.grid_lengths()
    }

    /// The physical cause of jumps that do not converge, as the end of a sentence: large wear in
    /// one cycle.
    fn explain_divergence(&mut self) -> String {
        let (rate, approach) = (self.rate().unwrap_or(0.0), self.scene.reference_approach());
        if rate < FIRST_JUMP * approach {
            return String::new();
        }
        format!(
            ": one cycle wears {rate:.1e} m, of an approach of {approach:.1e} m (k is in m^2/N, alpha in \
             m^3/J)"
        )
    }

    /// Cycles from now to the next row of a table over cycles, in the laws of wear or of friction.
    fn next_bend(&self) -> f64 {
        let now = self.state.cycles;
        let friction = self.scene.friction.history.iter();
        let friction = friction.filter(|history| history.of == History::Cycles);
        let friction = friction.flat_map(|history| history.table.iter().map(|(at, _)| *at));
        let laws = self
            .wear
            .bodies
            .iter()
            .flat_map(|body| body.bends(FactorVariable::Cycles));
        let behind = now * (1.0 + SHORTEST) + SHORTEST * self.wear.cycles;
        let ahead = friction.chain(laws).filter(|at| *at > behind);
        ahead.fold(f64::INFINITY, f64::min) - now
    }

    /// Tries a jump of at most `remaining` cycles, with shorter ones until its error is allowed and no event
    /// lies within it, and accepts it.
    fn jump(&mut self, remaining: f64) -> Result<Jump, Error> {
        let length = self.state.next;
        let mut n = length.min(remaining);
        // A negligible rest is included in this jump.
        if remaining - n < 1e-6 * n {
            n = remaining;
        }
        let to_bend = self.next_bend();
        n = n.min(to_bend);
        let (mut for_error, mut for_event) = (length, None);
        for retries in 0..TRIES {
            if self.stop.load(Ordering::Relaxed) {
                return Err(Error::Interrupted {
                    increment: self.state.jumps,
                });
            }
            self.model.restore(&self.state.model);
            let tried = self.attempt(n).and_then(|tried| self.check_on_grid(tried));
            let tried = match tried {
                Err(Error::NotConverged { .. }) if self.may_be_divided(n) => {
                    n *= SHORTER;
                    for_event = None;
                    continue;
                }
                tried => tried?,
            };
            if let Jumps::Tolerance(tolerance) = self.wear.jumps {
                let error = tried.error.max(tried.pressure_error / PRESSURE);
                let factor = CAUTIOUS * (tolerance / error.max(f64::MIN_POSITIVE)).sqrt();
                if error > tolerance && self.may_be_shorter(n) {
                    n *= factor.clamp(SHORTER, CAUTIOUS);
                    for_event = None;
                    continue;
                }
                for_error = n * factor.clamp(SHORTER, LONGER);
                if n == to_bend {
                    for_error = for_error.max(length);
                }
            }
            let stops = self.wear.worn_through == WornThrough::Stop;
            let passage = Passage {
                worn: &self.state.worn,
                half: &tried.half,
                whole: &tried.loss.depth,
            };
            if let Some(part) = crossing(&self.scene, &self.state.events, &passage) {
                // Iterates towards the cycle at which the first cell is worn through, from both
                // sides.
                let last = for_event.replace(n);
                if part < 1.0 - 1e-3 && retries + 1 < TRIES && last != Some(n * part) {
                    n *= part * (1.0 + 1e-4);
                    continue;
                }
                return self.accept(n, &tried, for_error, retries, stops);
            }
            return self.accept(n, &tried, for_error, retries, false);
        }
        Err(Error::NotConverged {
            increment: self.state.jumps + 1,
            solver: "wear",
            residual: n,
            tolerance: self.state.next,
            iterations: TRIES,
            why: String::new(),
        })
    }

    /// Fails if a jump wears cells at the border of the grid, since the scar then goes on beyond it even where
    /// the pressure is zero.
    fn check_on_grid(&self, tried: Attempt) -> Result<Attempt, Error> {
        let rows = self.model.pressing().rows();
        for depth in &tried.loss.depth {
            on_grid::check(&self.scene.grid, rows, depth, &[])?;
        }
        Ok(tried)
    }

    /// Checks that the run chooses the length of its jumps and may take fewer than n cycles.
    fn may_be_shorter(&self, n: f64) -> bool {
        matches!(self.wear.jumps, Jumps::Tolerance(_)) && n > SHORTEST * self.wear.cycles
    }

    /// Checks that a jump of n cycles that does not converge may be divided.
    fn may_be_divided(&self, n: f64) -> bool {
        !matches!(self.wear.jumps, Jumps::Explicit(_)) && n > SHORTEST * self.wear.cycles
    }

    /// Tries a jump of n cycles from the present state.
    fn attempt(&mut self, n: f64) -> Result<Attempt, Error> {
        let WearState { worn, model, .. } = &self.state;
        if matches!(self.wear.jumps, Jumps::Explicit(_)) {
            Attempt::explicit(&mut self.model, worn, n)
        } else {
            Attempt::implicit(&mut self.model, model, worn, n)
        }
    }

    /// Takes over a jump of n cycles that was tried: new state, events, results. `next` is the length of the
    /// next jump, and `ends` whether the run ends with this one.
    fn accept(
        &mut self,
        n: f64,
        tried: &Attempt,
        next: f64,
        retries: usize,
        ends: bool,
    ) -> Result<Jump, Error> {
        let mut worn = self.state.worn.clone();
        worn.add(&tried.loss);
        self.model.settle(&worn)?;
        let cycles = self.state.cycles + n;
        let passage = Passage {
            worn: &self.state.worn,
            half: &tried.half,
            whole: &tried.loss.depth,
        };
        let new = events(&self.scene, &self.wear, &self.state.events, &passage, n);
        let mut middle = self.state.worn.depth.clone();
        for (middle, half) in middle.iter_mut().zip(&tried.half) {
            middle.iter_mut().zip(half).for_each(|(w, half)| *w += half);
        }
        let area = self.model.pressing().cell_area();
        let output = self.model.output();
        let grown = worn.deepest() - self.state.worn.deepest();
        let by_spots = if output.stick_ratio > 0.0 {
            0.0
        } else {
            spots::depth_error(grown, output.p, self.model.pressing().rows())
        };
        let mixed = mixed_cells::depth_error(&self.wear.bodies, output.p, output.aerated);
        let by_spots = by_spots.hypot(mixed * grown.max(0.0));
        let by_border = self.model.border_error(&worn)?;
        let state = &mut self.state;
        for (sum, moved) in state.corrections.iter_mut().zip(&tried.correction) {
            sum.iter_mut()
                .zip(moved)
                .for_each(|(sum, moved)| *sum += moved);
        }
        state.spot_error += by_spots;
        (state.worn, state.model) = (worn, self.model.state());
        state.jumps += 1;
        state.cycles = cycles;
        state.dissipated += tried.loss.dissipated;
        state.next = next;
        state.ended = ends;
        let seen = state.to_jump(&self.model, &self.wear);
        let by_border = state.lost_by_slip(&seen) * by_border;
        let of_jumps = seen.depth_error + state.over_deepest(by_border);
        let of_spots = state.over_deepest(state.spot_error);
        let [of_depth, of_volume] =
            slip_zone::relative_cell_errors(seen.slip_cells, seen.stick_ratio);
        let worn = state.over_deepest(1.0) > 0.0;
        let of_cells = |part: f64| if worn { of_jumps.hypot(part) } else { of_jumps };
        let jump = Jump {
            depth_error: of_cells(of_depth.hypot(of_spots)),
            volume_error: of_cells(of_volume),
            length: n,
            error: tried.error,
            pressure_error: tried.pressure_error,
            p_max_error: seen.p_max_error.hypot(tried.pressure_error),
            retries,
            mu: tried.loss.mean_mu(seen.mu),
            mu_error: seen.mu_error.hypot(tried.mu_error),
            volume_halfway: middle.each_ref().map(|w| w.iter().sum::<f64>() * area),
            depth_halfway: middle
                .each_ref()
                .map(|w| w.iter().fold(0.0, |m: f64, w| m.max(*w))),
            ..seen
        };
        let part = jump.depth_error;
        let new = new.into_iter().map(|event| with_error(event, part));
        state.events.extend(new);
        state.history.push(jump.clone());
        Ok(jump)
    }

    /// Sentences on settings and results that are allowed but unlikely.
    pub fn doubts(&self) -> Vec<String> {
        let p_max = self.history().last().map_or(0.0, |jump| jump.p_max);
        let exceeded = self.wear.yield_stress.filter(|limit| p_max > *limit);
        let pressure = exceeded.map(|limit| {
            format!(
                "the largest pressure, {:.0} MPa, is above wear.yield_stress, {:.0} MPa. A core that hardly wears would \
                 yield: it would be wider and less loaded",
                1e-6 * p_max,
                1e-6 * limit
            )
        });
        self.wear.doubts().into_iter().chain(pressure).collect()
    }

    /// Every jump so far.
    pub fn history(&self) -> &[Jump] {
        &self.state.history
    }

    /// Checks that the fields after the last jump must be stored: when the cycles have grown, and
    /// at the end. Records that they are stored.
    pub fn takes_block(&mut self) -> bool {
        let ends =
            self.state.ended || self.state.remaining(&self.wear) <= SHORTEST * self.wear.cycles;
        let keeps = ends || self.state.has_grown(&self.wear);
        if keeps {
            self.state.kept_at = self.state.cycles;
        }
        keeps
    }

    /// The scene that wears.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The wear settings.
    pub fn wear(&self) -> &Wear {
        &self.wear
    }
}
