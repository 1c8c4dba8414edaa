//! The onset of sliding of unlike bodies: shift and energy run away there.

use std::sync::Arc;

use contact_core::Scene;
use contact_core::estimate::{BranchEnds, ErrorMethod, choose_increments, error_bars};
use contact_core::march::{Status, solve, summarise};
use contact_core::scene::{Elastic, LoadPath};

use super::{STEEL, W, run, sphere};

fn sheared(part: f64, n: usize, increments: Option<usize>) -> Scene {
    let lower = Elastic { E: 70e9, nu: 0.2 };
    let path = LoadPath::start()
        .normal(W, 20)
        .change_to(|to| to.T_x = part * 0.3 * W, increments);
    sphere((STEEL, lower), (2.6, n), path).0
}

#[test]
fn bars_cover_shift_and_energy_near_full_sliding() {
    for part in [0.9, 0.99, 0.999] {
        let chosen =
            choose_increments(&sheared(part, 32, None), &Arc::default()).expect("increments");
        let mut nobody = ();
        let mut ends = BranchEnds::new(&mut nobody);
        let increments = solve(&chosen, &mut ends).expect("a solution");
        let last = increments[increments.len() - 1];
        let bars = error_bars(
            &chosen,
            &increments,
            &ends.tractions,
            ErrorMethod::FinerGrid,
            &Arc::default(),
        )
        .expect("bars");
        let ours = summarise(&increments)[1];
        let right = summarise(&run(&sheared(part, 32, Some(400))))[1];
        println!(
            "{part}: {} increments, {:?}, shift {:.4e} +- {:?} for {:.4e}, energy {:.4e} +- {:?} for {:.4e}",
            ours.increments,
            last.status,
            ours.motion.delta_x,
            bars[1].delta_x,
            right.motion.delta_x,
            ours.dissipated,
            bars[1].dissipated,
            right.dissipated
        );
        assert_eq!(last.status, Status::PartialSlip);
        assert!((ours.motion.delta_x - right.motion.delta_x).abs() <= 1.5 * bars[1].delta_x.total);
        assert!((ours.dissipated - right.dissipated).abs() <= 1.5 * bars[1].dissipated.total);
    }
}
