//! Reasons for which the text of a scene is refused.

use super::tests::{FILE, GOOD, assert_refused, with_change, with_settings};
use super::*;

#[test]
fn bad_settings_are_named() {
    for (setting, part) in [
        ("friction.mmu=0.5", "the nearest valid key is `friction.mu`"),
        ("frition.mu=0.5", "the nearest valid key is `friction`"),
        ("pitch=1e-6", "the nearest valid key is `grid.spacing`"),
        ("cof=0.3", "the nearest valid key is `friction.mu`"),
        ("path.0.load=3", "the nearest valid key is `path[0].W`"),
        ("friction.mu", "of the form key=value"),
        ("=1", "the key is empty"),
        ("friction.mu=", "is not a TOML value"),
        ("friction.mu=[1", "is not a TOML value"),
        (
            "friction.mu=high",
            "friction.mu = \"high\": must be a number",
        ),
        (
            "friction.mu.x=3",
            "friction.mu = { x = 3 }: must be a number",
        ),
        ("body2.coatings.1.nu=0.2", "body2.coatings has 1 entries"),
        ("body2.coatings.last.nu=0.2", "none is `last`"),
        ("grid.n=0", "grid.n = 0: must be a whole number >= 1"),
        (
            "path.1.T_x.mu_W=1.2",
            "path[1].T_x = 360: must be |T| <= mu W = 300",
        ),
    ] {
        let error = with_settings(&[setting]).unwrap_err();
        assert!(matches!(&error, Error::Setting { setting: s, .. } if s == setting));
        let text = error.to_string();
        assert!(text.contains(part), "{text:?} lacks {part:?}");
    }
}

/// The key that is meant stands beside one that the file has: both faults are reported.
#[test]
fn a_key_by_another_word_that_clashes_has_two_faults() {
    let text = with_settings(&["grid.pitch=1e-6"]).unwrap_err().to_string();
    assert!(
        text.contains("the nearest valid key is `grid.spacing`"),
        "{text}"
    );
    assert!(
        text.contains("grid.extent and grid.spacing are both given"),
        "{text}"
    );
}

#[test]
fn unknown_keys_name_the_nearest() {
    assert_refused(
        with_change("[friction]", "[frcition]"),
        19,
        &["unknown key `frcition`", "nearest valid key is `friction`"],
    );
    assert_refused(
        with_change("thickness =", "thicknes ="),
        17,
        &[
            "unknown key `body2.coatings[0].thicknes`",
            "nearest valid key is `body2.coatings[0].thickness`",
        ],
    );
    assert_refused(
        with_change("T_x = {", "Tx = {"),
        32,
        &["unknown key `path[1].Tx`", "`path[1].T_x`"],
    );
    assert_refused(
        with_change("shape.sphere.R", "shape.sphere.radius"),
        5,
        &["`body1.shape.sphere.radius`", "`body1.shape.sphere.R`"],
    );
    assert_refused(
        with_change("{ a_H = 2.4 }", "{ a_h = 2.4 }"),
        24,
        &["grid.extent = { a_h = 2.4 }", "{ a_H = number }"],
    );
}

/// Text of the good scene; its replacement; the line; the key and value named; what is
/// allowed.
const WITHOUT_MEANING: &str = r#"
E = 210e9;  E = -210e9;  6;  body1.E = -210000000000;  a positive modulus in Pa
E = 210e9;  E = nan;  6;  body1.E = nan;  a number
nu = 0.3;  nu = 0.51;  7;  body1.nu = 0.51;  -1 < nu <= 0.5
nu = 0.3;  nu = -1.0;  7;  body1.nu = -1;  -1 < nu <= 0.5
R = 0.018;  R = 0.0;  5;  body1.shape.sphere.R = 0;  a finite radius in m
{ E_substrate = 2.0 };  -1.0;  15;  body2.coatings[0].E = -1;  a positive modulus
{ E_substrate = 2.0 };  inf;  15;  body2.coatings[0].E = inf;  a finite modulus
{ a_H = 1.0 };  0.0;  17;  body2.coatings[0].thickness = 0;  a positive length
{ a_H = 1.0 };  { a_H = nan };  17;  thickness.a_H = nan;  a number
mu = 0.3;  mu = -0.1;  20;  friction.mu = -0.1;  >= 0
mu = 0.3;  mu = inf;  20;  friction.mu = inf;  a finite number >= 0
n = 32;  n = 0;  23;  grid.n = 0;  a whole number >= 1
n = 32;  n = [32, -2];  23;  grid.n[1] = -2;  a whole number >= 1
n = 32;  n = [1, 2, 3];  23;  grid.n = [1, 2, 3];  two along x and y
{ a_H = 2.4 };  -1e-3;  24;  grid.extent = -0.001;  a positive length
W = 1000.0;  W = -1.0;  27;  path[0].W = -1;  a finite compressive force
increments = 10;  increments = 0;  28;  path[0].increments = 0;  >= 1
increments = 10;  increments = 1.5;  28;  path[0].increments = 1.5;  a whole number
t = 0.1;  t = 0.0;  29;  path[0].t = 0;  a time after 0
mu_W = 0.9;  mu_W = 1.1;  32;  path[1].T_x = 330;  |T| <= mu W = 300
mu_W = 0.9;  a_H = 0.9;  32;  path[1].T_x = { a_H = 0.9 };  { mu_W = number }
schema = 1;  schema = 2;  1;  schema = 2;  must be 1
"flat";  "flot";  10;  body2.shape = "flot";  "flat" or a table such as { sphere
"#;

#[test]
fn values_without_meaning_are_refused() {
    let rows = WITHOUT_MEANING.trim().lines();
    let mut count = 0;
    for row in rows {
        let parts: Vec<_> = row.split(';').map(str::trim).collect();
        let [from, to, line, value, allowed] = parts[..] else {
            panic!("{row}");
        };
        assert_refused(
            with_change(from, to),
            line.parse().unwrap(),
            &[value, allowed],
        );
        count += 1;
    }
    assert_eq!(count, 23);
}

#[test]
fn missing_values_are_named() {
    assert_refused(with_change("E = 210e9\n", ""), 4, &["body1.E is missing"]);
    assert_refused(with_change("n = 32\n", ""), 22, &["grid.n is missing"]);
    assert_refused(with_change("schema = 1\n", ""), 1, &["schema is missing"]);
    assert_refused(
        with_change("[friction]\nmu = 0.3\n", ""),
        1,
        &["friction is missing"],
    );
    assert_refused(
        with_change("extent = { a_H = 2.4 }", ""),
        22,
        &["grid.extent is missing"],
    );
    let both_sizes = with_change("n = 32", "n = 32\nspacing = 1e-5");
    assert_refused(both_sizes, 24, &["grid.extent and grid.spacing"]);
}

#[test]
fn broken_toml_names_its_line() {
    assert_refused(with_change("mu = 0.3", "mu = = 0.3"), 20, &[]);
    assert_refused(
        with_change("nu = 0.3", "nu = 0.3\nnu = 0.2"),
        8,
        &["duplicate key"],
    );
    assert_refused(with_change("W = 1000.0", "W = 1e999"), 27, &[]);
}

#[test]
fn a_missing_hertz_contact_is_named() {
    let flat = with_change("shape.sphere.R = 0.018", "shape = \"flat\"");
    assert_refused(flat, 17, &["thickness is given in a_H", "no Hertz contact"]);
    let rigid = GOOD
        .replace("E = 210e9", "E = \"rigid\"")
        .replace("{ a_H = 1.0 }", "1e-4");
    let rigid = Scene::from_toml_str(&rigid, FILE, &[]);
    assert_refused(rigid, 15, &["in E_substrate", "the substrate is rigid"]);
}
