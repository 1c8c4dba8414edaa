//! What influence coefficients must do whatever the stack: limits, symmetries, superposition.

use contact_core::kernels::{InfluenceCoefficients, Quadrant, influence_coefficients};
use contact_core::scene::{Body, Coating, Elastic, Grid, KernelSettings, Shape};

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };

fn body(layers: &[(f64, f64, f64)], substrate: Elastic) -> Body {
    let coating = |&(E, nu, thickness): &(f64, f64, f64)| Coating {
        material: Elastic { E, nu },
        thickness,
    };
    Body {
        substrate,
        coatings: layers.iter().map(coating).collect(),
        bonds: Vec::new(),
        plastic: Vec::new(),
        hardness: f64::INFINITY,
        residual: Vec::new(),
        shape: Shape::Flat,
        bulk: contact_core::scene::Bulk::default(),
    }
}

fn coefficients(body: &Body, grid: &Grid) -> InfluenceCoefficients {
    influence_coefficients(body, grid, &KernelSettings::default(), false, None).unwrap()
}

fn grid(n: (usize, usize), d: (f64, f64)) -> Grid {
    Grid::from_spacing(n, d).unwrap()
}

fn six(c: &InfluenceCoefficients) -> [&Quadrant; 6] {
    [&c.xx, &c.yy, &c.zz, &c.xy, &c.xz, &c.yz]
}

/// Largest difference in units of C33(0,0).
fn difference(a: &InfluenceCoefficients, b: &InfluenceCoefficients) -> f64 {
    let pairs = six(a).into_iter().zip(six(b));
    let largest = pairs.map(|(a, b)| (a - b).fold(0.0, |m: f64, v| m.max(v.abs())));
    largest.fold(0.0, f64::max) / a.zz[(0, 0)]
}

/// Three stacks that have little in common; lengths in m, cells of a micrometre.
fn stacks() -> [Body; 3] {
    [
        body(&[(840e9, 0.25, 0.05e-6)], STEEL),
        body(&[(2.1e9, 0.49, 3e-6), (400e9, 0.1, 0.4e-6)], STEEL),
        body(&[(300e9, 0.0, 40e-6), (90e9, 0.4, 1e-6)], Elastic::RIGID),
    ]
}

#[test]
fn layers_of_the_substrate_change_nothing() {
    for nu in [-0.5, 0.0, 0.3, 0.4999] {
        let material = Elastic { E: 210e9, nu };
        let layers = [(210e9, nu, 0.1e-6), (210e9, nu, 2e-6), (210e9, nu, 50e-6)];
        let grid = grid((40, 30), (1e-6, 1e-6));
        let bare = coefficients(&body(&[], material), &grid);
        let layered = coefficients(&body(&layers, material), &grid);
        assert!(difference(&bare, &layered) < 1e-12);
    }
}

#[test]
fn a_rigid_body_gives_zeros() {
    let c = coefficients(&body(&[], Elastic::RIGID), &grid((8, 8), (1e-6, 1e-6)));
    assert!(six(&c).iter().all(|c| c.iter().all(|v| *v == 0.0)));
}

/// A vanishing layer leaves the substrate, a thick one hides it: both with an error of first
/// order in the ratio of the lengths.
#[test]
fn thin_and_thick_layers_have_their_limits() {
    let grid = grid((24, 24), (1e-6, 1e-6));
    let substrate = coefficients(&body(&[], STEEL), &grid);
    let (E, nu) = (420e9, 0.2);
    let layer = coefficients(&body(&[], Elastic { E, nu }), &grid);
    for ratio in [1e-3, 1e-5, 1e-7] {
        let thin = coefficients(&body(&[(E, nu, ratio * 1e-6)], STEEL), &grid);
        let error = difference(&substrate, &thin);
        assert!(error < 10.0 * ratio, "{ratio}: {error}");
        let thick = coefficients(&body(&[(E, nu, 1e-6 / ratio)], STEEL), &grid);
        let error = difference(&layer, &thick);
        assert!(error < ratio, "{ratio}: {error}");
    }
}

/// Reciprocity C_ij(x) = C_ji(-x) with the symmetry of isotropic layers: exchange of the axes.
#[test]
fn axes_may_be_exchanged() {
    for body in stacks() {
        let c = coefficients(&body, &grid((20, 7), (1e-6, 3e-6)));
        let t = coefficients(&body, &grid((7, 20), (3e-6, 1e-6)));
        let turned = |q: &Quadrant| q.t().to_owned();
        let turned = InfluenceCoefficients {
            xx: turned(&t.yy),
            yy: turned(&t.xx),
            zz: turned(&t.zz),
            xy: turned(&t.xy),
            xz: turned(&t.yz),
            yz: turned(&t.xz),
        };
        assert!(difference(&c, &turned) < 1e-13);
    }
}

/// Whether xx, yy, zz, xy, xz, yz change their sign with x and with y.
const ODD: [(bool, bool); 6] = [
    (false, false),
    (false, false),
    (false, false),
    (true, true),
    (true, false),
    (false, true),
];

/// Uniform traction on a long cell is uniform traction on the square cells it consists of.
#[test]
fn long_cells_are_sums_of_square_ones() {
    let d = 1e-6;
    for body in stacks() {
        for (n, m) in [(1, 21), (5, 1), (3, 7)] {
            let long = coefficients(&body, &grid((4, 4), (n as f64 * d, m as f64 * d)));
            let square = coefficients(&body, &grid((4 * n, 4 * m), (d, d)));
            let sums = six(&square).into_iter().zip(ODD).map(|(q, odd)| {
                Quadrant::from_shape_fn((4, 4), |(i, j)| {
                    let cells = (0..n).flat_map(|a| (0..m).map(move |b| (a, b)));
                    cells
                        .map(|(a, b)| {
                            let x = (i * n + a) as i64 - (n / 2) as i64;
                            let y = (j * m + b) as i64 - (m / 2) as i64;
                            let flips = (odd.0 && x < 0) != (odd.1 && y < 0);
                            let value = q[(x.unsigned_abs() as usize, y.unsigned_abs() as usize)];
                            if flips { -value } else { value }
                        })
                        .sum()
                })
            });
            let scale = long.zz[(0, 0)];
            for (long, sum) in six(&long).into_iter().zip(sums) {
                let error = (long - &sum).fold(0.0, |m: f64, v| m.max(v.abs())) / scale;
                assert!(error < 1e-12, "{n} x {m}: {error:.2e}");
            }
        }
    }
}

/// Far away only the substrate is felt: Boussinesq's and Cerruti's solutions for its material.
/// What the layer changes is smaller by h/r, and for pressure and approach by its square: the
/// term of the response linear in k has no Hankel transform of order 0.
#[test]
fn far_away_is_the_substrate() {
    let grid = grid((600, 2), (1e-6, 1e-6));
    let substrate = coefficients(&body(&[], STEEL), &grid);
    let coated = coefficients(&body(&[(420e9, 0.2, 1e-6)], STEEL), &grid);
    // Twice the ratio: the layer is twice as stiff as the substrate.
    for (name, bare, coated, order) in [
        ("zz", &substrate.zz, &coated.zz, 2),
        ("xx", &substrate.xx, &coated.xx, 1),
        ("yy", &substrate.yy, &coated.yy, 1),
        ("xz", &substrate.xz, &coated.xz, 1),
    ] {
        for i in [20, 50, 100, 200, 400, 599] {
            let error = (coated[(i, 0)] / bare[(i, 0)] - 1.0).abs();
            assert!(
                error < 2.0 * (i as f64).powi(-order),
                "{name} at {i} h: {error:.1e}"
            );
        }
    }
}

/// The sign that a homogeneous body of nu > 0 gives to each coefficient at x, y > 0.
#[test]
fn signs() {
    let c = coefficients(&body(&[], STEEL), &grid((3, 3), (1e-6, 1e-6)));
    let at = (1, 1);
    assert!(c.zz[at] > 0.0 && c.xx[at] > 0.0 && c.yy[at] > 0.0 && c.xy[at] > 0.0);
    assert!(
        c.xz[at] < 0.0 && c.yz[at] < 0.0,
        "pressure draws the surface inwards"
    );
    assert!(
        c.xx[(1, 0)] > c.yy[(1, 0)],
        "a force pushes further ahead than aside"
    );
}

/// A tolerance below rounding cannot be met, and is not claimed to be.
#[test]
fn an_impossible_tolerance_is_refused() {
    let settings = KernelSettings {
        tolerance: 1e-17,
        ..KernelSettings::default()
    };
    let grid = grid((8, 8), (1e-6, 1e-6));
    let error = influence_coefficients(&stacks()[0], &grid, &settings, true, None).unwrap_err();
    assert!(error.to_string().contains("estimated error"), "{error}");
}

/// A layer cut in two is the same body, but not the same computation: other scales, other nodes,
/// other parts of cells. Stacks of any contrast, thin and thick layers, square and long cells.
#[test]
fn a_layer_may_be_cut_in_two() {
    let mut state = 7_u64;
    let mut draw = |from: f64, to: f64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        from + (to - from) * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    for case in 0..40 {
        let count = [1, 1, 2, 3, 8][case % 5];
        let layers: Vec<_> = (0..count)
            .map(|_| {
                let E = 210e9 * 10_f64.powf(draw(-4.0, 4.0));
                (E, draw(-0.9, 0.4999), 1e-6 * 10_f64.powf(draw(-1.3, 3.0)))
            })
            .collect();
        let substrate = Elastic {
            E: 210e9,
            nu: draw(-0.9, 0.4999),
        };
        let long = [1.0, 1.0, 0.05, 20.0][case % 4];
        let shape = if case % 3 == 0 { (900, 3) } else { (24, 24) };
        let grid = grid(shape, (1e-6, long * 1e-6));
        let whole = coefficients(&body(&layers, substrate), &grid);
        let (E, nu, h) = layers[0];
        let mut cut = layers.clone();
        cut[0].2 = h * 0.83;
        cut.insert(0, (E, nu, h * 0.17));
        let error = difference(&whole, &coefficients(&body(&cut, substrate), &grid));
        assert!(error < 1e-12, "case {case}: {error:.1e} with {layers:?}");
    }
}

/// In plane strain the coefficients are those of cells that are long along y, but for the constant
/// that an infinite length leaves open.
#[test]
fn a_strip_is_a_long_cell() {
    let n = 40;
    for body in stacks() {
        let strip = Grid::strip(40e-6, n, 1.0).unwrap();
        let long = grid((n, 1), (1e-6, 1.0));
        let (strip, long) = (coefficients(&body, &strip), coefficients(&body, &long));
        let fall = |q: &Quadrant, i: usize| q[(0, 0)] - q[(i, 0)];
        for i in 1..n {
            for (ours, theirs) in [
                (&strip.xx, &long.xx),
                (&strip.yy, &long.yy),
                (&strip.zz, &long.zz),
            ] {
                let (ours, theirs) = (fall(ours, i), fall(theirs, i));
                assert!((ours / theirs - 1.0).abs() < 1e-8, "{ours:e} {theirs:e}");
            }
            // A finite length L leaves out a part x/L of the pull along x.
            let (ours, theirs) = (strip.xz[(i, 0)], long.xz[(i, 0)]);
            let allowed = 2.0 * i as f64 * 1e-6 * strip.zz[(0, 0)];
            assert!((ours - theirs).abs() < allowed, "{ours:e} {theirs:e}");
        }
    }
}

/// Layers of the substrate's own material change nothing in plane strain either: the k-integral of
/// the remainder against the closed form.
#[test]
fn a_strip_on_layers_of_the_substrate() {
    let bare = body(&[], STEEL);
    let layered = body(&[(210e9, 0.3, 2e-6), (210e9, 0.3, 5e-6)], STEEL);
    // A layer so thick that the strip sees nothing else has the half-space's fall.
    let thick = body(&[(210e9, 0.3, 1.0)], Elastic { E: 70e9, nu: 0.3 });
    let strip = Grid::strip(40e-6, 40, 1.0).unwrap();
    let [bare, layered, thick] = [bare, layered, thick].map(|b| coefficients(&b, &strip));
    assert!(difference(&bare, &layered) < 1e-12);
    let fall = |c: &InfluenceCoefficients| c.zz[(0, 0)] - c.zz[(39, 0)];
    assert!((fall(&thick) / fall(&bare) - 1.0).abs() < 1e-8);
}
