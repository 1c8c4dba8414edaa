//! Instants in blocks of eight, which the compiler turns into vector instructions.

/// Instants side by side.
pub(super) const LANES: usize = 8;
/// A number at eight instants.
pub(super) type Lanes = [f64; LANES];

/// Keeps the larger of each lane.
pub(super) fn raise(most: &mut Lanes, by: &Lanes) {
    for l in 0..LANES {
        most[l] = if by[l] > most[l] { by[l] } else { most[l] };
    }
}

/// Keeps the smaller of each lane.
pub(super) fn lower(least: &mut Lanes, by: &Lanes) {
    for l in 0..LANES {
        least[l] = if by[l] < least[l] { by[l] } else { least[l] };
    }
}

/// The largest of the lanes.
pub(super) fn top(lanes: &Lanes) -> f64 {
    lanes.iter().fold(f64::NEG_INFINITY, |m, v| m.max(*v))
}

/// The smallest of the lanes.
pub(super) fn bottom(lanes: &Lanes) -> f64 {
    lanes.iter().fold(f64::INFINITY, |m, v| m.min(*v))
}

/// The largest number of all blocks.
pub(super) fn largest(blocks: &[Lanes]) -> f64 {
    let mut most = [f64::NEG_INFINITY; LANES];
    for block in blocks {
        raise(&mut most, block);
    }
    top(&most)
}

/// The instant at which the number is `value`, 0 if at none.
pub(super) fn place_of(blocks: &[Lanes], value: f64) -> usize {
    let equal = |v: &f64| v.to_bits() == value.to_bits();
    blocks.as_flattened().iter().position(equal).unwrap_or(0)
}
