//! Error bars: is the error of cells, increments and solver together what it is said to be?
//!
//! Random scenes with the increments that are chosen by default, each against four times the cells
//! each way and four times the increments. A few in the test; `FRET_ERROR_BARS=160` for as many
//! (`make error-bars`).

#![allow(clippy::print_stdout, reason = "a report for people")]

use std::fmt::Write as _;
use std::sync::Arc;

use crate::splitmix::Draw;
use contact_core::estimate::{
    Bar, BranchEnds, ErrorBars, ErrorMethod, choose_increments, error_bars, means,
};
use contact_core::march::{BranchSummary, Increment, Tractions, solve, summarise};
use contact_core::scene::{Elastic, Scene};
use contact_reference::hertz;
use ndarray::Array2;

/// True error over estimate: at most the second, in 95 % of a number, and at least the first, in so
/// many percent as [`METHODS`] says.
const HONEST: (f64, f64) = (0.2, 1.5);
/// Cells each way and of the reference, and increments of the reference over those chosen.
const CELLS: usize = 48;
const FINE: usize = 4 * CELLS;
const FINER: usize = 4;
/// Seeds differ from those of the path's errors, and from those that orders and weights of the bars
/// were chosen on (from 1000 to 4000).
const FIRST_SEED: u64 = 5000;

/// Both sources of the errors of cells, and the ratios at least 0.2 that are asked, in percent. A normal error
/// whose scale is the bar has 84 %, with bars twice as long 69 %. Shifts and rotations have bars from coarser grids
/// that are longer still.
const METHODS: [(&str, ErrorMethod, usize); 2] = [
    ("finer grid", ErrorMethod::FinerGrid, 80),
    ("coarser grids alone", ErrorMethod::CoarserGrids, 30),
];
/// Numbers whose bars have a least part, the place of a rim within a cell: 10 % fewer are asked.
const OF_RIMS: [&str; 2] = ["contact_radius", "stick_ratio"];

/// Largest moment over mu W a_H: two thirds of 3 pi/16, the moment of full slip, since a stiff
/// coating makes the contact smaller.
const TWISTED: f64 = 0.4;

/// A coating of `body`, harder or softer than it.
fn coating(draw: &mut Draw, body: &str, a: f64) -> String {
    let (ratio, thickness) = (draw.between(0.3, 4.0), a * draw.between(0.1, 2.0));
    format!(
        "[[{body}.coatings]]\nE = {{ E_substrate = {ratio} }}\nnu = {:.4}\nthickness = {thickness}\n",
        0.45 * draw.next()
    )
}

/// A sphere, smooth, rough, or tilted, so that the contact lies off the middle of the grid.
fn shape(draw: &mut Draw, a: f64) -> String {
    let sphere = format!("{{ sphere = {{ R = {R} }} }}");
    let kind = draw.next();
    if kind < 0.2 {
        let rms = a * a / R * draw.between(2e-3, 2e-2);
        let (longest, shortest) = (1.5 * a, 0.4 * a);
        let seed = (1e6 * draw.next()) as u64;
        format!(
            "shape.sum = [{sphere}, {{ rough = {{ rms = {rms}, hurst = 0.8, longest = {longest}, \
             shortest = {shortest}, seed = {seed} }} }}]\n"
        )
    } else if kind < 0.4 {
        let (spacing, off) = (6.0 * a, 0.2 * a * draw.next());
        let h = 0.5 * spacing * off / R;
        format!(
            "shape.sum = [{sphere}, {{ height_map = {{ spacing = {spacing}, z = [[{:?}, {:?}], [{h:?}, {h:?}]] }} }}]\n",
            -h, -h
        )
    } else {
        format!("shape.sphere.R = {R}\n")
    }
}

/// Radius \[m\] and load \[N\].
const R: f64 = 0.01;
const W: f64 = 100.0;

/// A ball on a half-space, either coated or not, fretted, twisted, loaded obliquely or only
/// pressed.
fn drawn(seed: u64) -> String {
    let mut draw = Draw(seed);
    let [nu_1, nu_2] = [(); 2].map(|()| 0.45 * draw.next());
    let (upper, lower) = (draw.between(50e9, 800e9), draw.between(50e9, 800e9));
    let bodies = [(upper, nu_1), (lower, nu_2)].map(|(E, nu)| Elastic { E, nu });
    let a = hertz(R, bodies[0], bodies[1], W).a;
    let mut text = format!("schema = 1\n[body1]\nE = {upper:e}\nnu = {nu_1:.4}\n");
    text += &shape(&mut draw, a);
    let coated = draw.next();
    if coated < 0.25 {
        text += &coating(&mut draw, "body1", a);
    }
    let _ = write!(
        text,
        "[body2]\nshape = \"flat\"\nE = {lower:e}\nnu = {nu_2:.4}\n"
    );
    if coated < 0.7 {
        text += &coating(&mut draw, "body2", a);
    }
    let (mu, extent) = (draw.between(0.1, 0.8), a * (3.0 + 0.3 * draw.next()));
    let _ = write!(
        text,
        "[friction]\nmu = {mu}\n[grid]\nn = @N@\nextent = {extent}\n[[path]]\nW = {W:?}\n"
    );
    let kind = draw.next();
    for sign in [1.0, -1.0] {
        let part = sign * draw.between(0.3, 0.95);
        let T_x = part * mu * W;
        let _ = if kind < 0.5 {
            write!(text, "[[path]]\nT_x = {T_x}\n")
        } else if kind < 0.65 {
            let load = W * (1.0 + 0.5 * part);
            write!(text, "[[path]]\nW = {load}\nT_x = {}\n", 0.4 * T_x)
        } else if kind < 0.85 {
            write!(text, "[[path]]\nM_z = {}\n", TWISTED * T_x * a)
        } else {
            Ok(())
        };
    }
    text
}

/// The scene on so many cells.
fn scene(text: &str, cells: usize) -> Scene {
    let text = text.replace("@N@", &cells.to_string());
    Scene::from_toml_str(&text, "drawn", &[]).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The scene with increments as they are chosen, and on finer cells with so many times of them.
fn chosen(text: &str) -> Option<(Scene, Scene)> {
    let coarse = choose_increments(&scene(text, CELLS), &Arc::default()).ok()?;
    let mut fine = scene(text, FINE);
    fine.path = coarse.path.clone();
    for branch in &mut fine.path.branches {
        branch.increments = branch.increments.map(|n| FINER * n);
    }
    fine.settings.solver.tolerance = Some(1e-6);
    Some((coarse, fine))
}

/// True over estimated errors: of p and q, and of numbers by name.
type Ratios = ([f64; 2], Vec<(&'static str, f64)>);

type Number = (
    &'static str,
    fn(&BranchSummary) -> f64,
    fn(&ErrorBars) -> Bar,
);

const NUMBERS: [Number; 7] = [
    ("contact_radius", |b| b.contact_radius, |e| e.contact_radius),
    ("stick_ratio", |b| b.stick_ratio, |e| e.stick_ratio),
    ("p_max", |b| b.p_max, |e| e.p_max),
    ("delta_z", |b| b.motion.delta_z, |e| e.delta_z),
    ("delta_x", |b| b.motion.delta_x, |e| e.delta_x),
    ("phi_z", |b| b.motion.phi_z, |e| e.phi_z),
    ("dissipated", |b| b.dissipated, |e| e.dissipated),
];

/// The L2 norm of some fields of a branch.
fn norm(fields: &[Array2<f64>]) -> f64 {
    let squares = fields.iter().flatten().map(|f| f * f);
    squares.sum::<f64>().sqrt()
}

/// The largest error of some of the tractions over the branches, over the largest of them.
fn field_error(ours: &[Tractions], reference: &[Tractions], of: std::ops::Range<usize>) -> f64 {
    let off = ours.iter().zip(reference).map(|(ours, reference)| {
        let off: Vec<_> = of
            .clone()
            .map(|k| &ours[k] - &means(&reference[k], ours[k].dim()))
            .collect();
        norm(&off)
    });
    let largest = ours.iter().map(|ours| norm(&ours[of.clone()]));
    off.fold(0.0, f64::max) / largest.fold(f64::MIN_POSITIVE, f64::max)
}

/// True over estimated errors of both [`METHODS`]: of the fields of a scene, and of the numbers of all of its
/// branches.
fn ratios(seed: u64) -> Option<[Ratios; 2]> {
    let text = drawn(seed);
    let (mut nobody, mut no_one) = ((), ());
    let (coarse, fine) = chosen(&text)?;
    let mut ends = BranchEnds::new(&mut nobody);
    // A soft coating may spread the contact over the border.
    let increments = solve(&coarse, &mut ends).ok()?;
    let mut true_ends = BranchEnds::new(&mut no_one);
    let reference = solve(&fine, &mut true_ends).ok()?;
    let of_method = |method| {
        println!("{seed}, {method:?}");
        let tractions = &ends.tractions;
        let bars = error_bars(&coarse, &increments, tractions, method, &Arc::default()).ok()?;
        Some(ratios_of_bars(
            &bars,
            [&increments, &reference],
            [tractions, &true_ends.tractions],
        ))
    };
    Some([of_method(METHODS[0].1)?, of_method(METHODS[1].1)?])
}

/// True over estimated errors, where a run and its reference ended with these tractions.
fn ratios_of_bars(
    bars: &[ErrorBars],
    [increments, reference]: [&[Increment]; 2],
    [tractions, true_tractions]: [&[Tractions]; 2],
) -> Ratios {
    let mut numbers = Vec::new();
    let (ours, truth) = (summarise(increments), summarise(reference));
    for (name, value, of) in NUMBERS {
        let largest = truth.iter().map(|b| value(b).abs()).fold(0.0, f64::max);
        for ((ours, truth), bar) in ours.iter().zip(&truth).zip(bars) {
            let error = (value(ours) - value(truth)).abs();
            // What never moves or slips, like delta_x under W alone, has no error but what single
            // precision rounds.
            let moves = !name.starts_with("delta") || largest > 1e-7 * truth.motion.delta_z;
            if value(truth).abs() > 1e-6 * largest && error > 1e-12 * largest && moves {
                numbers.push((name, error / of(bar).total));
                println!(
                    "  {name} of branch {}: {error:.2e} of {:.2e} at stick ratio {:.4}, {:?}",
                    bar.branch,
                    value(truth),
                    truth.stick_ratio,
                    of(bar)
                );
            }
        }
    }
    let largest = |of: fn(&ErrorBars) -> f64| bars.iter().map(of).fold(0.0, f64::max);
    let error = |of| field_error(tractions, true_tractions, of);
    let (p, q) = (error(0..1), error(1..3));
    let (bar_p, bar_q) = (largest(|b| b.p.total), largest(|b| b.q.total));
    println!("  p {p:.2e} of {bar_p:.2e}, q {q:.2e} of {bar_q:.2e}");
    ([p / bar_p, q / bar_q], numbers)
}

/// How many of these are small enough, how many large enough, and a line that says so.
fn summary(name: &str, ratios: &[f64]) -> ([usize; 2], String) {
    let mut sorted = ratios.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |part: f64| sorted[(part * (sorted.len() - 1) as f64).round() as usize];
    let below = ratios.iter().filter(|&&r| r <= HONEST.1).count();
    let above = ratios.iter().filter(|&&r| r >= HONEST.0).count();
    let line = format!(
        "{name:15} of {:3}: {below:3} at most {}, {above:3} at least {}; 5 % {:.2}, middle {:.2}, 95 % {:.2}, most {:.2}",
        ratios.len(),
        HONEST.1,
        HONEST.0,
        at(0.05),
        at(0.5),
        at(0.95),
        at(1.0)
    );
    ([below, above], line)
}

#[test]
#[ignore = "slow"]
fn error_bars_are_honest() {
    let asked = std::env::var("FRET_ERROR_BARS").ok();
    let scenes: usize = asked.map_or(2, |n| n.parse().expect("a number of scenes"));
    let found: Vec<_> = (FIRST_SEED..).filter_map(ratios).take(scenes).collect();
    let (mut lines, mut dishonest) = (Vec::new(), Vec::new());
    for (k, (title, _, least)) in METHODS.into_iter().enumerate() {
        let of_method: Vec<_> = found.iter().map(|both| &both[k]).collect();
        lines.push(title.into());
        judge(&of_method, least, &mut lines, &mut dishonest);
    }
    println!("{}", lines.join("\n"));
    if let Ok(document) = std::env::var("FRET_ERROR_BARS_REPORT") {
        let table = format!("```text\n{}\n```\n", lines.join("\n"));
        crate::document::insert(&document, "error-bars", &table);
    }
    assert!(dishonest.is_empty(), "{}", dishonest.join("\n"));
}

/// Adds a line for each number, and those of too many large ratios, or fewer than `least` percent at least 0.2, to
/// `dishonest`.
fn judge(found: &[&Ratios], least: usize, lines: &mut Vec<String>, dishonest: &mut Vec<String>) {
    let mut all = Vec::new();
    let mut look = |name: &str, ratios: &[f64]| {
        let ([below, above], line) = summary(name, ratios);
        // Of a few numbers one more may be odd, and how many bars are too long says nothing.
        let few = ratios.len() < 20;
        let is_too_short = 100 * (below + usize::from(few)) < 95 * ratios.len();
        let least = least - 10 * usize::from(OF_RIMS.contains(&name));
        let is_too_long = !few && 100 * above < least * ratios.len();
        if is_too_short || is_too_long {
            dishonest.push(line.clone());
        }
        lines.push(line);
    };
    for (k, name) in ["p, field", "q, field"].into_iter().enumerate() {
        let ratios: Vec<f64> = found.iter().map(|(fields, _)| fields[k]).collect();
        look(name, &ratios);
    }
    for (name, ..) in NUMBERS {
        let of = found.iter().flat_map(|(_, numbers)| numbers);
        let ratios: Vec<f64> = of.filter(|(of, _)| *of == name).map(|(_, r)| *r).collect();
        if !ratios.is_empty() {
            look(name, &ratios);
            all.extend(ratios);
        }
    }
    look("all numbers", &all);
}
