//! The stress of one point on eight planes at a time: the planes side by side in vector
//! instructions, the instants one after the other.

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use pulp::{Arch, Simd, WithSimd};

use super::eight_circles::{Circles, Found};
use super::lanes::{Eight, LANES, Lanes, Real};
use super::path::Path;

/// A point's stresses, and room for the shear on eight planes.
pub(super) struct Instants<F> {
    stress: Vec<[F; 6]>,
    shear: Vec<[Eight<F>; 2]>,
    arch: Arch,
}

/// What a sweep over the instants finds on each plane, at most `LANES` of them.
#[derive(Clone, Copy)]
pub(super) struct Swept<F> {
    pub(super) normal_max: Eight<F>,
    pub(super) strain_max: Eight<F>,
    pub(super) strain_min: Eight<F>,
    /// The instants of these three.
    pub(super) at: [Eight<F>; 3],
}

impl<F: Real> Instants<F> {
    pub(super) fn new() -> Self {
        Self {
            stress: Vec::new(),
            shear: Vec::new(),
            arch: Arch::new(),
        }
    }

    /// Takes the stresses of a path.
    pub(super) fn load(&mut self, path: &Path) {
        self.stress.clear();
        self.stress.extend(path.instants().map(|s| s.map(F::near)));
        let none = [[F::near(0.0); LANES]; 2];
        self.shear.resize(self.stress.len(), none);
    }

    /// Largest normal stress on the planes of eight unit normals, largest and smallest of
    /// `strain[0]` times the normal stress less `strain[1]` times the sum of the normal stresses,
    /// and, where `shear` is asked for, the shear stress at every instant, which stays here.
    pub(super) fn sweep(
        &mut self,
        n: &[Eight<f64>; 3],
        strain: Option<[f64; 2]>,
        shear: bool,
    ) -> Swept<F> {
        let (strained, strain) = (strain.is_some(), strain.unwrap_or_default().map(F::near));
        let (arch, stress) = (self.arch, &self.stress);
        let n = n.map(|d| d.map(F::near));
        if shear && strained {
            let shear = &mut self.shear;
            arch.dispatch(Sweep::<F, true, true> {
                stress,
                shear,
                n,
                strain,
            })
        } else if shear {
            let shear = &mut self.shear;
            arch.dispatch(Sweep::<F, true, false> {
                stress,
                shear,
                n,
                strain,
            })
        } else {
            let shear = &mut [];
            arch.dispatch(Sweep::<F, false, true> {
                stress,
                shear,
                n,
                strain,
            })
        }
    }

    /// The smallest circles round the shear that the last sweep left on each plane, from three
    /// instants; squares of radii of at most `enough` need not be the smallest.
    pub(super) fn circles(&self, on: [Lanes; 3], enough: Lanes) -> Found {
        let shear = &self.shear;
        self.arch.dispatch(Circles { shear, on, enough })
    }
}

/// [`Instants::sweep`], compiled for the processor.
struct Sweep<'a, F, const SHEAR: bool, const STRAIN: bool> {
    stress: &'a [[F; 6]],
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
            shear,
            n,
            strain,
        } = self;
        let [low, high] = [F::near(f64::NEG_INFINITY), F::near(f64::INFINITY)];
        let mut normal_max = [low; LANES];
        let (mut strain_max, mut strain_min) = (normal_max, [high; LANES]);
        let normal = normal_weights(&n);
        let [u, v] = if SHEAR {
            shear_weights(&n)
        } else {
            [normal; 2]
        };
        let mut at = [[F::near(0.0); LANES]; 3];
        let (mut mark, one) = (F::near(0.0), F::near(1.0));
        for (t, s) in stress.iter().enumerate() {
            let mut value = weighted(&normal, s);
            F::raise_marked(simd, &mut normal_max, &mut at[0], &value, mark);
            if STRAIN {
                let across = strain[1] * (s[0] + s[1] + s[2]);
                for l in 0..LANES {
                    value[l] = strain[0] * value[l] - across;
                }
                F::raise_marked(simd, &mut strain_max, &mut at[1], &value, mark);
                F::lower_marked(simd, &mut strain_min, &mut at[2], &value, mark);
            }
            if SHEAR {
                shear[t] = [weighted(&u, s), weighted(&v, s)];
            }
            mark = mark + one;
        }
        Swept {
            normal_max,
            strain_max,
            strain_min,
            at,
        }
    }
}

#[inline(always)]
fn weighted<F: Real>(weights: &[Eight<F>; 6], s: &[F; 6]) -> Eight<F> {
    let mut sum = [F::near(0.0); LANES];
    for c in 0..6 {
        for l in 0..LANES {
            sum[l] = weights[c][l].mul_add(s[c], sum[l]);
        }
    }
    sum
}

/// n.S.n as a sum of the components.
#[inline(always)]
fn normal_weights<F: Real>([x, y, z]: &[Eight<F>; 3]) -> [Eight<F>; 6] {
    let two = F::near(2.0);
    let mut weights = [[F::near(0.0); LANES]; 6];
    for l in 0..LANES {
        weights[0][l] = x[l] * x[l];
        weights[1][l] = y[l] * y[l];
        weights[2][l] = z[l] * z[l];
        weights[3][l] = two * x[l] * y[l];
        weights[4][l] = two * x[l] * z[l];
        weights[5][l] = two * y[l] * z[l];
    }
    weights
}

/// u.S.n and v.S.n as sums of the components; u and v are unit vectors across n and each other.
#[inline(always)]
fn shear_weights<F: Real>(n: &[Eight<F>; 3]) -> [[Eight<F>; 6]; 2] {
    let mut weights = [[[F::near(0.0); LANES]; 6]; 2];
    for l in 0..LANES {
        let n = [n[0][l], n[1][l], n[2][l]];
        for (weights, u) in weights.iter_mut().zip(across(n)) {
            for c in 0..3 {
                weights[c][l] = u[c] * n[c];
            }
            for (c, i, j) in [(3, 0, 1), (4, 0, 2), (5, 1, 2)] {
                weights[c][l] = u[i] * n[j] + u[j] * n[i];
            }
        }
    }
    weights
}

/// Unit vectors across n and each other, without roots: T. Duff et al., J. Comput. Graph. Tech. 6
/// (2017) 1-8.
#[inline(always)]
fn across<F: Real>([x, y, z]: [F; 3]) -> [[F; 3]; 2] {
    let [one, none] = [F::near(1.0), F::near(0.0)];
    let sign = if z < none { none - one } else { one };
    let a = none - F::near(1.0 / (sign + z).wide());
    let b = x * y * a;
    [
        [one + sign * x * x * a, sign * b, none - sign * x],
        [b, sign + y * y * a, none - y],
    ]
}
