//! The stress of one point on eight planes at a time: the planes side by side in vector
//! instructions, the instants one after the other.

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use pulp::{Arch, Simd, WithSimd};

use crate::circle::{Round, joined, needed, round_of_three};
use crate::eight_weights::{normal_weights, shear_weights, weighted};
use crate::histories::Histories;
use crate::lanes::{Eight, LANES, Real};
use crate::path::Path;

/// The stresses of a point, and buffers for the shear on eight planes.
pub(crate) struct Instants<F> {
    stress: Vec<[F; 6]>,
    /// [`Histories::apart`]; empty where it is the stress.
    strained: Vec<[F; 6]>,
    shear: Vec<[Eight<F>; 2]>,
    arch: Arch,
}

/// Extremes over the instants on each of at most `LANES` planes.
#[derive(Clone, Copy)]
pub(crate) struct Swept<F> {
    pub(crate) normal_max: Eight<F>,
    pub(crate) strain_max: Eight<F>,
    pub(crate) strain_min: Eight<F>,
    /// The instants of these three.
    pub(crate) at: [Eight<F>; 3],
}

/// For eight pairs of vectors a and b: the largest a.S.b, and half the range of a.e.b, e being the
/// strain.
#[derive(Clone, Copy)]
pub(crate) struct Mixed<F> {
    pub(crate) normal_max: Eight<F>,
    pub(crate) strain_amplitude: Eight<F>,
}

/// The circle of three instants on a plane; a radius whose square is at most `enough` need not be
/// exact.
#[derive(Clone, Copy)]
pub(crate) struct OfThree {
    pub(crate) on: [usize; 3],
    pub(crate) enough: f64,
    /// Square of the radius of the smallest circle round the three: the smallest round all is no
    /// smaller.
    pub(crate) square: f64,
}

impl<F: Real> Instants<F> {
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
    pub(crate) fn load(&mut self, of: &Histories) {
        self.load_tensors(of.stress.instants());
        let apart = of.apart().into_iter().flat_map(Path::instants);
        self.strained.extend(apart.map(|s| s.map(F::near)));
        let none = [[F::near(0.0); LANES]; 2];
        self.shear.resize(self.stress.len(), none);
    }

    /// Largest normal stress on the planes of eight unit normals, largest and smallest of
    /// `strain[0]` times the normal stress of S* less `strain[1]` times the sum of its normal stresses,
    /// and, where `shear` is asked for, the shear of S* at every instant, which stays here.
    pub(crate) fn sweep(
        &mut self,
        n: &[Eight<f64>; 3],
        strain: Option<[f64; 2]>,
        shear: bool,
    ) -> Swept<F> {
        let (elongates, strain) = (strain.is_some(), strain.unwrap_or_default().map(F::near));
        let (arch, [stress, strained]) = (self.arch, both(&self.stress, &self.strained));
        let n = n.map(|d| d.map(F::near));
        if shear && elongates {
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

    /// [`Mixed`] of eight pairs of vectors a and b. a.e.b is `strain[0]` times a.S.b less
    /// `strain[1]` a.b times the sum of the normal stresses; without it the amplitude is 0.
    pub(crate) fn mixed(
        &self,
        a: &[Eight<f64>; 3],
        b: &[Eight<f64>; 3],
        strain: Option<[f64; 2]>,
    ) -> Mixed<F> {
        let mut weights = [[F::near(0.0); LANES]; 6];
        let mut across = [F::near(0.0); LANES];
        for l in 0..LANES {
            let [a, b] = [a, b].map(|v| [v[0][l], v[1][l], v[2][l]].map(F::near));
            for c in 0..3 {
                weights[c][l] = a[c] * b[c];
                across[l] = across[l] - weights[c][l];
            }
            for (c, i, j) in [(3, 0, 1), (4, 0, 2), (5, 1, 2)] {
                weights[c][l] = a[i] * b[j] + a[j] * b[i];
            }
        }
        let (arch, [stress, strained]) = (self.arch, both(&self.stress, &self.strained));
        if let Some(strain) = strain {
            let strain = strain.map(F::near);
            arch.dispatch(Mix::<F, true> {
                stress,
                strained,
                weights,
                across,
                strain,
            })
        } else {
            let strain = [F::near(0.0); 2];
            arch.dispatch(Mix::<F, false> {
                stress,
                strained,
                weights,
                across,
                strain,
            })
        }
    }

    /// Squared radii of circles round the shear on each plane: of the smallest circle, or any with
    /// at most `enough`.
    pub(crate) fn circles(&mut self, lanes: &mut [OfThree]) -> Eight<f64> {
        let shear = &self.shear;
        let mut centres = [[F::near(0.0); LANES]; 2];
        let mut squares = [f64::INFINITY; LANES];
        let within = |k: usize| if k < shear.len() { k } else { 0 };
        for (l, lane) in lanes.iter_mut().enumerate() {
            let point = |k: usize| shear[k].map(|xy| xy[l].wide());
            lane.on = lane.on.map(within);
            let circle = round_of_three(lane.on.map(point));
            squares[l] = circle.square;
            (centres[0][l], centres[1][l]) = (F::near(circle.x), F::near(circle.y));
        }
        let mut open = [true; LANES];
        loop {
            let (far, at) = self.arch.dispatch(Farthest { shear, centres });
            let mut again = false;
            for (l, lane) in lanes.iter_mut().enumerate() {
                if !open[l] {
                    continue;
                }
                let square = far[l].wide();
                let point = |k: usize| shear[k].map(|xy| xy[l].wide());
                open[l] = square > squares[l] * (1.0 + 8.0 * F::EPSILON) && square > lane.enough;
                if open[l] {
                    let (Round { x, y, square }, on) =
                        joined(at[l].wide() as usize, lane.on, &point);
                    open[l] = square > squares[l];
                    if open[l] {
                        (centres[0][l], centres[1][l]) = (F::near(x), F::near(y));
                        (squares[l], lane.on) = (square, on);
                    }
                }
                again |= open[l];
            }
            if !again {
                for (l, lane) in lanes.iter_mut().enumerate() {
                    lane.square = squares[l];
                    lane.on = needed(lane.on, &|k: usize| shear[k].map(|xy| xy[l].wide()));
                }
                return far.map(F::wide);
            }
        }
    }
}

/// S and S*: the stress, where S* is empty.
fn both<'a, F>(stress: &'a [[F; 6]], strained: &'a [[F; 6]]) -> [&'a [[F; 6]]; 2] {
    let apart = if strained.is_empty() {
        stress
    } else {
        strained
    };
    [stress, apart]
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
    type Output = Swept<F>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Swept<F> {
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
            let across = if c < 3 { strain[1] } else { F::near(0.0) };
            for weight in weights {
                *weight = strain[0] * *weight - across;
            }
        }
        let [u, v] = if SHEAR {
            shear_weights(&n)
        } else {
            [normal; 2]
        };
        let mut at = [[F::near(0.0); LANES]; 3];
        for (t, (s, e)) in stress.iter().zip(strained).enumerate() {
            let mark = F::near(t as f64);
            let value = weighted(&normal, s);
            F::raise_marked(simd, &mut normal_max, &mut at[0], &value, mark);
            if STRAIN {
                let value = weighted(&elongation, e);
                F::raise_marked(simd, &mut strain_max, &mut at[1], &value, mark);
                F::lower_marked(simd, &mut strain_min, &mut at[2], &value, mark);
            }
            if SHEAR {
                shear[t] = [weighted(&u, e), weighted(&v, e)];
            }
        }
        Swept {
            normal_max,
            strain_max,
            strain_min,
            at,
        }
    }
}

/// [`Instants::mixed`], compiled for the processor.
struct Mix<'a, F, const STRAIN: bool> {
    stress: &'a [[F; 6]],
    strained: &'a [[F; 6]],
    weights: [Eight<F>; 6],
    /// -a.b.
    across: Eight<F>,
    strain: [F; 2],
}

impl<F: Real, const STRAIN: bool> WithSimd for Mix<'_, F, STRAIN> {
    type Output = Mixed<F>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Mixed<F> {
        let Self {
            stress,
            strained,
            weights,
            across,
            strain,
        } = self;
        let [low, high] = [F::near(f64::NEG_INFINITY), F::near(f64::INFINITY)];
        let mut normal_max = [low; LANES];
        let (mut most, mut least) = (normal_max, [high; LANES]);
        for (s, e) in stress.iter().zip(strained) {
            F::raise(simd, &mut normal_max, &weighted(&weights, s));
            if STRAIN {
                let mut value = weighted(&weights, e);
                let trace = strain[1] * (e[0] + e[1] + e[2]);
                for l in 0..LANES {
                    value[l] = across[l].mul_add(trace, strain[0] * value[l]);
                }
                F::raise(simd, &mut most, &value);
                F::lower(simd, &mut least, &value);
            }
        }
        let mut strain_amplitude = [F::near(0.0); LANES];
        if STRAIN {
            for l in 0..LANES {
                strain_amplitude[l] = F::near(0.5) * (most[l] - least[l]);
            }
        }
        Mixed {
            normal_max,
            strain_amplitude,
        }
    }
}

/// The square of the largest distance from a centre on each plane, and the instant.
struct Farthest<'a, F> {
    shear: &'a [[Eight<F>; 2]],
    centres: [Eight<F>; 2],
}

impl<F: Real> WithSimd for Farthest<'_, F> {
    type Output = (Eight<F>, Eight<F>);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        let [x, y] = self.centres;
        let mut far = [F::near(-1.0); LANES];
        let mut at = [F::near(0.0); LANES];
        for (t, [xs, ys]) in self.shear.iter().enumerate() {
            let t = F::near(t as f64);
            let mut square = [F::near(0.0); LANES];
            for l in 0..LANES {
                let (a, b) = (xs[l] - x[l], ys[l] - y[l]);
                square[l] = a.mul_add(a, b * b);
            }
            F::raise_marked(simd, &mut far, &mut at, &square, t);
        }
        (far, at)
    }
}
