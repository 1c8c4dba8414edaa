//! Sweeps over the cells of some fields at once.
//!
//! Most work besides convolutions is limited by memory: all operations on a cell are done in one
//! sweep. The cells are handed over by their values, not looked up by their number, so that the
//! processor takes several at once; and in chunks shared by the threads. The order of sums depends
//! on nothing but the number of cells.

use std::ops::Range;

use super::CHUNK;

/// Cells that are processed together, in registers; each has separate sums.
const BLOCK: usize = 8;

/// Fields that are read.
pub(crate) trait Fields: Copy + Sync {
    /// The values of one cell.
    type Cell;
    /// The values of [`BLOCK`] cells.
    type Block;
    /// The last cells, filled up to a block.
    type Last;
    /// Fields of other cells.
    type Other<'b>: Fields<Cell = Self::Cell>;

    /// Whether all fields have this number of cells.
    fn have_length(self, cells: usize) -> bool;
    /// The number of cells; none without a field.
    fn cells(self) -> usize;
    /// A range of the cells.
    fn slice(self, cells: Range<usize>) -> Self;
    /// The block that begins with cell n.
    fn block(self, n: usize) -> Option<Self::Block>;
    /// Cell i of a block.
    fn cell_of_block(block: &Self::Block, i: usize) -> Self::Cell;
    /// The cells from n on, fewer than a block, the last one repeated.
    fn last_cells(self, n: usize) -> Self::Last;
    /// The last cells as fields of one block.
    fn fields_of_last(last: &Self::Last) -> Self::Other<'_>;
}

/// The tail of a field, from cell n to its end: fewer than a block. The block is filled up with the last cell.
fn last_cells_of<T: Copy + Default>(field: &[T], n: usize) -> [T; BLOCK] {
    let remaining = &field[n..];
    std::array::from_fn(|i| {
        remaining
            .get(i)
            .or(remaining.last())
            .copied()
            .unwrap_or_default()
    })
}

impl<'a, const R: usize> Fields for [&'a [f64]; R] {
    type Cell = [f64; R];
    type Block = [&'a [f64; BLOCK]; R];
    type Last = [[f64; BLOCK]; R];
    type Other<'b> = [&'b [f64]; R];

    /// Whether every field has this number of cells.
    fn have_length(self, cells: usize) -> bool {
        self.iter().all(|f| f.len() == cells)
    }

    fn cells(self) -> usize {
        self.first().map_or(0, |f| f.len())
    }

    fn slice(self, cells: Range<usize>) -> Self {
        self.map(|f| &f[cells.clone()])
    }

    /// The eight cells from n on of every field; none if fewer are left.
    #[inline]
    fn block(self, n: usize) -> Option<Self::Block> {
        const NONE: &[f64; BLOCK] = &[0.0; BLOCK];
        let mut block = [NONE; R];
        for (block, field) in block.iter_mut().zip(self) {
            *block = field.get(n..)?.first_chunk()?;
        }
        Some(block)
    }

    #[inline]
    fn cell_of_block(block: &Self::Block, i: usize) -> Self::Cell {
        block.map(|f| f[i])
    }

    /// The cells from n to the end of every field, filled up to a block with the last one.
    fn last_cells(self, n: usize) -> Self::Last {
        self.map(|f| last_cells_of(f, n))
    }

    /// The filled blocks as fields.
    fn fields_of_last(last: &Self::Last) -> Self::Other<'_> {
        last.each_ref().map(|f| &f[..])
    }
}

/// Marks.
impl<'a> Fields for &'a [bool] {
    type Cell = bool;
    type Block = &'a [bool; BLOCK];
    type Last = [bool; BLOCK];
    type Other<'b> = &'b [bool];

    fn have_length(self, cells: usize) -> bool {
        self.len() == cells
    }

    fn cells(self) -> usize {
        self.len()
    }

    fn slice(self, cells: Range<usize>) -> Self {
        &self[cells]
    }

    /// The eight cells from n on; none if fewer are left.
    #[inline]
    fn block(self, n: usize) -> Option<Self::Block> {
        self.get(n..)?.first_chunk()
    }

    #[inline]
    fn cell_of_block(block: &Self::Block, i: usize) -> bool {
        block[i]
    }

    /// The cells from n to the end, filled up to a block with the last one.
    fn last_cells(self, n: usize) -> Self::Last {
        last_cells_of(self, n)
    }

    /// The filled block as a field.
    fn fields_of_last(last: &Self::Last) -> Self::Other<'_> {
        last
    }
}

impl<A: Fields, B: Fields> Fields for (A, B) {
    type Cell = (A::Cell, B::Cell);
    type Block = (A::Block, B::Block);
    type Last = (A::Last, B::Last);
    type Other<'b> = (A::Other<'b>, B::Other<'b>);

    /// Whether the fields of both parts have this number of cells.
    fn have_length(self, cells: usize) -> bool {
        self.0.have_length(cells) && self.1.have_length(cells)
    }

    fn cells(self) -> usize {
        self.0.cells().max(self.1.cells())
    }

    fn slice(self, cells: Range<usize>) -> Self {
        (self.0.slice(cells.clone()), self.1.slice(cells))
    }

    /// The eight cells from n on of both parts; none if fewer are left.
    #[inline]
    fn block(self, n: usize) -> Option<Self::Block> {
        Some((self.0.block(n)?, self.1.block(n)?))
    }

    #[inline]
    fn cell_of_block(block: &Self::Block, i: usize) -> Self::Cell {
        (A::cell_of_block(&block.0, i), B::cell_of_block(&block.1, i))
    }

    /// The cells from n to the end of both parts, filled up to a block with the last one.
    fn last_cells(self, n: usize) -> Self::Last {
        (self.0.last_cells(n), self.1.last_cells(n))
    }

    /// The filled blocks of both parts as fields.
    fn fields_of_last((a, b): &Self::Last) -> Self::Other<'_> {
        (A::fields_of_last(a), B::fields_of_last(b))
    }
}

/// Sets every cell of the fields `to` to its `values(n, from, old)`, and returns the sums of K
/// terms that `values` returns as well.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn sweep<F: Fields, const W: usize, const K: usize>(
    from: F,
    to: [&mut [f64]; W],
    values: impl Fn(usize, F::Cell, [f64; W]) -> ([f64; W], [f64; K]) + Sync,
) -> [f64; K] {
    let cells = to.first().map_or(from.cells(), |to| to.len());
    let (sums, []) = sweep_part(0..cells, from, to, &|n, from, old| {
        let (new, terms) = values(n, from, old);
        (new, terms, [])
    });
    sums
}

/// Sets every cell of the fields `to` to its `values(n, from, old)`.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn set_fields<F: Fields, const W: usize>(
    from: F,
    to: [&mut [f64]; W],
    values: impl Fn(usize, F::Cell, [f64; W]) -> [f64; W] + Sync,
) {
    let [] = sweep(from, to, |n, from, old| (values(n, from, old), []));
}

/// The sums of K `terms(n, cell)`, and the largest of each of M, and zero.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn sums_and_maxima<F: Fields, const K: usize, const M: usize>(
    from: F,
    terms: impl Fn(usize, F::Cell) -> ([f64; K], [f64; M]) + Sync,
) -> ([f64; K], [f64; M]) {
    sweep_part(0..from.cells(), from, [], &|n, from, []| {
        let (terms, sizes) = terms(n, from);
        ([], terms, sizes)
    })
}

/// The sums of K `terms(n, cell)`.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn sums<F: Fields, const K: usize>(
    from: F,
    terms: impl Fn(usize, F::Cell) -> [f64; K] + Sync,
) -> [f64; K] {
    let (sums, []) = sums_and_maxima(from, |n, cell| (terms(n, cell), []));
    sums
}

/// The largest of each of M `sizes(n, cell)`, and zero.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn largest<F: Fields, const M: usize>(
    from: F,
    sizes: impl Fn(usize, F::Cell) -> [f64; M] + Sync,
) -> [f64; M] {
    let ([], largest) = sums_and_maxima(from, |n, cell| ([], sizes(n, cell)));
    largest
}

/// Sweeps a part of the cells, in halves on two threads if it is large. Sets `to` as [`sweep`] does; returns
/// the K sums and the M largest values.
fn sweep_part<F: Fields, const W: usize, const K: usize, const M: usize>(
    cells: Range<usize>,
    from: F,
    mut to: [&mut [f64]; W],
    values: &(impl Fn(usize, F::Cell, [f64; W]) -> ([f64; W], [f64; K], [f64; M]) + Sync),
) -> ([f64; K], [f64; M]) {
    let count = cells.len();
    let lengths_match = from.have_length(count) && to.iter().all(|to| to.len() == count);
    assert!(lengths_match, "the fields have one length");
    if count > CHUNK {
        let middle = (count / 2).next_multiple_of(BLOCK);
        let to_first = to.each_mut().map(|to| {
            let (first, second) = std::mem::take(to).split_at_mut(middle);
            *to = second;
            first
        });
        let (first, second) = (
            cells.start..cells.start + middle,
            cells.start + middle..cells.end,
        );
        let ((mut sums, mut largest), (more_sums, larger)) = rayon::join(
            || sweep_part(first, from.slice(0..middle), to_first, values),
            || sweep_part(second, from.slice(middle..count), to, values),
        );
        (0..K).for_each(|k| sums[k] += more_sums[k]);
        (0..M).for_each(|m| largest[m] = largest[m].max(larger[m]));
        return (sums, largest);
    }
    let (full, remainder) = (count / BLOCK * BLOCK, count % BLOCK);
    let (mut sums, mut largest) = sweep_blocks(
        cells.clone(),
        from,
        to.each_mut().map(|to| &mut **to),
        values,
    );
    if remainder > 0 {
        // Filled up to a block, so that `values` is compiled at one place alone, into the loop over
        // several cells.
        let last = from.last_cells(full);
        let mut new = to.each_ref().map(|to| last_cells_of(to, full));
        let last_range = cells.start + full..cells.end;
        let last_new = new.each_mut().map(|new| &mut new[..]);
        let (more_sums, larger) =
            sweep_blocks(last_range, F::fields_of_last(&last), last_new, values);
        for i in 0..remainder {
            (0..K).for_each(|k| sums[k][i] += more_sums[k][i]);
            (0..M).for_each(|m| largest[m][i] = largest[m][i].max(larger[m][i]));
        }
        for (to, new) in to.iter_mut().zip(&new) {
            to[full..].copy_from_slice(&new[..remainder]);
        }
    }
    let max_of_block = |sizes: [f64; BLOCK]| sizes.into_iter().fold(0.0, f64::max);
    (
        sums.map(|sums| sums.iter().sum()),
        largest.map(max_of_block),
    )
}

/// Sweeps whole blocks of cells. Returns the K sums and the M largest values separately for each position in a
/// block. In the last block, positions beyond the end repeat the last cell.
#[inline(never)]
fn sweep_blocks<F: Fields, const W: usize, const K: usize, const M: usize>(
    cells: Range<usize>,
    from: F,
    to: [&mut [f64]; W],
    values: &(impl Fn(usize, F::Cell, [f64; W]) -> ([f64; W], [f64; K], [f64; M]) + Sync),
) -> ([[f64; BLOCK]; K], [[f64; BLOCK]; M]) {
    let (mut sums, mut largest) = ([[0.0; BLOCK]; K], [[0.0_f64; BLOCK]; M]);
    let count = to.first().map_or(from.cells(), |to| to.len());
    let mut to = to.map(|to| to.as_chunks_mut::<BLOCK>().0);
    for b in 0..count / BLOCK {
        let Some(from) = from.block(b * BLOCK) else {
            break;
        };
        let mut to = to.each_mut().map(|to| &mut to[b]);
        // No field is changed while another is read.
        let mut new = [[0.0; BLOCK]; W];
        for i in 0..BLOCK {
            let old = std::array::from_fn(|w| to[w][i]);
            let n = (cells.start + b * BLOCK + i).min(cells.end - 1);
            let (cell, summed, size) = values(n, F::cell_of_block(&from, i), old);
            (0..W).for_each(|w| new[w][i] = cell[w]);
            (0..K).for_each(|k| sums[k][i] += summed[k]);
            (0..M).for_each(|m| largest[m][i] = largest[m][i].max(size[m]));
        }
        to.iter_mut().zip(new).for_each(|(to, new)| **to = new);
    }
    (sums, largest)
}

#[cfg(test)]
mod tests {
    use super::CHUNK;
    use crate::cells::{sums_and_maxima, sweep};

    #[test]
    fn every_cell_is_swept_once() {
        for cells in [0, 1, 7, 8, 200, CHUNK, CHUNK + 1, 3 * CHUNK + 65] {
            let a: Vec<f64> = (0..cells).map(|n| n as f64).collect();
            let odd: Vec<bool> = (0..cells).map(|n| n % 2 == 1).collect();
            let (mut b, mut c) = (a.clone(), vec![1.0; cells]);
            let to = [&mut b[..], &mut c];
            let [sum, odds] = sweep(([&a[..]], &odd[..]), to, |n, ([a], odd), [b, c]| {
                assert!(a as usize == n && odd == (n % 2 == 1));
                ([2.0 * b, b + c], [a, f64::from(u8::from(odd))])
            });
            assert_eq!(sum as usize, cells * cells.saturating_sub(1) / 2);
            assert_eq!(odds as usize, cells / 2);
            let doubled: Vec<f64> = a.iter().map(|a| 2.0 * a).collect();
            let incremented: Vec<f64> = a.iter().map(|a| a + 1.0).collect();
            assert_eq!((b, c), (doubled, incremented));
            let ([], maxima) = sums_and_maxima([&a[..]], |_, [a]| ([], [a, -a - 1.0]));
            let [largest, zero] = maxima.map(|size| size as usize);
            assert_eq!((largest, zero), (cells.saturating_sub(1), 0));
        }
    }
}
