//! Graded coatings as stacks of layers.

use contact_core::kernels::{Graded, Profile, Stack};
use contact_core::scene::{Body, Elastic, Shape};

fn response(E: Profile, layers: usize) -> [f64; 4] {
    let graded = Graded {
        E,
        nu: Profile::Constant(0.3),
        thickness: 1e-5,
        layers,
    };
    let body = Body {
        substrate: Elastic { E: 210e9, nu: 0.3 },
        coatings: graded.coatings().unwrap(),
        bonds: Vec::new(),
        plastic: Vec::new(),
        hardness: f64::INFINITY,
        residual: Vec::new(),
        shape: Shape::Flat,
        bulk: contact_core::scene::Bulk::default(),
    };
    let r = Stack::new(&body).response(2e5);
    [r.zz, r.rr, r.tt, r.rz]
}

fn profiles() -> [Profile; 4] {
    let (top, bottom) = (800e9, 210e9);
    [
        Profile::Linear { top, bottom },
        Profile::Power {
            top,
            bottom,
            exponent: 2.0,
        },
        Profile::Exponential { top, bottom },
        Profile::Table(vec![(0.0, top), (0.25, 500e9), (1.0, bottom)]),
    ]
}

/// Layers with the properties of their middle are a midpoint rule: second order.
#[test]
fn converge_with_the_square_of_the_layers_thickness() {
    for profile in profiles() {
        let fine = response(profile.clone(), 1600);
        let error = |layers| {
            let coarse = response(profile.clone(), layers);
            let differences = coarse
                .iter()
                .zip(fine)
                .map(|(c, f)| (c - f).abs() / fine[0]);
            differences.fold(0.0, f64::max)
        };
        let rate = (error(20) / error(80)).log2() / 2.0;
        assert!((1.9..2.1).contains(&rate), "{profile:?}: {rate}");
    }
}

/// The out-of-plane response of an exponential coating obeys a linear equation with constant
/// coefficients: u'' + c u' - k^2 u = 0 with G = G_0 exp(c z).
#[test]
fn an_exponential_coating_has_its_closed_form() {
    let (h, k) = (1e-5_f64, 2e5_f64);
    let (G_0, G_h) = (800e9 / 2.6, 210e9 / 2.6_f64);
    let c = (G_h / G_0).ln() / h;
    let root = (c * c / 4.0 + k * k).sqrt();
    let (fast, slow) = (-c / 2.0 - root, -c / 2.0 + root);
    // u = exp(fast z) + b exp(slow z) with G u' = -G k u at z = h; u(0)/q = -u/(G_0 u').
    let b = -((fast + k) / (slow + k)) * ((fast - slow) * h).exp();
    let exact = -k * (1.0 + b) / (G_0 * (fast + b * slow));
    let ours = response(profiles()[2].clone(), 400)[2];
    assert!((ours / exact - 1.0).abs() < 1e-5, "{ours:e} {exact:e}");
}

#[test]
fn profiles_pass_through_their_ends() {
    for profile in profiles() {
        assert!((profile.value_at(0.0) / 800e9 - 1.0).abs() < 1e-15);
        assert!((profile.value_at(1.0) / 210e9 - 1.0).abs() < 1e-15);
    }
    assert!((profiles()[3].value_at(0.5) / (500e9 - 290e9 / 3.0) - 1.0).abs() < 1e-15);
}

#[test]
fn nonsense_is_refused() {
    let graded = |E, layers| Graded {
        E,
        nu: Profile::Constant(0.3),
        thickness: 1e-5,
        layers,
    };
    let tables = [vec![(0.0, 1.0)], vec![(0.0, 1.0), (0.5, 2.0)], vec![]];
    let wrong = tables.map(|t| graded(Profile::Table(t), 5));
    for graded in wrong.iter().chain([&graded(Profile::Constant(1e9), 0)]) {
        assert!(graded.coatings().is_err(), "{graded:?}");
    }
    let top_bottom = Profile::Exponential {
        top: 1.0,
        bottom: -1.0,
    };
    let error = graded(top_bottom, 5).coatings().unwrap_err();
    assert!(error.to_string().contains("E.bottom = -1"), "{error}");
}
