//! Areas of the contact and of the stick zone, with the parts of the cells that their borders
//! cross.
//!
//! The pressure grows like d^(1/2 + e) with the distance d inwards from the rim, or like d on a
//! layer thinner than the cells. The shortfall mu p - q . t, t being the direction of the shear in
//! the slip cells, grows like d^(1/2) from the border of a stick zone that shrinks and like d^(3/2)
//! from the border of one that grows. A power of either, the level f, vanishes linearly at the border:
//!
//! ```text
//! f = b_1 d + b_2 d^2 + ...,   f = p^(2/(1 + 2 e)) or (mu p - q . t)^2,   tan(pi e) = beta q_n/p
//! ```
//!
//! with Dundurs' beta and the shear q_n towards the inside on body 2 (a rim that slides on
//! dissimilar bodies; M. Comninou, J. Appl. Mech. 43 (1976) 631). Of the laws in question the one
//! with the straightest level is taken. Cells at a rim whose own level is another (a rough contact,
//! a layer as thin as the cells), and those beside them, count whole. On uneven surfaces each face between
//! two such cells takes (pi - 1 + ln 2)/24 of a cell off the area of the zone ([`EDGE`]). Where an uneven
//! surface has a rough rim, all cells of the stick zone count whole in its ratio to the contact: against
//! finer points of six surfaces it is off by a third of what levels are.
//!
//! Where a stick zone grows, cells come to stick with the shear with which they slipped, and their
//! shortfall depends on the position of the border in every increment. There the slip s of the
//! increment is used, which grows like d^(3/2) outwards from the border: f = s^(2/3). It gives the
//! border in the middle of the increment to second order; the radius at the end is extrapolated by
//! half of its growth since the last increment.
//!
//! **Cells at the limit.** Where a cycle returns to the shear of an earlier one, cells reach their
//! bound without slipping. Their computed slip is within the solver's tolerance, and rounding would
//! decide whether they count as slipping. A cell whose slip is below that tolerance, or below
//! [`TELLS`] times the largest slip, counts as sticking where such cells lie more than one abreast;
//! a moving border leaves a single row. The border of the stick zone beside them is where the slip
//! of the other cells vanishes.

use super::energy::slip_of;
use crate::cells::{Lattice, length};
use crate::march::Status;
use crate::march::results::EDGE;
use crate::march::setup::Setup;
use crate::material::dundurs_beta;
use crate::solvers::intermediate::AlternationInfo;
use crate::solvers::no_slip::NoSlipTerms;
use crate::solvers::{Interface, friction_bound};
use crate::zones::{Edge, Level, Line, Power, SHRINKING, STICK, SpotCount, Stencil, count_spots};

/// The rim of a slip ring on dissimilar bodies, n slip cells wide: for n > RING the pressure is
/// extrapolated from the outermost max(n - 1, FEWEST_CELLS) cells of a line, that is from slip cells but
/// for the innermost, and from two at least besides those that the stencil skips. For n <= RING it
/// is extrapolated from all cells of the line, though those that stick follow another law.
const RING: usize = 3;
const FEWEST_CELLS: usize = 4;
/// A sticking cell beside cells at the limit is at the limit too if |q| > (1 - REACHES) mu p.
const REACHES: f64 = 5e-3;
/// Part of the cells at a rim without a level from which on the rim is rough.
const ROUGH_RIM: f64 = 0.1;
/// Largest |e| of the law of a rim, reached at mu beta = tan(0.4 pi) = 3.1.
const STEEPEST: f64 = 0.4;
/// Slip below TELLS times the largest of the increment counts as none. Slip grows like d^(3/2) from
/// the border of a stick zone: this moves the border by TELLS^(2/3) = 1 % of the width of the ring.
const TELLS: f64 = 1e-3;

/// State of the interface, and areas in kept cells.
///
/// The status follows from the cells that count as slipping, as the field `stick` does: none is full
/// stick, all of a contact that slides is gross slip. The stick area lies strictly between zero and
/// the contact in partial slip alone.
pub(super) struct Areas {
    pub(super) status: Status,
    pub(super) contact: f64,
    /// Sizes of its spots.
    pub(super) count: SpotCount,
    /// The stick zone at the end of the increment.
    pub(super) stick: f64,
    /// The cells that did not slip in the increment.
    pub(super) without_slip: f64,
    /// Contact cells at the limit of friction.
    pub(super) at_limit: Vec<bool>,
}

/// The status of the interface, and contact and stick area at the end of a solved increment.
pub(super) fn areas(
    setup: &Setup<'_>,
    no_slip: &NoSlipTerms,
    now: &Interface,
    info: &AlternationInfo,
) -> Areas {
    let slip = |n: usize| {
        let rigid = setup.geometry.arms.displacement_in_plane(info.shift, n);
        length(slip_of(no_slip, now, setup.last(), rigid, n).0)
    };
    let cells = Cells::new(setup, now, info, slip);
    let partial = setup.problem.plan.methods.partial_cells;
    let rim = if partial { cells.rim() } else { Vec::new() };
    let contact = cells.area(&cells.contact, &rim);
    let whole = Areas {
        status: cells.status(setup, info),
        contact,
        count: count_spots(cells.lattice, &cells.contact),
        stick: contact,
        without_slip: contact,
        at_limit: Vec::new(),
    };
    let (without_slip, stick) = match whole.status {
        Status::NoContact | Status::FullStick => (contact, contact),
        Status::GrossSlip => (0.0, 0.0),
        Status::PartialSlip => {
            // With mu = infinity no cell is near its bound: whole cells count.
            let border = if partial && setup.problem.scene.friction.mu.is_finite() {
                cells.stick_border(&rim, slip)
            } else {
                Vec::new()
            };
            let without_slip = if cells.have_rough_borders(&whole.count, &rim) {
                let stick = count_spots(cells.lattice, &cells.stick);
                contact * corrected_cells(&stick) / corrected_cells(&whole.count)
            } else {
                cells.area(&cells.stick, &border)
            };
            let before = setup.state.without_slip / setup.problem.cell_area();
            let grows = setup.goes_on.is_some() && before > 0.0 && without_slip > before;
            let stick = if grows {
                let (radius, last) = (without_slip.sqrt(), before.sqrt());
                (radius + 0.5 * (radius - last)).powi(2)
            } else {
                without_slip
            };
            [without_slip, stick]
                .map(|area| cells.clamp_stick_area(contact, area))
                .into()
        }
    };
    Areas {
        stick,
        without_slip,
        at_limit: cells.at_limit,
        ..whole
    }
}

/// Cells of a zone, less the part that each face of its border takes off its area ([`EDGE`]).
fn corrected_cells(zone: &SpotCount) -> f64 {
    zone.cells - EDGE * zone.faces
}

/// Whether bodies whose cells all slip slide as a whole: under given forces only at the limit of friction, else
/// since a motion in the plane is given.
fn slides(setup: &Setup<'_>, info: &AlternationInfo) -> bool {
    let motions = setup.point.loads.given;
    let turns = motions
        .phi_z
        .is_some_and(|to| to != setup.state.motion.phi_z);
    info.uses_all_friction() || motions.delta_x.is_some() || motions.delta_y.is_some() || turns
}

/// The cells `marked` as slipping that hardly move, so that they are at the limit of friction (see above), and
/// lie beside others of this kind. `slip` is the slip of a cell \[m\].
fn at_limit(
    setup: &Setup<'_>,
    lattice: Lattice,
    marked: &[bool],
    slip: impl Fn(usize) -> f64,
) -> Vec<bool> {
    let slips: Vec<f64> = (marked.iter().enumerate())
        .map(|(n, &marked)| if marked { slip(n) } else { 0.0 })
        .collect();
    let largest_slip = slips.iter().copied().fold(0.0, f64::max);
    let notable = setup
        .problem
        .params(1.0)
        .tangential
        .tolerance
        .max(TELLS * largest_slip);
    let slips_notably: Vec<bool> = slips.iter().map(|&slip| slip > notable).collect();
    // Cells without friction slip freely: they have no limit.
    let hardly = |n: usize| marked[n] && !slips_notably[n] && setup.mu[n] > 0.0;
    if !(0..marked.len()).any(hardly) {
        return vec![false; marked.len()];
    }
    let abreast = (0..marked.len()).map(|n| hardly(n) && !lattice.is_beside(n, &slips_notably));
    let abreast: Vec<bool> = abreast.collect();
    (0..marked.len())
        .map(|n| hardly(n) && lattice.is_beside(n, &abreast))
        .collect()
}

/// The kept cells by state: contact, stick, slip, at the limit.
struct Cells<'a> {
    setup: &'a Setup<'a>,
    now: &'a Interface,
    lattice: Lattice,
    contact: Vec<bool>,
    stick: Vec<bool>,
    slips: Vec<bool>,
    /// Cells among those that stick which are at the limit of friction.
    at_limit: Vec<bool>,
}

impl<'a> Cells<'a> {
    /// Prepares the areas of a solved increment; `slip` is the slip of a cell in it \[m\].
    fn new(
        setup: &'a Setup<'_>,
        now: &'a Interface,
        info: &AlternationInfo,
        slip: impl Fn(usize) -> f64,
    ) -> Self {
        let contact: Vec<bool> = now.p.iter().map(|&p| p > 0.0).collect();
        let lattice = Lattice::new(&setup.geometry.grid, setup.problem.plan.mirror);
        let marked: Vec<bool> = (contact.iter().zip(&now.slips))
            .map(|(&c, &s)| c && s)
            .collect();
        // Where the loads use all friction, the cells slip though sliding is incipient.
        let mut at_limit = if marked == contact && info.uses_all_friction() {
            vec![false; marked.len()]
        } else {
            at_limit(setup, lattice, &marked, slip)
        };
        let slips: Vec<bool> = (marked.iter().zip(&at_limit))
            .map(|(&s, &l)| s && !l)
            .collect();
        if at_limit.contains(&true) {
            // Sticking cells beside them that have reached the limit.
            let reaches = |n: usize| {
                let bound = friction_bound(setup.mu[n], now.p[n]);
                contact[n]
                    && !marked[n]
                    && length([now.q[0][n], now.q[1][n]]) > (1.0 - REACHES) * bound
            };
            let beside = |n: usize| reaches(n) && lattice.is_beside(n, &at_limit);
            let others: Vec<usize> = (0..contact.len()).filter(|&n| beside(n)).collect();
            for n in others {
                at_limit[n] = true;
            }
        }
        Self {
            setup,
            now,
            lattice,
            stick: (contact.iter().zip(&slips))
                .map(|(&c, &s)| c && !s)
                .collect(),
            slips,
            at_limit,
            contact,
        }
    }

    /// Whether the borders of contact and stick zone are too rough to lie within cells by a level: the
    /// contact of an uneven surface is several spots, or many cells at its `rim` have no level. The ratio of
    /// two zones of whole cells is then the better one.
    fn have_rough_borders(&self, contact: &SpotCount, rim: &[(usize, Edge)]) -> bool {
        let scene = &self.setup.problem.scene;
        if !scene.is_uneven() || self.lattice.is_single_row {
            return false;
        }
        let without_level = rim.iter().filter(|(_, edge)| edge.level.is_none()).count();
        contact.spots > 1 || without_level as f64 > ROUGH_RIM * rim.len() as f64
    }

    /// The area of a zone \[m^2\]: whole cells inside, and parts of the cells `edges` that its border crosses.
    fn area(&self, zone: &[bool], edges: &[(usize, Edge)]) -> f64 {
        let whole = zone.iter().filter(|&&inside| inside).count() as f64;
        let partial =
            |(n, edge): &(usize, Edge)| edge.area_fraction() - f64::from(u8::from(zone[*n]));
        let area = whole + edges.iter().map(partial).sum::<f64>();
        if edges.is_empty() || !self.setup.problem.scene.is_uneven() || self.lattice.is_single_row {
            return area;
        }
        let counts_whole = |n: usize| {
            let edge = edges.binary_search_by_key(&n, |(n, _)| *n);
            edge.is_ok_and(|at| edges[at].1.level.is_none())
        };
        let is_face = |n: usize, offset: [isize; 2]| {
            let beside = self.lattice.cell_at_offset(n, offset);
            beside.is_some_and(|m| !zone[m] && counts_whole(m))
        };
        let faces = |(n, edge): &(usize, Edge)| {
            let counts = edge.level.is_none() && zone[*n];
            let sides = [[1, 0], [-1, 0], [0, 1], [0, -1]].into_iter();
            sides.filter(|side| counts && is_face(*n, *side)).count()
        };
        area - EDGE * edges.iter().map(faces).sum::<usize>() as f64
    }

    /// State of the interface (no contact, stick, partial slip, gross slip), from the cells that slip.
    fn status(&self, setup: &Setup<'_>, info: &AlternationInfo) -> Status {
        if !self.contact.contains(&true) {
            Status::NoContact
        } else if !self.slips.contains(&true) {
            Status::FullStick
        } else if !self.stick.contains(&true) && slides(setup, info) {
            // Below the limit of friction the bodies do not slide, even if every cell slips.
            Status::GrossSlip
        } else {
            Status::PartialSlip
        }
    }

    /// The area of a stick zone in partial slip \[m^2\]. `area`, by its border within the cells, is used if it
    /// lies between 0 and the area of the `contact`; otherwise the cells that stick are counted.
    fn clamp_stick_area(&self, contact: f64, area: f64) -> f64 {
        if self.stick.contains(&true) && area > 0.0 && area < contact {
            return area;
        }
        let count = |zone: &[bool]| zone.iter().filter(|&&inside| inside).count() as f64;
        contact * count(&self.stick) / count(&self.contact)
    }

    /// The rim of the contact: cells that its border crosses, each with the border within it, extrapolated from
    /// the pressure inside. Cells where that contradicts their own pressure have no level.
    fn rim(&self) -> Vec<(usize, Edge)> {
        let (now, scene) = (self.now, &self.setup.problem.scene);
        let beta = dundurs_beta(
            scene.body1.surface_material(),
            scene.body2.surface_material(),
        );
        let laws = |line: &mut Line| {
            let at = line.outermost();
            let ring = line.cells().iter().take_while(|&&n| now.slips[n]).count();
            if beta != 0.0 && ring > RING {
                line.shorten((ring - 1).max(FEWEST_CELLS));
            }
            let q_n = now.q[0][at] * line.inwards[0] + now.q[1][at] * line.inwards[1];
            // With mu = infinity the rim does not slide: e = 0.
            let slides = scene.friction.mu.is_finite();
            let ratio = if slides { q_n / now.p[at] } else { 0.0 };
            let e = ((beta * ratio).atan() / std::f64::consts::PI).clamp(-STEEPEST, STEEPEST);
            let power = if e == 0.0 {
                Power::Two
            } else {
                Power::Other(2.0 / (1.0 + 2.0 * e))
            };
            ([power, Power::One], |n: usize| now.p[n])
        };
        let stencils = [Stencil::ROOT, Stencil::LINEAR];
        let mut rim = self.lattice.edges(&self.contact, stencils, laws);
        let mut off = vec![false; self.contact.len()];
        for (n, edge) in &rim {
            off[*n] = edge.level.is_some_and(|level| {
                let (powers, pressure) = laws(&mut level.line.clone());
                !level.agrees_with(powers[level.law].level_of(pressure(*n)))
            });
        }
        for (n, edge) in &mut rim {
            let agrees = !off[*n] && !self.lattice.is_beside(*n, &off);
            edge.level = edge.level.filter(|_| agrees);
        }
        rim
    }

    /// The border of the stick zone, within the `rim` of the contact; `slip` is the slip of a cell in the
    /// increment \[m\].
    fn stick_border(
        &self,
        rim: &[(usize, Edge)],
        slip: impl Fn(usize) -> f64,
    ) -> Vec<(usize, Edge)> {
        let now = self.now;
        let stencils = [Stencil::ROOT, Stencil::LINEAR].map(Stencil::up_to_middle);
        let mut border = self.lattice.edges(&self.stick, stencils, |line| {
            let slipping = self.slipping_beside(line);
            (STICK, move |n| self.shortfall(now, n, slipping))
        });
        let beside_limit = |n: usize| self.lattice.is_beside(n, &self.at_limit);
        for (n, edge) in &mut border {
            edge.level = edge.level.filter(|level| level.law == SHRINKING);
            let line = edge.level.map(|level| level.line);
            let shrinks = |line: Line| !self.grew(line.outermost(), self.slipping_beside(&line));
            if line.is_some_and(shrinks) && !beside_limit(*n) {
                continue;
            }
            edge.level = None;
            let laws = |_: &mut Line| ([Power::TwoThirds], &slip);
            let by_slip = (self.lattice).edge_of_cell(*n, &self.slips, [Stencil::SLIP], &laws);
            let grown = by_slip.level.is_some_and(|Level { line, .. }| {
                self.stick[line.outside]
                    && (self.at_limit[line.outside] || self.grew(line.outside, line.outermost()))
            });
            if grown {
                *edge = by_slip.complement(self.stick[*n]);
            }
        }
        // Where no cell slips the zone ends at the rim, unless a level shows a ring narrower than a
        // cell.
        for (n, edge) in &mut border {
            if let Ok(at) = rim.binary_search_by_key(n, |(n, _)| *n)
                && (edge.area_fraction() > rim[at].1.area_fraction()
                    || edge.level.is_none() && !self.lattice.is_beside(*n, &self.slips))
            {
                *edge = rim[at].1;
            }
        }
        border
    }

    /// The slipping cell at the border end of a line: the cell outside it, or else its outermost one.
    fn slipping_beside(&self, line: &Line) -> usize {
        if self.slips[line.outside] {
            line.outside
        } else {
            line.outermost()
        }
    }

    /// mu p - q . t of cell n \[Pa\], t being the direction of the shear of the cell `slipping`.
    fn shortfall(&self, at: &Interface, n: usize, slipping: usize) -> f64 {
        let q = [self.now.q[0][slipping], self.now.q[1][slipping]];
        let [x, y] = q.map(|q_k| q_k / length(q).max(f64::MIN_POSITIVE));
        friction_bound(self.setup.mu[n], at.p[n]) - (at.q[0][n] * x + at.q[1][n] * y)
    }

    /// Whether the stick zone has grown at the cell `stuck` inside it: the cell has come to stick, other than
    /// by a reversal, or its shortfall has increased.
    fn grew(&self, stuck: usize, slipping: usize) -> bool {
        let before = self.setup.last();
        let short = |at| self.shortfall(at, stuck, slipping);
        let rests = before.slips[stuck] && self.setup.goes_on.is_some();
        before.p[stuck] > 0.0 && (rests || short(self.now) > short(before))
    }
}
