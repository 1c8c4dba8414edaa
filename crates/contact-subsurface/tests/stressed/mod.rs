//! A coated body under a contact's tractions, for benches and examples of the stress below it.

#![allow(unreachable_pub)]

use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Coating, Elastic, Grid, Shape};
use contact_subsurface::Depth;
use ndarray::Array2;

/// Hertz radius of the paper's contact \[m\].
const A_H: f64 = 4.890_973e-4;
/// Its Hertz pressure, about \[Pa\].
const P_H: f64 = 2e9;

/// Tractions on a body.
pub(crate) struct Contact {
    /// The coated body, E1/E2 = 2.
    pub(crate) body: Body,
    /// The paper's grid.
    pub(crate) grid: Grid,
    q: [Array2<f64>; 3],
}

/// A coating as thick as the contact's radius under a sliding sphere, with a little shear across,
/// as the coating causes it.
pub(crate) fn coated(n: usize) -> Contact {
    let material = |E| Elastic::new(E, 0.3).expect("a material");
    let body = Body {
        substrate: material(210e9),
        coatings: vec![Coating {
            material: material(420e9),
            thickness: A_H,
        }],
        bonds: Vec::new(),
        plastic: Vec::new(),
        hardness: f64::INFINITY,
        residual: Vec::new(),
        shape: Shape::Flat,
        bulk: contact_core::scene::Bulk::default(),
    };
    let grid = Grid::centred(2.4 * A_H, n).expect("a grid");
    let hertz = |x: f64, y: f64| P_H * (1.0 - (x * x + y * y) / (A_H * A_H)).max(0.0).sqrt();
    let q = [
        grid.map(|x, y| 0.3 * hertz(x, y)),
        grid.map(|x, y| 0.01 * hertz(x, y) * x * y / (A_H * A_H)),
        grid.map(hertz),
    ];
    Contact { body, grid, q }
}

impl Contact {
    /// The tractions.
    pub(crate) fn tractions(&self) -> Tractions<'_> {
        Tractions {
            q_x: self.q[0].as_slice(),
            q_y: self.q[1].as_slice(),
            p: self.q[2].as_slice(),
        }
    }

    /// Depths to 2 a_H, the first on the surface if there are several.
    pub(crate) fn depths(&self, n: usize) -> Vec<Depth> {
        let last = (n.max(2) - 1) as f64;
        let z: Vec<f64> = (0..n).map(|i| 2.0 * A_H * (i as f64 / last)).collect();
        contact_subsurface::depths(&self.body, &z).expect("depths")
    }
}
