//! The worn depth of each cell within a jump, under the loading of one cycle.
//!
//! In n equal cycles a cell follows
//!
//! ```text
//! dw/dN = r(w, e, N),   de/dN = D,
//! ```
//!
//! r being the depth per cycle by the law of the bare layer, e the energy per area and D its growth
//! per cycle. The cells are independent of one another. A smooth r is integrated by Simpson's rule
//! along the slope at the start of a step. A step ends at the bottom of a layer and at the places
//! of a table of the energy. Bisection locates other bends of r, for example of a law of the user
//! that stops. A law that bends in N is integrated from bend to bend.
//!
//! The depth at another pressure follows from the last rate: with r proportional to the loading, w is a
//! function of N times the loading, so that `dw/dP = n r_end/P`.

use contact_core::Error;

use super::law::{BodyWear, CellCycle, layer_at};
use super::variable::FactorVariable;

/// Difference of the rates at the start, in the middle and at the end of a step, over the largest of
/// them, up to which the rate counts as smooth.
const SMOOTH: f64 = 0.1;
/// Error of the place of a bend, over its distance from the start of the step, that ends the bisection,
/// and most bisections.
const LOCATED: f64 = 1e-4;
const BISECTIONS: usize = 40;
/// Most steps of a cell between two bends in N.
const STEPS: usize = 40;
/// Halvings of the cycles that locate a bend in N, and the departure from a straight line, over the
/// largest rate, from which a law bends.
const HALVINGS: u32 = 14;
const STRAIGHT: f64 = 1e-3;
/// A step ends short of a bend by this part of itself, so that the law before the bend holds.
const SHORT: f64 = 1e-9;

/// Coefficients of a body in a jump, `depth = n k pressure_times_slip` \[1/Pa\].
pub(super) struct Coefficients {
    /// k of the depth of all cycles.
    pub(super) mean: Vec<f64>,
    /// k of the last cycle.
    pub(super) end: Vec<f64>,
    /// Mean coefficient of friction of all cycles; empty where it does not follow the layer.
    pub(super) mu: Vec<f64>,
}

/// Factor of the dissipated energy of a cell while a layer is bare, over the energy of the cycle.
pub(super) type LayerFactor<'a> = dyn Fn(usize, usize) -> f64 + 'a;

/// Computes the coefficients of a body in n cycles that begin at the state in `cycle`. `coatings`
/// are the thicknesses of its layers \[m\], `friction` the factor where friction follows them.
pub(super) fn coefficients(
    body: &BodyWear,
    cycle: &CellCycle<'_>,
    (coatings, friction): (&[f64], Option<&LayerFactor<'_>>),
    n: f64,
) -> Result<Coefficients, Error> {
    let per_loading = |depth: &[f64], cycles: f64| -> Vec<f64> {
        let cells = depth.iter().zip(cycle.pressure_times_slip);
        cells
            .map(|(d, loading)| {
                if *loading > 0.0 {
                    d / (cycles * loading)
                } else {
                    0.0
                }
            })
            .collect()
    };
    let course = Course {
        friction,
        ..Course::new(body, cycle, coatings)
    };
    let mut state = State {
        lost: vec![0.0; cycle.worn.len()],
        worn: cycle.worn.to_vec(),
        energy: cycle.energy.to_vec(),
    };
    let first = course.rate(&state, cycle.cycles)?;
    if body.is_steady() && friction.is_none() {
        let k = per_loading(&first, 1.0);
        return Ok(Coefficients {
            end: k.clone(),
            mean: k,
            mu: Vec::new(),
        });
    }
    for (from, to) in course.straight_parts(&state, &first, [cycle.cycles, cycle.cycles + n])? {
        course.advance(&mut state, from, to)?;
    }
    let last = course.rate(&state, cycle.cycles + n)?;
    // Where the rate stays the same, the sum of its steps differs from it by rounding.
    let first = per_loading(&first, 1.0);
    let use_first_if_equal = |(mean, first): (f64, f64)| {
        if (mean - first).abs() <= 1e-9 * first {
            first
        } else {
            mean
        }
    };
    Ok(Coefficients {
        mean: per_loading(&state.lost, n)
            .into_iter()
            .zip(first)
            .map(use_first_if_equal)
            .collect(),
        end: per_loading(&last, 1.0),
        mu: if friction.is_some() {
            let growth = state.energy.iter().zip(cycle.energy);
            let growth: Vec<f64> = growth.map(|(end, start)| end - start).collect();
            per_loading(&growth, n)
        } else {
            Vec::new()
        },
    })
}

/// The state after a part of the step of each cell.
type StateAtPart<'a> = dyn Fn(&dyn Fn(usize) -> f64) -> State + 'a;

/// Depth and energy of every cell.
#[derive(Clone)]
struct State {
    /// Depth since the jump began. The total depth does not hold it to the last digits \[m\].
    lost: Vec<f64>,
    /// \[m\]
    worn: Vec<f64>,
    /// \[J/m^2\]
    energy: Vec<f64>,
}

struct Course<'a> {
    body: &'a BodyWear,
    cycle: &'a CellCycle<'a>,
    coatings: &'a [f64],
    /// Depths at which a layer ends \[m\], ascending.
    bottoms: Vec<f64>,
    /// Energies at which a table has a place \[J/m^2\], ascending.
    energies: Vec<f64>,
    /// Factor of the energy by the bare layer.
    friction: Option<&'a LayerFactor<'a>>,
}

impl<'a> Course<'a> {
    /// Follows the cells of a body through its layers, from the state in `cycle`.
    fn new(body: &'a BodyWear, cycle: &'a CellCycle<'a>, coatings: &'a [f64]) -> Self {
        let mut bottom = 0.0;
        let depths_below = |h: &f64| {
            bottom += h;
            bottom
        };
        Self {
            bottoms: coatings.iter().map(depths_below).collect(),
            energies: body.bends(FactorVariable::Energy),
            body,
            cycle,
            coatings,
            friction: None,
        }
    }

    /// Energy per area and cycle of a cell at a worn depth \[J/m^2\].
    fn dissipated(&self, c: usize, worn: f64) -> f64 {
        let factor = self.friction.map(|f| f(c, layer_at(worn, self.coatings)));
        self.cycle.dissipated[c] * factor.unwrap_or(1.0)
    }

    /// Depth per cycle of every cell \[m\], at a state and a number of cycles.
    fn rate(&self, state: &State, cycles: f64) -> Result<Vec<f64>, Error> {
        let of_layers: Vec<f64>;
        let dissipated = if self.friction.is_some() {
            let cells = state.worn.iter().enumerate();
            of_layers = cells.map(|(c, worn)| self.dissipated(c, *worn)).collect();
            &of_layers[..]
        } else {
            self.cycle.dissipated
        };
        let cycle = CellCycle {
            worn: &state.worn,
            energy: &state.energy,
            dissipated,
            cycles,
            ..*self.cycle
        };
        let mut depth = vec![0.0; state.worn.len()];
        self.body.depth(&cycle, self.coatings, &mut depth)?;
        Ok(depth)
    }

    /// Divides the cycles `from` to `to` at the bends that the rates of a state have in N, into parts in which
    /// they are straight.
    fn straight_parts(
        &self,
        state: &State,
        first: &[f64],
        [from, to]: [f64; 2],
    ) -> Result<Vec<(f64, f64)>, Error> {
        let mut parts = Vec::new();
        let last = self.rate(state, to)?;
        let mut open = vec![(from, to, first.to_vec(), last, 0)];
        let mut largest = vec![0.0_f64; first.len()];
        while let Some((from, to, first, last, halvings)) = open.pop() {
            let half = 0.5 * (from + to);
            let middle = self.rate(state, half)?;
            let mut bends = false;
            for c in 0..middle.len() {
                largest[c] = largest[c].max(first[c]).max(middle[c]).max(last[c]);
                let off = (middle[c] - 0.5 * (first[c] + last[c])).abs();
                bends |= off > STRAIGHT * largest[c];
            }
            if bends && halvings < HALVINGS {
                open.push((half, to, middle.clone(), last, halvings + 1));
                open.push((from, half, first, middle, halvings + 1));
            } else {
                parts.push((from, to));
            }
        }
        Ok(parts)
    }

    /// Advances every cell from one number of cycles to another. The law is evaluated at the cycles
    /// in the middle, which is exact where it is straight in N.
    fn advance(&self, state: &mut State, from: f64, to: f64) -> Result<(), Error> {
        let middle = 0.5 * (from + to);
        let cells = state.worn.len();
        let mut remaining = vec![to - from; cells];
        for step in 1..=STEPS {
            let first = self.rate(state, middle)?;
            let steps: Vec<CellStep> = (0..cells)
                .map(|c| self.next_step(state, c, first[c], remaining[c]))
                .collect();
            let state_at = |part: &dyn Fn(usize) -> f64| State {
                lost: Vec::new(),
                worn: (0..cells)
                    .map(|c| steps[c].worn(state, c, part(c)))
                    .collect(),
                energy: (0..cells)
                    .map(|c| steps[c].energy(state, c, part(c)))
                    .collect(),
            };
            let half = self.rate(&state_at(&|_| 0.5), middle)?;
            let last = self.rate(&state_at(&|_| 1.0 - SHORT), middle)?;
            let smooth = |c: usize| {
                let apart = (last[c] - first[c]).abs().max((half[c] - first[c]).abs());
                apart <= SMOOTH * first[c].max(half[c]).max(last[c])
            };
            let mut end: Vec<Option<f64>> = vec![None; cells];
            let mut mean: Vec<f64> = (0..cells)
                .map(|c| (first[c] + 4.0 * half[c] + last[c]) / 6.0)
                .collect();
            let bent: Vec<usize> = (0..cells)
                .filter(|&c| steps[c].cycles > 0.0 && !smooth(c))
                .collect();
            if !bent.is_empty() && step < STEPS {
                let bends = self.find_bends(&bent, &state_at, [&first, &half, &last], middle)?;
                for c in bent {
                    (end[c], mean[c]) = (Some(bends[c].0), 0.5 * (first[c] + bends[c].1));
                }
            }
            for c in 0..cells {
                let part = end[c].unwrap_or(1.0);
                let passed = part * steps[c].cycles;
                state.energy[c] += self.dissipated(c, state.worn[c]) * passed;
                if part == 1.0 && steps[c].ends_at.is_some() && step < STEPS {
                    let bottom = steps[c].ends_at.unwrap_or_default();
                    state.lost[c] += bottom - state.worn[c];
                    state.worn[c] = bottom;
                } else {
                    state.lost[c] += mean[c] * passed;
                    state.worn[c] += mean[c] * passed;
                }
                remaining[c] = (remaining[c] - passed).max(0.0);
            }
            if remaining
                .iter()
                .all(|remaining| *remaining <= SHORT * (to - from))
            {
                break;
            }
        }
        Ok(())
    }

    /// The next step of cell c, with the rate `first` and `remaining` cycles to go: to their end, to the bottom
    /// of its layer, or to the next place of a table.
    fn next_step(&self, state: &State, c: usize, first: f64, remaining: f64) -> CellStep {
        let grows = self.dissipated(c, state.worn[c]).max(0.0);
        let mut step = CellStep {
            first,
            grows,
            cycles: remaining,
            ends_at: None,
        };
        let energy = state.energy[c] * (1.0 + SHORT);
        let next_energy = self
            .energies
            .iter()
            .find(|energy_place| **energy_place > energy);
        if let Some(cycles) =
            next_energy.map(|energy_place| (energy_place - state.energy[c]) / grows)
        {
            step.cycles = step.cycles.min(cycles);
        }
        let bottom = self.bottoms.iter().find(|bottom| **bottom > state.worn[c]);
        if let Some(bottom) = bottom.filter(|_| first > 0.0) {
            let cycles = (bottom - state.worn[c]) / first;
            if cycles <= step.cycles {
                (step.cycles, step.ends_at) = (cycles, Some(*bottom));
            }
        }
        step
    }

    /// Finds the bend in the rate of cells that are `bent`: the part of the step just behind it,
    /// and the rate just before.
    fn find_bends(
        &self,
        bent: &[usize],
        state_at: &StateAtPart<'_>,
        [first, half, last]: [&[f64]; 3],
        cycles: f64,
    ) -> Result<Vec<(f64, f64)>, Error> {
        let cells = first.len();
        let is_past_middle = |c: usize| (last[c] - first[c]).abs() >= (half[c] - first[c]).abs();
        let new_rate: Vec<f64> = (0..cells)
            .map(|c| if is_past_middle(c) { last[c] } else { half[c] })
            .collect();
        let mut low = vec![0.0; cells];
        let mut high: Vec<f64> = (0..cells)
            .map(|c| if is_past_middle(c) { 1.0 } else { 0.5 })
            .collect();
        let mut before = first.to_vec();
        for _ in 0..BISECTIONS {
            if bent.iter().all(|&c| high[c] - low[c] <= LOCATED * high[c]) {
                break;
            }
            let rate = self.rate(&state_at(&|c| 0.5 * (low[c] + high[c])), cycles)?;
            for c in 0..cells {
                let middle = 0.5 * (low[c] + high[c]);
                if (rate[c] - first[c]).abs() <= (rate[c] - new_rate[c]).abs() {
                    (low[c], before[c]) = (middle, rate[c]);
                } else {
                    high[c] = middle;
                }
            }
        }
        Ok(high.into_iter().zip(before).collect())
    }
}

/// A step of a cell along the slope at its start.
struct CellStep {
    /// Depth per cycle \[m\].
    first: f64,
    /// Energy per area and cycle \[J/m^2\].
    grows: f64,
    cycles: f64,
    /// The bottom of the layer, if the step ends there \[m\].
    ends_at: Option<f64>,
}

impl CellStep {
    /// Worn depth of cell c after a part of the step \[m\].
    fn worn(&self, state: &State, c: usize, part: f64) -> f64 {
        state.worn[c] + part * self.cycles * self.first
    }

    /// Energy per area of cell c after a part of the step \[J/m^2\].
    fn energy(&self, state: &State, c: usize, part: f64) -> f64 {
        state.energy[c] + part * self.cycles * self.grows
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{Coefficients, coefficients};
    use contact_core::Error;

    use crate::{Archard, BodyWear, CellCycle, Factor, FactorVariable, Law, Varying};

    /// Ways from a thousandth of what wears a film to a thousand times it.
    const WAYS: [f64; 7] = [1e-3, 0.1, 0.9, 1.1, 3.0, 50.0, 1e3];

    /// The mean depth of `n` cycles in each cell, by the coefficients of a jump.
    fn worn(body: &BodyWear, coatings: &[f64], n: f64) -> Vec<f64> {
        let none = [0.0; WAYS.len()];
        let cycle = CellCycle {
            pressure_times_slip: &WAYS.map(|way| way / n),
            slip_distance: &WAYS,
            dissipated: &WAYS.map(|way| way / n),
            worn: &none,
            energy: &none,
            cycles: 100.0,
            frequency: f64::NAN,
            ..CellCycle::default()
        };
        let Coefficients { mean, .. } = coefficients(body, &cycle, (coatings, None), n).unwrap();
        mean.iter().zip(WAYS).map(|(k, way)| k * way).collect()
    }

    fn near(found: &[f64], exact: impl Fn(f64) -> f64, within: f64) {
        for (found, way) in found.iter().zip(WAYS) {
            let exact = exact(way);
            assert!(
                (found - exact).abs() <= within * exact,
                "way {way}: {found}, exact {exact}"
            );
        }
    }

    #[derive(Debug)]
    struct Own(fn(f64, f64) -> f64);

    impl Law for Own {
        fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error> {
            for (n, depth) in depth.iter_mut().enumerate() {
                *depth = cycle.pressure_times_slip[n] * (self.0)(cycle.worn[n], cycle.cycles);
            }
            Ok(())
        }
    }

    #[test]
    fn a_law_that_stops_at_a_depth_gives_that_depth() {
        let film = BodyWear::with_law(Own(|worn, _| if worn < 1.0 { 1.0 } else { 0.0 }));
        near(&worn(&film, &[], 1000.0), |way| way.min(1.0), 2e-4);
    }

    #[test]
    fn a_law_that_stops_within_the_jump_gives_the_cycles_before() {
        let until = BodyWear::with_law(Own(|_, cycles| if cycles < 400.0 { 1.0 } else { 0.0 }));
        near(&worn(&until, &[], 1000.0), |way| 0.3 * way, 1e-3);
    }

    #[test]
    fn each_layer_wears_by_its_own_law() {
        let archard = |k: f64| -> Arc<dyn Law> { Arc::new(Archard { k, threshold: 0.0 }) };
        let body = BodyWear {
            laws: vec![archard(1.0), archard(100.0), archard(0.5)],
            share: None,
        };
        let exact = |way: f64| match way {
            way if way < 1.0 => way,
            way if way < 1.001 => 1.0 + 100.0 * (way - 1.0),
            way => 1.1 + 0.5 * (way - 1.001),
        };
        near(&worn(&body, &[1.0, 0.1], 1000.0), exact, 1e-3);
    }

    #[test]
    fn a_narrow_table_of_the_energy_is_not_stepped_over() {
        let factor = Factor {
            variable: FactorVariable::Energy,
            table: vec![(0.5, 0.0), (0.501, 100.0), (0.502, 0.0)],
        };
        let law: Arc<dyn Law> = Arc::new(Archard {
            k: 1.0,
            threshold: 0.0,
        });
        let body = BodyWear::with_law(Varying { law, factor });
        near(
            &worn(&body, &[], 1000.0),
            |way| if way > 0.5 { 0.1 } else { 0.0 },
            1e-5,
        );
    }

    #[test]
    fn a_rate_that_falls_off_smoothly_is_integrated() {
        let body = BodyWear::with_law(Own(|worn, _| (-worn).exp()));
        near(&worn(&body, &[], 1000.0), |way| (1.0 + way).ln(), 0.03);
    }
}
