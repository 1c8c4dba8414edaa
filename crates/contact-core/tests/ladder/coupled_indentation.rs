//! Dissimilar bodies, friction, W alone: the self-similar contact of Spence.

use contact_core::reference::{coupled_indentation, dundurs_beta};
use contact_core::scene::{Elastic, LoadPath};

use crate::audit::Audit;
use crate::bench::{
    CORK, RIM, STEEL, W, WHOLE_CELLS, cell, close, hertz_of, indentation, norm, run, sphere_on_flat,
};

/// Error of c/a times the number of increments of equal radius. A stick zone that missed half of the
/// growth of an increment would be off by 0.5; a slip ring thinner than a cell leaves some of that.
const PATH: f64 = 0.1;

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
        let mut audit = Audit::new(&scene);
        let all = run(&scene, |march, increment| audit.check(march, increment));
        for at in [increments / 2, increments - 1] {
            let increment = &all[at];
            // Lengths grow with the contact radius, so a cell counts for more at half of it.
            let part = (at + 1) as f64 / increments as f64;
            let (d, steps) = (d / part, (at + 1) as f64);
            let a = hertz.a * part * truth.W.cbrt().recip();
            close("a", increment.contact_radius() / a, 1.0, WHOLE_CELLS * d);
            let ratio = (increment.stick_area / increment.contact_area).sqrt();
            close(
                "c/a",
                ratio,
                truth.stick_ratio,
                PATH / steps + WHOLE_CELLS * d,
            );
            // p has a cusp in the middle, as wide as the stick circle: first order in the cell.
            let p0 = truth.p0 * truth.W.powf(2.0 / 3.0) * hertz.p0 * part;
            close(
                "p0",
                increment.p_max / p0,
                1.0,
                0.15 * d / truth.stick_ratio,
            );
            let delta_z = truth.delta_z * a * a / crate::bench::R;
            close("delta_z", increment.motion.delta_z / delta_z, 1.0, 1e-3);
        }
    }
}

#[test]
fn more_increments_lead_to_the_self_similar_stick_radius() {
    let truth = coupled_indentation(0.5, 0.5).stick_ratio;
    let error = |increments: usize| {
        let scene = sphere_on_flat(
            CORK,
            Elastic::RIGID,
            0.5,
            (2.2, 128),
            indentation(increments),
        );
        let all = run(&scene, |_, _| {});
        let last = all.last().expect("an increment");
        let ratio = (last.stick_area / last.contact_area).sqrt();
        (ratio - truth, cell(&scene))
    };
    let ((coarse, _), (fine, d)) = (error(10), error(80));
    // The stick zone of the middle of the increment would miss half of what it grows by; what is left
    // of that is of second order, and in the end what the grid leaves.
    let half = 0.5 * truth / 10.0;
    assert!(coarse.abs() < half / 4.0, "{coarse} of {half}");
    assert!(fine.abs() < WHOLE_CELLS * d, "{fine}, cells of {d}");
}

#[test]
fn a_growing_stick_zone_is_known_within_the_cells() {
    // An increment is as long as a cell.
    let (n, extent) = (110, 2.2);
    for (material, mu) in [(STEEL, 0.2), (CORK, 0.5)] {
        let path = indentation(n / 2);
        let scene = sphere_on_flat(material, Elastic::RIGID, mu, (extent, n), path);
        let truth = coupled_indentation(dundurs_beta(material, Elastic::RIGID), mu);
        // Once the stick zone has thirty cells and more for the five that tell its border.
        for increment in &run(&scene, |_, _| {})[3 * n / 8..] {
            let ratio = (increment.stick_area / increment.contact_area).sqrt();
            let a = increment.contact_radius() / scene.grid.dx;
            // Twice what a border that shrinks is off by.
            close("c/a", ratio, truth.stick_ratio, 2.0 * RIM / a);
        }
    }
}

#[test]
fn increments_of_equal_radius_are_the_natural_ones() {
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
