//! What is no history.

use std::sync::atomic::AtomicBool;

use fatigue::Error;
use fatigue::{Criterion, History, Search, evaluate};
use ndarray::Array3;

use super::criterion;

fn refused(criterion: &Criterion, stress: &Array3<f64>) -> String {
    let never = AtomicBool::new(false);
    let found = evaluate(
        criterion,
        &History::elastic(&stress.view()),
        &Search::default(),
        &never,
    );
    found.unwrap_err().to_string()
}

fn findley() -> Criterion {
    criterion("findley", &[("k", 0.3)])
}

#[test]
fn histories_without_meaning() {
    let mut stress = Array3::from_elem((4, 3, 6), 1e6);
    stress[(2, 1, 4)] = f64::NAN;
    assert_eq!(
        refused(&findley(), &stress),
        "stress[2, 1, 4] = NaN: must be a finite stress in Pa, up to 1e75"
    );
    stress[(2, 1, 4)] = f64::INFINITY;
    assert!(refused(&findley(), &stress).contains("inf"));
    let zero = Array3::zeros((4, 3, 6));
    assert!(refused(&findley(), &zero).contains("other than zero"));
    assert!(refused(&findley(), &Array3::ones((1, 3, 6))).contains("at least 2"));
    assert!(refused(&findley(), &Array3::ones((4, 3, 3))).contains("xx, yy, zz"));
    stress[(2, 1, 4)] = 1e80;
    assert!(refused(&findley(), &stress).contains("up to 1e75"));
}

#[test]
fn criteria_without_meaning() {
    let refused = |name: &str, numbers: &[(&str, f64)]| {
        Criterion::new(name, numbers).unwrap_err().to_string()
    };
    let negative = refused("crossland", &[("alpha", -1.0)]);
    assert_eq!(
        negative,
        "crossland.alpha = -1: must be a weight, 0 or more"
    );
    assert!(refused("findley", &[("alpha", 1.0)]).contains("one of k"));
    assert!(refused("findley", &[]).contains("findley takes k"));
    assert!(refused("findlay", &[("k", 1.0)]).contains("one of crossland, "));
    let nu = refused("smith_watson_topper", &[("E", 2e11), ("nu", 0.6)]);
    assert!(nu.contains("-1 < nu <= 0.5"));
}

#[test]
fn a_point_without_stress_among_others() {
    let mut stress = Array3::from_shape_fn((4, 2, 6), |(t, _, c)| (t * 6 + c) as f64 * 1e6);
    stress.slice_mut(ndarray::s![.., 1, ..]).fill(0.0);
    let never = AtomicBool::new(false);
    let found = evaluate(
        &findley(),
        &History::elastic(&stress.view()),
        &Search::default(),
        &never,
    )
    .unwrap();
    assert!(found[0].value > 0.0 && found[1].value.abs() < 1e-300);
    assert!(found[1].normal[0].is_nan());
    let raised = AtomicBool::new(true);
    let stopped = evaluate(
        &findley(),
        &History::elastic(&stress.view()),
        &Search::default(),
        &raised,
    );
    assert!(matches!(stopped, Err(Error::Stopped)));
}
