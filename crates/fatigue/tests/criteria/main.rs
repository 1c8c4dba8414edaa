//! Criteria on stress histories against closed forms, brute force and symmetries.

#![allow(clippy::unwrap_used)]

mod ball;
mod brute_force;
mod closed_forms;
mod degenerate;
mod materials;
mod plastic_strain;
mod refused;
#[allow(dead_code, reason = "logarithmic numbers are for others")]
#[path = "../splitmix/mod.rs"]
mod splitmix;
mod symmetries;
mod ties;
mod yielding;

use std::sync::atomic::AtomicBool;

use fatigue::{Criterion, History, PointResult, Search, evaluate};
use ndarray::Array3;
use splitmix::Draw;

type Tensor = [f64; 6];

const STEEL: (f64, f64) = (210e9, 0.3);

/// All criteria, with weights that matter.
fn all() -> [Criterion; 8] {
    let (E, nu) = STEEL;
    [
        criterion("crossland", &[("alpha", 0.22)]),
        criterion("dang_van", &[("alpha", 0.4)]),
        criterion("findley", &[("k", 0.3)]),
        criterion("matake", &[("k", 0.5)]),
        criterion("mcdiarmid", &[("k", 0.2)]),
        criterion("smith_watson_topper", &[("E", E), ("nu", nu)]),
        criterion(
            "fatemi_socie",
            &[("E", E), ("nu", nu), ("k", 1.0), ("s_y", 500e6)],
        ),
        criterion("brown_miller", &[("E", E), ("nu", nu), ("S", 0.85)]),
    ]
}

fn criterion(name: &str, numbers: &[(&str, f64)]) -> Criterion {
    Criterion::new(name, numbers).unwrap()
}

fn one(criterion: &Criterion, history: &[Tensor]) -> PointResult {
    many(criterion, &[history.to_vec()])[0]
}

/// Points of equally long histories.
fn many(criterion: &Criterion, histories: &[Vec<Tensor>]) -> Vec<PointResult> {
    searched(criterion, histories, &Search::default())
}

fn searched(criterion: &Criterion, histories: &[Vec<Tensor>], search: &Search) -> Vec<PointResult> {
    let shape = (histories[0].len(), histories.len(), 6);
    let stress = Array3::from_shape_fn(shape, |(t, p, c)| histories[p][t][c]);
    let never = AtomicBool::new(false);
    evaluate(criterion, &History::elastic(&stress.view()), search, &never).unwrap()
}

/// A non-proportional history of independent stresses \[Pa\].
fn random(draw: &mut Draw, instants: usize) -> Vec<Tensor> {
    let mean: Tensor = std::array::from_fn(|_| 4e8 * (draw.next() - 0.6));
    (0..instants)
        .map(|_| std::array::from_fn(|c| mean[c] + 4e8 * (draw.next() - 0.5)))
        .collect()
}

/// A smooth cycle of two harmonics, as of a contact.
fn smooth(draw: &mut Draw, instants: usize) -> Vec<Tensor> {
    let part: [[f64; 5]; 6] = std::array::from_fn(|_| std::array::from_fn(|_| draw.next() - 0.5));
    (0..instants)
        .map(|t| {
            let phase = std::f64::consts::TAU * t as f64 / instants as f64;
            std::array::from_fn(|c| {
                let [a, b, d, e, f] = part[c];
                let second = (2.0 * phase).cos() * d + (2.0 * phase).sin() * e;
                4e8 * (a * phase.cos() + b * phase.sin() + 0.3 * second + f)
            })
        })
        .collect()
}

/// A cycle of two harmonics beside a pressure in one direction that leaves little tension, on a
/// ring of planes, as beside a contact \[Pa\].
fn pressed(draw: &mut Draw, instants: usize, share: f64) -> Vec<Tensor> {
    let axis: [f64; 3] = std::array::from_fn(|_| draw.next() - 0.5);
    let [x, y, z] = axis;
    let pressure = -4e8 / (x * x + y * y + z * z);
    let pressure = [x * x, y * y, z * z, x * y, x * z, y * z].map(|n| pressure * n);
    let rest = smooth(draw, instants);
    let add = |s: &Tensor| std::array::from_fn(|c| pressure[c] + share * s[c]);
    rest.iter().map(add).collect()
}
