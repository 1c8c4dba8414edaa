//! Coated bodies without friction.

use contact_core::scene::{Coating, Elastic};
use contact_reference::{
    CoatedIndentation, coated_indentation, confined_modulus, hertz, layered_normal_response,
    thin_compressible_layer, thin_incompressible_layer,
};
use serde_json::Value;

use crate::quadrature::integrate;

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };
const R: f64 = 0.018;

fn material(value: &Value) -> Elastic {
    if value == "rigid" {
        return Elastic::RIGID;
    }
    let number = |key: &str| value[key].as_f64().expect(key);
    Elastic {
        E: number("E"),
        nu: number("nu"),
    }
}

#[test]
fn another_program_in_extended_precision_finds_the_same_contact() {
    let data: Value = serde_json::from_str(include_str!(
        "../../../contact-core/tests/data/axisym_indentation.json"
    ))
    .unwrap();
    let entries = data["entries"].as_array().unwrap();
    assert_eq!(entries.len(), 18);
    for entry in entries {
        let number = |key: &str| entry[key].as_f64().unwrap();
        let layer = &entry["layers"][0];
        let coating = Coating {
            material: material(layer),
            thickness: layer["h"].as_f64().unwrap(),
        };
        let a = number("a");
        let contact = CoatedIndentation::of_radius(
            number("R"),
            material(&entry["indenter"]),
            coating,
            material(&entry["substrate"]),
            a,
        );
        let mut pairs = vec![
            (contact.W, number("load_W")),
            (contact.delta_z, number("approach_delta")),
        ];
        for (r, p) in entry["p_at_r_over_a"].as_object().unwrap() {
            pairs.push((
                contact.p(r.parse::<f64>().unwrap() * a),
                p.as_f64().unwrap(),
            ));
        }
        for (ours, theirs) in pairs {
            assert!(
                (ours / theirs - 1.0).abs() < 1e-8,
                "{}: {ours} {theirs}",
                entry["id"]
            );
        }
    }
}

/// E1/E2, h/a0, a/a0, p_max/p0, delta/delta0 of a rigid sphere at the load whose Hertz contact
/// with the bare substrate is a0, p0, delta0; nu = 0.3. Computed with another program.
const ROWS: [[f64; 5]; 8] = [
    [0.25, 0.25, 1.226_363_8, 0.759_546_4, 1.177_768_3],
    [2.0, 0.25, 0.920_340_0, 1.073_928_9, 0.955_810_6],
    [0.5, 0.5, 1.149_908_8, 0.807_561_5, 1.127_525_3],
    [4.0, 0.5, 0.745_815_8, 1.574_471_5, 0.836_736_0],
    [0.25, 1.0, 1.446_997_4, 0.507_137_6, 1.544_689_0],
    [2.0, 1.0, 0.818_477_5, 1.475_436_9, 0.826_870_0],
    [0.5, 2.0, 1.244_858_9, 0.647_356_5, 1.352_655_0],
    [4.0, 2.0, 0.634_292_7, 2.484_388_8, 0.551_408_5],
];

#[test]
fn the_load_finds_its_radius() {
    let W = 1e3;
    let bare = hertz(R, Elastic::RIGID, STEEL, W);
    for [ratio, h, a, p_max, delta] in ROWS {
        let coating = Coating {
            material: Elastic::new(ratio * STEEL.E, 0.3).unwrap(),
            thickness: h * bare.a,
        };
        let contact = coated_indentation(R, Elastic::RIGID, coating, STEEL, W).unwrap();
        assert!((contact.a / bare.a - a).abs() < 6e-8);
        assert!((contact.p(0.0) / bare.p0 - p_max).abs() < 6e-8);
        assert!((contact.delta_z / bare.delta_z - delta).abs() < 6e-8);
    }
}

#[test]
fn the_load_is_met_from_films_to_bulk() {
    for (ratio, nu, h) in [
        (1e-2, 0.49, 0.05),
        (1e3, 0.0, 0.05),
        (0.1, 0.3, 100.0),
        (50.0, -0.5, 1.0),
    ] {
        let bare = hertz(R, STEEL, STEEL, 1e3);
        let coating = Coating {
            material: Elastic {
                E: ratio * STEEL.E,
                nu,
            },
            thickness: h * bare.a,
        };
        let contact = coated_indentation(R, STEEL, coating, STEEL, 1e3).unwrap();
        assert!(
            (contact.W / 1e3 - 1.0).abs() < 1e-11,
            "{ratio} {h}: {}",
            contact.W
        );
        // The pressure, computed on its own, carries the load.
        let a = contact.a;
        let carried = integrate(0.0, a, |r| 2.0 * std::f64::consts::PI * r * contact.p(r));
        assert!((carried / 1e3 - 1.0).abs() < 1e-8, "{ratio} {h}: {carried}");
    }
}

#[test]
fn a_coating_of_the_substrates_material_gives_hertz() {
    let bare = hertz(R, STEEL, STEEL, 1e3);
    let coating = Coating {
        material: STEEL,
        thickness: 0.3 * bare.a,
    };
    let contact = coated_indentation(R, STEEL, coating, STEEL, 1e3).unwrap();
    assert!((contact.a / bare.a - 1.0).abs() < 1e-12);
    assert!((contact.delta_z / bare.delta_z - 1.0).abs() < 1e-12);
    for r in [0.0, 0.5 * bare.a, 0.99 * bare.a] {
        assert!((contact.p(r) / bare.p(r) - 1.0).abs() < 1e-10);
    }
}

#[test]
fn thin_layers_are_the_limit_of_the_coated_half_space() {
    let a = 1e-3;
    let on_rigid = |layer: Elastic, h: f64| {
        let coating = Coating {
            material: layer,
            thickness: h,
        };
        CoatedIndentation::of_radius(R, Elastic::RIGID, coating, Elastic::RIGID, a)
    };
    // The edge zone is about h wide: the error is about 2 h/a and halves with it.
    let soft = Elastic { E: 1e9, nu: 0.3 };
    let error = |h: f64| {
        let contact = on_rigid(soft, h);
        thin_compressible_layer(R, soft, h, contact.W).a / a - 1.0
    };
    let (coarse, fine) = (error(0.04 * a), error(0.02 * a));
    assert!(fine.abs() < 0.04, "{fine}");
    assert!((coarse / fine - 2.0).abs() < 0.1, "{coarse} {fine}");

    let rubber = Elastic {
        E: 3e6,
        nu: 0.499_999_9,
    };
    let error = |h: f64| {
        let contact = on_rigid(rubber, h);
        thin_incompressible_layer(R, rubber.G(), h, contact.W).a / a - 1.0
    };
    let (coarse, fine) = (error(0.04 * a), error(0.02 * a));
    assert!(fine.abs() < 0.04, "{fine}");
    assert!((coarse / fine - 2.0).abs() < 0.1, "{coarse} {fine}");
}

#[test]
fn thin_layers_carry_their_load() {
    use std::f64::consts::PI;
    let (layer, h, W) = (Elastic { E: 1e9, nu: 0.3 }, 1e-5, 50.0);
    let compressible = thin_compressible_layer(R, layer, h, W);
    let a = compressible.a;
    let column = |r: f64| confined_modulus(layer) / h * (compressible.delta_z - r * r / (2.0 * R));
    let carried = integrate(0.0, a, |r| 2.0 * PI * r * column(r));
    assert!((carried / W - 1.0).abs() < 1e-10);
    assert!((column(0.0) / compressible.p0 - 1.0).abs() < 1e-14);

    let G = 1e6;
    let flowing = thin_incompressible_layer(R, G, h, W);
    let a = flowing.a;
    let p = |r: f64| flowing.p0 * (1.0 - (r / a).powi(2)).powi(2);
    let carried = integrate(0.0, a, |r| 2.0 * PI * r * p(r));
    assert!((carried / W - 1.0).abs() < 1e-10);
    // -(h^3/(3 G)) (p'' + p'/r) = delta_z - r^2/(2 R), by differences.
    for r in [0.2 * a, 0.7 * a] {
        let d = 1e-3 * a;
        let laplace =
            (p(r + d) - 2.0 * p(r) + p(r - d)) / (d * d) + (p(r + d) - p(r - d)) / (2.0 * d * r);
        let indented = flowing.delta_z - r * r / (2.0 * R);
        let volume = -h.powi(3) / (3.0 * G) * laplace;
        assert!((volume - indented).abs() < 1e-5 * flowing.delta_z);
    }
}

#[test]
fn the_response_has_its_limits() {
    let half_space = |k: f64, m: Elastic| (1.0 - m.nu) / (m.G() * k);
    let hard = Elastic { E: 800e9, nu: 0.2 };
    let h = 1e-4;
    // Waves much shorter than the coating see its material, much longer ones the substrate.
    let short = layered_normal_response(40.0 / h, hard, h, STEEL) / half_space(40.0 / h, hard);
    let long = layered_normal_response(1e-9 / h, hard, h, STEEL) / half_space(1e-9 / h, STEEL);
    assert!(
        (short - 1.0).abs() < 1e-13 && (long - 1.0).abs() < 1e-7,
        "{short} {long}"
    );
    let same = layered_normal_response(1.0 / h, STEEL, h, STEEL) / half_space(1.0 / h, STEEL);
    assert!((same - 1.0).abs() < 1e-14);
    // On a rigid base: h/M, and h^3 k^2/(3 G) for an incompressible layer.
    let k = 1e-4 / h;
    let layer = layered_normal_response(k, STEEL, h, Elastic::RIGID) * confined_modulus(STEEL) / h;
    assert!((layer - 1.0).abs() < 1e-6, "{layer}");
    let rubber = Elastic {
        E: 3e6,
        nu: 0.5 - 1e-13,
    };
    let k = 1e-2 / h;
    let flow = layered_normal_response(k, rubber, h, Elastic::RIGID)
        / (h.powi(3) * k * k / (3.0 * rubber.G()));
    assert!((flow - 1.0).abs() < 1e-3, "{flow}");
}
