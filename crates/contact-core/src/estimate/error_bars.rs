//! Errors of the numbers of a run, from cells, increments and solver.
//!
//! **Cells.** The path is run again on coarser grids with cells r_i times as large (`coarser`).
//! Each gives the error of a number f that falls like the m-th power of the cell (Richardson),
//!
//! ```text
//! error = |f - c_i|/(r_i^m - 1)
//! ```
//!
//! c_i being the number on grid i. Since the position of the rim within the cells makes errors rise
//! and fall from grid to grid, the root mean square over the grids is taken as the scale of the
//! error. A finer grid gives the error itself with its sign (`finer`), up to its own error on that
//! scale. The tractions are compared as fields: their means over the cells of the first coarser
//! grid.
//!
//! **Increments.** The change of every number from fewer increments, or to more (`path_error`).
//!
//! **Solver.** Its tolerance, and the tolerance of the additional runs.
//!
//! Errors of cells and increments of the same sign add up; errors of opposite sign are not taken to
//! cancel (`bar`).

use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use serde::{Deserialize, Serialize};

use super::bar::Bar;
use super::choice::choose_increments;
use super::coarser::{GridErrors, ORDER, coarser_grids};
use super::finer::Finer;
use super::numbers::{
    CONTACT_RADIUS, DISSIPATED, LOADS, MOTIONS, NUMBERS, P_MAX, PLASTIC, Q_MAX, STICK_RATIO,
    is_given, numbers,
};
use super::path_error::path_errors;
use super::two_runs::PathError;
use crate::error::Error;
use crate::march::{
    BranchSummary, Increment, TANGENTIAL_SHARE, Tractions, shear_errors, summarise,
};
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
/// Narrowest slip ring that the cells resolve \[cells\]. A narrower one may be missed as a whole,
/// or a spurious one found.
const NARROWEST_RING: f64 = 0.5;
/// E/(mu^2 W delta_z (1 - S)^2), E being the energy dissipated in a narrow slip ring during
/// indentation and S the stick area over the contact area: the median of 26 indentations of
/// dissimilar bodies (random scenes, 0.02 < 1 - S < 0.6; half of them between 0.022 and 0.035).
/// Scaling: the ring carries the shear mu W (1 - S)^(3/2) and slips by about mu delta_z (1 -
/// S)^(3/2) while the contact grows by the width of the ring, 1/(1 - S) times in all.
const RING_ENERGY: f64 = 0.024;

/// Estimated errors of the numbers at the end of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorBars {
    /// Branch, from 0.
    pub branch: usize,
    /// Error of the contact radius, of a line contact of half its width \[m\].
    pub contact_radius: Bar,
    /// Error of the stick area over the contact area.
    pub stick_ratio: Bar,
    /// Error of the largest pressure \[Pa\].
    pub p_max: Bar,
    /// Error of the largest shear traction \[Pa\].
    #[serde(default)]
    pub q_max: Bar,
    /// Error of the area of the contact \[m^2\].
    #[serde(default)]
    pub contact_area: Bar,
    /// Error of the area of the stick zone \[m^2\].
    #[serde(default)]
    pub stick_area: Bar,
    /// Error of the approach \[m\]; this and the errors of other motions and loads are zero where these are prescribed.
    pub delta_z: Bar,
    /// Error of the tilt about x \[rad\].
    pub phi_x: Bar,
    /// Error of the tilt about y \[rad\].
    pub phi_y: Bar,
    /// Error of the shift along x \[m\].
    pub delta_x: Bar,
    /// Error of the shift along y \[m\].
    pub delta_y: Bar,
    /// Error of the rotation \[rad\].
    pub phi_z: Bar,
    /// Error of the normal force \[N\].
    pub W: Bar,
    /// Error of the tilting moment about x \[N m\].
    pub M_x: Bar,
    /// Error of the tilting moment about y \[N m\].
    pub M_y: Bar,
    /// Error of the tangential force along x \[N\].
    pub T_x: Bar,
    /// Error of the tangential force along y \[N\].
    pub T_y: Bar,
    /// Error of the torsional moment \[N m\].
    pub M_z: Bar,
    /// Error of the energy dissipated in the branch \[J\].
    pub dissipated: Bar,
    /// Error of the pressure as a field: L2 norm, over the largest of the path.
    pub p: Bar,
    /// Error of the shear as a field: L2 norm, over the largest of the path.
    pub q: Bar,
    /// Error of the plastic work in the branch \[J\]; this and the next three are zero where nothing yields.
    #[serde(default)]
    pub plastic_work: Bar,
    /// Error of the volume that has yielded \[m^3\].
    #[serde(default)]
    pub plastic_volume: Bar,
    /// Error of the largest equivalent plastic strain, which at the border of slip and at the rim of a coating
    /// does not converge.
    #[serde(default)]
    pub largest_plastic_strain: Bar,
    /// Error of the residual stress at a point, over the largest below the middle of the grid.
    #[serde(default)]
    pub residual_stress: Bar,
    /// Error of the stress in the bodies, over its size.
    #[serde(default)]
    pub stress: Bar,
}

impl ErrorBars {
    /// Errors of the motions, in the order of [`RigidMotion::ALL`](crate::scene::RigidMotion::ALL).
    pub fn motions(&self) -> [Bar; 6] {
        let Self {
            delta_z,
            phi_x,
            phi_y,
            delta_x,
            delta_y,
            phi_z,
            ..
        } = *self;
        [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z]
    }

    /// Errors of their loads.
    pub fn loads(&self) -> [Bar; 6] {
        [self.W, self.M_x, self.M_y, self.T_x, self.T_y, self.M_z]
    }
}

/// The errors of the branches of `increments`, which ended with these tractions. Solves the scene
/// again on two coarser grids, with fewer increments, and in few increments on a finer grid: a few
/// times the work of the run. Where a finer grid would have more than 512 x 512 cells the coarser
/// ones alone give the scale of the errors. Ends when `stop` is raised.
pub fn error_bars(
    scene: &Scene,
    increments: &[Increment],
    tractions: &[Tractions],
    stop: &Arc<AtomicBool>,
) -> Result<Vec<ErrorBars>, Error> {
    let scene = &choose_increments(scene, stop)?;
    let mut along_path = path_errors(scene, stop)?;
    for (error, seen) in along_path.iter_mut().zip(shear_errors(scene, increments)) {
        error.q = error.q.max(seen);
    }
    let fine = summarise(increments);
    let coarser = coarser_grids(scene, &fine, tractions, stop)?;
    let finer = Finer::solve(scene, stop)?;
    let branches = fine.iter().zip(coarser).zip(along_path).enumerate();
    Ok(branches
        .map(|(k, ((fine, of_grids), path))| {
            let of_finer = finer.as_ref().map(|finer| Differs {
                ratio: finer.ratio,
                off: finer.off[k],
                tolerance: finer.tolerance,
            });
            bars(scene, fine, &of_grids, &path, of_finer.as_ref())
        })
        .collect())
}

/// Error of what has yielded that the fixed point of an increment leaves: it ends where the stress changes
/// by 1e-4 of the yield stress.
const RETURNED: f64 = 1e-3;

/// Errors of a branch from a finer grid.
struct Differs {
    /// Refinement factor of the finer grid.
    ratio: f64,
    /// The numbers minus the numbers on the finer grid, each in its unit.
    off: [f64; NUMBERS],
    /// Tolerance of both runs.
    tolerance: f64,
}

/// The error bars of a branch.
fn bars(
    scene: &Scene,
    fine: &BranchSummary,
    of_grids: &GridErrors,
    path: &PathError,
    finer: Option<&Differs>,
) -> ErrorBars {
    let tolerance = scene.tolerance();
    let by_solver = solver_parts(
        scene,
        fine,
        finer.map_or(tolerance, |f| f.tolerance.max(tolerance)),
    );
    let ring = slip_ring(scene, fine);
    let bar = |n: usize| {
        if is_given(fine, n) {
            return Bar::default();
        }
        let least = match n {
            STICK_RATIO => ring,
            DISSIPATED => energy_of_ring(scene, fine, ring),
            CONTACT_RADIUS if scene.is_uneven() => radius_of_spots(fine),
            _ => 0.0,
        };
        let solver = by_solver[n];
        match finer {
            None => Bar::new(
                of_grids.numbers[n].hypot(least),
                path.numbers[n].abs(),
                solver,
            ),
            Some(finer) => {
                // The error of the finer grid over the error of the grid.
                let remaining = finer.ratio.powf(-ORDER[n]);
                let scatter = (remaining * of_grids.numbers[n]).hypot(least);
                Bar::signed(
                    finer.off[n] / (1.0 - remaining),
                    scatter,
                    path.numbers[n],
                    solver,
                )
            }
        }
    };
    let [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z] =
        [0, 1, 2, 3, 4, 5].map(|k| bar(MOTIONS + k));
    let [W, M_x, M_y, T_x, T_y, M_z] = [0, 1, 2, 3, 4, 5].map(|k| bar(LOADS + k));
    let [plastic_work, plastic_volume, largest_plastic_strain] =
        [0, 1, 2].map(|k| bar(PLASTIC + k));
    let [contact_area, stick_area] =
        bars_of_areas(scene, fine, bar(CONTACT_RADIUS), bar(STICK_RATIO));
    let cell_bars = [STICK_RATIO, P_MAX].map(|n| bar(n).cells);
    let remaining = if fine.plastic_volume > 0.0 {
        Bar::new(of_grids.residual, path.residual, RETURNED)
    } else {
        Bar::default()
    };
    ErrorBars {
        branch: fine.branch,
        contact_radius: bar(CONTACT_RADIUS),
        stick_ratio: bar(STICK_RATIO),
        p_max: bar(P_MAX),
        q_max: bar(Q_MAX),
        contact_area,
        stick_area,
        delta_z,
        phi_x,
        phi_y,
        delta_x,
        delta_y,
        phi_z,
        W,
        M_x,
        M_y,
        T_x,
        T_y,
        M_z,
        dissipated: bar(DISSIPATED),
        p: Bar::new(of_grids.fields[0], path.p, tolerance),
        q: Bar::new(of_grids.fields[1], path.q, tolerance),
        plastic_work,
        plastic_volume,
        largest_plastic_strain,
        residual_stress: remaining,
        stress: of_stress(fine, cell_bars, path, tolerance),
    }
}

/// Errors of the contact area A and of the stick area S A from the errors of the radius a and of the
/// stick ratio S: dA = 2 A da/a, of a line contact A da/a; d(S A) = S dA + A dS.
fn bars_of_areas(scene: &Scene, fine: &BranchSummary, radius: Bar, stick: Bar) -> [Bar; 2] {
    let a = fine.contact_radius;
    let stick_ratio = if a > 0.0 { fine.stick_ratio } else { 0.0 };
    let (area, slope) = if scene.grid.plane_strain {
        (2.0 * a * scene.grid.dy, 2.0 * scene.grid.dy)
    } else {
        (PI * a * a, 2.0 * PI * a)
    };
    let contact = radius.times(slope);
    [contact, contact.times(stick_ratio).plus(&stick.times(area))]
}

/// The error of the stress that the errors of the tractions cause, over the stress, from the errors
/// of stick ratio and largest pressure by the cells.
///
/// The errors of cells lie at the rim and at the border of the stick zone, change sign from cell to
/// cell, and cancel in the stress a few cells away from there; near them the change to cells twice
/// as large shows them. Farther away the stress errs by as much as the height of the tractions does,
/// dp_max/p_max. The shear that a border at a wrong place moves has no resultant: a tenth of dS is
/// taken. The errors of increments are smooth: they count whole.
fn of_stress(
    fine: &BranchSummary,
    [stick, p_max]: [f64; 2],
    path: &PathError,
    tolerance: f64,
) -> Bar {
    let height = if fine.p_max > 0.0 {
        p_max / fine.p_max
    } else {
        0.0
    };
    Bar::new(height.hypot(0.1 * stick), path.p.hypot(path.q), tolerance)
}

/// Error of each number within a tolerance, in its unit: for most numbers tol times the number.
///
/// The slip has the error s tol mu delta_z, s being the tangential share of the tolerance. Under
/// Hertz's pressure the slip ring outside a stick zone of the area ratio S carries W (1 - S)^(3/2),
/// so that the dissipated energy has the error s tol mu^2 W delta_z (1 - S)^(3/2).
fn solver_parts(scene: &Scene, fine: &BranchSummary, tolerance: f64) -> [f64; NUMBERS] {
    let value = numbers(fine).map(f64::abs);
    let mut parts = value.map(|value| tolerance * value);
    for n in PLASTIC..NUMBERS {
        parts[n] = parts[n].max(RETURNED * value[n]);
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
fn slip_ring(scene: &Scene, fine: &BranchSummary) -> f64 {
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
fn energy_of_ring(scene: &Scene, fine: &BranchSummary, ring: f64) -> f64 {
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

/// Error of the contact radius by the cells along the border of the spots, which count whole \[m\].
fn radius_of_spots(fine: &BranchSummary) -> f64 {
    let (spots, radius) = (&fine.spots, fine.contact_radius);
    let whole = spots.whole_cells.max(f64::MIN_POSITIVE);
    let off = spots.whole_cells - spots.real_area() + spots.real_area_error();
    0.5 * radius * off / whole
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
