//! What cells outside the contact move before they enter it, from a contact kept to its old cells.
//!
//! With the contact kept, in p and in q, the gap over a cell outside closes by c in the increment
//! and the cell moves by m relative to the rigid shift. Both depend on how far the cell is from the
//! edge of the contact, and the edge comes nearer: when it has passed k cells, a cell closes and
//! moves as the one k cells nearer to the old edge does. So cell j outside the old edge enters after
//! j parts t_1 ... t_j of the increment, and has moved by M_j:
//!
//! ```text
//! gap_j = t_1 c_j + t_2 c_{j-1} + ... + t_j c_1
//! M_j   = t_1 m_j + t_2 m_{j-1} + ... + t_j m_1
//! ```
//!
//! t_1 ... t_{j-1} are known from the cells before it. With fine cells this is the convolution with
//! the motion of the edge: gap = 1/da int c dx. Where gap and motion are alike (proportional loads
//! on similar bodies of nu = 0) M_j = m/c gap_j, which is exact, in increments of any size.

/// A cell is taken to enter at the latest so much beyond the end of the increment.
const LATEST: f64 = 2.0;

/// An increment with the contact kept to its old cells.
pub(super) struct KeptContact {
    /// Gap at the start \[m\].
    pub(super) gap: Vec<f64>,
    /// How far the gap closes \[m\].
    pub(super) closing: Vec<f64>,
    /// Motion relative to the rigid shift \[m\].
    pub(super) motion: [Vec<f64>; 2],
    /// Cells along y.
    pub(super) rows: usize,
}

/// How the edge of the contact comes to a cell, one cell after the other.
struct Way {
    /// Parts t of the increment that it takes.
    parts: Vec<f64>,
    /// Closing and motion, under the kept contact, of the cells on the way, the first first, and of the
    /// cell itself \[m\].
    cells: Vec<[f64; 3]>,
}

impl Way {
    /// The way to a cell: through those `before` it, on the mean where these are several.
    fn to(before: &[&Self], gap: f64, cell: [f64; 3]) -> Self {
        let passed = before.iter().map(|way| way.parts.len()).min().unwrap_or(0);
        let mean = |of: &dyn Fn(&Self) -> f64| {
            before.iter().map(|way| of(way)).sum::<f64>() / before.len() as f64
        };
        let mut way = Self {
            parts: (0..passed).map(|i| mean(&|way| way.parts[i])).collect(),
            cells: (0..passed)
                .map(|i| [0, 1, 2].map(|k| mean(&|way| way.cells[i][k])))
                .chain([cell])
                .collect(),
        };
        let [closed, ..] = way.sums();
        let part = (gap - closed) / way.cells[0][0];
        way.parts.push(part.clamp(0.0, LATEST));
        way
    }

    /// Closing and motion over all parts \[m\].
    fn sums(&self) -> [f64; 3] {
        let steps = self.parts.iter().zip(self.cells.iter().rev());
        steps.fold([0.0; 3], |sums, (t, cell)| {
            [0, 1, 2].map(|k| sums[k] + t * cell[k])
        })
    }

    /// Whether the cell enters within the increment.
    fn enters(&self) -> bool {
        self.parts.iter().sum::<f64>() <= 1.0
    }
}

impl KeptContact {
    /// The motion of each cell outside before its entry \[m\]. A cell that no other leads to goes with
    /// t = gap/c.
    pub(super) fn moved(&self, outside: impl Fn(usize) -> bool) -> [Vec<f64>; 2] {
        let cells = self.gap.len();
        let mut moved = [vec![0.0; cells], vec![0.0; cells]];
        let mut put = |n: usize, m: [f64; 2]| {
            moved[0][n] = m[0];
            moved[1][n] = m[1];
        };
        for n in (0..cells).filter(|&n| outside(n)) {
            let t = (self.gap[n] / self.closing[n].max(f64::MIN_POSITIVE)).min(1.0);
            put(n, [0, 1].map(|c| t * self.motion[c][n]));
        }
        let mut reached = vec![false; cells];
        let at_edge =
            |&n: &usize| outside(n) && self.closing[n] > 0.0 && self.beside(n).any(|m| !outside(m));
        let mut layer: Vec<usize> = (0..cells).filter(at_edge).collect();
        // Ways go on from those to the last layer alone; a way is as long as the edge has moved.
        let mut last: Vec<(usize, Way)> = Vec::new();
        while !layer.is_empty() {
            let ways = layer.iter().map(|&n| (n, self.way(n, &last)));
            let mut ways: Vec<(usize, Way)> = ways.collect();
            let mut next = Vec::new();
            for (n, way) in &ways {
                let n = *n;
                let [_, x, y] = way.sums();
                // A cell that enters does so within the increment.
                let over = way.parts.iter().sum::<f64>().max(1.0);
                put(n, [x / over, y / over]);
                if way.enters() {
                    next.extend(self.beside(n).filter(|&m| outside(m)));
                }
                reached[n] = true;
            }
            next.sort_unstable();
            next.dedup();
            next.retain(|&n| !reached[n] && self.closing[n] > 0.0);
            ways.retain(|(_, way)| way.enters());
            (layer, last) = (next, ways);
        }
        moved
    }

    /// The way to cell n through those beside it in the layer before that enter, sorted by cell.
    fn way(&self, n: usize, layer: &[(usize, Way)]) -> Way {
        let to = |m: usize| layer.binary_search_by_key(&m, |(cell, _)| *cell).ok();
        let before = self.beside(n).filter_map(to);
        let before: Vec<&Way> = before.map(|at| &layer[at].1).collect();
        let cell = [self.closing[n], self.motion[0][n], self.motion[1][n]];
        Way::to(&before, self.gap[n], cell)
    }

    /// The cells beside cell n.
    fn beside(&self, n: usize) -> impl Iterator<Item = usize> {
        let (rows, cells) = (self.rows, self.gap.len());
        let j = n % rows;
        [
            n.checked_sub(rows),
            (n + rows < cells).then_some(n + rows),
            (j > 0).then(|| n - 1),
            (j + 1 < rows).then(|| n + 1),
        ]
        .into_iter()
        .flatten()
    }
}
