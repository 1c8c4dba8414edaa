//! Normal and tangential load growing together from nothing, T = k W with k < mu: no cell slips,
//! and the shear is k times the pressure (similar bodies without lateral contraction; R. D.
//! Mindlin, H. Deresiewicz, J. Appl. Mech. 20 (1953) 327-344).

use contact_core::march::Status;
use contact_core::scene::{LoadPath, Loads};

use crate::bench::{CORK, W, run, sphere_on_flat};

const MU: f64 = 0.3;
const K: f64 = 0.2;

/// Largest |q - k p| over k p_max at the end, with that many increments.
fn misfit(increments: usize, entering: bool) -> f64 {
    let to = |to: &mut Loads| {
        to.W = W;
        to.T_x = K * W;
    };
    let path = LoadPath::start().change_to(to, increments);
    let mut scene = sphere_on_flat(CORK, CORK, MU, (2.4, 64), path);
    scene.settings.solver.tolerance = Some(1e-9);
    scene.settings.solver.cell_entry_correction = entering;
    let mut worst = 0.0_f64;
    run(&scene, |march, increment| {
        if entering {
            assert_eq!(increment.status, Status::FullStick, "{}", increment.index);
            assert!(increment.energy.dissipated.abs() < 1e-9 * increment.energy.work);
        }
        let energy = increment.residuals.energy;
        assert!(energy.abs() < 1e-7, "{energy:e}");
        let fields = march.fields();
        let off = |q: &f64, p: &f64| (q - K * p).abs() / (K * increment.p_max);
        let cells = fields.q_x.iter().zip(&fields.p);
        worst = cells.fold(0.0, |worst, (q, p)| worst.max(off(q, p)));
        worst = fields
            .q_y
            .iter()
            .fold(worst, |worst, q| worst.max(off(q, &0.0)));
    });
    worst
}

#[test]
fn shear_is_a_multiple_of_pressure() {
    for increments in [20, 5, 1] {
        let misfit = misfit(increments, true);
        assert!(
            misfit < 1e-5,
            "{increments} increments: q off by {misfit:e}"
        );
    }
}

/// Without the motion before entry it converges with the first power of the increment.
#[test]
fn cells_whose_motion_before_entry_is_left_out_take_too_much_shear() {
    let [coarse, fine] = [20, 40].map(|n| misfit(n, false));
    assert!(coarse > 0.05 && fine < 0.8 * coarse, "{coarse} {fine}");
}
