//! Faces that touch: which points of a crack are open, which stick and which slip.
//!
//! With the jumps (g, d) of the faces at the points, opening and slip (sums of the dislocations'
//! contents from the tip on), the tractions are
//!
//! ```text
//! s = M (g, d) + t,
//! ```
//!
//! t the tractions of the body without the crack. Jumps are in Pa m; times 8 pi/E' they are displacements.
//! With the pressure p = -s_nn, the shear traction s_tn and the slip m = d - d_0 since the last
//! instant, Coulomb's law at each point is
//!
//! ```text
//! open:   g > 0,    p = 0,                s_tn = 0
//! stick:  g = 0,    p >= 0,  |s_tn| <= mu p,      m = 0
//! slip:   g = 0,    p >= 0,   s_tn = +-mu p,  +-m >= 0
//! ```
//!
//! Given the state of every point, the jumps follow from one linear system. Points that break their
//! inequality change their state, all of them at once: Newton's method of this complementarity
//! problem, which is exact once no state changes (M. Hintermueller, K. Ito, K. Kunisch, SIAM J.
//! Optim. 13 (2002) 865-888). Along straight cracks -M_nn and -M_tt have no positive entry beside the
//! diagonal, and the method ends. At a kink slip can lift the faces that press it, and the states
//! may change for ever: the number of passes is bounded. 160 random histories with kinks of up to 34
//! degrees and mu up to 0.9 ended, and 80 with kinks of up to 52 degrees and mu up to 0.3; with mu of
//! 0.9 a fifth of those did not. Where these passes do not end, Lemke's pivots end on a ray.
//!
//! Tractions below [`ZERO`] times the largest of the history count as zero, and so do the jumps that
//! they cause: a crack that is unloaded is at rest, whatever the rounding of its stress.

use std::sync::Arc;

use ndarray::{Array1, Array2, s};

use super::Error;
use super::influence::influence;
use super::lu::{Lu, largest};
use super::rule::Rule;

/// Changes of the states before the search gives up. Random stresses take 2 to 7 on straight cracks and
/// 2 to 17 on kinked ones (mu = 0.05 to 0.8). In the sharp wedge of a crack 45 to 60 degrees from the normal
/// open and closed parts alternate towards the mouth. They settle one after the other, three points in a
/// pass: 156 passes at most in 560 cycles of partial slip.
const MOST_PASSES: usize = 160;
/// Changes of all points at fault that may leave as many at fault, before one is changed at a time. With 8
/// of them the parts of a sharp wedge are cut short.
const BLOCKS: usize = 60;
/// Part of the largest traction of the history that counts as zero, and of the jump that it causes.
const ZERO: f64 = 1e-12;
/// Rounding of a sum, over the sum of the sizes of its terms: beside mouth and kinks points are so
/// near to each other that their tractions are differences of large numbers.
const ROUNDING: f64 = 1e-14;

/// State of the faces at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Apart.
    Open,
    /// Contact without relative motion since the last instant.
    Stick,
    /// Contact with slip, or without friction.
    Slip,
}

/// State of a point and the sign of its shear traction where it slips, else 0.
pub(crate) type Signed = (State, i8);

/// Opening of the faces and the normal traction between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// Open points.
    pub open: Vec<bool>,
    /// Jump across the faces over the length \[Pa\].
    pub gap: Array1<f64>,
    /// Normal traction \[Pa\], zero where open.
    pub normal: Array1<f64>,
}

/// Jumps and tractions of the faces: openings or normal tractions first, then slips or shear
/// tractions.
#[derive(Clone, Debug)]
pub(crate) struct Touching {
    pub(crate) jumps: Array1<f64>,
    pub(crate) tractions: Array1<f64>,
    pub(crate) states: Vec<Signed>,
    /// Linear systems solved.
    pub(crate) passes: usize,
}

/// Points at fault after the last pass of a search that found no state.
pub(crate) struct Unsettled {
    pub(crate) passes: usize,
    pub(crate) at_fault: usize,
}

/// Origin of a crack of unit length, and the loads on it.
pub(crate) struct Instant<'a> {
    /// Tractions of the body without the crack, normal then shear \[Pa\].
    pub(crate) load: &'a Array1<f64>,
    /// The largest of the history \[Pa\].
    pub(crate) most: f64,
    /// Coefficient of friction.
    pub(crate) friction: f64,
    /// Slips at the last instant.
    pub(crate) before: &'a Array1<f64>,
}

/// Tractions per jump of the faces of a crack of unit length.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    /// M: rows normal, then shear; columns opening, then slip.
    matrix: Array2<f64>,
    /// Factors of M, for faces that are open all along.
    all_open: Factors,
    /// Largest opening under a unit normal traction.
    compliance: f64,
    /// Weight of the dislocation at the tip.
    pub(crate) tip: f64,
    /// Distances of the points from the mouth over the length.
    pub(crate) s: Vec<f64>,
}

/// Factors of the system of the openings, and the open points that it belongs to. They serve the next
/// pass, and the next instant, as long as the same points are open.
pub(crate) type OpenFactors = Option<(Vec<usize>, Arc<Lu>)>;

/// Factors of M.
#[derive(Clone, Debug)]
enum Factors {
    /// All of it: slip changes normal tractions, as it does along cracks that are not straight.
    Coupled(Lu),
    /// Its halves: opening to normal tractions, and slip to shear tractions.
    Halves { opening: Lu, slip: Lu },
}

impl Factors {
    /// Factorises the matrix; `None` for a singular one.
    fn new(matrix: &Array2<f64>) -> Option<Self> {
        let n = matrix.nrows() / 2;
        let coupled = matrix.indexed_iter().any(|((row, column), t)| {
            row < n && column >= n && t.abs() > ZERO * matrix[[row, row]].abs()
        });
        Some(if coupled {
            Self::Coupled(Lu::new(matrix.clone())?)
        } else {
            Self::Halves {
                opening: Lu::new(matrix.slice(s![..n, ..n]).to_owned())?,
                slip: Lu::new(matrix.slice(s![n.., n..]).to_owned())?,
            }
        })
    }

    /// The openings under the tractions -`right`, normal then shear.
    fn openings(&self, right: &Array1<f64>) -> Array1<f64> {
        let n = right.len() / 2;
        match self {
            Self::Coupled(whole) => whole.solve(right).slice(s![..n]).to_owned(),
            Self::Halves { opening, .. } => opening.solve(&right.slice(s![..n]).to_owned()),
        }
    }
}

impl Contact {
    /// Computes the matrices between jumps and tractions of the faces of a crack.
    pub(crate) fn new(rule: &Rule, length: f64) -> Result<Self, Error> {
        let n = rule.points.len();
        let mut matrix = influence(rule);
        for j in 0..n {
            for column in [j, n + j] {
                let weight = rule.dislocations[j].weight;
                matrix.column_mut(column).mapv_inplace(|t| t / weight);
            }
        }
        // Content of dislocation j is g_j - g_(j-1).
        for part in [0, n] {
            for j in 0..n - 1 {
                let next = matrix.column(part + j + 1).to_owned();
                let mut column = matrix.column_mut(part + j);
                column -= &next;
            }
        }
        let all_open = Factors::new(&matrix).ok_or_else(|| Error::Singular {
            length,
            why: "its legs touch or run along each other".into(),
        })?;
        let unit = Array1::from_shape_fn(2 * n, |k| if k < n { -1.0 } else { 0.0 });
        Ok(Self {
            compliance: largest(&all_open.openings(&unit)),
            matrix,
            all_open,
            tip: rule.dislocations[0].weight,
            s: rule.points.iter().map(|p| p.s).collect(),
        })
    }

    /// Finds which points of the faces are open, stick or slip at an instant; `states` is the first guess.
    ///
    /// Each pass solves for the jumps, and all points whose state contradicts them change. Where the number
    /// of contradictions has not fallen for [`BLOCKS`] passes, the last point alone changes. `known` keeps the
    /// factors of the open points. Fails with the contradictions left after [`MOST_PASSES`].
    ///
    /// Where the faces can part everywhere they do: then no history is left in them.
    pub(crate) fn settle(
        &self,
        instant: &Instant<'_>,
        states: &[Signed],
        known: &mut OpenFactors,
    ) -> Result<Touching, Unsettled> {
        let n = self.s.len();
        let tight = ZERO * self.compliance * instant.most;
        let gaps = self.all_open.openings(&-instant.load);
        if gaps.iter().all(|gap| *gap >= -tight) {
            return Ok(Touching {
                jumps: self.apart(instant, &gaps),
                tractions: Array1::zeros(2 * n),
                states: vec![(State::Open, 0); n],
                passes: 1,
            });
        }
        let mut states = states.to_vec();
        let (mut fewest, mut blocks, mut at_fault) = (usize::MAX, BLOCKS, 0);
        for passes in 2..=MOST_PASSES {
            let Some(jumps) = self.jumps(instant, &states, known) else {
                return Err(Unsettled { passes, at_fault });
            };
            let (tractions, rounding) = self.tractions(instant, &jumps);
            let next = |k: usize| {
                let [normal, shear] = [k, n + k].map(|row| (tractions[row], rounding[row]));
                let moved = jumps[n + k] - instant.before[k];
                let against = (jumps[k], moved, tight);
                instant.next(states[k], normal, shear, against)
            };
            let all = (0..n).map(|k| (k, next(k)));
            let mut changes: Vec<(usize, Signed)> =
                all.filter(|(k, to)| states[*k] != *to).collect();
            at_fault = changes.len();
            if changes.is_empty() {
                return Ok(Touching {
                    tractions: instant.lawful(tractions, &states),
                    jumps,
                    states,
                    passes,
                });
            }
            if at_fault < fewest {
                (fewest, blocks) = (at_fault, BLOCKS);
            } else if blocks > 0 {
                blocks -= 1;
            } else {
                changes.drain(..at_fault - 1);
            }
            for (k, to) in changes {
                states[k] = to;
            }
        }
        let passes = MOST_PASSES;
        Err(Unsettled { passes, at_fault })
    }

    /// The jumps of faces that are open all along, from these openings `gaps`.
    fn apart(&self, instant: &Instant<'_>, gaps: &Array1<f64>) -> Array1<f64> {
        match &self.all_open {
            Factors::Coupled(whole) => whole.solve(&-instant.load),
            Factors::Halves { slip, .. } => {
                let n = gaps.len();
                let loads = instant.load.slice(s![n..]);
                let right = -self.matrix.slice(s![n.., ..n]).dot(gaps) - loads;
                let slips = slip.solve(&right);
                gaps.iter().chain(&slips).copied().collect()
            }
        }
    }

    /// The jumps of points in given states: those that are free, from the equations of their states.
    fn jumps(
        &self,
        instant: &Instant<'_>,
        states: &[Signed],
        known: &mut OpenFactors,
    ) -> Option<Array1<f64>> {
        let n = states.len();
        let of = |kind: fn(State) -> bool| (0..n).filter(move |k| kind(states[*k].0));
        let open: Vec<usize> = of(|state| state == State::Open).collect();
        let moves: Vec<usize> = of(|state| state != State::Stick).map(|k| n + k).collect();
        // Slips that stick, and the tractions that they leave.
        let mut jumps = Array1::zeros(2 * n);
        for k in of(|state| state == State::Stick) {
            jumps[n + k] = instant.before[k];
        }
        let held = if moves.len() == n {
            instant.load.clone()
        } else {
            instant.load + &self.matrix.dot(&jumps)
        };
        // s_nn = 0; s_tn + sign mu s_nn = 0, which is s_tn = 0 where open.
        let share = |row: usize| match row.checked_sub(n) {
            Some(k) => (k, f64::from(states[k].1) * instant.friction),
            None => (row, 0.0),
        };
        let part = |rows: &[usize], columns: &[usize]| {
            let mut values = Vec::with_capacity(rows.len() * columns.len());
            for row in rows {
                let (normal, share) = share(*row);
                let [own, normal] = [*row, normal].map(|row| self.matrix.row(row));
                values.extend(columns.iter().map(|k| own[*k] + share * normal[*k]));
            }
            Array2::from_shape_vec((rows.len(), columns.len()), values)
                .expect("a value for each row and column")
        };
        let right = |rows: &[usize]| -> Array1<f64> {
            let row = |row: &usize| {
                let (normal, share) = share(*row);
                -(held[*row] + share * held[normal])
            };
            rows.iter().map(row).collect()
        };
        let solve = |free: &[usize], right: &Array1<f64>| match free {
            [] => Some(Array1::zeros(0)),
            free => Lu::new(part(free, free)).map(|lu| lu.solve(right)),
        };
        let (free, found): (Vec<usize>, Array1<f64>) = match &self.all_open {
            Factors::Coupled(_) => {
                let free = [open, moves].concat();
                let found = solve(&free, &right(&free))?;
                (free, found)
            }
            Factors::Halves { slip, .. } => {
                if !matches!(known, Some((points, _)) if *points == open) {
                    let factors = Lu::new(part(&open, &open))?;
                    *known = Some((open.clone(), Arc::new(factors)));
                }
                let gaps = known.as_ref()?.1.solve(&right(&open));
                let shears = right(&moves) - part(&moves, &open).dot(&gaps);
                // Openings do not depend on slip, so that the same factors serve all signs of it.
                let slips = if moves.len() == n {
                    slip.solve(&shears)
                } else {
                    solve(&moves, &shears)?
                };
                let found = gaps.iter().chain(&slips).copied().collect();
                ([open, moves].concat(), found)
            }
        };
        for (place, jump) in free.into_iter().zip(found) {
            jumps[place] = jump;
        }
        Some(jumps)
    }

    /// Tractions of the faces under these jumps, and the rounding errors in them.
    fn tractions(&self, instant: &Instant<'_>, jumps: &Array1<f64>) -> (Array1<f64>, Array1<f64>) {
        let n = jumps.len() / 2;
        let halves = matches!(self.all_open, Factors::Halves { .. });
        let of = |(k, (row, load)): (usize, (ndarray::ArrayView1<'_, f64>, &f64))| {
            let columns = if halves && k < n { n } else { 2 * n };
            // Four sums side by side: each waits for its last term.
            let (mut sums, mut sizes) = ([0.0; 4], [0.0; 4]);
            for (k, (t, jump)) in row.iter().zip(jumps).take(columns).enumerate() {
                let term: f64 = t * jump;
                sums[k % 4] += term;
                sizes[k % 4] += term.abs();
            }
            let [sum, size] = [sums, sizes].map(|v| v.iter().sum::<f64>());
            (load + sum, ROUNDING * size + ZERO * instant.most)
        };
        let rows = self.matrix.rows().into_iter().zip(instant.load).enumerate();
        let (tractions, rounding): (Vec<f64>, Vec<f64>) = rows.map(of).unzip();
        (tractions.into(), rounding.into())
    }
}

impl Instant<'_> {
    /// Sets tractions that the states prescribe (zero when open, friction when sliding) without rounding.
    fn lawful(&self, mut tractions: Array1<f64>, states: &[Signed]) -> Array1<f64> {
        let n = states.len();
        for (k, (state, sign)) in states.iter().enumerate() {
            match state {
                State::Open => (tractions[k], tractions[n + k]) = (0.0, 0.0),
                State::Slip => {
                    tractions[n + k] = f64::from(*sign) * self.friction * (-tractions[k]).max(0.0);
                }
                State::Stick => {}
            }
        }
        tractions
    }

    /// The state that follows from a state, the normal and the shear traction, each with its
    /// rounding, the opening and the slip since the last instant, and the jump that counts as zero.
    fn next(
        &self,
        (state, sign): Signed,
        (normal, of_normal): (f64, f64),
        (shear, of_shear): (f64, f64),
        (gap, moved, tight): (f64, f64, f64),
    ) -> Signed {
        let along = |value: f64| (State::Slip, if value < 0.0 { -1 } else { 1 });
        let bound = self.friction * (-normal).max(0.0);
        match state {
            State::Open if gap >= -tight => (state, sign),
            State::Open if self.friction == 0.0 => (State::Slip, 1),
            State::Open if moved.abs() <= tight => (State::Stick, 0),
            State::Open => along(moved),
            _ if normal > of_normal => (State::Open, 0),
            State::Stick if shear.abs() > bound + of_shear => along(shear),
            State::Slip if f64::from(sign) * moved < -tight && bound > of_shear => {
                (State::Stick, 0)
            }
            _ => (state, sign),
        }
    }
}
