//! A sliding sphere: Hamilton, and the tension at the trailing edge.

use contact_core::convolution::Tractions;
use contact_core::fields::{Depth, Line, Section, Side, depths, rims};
use contact_core::reference::HertzStress;
use contact_core::scene::{Body, Elastic, Grid, Shape};
use ndarray::{Array3, Axis};

const NU: f64 = 0.3;

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
