//! Numbers in blocks of eight, as vector instructions take them.

#![allow(
    clippy::inline_always,
    reason = "they are to be compiled for the processor of the caller"
)]

use std::ops::{Add, Mul, Sub};

use pulp::Simd;

/// Numbers side by side.
pub(crate) const LANES: usize = 8;
/// Rounding of a stress on a plane, in spacings of the numbers next to 1 and largest components: a
/// sum of nine products whose factors are rounded, counted generously.
pub(crate) const ROUNDING: f64 = 32.0;

/// A number at eight instants, or on eight planes.
pub(crate) type Eight<F> = [F; LANES];
/// A number at eight instants.
pub(crate) type Lanes = Eight<f64>;

/// Single or double precision.
pub(crate) trait Real:
    Copy + PartialOrd + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self>
{
    /// Spacing of the numbers next to 1.
    const EPSILON: f64;
    /// The nearest number.
    fn near(value: f64) -> Self;
    /// The number in double precision.
    fn wide(self) -> f64;
    /// self times by, plus add.
    fn mul_add(self, by: Self, add: Self) -> Self;
    /// Keeps the larger number in each lane.
    fn raise<S: Simd>(simd: S, most: &mut Eight<Self>, by: &Eight<Self>);
    /// Keeps the smaller number in each lane.
    fn lower<S: Simd>(simd: S, least: &mut Eight<Self>, by: &Eight<Self>);
    /// Keeps the larger number in each lane, and its mark.
    fn raise_marked<S: Simd>(
        simd: S,
        most: &mut Eight<Self>,
        marks: &mut Eight<Self>,
        by: &Eight<Self>,
        mark: Self,
    );
    /// Keeps the smaller number in each lane, and its mark.
    fn lower_marked<S: Simd>(
        simd: S,
        least: &mut Eight<Self>,
        marks: &mut Eight<Self>,
        by: &Eight<Self>,
        mark: Self,
    );
}

macro_rules! real {
    ($float:ty, $view:ident, $edit:ident, $max:ident, $min:ident, $more:ident, $select:ident, $splat:ident) => {
        impl Real for $float {
            const EPSILON: f64 = <$float>::EPSILON as f64;
            /// The nearest number of this precision.
            #[inline(always)]
            fn near(value: f64) -> Self {
                value as Self
            }
            /// The number in double precision.
            #[inline(always)]
            fn wide(self) -> f64 {
                f64::from(self)
            }
            /// self times `by` plus `add`.
            #[inline(always)]
            fn mul_add(self, by: Self, add: Self) -> Self {
                self.mul_add(by, add)
            }
            /// Replaces each lane by the larger of the two.
            #[inline(always)]
            fn raise<S: Simd>(simd: S, most: &mut Eight<Self>, by: &Eight<Self>) {
                for (most, by) in S::$edit(most).0.iter_mut().zip(S::$view(by).0) {
                    *most = simd.$max(*most, *by);
                }
            }
            /// Replaces each lane by the smaller of the two.
            #[inline(always)]
            fn lower<S: Simd>(simd: S, least: &mut Eight<Self>, by: &Eight<Self>) {
                for (least, by) in S::$edit(least).0.iter_mut().zip(S::$view(by).0) {
                    *least = simd.$min(*least, *by);
                }
            }
            /// Replaces each lane by the larger of the two; lanes that change get the `mark`.
            #[inline(always)]
            fn raise_marked<S: Simd>(
                simd: S,
                most: &mut Eight<Self>,
                marks: &mut Eight<Self>,
                by: &Eight<Self>,
                mark: Self,
            ) {
                let mark = simd.$splat(mark);
                let most = S::$edit(most).0.iter_mut();
                let marks = S::$edit(marks).0.iter_mut();
                for ((most, at), by) in most.zip(marks).zip(S::$view(by).0) {
                    let more = simd.$more(*by, *most);
                    *at = simd.$select(more, mark, *at);
                    *most = simd.$max(*most, *by);
                }
            }
            /// Replaces each lane by the smaller of the two; lanes that change get the `mark`.
            #[inline(always)]
            fn lower_marked<S: Simd>(
                simd: S,
                least: &mut Eight<Self>,
                marks: &mut Eight<Self>,
                by: &Eight<Self>,
                mark: Self,
            ) {
                let mark = simd.$splat(mark);
                let least = S::$edit(least).0.iter_mut();
                let marks = S::$edit(marks).0.iter_mut();
                for ((least, at), by) in least.zip(marks).zip(S::$view(by).0) {
                    let less = simd.$more(*least, *by);
                    *at = simd.$select(less, mark, *at);
                    *least = simd.$min(*least, *by);
                }
            }
        }
    };
}
real!(
    f32,
    as_simd_f32s,
    as_mut_simd_f32s,
    max_f32s,
    min_f32s,
    greater_than_f32s,
    select_f32s_m32s,
    splat_f32s
);
real!(
    f64,
    as_simd_f64s,
    as_mut_simd_f64s,
    max_f64s,
    min_f64s,
    greater_than_f64s,
    select_f64s_m64s,
    splat_f64s
);

/// The largest of the lanes.
#[inline(always)]
pub(crate) fn max_lane(lanes: &Lanes) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let [a, b, c, d, e, f, g, h] = *lanes;
    larger(
        larger(larger(a, b), larger(c, d)),
        larger(larger(e, f), larger(g, h)),
    )
}

/// The smallest of the lanes.
#[inline(always)]
pub(crate) fn min_lane(lanes: &Lanes) -> f64 {
    -max_lane(&lanes.map(|v| -v))
}

/// The largest number of all blocks.
#[inline(always)]
pub(crate) fn max_of_blocks(blocks: &[Lanes]) -> f64 {
    let mut largest = [f64::NEG_INFINITY; LANES];
    for block in blocks {
        for l in 0..LANES {
            largest[l] = if block[l] > largest[l] {
                block[l]
            } else {
                largest[l]
            };
        }
    }
    max_lane(&largest)
}

/// Index of the number that is `value`, 0 if there is none.
#[inline(always)]
pub(crate) fn index_of_value(blocks: &[Lanes], value: f64) -> usize {
    let equal = |v: &f64| v.to_bits() == value.to_bits();
    blocks.as_flattened().iter().position(equal).unwrap_or(0)
}
