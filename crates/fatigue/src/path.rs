//! The stress at one point over time, and on planes.

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use pulp::{Arch, Simd, WithSimd};
use stress_tensor::{StressTensor, principal, principal_values, von_mises};

use crate::lanes::{LANES, Lanes, Real, bottom, place_of, top};

/// Tresca's equivalent stress is at most this times von Mises'.
const TRESCA_OVER_MISES: f64 = 1.154_700_538_379_251_5;

/// Stress over time in blocks of instants, as multiples of a power of two so that the largest
/// component is between 1 and 2; the last instant fills the last block.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    pub(crate) blocks: Vec<[Lanes; 6]>,
    /// The unit of stress \[Pa\].
    unit: f64,
    /// Sums of the normal stresses.
    traces: Vec<Lanes>,
    arch: Arch,
}

/// Unit normal of a plane and two unit vectors in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) n: [f64; 3],
    pub(crate) u: [f64; 3],
    pub(crate) v: [f64; 3],
}

/// Largest and smallest value over time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    pub(crate) max: f64,
    pub(crate) min: f64,
}

impl Range {
    /// Half of max - min.
    pub(crate) fn amplitude(&self) -> f64 {
        (self.max - self.min) / 2.0
    }

    /// Middle between max and min.
    pub(crate) fn mean(&self) -> f64 {
        f64::midpoint(self.max, self.min)
    }
}

impl Frame {
    /// A plane of a unit normal.
    pub(crate) fn across(n: [f64; 3]) -> Self {
        let [x, y, z] = n.map(f64::abs);
        let other = if x <= y && x <= z {
            [1.0, 0.0, 0.0]
        } else if y <= z {
            [0.0, 1.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let u = unit(cross(n, other));
        Self {
            n,
            u,
            v: cross(n, u),
        }
    }
}

impl Path {
    pub(crate) fn new() -> Self {
        Self {
            blocks: Vec::new(),
            unit: 1.0,
            traces: Vec::new(),
            arch: Arch::new(),
        }
    }

    /// Takes the stress at every instant \[Pa\], at least one, in a unit \[Pa\].
    pub(crate) fn load(&mut self, instants: &[StressTensor], unit: f64) {
        let blocks = instants.len().div_ceil(LANES);
        self.blocks.resize(blocks, [[0.0; LANES]; 6]);
        self.unit = unit;
        for n in 0..blocks * LANES {
            let s = instants[n.min(instants.len() - 1)];
            for c in 0..6 {
                self.blocks[n / LANES][c][n % LANES] = s[c] / self.unit;
            }
        }
        let trace = |b: &[Lanes; 6]| std::array::from_fn(|l| b[0][l] + b[1][l] + b[2][l]);
        self.traces.clear();
        self.traces.extend(self.blocks.iter().map(trace));
    }

    /// The unit of stress \[Pa\].
    pub(crate) fn unit(&self) -> f64 {
        self.unit
    }

    /// The stress at every instant, the last one repeated to the end of its block.
    pub(crate) fn instants(&self) -> impl Iterator<Item = StressTensor> + '_ {
        let lanes = |block: &[Lanes; 6], l: usize| block.map(|lanes| lanes[l]);
        self.blocks
            .iter()
            .flat_map(move |block| (0..LANES).map(move |l| lanes(block, l)))
    }

    /// Largest and smallest normal stress on a plane.
    pub(crate) fn normal(&self, n: [f64; 3]) -> Range {
        self.range(&normal_weights(n))
    }

    /// Largest and smallest of a sum of weighted components.
    pub(crate) fn range(&self, weights: &[f64; 6]) -> Range {
        let blocks = &self.blocks;
        self.arch.dispatch(RangeOf { blocks, weights })
    }

    /// The largest normal stress on a plane, and the range of `along` times that of another path less
    /// `across` times the sum of its normal stresses.
    pub(crate) fn max_and_range(
        &self,
        strained: &Self,
        n: [f64; 3],
        strain: [f64; 2],
    ) -> (f64, Range) {
        self.arch.dispatch(NormalAndStrain {
            path: self,
            strained,
            weights: normal_weights(n),
            strain,
        })
    }

    /// The instants at which a sum of weighted components is largest and smallest.
    pub(crate) fn extremes(&self, weights: &[f64; 6]) -> [usize; 2] {
        let blocks = &self.blocks;
        self.arch.dispatch(ExtremesOf { blocks, weights })
    }

    /// The stress at an instant.
    pub(crate) fn at(&self, instant: usize) -> StressTensor {
        self.blocks[instant / LANES].map(|lanes| lanes[instant % LANES])
    }

    /// The largest normal stress on a plane, and the shear of another path along u and v at every instant.
    pub(crate) fn resolve(
        &self,
        strained: &Self,
        plane: &Frame,
        shear: &mut Vec<[Lanes; 2]>,
    ) -> f64 {
        shear.resize(self.blocks.len(), [[0.0; LANES]; 2]);
        self.arch.dispatch(Resolved {
            blocks: &self.blocks,
            strained: &strained.blocks,
            weights: [
                normal_weights(plane.n),
                shear_weights(plane.n, plane.u),
                shear_weights(plane.n, plane.v),
            ],
            shear,
        })
    }

    /// Bounds of Tresca's equivalent stress, from von Mises': the largest of any instant, and
    /// the largest of the deviation of any instant from one constant stress.
    pub(crate) fn tresca_bounds(&self) -> (f64, f64) {
        let mut middle = [0.0; 6];
        for (c, middle) in middle.iter_mut().enumerate() {
            let mut weights = [0.0; 6];
            weights[c] = 1.0;
            *middle = self.range(&weights).mean();
        }
        let (mut whole, mut deviation) = (0.0_f64, 0.0_f64);
        for s in self.instants() {
            whole = whole.max(von_mises(&s));
            deviation = deviation.max(von_mises(&std::array::from_fn(|c| s[c] - middle[c])));
        }
        (TRESCA_OVER_MISES * whole, TRESCA_OVER_MISES * deviation)
    }

    /// The largest component of any instant by absolute value: between 1 and 2, or 0 without
    /// stress.
    pub(crate) fn size(&self) -> f64 {
        size(self.blocks.as_flattened().as_flattened())
    }

    /// The largest principal stress of any instant, and its direction.
    pub(crate) fn most_tension(&self) -> (f64, [f64; 3]) {
        let mut most = (f64::NEG_INFINITY, [0.0; 6]);
        for s in self.instants() {
            // No principal stress is above the largest row sum (Gershgorin).
            let [xx, yy, zz, xy, xz, yz] = s;
            let (xy, xz, yz) = (xy.abs(), xz.abs(), yz.abs());
            let row = (xx + xy + xz).max(yy + xy + yz).max(zz + xz + yz);
            if row > most.0 {
                let first = principal_values(&s)[0];
                if first > most.0 {
                    most = (first, s);
                }
            }
        }
        (most.0, principal(&most.1).directions[0])
    }
}

/// The largest of numbers by size.
pub(crate) fn size(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |m, s| m.max(s.abs()))
}

/// The power of two at or below a number; 1 for 0.
pub(crate) fn power_of_two(number: f64) -> f64 {
    if number == 0.0 {
        return 1.0;
    }
    // The exponent alone: a number of the mantissa 1.
    let power = f64::from_bits(number.to_bits() & 0x7FF0_0000_0000_0000);
    power.max(f64::MIN_POSITIVE)
}

/// [`Path::range`], compiled for the processor.
struct RangeOf<'a> {
    blocks: &'a [[Lanes; 6]],
    weights: &'a [f64; 6],
}

impl WithSimd for RangeOf<'_> {
    type Output = Range;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Range {
        let (mut most, mut least) = ([f64::NEG_INFINITY; LANES], [f64::INFINITY; LANES]);
        for block in self.blocks {
            let value = weighted(block, self.weights);
            f64::raise(simd, &mut most, &value);
            f64::lower(simd, &mut least, &value);
        }
        let (max, min) = (top(&most), bottom(&least));
        Range { max, min }
    }
}

/// [`Path::extremes`], compiled for the processor.
struct ExtremesOf<'a> {
    blocks: &'a [[Lanes; 6]],
    weights: &'a [f64; 6],
}

impl WithSimd for ExtremesOf<'_> {
    type Output = [usize; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [usize; 2] {
        let (mut most, mut least) = ([f64::NEG_INFINITY; LANES], [f64::INFINITY; LANES]);
        // Blocks of the extremes, as numbers that blend with the others.
        let mut at = [[0.0; LANES]; 2];
        for (n, block) in self.blocks.iter().enumerate() {
            let (value, n) = (weighted(block, self.weights), n as f64);
            f64::raise_marked(simd, &mut most, &mut at[0], &value, n);
            f64::lower_marked(simd, &mut least, &mut at[1], &value, n);
        }
        let lane = |lanes: &Lanes, value: f64| place_of(std::slice::from_ref(lanes), value);
        let ends = [lane(&most, top(&most)), lane(&least, bottom(&least))];
        [0, 1].map(|k| at[k][ends[k]] as usize * LANES + ends[k])
    }
}

/// [`Path::max_and_range`], compiled for the processor.
struct NormalAndStrain<'a> {
    path: &'a Path,
    strained: &'a Path,
    weights: [f64; 6],
    strain: [f64; 2],
}

impl WithSimd for NormalAndStrain<'_> {
    type Output = (f64, Range);

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (f64, Range) {
        let [along, across] = self.strain;
        let mut first = [f64::NEG_INFINITY; LANES];
        let (mut most, mut least) = (first, [f64::INFINITY; LANES]);
        let strained = self.strained.blocks.iter().zip(&self.strained.traces);
        for (block, (strained, trace)) in self.path.blocks.iter().zip(strained) {
            f64::raise(simd, &mut first, &weighted(block, &self.weights));
            let mut value = weighted(strained, &self.weights);
            for l in 0..LANES {
                value[l] = along * value[l] - across * trace[l];
            }
            f64::raise(simd, &mut most, &value);
            f64::lower(simd, &mut least, &value);
        }
        let (max, min) = (top(&most), bottom(&least));
        (top(&first), Range { max, min })
    }
}

/// [`Path::resolve`], compiled for the processor.
struct Resolved<'a> {
    blocks: &'a [[Lanes; 6]],
    strained: &'a [[Lanes; 6]],
    weights: [[f64; 6]; 3],
    shear: &'a mut [[Lanes; 2]],
}

impl WithSimd for Resolved<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let [normal, u, v] = &self.weights;
        let mut most = [f64::NEG_INFINITY; LANES];
        let blocks = self.blocks.iter().zip(self.strained);
        for ((block, strained), shear) in blocks.zip(self.shear) {
            f64::raise(simd, &mut most, &weighted(block, normal));
            *shear = [weighted(strained, u), weighted(strained, v)];
        }
        top(&most)
    }
}

#[inline(always)]
fn weighted(block: &[Lanes; 6], weights: &[f64; 6]) -> Lanes {
    let mut sum = [0.0; LANES];
    for c in 0..6 {
        for l in 0..LANES {
            sum[l] = weights[c].mul_add(block[c][l], sum[l]);
        }
    }
    sum
}

/// n.S.n as a sum of the components.
pub(crate) fn normal_weights([x, y, z]: [f64; 3]) -> [f64; 6] {
    [x * x, y * y, z * z, 2.0 * x * y, 2.0 * x * z, 2.0 * y * z]
}

/// u.S.n as a sum of the components.
pub(crate) fn shear_weights(n: [f64; 3], u: [f64; 3]) -> [f64; 6] {
    let mixed = |i: usize, j: usize| u[i] * n[j] + u[j] * n[i];
    [
        u[0] * n[0],
        u[1] * n[1],
        u[2] * n[2],
        mixed(0, 1),
        mixed(0, 2),
        mixed(1, 2),
    ]
}

pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn unit(a: [f64; 3]) -> [f64; 3] {
    let by = 1.0 / dot(a, a).sqrt();
    [a[0] * by, a[1] * by, a[2] * by]
}
