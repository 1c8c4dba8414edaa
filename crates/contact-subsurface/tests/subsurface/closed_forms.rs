//! The axis of a pressed sphere; McEwen's cylinder.

use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Elastic, Grid, Shape};
use contact_reference::line_contact;
use contact_subsurface::{Depth, Line, Points, Section, Side, depths};

const NU: f64 = 0.3;

#[test]
fn pressed_sphere_on_the_axis() {
    let (n, nu) = (256, NU);
    let body = Body::homogeneous(Elastic::new(1.0, nu).unwrap(), Shape::Flat);
    let grid = Grid::centred(2.4, n).unwrap();
    let p = grid.map(|x, y| (1.0 - x * x - y * y).max(0.0).sqrt());
    let state = Tractions {
        p: p.as_slice(),
        ..Tractions::default()
    };
    let points = Points::new(&body, Side::Body1, &grid, &[state]).unwrap();
    let mut worst: f64 = 0.0;
    for z in [0.02, 0.2, 0.481, 1.0, 3.0] {
        let s = points.stress(&[(0.0, 0.0, Depth { z, layer: 0 })]).unwrap()[0][0];
        // K. L. Johnson, Contact Mechanics (1985), eq. (3.45).
        let radial = -(1.0 + nu) * (1.0 - z * (1.0 / z).atan()) + 0.5 / (1.0 + z * z);
        let axial = -1.0 / (1.0 + z * z);
        for (ours, exact) in [(s[0], radial), (s[1], radial), (s[2], axial)] {
            assert!((ours - exact).abs() < 1e-3, "z = {z}: {ours} {exact}");
            worst = worst.max((ours - exact).abs());
        }
    }
    println!("axis of a pressed sphere, 256 cells: {worst:.1e} p_H");
}

/// A cylinder in partial slip: rows as long as 40 half-widths stand for the infinite length.
#[test]
fn partial_slip_of_a_cylinder_converges_to_mcewen() {
    let nu = 0.3;
    let body = Body::homogeneous(Elastic::new(1.0, nu).unwrap(), Shape::Flat);
    let line = line_contact(1.0, 1.0, std::f64::consts::PI / 4.0);
    let (mu, T) = (0.4, 0.6 * 0.4 * line.W);
    let error = |n: usize| {
        let grid = Grid::from_spacing((n, 9), (2.4 * line.a / n as f64, 40.0 * line.a)).unwrap();
        let p = grid.map(|x, _| line.p(x));
        let q_x = grid.map(|x, _| line.q(x, T, mu));
        let state = Tractions {
            q_x: q_x.as_slice(),
            q_y: None,
            p: p.as_slice(),
        };
        let z: Vec<f64> = (1..=20).map(|i| f64::from(i) * 0.1 * line.a).collect();
        let depths = depths(&body, &z).unwrap();
        let section = Section::new(&body, Side::Body2, &grid, Line::AlongX(0.0), &[state]).unwrap();
        let stress = section.stress(&depths).unwrap().remove(0);
        let mut worst: f64 = 0.0;
        for (k, depth) in depths.iter().enumerate() {
            for i in 0..n {
                let [xx, zz, xz] = line.partial_slip_stress((grid.x(i), depth.z), T, mu);
                let exact = [xx, nu * (xx + zz), zz, 0.0, xz, 0.0];
                for c in 0..6 {
                    worst = worst.max((stress[(c, k, i)] - exact[c]).abs() / line.p0);
                }
            }
        }
        worst
    };
    let errors = [64, 256].map(error);
    println!("cylinder in partial slip, 64 and 256 cells: {errors:?} p_H");
    assert!(
        errors[1] < 5e-3 && errors[1] < 0.3 * errors[0],
        "{errors:?}"
    );
}
