//! All loads, laws of friction and layers at once: what holds for each must hold for all.

use contact_core::scene::{
    Coating, Elastic, Friction, FrictionHistory, History, LoadPath, Missing, Shape, SurfaceMap,
};
use ndarray::Array2;

use crate::bench::{R, W, close, hertz_of, run, sphere_on_flat};

/// Two coated bodies of different materials, a turned and wavy ellipsoid, friction by map, history,
/// direction and state, all six loads or motions and a bulk stress in either body, to and fro until
/// contact is lost. Energies and dissipation per cell are looked at by `run`.
#[test]
fn whatever_is_combined_balances() {
    let upper = Elastic { E: 120e9, nu: 0.15 };
    let lower = Elastic { E: 210e9, nu: 0.4 };
    let start = LoadPath::start().normal(W, 3);
    let mut scene = sphere_on_flat(upper, lower, 0.3, (2.9, 28), start);
    let a = hertz_of(&scene).a;
    scene.body1.shape = Shape::Sum(vec![
        Shape::Ellipsoid {
            R_x: R,
            R_y: 1.5 * R,
            angle: 0.4,
        },
        Shape::Waviness {
            amplitude: 2e-3 * a * a / R,
            wavelength: 0.9 * a,
            angle: 0.2,
            phase: 0.0,
        },
    ]);
    let layer = |E, nu, thickness| Coating {
        material: Elastic { E, nu },
        thickness,
    };
    scene.body1.coatings = vec![layer(300e9, 0.2, 0.2 * a)];
    scene.body2.coatings = vec![layer(400e9, 0.25, 0.1 * a), layer(90e9, 0.35, 0.4 * a)];
    let spacing = 0.1 * a;
    let values = Array2::from_shape_fn((41, 41), |(i, _)| 1.0 + 0.01 * (i as f64 - 20.0));
    scene.friction = Friction {
        mu_y: Some(0.35),
        kinetic: Some(0.25),
        map: Some(SurfaceMap::new(values, (spacing, spacing), Missing::Refuse).unwrap()),
        history: Some(FrictionHistory {
            of: History::Dissipated,
            table: vec![(0.0, 1.0), (100.0, 1.2)],
        }),
        ..Friction::coulomb(0.3)
    };
    scene.path = scene
        .path
        .clone()
        .change_to(
            |to| {
                (to.T_x, to.T_y, to.sigma_B, to.sigma_B1) = (0.1 * W, -0.08 * W, 2e8, -5e7);
                (to.M_x, to.M_y, to.M_z) = (0.05 * W * a, -0.04 * W * a, 0.02 * W * a);
                (to.given.phi_x, to.given.phi_y, to.given.phi_z) = (None, None, None);
            },
            4,
        )
        .change_to(
            |to| {
                (to.T_x, to.T_y, to.sigma_B, to.sigma_B1) = (-0.1 * W, 0.05 * W, -1e8, 5e7);
                (to.W, to.M_z) = (0.8 * W, -0.02 * W * a);
            },
            4,
        )
        .ellipse((0.08 * W, 0.04 * W), 1, 6)
        .change_to(
            |to| {
                (to.given.delta_x, to.given.delta_y) = (Some(3e-6), Some(-1e-6));
                (to.given.phi_z, to.given.delta_z) = (Some(2e-4), Some(0.5 * a * a / R));
            },
            5,
        )
        // Moments held would keep the bodies leaning on each other.
        .change_to(
            |to| {
                (to.given.phi_x, to.given.phi_y) = (Some(0.0), Some(0.0));
                to.given.delta_z = Some(-0.5 * a * a / R);
            },
            4,
        );
    let mut dissipated = 0.0;
    let all = run(&scene, |march, increment| {
        let fields = march.fields();
        let r = increment.residuals;
        assert!(r.balance < 1e-9, "{r:?} at {}", increment.index);
        assert!(r.coulomb < 1e-9, "{r:?} at {}", increment.index);
        let loads = increment.point.loads;
        let area = scene.grid.cell_area();
        close("W", fields.p.sum() * area / W, loads.W / W, 1e-9);
        close("T_y", fields.q_y.sum() * area / W, loads.T_y / W, 1e-9);
        dissipated += increment.energy.dissipated;
    });
    assert!(dissipated > 0.0);
    let last = all.last().expect("an increment");
    assert!(last.p_max == 0.0 && last.point.loads.W == 0.0, "{last:?}");
}
