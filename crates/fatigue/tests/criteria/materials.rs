//! Material data: every number has a source, and criteria give back what their weights are from.

use fatigue::{Assessment, CRITERIA, Judge, LONGEST, LifeRange, Material, Range, materials, read};

use super::{Tensor, one};

#[test]
fn the_table_is_whole() {
    let table = materials();
    assert!(table.len() >= 10);
    for material in table.values() {
        assert!(!material.numbers.is_empty() && !material.title.is_empty());
        for of in material.numbers.values() {
            assert!(of.source.len() > 20, "{of:?}");
        }
    }
}

/// Criteria with limits have a safety factor of 1 in the two tests that their limits are from.
#[test]
fn limits_are_those_of_the_tests() {
    let table = materials();
    for name in ["steel_42CrMo4", "steel_34Cr4", "steel_30NCD16"] {
        let material = &table[name];
        let (s_D, t_D) = (
            material.number("s_D").unwrap(),
            material.number("t_D").unwrap(),
        );
        let bent = |s: f64| -> Tensor { [s, 0.0, 0.0, 0.0, 0.0, 0.0] };
        let twisted = |t: f64| -> Tensor { [0.0, 0.0, 0.0, t, 0.0, 0.0] };
        for criterion in ["crossland", "dang_van", "findley", "matake"] {
            let of = Assessment::from_name(criterion, material).unwrap();
            for history in [[bent(s_D), bent(-s_D)], [twisted(t_D), twisted(-t_D)]] {
                let factor = of.safety_factor(one(&of.criterion, &history).value);
                assert!((factor - 1.0).abs() < 1e-5, "{name} {criterion}: {factor}");
            }
        }
    }
}

/// Criteria with curves give the life of the uniaxial test that the curve is from, while the strain
/// is nearly elastic.
#[test]
fn lives_are_those_of_the_test() {
    let table = materials();
    let mut material: Material = table["titanium_6Al4V"].clone();
    for (name, value) in [("k", 0.0), ("S", 0.5)] {
        let of = material.numbers["E"].clone();
        material
            .numbers
            .insert(name, fatigue::Sourced { value, ..of });
    }
    for criterion in ["smith_watson_topper", "fatemi_socie", "brown_miller"] {
        let of = Assessment::from_name(criterion, &material).unwrap();
        let Judge::Life(curve) = of.judge else {
            panic!("{criterion} has a curve")
        };
        let N = 1e9;
        let s = curve.elastic.amplitude(N);
        let uniaxial: Tensor = [s, 0.0, 0.0, 0.0, 0.0, 0.0];
        let found = one(&of.criterion, &[uniaxial, uniaxial.map(|s| -s)]);
        // The plastic strain, 2e-4 of the elastic one, is missing: over b, 2e-3 of the life.
        let life = of.life(found.value);
        assert!((life / N - 1.0).abs() < 0.01, "{criterion}: {life}");
    }
}

#[test]
fn wrong_files_and_missing_numbers() {
    let refused = |text: &str| read(text, "mine.toml").unwrap_err().to_string();
    let with = |line: &str| format!("schema = 1\n[materials.mine]\n{line}\n");
    let unknown = refused(&with("s_yield = { value = 1.0, source = \"test\" }"));
    assert!(
        unknown.starts_with("mine.toml:3: materials.mine.s_yield: unknown; nearest is s_y"),
        "{unknown}"
    );
    assert!(refused(&with("E = 210e9")).contains("source"));
    assert!(refused(&with("E = { value = 210e9, source = \"\" }")).contains("has no source"));
    assert!(refused(&with("E = { value = -1.0, source = \"test\" }")).contains("must be positive"));
    assert!(refused(&with("b = { value = 0.1, source = \"test\" }")).contains("must be negative"));
    assert!(refused("schema = 2\n[materials]\n").contains("must be 1"));
    assert!(refused("schema = 1\n[materials.x\n").starts_with("mine.toml:2:"));
    let mine = read(
        &with("s_D = { value = 4e8, source = \"test\" }"),
        "mine.toml",
    )
    .unwrap();
    let error = Assessment::from_name("crossland", &mine["mine"])
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("mine`.t_D: is missing (fatigue limit")
            && error.contains("known of it are s_D"),
        "{error}"
    );
    let error = Assessment::from_name("crosland", &mine["mine"])
        .unwrap_err()
        .to_string();
    assert!(error.contains("one of crossland"), "{error}");
}

#[test]
fn parts_of_a_range_add_as_squares_of_logarithms() {
    let range = |low, best, high| Range { low, best, high };
    let (stress, distance) = (range(5e4, 1e5, 2e5), range(8e4, 1e5, 1.25e5));
    let found = LifeRange::combine(stress, 4.0, Some(distance)).range;
    let half = (2.0 * 2f64.ln().powi(2) + 1.25f64.ln().powi(2)).sqrt();
    assert!((found.low / (1e5 * (-half).exp()) - 1.0).abs() < 1e-12);
    assert!((found.high / (1e5 * half.exp()) - 1.0).abs() < 1e-12);
    let endless = LifeRange::combine(range(1e7, f64::INFINITY, f64::INFINITY), 4.0, None).range;
    assert!((endless.low - 5e6).abs() < 1.0);
    assert_eq!(endless.high, f64::INFINITY);
}

#[test]
fn a_life_beyond_the_tests_of_its_curve_is_without_end_and_a_safety_factor_is_not() {
    let materials = materials();
    let told = |criterion: &str, name: &str, best: f64| {
        let of = Assessment::from_name(criterion, &materials[name]).unwrap();
        let (low, high) = (0.5 * best, 2.0 * best);
        of.life_range(Range { low, best, high }, 1.0, None).range
    };
    let life = |best| told("smith_watson_topper", "steel_4340", best);
    assert!((life(4e6).high - 8e6).abs() < 1.0);
    let at_end = life(8e6);
    assert!((at_end.low - 4e6).abs() < 1.0 && (at_end.best - 8e6).abs() < 1.0);
    assert_eq!(at_end.high, f64::INFINITY);
    let beyond = life(1e9);
    assert!((beyond.low - LONGEST).abs() < 1.0 && beyond.best.is_infinite());
    assert!((told("crossland", "steel_42CrMo4", 1e9).high - 2e9).abs() < 1.0);
}

#[test]
fn no_number_that_a_reader_is_given_is_a_life_beyond_the_tests() {
    let mut beyond = 0;
    for material in materials().values() {
        for of in CRITERIA {
            let Ok(of) = Assessment::from_name(of.name, material) else {
                continue;
            };
            for n in 0..60 {
                let value = 10f64.powf(-8.0 + 0.3 * f64::from(n));
                let range = of.margin_range(value, 0.1 * value);
                assert!(range.best.to_bits() == of.margin(value).to_bits());
                if of.gives_lives() {
                    let told = [range.best, range.high];
                    assert!(
                        told.iter()
                            .all(|life| *life <= LONGEST || life.is_infinite())
                    );
                    assert!(range.low <= LONGEST || of.uncapped_margin(1.1 * value).is_infinite());
                    beyond += usize::from(of.uncapped_margin(value) > LONGEST && range.low > 0.0);
                } else {
                    assert!(of.uncapped_margin(value).to_bits() == range.best.to_bits());
                }
            }
        }
    }
    assert!(beyond > 50, "{beyond}");
}

#[test]
fn every_material_that_is_judged_has_a_critical_distance_and_says_how_it_is_known() {
    for (name, material) in materials() {
        let judged = CRITERIA
            .iter()
            .filter_map(|of| Assessment::from_name(of.name, &material).ok())
            .collect::<Vec<_>>();
        if judged.is_empty() {
            continue;
        }
        let length = material.critical_distance();
        assert!(
            length.as_ref().is_ok_and(|L| (5e-6..3e-4).contains(L)),
            "{name}: {length:?}"
        );
        for of in judged {
            let (factor, note) = of.scatter(Some(&material), None).unwrap();
            // A wider range comes with its reason.
            let wide = factor > if of.gives_lives() { 3.0 } else { 1.2 };
            assert_eq!(wide, note.is_some(), "{name}: {factor}, {note:?}");
        }
    }
}
