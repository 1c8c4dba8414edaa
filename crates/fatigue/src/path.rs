//! The stress at one point over time, and on planes.

#![allow(
    clippy::inline_always,
    reason = "sweeps are to be compiled for the processor that runs them"
)]

use pulp::{Arch, Simd, WithSimd};
use stress_tensor::{StressTensor, principal, principal_values, von_mises};

use crate::lanes::{LANES, Lanes, Real, index_of_value, max_lane, min_lane};

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
    /// Completes a unit normal by two unit vectors in the plane.
    pub(crate) fn from_normal(n: [f64; 3]) -> Self {
        let [x, y, z] = n.map(f64::abs);
        let axis = if x <= y && x <= z {
            [1.0, 0.0, 0.0]
        } else if y <= z {
            [0.0, 1.0, 0.0]
        } else {
            [0.0, 0.0, 1.0]
        };
        let u = normalize(cross(n, axis));
        Self {
            n,
            u,
            v: cross(n, u),
        }
    }
}

impl Path {
    /// A path without any instant.
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

    /// Largest and smallest value of a sum of weighted components.
    pub(crate) fn range(&self, weights: &[f64; 6]) -> Range {
        let blocks = &self.blocks;
        self.arch.dispatch(RangeSweep { blocks, weights })
    }

    /// The largest normal stress on a plane, and the range of a strain on it. The strain is
    /// `strain[0]` times the normal stress of another path less `strain[1]` times the sum of its
    /// normal stresses.
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
    pub(crate) fn extreme_instants(&self, weights: &[f64; 6]) -> [usize; 2] {
        let blocks = &self.blocks;
        self.arch.dispatch(ExtremesSweep { blocks, weights })
    }

    /// The stress at an instant.
    pub(crate) fn stress_at(&self, instant: usize) -> StressTensor {
        self.blocks[instant / LANES].map(|lanes| lanes[instant % LANES])
    }

    /// Returns the largest normal stress on a plane. Writes the shear of another path along u and v
    /// at every instant.
    pub(crate) fn resolve_on_plane(
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

    /// Bounds of Tresca's equivalent stress, from von Mises': the largest of any instant, and the
    /// largest of the deviation of any instant from one constant stress.
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
    pub(crate) fn max_component(&self) -> f64 {
        max_abs(self.blocks.as_flattened().as_flattened())
    }

    /// The largest principal stress of any instant, and its direction.
    pub(crate) fn max_principal(&self) -> (f64, [f64; 3]) {
        let mut largest = (f64::NEG_INFINITY, [0.0; 6]);
        for s in self.instants() {
            // No principal stress is above the largest row sum (Gershgorin).
            let [xx, yy, zz, xy, xz, yz] = s;
            let (xy, xz, yz) = (xy.abs(), xz.abs(), yz.abs());
            let row = (xx + xy + xz).max(yy + xy + yz).max(zz + xz + yz);
            if row > largest.0 {
                let first = principal_values(&s)[0];
                if first > largest.0 {
                    largest = (first, s);
                }
            }
        }
        (largest.0, principal(&largest.1).directions[0])
    }
}

/// Largest absolute value.
pub(crate) fn max_abs(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |m, s| m.max(s.abs()))
}

/// The largest power of two that is not above a number; 1 for 0.
pub(crate) fn power_of_two(number: f64) -> f64 {
    if number == 0.0 {
        return 1.0;
    }
    // The exponent alone: a number of the mantissa 1.
    let power = f64::from_bits(number.to_bits() & 0x7FF0_0000_0000_0000);
    power.max(f64::MIN_POSITIVE)
}

/// [`Path::range`], compiled for the processor.
struct RangeSweep<'a> {
    blocks: &'a [[Lanes; 6]],
    weights: &'a [f64; 6],
}

impl WithSimd for RangeSweep<'_> {
    type Output = Range;

    /// Finds the extremes of a weighted sum, with vectors of the processor.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Range {
        let (mut largest, mut smallest) = ([f64::NEG_INFINITY; LANES], [f64::INFINITY; LANES]);
        for block in self.blocks {
            let value = weighted_sum(block, self.weights);
            f64::raise(simd, &mut largest, &value);
            f64::lower(simd, &mut smallest, &value);
        }
        let (max, min) = (max_lane(&largest), min_lane(&smallest));
        Range { max, min }
    }
}

/// [`Path::extreme_instants`], compiled for the processor.
struct ExtremesSweep<'a> {
    blocks: &'a [[Lanes; 6]],
    weights: &'a [f64; 6],
}

impl WithSimd for ExtremesSweep<'_> {
    type Output = [usize; 2];

    /// Finds the instants of the extremes of a weighted sum.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [usize; 2] {
        let (mut largest, mut smallest) = ([f64::NEG_INFINITY; LANES], [f64::INFINITY; LANES]);
        // Blocks of the extremes, as numbers that blend with the others.
        let mut blocks_at = [[0.0; LANES]; 2];
        for (n, block) in self.blocks.iter().enumerate() {
            let (value, n) = (weighted_sum(block, self.weights), n as f64);
            f64::raise_marked(simd, &mut largest, &mut blocks_at[0], &value, n);
            f64::lower_marked(simd, &mut smallest, &mut blocks_at[1], &value, n);
        }
        let lane = |lanes: &Lanes, value: f64| index_of_value(std::slice::from_ref(lanes), value);
        let ends = [
            lane(&largest, max_lane(&largest)),
            lane(&smallest, min_lane(&smallest)),
        ];
        [0, 1].map(|k| blocks_at[k][ends[k]] as usize * LANES + ends[k])
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

    /// Finds the largest normal stress and the range of the strain.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> (f64, Range) {
        let [along, across] = self.strain;
        let mut normal_max = [f64::NEG_INFINITY; LANES];
        let (mut strain_max, mut strain_min) = (normal_max, [f64::INFINITY; LANES]);
        let strained = self.strained.blocks.iter().zip(&self.strained.traces);
        for (block, (strained, trace)) in self.path.blocks.iter().zip(strained) {
            f64::raise(simd, &mut normal_max, &weighted_sum(block, &self.weights));
            let mut value = weighted_sum(strained, &self.weights);
            for l in 0..LANES {
                value[l] = along * value[l] - across * trace[l];
            }
            f64::raise(simd, &mut strain_max, &value);
            f64::lower(simd, &mut strain_min, &value);
        }
        let (max, min) = (max_lane(&strain_max), min_lane(&strain_min));
        (max_lane(&normal_max), Range { max, min })
    }
}

/// [`Path::resolve_on_plane`], compiled for the processor.
struct Resolved<'a> {
    blocks: &'a [[Lanes; 6]],
    strained: &'a [[Lanes; 6]],
    weights: [[f64; 6]; 3],
    shear: &'a mut [[Lanes; 2]],
}

impl WithSimd for Resolved<'_> {
    type Output = f64;

    /// Finds the largest normal stress and writes the shear of every instant.
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let [normal, u, v] = &self.weights;
        let mut largest = [f64::NEG_INFINITY; LANES];
        let blocks = self.blocks.iter().zip(self.strained);
        for ((block, strained), shear) in blocks.zip(self.shear) {
            f64::raise(simd, &mut largest, &weighted_sum(block, normal));
            *shear = [weighted_sum(strained, u), weighted_sum(strained, v)];
        }
        max_lane(&largest)
    }
}

#[inline(always)]
/// Weighted sum of the components, at eight instants.
fn weighted_sum(block: &[Lanes; 6], weights: &[f64; 6]) -> Lanes {
    let mut sum = [0.0; LANES];
    for c in 0..6 {
        for l in 0..LANES {
            sum[l] = weights[c].mul_add(block[c][l], sum[l]);
        }
    }
    sum
}

/// Weights of n.S.n as a sum of the components.
pub(crate) fn normal_weights([x, y, z]: [f64; 3]) -> [f64; 6] {
    [x * x, y * y, z * z, 2.0 * x * y, 2.0 * x * z, 2.0 * y * z]
}

/// Weights of u.S.n as a sum of the components.
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

/// Cross product.
pub(crate) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// Dot product.
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The unit vector.
pub(crate) fn normalize(a: [f64; 3]) -> [f64; 3] {
    let inverse_length = 1.0 / dot(a, a).sqrt();
    [
        a[0] * inverse_length,
        a[1] * inverse_length,
        a[2] * inverse_length,
    ]
}
