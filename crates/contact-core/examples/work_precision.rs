//! Work against error of a load path: time of the choice of increments and of all, work counters
//! and error of p and q, as CSV.
//!
//! Runs a scene under several settings and compares the tractions at the ends of its branches with
//! those of the last run, the reference. Arguments: the scene file, settings common to all runs
//! (`grid.n=128`), and after each `--` the settings of one run; the last is the reference:
//!
//! ```text
//! work_precision scenes/coated_fretting.toml grid.n=128 -- solver.tolerance=1e-5 \
//!     -- solver.tolerance=1e-7
//! ```
#![allow(clippy::print_stdout)]

use std::time::Instant;

use contact_core::estimate::choose_increments;
use contact_core::march::{Increment, March, Observer, solve};
use contact_core::{Error, Scene};
use ndarray::Array2;

/// The tractions at the end of every branch.
#[derive(Default)]
struct Ends {
    p: Vec<Array2<f64>>,
    q: Vec<[Array2<f64>; 2]>,
}

impl Observer for Ends {
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if increment.point.ends_branch {
            let fields = march.fields();
            self.p.push(fields.p);
            self.q.push([fields.q_x, fields.q_y]);
        }
        Ok(())
    }
}

struct Run {
    settings: String,
    /// Time of the choice of increments, and of all.
    seconds: [f64; 2],
    increments: Vec<Increment>,
    ends: Ends,
}

fn run(file: &str, settings: &[String], name: String) -> Result<Run, Error> {
    let scene = Scene::from_file(file, settings)?;
    let mut ends = Ends::default();
    let start = Instant::now();
    let scene = choose_increments(&scene, &std::sync::Arc::default())?;
    let chosen = start.elapsed().as_secs_f64();
    let increments = solve(&scene, &mut ends)?;
    Ok(Run {
        settings: name,
        seconds: [chosen, start.elapsed().as_secs_f64()],
        increments,
        ends,
    })
}

/// ||a - b|| / ||b||
fn relative<'a>(pairs: impl Iterator<Item = (&'a Array2<f64>, &'a Array2<f64>)>) -> f64 {
    let (mut difference, mut size) = (0.0, 0.0);
    for (a, b) in pairs {
        difference += a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>();
        size += b.iter().map(|b| b * b).sum::<f64>();
    }
    (difference / size).sqrt()
}

impl Run {
    /// Errors of p and of q: the largest of all branch ends past the first, and q after the first.
    fn errors(&self, reference: &Self) -> [f64; 3] {
        let ends = 0..self.ends.p.len();
        let p = |i: usize| relative(std::iter::once((&self.ends.p[i], &reference.ends.p[i])));
        let q = |i: usize| relative(self.ends.q[i].iter().zip(&reference.ends.q[i]));
        [
            ends.clone().map(p).fold(0.0, f64::max),
            ends.skip(1).map(q).fold(0.0, f64::max),
            q(0),
        ]
    }

    fn print(&self, reference: &Self) {
        let count = self.increments.len();
        let sum = |of: &dyn Fn(&Increment) -> f64| self.increments.iter().map(of).sum::<f64>();
        let [p, q, q_first] = self.errors(reference);
        let cells = self.increments.iter().map(|i| i.path_grid).max();
        let cells = cells.unwrap_or(1) as f64;
        // In convolutions on the grid of the scene.
        let work = |i: &Increment| i.work.convolutions * (i.path_grid as f64 / cells).powi(2);
        println!(
            "\"{}\",{count},{:.3},{:.3},{:.0},{:.2},{:.2},{:.2},{:.2},{p:.2e},{q:.2e},{q_first:.2e}",
            self.settings.replace('"', "\"\""),
            self.seconds[0],
            self.seconds[1],
            sum(&work),
            sum(&work) / count as f64,
            sum(&|i| i.work.alternations as f64) / count as f64,
            sum(&|i| i.work.normal_iterations as f64) / count as f64,
            sum(&|i| i.work.tangential_iterations as f64) / count as f64,
        );
    }
}

fn main() -> Result<(), Error> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut groups = arguments.split(|a| a == "--");
    let common = groups.next().unwrap_or_default();
    let (file, common) = match common.split_first() {
        Some((file, common)) => (file.as_str(), common),
        None => ("scenes/coated_fretting.toml", common),
    };
    let mut runs = Vec::new();
    for group in groups {
        let settings = [common, group].concat();
        runs.push(run(file, &settings, group.join(" "))?);
    }
    println!(
        "settings,increments,choice,seconds,convolutions,per_increment,alternations,normal,tangential,\
         error_p,error_q,error_q_first"
    );
    if let Some(reference) = runs.last() {
        for run in &runs {
            run.print(reference);
        }
    }
    Ok(())
}
