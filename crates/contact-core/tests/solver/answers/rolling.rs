//! Material that rolls in from beyond the cells brings along what the tractions did to it there.

use contact_core::Scene;
use contact_core::march::{March, Tractions};
use contact_core::scene::{Friction, Grid, LoadPath};
use ndarray::s;

use super::{ALUMINIUM, STEEL, W, sphere};

/// Three increments of `k` cells each on n x n cells, a contact of 16 across.
fn rolled(n: usize, k: f64, tolerance: f64) -> Result<Tractions, contact_core::Error> {
    let (mut scene, _) = sphere((STEEL, ALUMINIUM), (3.0, n), LoadPath::start());
    let dx = 25e-6;
    scene.friction = Friction::coulomb(0.8);
    scene.grid = Grid::from_spacing((n, n), (dx, dx)).expect("a grid");
    scene.settings.solver.tolerance = Some(tolerance);
    scene.path = LoadPath::start()
        .normal(W, 1)
        .change_to(|to| to.T_x = 10.0, 2)
        .change_to(|to| to.rolled = 3.0 * k * dx, 3);
    last(&scene)
}

fn last(scene: &Scene) -> Result<Tractions, contact_core::Error> {
    let mut march = March::new(scene)?;
    while let Some(increment) = march.advance() {
        let increment = increment?;
        assert!(
            increment.residuals.energy.abs() < 1e-6,
            "{:?}",
            increment.residuals
        );
    }
    Ok(march.tractions())
}

#[test]
fn rolling_does_not_depend_on_what_lies_beyond_the_contact() {
    for k in [1.0, -1.0, 2.0, 3.0, 4.0] {
        let wide = rolled(60, k, 1e-8).expect("a solution");
        let narrow = rolled(24, k, 1e-8).expect("a solution");
        let norm = |f: &ndarray::Array2<f64>| f.iter().map(|f| f * f).sum::<f64>().sqrt();
        for c in 0..2 {
            let right = wide[c].slice(s![18..42, 18..42]).to_owned();
            let off = norm(&(&narrow[c] - &right)) / norm(&right);
            println!("{k} cells, component {c}: off by {off:.1e}");
            // Where a cell enters is told by cells around it: of four beyond the contact less is
            // known.
            assert!(off < 2e-3, "{k} cells: off by {off:e}");
        }
    }
}

#[test]
fn a_contact_that_would_roll_off_is_refused() {
    let refused = rolled(24, 6.0, 1e-6).expect_err("too far").to_string();
    assert!(
        refused.contains("6 cells in an increment") && refused.contains("more increments"),
        "{refused}"
    );
}
