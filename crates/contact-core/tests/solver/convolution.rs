//! Ladder of truth, second rung: the fast operator against the direct sum, on grids even, odd,
//! prime and elongated, whole and halved by symmetry, with any part of the tractions.

use contact_core::convolution::{
    ApproximateInverse, CirculantInverse, DcFft, Direct, Displacements, SurfaceOperator, Tractions,
};
use contact_core::kernels::InfluenceCoefficients;
use contact_core::plan::{Mirror, Parity};
use ndarray::Array2;

/// A reproducible sequence in (-1, 1).
fn noise(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// Coefficients of the right parities with no other structure.
fn coefficients(nx: usize, ny: usize) -> InfluenceCoefficients {
    let mut random = noise(7);
    let mut quadrant = |odd: (bool, bool)| {
        Array2::from_shape_fn((nx, ny), |(i, j)| {
            let vanishes = (odd.0 && i == 0) || (odd.1 && j == 0);
            let value = random() / (1.0 + i as f64 + j as f64);
            if vanishes { 0.0 } else { value }
        })
    };
    InfluenceCoefficients {
        xx: quadrant((false, false)),
        yy: quadrant((false, false)),
        zz: quadrant((false, false)),
        xy: quadrant((true, true)),
        xz: quadrant((true, false)),
        yz: quadrant((false, true)),
    }
}

fn apply(op: &mut dyn SurfaceOperator, q: &[Vec<f64>; 3], given: [bool; 3]) -> [Vec<f64>; 3] {
    let (nx, ny) = op.shape();
    let mut u: [Vec<f64>; 3] = std::array::from_fn(|_| vec![0.0; nx * ny]);
    let [u_x, u_y, u_z] = &mut u;
    let pick = |c: usize| given[c].then_some(&q[c][..]);
    op.apply(
        Tractions {
            q_x: pick(0),
            q_y: pick(1),
            p: pick(2),
        },
        Displacements {
            u_x: Some(u_x),
            u_y: Some(u_y),
            u_z: Some(u_z),
        },
    );
    u
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .fold(0.0, |m, (a, b)| f64::max(m, (a - b).abs()))
}

/// Rounding of transforms of length 200 on data of order one.
const ROUNDING: f64 = 2e-13;

#[test]
fn dc_fft_equals_the_direct_sum() {
    for (nx, ny) in [
        (8, 8),
        (7, 7),
        (13, 8),
        (16, 5),
        (1, 9),
        (9, 1),
        (23, 17),
        (12, 48),
    ] {
        let c = coefficients(nx, ny);
        let mut random = noise(3);
        let q: [Vec<f64>; 3] = std::array::from_fn(|_| (0..nx * ny).map(|_| random()).collect());
        let mut direct = Direct::new(c.clone());
        let mut fast = DcFft::new(&c, Mirror::None, true);
        for given in [
            [true, true, true],
            [false, false, true],
            [true, true, false],
            [true, false, false],
        ] {
            let (truth, found) = (apply(&mut direct, &q, given), apply(&mut fast, &q, given));
            for (t, f) in truth.iter().zip(&found) {
                let error = largest_difference(t, f);
                assert!(error < ROUNDING, "{nx} x {ny}, {given:?}: {error:e}");
            }
        }
    }
}

#[test]
fn the_mirrored_half_equals_the_whole() {
    let halves = [Parity::Even, Parity::Odd, Parity::Even];
    for (nx, ny) in [(8, 8), (9, 6), (20, 2), (5, 14), (31, 50), (80, 96)] {
        let c = coefficients(nx, ny);
        let mut random = noise(5);
        let half: [Vec<f64>; 3] =
            std::array::from_fn(|_| (0..nx * ny / 2).map(|_| random()).collect());
        let whole: [Vec<f64>; 3] = std::array::from_fn(|k| {
            Mirror::Y
                .unfold(&half[k], nx, ny, halves[k])
                .into_raw_vec_and_offset()
                .0
        });
        let truth = apply(&mut DcFft::new(&c, Mirror::None, true), &whole, [true; 3]);
        let found = apply(&mut DcFft::new(&c, Mirror::Y, true), &half, [true; 3]);
        for k in 0..3 {
            let truth = Array2::from_shape_vec((nx, ny), truth[k].clone()).unwrap();
            let error = largest_difference(&Mirror::Y.fold(&truth), &found[k]);
            assert!(error < ROUNDING, "{nx} x {ny}, component {k}: {error:e}");
        }
    }
}

/// Nothing pads the rows of the inverse: an odd number of them fills its whole length.
#[test]
fn the_mirrored_inverse_equals_the_whole() {
    let halves = [Parity::Even, Parity::Odd];
    for (nx, ny) in [(16, 16), (9, 18), (12, 54), (23, 20)] {
        let c = coefficients(nx, ny);
        let mut random = noise(9);
        let half: [Vec<f64>; 2] =
            std::array::from_fn(|_| (0..nx * ny / 2).map(|_| random()).collect());
        let whole: [Vec<f64>; 2] = std::array::from_fn(|k| {
            let whole = Mirror::Y.unfold(&half[k], nx, ny, halves[k]);
            whole.into_raw_vec_and_offset().0
        });
        let inverse = |mirror: Mirror, r: &[Vec<f64>; 2]| {
            let mut z = r.clone();
            let [z_x, z_y] = &mut z;
            CirculantInverse::new(&c, mirror, false).tangential([&r[0], &r[1]], [z_x, z_y]);
            z
        };
        let (truth, found) = (inverse(Mirror::None, &whole), inverse(Mirror::Y, &half));
        for k in 0..2 {
            let largest = truth[k].iter().fold(0.0, |m: f64, z| m.max(z.abs()));
            let truth = Array2::from_shape_vec((nx, ny), truth[k].clone()).unwrap();
            let error = largest_difference(&Mirror::Y.fold(&truth), &found[k]) / largest;
            assert!(error < ROUNDING, "{nx} x {ny}, component {k}: {error:e}");
        }
    }
}

/// Single precision keeps seven digits of the largest displacement at any magnitude of the
/// tractions.
#[test]
fn single_precision_keeps_its_digits_at_any_magnitude() {
    for (nx, ny) in [(8, 8), (23, 18), (64, 96)] {
        let c = coefficients(nx, ny);
        for mirror in [Mirror::None, Mirror::Y] {
            let cells = nx * mirror.rows(ny);
            let mut op = DcFft::with_single(&c, mirror, true, true);
            for magnitude in [1e-60, 1.0, 1e9, 1e60] {
                let mut random = noise(11);
                let mut field =
                    || -> Vec<f64> { (0..cells).map(|_| magnitude * random()).collect() };
                let q = [field(), field(), field()];
                let given = || Tractions {
                    q_x: Some(&q[0]),
                    q_y: Some(&q[1]),
                    p: Some(&q[2]),
                };
                let mut found = [(); 2].map(|()| [(); 3].map(|()| vec![0.0; cells]));
                let wanted = |u: &mut [Vec<f64>; 3], respond: bool, op: &mut DcFft| {
                    let [u_x, u_y, u_z] = u;
                    let wanted = Displacements {
                        u_x: Some(u_x),
                        u_y: Some(u_y),
                        u_z: Some(u_z),
                    };
                    if respond {
                        op.respond(given(), wanted);
                    } else {
                        op.apply(given(), wanted);
                    }
                };
                let [exact, single] = &mut found;
                wanted(exact, false, &mut op);
                wanted(single, true, &mut op);
                let largest = exact.iter().flatten().fold(0.0, |m: f64, u| m.max(u.abs()));
                let squares: f64 = q.iter().flatten().map(|q| q * q).sum();
                let allowed = op.rounding() * squares.sqrt();
                for k in 0..3 {
                    let error = largest_difference(&exact[k], &single[k]) / largest;
                    assert!(error > 0.0 && error < 5e-7, "{nx} x {ny}: {error:e}");
                    assert!(error * largest < allowed);
                }
            }
        }
    }
}
