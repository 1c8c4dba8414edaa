//! Cells that enter the contact while it grows, against increments so short that it does not matter
//! how.
//!
//! A cell that the contact reaches within an increment has moved freely until then, and its slip is
//! reckoned from there (`solver.cell_entry_correction`). What it moves as the edge of the contact comes nearer
//! bends like a root of the distance to it. So what one increment of N that lead to the radius a
//! tells of that way, from one edge to the next, is good to the 3/2 power of its length, 1/N; once
//! an increment is as short as a cell, the cells are what is left. The truth are increments of half
//! a cell, and slip reckoned from the start of the increment leads to the same limit, of first
//! order in the increment.

use contact_core::scene::{Branch, Elastic, LoadPath, Loads, Scene, Spacing};
use ndarray::Array2;

use crate::bench::{
    CORK, FIELD, STEEL, W, cell, coated, hertz_of, indentation, norm, run, sphere_on_flat,
};

/// The grid: 29 cells in a radius.
const GRID: (f64, usize) = (2.2, 64);

/// W and in proportion to it T_x, in increments of equal radius.
fn proportional(T_x: f64, increments: usize) -> LoadPath {
    LoadPath::start().push_branch(Branch {
        to: Loads {
            W,
            T_x,
            ..Loads::default()
        },
        increments: Some(increments),
        spacing: Spacing::EqualRadius,
        t_end: 1.0,
        path_error: None,
    })
}

/// The shear at the end.
fn shear(scene: &Scene) -> [Array2<f64>; 2] {
    let mut q = None;
    run(scene, |march, _| q = Some(march.shear()));
    q.expect("an increment")
}

/// Distance of two shears over that of the other, root mean square.
fn distance(one: &[Array2<f64>; 2], other: &[Array2<f64>; 2]) -> f64 {
    let size = |q: [f64; 2]| q[0].hypot(q[1]);
    size([0, 1].map(|c| norm(&(&one[c] - &other[c])))) / size([0, 1].map(|c| norm(&other[c])))
}

/// Few increments come as near to the limit of short ones as their length says, and so do short
/// ones that reckon slip from the start.
#[track_caller]
fn leads_to_the_limit_of_short_increments(of: impl Fn(usize) -> Scene) {
    let d = cell(&of(1));
    let radius = (1.0 / d).round() as usize;
    let limit = shear(&of(2 * radius));
    for increments in [5, 10, radius] {
        let error = distance(&shear(&of(increments)), &limit);
        let allowed = (increments as f64).powf(-1.5) + FIELD * d;
        assert!(
            error < allowed,
            "{error:.1e} after {increments} increments, allowed {allowed:.1e}"
        );
    }
    let [long, short] = [2, 4].map(|parts| {
        let mut scene = of(parts * radius);
        scene.settings.solver.cell_entry_correction = false;
        distance(&shear(&scene), &limit)
    });
    assert!(short < 0.5 * (long + FIELD * d), "{long:.1e} {short:.1e}");
}

#[test]
fn indentation_of_dissimilar_bodies_leads_to_the_limit_of_short_increments() {
    for (material, mu) in [(CORK, 0.5), (STEEL, 0.5)] {
        leads_to_the_limit_of_short_increments(|increments| {
            let path = proportional(0.0, increments);
            sphere_on_flat(material, Elastic::RIGID, mu, GRID, path)
        });
    }
}

#[test]
fn indentation_of_a_coated_flat_leads_to_the_limit_of_short_increments() {
    leads_to_the_limit_of_short_increments(|increments| {
        let path = proportional(0.0, increments);
        let scene = sphere_on_flat(STEEL, STEEL, 0.3, GRID, path);
        let hard = Elastic {
            E: 2.0 * STEEL.E,
            nu: 0.3,
        };
        let a_H = hertz_of(&scene).a;
        coated(scene, hard, a_H)
    });
}

#[test]
fn forces_that_grow_in_proportion_lead_to_the_limit_of_short_increments() {
    for lower in [Elastic::RIGID, STEEL] {
        leads_to_the_limit_of_short_increments(|increments| {
            let path = proportional(0.2 * W, increments);
            sphere_on_flat(STEEL, lower, 0.5, GRID, path)
        });
    }
}

/// Cells that enter last in an increment of a small contact would keep a ring of wrong shear, which
/// sticks to the end.
#[test]
fn no_ring_of_cells_keeps_what_an_increment_has_missed() {
    for part in [0.5, 2.0] {
        let of = |path: LoadPath| {
            let scene = sphere_on_flat(STEEL, STEEL, 0.3, (2.4, 96), path);
            let material = Elastic {
                E: part * STEEL.E,
                nu: 0.3,
            };
            let a_H = hertz_of(&scene).a;
            shear(&coated(scene, material, a_H))
        };
        let limit = of(indentation(240));
        let size = |q: &[Array2<f64>; 2]| {
            let squares = &q[0] * &q[0] + &q[1] * &q[1];
            squares.iter().copied().fold(0.0, f64::max).sqrt()
        };
        // Of 12 increments of equal radius the last step is off by about 1.2/12^2 of the shear,
        // before cells.
        for (path, allowed) in [
            (indentation(12), 0.03),
            (LoadPath::start().normal(W, 100), 0.05),
        ] {
            let q = of(path);
            let off = size(&[0, 1].map(|c| &q[c] - &limit[c])) / size(&limit);
            assert!(
                off < allowed,
                "E1/E2 = {part}: a cell is off by {off:.3}, allowed {allowed}"
            );
        }
    }
}
