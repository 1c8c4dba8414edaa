//! Where nothing carries a load or a shear: surfaces that have parted, cells without friction, and
//! cells at the rim of a contact that never slips.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::march::{Fields, Increment, March, Status};
use contact_core::{Error, Scene};

use super::campaign::audited;

const PRESSED: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.01, E = 210e9, nu = 0.3 }
body2 = { shape = "flat", E = 70e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 32, extent = 6e-4 }
path = [{ W = 100.0, increments = 2 }, { T_x = 8.0, increments = 2 }]
"#;

fn pressed(settings: &[&str]) -> Result<Scene, Error> {
    let settings: Vec<_> = settings.iter().map(|&s| s.to_owned()).collect();
    Scene::from_toml_str(PRESSED, "pressed.toml", &settings)
}

/// Every increment with its fields.
fn solved(scene: &Scene) -> Result<Vec<(Increment, Fields)>, Error> {
    let mut march = March::new(scene)?;
    let mut all = Vec::new();
    while let Some(increment) = march.advance() {
        all.push((increment?, march.fields()));
    }
    Ok(all)
}

/// Bodies that shear has stretched part: nothing is left on their surfaces, and they do not
/// overlap.
#[test]
fn parted_surfaces_carry_nothing() {
    let lifted = "path=[{delta_z=3e-6,increments=3},{delta_z=-1e-6,increments=1}]";
    let cone = "path=[{W=1.0988,increments=1},{delta_z=-3.206e-7,increments=2}]";
    let on_cone = [
        cone,
        "body1={shape.cone.slope=0.01257,E=70e9,nu=0.3}",
        "body2.E=10.7e9",
        "friction.mu=0.6",
        "grid={n=24,spacing=1.746e-5}",
    ];
    let sheared =
        "path=[{W=100.0,increments=2},{T_x=20.0,increments=2},{W=0.0,T_x=0.0,increments=2}]";
    for settings in [&[lifted][..], &on_cone, &[sheared]] {
        let scene = pressed(settings).unwrap();
        let (_, violations) = audited(&scene, &Arc::<AtomicBool>::default()).unwrap();
        assert!(violations.hold(), "{settings:?}: {violations:?}");
        let (last, fields) = solved(&scene).unwrap().pop().unwrap();
        assert_eq!(last.status, Status::NoContact);
        for field in [
            &fields.p,
            &fields.q_x,
            &fields.q_y,
            &fields.u_x,
            &fields.u_z,
        ] {
            let largest = field.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            // What sums of displacements leave where they cancel.
            assert!(
                largest < 1e-3 * scene.tolerance() * scene.reference_approach(),
                "{largest:e}"
            );
        }
    }
}

/// A load whose motion is free and that nothing resists is refused by its name.
#[test]
fn loads_that_nothing_carries_are_refused() {
    let no_map = "friction.map={spacing=6e-4,z=[[0.0,0.0],[0.0,0.0]]}";
    let no_history = r#"friction.history={of="increment",table=[[0.0,0.0]]}"#;
    let parted = "path=[{delta_z=3e-6,increments=2},{delta_z=-1e-6,T_x=10.0,increments=1}]";
    let twisted = "path=[{W=100.0,increments=2},{M_z=1e-3,increments=1}]";
    for (settings, load, motion) in [
        (&[no_map][..], "T_x", "delta_x"),
        (&[no_history], "T_x", "delta_x"),
        (&[parted], "T_x", "delta_x"),
        (&[no_map, twisted], "M_z", "phi_z"),
    ] {
        match solved(&pressed(settings).unwrap()) {
            Err(Error::Unresisted {
                load: l,
                motion: m,
                increment: 3,
                ..
            }) => {
                assert_eq!((l, m), (load, motion));
            }
            other => panic!("{settings:?}: {:?}", other.map(|all| all.len())),
        }
    }
    // Bodies that never touch carry no moment.
    let never = pressed(&["path=[{delta_z=-1e-6,M_y=1e-3,increments=1}]"]).unwrap();
    let refused = solved(&never).unwrap_err().to_string();
    assert!(
        refused.contains("M_y") && refused.contains("do not touch"),
        "{refused}"
    );
    // Without any friction the file says so already.
    let refused = pressed(&["friction.mu=0.0", twisted])
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("M_z") && refused.contains("friction"),
        "{refused}"
    );
}

/// Strips of no friction carry nothing and slip; the others hold as if they bore next to nothing.
#[test]
fn cells_without_friction_slip_freely() {
    let strips = |none: &str| {
        let row = |f: &str| format!("[{}]", [f; 8].join(","));
        let rows = ["1.0", "1.0", none, none, "1.0", none, none, "1.0"].map(row);
        format!("friction.map={{spacing=8e-5,z=[{}]}}", rows.join(","))
    };
    let path = "path=[{W=100.0,increments=2},{T_x=4.0,increments=2}]";
    // With a lower coefficient in motion a cell at the border of stick decides by less than the
    // tolerance.
    for (more, steady) in [
        ("body2.nu=0.3", true),
        ("friction.kinetic=0.2", false),
        ("body2.E=210e9", true),
    ] {
        let scene = pressed(&[path, &strips("0.0"), more]).unwrap();
        let all = solved(&scene).unwrap();
        let nearly = solved(&pressed(&[path, &strips("1e-6"), more]).unwrap()).unwrap();
        // Linear between the strips, which lie across x.
        let strip = |x: f64| {
            let place = (x / 8e-5 + 3.5).clamp(0.0, 7.0);
            let (low, part) = (place.floor(), place.fract());
            let of = |strip: usize| [1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0][strip];
            (1.0 - part) * of(low as usize) + part * of(low as usize + 1)
        };
        let factor = scene.grid.map(|x, _| strip(x));
        let mut free = 0;
        for ((increment, fields), (_, other)) in all.iter().zip(&nearly) {
            for (n, &factor) in factor.indexed_iter() {
                let (p, q) = (fields.p[n], fields.q_x[n].hypot(fields.q_y[n]));
                assert!(q <= 0.3 * factor * p * (1.0 + 1e-9));
                if factor == 0.0 && p > 0.0 {
                    free += 1;
                    assert!(q == 0.0 && !fields.stick[n]);
                }
            }
            let cells = fields
                .p
                .iter()
                .zip(&other.p)
                .chain(fields.q_x.iter().zip(&other.q_x));
            let off = cells.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
            assert!(
                !steady || off < 1e-3 * increment.p_max,
                "{more}: {off:e} of {:e}",
                increment.p_max
            );
        }
        assert!(free > 100, "{free}");
    }
}

/// The approach is where the surfaces touch, wherever they lie, also before anything presses them.
#[test]
fn surfaces_touch_where_they_lie() {
    let path = "path=[{W=0.0,increments=1},{W=50.0,increments=2},{W=0.0,increments=1}]";
    let at_height = |z: &str| {
        let map = format!("body2.shape={{height_map={{spacing=1e-3,z=[[{z},{z}],[{z},{z}]]}}}}");
        pressed(&[path, &map]).unwrap()
    };
    let plain = solved(&at_height("0.0")).unwrap();
    let scene = at_height("1e-3");
    let (_, violations) = audited(&scene, &Arc::<AtomicBool>::default()).unwrap();
    assert!(violations.hold(), "{violations:?}");
    let all = solved(&scene).unwrap();
    for ((one, fields), (other, _)) in all.iter().zip(&plain) {
        let off = one.motion.delta_z + 1e-3 - other.motion.delta_z;
        assert!(
            off.abs() < 1e-5 * scene.reference_approach(),
            "{}: {off:e}",
            one.index
        );
        let off = one.energy.work - other.energy.work;
        assert!(off.abs() < 1e-3 * plain[1].0.energy.work, "{off:e}");
        let lowest = fields.gap.iter().fold(f64::INFINITY, |m, g| m.min(*g));
        assert!(
            lowest.abs() < 1e-5 * scene.reference_approach(),
            "{}: {lowest:e}",
            one.index
        );
    }
}

/// Where a contact never slips, shear may lift cells at its rim: neither stuck nor parted have they
/// a place. They slip; a shift of an approach is solved whole.
#[test]
fn shear_lifts_cells_of_a_contact_that_never_slips() {
    let bodies = [
        "body1={shape.sphere.R=0.01,E=16.3e9,nu=-0.162}",
        "body2={shape=\"flat\",E=4.61e9,nu=0.0}",
        "friction.mu=\"stick\"",
        "grid={n=32,spacing=3.001e-5}",
        "path=[{W=12.965,increments=4},{delta_x=8.168e-6,increments=1}]",
    ];
    let scene = pressed(&bodies).unwrap();
    for (increment, fields) in solved(&scene).unwrap() {
        let whole = increment.work.parts == 1 || increment.point.branch == 0;
        assert!(whole && increment.work.convolutions < 500.0);
        for (n, &p) in fields.p.indexed_iter() {
            let overlap = -fields.gap[n] / scene.reference_approach();
            assert!(p > 0.0 || (overlap < 1e-6 && fields.q_x[n] == 0.0));
        }
    }
}
