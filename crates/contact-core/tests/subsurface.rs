//! Stress below the surface against direct sums, closed forms and the equations of elasticity.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod kernel_tables;

use contact_core::convolution::{Direct, Displacements, SurfaceOperator, Tractions};
use contact_core::fields::{Depth, Line, Points, Section, Side, Slices, depths, rims};
use contact_core::kernels::{influence_coefficients, stress_at};
use contact_core::reference::{HertzStress, line_contact};
use contact_core::scene::{Body, Coating, Elastic, Grid, KernelSettings, Shape};
use kernel_tables::{body, load, matrix, number, whole};
use ndarray::{Array2, Array3, Axis};

/// A body with two layers on a substrate; lengths in cells.
fn coated() -> Body {
    let layer = |E, nu, thickness| Coating {
        material: Elastic::new(E, nu).unwrap(),
        thickness,
    };
    Body {
        substrate: Elastic::new(1.0, 0.3).unwrap(),
        coatings: vec![layer(3.0, 0.25, 9.5), layer(0.4, 0.4, 2.5)],
        shape: Shape::Flat,
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

/// The stress by its definition: the sum over all cells.
fn direct(
    body: &Body,
    grid: &Grid,
    q: &[Array2<f64>; 3],
    at: (f64, f64),
    depth: Depth,
) -> [f64; 6] {
    let mut sum = [0.0; 6];
    for i in 0..grid.nx {
        for j in 0..grid.ny {
            let loads = [0, 1, 2].map(|c| q[c][(i, j)]);
            if loads.iter().all(|q| *q == 0.0) {
                continue;
            }
            let from = (at.0 - grid.x(i), at.1 - grid.y(j), depth.z);
            let s = stress_at(body, (grid.dx, grid.dy), from, Some(depth.layer)).unwrap();
            for (sum, row) in sum.iter_mut().zip(s) {
                *sum += row[0] * loads[0] + row[1] * loads[1] + row[2] * loads[2];
            }
        }
    }
    sum
}

/// The table of single cells, whose smallest features point loads have to follow.
#[test]
fn a_single_cell_reproduces_the_table() {
    let mut worst: f64 = 0.0;
    for entry in load("kernel_stress.json") {
        let body = body(&entry);
        let d = (number(&entry, "d1"), number(&entry, "d2"));
        let grid = Grid::from_spacing((1, 1), d).unwrap();
        let depth = Depth {
            z: number(&entry, "x3"),
            layer: whole(&entry, "layer_index") as usize,
        };
        let at = (number(&entry, "x1"), number(&entry, "x2"), depth);
        let one = [1.0];
        let loads = [
            Tractions {
                q_x: Some(&one),
                ..Tractions::default()
            },
            Tractions {
                q_y: Some(&one),
                ..Tractions::default()
            },
            Tractions {
                p: Some(&one),
                ..Tractions::default()
            },
        ];
        let points = Points::new(&body, Side::Body2, &grid, &loads).unwrap();
        let ours = points.stress(&[at]).unwrap();
        let theirs = matrix(&entry["s"]);
        let largest = theirs
            .iter()
            .flatten()
            .fold(0.0, |m: f64, s| m.max(s.abs()));
        for (row, theirs) in theirs.iter().enumerate() {
            for (column, theirs) in theirs.iter().enumerate() {
                let error = (ours[column][0][row] - theirs).abs() / largest;
                assert!(error < 1e-6, "entry {}: {error:.1e}", entry["id"]);
                worst = worst.max(error);
            }
        }
    }
    println!("table of stresses under a cell: {worst:.1e} of the largest component");
}

#[test]
fn all_ways_agree_with_the_direct_sum() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let state = states(&q);
    let z = [0.0, 0.4, 3.0, 9.5, 11.0, 12.0, 14.0, 40.0];
    let depths = depths(&body, &z).unwrap();
    assert_eq!(depths.len(), 10);
    let slices = Slices::new(&body, Side::Body2, &grid, &[state]).unwrap();
    let points = Points::new(&body, Side::Body2, &grid, &[state]).unwrap();
    // Through the middles of cells, between them, and off both.
    let lines = [
        Line::AlongX(grid.y(4)),
        Line::AlongX(0.0),
        Line::AlongX(2.171),
        Line::AlongY(grid.x(9)),
        Line::AlongY(-1.83),
    ];
    let sections =
        lines.map(|line| Section::new(&body, Side::Body2, &grid, line, &[state]).unwrap());
    let lines_stress: Vec<_> = sections
        .iter()
        .map(|s| s.stress(&depths).unwrap().remove(0))
        .collect();
    for (k, depth) in depths.iter().enumerate() {
        // Point loads stand for cells from eight cells' depth on.
        let tolerance = if depth.z < 8.0 { 1e-11 } else { 3e-8 };
        let plane = slices.stress(*depth).unwrap().remove(0);
        for (i, j) in [(0, 0), (7, 4), (3, 10)] {
            let at = (grid.x(i), grid.y(j));
            let truth = direct(&body, &grid, &q, at, *depth);
            let point = points.stress(&[(at.0, at.1, *depth)]).unwrap()[0][0];
            for c in 0..6 {
                let error = (plane[c][(i, j)] - truth[c]).abs();
                assert!(error < tolerance, "plane {depth:?} {c}: {error:.1e}");
                let error = (point[c] - truth[c]).abs();
                assert!(error < tolerance, "point {depth:?} {c}: {error:.1e}");
            }
        }
        for (line, stress) in lines.iter().zip(&lines_stress) {
            for i in [5] {
                let at = match *line {
                    Line::AlongX(y) => (grid.x(i), y),
                    Line::AlongY(x) => (x, grid.y(i)),
                };
                // On a border between cells the surface stress has no value.
                if depth.z == 0.0 && matches!(line, Line::AlongX(0.0)) {
                    continue;
                }
                let truth = direct(&body, &grid, &q, at, *depth);
                for c in 0..6 {
                    let error = (stress[(c, k, i)] - truth[c]).abs();
                    assert!(error < tolerance, "{line:?} {depth:?} {c}: {error:.1e}");
                }
            }
        }
    }
}

#[test]
fn surface_values_are_the_tractions_and_the_surface_displacement() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let top = Depth { z: 0.0, layer: 0 };
    let coefficients =
        influence_coefficients(&body, &grid, &KernelSettings::default(), true).unwrap();
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

#[test]
fn what_must_be_continuous_across_interfaces_is() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let section =
        Section::new(&body, Side::Body2, &grid, Line::AlongX(0.4), &[states(&q)]).unwrap();
    let both = depths(&body, &[9.5, 12.0]).unwrap();
    assert_eq!(
        both.iter().map(|d| d.layer).collect::<Vec<_>>(),
        [0, 1, 1, 2]
    );
    let stress = section.stress(&both).unwrap().remove(0);
    let u = section.displacement(&both).unwrap().remove(0);
    let mut worst: f64 = 0.0;
    for upper in [0, 2] {
        for i in 0..grid.nx {
            for c in [2, 4, 5] {
                let jump = stress[(c, upper, i)] - stress[(c, upper + 1, i)];
                worst = worst.max(jump.abs());
                assert!(jump.abs() < 1e-9, "stress {c} at {upper}: {jump:.1e}");
            }
            for c in 0..3 {
                let jump = u[(c, upper, i)] - u[(c, upper + 1, i)];
                assert!(jump.abs() < 1e-9, "displacement {c} at {upper}: {jump:.1e}");
            }
        }
        let jump = (0..grid.nx).map(|i| (stress[(0, upper, i)] - stress[(0, upper + 1, i)]).abs());
        assert!(
            jump.fold(0.0, f64::max) > 1e-3,
            "s_xx jumps where moduli do"
        );
    }
    println!("s_zz, s_xz, s_yz across interfaces: {worst:.1e} of the traction");
}

/// Derivatives by central differences of two steps: the remainder falls as h^2, and Richardson's
/// combination of both leaves h^4.
#[test]
fn stress_obeys_hooke_and_equilibrium() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let points = Points::new(&body, Side::Body2, &grid, &[states(&q)]).unwrap();
    let lame = |layer: usize| {
        let m = body
            .coatings
            .get(layer)
            .map_or(body.substrate, |c| c.material);
        (2.0 * m.G() * m.nu / (1.0 - 2.0 * m.nu), m.G())
    };
    // Shallow and deep in the coating, in the second layer, in the substrate.
    for (z, layer) in [(4.0, 0), (8.8, 0), (10.7, 1), (15.0, 2)] {
        let at = [0.37, -1.12, z];
        let moved = |axis: usize, by: f64| {
            let mut p = at;
            p[axis] += by;
            (p[0], p[1], Depth { z: p[2], layer })
        };
        let slopes = |h: f64| {
            let places: Vec<_> = (0..3)
                .flat_map(|axis| [moved(axis, h), moved(axis, -h)])
                .collect();
            let s = points.stress(&places).unwrap().remove(0);
            let u = points.displacement(&places).unwrap().remove(0);
            let ds: [[f64; 6]; 3] = std::array::from_fn(|a| {
                std::array::from_fn(|c| (s[2 * a][c] - s[2 * a + 1][c]) / (2.0 * h))
            });
            let du: [[f64; 3]; 3] = std::array::from_fn(|a| {
                std::array::from_fn(|c| (u[2 * a][c] - u[2 * a + 1][c]) / (2.0 * h))
            });
            (ds, du)
        };
        let s = points
            .stress(&[(at[0], at[1], Depth { z, layer })])
            .unwrap()[0][0];
        let (lambda, G) = lame(layer);
        let errors = |h: f64| {
            let (ds, du) = slopes(h);
            let divergence = [
                ds[0][0] + ds[1][3] + ds[2][4],
                ds[0][3] + ds[1][1] + ds[2][5],
                ds[0][4] + ds[1][5] + ds[2][2],
            ];
            let volume = du[0][0] + du[1][1] + du[2][2];
            let hooke = [
                lambda * volume + 2.0 * G * du[0][0] - s[0],
                lambda * volume + 2.0 * G * du[1][1] - s[1],
                lambda * volume + 2.0 * G * du[2][2] - s[2],
                G * (du[0][1] + du[1][0]) - s[3],
                G * (du[0][2] + du[2][0]) - s[4],
                G * (du[1][2] + du[2][1]) - s[5],
            ];
            [divergence.to_vec(), hooke.to_vec()].concat()
        };
        let (coarse, fine) = (errors(0.2), errors(0.1));
        let largest = |e: &[f64]| e.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let ratio = largest(&coarse) / largest(&fine);
        println!("equilibrium and Hooke at z = {z}: with h halved the error falls by {ratio:.3}");
        assert!(
            (ratio - 4.0).abs() < 0.2,
            "z = {z}: falls by {ratio} with h halved"
        );
        let rest: Vec<f64> = coarse
            .iter()
            .zip(&fine)
            .map(|(c, f)| (4.0 * f - c) / 3.0)
            .collect();
        assert!(largest(&rest) < 1e-5, "z = {z}: {rest:?}");
    }
}

/// Stress below a sliding sphere, a = p_H = 1, on the plane y = 0 at the depths z.
fn sliding_sphere(n: usize, mu: f64, z: &[f64]) -> (Grid, Vec<Depth>, Array3<f64>) {
    let body = Body::homogeneous(Elastic::new(1.0, NU).unwrap(), Shape::Flat);
    let grid = Grid::centred(2.4, n).unwrap();
    let p = grid.map(|x, y| (1.0 - x * x - y * y).max(0.0).sqrt());
    let q_x = p.mapv(|p| mu * p);
    let state = Tractions {
        q_x: q_x.as_slice(),
        q_y: None,
        p: p.as_slice(),
    };
    let depths = depths(&body, z).unwrap();
    let section = Section::new(&body, Side::Body2, &grid, Line::AlongX(0.0), &[state]).unwrap();
    let stress = section.stress(&depths).unwrap().remove(0);
    (grid, depths, stress)
}

const NU: f64 = 0.3;

/// Largest error over p_H of the stress below a sliding sphere on the plane y = 0, from a depth on,
/// and farther than a twentieth from the rim at any depth below the surface.
fn hamilton_errors(n: usize) -> (f64, f64) {
    let mu = 0.3;
    // The depths of figure 13 of the paper, and some nearer to the surface.
    let z: Vec<f64> = (1..256)
        .map(|i| 2.0 * f64::from(i) / 255.0)
        .chain([1e-3, 2e-3, 4e-3])
        .collect();
    let (grid, depths, stress) = sliding_sphere(n, mu, &z);
    let closed = HertzStress { a: 1.0, nu: NU };
    let (mut below, mut beside): (f64, f64) = (0.0, 0.0);
    for (k, depth) in depths.iter().enumerate() {
        for i in 0..n {
            let x = grid.x(i);
            let exact = closed.sliding(1.0, mu, (x, 0.0, depth.z));
            for c in 0..6 {
                let error = (stress[(c, k, i)] - exact[c]).abs();
                if depth.z > 1.0 / 64.0 {
                    below = below.max(error);
                }
                if (x.abs() - 1.0).abs() > 0.05 {
                    beside = beside.max(error);
                }
            }
        }
    }
    (below, beside)
}

#[test]
fn sliding_sphere_converges_to_hamilton() {
    let [coarse, middle, fine] = [64, 128, 256].map(hamilton_errors);
    println!("Hamilton, 64 to 256 cells: {coarse:?} {middle:?} {fine:?}");
    assert!(fine.0 < 5e-3 && fine.1 < 5e-3, "{fine:?}");
    // Sampled at the middles of cells, the square-root rim leaves the power 3/2.
    assert!(
        middle.0 < 0.5 * coarse.0 && fine.0 < 0.5 * middle.0,
        "{coarse:?} {middle:?} {fine:?}"
    );
    assert!(
        middle.1 < 0.5 * coarse.1 && fine.1 < 0.5 * middle.1,
        "{coarse:?} {middle:?} {fine:?}"
    );
}

/// Tension at the trailing edge, where the samples are off by the square root of the cell.
#[test]
fn trailing_edge_tension_is_known_from_the_samples_beside_it() {
    let tolerances = [
        (0.1, [5e-3, 5e-3, 5e-3]),
        (0.3, [0.02, 0.01, 0.01]),
        (0.8, [0.06, 0.03, 0.03]),
    ];
    for (mu, tolerances) in tolerances {
        // u_x of the Hertz-shaped shear, differentiated, and Hertz at r = a.
        let exact = (1.0 - 2.0 * NU) / 3.0 + std::f64::consts::PI * mu * (4.0 + NU) / 8.0;
        let errors = [128, 256, 384].map(|n| {
            let (grid, _, stress) = sliding_sphere(n, mu, &[0.0]);
            let x: Vec<f64> = (0..n).map(|i| grid.x(i)).collect();
            let surface = stress.index_axis(Axis(1), 0);
            let [trailing, leading] = rims(&surface, &x)[..] else {
                panic!("two rims");
            };
            assert!((trailing.place + 1.0).abs() < 0.3 * grid.dx);
            assert!((leading.place - 1.0).abs() < 0.3 * grid.dx);
            let sampled = surface.row(0).fold(0.0, |m: f64, s| m.max(*s));
            assert!(sampled < exact - 5e-3, "mu = {mu}, {n}: {sampled}");
            trailing.stress[0] - exact
        });
        println!("tension at the trailing edge, mu = {mu}, 128 to 384 cells: {errors:?}");
        for (error, tolerance) in errors.iter().zip(tolerances) {
            assert!(error.abs() < tolerance, "mu = {mu}: {errors:?}");
        }
    }
    // Twenty cells are not enough to tell.
    let (grid, _, stress) = sliding_sphere(24, 0.3, &[0.0]);
    let x: Vec<f64> = (0..24).map(|i| grid.x(i)).collect();
    assert_eq!(rims(&stress.index_axis(Axis(1), 0), &x), []);
}

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
