//! Dissimilar bodies, friction, W alone: the self-similar contact of Spence.

use contact_core::scene::{Elastic, LoadPath};
use contact_reference::{coupled_indentation, dundurs_beta};

use crate::bench::{
    CORK, RIM, SMOOTH, STEEL, W, WHOLE_CELLS, cell, close, hertz_of, indentation, norm, run,
    run_audited, run_without_growth_steps, sphere_on_flat,
};

/// What is claimed of c/a and p(0) after 40 increments on 128 cells a side, relative. Both errors,
/// of the cells and of the increments, are of second order.
const CLAIM: f64 = 1e-3;
/// What the truth is good to.
const TRUTH: f64 = 1e-4;

#[test]
fn stick_radius_pressure_and_approach_of_every_pair() {
    let increments = 40;
    for (material, mu) in [(STEEL, 0.2), (STEEL, 0.5), (CORK, 0.2), (CORK, 0.5)] {
        let scene = sphere_on_flat(
            material,
            Elastic::RIGID,
            mu,
            (2.2, 128),
            indentation(increments),
        );
        let (hertz, d) = (hertz_of(&scene), cell(&scene));
        let truth = coupled_indentation(dundurs_beta(material, Elastic::RIGID), mu);
        let all = run_audited(&scene, |_, _| ());
        for at in [increments / 2, increments - 1] {
            let increment = &all[at];
            // Lengths grow with the contact radius, so a cell and an increment count for more at
            // half of it.
            let part = (at + 1) as f64 / increments as f64;
            let d = d / part;
            let claim = CLAIM / (part * part);
            // Fewer than five cells in the slip ring do not tell its border, and thirty in a radius
            // do so by where it lies in them: what is left are whole cells.
            let thin = 1.0 - truth.stick_ratio < 5.0 * d;
            let rim = if thin { WHOLE_CELLS } else { RIM } * d;
            let ring = if thin || part < 1.0 {
                // A tenth of an increment comes on top.
                WHOLE_CELLS * d + 0.1 / (at + 1) as f64
            } else {
                // The border is known to a twentieth of a cell.
                claim * truth.stick_ratio + RIM * d
            };
            let a = hertz.a * part * truth.W.cbrt().recip();
            close("a", increment.contact_radius / a, 1.0, rim + TRUTH);
            let ratio = (increment.stick_area / increment.contact_area).sqrt();
            close("c/a", ratio, truth.stick_ratio, ring);
            let p0 = truth.p0 * truth.W.powf(2.0 / 3.0) * hertz.p0 * part;
            // p has a cusp in the middle, as wide as the stick circle: first order in the cell.
            let cusp = 0.15 * d / truth.stick_ratio;
            close("p0", increment.p_max / p0, 1.0, claim.max(cusp));
            let delta_z = truth.delta_z * a * a / crate::bench::R;
            let smooth = (SMOOTH * d * d + TRUTH).max(1e-3);
            close("delta_z", increment.motion.delta_z / delta_z, 1.0, smooth);
        }
    }
}

/// Error of c/a, root mean square over grids whose cells differ: where the rim lies in its cells
/// makes single ones go up and down.
fn error(increments: usize) -> f64 {
    let truth = coupled_indentation(0.5, 0.5).stick_ratio;
    let squares = [116, 122, 128].map(|n| {
        let path = indentation(increments);
        let scene = sphere_on_flat(CORK, Elastic::RIGID, 0.5, (2.2, n), path);
        let all = run_without_growth_steps(&scene);
        let last = all.last().expect("an increment");
        let ratio = (last.stick_area / last.contact_area).sqrt();
        (ratio / truth - 1.0).powi(2)
    });
    (squares.iter().sum::<f64>() / 3.0).sqrt()
}

#[test]
fn the_stick_radius_is_of_second_order_in_the_increments() {
    let errors = [5, 10, 20].map(error);
    for pair in errors.windows(2) {
        // What the cells leave, some 2e-4, may take up to half of one from the order of the last.
        let order = (pair[0] / pair[1]).log2();
        assert!(order > 1.5, "{order}: {errors:?}");
    }
}

#[test]
fn the_border_of_a_growing_stick_zone_is_known_to_a_tenth_of_a_cell() {
    // An increment is as long as a cell.
    let (n, extent) = (110, 2.2);
    for (material, mu) in [(STEEL, 0.2), (CORK, 0.5)] {
        let path = indentation(n / 2);
        let scene = sphere_on_flat(material, Elastic::RIGID, mu, (extent, n), path);
        let truth = coupled_indentation(dundurs_beta(material, Elastic::RIGID), mu);
        // Once the stick zone has thirty cells and more for the five that tell its border.
        for increment in &run(&scene, |_, _| {})[3 * n / 8..] {
            let ratio = (increment.stick_area / increment.contact_area).sqrt();
            let a = increment.contact_radius / scene.grid.dx;
            // Twice what a border that shrinks is off by.
            close("c/a", ratio, truth.stick_ratio, 2.0 * RIM / a);
        }
    }
}

#[test]
fn increments_of_equal_radius_are_more_exact_than_those_of_equal_force() {
    let shear = |path: LoadPath| {
        let scene = sphere_on_flat(CORK, Elastic::RIGID, 0.5, (2.2, 64), path);
        let mut q_x = None;
        run(&scene, |march, _| q_x = Some(march.fields().q_x));
        q_x.expect("an increment")
    };
    let limit = shear(indentation(120));
    let error = |q: &ndarray::Array2<f64>| norm(&(q - &limit)) / norm(&limit);
    let (equal, uniform) = (
        error(&shear(indentation(20))),
        error(&shear(LoadPath::start().normal(W, 20))),
    );
    assert!(equal < uniform, "{equal} {uniform}");
}
