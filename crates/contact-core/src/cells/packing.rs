//! The contact cells, packed one behind the other.
//!
//! The unknowns live on the contact alone, often less than half of the grid. Contact cells that
//! lie side by side are copied together.

use std::ops::Range;

use rayon::prelude::*;

use super::{CHUNK, run_both};

/// Cells that are tested together: mostly all of them lie in the contact, or none.
const STRIDE: usize = 16;

/// Runs of contact cells in the order of the grid.
#[derive(Debug, Default)]
pub(crate) struct ContactCells {
    runs: Vec<Range<usize>>,
    count: usize,
}

impl ContactCells {
    /// Finds the cells n < `cells` for which `inside(n)` holds, and stores them as runs.
    pub(crate) fn find(&mut self, cells: usize, inside: impl Fn(usize) -> bool) {
        self.runs.clear();
        self.count = 0;
        let mut run = None;
        for first in (0..cells).step_by(STRIDE) {
            let stride = first..cells.min(first + STRIDE);
            let inside_count = stride.clone().filter(|&n| inside(n)).count();
            if inside_count == if run.is_some() { stride.len() } else { 0 } {
                continue;
            }
            for n in stride {
                match (inside(n), run) {
                    (true, None) => run = Some(n),
                    (false, Some(from)) => {
                        self.push_run(from..n);
                        run = None;
                    }
                    _ => {}
                }
            }
        }
        if let Some(from) = run {
            self.push_run(from..cells);
        }
    }

    /// Appends a run of consecutive cells of the field, and counts its cells.
    fn push_run(&mut self, run: Range<usize>) {
        self.count += run.len();
        self.runs.push(run);
    }

    /// Number of contact cells.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Copies the values of the contact cells from a field.
    pub(crate) fn pack<T: Copy>(&self, field: &[T], packed: &mut [T]) {
        for (run, at) in self.runs() {
            packed[at..at + run.len()].copy_from_slice(&field[run]);
        }
    }

    /// Copies values into the contact cells of a field; the others keep their values.
    pub(crate) fn unpack<T: Copy>(&self, packed: &[T], field: &mut [T]) {
        for (run, at) in self.runs() {
            let length = run.len();
            field[run].copy_from_slice(&packed[at..at + length]);
        }
    }

    /// [`Self::pack`] for many fields, which take the length of the contact; empty fields stay
    /// empty.
    pub(crate) fn pack_all<const N: usize>(&self, fields: [(&[f64], &mut Vec<f64>); N]) {
        let pack = |(field, packed): (&[f64], &mut Vec<f64>)| {
            packed.resize(if field.is_empty() { 0 } else { self.count }, 0.0);
            if !field.is_empty() {
                self.pack(field, packed);
            }
        };
        if self.count > CHUNK {
            fields.into_par_iter().for_each(pack);
        } else {
            fields.into_iter().for_each(pack);
        }
    }

    /// [`Self::pack`] for two fields.
    pub(crate) fn pack_pair(&self, fields: &[Vec<f64>; 2], packed: &mut [Vec<f64>; 2]) {
        let ([a, b], [to_a, to_b]) = (fields, packed);
        run_both(self.count, || self.pack(a, to_a), || self.pack(b, to_b));
    }

    /// [`Self::unpack`] for two fields.
    pub(crate) fn unpack_pair(&self, packed: &[Vec<f64>; 2], fields: &mut [Vec<f64>; 2]) {
        let ([a, b], [to_a, to_b]) = (packed, fields);
        run_both(self.count, || self.unpack(a, to_a), || self.unpack(b, to_b));
    }

    /// Yields the runs and the position of each in packed order.
    fn runs(&self) -> impl Iterator<Item = (Range<usize>, usize)> {
        self.runs.iter().scan(0, |at, run| {
            let begin = *at;
            *at += run.len();
            Some((run.clone(), begin))
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::cells::ContactCells;

    #[test]
    fn packing_and_unpacking_are_inverse() {
        let field: Vec<f64> = (0..20).map(f64::from).collect();
        let inside = |n: usize| n < 2 || (5..9).contains(&n) || n == 19;
        let mut cells = ContactCells::default();
        cells.find(20, inside);
        let mut packed = vec![0.0; cells.count()];
        cells.pack(&field, &mut packed);
        assert_eq!(packed, [0.0, 1.0, 5.0, 6.0, 7.0, 8.0, 19.0]);
        let mut unpacked = vec![-1.0; 20];
        cells.unpack(&packed, &mut unpacked);
        let expected: Vec<f64> = (0..20)
            .map(|n| if inside(n) { field[n] } else { -1.0 })
            .collect();
        assert_eq!(unpacked, expected);
    }
}
