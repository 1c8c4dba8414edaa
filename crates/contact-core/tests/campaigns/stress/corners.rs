//! Corners of the space of scenes, each by its name.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::march::{Increment, March, Status};
use contact_core::{Error, Scene};
use contact_reference::coupled_indentation;
use ndarray::Array2;

use super::campaign::{End, audited};

const PLAIN: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 32, extent = { a_H = 2.6 } }
path = [
    { W = 1000.0, increments = 8, spacing = "equal_radius" },
    { T_x = { mu_W = 0.9 }, increments = 6 },
    { T_x = { mu_W = -0.9 }, increments = 6 },
]
"#;

fn read(text: &str, settings: &[&str]) -> Result<Scene, Error> {
    let settings: Vec<_> = settings.iter().map(|&s| s.to_owned()).collect();
    Scene::from_toml_str(text, "corner.toml", &settings)
}

fn plain(settings: &[&str]) -> Scene {
    read(PLAIN, settings).unwrap()
}

/// Solves, and audits every increment.
#[track_caller]
fn sound(scene: &Scene) -> End {
    let (end, violations) = match audited(scene, &Arc::<AtomicBool>::default()) {
        Ok(solved) => solved,
        Err(error) => panic!("{error}"),
    };
    assert!(violations.hold(), "{violations:?}");
    end
}

fn last(end: &End) -> &Increment {
    end.increments.last().unwrap()
}

/// nu = 0 on a rigid plane: Dundurs' beta = 1/2, its largest value. From nearly no stick to nearly
/// no slip.
#[test]
fn strong_coupling() {
    let mut stuck = 0.0;
    for mu in ["0.05", "0.1", "0.2", "0.3", "0.5", "0.7", "1.0"] {
        let friction = format!("friction.mu={mu}");
        let scene = plain(&[&friction, "body1.nu=0.0", "body2.E=rigid", "body2.nu=0.0"]);
        let end = sound(&scene);
        let indented = &end.increments[7];
        let ratio = (indented.stick_area / indented.contact_area).sqrt();
        let truth = coupled_indentation(0.5, mu.parse().unwrap()).stick_ratio;
        // The rim of the stick zone is known to half a cell, of 12 in a radius, and the shear of a
        // cell to the increment that it came in, one of 8.
        let known = 0.5 / 12.3 + 0.5 / 8.0;
        assert!((ratio - truth).abs() < known, "mu = {mu}: {ratio} {truth}");
        assert!(ratio >= stuck, "mu = {mu}: {ratio} after {stuck}");
        stuck = ratio;
    }
}

#[test]
fn incompressible_and_nearly_rigid_coatings() {
    for (E, nu, thickness) in [
        ("0.01", "0.4999", "0.1"),
        ("0.01", "0.4999999", "0.1"),
        ("0.001", "0.4999", "1.0"),
        ("1.0", "-0.99", "0.3"),
        ("1e3", "0.3", "0.01"),
        ("1e3", "0.3", "1.0"),
        ("1e6", "0.3", "0.1"),
    ] {
        let coating = format!(
            "body2.coatings=[{{E = {{ E_substrate = {E} }}, nu = {nu}, thickness = {{ a_H = {thickness} }}}}]"
        );
        // A soft layer widens the contact, a stiff plate more.
        let scene = plain(&[&coating, "grid.extent.a_H=26.0", "grid.n=64"]);
        let end = sound(&scene);
        assert_eq!(end.increments.len(), 20, "{coating}");
    }
}

/// A coating of a hundredth of a cell and less leaves the body as it is, as far as its compliance
/// goes: thickness over contact radius times the ratio of the moduli.
#[test]
fn coating_much_thinner_than_a_cell() {
    let bare = sound(&plain(&["skip.coupling=false"]));
    for (ratio, thickness) in [(1e-2, 1e-5), (1e2, 1e-5), (1e3, 1e-9), (1e-3, 1e-9)] {
        let coating = format!(
            "body2.coatings=[{{E = {{ E_substrate = {ratio:?} }}, nu = 0.3, thickness = {{ a_H = {thickness:?} }}}}]"
        );
        let end = sound(&plain(&[&coating]));
        let compliance = thickness * f64::max(ratio, 1.0 / ratio);
        for (with, without) in end.increments.iter().zip(&bare.increments) {
            let off = with.p_max / without.p_max - 1.0;
            // p_max of a cell is known to the tolerance times the wave number of the cells.
            let known = 10.0 * compliance + 1e-4;
            assert!(off.abs() < known, "{ratio} {thickness}: {off:e} {known:e}");
        }
    }
}

/// The nearer to sliding, the less stick and the more shift. The slip has a part across the force,
/// since shear along x moves the surface along y too; while the bodies slide on, its share falls,
/// and only in the limit do all cells pull alike: the shift that carries the last part of the force
/// grows without bound, like the inverse root of that part. At the limit itself it is the incipient
/// one.
#[test]
fn force_at_the_verge_of_sliding() {
    for body2 in ["body2.E=210e9", "body2.E=70e9"] {
        let at = |below: f64| {
            let force = format!("path.1.T_x.mu_W={:?}", 1.0 - below);
            let settings = [body2, &force, "path.2.T_x.mu_W=-0.5", "grid.extent.a_H=3.0"];
            sound(&plain(&settings)).increments[13]
        };
        let verge = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10].map(at);
        for (nearer, before) in verge[1..].iter().zip(&verge) {
            assert!(nearer.stick_area <= before.stick_area);
            assert!(nearer.motion.delta_x > before.motion.delta_x);
        }
        // A hundredth of the part that is left, ten times the shift.
        let growth = verge[4].motion.delta_x / verge[3].motion.delta_x;
        assert!((growth / 10.0 - 1.0).abs() < 0.05, "{growth}");
        for full in [1e-12, 1e-15, 0.0].map(at) {
            assert_eq!(full.status, Status::GrossSlip);
            let (incipient, before) = (full.motion.delta_x, verge[0].motion.delta_x);
            assert!(incipient > before && incipient < 1.1 * before);
        }
    }
}

#[test]
fn reversal_at_every_increment() {
    let mut branches = vec!["{ W = 1000.0, increments = 1 }".to_owned()];
    for n in 0..24 {
        let sign = if n % 2 == 0 { 1.0 } else { -1.0 };
        let part = sign * (0.95 - 0.03 * f64::from(n));
        branches.push(format!("{{ T_x = {{ mu_W = {part} }}, increments = 1 }}"));
    }
    for body2 in ["body2.E=210e9", "body2.E=70e9"] {
        let path = format!("path=[{}]", branches.join(", "));
        let end = sound(&plain(&[&path, body2]));
        let mut work = 0.0;
        for i in &end.increments {
            work += i.energy.work.abs();
            let dissipated = i.energy.dissipated;
            // Nothing is dissipated but what slips, each against its shear.
            assert!(
                dissipated > -1e-6 * work,
                "{}: {dissipated:e} of {work:e}",
                i.index
            );
        }
    }
}

/// Everything at once, from bodies that do not touch.
#[test]
fn first_increment_from_nothing() {
    let whole = r"path=[{ W = 1000.0, T_x = { mu_W = 0.9 }, T_y = -100.0, increments = 1 }]";
    for more in ["body2.E=210e9", "body2.E=1e9", "body2.E=70e9"] {
        let end = sound(&plain(&[whole, more]));
        assert!(last(&end).contact_area > 0.0);
    }
    // Or from next to nothing.
    let crept = r"path=[{ W = 1e-9, increments = 1 }, { W = 1000.0, increments = 1 }]";
    let end = sound(&plain(&[crept]));
    assert!(end.increments[0].contact_area > 0.0);
}

/// The error says how large the grid should be, and on a grid as large as that the scene is solved.
#[test]
fn edge_touching_contact() {
    let soft = "body2.coatings=[{E = { E_substrate = 0.01 }, nu = 0.3, thickness = { a_H = 2.0 }}]";
    let ellipse = "body1.shape={ellipsoid = {R_x = 0.018, R_y = 0.3}}";
    for more in ["friction.mu=0.3", soft, ellipse] {
        let small = plain(&[more, "grid.extent.a_H=1.2"]);
        let error = audited(&small, &Arc::default()).map(|_| ()).unwrap_err();
        let text = error.to_string();
        let Error::OffGrid { needed, .. } = error else {
            panic!("{text}");
        };
        assert!(text.contains("should be about"), "{text}");
        let extent = format!("grid.extent={needed:?}");
        let end = sound(&plain(&[more, &extent]));
        // Not much too large either.
        let fields = &end.fields;
        let widest = fields
            .contact
            .outer_iter()
            .filter(|row| row.iter().any(|c| *c))
            .count();
        let longest = fields
            .contact
            .columns()
            .into_iter()
            .filter(|c| c.iter().any(|c| *c))
            .count();
        assert!(
            widest.max(longest) >= 16,
            "{more}: {widest} x {longest} of 32 cells"
        );
    }
}

/// Spots: cells in contact, connected by their sides.
fn spots(contact: &Array2<bool>) -> usize {
    let mut left = contact.clone();
    let mut count = 0;
    while let Some(start) = left.indexed_iter().find(|(_, c)| **c).map(|(at, _)| at) {
        count += 1;
        let mut front = vec![start];
        while let Some((i, j)) = front.pop() {
            if left.get((i, j)) != Some(&true) {
                continue;
            }
            left[(i, j)] = false;
            front.extend([
                (i + 1, j),
                (i.wrapping_sub(1), j),
                (i, j + 1),
                (i, j.wrapping_sub(1)),
            ]);
        }
    }
    count
}

#[test]
fn rough_surface_with_hundreds_of_spots() {
    let shape = "body1.shape={sphere = {R = 0.018}, rough = {rms = 1e-6, hurst = 0.8, longest = 6e-5, shortest = 2.8e-5, seed = 3}}";
    for body2 in ["body2.E=210e9", "body2.E=70e9"] {
        let scene = plain(&[
            shape,
            body2,
            "grid.n=128",
            "grid.extent.a_H=2.8",
            "path.0.increments=3",
            "path.1.increments=3",
            "path.2.increments=2",
        ]);
        let end = sound(&scene);
        let spots = spots(&end.fields.contact);
        assert!(spots > 100, "{spots} spots");
    }
}

#[test]
fn contact_of_one_cell() {
    // One cell takes up to about 1.5 times the load at which a contact is as wide as a cell.
    for body2 in ["body2.E=210e9", "body2.E=70e9"] {
        let scene = plain(&["grid.n=9", "grid.extent.a_H=40.0", body2]);
        let end = sound(&scene);
        assert!(end.fields.contact.iter().filter(|c| **c).count() == 1);
        let stuck = &end.increments[13];
        assert_eq!(stuck.status, Status::FullStick);
    }
    // And so has a grid of one cell: its cell lies at the border.
    let error = read(PLAIN, &["grid.n=1"]).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("border of the grid"), "{error}");
}

#[test]
fn zero_load() {
    let path = "path=[{ W = 0.0, increments = 2 }, { W = 1000.0, increments = 2 }, { W = 0.0, increments = 2 }, { W = 500.0, increments = 1 }]";
    let end = sound(&plain(&[path]));
    let status: Vec<_> = end.increments.iter().map(|i| i.status).collect();
    assert_eq!(status[..2], [Status::NoContact; 2]);
    assert_eq!(status[5], Status::NoContact);
    assert!(last(&end).contact_area > 0.0);
    let nothing = "path=[{ W = 0.0, increments = 3 }]";
    let scene = read(&PLAIN.replace("{ a_H = 2.6 }", "0.001"), &[nothing]).unwrap();
    let mut march = March::new(&scene).unwrap();
    while let Some(increment) = march.advance() {
        let increment = increment.unwrap();
        assert_eq!(increment.status, Status::NoContact);
        assert!(increment.residuals.gap.abs() <= 0.0 && increment.stick_ratio().is_nan());
    }
    assert!(march.fields().p.iter().all(|p| *p == 0.0));
}

/// Numbers at the ends of the range of a double: solved, or refused by name.
#[test]
fn denormals_and_giants() {
    let refused = |settings: &[&str], key: &str| {
        let error = match read(PLAIN, settings) {
            Ok(scene) => March::new(&scene).map(|_| ()).unwrap_err(),
            Err(error) => error,
        };
        assert!(error.to_string().contains(key), "{error}");
    };
    let path = "path=[{ W = 5e-324, increments = 2 }]";
    refused(&[path, "grid.extent=1e-3"], "path[0].W");
    refused(&["body2.E=1e-310"], "body2.E");
    refused(&["body1.E=1e300", "body2.E=1e300"], "E = 1e300");
    refused(&["grid.extent.a_H=1e-310"], "grid.d");
    refused(&["grid.extent=1e-310"], "grid.d");
    refused(
        &["body1.shape.sphere.R=1e-310", "grid.extent=1e-3"],
        "sphere.R",
    );
    refused(
        &["body2.coatings=[{E = 1e11, nu = 0.3, thickness = 5e-324}]"],
        "body2.coatings[0].thickness",
    );
    // A force that is nothing beside the others does no harm.
    let end = sound(&plain(&["path.1.T_x=5e-324", "path.2.T_y=1e-310"]));
    assert!(end.increments[13].motion.delta_x.abs() < 1e-15);
    sound(&plain(&["friction.mu=1e-12"]));
    // Units of another world, well within the range.
    sound(&plain(&[
        "body1.E=2e-29",
        "body2.E=2e-29",
        "path.0.W=1e-37",
    ]));
}

#[test]
fn height_map_of_nothing_but_nan() {
    let refused = |text: &str| {
        let shape = format!("body1.shape={text}");
        let error = read(PLAIN, &[&shape, "grid.extent=1e-3"])
            .map(|_| ())
            .unwrap_err();
        let text = error.to_string();
        assert!(text.contains("height_map"), "{text}");
        let named = ["nan", "NaN", "no number"];
        assert!(named.iter().any(|name| text.contains(name)), "{text}");
    };
    refused("{height_map = {spacing = 1e-3, z = [[nan, nan], [nan, nan]]}}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("z.npy");
    ndarray_npy::write_npy(&file, &Array2::from_elem((8, 8), f64::NAN)).unwrap();
    let scene = PLAIN.replace(
        "shape.sphere.R = 0.018",
        "shape.height_map = { spacing = 1e-3, file = \"z.npy\" }",
    );
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, scene.replace("{ a_H = 2.6 }", "1e-3")).unwrap();
    let error = Scene::from_file(&path, &[]).map(|_| ()).unwrap_err();
    assert!(
        error.to_string().contains("z.npy: holds no number"),
        "{error}"
    );
}
