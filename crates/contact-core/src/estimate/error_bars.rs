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
//! scale. Without a finer grid three coarser ones give the scale, and a number errs by that times
//! [`SAFETY`](super::coarser::SAFETY). The tractions are compared as fields: their means over the
//! cells of the first coarser grid.
//!
//! **Increments.** The change of every number from fewer increments, or to more (`path_error`).
//!
//! **Path on a coarser grid.** The path in few increments that is compared with the finer grid is solved on the
//! same path grid as the run, whose errors the difference contains. Without a finer grid a trial gives their
//! size (`path_grid`).
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
use super::least_errors::{
    RETURNED, energy_of_ring, radius_of_spots, rim, slip_ring, solver_parts,
};
use super::numbers::{
    CONTACT_RADIUS, DISSIPATED, LOADS, MOTIONS, NUMBERS, P_MAX, PLASTIC, Q_MAX, STICK_RATIO,
    is_given,
};
use super::path_error::path_error_parts;
use super::two_runs::PathError;
use crate::error::Error;
use crate::march::{BranchSummary, Increment, Tractions, shear_errors, summarise};
use crate::scene::Scene;

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

/// The grids that the errors of cells come from.
#[derive(Clone, Copy, Debug)]
pub enum ErrorMethod {
    /// Two coarser grids, and a finer one for the sign of the error: five to eight times the work of the run. Where
    /// the finer grid would have more than 512 x 512 cells, and where bodies yield, as [`Self::CoarserGrids`].
    FinerGrid,
    /// Coarser grids alone, which give the size of the error: 0.8 to 1.4 times the work of the run, and bars twice
    /// as long. A scene with maps of heights takes the finer grid all the same: half of the points alone leave the
    /// approach of one in four rough balls outside 1.5 bars.
    CoarserGrids,
}

/// The errors of the branches of `increments`, which ended with these tractions. Solves the scene
/// again with fewer increments, and on the grids of the method. Ends when `stop` is raised.
pub fn error_bars(
    scene: &Scene,
    increments: &[Increment],
    tractions: &[Tractions],
    method: ErrorMethod,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<ErrorBars>, Error> {
    let scene = &choose_increments(scene, stop)?;
    let [mut along_path, of_path_grid] = path_error_parts(scene, stop)?;
    let fine = summarise(increments);
    let finer = match method {
        ErrorMethod::CoarserGrids if !scene.has_maps() => None,
        _ => Finer::solve(scene, &fine, stop)?,
    };
    let coarser = coarser_grids(scene, &fine, tractions, finer.is_some(), stop)?;
    for (error, of_grid) in along_path.iter_mut().zip(&of_path_grid) {
        error.add_fields(of_grid);
        // The change to the finer grid contains the errors of the path grid.
        if finer.is_none() {
            error.add_numbers(of_grid);
        }
    }
    for (error, seen) in along_path.iter_mut().zip(shear_errors(scene, increments)) {
        error.q = error.q.max(seen);
    }
    let branches = fine.iter().zip(coarser).zip(along_path).enumerate();
    Ok(branches
        .map(|(k, ((fine, of_grids), path))| {
            let of_finer = finer.as_ref().map(|finer| Differs {
                ratio: finer.ratio,
                differences: finer.differences[k],
                tolerance: finer.tolerance,
            });
            bars(scene, fine, &of_grids, &path, of_finer.as_ref())
        })
        .collect())
}

/// Errors of a branch from a finer grid.
struct Differs {
    /// Refinement factor of the finer grid.
    ratio: f64,
    /// The numbers minus the numbers on the finer grid, each in its unit.
    differences: [f64; NUMBERS],
    /// Tolerance of both runs.
    tolerance: f64,
}

/// The error bars of one branch: of its numbers in the run `fine`, from the differences to coarser grids
/// (`of_grids`), to other increments (`path`) and, if there is one, to a finer grid (`finer`).
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
            CONTACT_RADIUS if scene.is_uneven() => radius_of_spots(scene, fine),
            CONTACT_RADIUS => rim(scene),
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
                    finer.differences[n] / (1.0 - remaining),
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
