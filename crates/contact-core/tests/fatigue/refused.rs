//! What is no history.

use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::fatigue::{Criterion, Search, evaluate};
use ndarray::Array3;

fn refused(criterion: &Criterion, stress: &Array3<f64>) -> String {
    let never = AtomicBool::new(false);
    let found = evaluate(criterion, &stress.view(), &Search::default(), &never);
    found.unwrap_err().to_string()
}

const FINDLEY: Criterion = Criterion::Findley { k: 0.3 };

#[test]
fn histories_without_meaning() {
    let mut stress = Array3::from_elem((4, 3, 6), 1e6);
    stress[(2, 1, 4)] = f64::NAN;
    assert_eq!(
        refused(&FINDLEY, &stress),
        "stress[2, 1, 4] = NaN: must be a finite stress in Pa"
    );
    stress[(2, 1, 4)] = f64::INFINITY;
    assert!(refused(&FINDLEY, &stress).contains("inf"));
    let zero = Array3::zeros((4, 3, 6));
    assert!(refused(&FINDLEY, &zero).contains("other than zero"));
    assert!(refused(&FINDLEY, &Array3::ones((1, 3, 6))).contains("at least 2"));
    assert!(refused(&FINDLEY, &Array3::ones((4, 3, 3))).contains("xx, yy, zz"));
    let weight = Criterion::Crossland { alpha: -1.0 };
    assert!(refused(&weight, &Array3::ones((4, 3, 6))).contains("crossland.alpha"));
}

#[test]
fn a_point_without_stress_among_others() {
    let mut stress = Array3::from_shape_fn((4, 2, 6), |(t, _, c)| (t * 6 + c) as f64 * 1e6);
    stress.slice_mut(ndarray::s![.., 1, ..]).fill(0.0);
    let never = AtomicBool::new(false);
    let found = evaluate(&FINDLEY, &stress.view(), &Search::default(), &never).unwrap();
    assert!(found[0].value > 0.0 && found[1].value.abs() < 1e-300);
    assert!(found[1].normal[0].is_nan());
    let raised = AtomicBool::new(true);
    let stopped = evaluate(&FINDLEY, &stress.view(), &Search::default(), &raised);
    assert!(matches!(stopped, Err(Error::Interrupted { .. })));
}
