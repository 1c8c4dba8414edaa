//! Stress below the surface against direct sums, closed forms and the equations of elasticity.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "../../../contact-core/tests/branch_ends/mod.rs"]
mod branch_ends;
mod bulk;
mod closed_forms;
#[path = "../../../contact-core/tests/document/mod.rs"]
mod document;
mod elasticity;
#[path = "../../../contact-core/tests/kernel_tables/mod.rs"]
mod kernel_tables;
mod largest;
mod rims;
mod sliding_sphere;
mod solved;
mod surface;
mod ways;

use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Coating, Elastic, Grid, Shape};
use ndarray::Array2;

/// A body with two layers on a substrate; lengths in cells.
fn coated() -> Body {
    let layer = |E, nu, thickness| Coating {
        material: Elastic::new(E, nu).unwrap(),
        thickness,
    };
    Body {
        substrate: Elastic::new(1.0, 0.3).unwrap(),
        coatings: vec![layer(3.0, 0.25, 9.5), layer(0.4, 0.4, 2.5)],
        bonds: Vec::new(),
        plastic: Vec::new(),
        hardness: f64::INFINITY,
        residual: Vec::new(),
        shape: Shape::Flat,
        bulk: contact_core::scene::Bulk::default(),
    }
}

/// Tractions without any symmetry, nothing on some cells.
fn tractions(grid: &Grid) -> [Array2<f64>; 3] {
    let some = |seed: f64| {
        grid.map(|x, y| {
            let loaded = (x - 0.7).hypot(y + 1.3) < 2.3;
            let value = (12.9898 * x + 78.233 * y + seed).sin() + 0.3;
            if loaded { value } else { 0.0 }
        })
    };
    [some(0.1), some(1.7), some(2.9)]
}

fn states(q: &[Array2<f64>; 3]) -> Tractions<'_> {
    Tractions {
        q_x: q[0].as_slice(),
        q_y: q[1].as_slice(),
        p: q[2].as_slice(),
    }
}
