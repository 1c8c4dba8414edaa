//! A coating that is worn through.

use std::sync::Arc;

use contact_core::scene::{Coating, Elastic, Grid};
use contact_wear::{Archard, BodyWear, Cycling, EventKind, Law, WornThrough};

use crate::bench::{archard, cylinder, run, scene, to_and_fro, wear};

#[test]
fn a_run_ends_at_the_cycle_in_which_the_coating_is_through_or_goes_on_with_the_substrate() {
    let thickness = 0.5e-6;
    let (W, stroke) = (18.5e3, 1e-6);
    let grid = Grid::strip(0.4e-3, 200, 1.0).unwrap();
    let mut scene = scene(cylinder(6e-3), grid, to_and_fro(W, stroke, 1), 0.5);
    let material = Elastic { E: 400e9, nu: 0.25 };
    scene.body2.coatings = vec![Coating {
        material,
        thickness,
    }];
    let law = |k: f64| -> Arc<dyn Law> { Arc::new(Archard { k, threshold: 0.0 }) };
    let coated = BodyWear {
        laws: vec![law(1e-14), law(1e-13)],
        share: None,
    };
    let mut wear = wear([BodyWear::default(), coated.clone()], 1e6, Cycling::Sliding);
    let (ended, jumps) = run(&scene, &wear);
    let last = jumps.last().unwrap();
    let events = &ended.state().events;
    assert!(
        last.cycles < 1e6 && (last.depth[1] / thickness - 1.0).abs() < 2e-3,
        "{last:?}"
    );
    let kinds: Vec<_> = events.iter().map(|e| (e.kind, e.body)).collect();
    assert_eq!(
        kinds,
        [(EventKind::Thinned, 2), (EventKind::WornThrough, 2)]
    );
    assert!(events[1].x.abs() <= grid.dx && events[0].cycles < events[1].cycles);

    // With a substrate that wears ten times as fast the same cycles again wear more than the
    // coating.
    (wear.worn_through, wear.cycles) = (WornThrough::GoOn, 2.0 * last.cycles);
    let (_, soft) = run(&scene, &wear);
    wear.bodies[1] = archard(1e-14);
    let (_, alike) = run(&scene, &wear);
    let depth = |jumps: &[contact_wear::Jump]| jumps.last().unwrap().depth[1];
    assert!(
        depth(&soft) > 1.1 * depth(&alike),
        "{:e}, {:e}",
        depth(&soft),
        depth(&alike)
    );
}
