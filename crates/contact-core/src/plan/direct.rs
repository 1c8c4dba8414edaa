//! Branches of the load path for which one increment is exact.
//!
//! Pressure without shear depends on the loads alone. Shear depends on the load path; but if the
//! pressure is constant, all slip is along one line and the loads do not reverse, a cell that slips
//! continues to slip, and a single step gives the end of the branch (M. Ciavarella, Int. J. Solids
//! Struct. 35 (1998) 2349-2362). All slip is along one line only if the shear kernel is isotropic,
//! for half-spaces if nu = 0; otherwise the error of a single increment is of the order of nu (for
//! nu = 0.3 a hundredth of q).
//!
//! The increments in between, such as the shape of a loop, are not computed.

use crate::scene::{Branch, Loads, RigidMotion, SaveFields, Scene};

/// Decides for every branch whether its increments may be left out, with the reason why any or none are.
pub(crate) fn direct_branches(
    scene: &Scene,
    coupling: bool,
) -> (Vec<bool>, Result<&'static str, &'static str>) {
    let branches = &scene.path.branches;
    let keep_all = |reason| (vec![false; branches.len()], Err(reason));
    if !scene.settings.skip.path_independent_branches {
        return keep_all("skip.path_independent_branches is off: each has its row in the results");
    }
    if scene.settings.save != SaveFields::Branches {
        return keep_all("fields within the branches are to be kept");
    }
    if branches.iter().all(|b| b.increments == Some(1)) {
        return keep_all("every branch has one increment");
    }
    if scene.friction.mu == 0.0 {
        let every_branch = vec![true; branches.len()];
        return (
            every_branch,
            Ok("without friction pressure depends on the loads alone"),
        );
    }
    if scene.friction.varies() {
        return keep_all("friction depends on what cells have been through");
    }
    if branches.iter().any(|b| {
        [b.to.sigma_B, b.to.sigma_B1, b.to.rolled]
            .iter()
            .any(|v| *v != 0.0)
    }) {
        return keep_all("the bodies roll or are stretched meanwhile");
    }
    if coupling {
        return keep_all("pressure and shear act on each other, the way counts");
    }
    let unsheared = branches
        .iter()
        .take_while(|b| is_without_shear(&b.to))
        .count();
    let isotropic_on_a_line = is_isotropic(scene) && shear_is_along_a_line(branches);
    let direct: Vec<bool> = (0..branches.len())
        .map(|b| {
            b < unsheared || (isotropic_on_a_line && b > 0 && has_constant_pressure(branches, b))
        })
        .collect();
    let verdict = match (direct.contains(&true), isotropic_on_a_line) {
        (true, true) => {
            Ok("similar bodies under a constant W, shear along one line: one increment is exact")
        }
        (true, false) => {
            Ok("without shear the pressure of similar bodies depends on the loads alone")
        }
        (false, _) => {
            Err("W and T change together, or shear is not along one line: the way counts")
        }
    };
    (direct, verdict)
}

/// Whether no shear is prescribed.
fn is_without_shear(to: &Loads) -> bool {
    let in_plane_motions = RigidMotion::ALL.into_iter().filter(|of| of.is_in_plane());
    in_plane_motions
        .map(|of| to.prescribed(of))
        .all(|p| p.value() == 0.0)
}

/// Whether shear along a line causes displacements, and so slip, along this line alone.
fn is_isotropic(scene: &Scene) -> bool {
    if scene.friction.mu_y.is_some() {
        return false;
    }
    if scene.grid.plane_strain && scene.path.branches.iter().all(|b| b.to.T_y == 0.0) {
        return true;
    }
    [&scene.body1, &scene.body2].iter().all(|body| {
        body.is_homogeneous() && (body.substrate.is_rigid() || body.substrate.nu == 0.0)
    })
}

/// Whether all tangential forces are along one line and no twist or shift in the plane is prescribed.
fn shear_is_along_a_line(branches: &[Branch]) -> bool {
    let mut line = (0.0_f64, 0.0_f64);
    branches.iter().all(|b| {
        let Loads { T_x, T_y, .. } = b.to;
        if line == (0.0, 0.0) {
            line = (T_x, T_y);
        }
        let cross_product = (T_x * line.1 - T_y * line.0).abs();
        let prescribed = |motion: RigidMotion| b.to.prescribed(motion);
        let is_turned = prescribed(RigidMotion::PhiZ).value() != 0.0;
        let is_displaced = [RigidMotion::DeltaX, RigidMotion::DeltaY]
            .iter()
            .any(|of| prescribed(*of).is_motion());
        cross_product <= 1e-12 * T_x.hypot(T_y) * line.0.hypot(line.1)
            && !is_turned
            && !is_displaced
    })
}

/// Whether the loads across the plane are constant in branch `b`.
fn has_constant_pressure(branches: &[Branch], b: usize) -> bool {
    let mut out_of_plane = RigidMotion::ALL.into_iter().filter(|of| !of.is_in_plane());
    out_of_plane.all(|of| branches[b].to.prescribed(of) == branches[b - 1].to.prescribed(of))
}
