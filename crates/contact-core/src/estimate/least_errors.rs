//! The errors that two runs cannot show: the solver's tolerance, and borders within a cell.
//!
//! The change from grid to grid vanishes by chance, or lies below the tolerance. What is known
//! beforehand is the least error of a number.

use super::numbers::{DISSIPATED, MOTIONS, NUMBERS, PLASTIC, STICK_RATIO, numbers};
use crate::march::{BranchSummary, TANGENTIAL_SHARE};
use crate::plan::Plan;
use crate::scene::{Branch, Scene};

/// Error of the position of the border of a stick zone, at least \[cells\]. With it 99 % of the
/// errors of the stick ratio in 160 random scenes (`make error-bars`) are at most 1.5 times, 81 %
/// at least 0.2 times the bar.
const BORDER: f64 = 0.04;
/// The same under a layer thinner than THIN cells, which alone sets the shear at the border: the
/// root mean square of 16 grids of 64 to 512 cells under a stiff layer (titanium and 4 um of TiN,
/// plane strain, bulk stress in phase).
const BORDER_UNDER_THIN: f64 = 0.25;
const THIN: f64 = 2.0;
/// [`BORDER`] of line contacts under bulk stress, bare and coated, whose stick zone lies beside the middle: half
/// the root mean square error of its width over a cycle, on 36 grids of 48 to 96 cells against 512 (titanium,
/// bare and with one or two layers of 0.05 to 0.4 a, bulk stress in and out of phase).
const BORDER_UNDER_BULK: [f64; 2] = [0.25, 0.4];
/// Error of the position of the rim, bare and under a layer, at least \[cells\]: the change between two
/// grids vanishes by chance. The root mean square errors of half-widths on 48 to 96 cells against 1024
/// (12 random cylinders; radii of balls: 0.01 and 0.06).
const RIM: [f64; 2] = [0.015, 0.11];
/// Narrowest slip ring that the cells resolve \[cells\]. A narrower one may be missed as a whole,
/// or a spurious one found.
const NARROWEST_RING: f64 = 0.5;
/// E/(mu^2 W delta_z (1 - S)^2), E being the energy dissipated in a narrow slip ring during
/// indentation and S the stick area over the contact area: the median of 26 indentations of
/// dissimilar bodies (random scenes, 0.02 < 1 - S < 0.6; half of them between 0.022 and 0.035).
/// Scaling: the ring carries the shear mu W (1 - S)^(3/2) and slips by about mu delta_z (1 -
/// S)^(3/2) while the contact grows by the width of the ring, 1/(1 - S) times in all.
const RING_ENERGY: f64 = 0.024;

/// Error of what has yielded that the fixed point of an increment leaves: it ends where the stress changes
/// by 1e-4 of the yield stress.
pub(super) const RETURNED: f64 = 1e-3;

/// Error of each number of a branch by the solver's tolerance, in the unit of the number: for most of them the
/// tolerance times the number.
///
/// A motion or a load that vanishes has the error [`BranchSummary::insignificant_sizes`].
///
/// The slip has the error s tol mu delta_z, s being the tangential share of the tolerance. Under
/// Hertz's pressure the slip ring outside a stick zone of the area ratio S carries W (1 - S)^(3/2),
/// so that the dissipated energy has the error s tol mu^2 W delta_z (1 - S)^(3/2).
pub(super) fn solver_parts(scene: &Scene, fine: &BranchSummary, tolerance: f64) -> [f64; NUMBERS] {
    let value = numbers(fine).map(f64::abs);
    let mut parts = value.map(|value| tolerance * value);
    for n in PLASTIC..NUMBERS {
        parts[n] = parts[n].max(RETURNED * value[n]);
    }
    let (motions, loads) = fine.insignificant_sizes(scene);
    let sizes = motions.into_iter().chain(loads);
    for (n, size) in (MOTIONS..PLASTIC).zip(sizes) {
        // What is zero to the last digit is zero by symmetry.
        if size.is_finite() && value[n] > 0.0 {
            parts[n] = parts[n].max(size);
        }
    }
    if may_slip(scene) {
        let mu = scene.friction.mu;
        let slip = TANGENTIAL_SHARE * tolerance * mu;
        let borne = fine.loads.W * (1.0 - value[STICK_RATIO]).max(0.0).powf(1.5);
        let least = slip * mu * borne * value[MOTIONS];
        parts[DISSIPATED] = parts[DISSIPATED].max(least);
    }
    parts
}

/// Uncertainty of the stick ratio: the area of a ring of width [`BORDER`] or
/// [`BORDER_UNDER_THIN`] along the border of the stick zone over the one of the contact; where the
/// slip ring is narrower than [`NARROWEST_RING`], of a ring of the missing width. In a line contact
/// the ring is a strip on both sides.
pub(super) fn slip_ring(scene: &Scene, fine: &BranchSummary) -> f64 {
    if !may_slip(scene) || fine.contact_radius <= 0.0 {
        return 0.0;
    }
    let layers = [&scene.body1, &scene.body2].map(|body| body.coatings.first());
    let layers: Vec<_> = layers.into_iter().flatten().collect();
    let is_thin = (layers.iter()).any(|layer| layer.thickness < THIN * cell(scene));
    let mut border = if is_thin { BORDER_UNDER_THIN } else { BORDER };
    let mut branches = scene.path.branches.iter();
    if scene.grid.plane_strain
        && branches.any(|branch| branch.to.sigma_B != 0.0 || branch.to.sigma_B1 != 0.0)
    {
        border = border.max(BORDER_UNDER_BULK[usize::from(!layers.is_empty())]);
    }
    let (ratio, cell) = (fine.stick_ratio, cell(scene) / fine.contact_radius);
    if scene.grid.plane_strain {
        let missed = (NARROWEST_RING * cell - (1.0 - ratio)).max(0.0);
        return (border * cell).max(missed);
    }
    // Width of the ring, over the radius of the contact.
    let seen = 1.0 - ratio.max(0.0).sqrt();
    let missed = (NARROWEST_RING * cell - seen).max(0.0);
    2.0 * (border * cell).max(missed) * ratio.max(0.0).sqrt()
}

/// Uncertainty of the energy dissipated in the indentation of dissimilar bodies, whose slip ring
/// may be larger by `ring` \[J\]; negligible where loads in the plane act.
pub(super) fn energy_of_ring(scene: &Scene, fine: &BranchSummary, ring: f64) -> f64 {
    let mut until = scene.path.branches[..=fine.branch].iter();
    if ring <= 0.0
        || fine.contact_radius <= 0.0
        || !Plan::new(scene).coupling
        || !until.all(Branch::only_presses)
    {
        return 0.0;
    }
    let (mu, slips) = (scene.friction.mu, 1.0 - fine.stick_ratio);
    let whole = mu * mu * fine.loads.W * fine.motion.delta_z.abs();
    RING_ENERGY * whole * ring * (2.0 * slips + ring)
}

/// Error of the contact radius by the cells along the border of the spots \[m\]. In plane strain these
/// count whole.
pub(super) fn radius_of_spots(scene: &Scene, fine: &BranchSummary) -> f64 {
    let (spots, radius) = (&fine.spots, fine.contact_radius);
    let area = spots.real_area().max(f64::MIN_POSITIVE);
    let whole = if scene.grid.plane_strain {
        spots.whole_cells - spots.real_area()
    } else {
        0.0
    };
    0.5 * radius * (whole + spots.real_area_error()) / area
}

/// Uncertainty of the position of the rim \[m\], a fixed part of a cell.
pub(super) fn rim(scene: &Scene) -> f64 {
    let bodies = [&scene.body1, &scene.body2];
    let is_coated = bodies.iter().any(|body| !body.coatings.is_empty());
    RIM[usize::from(is_coated)] * cell(scene)
}

/// Whether cells may slip: friction has a bound, and shear reaches it.
fn may_slip(scene: &Scene) -> bool {
    let mu = scene.friction.mu;
    mu > 0.0 && mu.is_finite() && (Plan::new(scene).coupling || !scene.path.only_presses())
}

/// Side of the square with the area of a cell; in plane strain the length of the cell \[m\].
fn cell(scene: &Scene) -> f64 {
    if scene.grid.plane_strain {
        scene.grid.dx
    } else {
        scene.grid.cell_area().sqrt()
    }
}
