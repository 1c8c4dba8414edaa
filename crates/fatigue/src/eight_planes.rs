//! The stress of one point on eight planes at a time: the planes side by side in vector
//! instructions, the instants one after the other.

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use pulp::{Arch, Simd, WithSimd};

use crate::circle::{Disc, circle_with_point, defining_points, smallest_disc_of_three};
use crate::eight_weights::{normal_weights, shear_weights, weighted_sum};
use crate::histories::Histories;
use crate::lanes::{Eight, LANES, Real};
use crate::path::Path;

/// The stresses of a point, and buffers for the shear on eight planes.
pub(crate) struct Instants<F> {
    stress: Vec<[F; 6]>,
    /// [`Histories::distinct_strain`]; empty where it is the stress.
    strained: Vec<[F; 6]>,
    shear: Vec<[Eight<F>; 2]>,
    arch: Arch,
}

/// Extremes over the instants on each of at most `LANES` planes.
#[derive(Clone, Copy)]
pub(crate) struct PlaneExtrema<F> {
    pub(crate) normal_max: Eight<F>,
    pub(crate) strain_max: Eight<F>,
    pub(crate) strain_min: Eight<F>,
    /// The instants of these three.
    pub(crate) instants: [Eight<F>; 3],
}

/// For eight pairs of vectors a and b: the largest a.S.b, and half the range of a.e.b, e being the
/// strain.
#[derive(Clone, Copy)]
pub(crate) struct PairExtrema<F> {
    pub(crate) normal_max: Eight<F>,
    pub(crate) strain_amplitude: Eight<F>,
}

/// The circle of three instants on a plane; a radius whose square is at most `enough` need not be
/// exact.
#[derive(Clone, Copy)]
pub(crate) struct ThreePointCircle {
    pub(crate) instants: [usize; 3],
    pub(crate) enough: f64,
    /// Square of the radius of the smallest circle round the three: the smallest round all is no
    /// smaller.
    pub(crate) square: f64,
}

impl<F: Real> Instants<F> {
    /// Buffers without any instant.
    pub(crate) fn new() -> Self {
        Self {
            stress: Vec::new(),
            strained: Vec::new(),
            shear: Vec::new(),
            arch: Arch::new(),
        }
    }

    /// Takes other tensors than stresses, for [`Self::mixed`] alone.
    pub(crate) fn load_tensors(&mut self, tensors: impl Iterator<Item = [f64; 6]>) {
        self.stress.clear();
        self.strained.clear();
        self.stress.extend(tensors.map(|s| s.map(F::near)));
    }

    /// Takes stress and strain of a point.
    pub(crate) fn load(&mut self, histories: &Histories) {
        self.load_tensors(histories.stress.instants());
        let strained = histories
            .distinct_strain()
            .into_iter()
            .flat_map(Path::instants);
        self.strained.extend(strained.map(|s| s.map(F::near)));
        let none = [[F::near(0.0); LANES]; 2];
        self.shear.resize(self.stress.len(), none);
    }

    /// Evaluates the planes of eight unit normals n over all instants: the largest normal stress and, with
    /// `strain` = (a, b), the extremes of a n.S*.n - b tr S*. With `shear`, the shear of S* at every instant is
    /// kept for [`Self::circles`].
    pub(crate) fn sweep(
        &mut self,
        n: &[Eight<f64>; 3],
        strain: Option<[f64; 2]>,
        shear: bool,
    ) -> PlaneExtrema<F> {
        let (has_strain, strain) = (strain.is_some(), strain.unwrap_or_default().map(F::near));
        let (arch, [stress, strained]) =
            (self.arch, stress_and_strain(&self.stress, &self.strained));
        let n = n.map(|d| d.map(F::near));
        if shear && has_strain {
            let shear = &mut self.shear;
            arch.dispatch(Sweep::<F, true, true> {
                stress,
                strained,
                shear,
                n,
                strain,
            })
        } else if shear {
            let shear = &mut self.shear;
            arch.dispatch(Sweep::<F, true, false> {
                stress,
                strained,
                shear,
                n,
                strain,
            })
        } else {
            let shear = &mut [];
            arch.dispatch(Sweep::<F, false, true> {
                stress,
                strained,
                shear,
                n,
                strain,
            })
        }
    }

    /// [`PairExtrema`] of eight pairs of vectors a and b. a.e.b is `strain[0]` times a.S.b less
    /// `strain[1]` a.b times the sum of the normal stresses; without it the amplitude is 0.
    pub(crate) fn mixed(
        &self,
        a: &[Eight<f64>; 3],
        b: &[Eight<f64>; 3],
        strain: Option<[f64; 2]>,
    ) -> PairExtrema<F> {
        let mut weights = [[F::near(0.0); LANES]; 6];
        let mut minus_product = [F::near(0.0); LANES];
        for l in 0..LANES {
            let [a, b] = [a, b].map(|v| [v[0][l], v[1][l], v[2][l]].map(F::near));
            for c in 0..3 {
                weights[c][l] = a[c] * b[c];
                minus_product[l] = minus_product[l] - weights[c][l];
            }
            for (c, i, j) in [(3, 0, 1), (4, 0, 2), (5, 1, 2)] {
                weights[c][l] = a[i] * b[j] + a[j] * b[i];
            }
        }
        let (arch, [stress, strained]) =
            (self.arch, stress_and_strain(&self.stress, &self.strained));
        if let Some(strain) = strain {
            let strain = strain.map(F::near);
            arch.dispatch(Mix::<F, true> {
                stress,
                strained,
                weights,
                minus_product,
                strain,
            })
        } else {
            let strain = [F::near(0.0); 2];
            arch.dispatch(Mix::<F, false> {
                stress,
                strained,
                weights,
                minus_product,
                strain,
            })
        }
    }

    /// Squared radii of the smallest circles around the shear on each of eight planes. A lane that has at most
    /// the radius `enough` may stop early.
    pub(crate) fn circles(&mut self, lanes: &mut [ThreePointCircle]) -> Eight<f64> {
        let shear = &self.shear;
        let mut centres = [[F::near(0.0); LANES]; 2];
        let mut squares = [f64::INFINITY; LANES];
        let clamp = |k: usize| if k < shear.len() { k } else { 0 };
        for (l, lane) in lanes.iter_mut().enumerate() {
            let point = |k: usize| shear[k].map(|xy| xy[l].wide());
            lane.instants = lane.instants.map(clamp);
            let circle = smallest_disc_of_three(lane.instants.map(point));
            squares[l] = circle.square;
            (centres[0][l], centres[1][l]) = (F::near(circle.x), F::near(circle.y));
        }
        let mut open = [true; LANES];
        loop {
            let (farthest, instants) = self.arch.dispatch(Farthest { shear, centres });
            let mut is_any_open = false;
            for (l, lane) in lanes.iter_mut().enumerate() {
                if !open[l] {
                    continue;
                }
                let square = farthest[l].wide();
                let point = |k: usize| shear[k].map(|xy| xy[l].wide());
                open[l] = square > squares[l] * (1.0 + 8.0 * F::EPSILON) && square > lane.enough;
                if open[l] {
                    let (Disc { x, y, square }, on) =
                        circle_with_point(instants[l].wide() as usize, lane.instants, &point);
                    open[l] = square > squares[l];
                    if open[l] {
                        (centres[0][l], centres[1][l]) = (F::near(x), F::near(y));
                        (squares[l], lane.instants) = (square, on);
                    }
                }
                is_any_open |= open[l];
            }
            if !is_any_open {
                for (l, lane) in lanes.iter_mut().enumerate() {
                    lane.square = squares[l];
                    lane.instants =
                        defining_points(lane.instants, &|k: usize| shear[k].map(|xy| xy[l].wide()));
                }
                return farthest.map(F::wide);
            }
        }
    }
}

/// S and S*; where S* is empty it is the stress.
fn stress_and_strain<'a, F>(stress: &'a [[F; 6]], strained: &'a [[F; 6]]) -> [&'a [[F; 6]]; 2] {
    let strain_source = if strained.is_empty() {
        stress
    } else {
        strained
    };
    [stress, strain_source]
}

/// [`Instants::sweep`], compiled for the processor.
struct Sweep<'a, F, const SHEAR: bool, const STRAIN: bool> {
    stress: &'a [[F; 6]],
    strained: &'a [[F; 6]],
    shear: &'a mut [[Eight<F>; 2]],
    n: [Eight<F>; 3],
    strain: [F; 2],
}

impl<F: Real, const SHEAR: bool, const STRAIN: bool> WithSimd for Sweep<'_, F, SHEAR, STRAIN> {
    type Output = PlaneExtrema<F>;

    /// Runs the sweep with vectors of the processor.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> PlaneExtrema<F> {
        let Self {
            stress,
            strained,
            shear,
            n,
            strain,
        } = self;
        let [low, high] = [F::near(f64::NEG_INFINITY), F::near(f64::INFINITY)];
        let mut normal_max = [low; LANES];
        let (mut strain_max, mut strain_min) = (normal_max, [high; LANES]);
        let normal = normal_weights(&n);
        let mut elongation = normal;
        for (c, weights) in elongation.iter_mut().enumerate() {
            let offset = if c < 3 { strain[1] } else { F::near(0.0) };
            for weight in weights {
                *weight = strain[0] * *weight - offset;
            }
        }
        let [u, v] = if SHEAR {
            shear_weights(&n)
        } else {
            [normal; 2]
        };
        let mut marks = [[F::near(0.0); LANES]; 3];
        for (t, (s, e)) in stress.iter().zip(strained).enumerate() {
            let mark = F::near(t as f64);
            let value = weighted_sum(&normal, s);
            F::raise_marked(simd, &mut normal_max, &mut marks[0], &value, mark);
            if STRAIN {
                let value = weighted_sum(&elongation, e);
                F::raise_marked(simd, &mut strain_max, &mut marks[1], &value, mark);
                F::lower_marked(simd, &mut strain_min, &mut marks[2], &value, mark);
            }
            if SHEAR {
                shear[t] = [weighted_sum(&u, e), weighted_sum(&v, e)];
            }
        }
        PlaneExtrema {
            normal_max,
            strain_max,
            strain_min,
            instants: marks,
        }
    }
}

/// [`Instants::mixed`], compiled for the processor.
struct Mix<'a, F, const STRAIN: bool> {
    stress: &'a [[F; 6]],
    strained: &'a [[F; 6]],
    weights: [Eight<F>; 6],
    /// -a.b.
    minus_product: Eight<F>,
    strain: [F; 2],
}

impl<F: Real, const STRAIN: bool> WithSimd for Mix<'_, F, STRAIN> {
    type Output = PairExtrema<F>;

    /// Runs the sweep over pairs with vectors of the processor.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> PairExtrema<F> {
        let Self {
            stress,
            strained,
            weights,
            minus_product: across,
            strain,
        } = self;
        let [low, high] = [F::near(f64::NEG_INFINITY), F::near(f64::INFINITY)];
        let mut normal_max = [low; LANES];
        let (mut strain_max, mut strain_min) = (normal_max, [high; LANES]);
        for (s, e) in stress.iter().zip(strained) {
            F::raise(simd, &mut normal_max, &weighted_sum(&weights, s));
            if STRAIN {
                let mut value = weighted_sum(&weights, e);
                let trace = strain[1] * (e[0] + e[1] + e[2]);
                for l in 0..LANES {
                    value[l] = across[l].mul_add(trace, strain[0] * value[l]);
                }
                F::raise(simd, &mut strain_max, &value);
                F::lower(simd, &mut strain_min, &value);
            }
        }
        let mut strain_amplitude = [F::near(0.0); LANES];
        if STRAIN {
            for l in 0..LANES {
                strain_amplitude[l] = F::near(0.5) * (strain_max[l] - strain_min[l]);
            }
        }
        PairExtrema {
            normal_max,
            strain_amplitude,
        }
    }
}

/// Finds the square of the largest distance from a centre on each plane, and the instant.
struct Farthest<'a, F> {
    shear: &'a [[Eight<F>; 2]],
    centres: [Eight<F>; 2],
}

impl<F: Real> WithSimd for Farthest<'_, F> {
    type Output = (Eight<F>, Eight<F>);

    /// Finds the squared distance and the instant of the shear farthest from each of eight centres.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let [x, y] = self.centres;
        let mut farthest = [F::near(-1.0); LANES];
        let mut instants = [F::near(0.0); LANES];
        for (t, [xs, ys]) in self.shear.iter().enumerate() {
            let t = F::near(t as f64);
            let mut square = [F::near(0.0); LANES];
            for l in 0..LANES {
                let (a, b) = (xs[l] - x[l], ys[l] - y[l]);
                square[l] = a.mul_add(a, b * b);
            }
            F::raise_marked(simd, &mut farthest, &mut instants, &square, t);
        }
        (farthest, instants)
    }
}
