//! Cracks below a solved line contact against those below its closed form.

#![allow(clippy::unwrap_used)]

use contact_assess::crack::{Cracks, Prepared, over_cycle};
use contact_core::Scene;
use contact_core::convolution::Tractions;
use contact_core::march::March;
use contact_core::scene::{Body, Elastic, Friction, Grid, LoadPath, Settings, Shape};
use contact_reference::{line_contact, mcewen_pressure, mcewen_shear};
use contact_subsurface::{Side, States};
use fracture::{Crack, Path};

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
const MU: f64 = 0.6;
const W: f64 = 2e5;
const R: f64 = 0.05;

/// K of cracks at the rim -a, normal and inclined, after T = share mu W, with its error, against
/// the closed form of partial slip.
fn compare(share: f64, cells: usize) {
    let E_star = STEEL.E / (2.0 * (1.0 - STEEL.nu * STEEL.nu));
    let line = line_contact(R, E_star, W);
    let T = share * MU * W;
    let mut scene = Scene {
        title: "cracks".into(),
        body1: Body::homogeneous(
            STEEL,
            Shape::Cylinder {
                R,
                length: f64::INFINITY,
                angle: 0.0,
            },
        ),
        body2: Body::homogeneous(STEEL, Shape::Flat),
        friction: Friction::coulomb(MU),
        grid: Grid::strip(2.4 * line.a, cells, 1.0).unwrap(),
        path: LoadPath::start().normal(W, 1).tangential(&[T], 1),
        settings: Settings::default(),
    };
    scene.settings.solver.tolerance = Some(1e-9);
    let mut march = March::new(&scene).unwrap();
    while let Some(increment) = march.advance() {
        increment.unwrap();
    }
    let fields = march.fields();
    let slices = [&fields.q_x, &fields.q_y, &fields.p].map(|f| f.as_slice().unwrap());
    let tractions = [Tractions {
        q_x: Some(slices[0]),
        q_y: Some(slices[1]),
        p: Some(slices[2]),
    }];
    let stick = [fields.stick.as_slice().unwrap()];
    let states = States {
        tractions: &tractions,
        stick: Some(&stick),
        ..States::default()
    };
    let c = line.stick_half_width(T, MU);
    for angle in [0.0, 20_f64.to_radians()] {
        let cracks = Cracks {
            x: -line.a,
            angle,
            lengths: [0.05, 0.1, 0.2, 0.5, 1.0].map(|l| l * line.a).to_vec(),
            ..Cracks::default()
        };
        let contact = Prepared::new(&scene.body2, Side::Body2, &scene.grid, &states);
        let found = over_cycle(&contact, &cracks, None).unwrap();
        for (length, found) in cracks.lengths.iter().zip(found) {
            let crack = Crack::new(Path::straight(-line.a, *length, angle)).unwrap();
            let stress: Vec<_> = crack
                .points()
                .iter()
                .map(|p| {
                    let at = (p.x, p.z);
                    let pressure = mcewen_pressure(line.p0, line.a, at);
                    let slip = mcewen_shear(MU * line.p0, line.a, at);
                    let stick = mcewen_shear(MU * line.p0 * c / line.a, c, at);
                    std::array::from_fn(|i| pressure[i] + slip[i] - stick[i])
                })
                .collect();
            let truth = crack.intensity(&stress).unwrap();
            let k = found.linear[0];
            let off = (k.K_I - truth.K_I).hypot(k.K_II - truth.K_II);
            let scale = truth.K_I.hypot(truth.K_II);
            assert!(
                off < 1e-3 * scale,
                "{share} {angle} {length}: {off:e} of {scale:e}"
            );
            assert!(
                off < k.error,
                "{share} {angle} {length}: {off:e}, told {:e}",
                k.error
            );
        }
    }
}

#[test]
fn a_solved_contact_in_partial_slip() {
    compare(0.5, 256);
}

#[test]
fn a_solved_contact_near_full_slip() {
    compare(0.95, 256);
}
