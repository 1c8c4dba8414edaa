//! What either body takes of the heat.

use contact_core::kernels::Complex64;
use contact_heat::{Conduction, Layers, partition};

use super::{A, STEEL, TITANIUM, close, coated, disc, grid, source, steel, titanium};

/// frequency.
/// The steady share of half-spaces is K_1/(K_1 + K_2), that of bodies of the same make half, at any
#[test]
fn heat_goes_where_it_is_conducted() {
    let grid = grid(8);
    let q = disc(&grid);
    let contact: Vec<bool> = q.iter().map(|q| q.re > 0.0).collect();
    let shares = |bodies: [&Layers; 2], w: f64| {
        let [mut one, mut two] = bodies.map(|body| Conduction::new(body, &grid, w).unwrap());
        let flux = partition([&mut one, &mut two], &q, &contact, 0.0)
            .unwrap()
            .flux;
        let cells = q.iter().zip(&flux[0]).filter(|(q, _)| q.re > 0.0);
        cells.map(|(q, one)| one / q).collect::<Vec<_>>()
    };
    let (k_1, k_2) = (STEEL.conductivity, TITANIUM.conductivity);
    for share in shares([&steel(), &titanium()], 0.0) {
        assert!((share - k_1 / (k_1 + k_2)).norm() < 1e-12, "{share}");
    }
    let layered = coated(TITANIUM, 0.2 * A, STEEL);
    for w in [0.0, 30.0] {
        for share in shares([&layered, &layered], w) {
            assert!((share - 0.5).norm() < 1e-12, "{share}");
        }
    }
}

/// A coated and a bare body, steady and swinging: what flows into both is the heat, and on every
/// cell in contact they are as warm as each other.
#[test]
fn temperatures_agree_where_bodies_touch() {
    let grid = grid(8);
    let q = source(&grid, |r| {
        (1.0 - r * r).max(0.0).sqrt() * (2.0 + (3.0 * r).sin())
    });
    let contact: Vec<bool> = q.iter().map(|q| q.re > 0.0).collect();
    let warmer = 1e-6;
    for (w, warmer) in [(0.0, 0.0), (0.0, warmer), (3.0, 0.0), (3e3, 0.0)] {
        let layered = coated(TITANIUM, 0.2 * A, STEEL);
        let [mut one, mut two] =
            [&layered, &titanium()].map(|body| Conduction::new(body, &grid, w).unwrap());
        let found = partition([&mut one, &mut two], &q, &contact, warmer).unwrap();
        let largest = found.rise[1].iter().map(|t| t.norm()).fold(0.0, f64::max);
        for n in 0..q.len() {
            let sum = found.flux[0][n] + found.flux[1][n];
            assert!((sum - q[n]).norm() < 1e-12);
            let step = found.rise[0][n] - found.rise[1][n] - warmer;
            assert!(
                !contact[n] || step.norm() < 1e-7 * largest,
                "{step} of {largest}"
            );
        }
        assert!(
            found.flux[0]
                .iter()
                .zip(&contact)
                .all(|(q, c)| *c || q.norm() == 0.0)
        );
    }
}

/// Without friction heat flows from the warmer to the colder body through the constriction of a
/// disc: Q = (T_2 - T_1)/(1/(4 K_1 a) + 1/(4 K_2 a)) (Carslaw and Jaeger 1959, section 8.2).
#[test]
fn a_disc_between_a_warm_and_a_cold_body() {
    let grid = grid(16);
    let none = vec![Complex64::ZERO; grid.cells()];
    let contact: Vec<bool> = disc(&grid).iter().map(|q| q.re >= 0.5).collect();
    let [mut one, mut two] =
        [&steel(), &titanium()].map(|body| Conduction::new(body, &grid, 0.0).unwrap());
    let found = partition([&mut one, &mut two], &none, &contact, 10.0).unwrap();
    let total: f64 = found.flux[0].iter().map(|q| q.re).sum::<f64>() * grid.cell_area();
    let resistance = (1.0 / STEEL.conductivity + 1.0 / TITANIUM.conductivity) / (4.0 * A);
    // The flux is singular at the rim, whose place the cells know to a fraction of their width.
    close(total, 10.0 / resistance, 0.25 / 16.0);
}
