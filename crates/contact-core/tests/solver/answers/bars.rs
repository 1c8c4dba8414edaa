//! Error bars of what is answered, and of friction that changes with what cells go through.

use std::sync::Arc;

use contact_core::Scene;
use contact_core::estimate::{BranchEnds, ErrorBars, ErrorMethod, choose_increments, error_bars};
use contact_core::march::{BranchSummary, solve, summarise};
use contact_core::scene::{Elastic, Friction, FrictionHistory, History, LoadPath};

use super::{ALUMINIUM, STEEL, W, sphere};

/// True error over the bar that covers it.
const COVERS: f64 = 1.5;

fn with_bars(scene: &Scene) -> (Vec<BranchSummary>, Vec<ErrorBars>) {
    let scene = choose_increments(scene, &Arc::default()).expect("increments");
    let mut nobody = ();
    let mut ends = BranchEnds::new(&mut nobody);
    let increments = solve(&scene, &mut ends).expect("a solution");
    let bars = error_bars(
        &scene,
        &increments,
        &ends.tractions,
        ErrorMethod::FinerGrid,
        &Arc::default(),
    );
    (summarise(&increments), bars.expect("bars"))
}

#[test]
fn forces_and_moments_that_are_answered_have_bars() {
    let given = |path: LoadPath| {
        let (scene, hertz) = sphere((STEEL, ALUMINIUM), (2.8, 32), path);
        (scene, hertz.delta_z, hertz.a)
    };
    let (mut scene, delta_z, a) = given(LoadPath::start());
    scene.path = LoadPath::start()
        .change_to(|to| to.given.delta_z = Some(delta_z), 8)
        .change_to(
            |to| {
                to.given.delta_x = Some(0.15 * delta_z);
                to.given.delta_y = Some(0.05 * delta_z);
                to.given.phi_z = Some(0.02 * delta_z / a);
            },
            12,
        );
    let (ours, bars) = with_bars(&scene);
    let (mut fine, ..) = given(scene.path.clone());
    fine.grid = contact_core::scene::Grid::centred(2.8 * a, 128).expect("a grid");
    for branch in &mut fine.path.branches {
        branch.increments = branch.increments.map(|n| 4 * n);
    }
    let truth = summarise(&solve(&fine, &mut ()).expect("a solution"));
    for k in [0, 3, 4, 5] {
        let (value, right) = (ours[1].loads.forces()[k], truth[1].loads.forces()[k]);
        let bar = bars[1].loads()[k];
        println!(
            "load {k}: {value:.5e} +- {:.1e}, right {right:.5e}",
            bar.total
        );
        assert!((value - right).abs() <= COVERS * bar.total, "load {k}");
        assert!(bar.total < 0.2 * right.abs(), "load {k}: {bar:?}");
        assert_eq!(bars[1].motions()[k], contact_core::estimate::Bar::default());
    }
    // The tilts are given as zero.
    assert_eq!(bars[1].motions()[1].total, 0.0);
}

/// Energy and force of a reversal against many increments.
#[test]
fn friction_with_a_history_has_bars_that_cover() {
    let slip = FrictionHistory {
        of: History::Slip,
        table: vec![(0.0, 1.0), (1e-7, 1.3)],
    };
    let spent = FrictionHistory {
        of: History::Dissipated,
        table: vec![(0.0, 1.0), (20.0, 0.7)],
    };
    let mu = 0.4;
    let laws = [
        (
            "slip",
            Friction {
                history: Some(slip),
                ..Friction::coulomb(mu)
            },
        ),
        (
            "energy",
            Friction {
                history: Some(spent),
                ..Friction::coulomb(mu)
            },
        ),
        (
            "kinetic",
            Friction {
                kinetic: Some(0.3),
                ..Friction::coulomb(mu)
            },
        ),
    ];
    let mut worst: f64 = 0.0;
    let soft = Elastic { E: 200e9, nu: 0.3 };
    for (name, law) in laws {
        let of = |k: usize| {
            let path = LoadPath::start()
                .normal(W, 4)
                .tangential(&[0.5 * mu * W, -0.5 * mu * W], k);
            let (mut scene, _) = sphere((soft, soft), (2.6, 48), path);
            scene.friction = law.clone();
            scene
        };
        let right = summarise(&solve(&of(192), &mut ()).expect("a solution"));
        for k in [6, 12, 24] {
            let (ours, bars) = with_bars(&of(k));
            for b in [1, 2] {
                let (value, right) = (ours[b].dissipated, right[b].dissipated);
                let bar = bars[b].dissipated;
                println!(
                    "{name}, {k} increments, branch {b}: {value:.4e} +- {bar:?} J, right {right:.4e}"
                );
                worst = worst.max((value - right).abs() / bar.total);
            }
        }
    }
    assert!(worst <= COVERS, "{worst}");
}

#[test]
fn what_vanishes_within_the_tolerance_has_its_error() {
    let path = LoadPath::start().normal(W, 3).tangential(&[0.1 * W], 4);
    let (scene, hertz) = sphere((STEEL, ALUMINIUM), (2.8, 24), path);
    let (branches, bars) = with_bars(&scene);
    for (branch, bar) in branches.iter().zip(&bars) {
        let (motions, loads) = branch.insignificant_sizes(&scene);
        let given = branch.loads.given.motions();
        for k in 1..6 {
            let (value, answered, least) = if given[k].is_some() {
                (branch.loads.forces()[k], bar.loads()[k], loads[k])
            } else {
                (branch.motion.motions()[k], bar.motions()[k], motions[k])
            };
            assert!(
                answered.total >= least || value == 0.0,
                "{k}: {value:e}, {answered:?}, at least {least:e}"
            );
        }
        // A ball has its rim within 0.015 cells at best.
        assert!(bar.contact_radius.total >= 0.015 * scene.grid.dx);
        assert!(bar.contact_radius.total < 0.02 * hertz.a);
    }
}
