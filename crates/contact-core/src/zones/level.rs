//! The level of a zone, extrapolated to the cells at its border.
//!
//! A level f is a power of a traction that vanishes linearly at the border. Tractions constant in
//! the cells make errors of f next to the border: where f is the square of a root, the border
//! computed from the outermost cell is off by up to 1/10 of a cell, from the second by 1/30, from
//! cells further in by less than 1/100. So f is extrapolated from the cells further in: along the
//! line of cells, out of eight directions, closest to the normal of the border, by the parabola
//! through the next cells (`parabola`), or from the cells before the middle of the zone if f is no
//! parabola. Where f bends within a few cells, as on a layer of that thickness or in a narrow slip
//! ring, the outermost cells themselves give the border (`discrete_root`). A linear law needs no
//! cells left out, and slip is extrapolated from the cells next to its border. The border is the
//! straight line f = 0 within a cell.

use super::laws::Power;
use super::parabola::Parabola;
use crate::cells::Lattice;

/// Largest distance of the border from the edge between the outermost cell of the zone and its
/// neighbour outside, in cells along the line: beyond it f is not such a level (a punch with a
/// sharp edge).
const MAX_DISTANCE: f64 = 1.5;
/// Most cells of a line that a level is extrapolated from, those left out included.
const MAX_CELLS: usize = 7;
/// A law is accepted at once if the second differences of its level sum to at most this part of its
/// rise.
const STRAIGHT: f64 = 0.1;

/// Largest difference of the level of a cell from the extrapolated one, over the change of the
/// level per cell: beyond it the level is not smooth (a rough contact, a layer as thin as the
/// cells).
const MAX_DIFFERENCE: f64 = 0.12;

/// Distance of two borders, one from the cells further in and one from the outermost, up to which
/// the first is taken \[cells\]: the other is off by up to 0.08 where a smooth border runs askew.
const MAX_DISAGREEMENT: f64 = 0.1;

/// The cells of a line from which a level is extrapolated.
#[derive(Clone, Copy, Debug)]
pub struct Stencil {
    /// Outermost cells that are left out.
    skipped: usize,
    /// Largest number of cells of a line, including the skipped ones.
    max_cells: usize,
    /// Whether only the cells before the middle of the zone are used if the level is no parabola.
    before_middle: bool,
    /// Distance by which the level of constant tractions vanishes outside the true border
    /// \[cells\]: the mean over positions and directions of the border within the cells, from Hertz
    /// contacts and their stick zones on 384 to 768 cells. Check on a contact that was not used for
    /// it: c/a of the coupled indentation (nu = 0.3, mu = 0.2, 40 increments) is off by 0.30, 0.025
    /// and 0.001 % on 64, 128 and 256 cells with it, by 0.45, 0.10 and 0.04 % without.
    bias: f64,
    /// Whether the outermost cells lie at the border of a root.
    at_border: bool,
}

impl Stencil {
    /// Stencil for a root of the distance.
    pub const ROOT: Self = Self {
        skipped: 2,
        max_cells: MAX_CELLS,
        before_middle: false,
        bias: 0.010,
        at_border: true,
    };
    /// Stencil for a linear law, or for a root where only the law is needed.
    pub const LINEAR: Self = Self {
        skipped: 0,
        max_cells: MAX_CELLS,
        before_middle: false,
        bias: 0.0,
        at_border: false,
    };
    /// Stencil for slip, which changes over the width of a slip ring: the cells next to its border.
    pub(crate) const SLIP: Self = Self {
        skipped: 0,
        max_cells: 3,
        before_middle: false,
        bias: 0.024,
        at_border: false,
    };

    /// Adapts the stencil to a level that may have a kink in the middle of the zone, as the shortfall of the
    /// shear under torsion has (a cone).
    pub(crate) const fn up_to_middle(self) -> Self {
        Self {
            before_middle: true,
            ..self
        }
    }

    /// Adapts the stencil to a zone whose border lies beyond its outermost cells.
    #[must_use]
    pub const fn for_inner_zone(self) -> Self {
        Self {
            at_border: false,
            ..self
        }
    }

    /// Chooses the levels of a line (of a zone `half` cells deep) that are used. Returns these, how many of the
    /// outermost are skipped, and the cell whose gradient gives the normal of the border.
    fn choose(self, levels: &[f64], half: usize) -> (&[f64], usize, usize) {
        let levels = &levels[..levels.len().min(self.max_cells)];
        if !self.before_middle {
            return (levels, self.skipped, 2);
        }
        // A former border next to this one makes the level fall again: only the cells before it are
        // used.
        let rising = levels
            .windows(2)
            .take_while(|pair| pair[1] > pair[0])
            .count()
            + 1;
        if rising < levels.len().min(self.skipped + 3).min(half) {
            let rising = if rising < 2 { 0 } else { rising };
            return (&levels[..rising], 0, 1);
        }
        if Parabola::is_parabola(levels, self.skipped) {
            return (levels, self.skipped, 2);
        }
        let levels = &levels[..levels.len().min(half)];
        let skipped = self.skipped.min((levels.len() - 1) / 3);
        // The cell in the middle has no gradient.
        (levels, skipped, levels.len().saturating_sub(2).min(2))
    }
}

/// A line of cells that leads into a zone.
#[derive(Clone, Copy, Debug)]
pub struct Line {
    /// The last cell before the zone.
    pub(crate) outside: usize,
    /// The first cells of the zone, outermost first, and their number.
    cells: [usize; MAX_CELLS],
    count: usize,
    /// Direction into the zone.
    pub(crate) inwards: [f64; 2],
    /// Step from cell to cell, in columns and rows.
    step: [f64; 2],
    /// Steps from the cell at which the level is extrapolated to the outermost cell of the zone.
    first: f64,
    /// Cells before the middle of the zone along the line, or `ALONG` if there are more.
    half: usize,
}

impl Line {
    /// Finds the line through a cell at the border of a zone; none where the border has no clear direction.
    fn through_border_cell(lattice: Lattice, n: usize, zone: &[bool]) -> Option<Self> {
        let inwards = lattice.direction_into(n, zone)?;
        let (i, j) = lattice.column_and_row(n);
        let cell_at = |k: isize| lattice.stored_cell(i + k * inwards[0], j + k * inwards[1]);
        let in_zone = |m: &usize| zone[*m];
        let first = (-1..=1).find(|&k| cell_at(k).is_some_and(|m| zone[m]))?;
        let step = inwards.map(|k| k as f64);
        // Up to the other side of the zone.
        let cells = (first..).map_while(|k| cell_at(k).filter(in_zone));
        let mut line = Self {
            outside: cell_at(first - 1).filter(|m| !in_zone(m))?,
            cells: [0; MAX_CELLS],
            count: 0,
            inwards: step.map(|k| k / step[0].hypot(step[1])),
            step,
            first: first as f64,
            half: cells.clone().take(2 * MAX_CELLS).count().div_ceil(2),
        };
        for m in cells.take(MAX_CELLS) {
            line.cells[line.count] = m;
            line.count += 1;
        }
        Some(line)
    }

    /// The first cell of the zone.
    pub fn outermost(&self) -> usize {
        self.cells[0]
    }

    /// Whether a parabola has its border within [`MAX_DISTANCE`] of the outermost cell's edge and grows
    /// inwards.
    fn fits(&self, parabola: Parabola) -> bool {
        let at = parabola.outermost;
        (0.5 - parabola.distance_inside()).abs() <= MAX_DISTANCE
            && parabola.slope(at) > 0.0
            && parabola.slope(at - self.first) > 0.0
    }

    /// Keeps the first `count` cells for the extrapolation.
    pub(crate) fn shorten(&mut self, count: usize) {
        self.count = self.count.min(count);
    }

    /// The first cells of the zone, outermost first.
    pub(crate) fn cells(&self) -> &[usize] {
        &self.cells[..self.count]
    }

    /// The power whose level is straight ([`STRAIGHT`]) over the first `checked` cells of the line: the first
    /// such one, or else the straightest. Returns its index and the levels of all cells.
    fn straightest<const K: usize>(
        &self,
        powers: &[Power; K],
        value: impl Fn(usize) -> f64,
        checked: usize,
    ) -> (usize, [f64; MAX_CELLS]) {
        let mut values = [0.0; MAX_CELLS];
        for (value_k, &m) in values.iter_mut().zip(self.cells()) {
            *value_k = value(m);
        }
        let levels = |law: usize| values.map(|value| powers[law].level_of(value));
        let curvature = |levels: &[f64; MAX_CELLS]| relative_curvature(&levels[1..checked]);
        let (mut law, mut levels_of_law) = (0, levels(0));
        for candidate in 1..K {
            let bend_so_far = curvature(&levels_of_law);
            if bend_so_far <= STRAIGHT {
                break;
            }
            let candidate_levels = levels(candidate);
            if curvature(&candidate_levels) < bend_so_far || bend_so_far.is_nan() {
                (law, levels_of_law) = (candidate, candidate_levels);
            }
        }
        (law, levels_of_law)
    }
}

/// A level extrapolated to a cell at the border of a zone.
#[derive(Clone, Copy, Debug)]
pub struct Level {
    /// The line that it is extrapolated along.
    pub line: Line,
    /// Index of the law among the laws of its zone.
    pub law: usize,
    /// [`Stencil::bias`]
    pub(crate) bias: f64,
    /// Its value at the cell's centre.
    pub middle: f64,
    /// Its gradient per cell along x and y.
    pub gradient: [f64; 2],
    /// Half of its second derivative along the line, per step.
    pub(crate) bend: f64,
}

impl Level {
    /// The columns and rows to the next cell of the line inwards, and the level there.
    pub(crate) fn next_inwards(&self) -> ([f64; 2], f64) {
        let ([a, b], [of_x, of_y]) = (self.line.step, self.gradient);
        ([a, b], self.middle + a * of_x + b * of_y + self.bend)
    }

    /// Whether it agrees with the level `own` of the cell itself.
    pub(crate) fn agrees_with(&self, own: f64) -> bool {
        agree(self.middle, self.gradient, own)
    }
}

/// Whether an extrapolated level agrees with the level `own` of the cell itself ([`MAX_DIFFERENCE`]); negative values
/// count as zero.
pub(super) fn agree(middle: f64, gradient: [f64; 2], own: f64) -> bool {
    (middle.max(0.0) - own).abs() <= MAX_DIFFERENCE * gradient[0].hypot(gradient[1])
}

impl Lattice {
    /// The straightest level at the centre of a cell, extrapolated from inside.
    pub(super) fn extrapolate_level<const K: usize, V: Fn(usize) -> f64>(
        self,
        n: usize,
        zone: &[bool],
        stencils: [Stencil; K],
        laws: &impl Fn(&mut Line) -> ([Power; K], V),
    ) -> Option<Level> {
        let mut line = Line::through_border_cell(self, n, zone)?;
        let (powers, value) = laws(&mut line);
        let checked = if stencils[0].before_middle {
            line.count.min(line.half)
        } else {
            line.count
        };
        let (law, levels) = line.straightest(&powers, &value, checked);
        let sampled = &levels[..line.count];
        let (levels, skipped, gradient_index) = stencils[law].choose(sampled, line.half);
        let inner_fit = Parabola::fit(levels, skipped).filter(|far| line.fits(*far));
        let is_root = stencils[law].at_border && matches!(powers[law], Power::Two);
        let diagonal = line.step[0] != 0.0 && line.step[1] != 0.0;
        let border_fit = is_root.then(|| Parabola::from_discrete_root(sampled, diagonal));
        let parabola = match (
            inner_fit,
            border_fit.flatten().filter(|near| line.fits(*near)),
        ) {
            (Some(far), Some(near))
                if far.passes_through(sampled)
                    || (far.distance_inside() - near.distance_inside()).abs()
                        <= MAX_DISAGREEMENT =>
            {
                far
            }
            (far, near) => near.or(far)?,
        };
        // The position of cell n on the parabola.
        let position = parabola.outermost - line.first;
        let slope = parabola.slope(position);
        let sloping = line.cells().get(gradient_index);
        let gradient = sloping.map_or([0.0; 2], |&m| {
            self.gradient(m, zone, |m| powers[law].level_of(value(m)))
        });
        // Gradient: direction of the central differences, slope of the parabola along the line.
        let d = line.step;
        let slope_along = gradient[0] * d[0] + gradient[1] * d[1];
        let gradient = if slope_along > 0.0 {
            gradient.map(|g| g * slope / slope_along)
        } else {
            d.map(|d_k| d_k * slope / (d[0] * d[0] + d[1] * d[1]))
        };
        Some(Level {
            line,
            law,
            bias: stencils[law].bias,
            middle: parabola.evaluate(position),
            gradient,
            bend: parabola.bend(),
        })
    }

    /// Central differences of the level from cell to cell; zero where a neighbour is not in the
    /// zone.
    fn gradient(self, n: usize, zone: &[bool], level: impl Fn(usize) -> f64) -> [f64; 2] {
        let difference_along = |d: [isize; 2]| {
            let [next, last] =
                [d, [-d[0], -d[1]]].map(|d| self.cell_at_offset(n, d).filter(|&m| zone[m]));
            Some(0.5 * (level(next?) - level(last?)))
        };
        if self.is_single_row {
            return [difference_along([1, 0]).unwrap_or(0.0), 0.0];
        }
        match (difference_along([1, 0]), difference_along([0, 1])) {
            (Some(x), Some(y)) => [x, y],
            _ => [0.0; 2],
        }
    }
}

/// Measure of the curvature of a level along a line: the sum of the second differences of its first four
/// values, over their rise.
fn relative_curvature(levels: &[f64]) -> f64 {
    let first_levels = &levels[..levels.len().min(4)];
    let bends = first_levels
        .windows(3)
        .map(|y| (y[2] - 2.0 * y[1] + y[0]).abs());
    bends.sum::<f64>()
        / (first_levels.last().unwrap_or(&0.0) - first_levels.first().unwrap_or(&0.0)).abs()
}
