//! Cells that are said to stick: full stick that has a solution or none, and displacements after
//! sliding far.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::march::March;
use contact_core::plan::Plan;
use contact_core::{Error, Scene};
use ndarray::Array2;

use super::campaign::audited;

/// Full stick of dissimilar bodies, coated or not.
fn held(bodies: &str, cell: f64, cells: usize, path: &str) -> Scene {
    let text = format!(
        "schema = 1\n{bodies}\nfriction.mu = \"stick\"\ngrid = {{ n = {cells}, spacing = {cell} }}\npath = [{path}]\n"
    );
    Scene::from_toml_str(&text, "held.toml", &[]).unwrap()
}

const SOFT_ON_COATED: &str = r#"
body1 = { shape.sphere.R = 0.01, E = 3.169e9, nu = 0.2236 }
body2 = { shape = "flat", E = 1.1045e11, nu = 0.0, coatings = [
    { E = { E_substrate = 2.8817 }, nu = 0.2449, thickness = 4.051e-5 },
] }
"#;
const SPHERES: &str = r#"
body1 = { shape.sphere.R = 0.01, E = 1.63e10, nu = -0.162 }
body2 = { shape = "flat", E = 4.61e9, nu = 0.0 }
"#;

/// A cell next to one that is out of contact.
fn at_rim(contact: &Array2<bool>, (i, j): (usize, usize)) -> bool {
    let mut around = (i - 1..=i + 1).flat_map(|i| (j - 1..=j + 1).map(move |j| (i, j)));
    around.any(|n| !contact[n])
}

/// Shear as large as the load lifts cells at the rim, which slip; all others are held.
#[test]
fn a_contact_that_sticks_is_lifted_at_its_rim_alone() {
    let path = "{ W = 0.158228, increments = 1 }, { delta_x = 4.5661e-7, increments = 4 }";
    let scene = held(SOFT_ON_COATED, 1.54281e-5, 16, path);
    let mut march = March::new(&scene).unwrap();
    let mut lifted = 0;
    while let Some(increment) = march.advance() {
        increment.unwrap();
        let fields = march.fields();
        for (n, &contact) in fields.contact.indexed_iter() {
            if contact && !fields.stick[n] {
                assert!(at_rim(&fields.contact, n), "{n:?}");
                lifted += 1;
            }
        }
    }
    assert!(lifted > 0, "nothing was lifted");
}

/// A problem without bounds is no harder on one grid than on another: pressing, in one step, and
/// twisting a ball on a stiff coating takes 22 to 28 and 2 to 6 convolutions.
#[test]
fn full_stick_takes_as_much_work_on_any_grid() {
    let bodies = r#"
body1 = { shape.sphere.R = 0.01, E = 2.1e11, nu = 0.3 }
body2 = { shape = "flat", E = 1e11, nu = 0.3, coatings = [{ E = 4.2e11, nu = 0.3, thickness = { a_H = 0.3 } }] }
"#;
    let a = held(bodies, 1e-6, 16, "{ W = 100.0 }").hertz().unwrap().a;
    let path = "{ W = 100.0, increments = 1 }, { M_z = 1e-4, increments = 1 }";
    let work = [240, 250, 256, 258, 264].map(|n| {
        let scene = held(bodies, 2.4 * a / n as f64, n, path);
        let mut plan = Plan::new(&scene);
        plan.methods.growth_steps = 1;
        let mut march = March::planned(&scene, plan, &Arc::default()).unwrap();
        std::iter::from_fn(|| march.advance())
            .map(|increment| increment.unwrap().work.convolutions)
            .sum::<f64>()
    });
    let least = work.into_iter().fold(f64::INFINITY, f64::min);
    assert!(work.iter().all(|w| *w < 1.5 * least), "{work:?}");
}

/// Shifted by ten approaches no contact that sticks everywhere is in equilibrium, and the error
/// says so.
#[test]
fn a_contact_that_cannot_stick_is_refused() {
    for (bodies, cell, cells, path) in [
        (
            SPHERES,
            3.001e-5,
            32,
            "{ W = 12.965, increments = 4 }, { delta_x = 8.168e-5, increments = 4 }",
        ),
        (
            SOFT_ON_COATED,
            1.54281e-5,
            16,
            "{ W = 0.158228, increments = 1 }, { delta_x = 5e-6, increments = 1 }",
        ),
    ] {
        let scene = held(bodies, cell, cells, path);
        let refused = audited(&scene, &Arc::<AtomicBool>::default()).map(|_| ());
        let Err(Error::Lifted {
            contact,
            lifted,
            within,
            ..
        }) = refused
        else {
            panic!("{refused:?}");
        };
        assert!(within > 0 && within <= lifted && lifted <= contact);
    }
}

/// Sliding by many times what shear alone can move a surface goes through large tractions on the
/// way to the solution: displacements are those of the tractions all the same, and the cells that
/// stick after it do not move.
#[test]
fn displacements_are_exact_after_sliding_far() {
    let text = r"
schema = 1
body1 = { shape = { sum = [
    { sphere = { R = 0.01 } },
    { waviness = { amplitude = 5.934467193655404e-09, wavelength = 5.371814945732905e-05, angle = 4.438576220876751, phase = 4.1302186506486205 } },
] }, E = 11538007631.016954, nu = 0.45 }
body2 = { shape = { cylinder = { R = 0.17168899810335053 } }, E = 173991997489.3351, nu = 0.0, coatings = [
    { E = { E_substrate = 0.4097700702123348 }, nu = 0.10396906032738737, thickness = 6.439062756892926e-05 },
] }
friction.mu = 0.3
grid = { n = 20, spacing = 6.486719132312689e-06 }
path = [
    { W = 0.03155135477463118, increments = 1 },
    { T_x = 0.0052499874182967525, increments = 1 },
    { delta_x = -9.599893046120053e-07, increments = 2 },
    { T_x = -0.005394332412133615, increments = 4 },
]
";
    let scene = Scene::from_toml_str(text, "far.toml", &[]).unwrap();
    let (_, violations) = audited(&scene, &Arc::<AtomicBool>::default()).unwrap();
    assert!(violations.hold(), "{violations:?}");
}
