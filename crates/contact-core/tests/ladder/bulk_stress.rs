//! Bulk stress in either body.

use contact_core::scene::{LoadPath, Loads};
use ndarray::Array2;

use crate::bench::{STEEL, W, norm, sphere_on_flat};
use crate::invariants::{TWINS, assert_twins, end, loads_mapped, twin};

/// The twins of a coupled scene with both bodies pulled: exchanged, what pulled one pulls the
/// other; mirrored at x = 0, tension stays tension.
#[test]
fn pulled_bodies_have_twins() {
    let mut scene = twin();
    for (branch, (lower, upper)) in
        scene
            .path
            .branches
            .iter_mut()
            .zip([(0.0, 1e8), (3e8, 1e8), (-1e8, -2e8)])
    {
        (branch.to.sigma_B, branch.to.sigma_B1) = (lower, upper);
    }
    let (ours, _) = end(&scene);
    let same = [&ours.p, &ours.q_x, &ours.q_y];
    let (unpulled, _) = end(&twin());
    let q = norm(&ours.q_x);
    assert!(norm(&(&unpulled.q_x - &ours.q_x)) > 0.1 * q);

    let mut exchanged = scene.clone();
    std::mem::swap(&mut exchanged.body1, &mut exchanged.body2);
    exchanged.path = loads_mapped(&scene, |l| Loads {
        T_x: -l.T_x,
        T_y: -l.T_y,
        sigma_B: l.sigma_B1,
        sigma_B1: l.sigma_B,
        ..l
    });
    let (theirs, _) = end(&exchanged);
    let back = [theirs.p.clone(), -&theirs.q_x, -&theirs.q_y];
    assert_twins("exchanged", [&back[0], &back[1], &back[2]], same);

    let mut mirrored = scene.clone();
    if let contact_core::scene::Shape::Ellipsoid { angle, .. } = &mut mirrored.body1.shape {
        *angle = -*angle;
    }
    mirrored.path = loads_mapped(&scene, |l| Loads { T_x: -l.T_x, ..l });
    let (theirs, _) = end(&mirrored);
    let flip = |f: &Array2<f64>, sign: f64| f.slice(ndarray::s![..;-1, ..]).to_owned() * sign;
    let back = [
        flip(&theirs.p, 1.0),
        flip(&theirs.q_x, -1.0),
        flip(&theirs.q_y, 1.0),
    ];
    assert_twins("mirrored", [&back[0], &back[1], &back[2]], same);
}

/// Like bodies that are pulled alike stay together; pulled one against the other, it does not
/// matter which of the two is.
#[test]
fn the_difference_of_the_strains_counts() {
    let mut scene = sphere_on_flat(STEEL, STEEL, 0.3, (2.6, 24), LoadPath::start());
    scene.settings.solver.tolerance = Some(1e-11);
    let mut pulled = |lower: f64, upper: f64| {
        scene.path = LoadPath::start().normal(W, 2).change_to(
            |to| (to.T_x, to.sigma_B, to.sigma_B1) = (0.1 * W, lower, upper),
            3,
        );
        end(&scene).0
    };
    let [none, both] = [(0.0, 0.0), (4e8, 4e8)].map(|(lower, upper)| pulled(lower, upper));
    let [lower, upper] = [(4e8, 0.0), (0.0, -4e8)].map(|(lower, upper)| pulled(lower, upper));
    let p = norm(&none.p);
    for (one, other) in [(&none, &both), (&lower, &upper)] {
        assert!(norm(&(&one.q_x - &other.q_x)) < TWINS * p);
        assert!(norm(&(&one.q_y - &other.q_y)) < TWINS * p);
    }
    assert!(norm(&(&none.q_x - &lower.q_x)) > 0.02 * p);
}
