//! Cells that come back to the limit of friction and do not slip: a cylinder on a flat that is
//! pulled in phase with its shear.

use std::sync::Arc;

use contact_core::Scene;
use contact_core::estimate::choose_increments;
use contact_core::march::{March, Status};
use contact_core::scene::{Body, Coating, Elastic, Friction, Grid, LoadPath, Settings, Shape};
use contact_reference::line_contact;

const TITANIUM: Elastic = Elastic { E: 116e9, nu: 0.33 };
const R: f64 = 0.05;
/// Force on a metre of width \[N\].
const P: f64 = 4e5;
const MU: f64 = 0.6;

/// Two cycles of Q = +-0.6 mu P with a bulk stress between 0 and 350 MPa, on `n` cells.
fn rig(n: usize, extent: f64, coatings: Vec<Coating>) -> Scene {
    let E_star = 0.5 * TITANIUM.E / (1.0 - TITANIUM.nu * TITANIUM.nu);
    let a = line_contact(R, E_star, P).a;
    let mut path = LoadPath::start().normal(P, None);
    for sign in [1.0, -1.0, 1.0, -1.0, 1.0] {
        path = path.change_to(
            |to| (to.T_x, to.sigma_B) = (sign * 0.6 * MU * P, 175e6 * (1.0 + sign)),
            None,
        );
    }
    let mut lower = Body::homogeneous(TITANIUM, Shape::Flat);
    lower.coatings = coatings;
    let round = Shape::Cylinder {
        R,
        length: f64::INFINITY,
        angle: 0.0,
    };
    Scene {
        title: "rig".into(),
        body1: Body::homogeneous(TITANIUM, round),
        body2: lower,
        friction: Friction::coulomb(MU),
        grid: Grid::strip(extent * a, n, 1.0).expect("a grid"),
        path,
        settings: Settings::default(),
    }
}

/// Stick ratios at the ends of the second cycle, and those of the masks.
fn stick(scene: &Scene) -> Vec<[f64; 2]> {
    let chosen = choose_increments(scene, &Arc::default()).expect("increments");
    let mut march = March::new(&chosen).expect("a scene");
    let mut ratios = Vec::new();
    while let Some(increment) = march.advance() {
        let increment = increment.expect("a solution");
        if increment.point.ends_branch && increment.point.branch >= 3 {
            assert_eq!(increment.status, Status::PartialSlip);
            let fields = march.fields();
            let count =
                |mask: &ndarray::Array2<bool>| mask.iter().filter(|&&yes| yes).count() as f64;
            ratios.push([
                increment.stick_ratio(),
                count(&fields.stick) / count(&fields.contact),
            ]);
        }
    }
    ratios
}

/// A cycle comes back to the shear that the one before has left: cells at the limit that do not
/// slip count as sticking on every grid. The border lies within a cell or so; bare 0.6325 is that
/// of an independent solution.
#[test]
fn the_stick_ratio_of_a_steady_cycle_is_that_of_every_grid() {
    let tin = Elastic { E: 450e9, nu: 0.25 };
    for n in [64, 128, 129, 256, 400] {
        for extent in [2.6, 3.1] {
            let coating = vec![Coating {
                material: tin,
                thickness: 4e-6,
            }];
            let cell = 0.5 * extent / n as f64;
            let kinds = [(0.6325, 1.3, Vec::new()), (0.6190, 2.0, coating)];
            for (right, cells, coatings) in kinds {
                for [ratio, mask] in stick(&rig(n, extent, coatings)) {
                    let allowed = cells * cell;
                    assert!(
                        (ratio - right).abs() < allowed,
                        "{n} on {extent} a: {ratio} of {right}"
                    );
                    assert!(
                        (mask - right).abs() < 1.5 * allowed,
                        "{n} on {extent} a: mask {mask}"
                    );
                }
            }
        }
    }
}
