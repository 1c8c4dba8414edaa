//! Increments that are chosen: what they show of a loop, and what they leave on paths of any shape.

use std::f64::consts::TAU;
use std::sync::Arc;

use contact_core::estimate::{choose_increments, choose_increments_like};
use contact_core::march::Increment;
use contact_core::scene::{Elastic, LoadPath, Scene};
use contact_reference::CattaneoMindlin;
use ndarray::Array2;

use crate::bench::{CORK, STEEL, W, coated, hertz_of, indentation, norm, run, sphere_on_flat};

const MU: f64 = 0.3;
/// Part of the way to full sliding that the loops go.
const LOOP: f64 = 0.9;

fn chosen(scene: &Scene) -> Scene {
    choose_increments(scene, &Arc::default()).expect("increments")
}

/// A fretting loop with chosen increments after a path.
fn fretted(start: LoadPath) -> LoadPath {
    start.tangential(&[LOOP * MU * W, -LOOP * MU * W, LOOP * MU * W], None)
}

/// The secant stiffness of the first increment of every branch after the first, and its stick
/// ratio.
fn begins(increments: &[Increment]) -> Vec<(f64, f64)> {
    let pairs = increments.windows(2);
    pairs
        .filter(|pair| pair[1].point.branch > pair[0].point.branch)
        .map(|pair| {
            let force = pair[1].point.loads.T_x - pair[0].point.loads.T_x;
            let shift = pair[1].motion.delta_x - pair[0].motion.delta_x;
            (force / shift, pair[1].stick_ratio())
        })
        .collect()
}

/// Mindlin and Deresiewicz: after a reversal all sticks, and the stiffness is that of the first
/// touch.
#[test]
fn a_loop_has_its_stiffness_and_stick_zone_after_a_reversal() {
    let scene = sphere_on_flat(
        CORK,
        CORK,
        MU,
        (2.4, 128),
        fretted(LoadPath::start().normal(W, 1)),
    );
    let closed = CattaneoMindlin::new(hertz_of(&scene), CORK, CORK, MU);
    let stiffness = 1.5 * closed.shift_limit().recip() * closed.T_limit();
    for (increments, name) in [
        (run(&chosen(&scene), |_, _| ()), "all"),
        (run(&chosen(&directly(&scene)), |_, _| ()), "directly"),
    ] {
        let begins = begins(&increments);
        for (found, stick_ratio) in &begins {
            let off = found / stiffness - 1.0;
            assert!(
                off.abs() < 0.01,
                "{name}: {found:e} of {stiffness:e}, {off:+.2e}"
            );
            assert!(*stick_ratio > 0.96, "{name}: {stick_ratio}");
        }
        let reversed = begins[1..].iter().map(|(_, stick_ratio)| *stick_ratio);
        let largest = reversed.fold(0.0, f64::max);
        assert!(largest > 0.98, "{name}: {largest}");
    }
}

/// The scene, the increments left out that its ends do not depend on.
fn directly(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.settings.skip.path_independent_branches = true;
    scene
}

/// The coated sphere of the paper against a hundred times as many increments after a reversal.
#[test]
fn a_coated_loop_has_its_stiffness_after_a_reversal() {
    let coated_with = |path: LoadPath| {
        let scene = sphere_on_flat(STEEL, STEEL, MU, (2.4, 64), path);
        let a = hertz_of(&scene).a;
        coated(scene, Elastic { E: 420e9, nu: 0.3 }, a)
    };
    let few = run(
        &chosen(&coated_with(fretted(LoadPath::start().normal(W, None)))),
        |_, _| (),
    );
    let T = LOOP * MU * W;
    let fine = indentation(12)
        .tangential(&[T], 10)
        .tangential(&[0.998 * T], 1);
    let fine = begins(&run(&coated_with(fine), |_, _| ()));
    let (stiffness, _) = fine[1];
    let begins = begins(&few);
    for (found, stick_ratio) in &begins[1..] {
        let off = found / stiffness - 1.0;
        assert!(off.abs() < 0.01, "{found:e} of {stiffness:e}, {off:+.2e}");
        assert!(*stick_ratio > 0.98, "{stick_ratio}");
    }
}

/// The increments of a cycle that repeats are those of the first like it, with its error; given
/// increments stay.
#[test]
fn cycles_get_the_increments_of_the_first() {
    let T = LOOP * MU * W;
    let coated_with = |path: LoadPath| {
        let lower = Elastic { E: 100e9, nu: 0.3 };
        let scene = sphere_on_flat(STEEL, lower, MU, (2.4, 32), path);
        let a = hertz_of(&scene).a;
        coated(scene, Elastic { E: 420e9, nu: 0.3 }, a)
    };
    let around = |path: LoadPath, of| path.tangential(&[T, -T], of);
    let mut path = LoadPath::start().normal(W, None);
    for of in [None, None, Some(10), None, None] {
        path = around(path, of);
    }
    let scene = coated_with(path);
    let chosen = chosen(&scene);
    let branches = &chosen.path.branches;
    let counts: Vec<_> = branches.iter().map(|b| b.increments).collect();
    assert_eq!(counts[5..7], [Some(5), Some(5)]);
    assert_eq!(counts[3..5], counts[7..9]);
    assert_eq!(counts[7..9], counts[9..11]);
    assert_ne!(counts[3], counts[5]);
    let mut many = scene.clone();
    for (branch, of) in many.path.branches.iter_mut().zip(branches) {
        branch.increments = of.increments.map(|n| 8 * n);
        branch.spacing = of.spacing;
    }
    let error = distance(&shear(&chosen), &shear(&many));
    let tolerance = scene.settings.solver.path_tolerance;
    assert!(error < tolerance, "{error:.2e} of {tolerance:.0e}");
}

/// The increments of a neighbour stand where one comparison allows them; a scene like itself, and one
/// whose path is of another kind, get what they get alone. Nothing depends on what was chosen before.
#[test]
fn increments_of_a_neighbour_are_the_first_guess() {
    let fretted = fretted(LoadPath::start().normal(W, None));
    let coated_with = |E: f64, mu: f64, path: &LoadPath| {
        let lower = Elastic { E: 100e9, nu: 0.3 };
        let scene = sphere_on_flat(STEEL, lower, mu, (2.4, 48), path.clone());
        let a = hertz_of(&scene).a;
        coated(scene, Elastic { E, nu: 0.3 }, a)
    };
    let like = |scene: &Scene, neighbour: &Scene| {
        choose_increments_like(scene, neighbour, &Arc::default()).expect("increments")
    };
    let neighbour = coated_with(420e9, MU, &fretted);
    let alone = chosen(&neighbour);
    assert_eq!(like(&neighbour, &neighbour), alone);
    let mut pressed = neighbour.clone();
    pressed.path.branches.truncate(2);
    assert_eq!(like(&pressed, &neighbour), chosen(&pressed));
    let counts = |of: &Scene| -> Vec<_> { of.path.branches.iter().map(|b| b.increments).collect() };
    let mut kept = 0;
    for (E, mu) in [(350e9, MU), (500e9, MU), (420e9, 0.5), (100e9, 0.6)] {
        // With friction the loads are given as forces: the same part of mu W.
        let mut path = fretted.clone();
        for branch in &mut path.branches {
            branch.to.T_x *= mu / MU;
        }
        let scene = coated_with(E, mu, &path);
        let first = like(&scene, &neighbour);
        assert_eq!(like(&scene, &neighbour), first);
        kept += usize::from(counts(&first) == counts(&alone));
        let tolerance = scene.settings.solver.path_tolerance;
        for branch in &first.path.branches[1..] {
            let error = branch.path_error.expect("an error");
            assert!(error <= tolerance, "{E:e}, {mu}: {error:.2e}");
        }
        let mut many = first.clone();
        for branch in &mut many.path.branches {
            branch.increments = branch.increments.map(|n| 4 * n);
        }
        let error = distance(&shear(&first), &shear(&many));
        assert!(
            error < tolerance,
            "{E:e}, {mu}: {error:.2e} of {tolerance:.0e}"
        );
    }
    assert!(
        kept >= 2,
        "{kept} of 4 have the increments of the neighbour"
    );
}

/// A ring of slip of 1.4 cells of the grid on which increments are chosen, in an unlike pair that is
/// sheared back: the error of the increments is five times as large where the grid resolves the ring.
#[test]
fn the_error_in_a_narrow_ring_of_slip_is_told() {
    let T = 0.3 * 0.4 * W;
    let path = indentation(16).tangential(&[T, -T], None);
    let metal = Elastic { E: 70e9, nu: 0.33 };
    let scene = sphere_on_flat(STEEL, metal, 0.4, (2.6, 128), path);
    let known = chosen(&scene);
    let told = known.path.branches[2].path_error.expect("an error");
    let mut many = known.clone();
    for branch in &mut many.path.branches[1..] {
        branch.increments = branch.increments.map(|n| 4 * n);
    }
    let error = distance(&shear(&known), &shear(&many));
    let tolerance = scene.settings.solver.path_tolerance;
    assert!(error < 1.5 * told, "{error:.2e} of {told:.2e}");
    assert!(error < tolerance, "{error:.2e} of {tolerance:.0e}");
}

/// The shear at the end of a path.
fn shear(scene: &Scene) -> [Array2<f64>; 2] {
    let mut q = None;
    run(scene, |march, _| q = Some(march.shear()));
    q.expect("an increment")
}

fn distance(a: &[Array2<f64>; 2], b: &[Array2<f64>; 2]) -> f64 {
    let off = norm(&(&a[0] - &b[0])).hypot(norm(&(&a[1] - &b[1])));
    off / norm(&b[0]).hypot(norm(&b[1]))
}

#[test]
fn an_ellipse_and_its_waypoints_meet_their_tolerance() {
    let around = |path: LoadPath| sphere_on_flat(STEEL, STEEL, MU, (2.3, 32), path);
    let pressed = || LoadPath::start().normal(W, 1);
    let axes @ (T_x, T_y) = (0.7 * MU * W, 0.4 * MU * W);
    let exact = shear(&around(pressed().ellipse(axes, 1, 512)));
    let names = ["T_x", "T_y"];
    let rows: Vec<Vec<f64>> = (0..=64)
        .map(|i| TAU * f64::from(i) / 64.0)
        .map(|angle| vec![T_x * angle.cos(), T_y * angle.sin()])
        .collect();
    let waypoints = pressed().waypoints(&names, &rows, contact_core::scene::Increments::Chosen);
    for path in [
        pressed().ellipse(axes, 1, None),
        waypoints.expect("waypoints"),
    ] {
        let scene = chosen(&around(path));
        let error = distance(&shear(&scene), &exact);
        let tolerance = scene.settings.solver.path_tolerance;
        assert!(error < tolerance, "{error:.2e} of {tolerance:.0e}");
        assert!(scene.path.increments() < 300, "{}", scene.path.increments());
    }
}

/// A contact that was pressed in one increment given by the user: what that leaves sticks, and no
/// number of increments after it takes it away.
#[test]
fn given_increments_do_not_drive_those_that_are_chosen() {
    let coated_with = |pressing: Option<usize>, E: f64| {
        let T = LOOP * MU * W;
        let path = LoadPath::start()
            .normal(W, pressing)
            .tangential(&[T, -T], None);
        let lower = Elastic { E, nu: 0.3 };
        let scene = sphere_on_flat(STEEL, lower, MU, (2.4, 32), path);
        let a = hertz_of(&scene).a;
        coated(scene, Elastic { E: 420e9, nu: 0.3 }, a)
    };
    for E in [210e9, 20e9] {
        let given = chosen(&coated_with(Some(1), E));
        let all = chosen(&coated_with(None, E));
        let counts = |scene: &Scene| -> usize {
            scene.path.branches[1..]
                .iter()
                .filter_map(|b| b.increments)
                .sum()
        };
        assert!(
            counts(&given) <= 2 * counts(&all),
            "{} {}",
            counts(&given),
            counts(&all)
        );
        // What the given increment leaves is said, of the largest shear of the path.
        let mut pressed = given.clone();
        pressed.path.branches.truncate(1);
        let mut in_many = pressed.clone();
        in_many.path.branches[0].increments = Some(64);
        let (pressed, in_many) = (shear(&pressed), shear(&in_many));
        let size = |q: &[Array2<f64>; 2]| norm(&q[0]).hypot(norm(&q[1]));
        let largest = size(&in_many).max(size(&shear(&given)));
        let left = distance(&pressed, &in_many) * size(&in_many) / largest;
        let said = given.path.branches[0].path_error.expect("an estimate");
        assert!(
            left < 1.5 * said && said < 20.0 * left,
            "{left:.2e} {said:.2e}"
        );
        let mut fine = given.clone();
        for branch in &mut fine.path.branches[1..] {
            branch.increments = branch.increments.map(|n| 8 * n);
        }
        let error = distance(&shear(&given), &shear(&fine));
        let tolerance = given.settings.solver.path_tolerance;
        assert!(
            error < 1.5 * tolerance,
            "{E:e}: {error:.2e} of {tolerance:.0e}"
        );
    }
}
