//! Faces that touch: which parts of a crack are open, without friction.
//!
//! With the jump g of the faces at the points (sums of the dislocations' contents from the tip on)
//! the tractions are s = M g + t, t those of the body without the crack. The opening and the normal
//! traction are complementary: g_n >= 0, s_nn <= 0, one of them zero at each point. Jumps are in Pa
//! m; times 8 pi/E' they are displacements.

use ndarray::{Array1, Array2, s};

use super::Error;
use super::influence::influence;
use super::lu::{Lu, largest};
use super::rule::Rule;

/// Changes of the set of open points, beyond their number, before the search gives up.
const MOST_CHANGES: usize = 100;
/// Changes of all points at fault that may leave as many at fault, before one is changed at a time.
const BLOCKS: usize = 8;
/// Values below this part of the largest of their kind count as zero.
const ZERO: f64 = 1e-12;
/// Rounding of a sum, over the sum of the sizes of its terms: beside mouth and kinks points are so
/// near to each other that their tractions are differences of large numbers.
const ROUNDING: f64 = 1e-14;

/// Tractions per jump of the faces of a crack of unit length.
#[derive(Clone, Debug)]
pub(crate) struct Contact {
    /// Shear traction per opening.
    pub(crate) tn: Array2<f64>,
    /// Shear traction per slip.
    pub(crate) tt: Array2<f64>,
    /// Its inverse.
    pub(crate) tt_inverse: Array2<f64>,
    /// Normal traction per slip times the slip per shear traction.
    pub(crate) nt: Array2<f64>,
    /// Normal traction per opening while the shear traction is held.
    pub(crate) normal: Array2<f64>,
    /// Factors of `normal`, for faces that are open all along.
    all_open: Lu,
    /// Weight of the dislocation at the tip.
    pub(crate) tip: f64,
    /// Distances of the points from the mouth over the length.
    pub(crate) s: Vec<f64>,
}

/// Opening of the faces and the normal traction between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Opening {
    /// Which points are open.
    pub open: Vec<bool>,
    /// Jump across the faces over the length \[Pa\].
    pub gap: Array1<f64>,
    /// Normal traction \[Pa\], zero where open.
    pub normal: Array1<f64>,
}

impl Contact {
    pub(crate) fn new(rule: &Rule, length: f64) -> Result<Self, Error> {
        let n = rule.points.len();
        let mut M = influence(rule);
        for j in 0..n {
            for column in [j, n + j] {
                let weight = rule.dislocations[j].weight;
                M.column_mut(column).mapv_inplace(|t| t / weight);
            }
        }
        // Content of dislocation j is g_j - g_(j-1).
        for part in [0, n] {
            for j in 0..n - 1 {
                let next = M.column(part + j + 1).to_owned();
                let mut column = M.column_mut(part + j);
                column -= &next;
            }
        }
        let block =
            |row: usize, column: usize| M.slice(s![row..row + n, column..column + n]).to_owned();
        let (nn, n_t, tn, tt) = (block(0, 0), block(0, n), block(n, 0), block(n, n));
        let factors = Lu::new(tt.clone()).ok_or_else(|| Error::Singular {
            length,
            why: "its legs touch or run along each other".into(),
        })?;
        let tt_inverse = factors.inverse();
        let nt = n_t.dot(&tt_inverse);
        let normal = &nn - &nt.dot(&tn);
        let all_open = Lu::new(normal.clone()).ok_or_else(|| Error::Singular {
            length,
            why: "its legs touch or run along each other".into(),
        })?;
        Ok(Self {
            normal,
            all_open,
            tip: rule.dislocations[0].weight,
            s: rule.points.iter().map(|p| p.s).collect(),
            tn,
            tt,
            tt_inverse,
            nt,
        })
    }

    /// Opening under the normal traction `load` that closed faces would have; `open` is the first
    /// guess on entry and the open points on exit.
    ///
    /// Active set: open points that overlap close, closed ones in tension open, all of them at once
    /// while that lessens their number, else the one nearest to the mouth, which ends for every matrix
    /// with positive principal minors (K. G. Murty, Linear Algebra Appl. 7 (1974) 65-108; in blocks
    /// J. J. Judice, F. M. Pires, Comput. Oper. Res. 21 (1994) 587-596).
    pub(crate) fn open(&self, load: &Array1<f64>, open: &mut [bool]) -> Option<Opening> {
        let scale = largest(load);
        if load.iter().all(|t| *t <= 0.0) {
            open.fill(false);
        }
        let sizes = self.normal.mapv(f64::abs);
        let (mut fewest, mut blocks) = (usize::MAX, BLOCKS);
        for _ in 0..MOST_CHANGES + open.len() {
            let places: Vec<usize> = (0..open.len()).filter(|k| open[*k]).collect();
            let gap = if places.len() == open.len() {
                self.all_open.solve(&-load)
            } else {
                solve(&self.normal, &places, &(-load))?
            };
            let normal = self.normal.dot(&gap) + load;
            let rounding = sizes.dot(&gap.mapv(f64::abs)) * ROUNDING;
            let tight = ZERO * largest(&gap);
            let at_fault = |k: &usize| {
                if open[*k] {
                    gap[*k] < -tight
                } else {
                    normal[*k] > ZERO * scale + rounding[*k]
                }
            };
            let mut faults: Vec<usize> = (0..open.len()).filter(at_fault).collect();
            if faults.is_empty() {
                return Some(Opening {
                    open: open.to_vec(),
                    gap,
                    normal,
                });
            }
            if faults.len() < fewest {
                (fewest, blocks) = (faults.len(), BLOCKS);
            } else if blocks > 0 {
                blocks -= 1;
            } else {
                faults.drain(..faults.len() - 1);
            }
            for k in faults {
                open[k] = !open[k];
            }
        }
        None
    }
}

/// x with (matrix x)_k = right_k at `places` and x = 0 elsewhere.
pub(crate) fn solve(
    matrix: &Array2<f64>,
    places: &[usize],
    right: &Array1<f64>,
) -> Option<Array1<f64>> {
    let m = places.len();
    let mut x = Array1::zeros(right.len());
    if m == 0 {
        return Some(x);
    }
    let part = Array2::from_shape_fn((m, m), |(i, j)| matrix[[places[i], places[j]]]);
    let known = Array1::from_shape_fn(m, |i| right[places[i]]);
    let found = Lu::new(part)?.solve(&known);
    for (i, place) in places.iter().enumerate() {
        x[*place] = found[i];
    }
    Some(x)
}
