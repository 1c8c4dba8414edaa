//! Sweeps over the cells of some fields at once.
//!
//! Most work besides convolutions is limited by memory: all operations on a cell are done in one
//! sweep. The cells are handed over by their values, not looked up by their number, so that the
//! processor takes several at once; and in chunks shared by the threads. The order of sums depends
//! on nothing but the number of cells.

use std::ops::Range;

use super::CHUNK;

/// Cells that are worked out in one go, in registers; each has sums of its own.
const BLOCK: usize = 8;

/// Fields that are read.
pub(crate) trait Fields: Copy + Sync {
    /// The values of one cell.
    type Cell;
    /// Those of [`BLOCK`] cells.
    type Block;
    /// The last cells, filled up to a block.
    type Last;
    /// Fields of other cells.
    type Other<'b>: Fields<Cell = Self::Cell>;

    /// Whether all have so many cells.
    fn have(self, cells: usize) -> bool;
    /// The number of cells; none without a field.
    fn cells(self) -> usize;
    /// Some of the cells.
    fn part(self, cells: Range<usize>) -> Self;
    /// The block that begins with cell n.
    fn block(self, n: usize) -> Option<Self::Block>;
    /// Cell i of a block.
    fn of_block(block: &Self::Block, i: usize) -> Self::Cell;
    /// The cells from n on, less than a block of them, the last one repeated.
    fn last(self, n: usize) -> Self::Last;
    /// These as fields of one block.
    fn of_last(last: &Self::Last) -> Self::Other<'_>;
}

/// The cells of a field from n on, less than a block of them, the last one repeated.
fn last_of<T: Copy + Default>(field: &[T], n: usize) -> [T; BLOCK] {
    let rest = &field[n..];
    std::array::from_fn(|i| rest.get(i).or(rest.last()).copied().unwrap_or_default())
}

impl<'a, const R: usize> Fields for [&'a [f64]; R] {
    type Cell = [f64; R];
    type Block = [&'a [f64; BLOCK]; R];
    type Last = [[f64; BLOCK]; R];
    type Other<'b> = [&'b [f64]; R];

    fn have(self, cells: usize) -> bool {
        self.iter().all(|f| f.len() == cells)
    }

    fn cells(self) -> usize {
        self.first().map_or(0, |f| f.len())
    }

    fn part(self, cells: Range<usize>) -> Self {
        self.map(|f| &f[cells.clone()])
    }

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
    fn of_block(block: &Self::Block, i: usize) -> Self::Cell {
        block.map(|f| f[i])
    }

    fn last(self, n: usize) -> Self::Last {
        self.map(|f| last_of(f, n))
    }

    fn of_last(last: &Self::Last) -> Self::Other<'_> {
        last.each_ref().map(|f| &f[..])
    }
}

/// Marks.
impl<'a> Fields for &'a [bool] {
    type Cell = bool;
    type Block = &'a [bool; BLOCK];
    type Last = [bool; BLOCK];
    type Other<'b> = &'b [bool];

    fn have(self, cells: usize) -> bool {
        self.len() == cells
    }

    fn cells(self) -> usize {
        self.len()
    }

    fn part(self, cells: Range<usize>) -> Self {
        &self[cells]
    }

    #[inline]
    fn block(self, n: usize) -> Option<Self::Block> {
        self.get(n..)?.first_chunk()
    }

    #[inline]
    fn of_block(block: &Self::Block, i: usize) -> bool {
        block[i]
    }

    fn last(self, n: usize) -> Self::Last {
        last_of(self, n)
    }

    fn of_last(last: &Self::Last) -> Self::Other<'_> {
        last
    }
}

impl<A: Fields, B: Fields> Fields for (A, B) {
    type Cell = (A::Cell, B::Cell);
    type Block = (A::Block, B::Block);
    type Last = (A::Last, B::Last);
    type Other<'b> = (A::Other<'b>, B::Other<'b>);

    fn have(self, cells: usize) -> bool {
        self.0.have(cells) && self.1.have(cells)
    }

    fn cells(self) -> usize {
        self.0.cells().max(self.1.cells())
    }

    fn part(self, cells: Range<usize>) -> Self {
        (self.0.part(cells.clone()), self.1.part(cells))
    }

    #[inline]
    fn block(self, n: usize) -> Option<Self::Block> {
        Some((self.0.block(n)?, self.1.block(n)?))
    }

    #[inline]
    fn of_block(block: &Self::Block, i: usize) -> Self::Cell {
        (A::of_block(&block.0, i), B::of_block(&block.1, i))
    }

    fn last(self, n: usize) -> Self::Last {
        (self.0.last(n), self.1.last(n))
    }

    fn of_last((a, b): &Self::Last) -> Self::Other<'_> {
        (A::of_last(a), B::of_last(b))
    }
}

/// Sets every cell of the fields `to` to its `values(n, from, old)`, and returns the sums of K
/// terms that these come with.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn sweep<F: Fields, const W: usize, const K: usize>(
    from: F,
    to: [&mut [f64]; W],
    values: impl Fn(usize, F::Cell, [f64; W]) -> ([f64; W], [f64; K]) + Sync,
) -> [f64; K] {
    let cells = to.first().map_or(from.cells(), |to| to.len());
    let (sums, []) = part(0..cells, from, to, &|n, from, old| {
        let (new, terms) = values(n, from, old);
        (new, terms, [])
    });
    sums
}

/// Sets every cell of the fields `to` to its `values(n, from, old)`.
///
/// # Panics
/// If the lengths differ.
pub(crate) fn set<F: Fields, const W: usize>(
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
pub(crate) fn survey<F: Fields, const K: usize, const M: usize>(
    from: F,
    terms: impl Fn(usize, F::Cell) -> ([f64; K], [f64; M]) + Sync,
) -> ([f64; K], [f64; M]) {
    part(0..from.cells(), from, [], &|n, from, []| {
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
    let (sums, []) = survey(from, |n, cell| (terms(n, cell), []));
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
    let ([], largest) = survey(from, |n, cell| ([], sizes(n, cell)));
    largest
}

fn part<F: Fields, const W: usize, const K: usize, const M: usize>(
    cells: Range<usize>,
    from: F,
    mut to: [&mut [f64]; W],
    values: &(impl Fn(usize, F::Cell, [f64; W]) -> ([f64; W], [f64; K], [f64; M]) + Sync),
) -> ([f64; K], [f64; M]) {
    let count = cells.len();
    let fit = from.have(count) && to.iter().all(|to| to.len() == count);
    assert!(fit, "the fields have one length");
    if count > CHUNK {
        let middle = (count / 2).next_multiple_of(BLOCK);
        let to_first = to.each_mut().map(|to| {
            let (first, rest) = std::mem::take(to).split_at_mut(middle);
            *to = rest;
            first
        });
        let (first, rest) = (
            cells.start..cells.start + middle,
            cells.start + middle..cells.end,
        );
        let ((mut sums, mut largest), (more, larger)) = rayon::join(
            || part(first, from.part(0..middle), to_first, values),
            || part(rest, from.part(middle..count), to, values),
        );
        (0..K).for_each(|k| sums[k] += more[k]);
        (0..M).for_each(|m| largest[m] = largest[m].max(larger[m]));
        return (sums, largest);
    }
    let (whole, rest) = (count / BLOCK * BLOCK, count % BLOCK);
    let (mut sums, mut largest) = blocks(
        cells.clone(),
        from,
        to.each_mut().map(|to| &mut **to),
        values,
    );
    if rest > 0 {
        // Filled up to a block, so that `values` is compiled at one place alone, into the loop over
        // several cells.
        let last = from.last(whole);
        let mut new = to.each_ref().map(|to| last_of(to, whole));
        let here = cells.start + whole..cells.end;
        let one = new.each_mut().map(|new| &mut new[..]);
        let (more, larger) = blocks(here, F::of_last(&last), one, values);
        for i in 0..rest {
            (0..K).for_each(|k| sums[k][i] += more[k][i]);
            (0..M).for_each(|m| largest[m][i] = largest[m][i].max(larger[m][i]));
        }
        for (to, new) in to.iter_mut().zip(&new) {
            to[whole..].copy_from_slice(&new[..rest]);
        }
    }
    let of_block = |sizes: [f64; BLOCK]| sizes.into_iter().fold(0.0, f64::max);
    (sums.map(|sums| sums.iter().sum()), largest.map(of_block))
}

/// The whole blocks of some cells: sums and largest values, one of each for every place in a block.
/// Behind the end of the cells the last one is meant.
#[inline(never)]
fn blocks<F: Fields, const W: usize, const K: usize, const M: usize>(
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
            let (cell, summed, size) = values(n, F::of_block(&from, i), old);
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
    use crate::cells::{survey, sweep};

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
            let twice: Vec<f64> = a.iter().map(|a| 2.0 * a).collect();
            let more: Vec<f64> = a.iter().map(|a| a + 1.0).collect();
            assert_eq!((b, c), (twice, more));
            let ([], found) = survey([&a[..]], |_, [a]| ([], [a, -a - 1.0]));
            let [largest, none] = found.map(|size| size as usize);
            assert_eq!((largest, none), (cells.saturating_sub(1), 0));
        }
    }
}
