//! On the surface: the tractions, the surface displacement, borders between cells.

use contact_core::convolution::{Direct, Displacements, SurfaceOperator, Tractions};
use contact_core::kernels::influence_coefficients;
use contact_core::scene::{Grid, KernelSettings};
use contact_subsurface::{Depth, Line, Points, Section, Side, Slices};

use crate::{coated, states, tractions};

#[test]
fn surface_values_are_the_tractions_and_the_surface_displacement() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let top = Depth { z: 0.0, layer: 0 };
    let coefficients =
        influence_coefficients(&body, &grid, &KernelSettings::default(), true, None).unwrap();
    for side in [Side::Body1, Side::Body2] {
        let slices = Slices::new(&body, side, &grid, &[states(&q)]).unwrap();
        let stress = slices.stress(top).unwrap().remove(0);
        // On the plane both bodies have the same stress vector, in the same axes.
        for (row, load) in [(2, &q[2]), (4, &q[0]), (5, &q[1])] {
            let error = (&stress[row] + load).mapv(f64::abs);
            assert!(error.iter().all(|e| *e < 1e-12), "{side:?} {row}");
        }
        let sign = if side == Side::Body1 { -1.0 } else { 1.0 };
        let own = [
            q[0].mapv(|v| sign * v),
            q[1].mapv(|v| sign * v),
            q[2].clone(),
        ];
        let mut u = [0, 1, 2].map(|_| vec![0.0; grid.cells()]);
        let [u_x, u_y, u_z] = &mut u;
        Direct::new(coefficients.clone()).apply(
            states(&own),
            Displacements {
                u_x: Some(u_x),
                u_y: Some(u_y),
                u_z: Some(u_z),
            },
        );
        let ours = slices.displacement(top).unwrap().remove(0);
        for (c, sign) in [1.0, 1.0, sign].into_iter().enumerate() {
            for (a, b) in ours[c].iter().zip(&u[c]) {
                assert!((a - sign * b).abs() < 1e-10, "{side:?} {c}: {a} {b}");
            }
        }
    }
}

/// Between two rows of equal loads the surface stress is as continuous as through their middles.
#[test]
fn surface_stress_on_a_border_is_the_mean_of_both_sides() {
    let body = coated();
    let grid = Grid::from_spacing((21, 22), (1.0, 0.3)).unwrap();
    let smooth = |x: f64, y: f64| (1.0 - (x / 8.0).powi(2) - (y / 2.7).powi(2)).max(0.0);
    let (p, q_x) = (grid.map(smooth), grid.map(|x, y| 0.2 * smooth(x, y)));
    let state = Tractions {
        q_x: q_x.as_slice(),
        q_y: None,
        p: p.as_slice(),
    };
    let top = [Depth { z: 0.0, layer: 0 }];
    let on = |y: f64| {
        let section = Section::new(&body, Side::Body2, &grid, Line::AlongX(y), &[state]);
        section.unwrap().stress(&top).unwrap().remove(0)
    };
    let (border, middle) = (on(0.0), on(grid.y(11)));
    let points = Points::new(&body, Side::Body2, &grid, &[state]).unwrap();
    // y = 0.9 is a border; in tenths of the cell it is not a whole number.
    for y in [0.0, 3.0 * 0.3] {
        let line = on(y);
        for i in 4..17 {
            let point = points.stress(&[(grid.x(i), y, top[0])]).unwrap()[0][0];
            for c in 0..6 {
                assert!((line[(c, 0, i)] - point[c]).abs() < 1e-11, "{y} {i} {c}");
            }
        }
    }
    // Where four cells meet as well.
    let vertex = points.stress(&[(0.5, 0.0, top[0])]).unwrap()[0][0];
    for c in 0..6 {
        let mean = f64::midpoint(border[(c, 0, 10)], border[(c, 0, 11)]);
        assert!(
            (vertex[c] - mean).abs() < 0.02,
            "component {c}: {} {mean}",
            vertex[c]
        );
    }
    for i in 4..17 {
        for c in 0..6 {
            // The fields change by a few per mille over half a cell.
            let step = (border[(c, 0, i)] - middle[(c, 0, i)]).abs();
            assert!(step < 0.02, "component {c} at {i}: {step:.1e}");
        }
    }
}
