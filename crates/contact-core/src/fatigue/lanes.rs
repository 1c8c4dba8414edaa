//! Instants in blocks of eight, which the compiler turns into vector instructions.

#![allow(
    clippy::inline_always,
    reason = "they are to be compiled for the processor of the caller"
)]

/// Instants side by side.
pub(super) const LANES: usize = 8;
/// A number at eight instants.
pub(super) type Lanes = [f64; LANES];

/// Keeps the larger of each lane.
#[inline(always)]
pub(super) fn raise(most: &mut Lanes, by: &Lanes) {
    for l in 0..LANES {
        most[l] = if by[l] > most[l] { by[l] } else { most[l] };
    }
}

/// Keeps the smaller of each lane.
#[inline(always)]
pub(super) fn lower(least: &mut Lanes, by: &Lanes) {
    for l in 0..LANES {
        least[l] = if by[l] < least[l] { by[l] } else { least[l] };
    }
}

/// The largest of the lanes.
#[inline(always)]
pub(super) fn top(lanes: &Lanes) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let [a, b, c, d, e, f, g, h] = *lanes;
    larger(
        larger(larger(a, b), larger(c, d)),
        larger(larger(e, f), larger(g, h)),
    )
}

/// The smallest of the lanes.
#[inline(always)]
pub(super) fn bottom(lanes: &Lanes) -> f64 {
    -top(&lanes.map(|v| -v))
}

/// The largest number of all blocks.
#[inline(always)]
pub(super) fn largest(blocks: &[Lanes]) -> f64 {
    let mut most = [f64::NEG_INFINITY; LANES];
    for block in blocks {
        raise(&mut most, block);
    }
    top(&most)
}

/// The instant at which the number is `value`, 0 if at none.
#[inline(always)]
pub(super) fn place_of(blocks: &[Lanes], value: f64) -> usize {
    let equal = |v: &f64| v.to_bits() == value.to_bits();
    blocks.as_flattened().iter().position(equal).unwrap_or(0)
}
