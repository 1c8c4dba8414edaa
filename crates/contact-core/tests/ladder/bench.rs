//! The test rig: a sphere on a flat, run through a path.

use std::sync::Arc;

use contact_core::march::{Increment, March};
use contact_core::plan::Plan;
use contact_core::scene::{
    Body, Branch, Coating, Elastic, Friction, Grid, LoadPath, Loads, Scene, Settings, Shape,
    Spacing,
};
use contact_reference::{Hertz, hertz};
use ndarray::{Array2, Zip};

use crate::audit::{Audit, Violations};

/// Radius of the sphere \[m\].
pub(crate) const R: f64 = 0.018;
/// Largest normal force \[N\].
pub(crate) const W: f64 = 1e3;
/// The paper's material.
pub(crate) const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
/// Without lateral contraction the shear kernel is isotropic.
pub(crate) const CORK: Elastic = Elastic { E: 210e9, nu: 0.0 };

/// Error of the radius of a contact or a stick zone, in cells: the pressure or the shear a few
/// cells inside, which tells the rim, is off by as much as if the rim were off by a hundredth of a
/// cell.
pub(crate) const RIM: f64 = 0.05;
/// The same where cells a few rows inside do not tell the rim (a stick zone that grows by cells,
/// two borders within a few cells): the radius of whole cells scatters by this.
pub(crate) const WHOLE_CELLS: f64 = 0.25;
/// Error of a field in the L2 norm, relative, over the cell size in contact radii: 2.8 times the
/// part of p0 sqrt(2 d/a), the pressure one cell inside, that the 2 pi a/d rim cells are off by, a
/// tenth at most.
pub(crate) const FIELD: f64 = 0.28;
/// Error of smooth values, relative, over the square of the cell size in contact radii.
pub(crate) const SMOOTH: f64 = 0.1;

/// A sphere of `upper` on a flat of `lower`, `n` x `n` cells over `extent` times the Hertz radius.
pub(crate) fn sphere_on_flat(
    upper: Elastic,
    lower: Elastic,
    mu: f64,
    (extent, n): (f64, usize),
    path: LoadPath,
) -> Scene {
    let a = hertz(R, upper, lower, W).a;
    Scene {
        title: "ladder".into(),
        body1: Body::homogeneous(upper, Shape::Sphere { R }),
        body2: Body::homogeneous(lower, Shape::Flat),
        friction: Friction::coulomb(mu),
        grid: Grid::centred(extent * a, n).expect("a grid"),
        path,
        settings: Settings::default(),
    }
}

/// The same with one coating on the flat.
pub(crate) fn coated(mut scene: Scene, material: Elastic, thickness: f64) -> Scene {
    scene.body2.coatings = vec![Coating {
        material,
        thickness,
    }];
    scene
}

/// Indentation to W in steps of equal contact radius.
pub(crate) fn indentation(increments: usize) -> LoadPath {
    LoadPath::start().push_branch(Branch {
        to: Loads {
            W,
            ..Loads::default()
        },
        increments: Some(increments),
        spacing: Spacing::EqualRadius,
        t_end: 1.0,
        path_error: None,
    })
}

/// The Hertz contact of the uncoated pair.
pub(crate) fn hertz_of(scene: &Scene) -> Hertz {
    scene.hertz().expect("a Hertz contact")
}

/// Cell size over the Hertz radius.
pub(crate) fn cell(scene: &Scene) -> f64 {
    scene.grid.dx / hertz_of(scene).a
}

/// Runs the path; `watch` sees every increment. In each, the energies balance and friction takes
/// energy in every cell.
pub(crate) fn run(scene: &Scene, watch: impl FnMut(&March, &Increment)) -> Vec<Increment> {
    along(scene, March::new(scene).expect("a scene"), watch)
}

/// The same where a contact grows whole in each increment, for orders in the increments that are
/// given.
pub(crate) fn run_without_growth_steps(scene: &Scene) -> Vec<Increment> {
    let mut plan = Plan::new(scene);
    plan.methods.growth_steps = 1;
    let march = March::planned(scene, plan, &Arc::default()).expect("a scene");
    along(scene, march, |_, _| ())
}

fn along(
    scene: &Scene,
    mut march: March,
    mut watch: impl FnMut(&March, &Increment),
) -> Vec<Increment> {
    let mut increments = Vec::new();
    let mut dissipated = Array2::<f64>::zeros((scene.grid.nx, scene.grid.ny));
    let (mut q_max, mut work) = (0.0_f64, 0.0);
    let tolerance = scene.tolerance();
    while let Some(increment) = march.advance() {
        let increment = increment.expect("a solution");
        let at = increment.index;
        // A gap or a slip within the tolerance, times the traction there.
        work += increment.energy.work.abs();
        let missing = increment.energy.imbalance();
        assert!(
            missing.abs() <= tolerance * work,
            "energy {missing:e} of {work:e} at {at}"
        );
        // Slip along the shear within the tolerance, all of it in one cell. Where the contact rolls
        // the cell has other material than before.
        let fields = march.fields();
        let cells = fields.contact.iter().filter(|c| **c).count() as f64;
        let along =
            tolerance * scene.reference_approach() * scene.friction.mu.min(1.0) * cells.sqrt();
        q_max = q_max.max(increment.q_max);
        if increment.point.loads.rolled == 0.0 {
            Zip::from(&fields.dissipated)
                .and(&dissipated)
                .for_each(|now, before| {
                    let gained = now - before;
                    assert!(
                        gained >= -q_max * along - 1e-12 * now.abs(),
                        "friction gives {:e} J/m^2 at {at}",
                        -gained
                    );
                });
        }
        dissipated = fields.dissipated;
        watch(&march, &increment);
        increments.push(increment);
    }
    increments
}

/// The same, and every increment is audited.
pub(crate) fn run_audited(
    scene: &Scene,
    mut watch: impl FnMut(&March, &Increment),
) -> Vec<Increment> {
    let (mut audit, mut worst) = (Audit::new(scene), Violations::default());
    run(scene, |march, increment| {
        worst.worse(&audit.check(march, increment));
        assert!(worst.hold(), "{worst:#?} at {}", increment.index);
        watch(march, increment);
    })
}

/// Radius of the circle of an area.
pub(crate) fn radius(area: f64) -> f64 {
    (area / std::f64::consts::PI).sqrt()
}

/// The L2 norm over cells.
pub(crate) fn norm(field: &Array2<f64>) -> f64 {
    field.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// Asserts |`value` - `truth`| <= `tolerance` and says all three if not.
#[track_caller]
pub(crate) fn close(what: &str, value: f64, truth: f64, tolerance: f64) {
    assert!(
        (value - truth).abs() <= tolerance,
        "{what}: {value} is not {truth}, off by {:+.2e}, allowed {tolerance:.1e}",
        value - truth
    );
}
