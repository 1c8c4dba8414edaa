//! Difference of the continued and the constant tractions on the parts of cells near borders.
//!
//! Samples at all depths and in the cells around divide a cell into the same parts, except the smallest
//! ones. The difference on the others is evaluated once.

use std::ops::Range;
use std::sync::OnceLock;

use contact_core::zones::{CellTractions, Continued};
use ndarray::Array2;

use super::divided::{Part, SHARED_DIVISIONS, SharedPart, middles};

/// No place in [`ExcessTables::cells`].
const NONE: u32 = u32::MAX;

/// The cells of a state near borders, each with its table once a sample needs it.
pub(super) struct ExcessTables {
    /// First column and row of the window.
    start: (usize, usize),
    /// Place of each cell of the window in `cells`.
    places: Array2<u32>,
    cells: Vec<OnceLock<Option<Box<ExcessTable>>>>,
    flat: bool,
}

/// The tractions of a cell, and their excess over the constant ones on its parts \[Pa\].
pub(super) struct ExcessTable {
    within: CellTractions,
    flat: bool,
    /// The excess on the parts of each division, in the order of [`middles`].
    divisions: [OnceLock<Box<[[f64; 3]]>>; SHARED_DIVISIONS],
}

impl ExcessTables {
    /// Prepares empty tables for the cells of a window that are near a border, to be filled when they are
    /// needed.
    pub(super) fn new(
        window: &(Range<usize>, Range<usize>),
        flat: bool,
        is_near: impl Fn((usize, usize)) -> bool,
    ) -> Self {
        let start = (window.0.start, window.1.start);
        let mut count = 0;
        let places = Array2::from_shape_fn((window.0.len(), window.1.len()), |(i, j)| {
            if !is_near((start.0 + i, start.1 + j)) {
                return NONE;
            }
            count += 1;
            count - 1
        });
        Self {
            start,
            places,
            cells: (0..count).map(|_| OnceLock::new()).collect(),
            flat,
        }
    }

    /// The table of a cell, computed at its first use; `None` where the tractions are constant.
    pub(super) fn fetch(&self, state: &Continued, cell: (usize, usize)) -> Option<&ExcessTable> {
        let i = cell.0.checked_sub(self.start.0)?;
        let j = cell.1.checked_sub(self.start.1)?;
        let index = *self.places.get((i, j))?;
        let table = self.cells.get(index as usize)?.get_or_init(|| {
            let within = state.tractions_within(cell)?;
            Some(Box::new(ExcessTable {
                within,
                flat: self.flat,
                divisions: std::array::from_fn(|_| OnceLock::new()),
            }))
        });
        table.as_deref()
    }
}

impl ExcessTable {
    /// The excess of the tractions over their constant values on a part of the cell: q_x, q_y, p \[Pa\].
    pub(super) fn on_part(&self, part: &Part) -> [f64; 3] {
        let Some(SharedPart { division, index }) = part.shared else {
            return self.evaluate(part.at);
        };
        let table = self.divisions[division].get_or_init(|| {
            let middles = middles(self.flat, division);
            middles.into_iter().map(|at| self.evaluate(at)).collect()
        });
        table[index]
    }

    /// The excess of the tractions over their constant values at an offset from the middle of the cell: q_x,
    /// q_y, p \[Pa\].
    fn evaluate(&self, offset: (f64, f64)) -> [f64; 3] {
        let q = self.within.evaluate(offset);
        std::array::from_fn(|c| q[c] - self.within.constant[c])
    }
}
