//! What each numerical method buys: it is switched off alone, on seven scenes.
//!
//! Writes a table in Markdown to standard output (`make ablation` writes `docs/ablation.md`).
//! Errors are those against the same scene with many more increments and a tolerance of 1e-7, with
//! all methods: of the shear in the L2 norm, over the largest of the path, and of radii in cells.
//! Times are those of the processor on one thread, the least of three runs as a ratio to the least of
//! three with all methods, run in turn with them; of busy threads elapsed times on all threads.
//! Convolutions are counted.
#![allow(clippy::print_stdout)]

mod scenes;

use std::sync::Arc;
use std::time::{Duration, Instant};

use contact_core::Error;
use contact_core::march::{Increment, March, Tractions};
use contact_core::plan::{Methods, Plan};
use contact_core::scene::Scene;
use cpu_time::ProcessTime;
use ndarray::Array2;
use rayon::ThreadPoolBuilder;

use scenes::{Trial, trials};

/// A method: how it is switched off, and the files that it costs.
struct Method {
    name: &'static str,
    off: fn(&mut Methods),
    files: &'static [&'static str],
}

impl Method {
    /// Whether it is there for several threads.
    fn is_of_threads(&self) -> bool {
        self.name == "busy threads"
    }
}

const METHODS: [Method; 15] = [
    Method {
        name: "preconditioner",
        off: |m| m.preconditioner = false,
        files: &["convolution/preconditioner.rs"],
    },
    Method {
        name: "window around the contact",
        off: |m| m.window = false,
        files: &[
            "march/domain/fit.rs",
            "march/domain/shape.rs",
            "march/domain/embed.rs",
            "march/domain/beyond.rs",
        ],
    },
    Method {
        name: "single precision",
        off: |m| m.single_precision = false,
        files: &[
            "solvers/intermediate/precision.rs",
            "convolution/precision.rs",
        ],
    },
    Method {
        name: "busy threads",
        off: |m| m.busy_threads = false,
        files: &["march/threads.rs"],
    },
    Method {
        name: "extrapolation",
        off: |m| m.extrapolation = false,
        files: &["march/guess.rs"],
    },
    Method {
        name: "first contact of a paraboloid",
        off: |m| m.first_contact = false,
        files: &["march/first_pressure.rs"],
    },
    Method {
        name: "growth in steps",
        off: |m| m.growth_steps = 1,
        files: &["march/growing.rs"],
    },
    Method {
        name: "entry of cells",
        off: |m| m.entry = false,
        files: &[
            "march/entry/mod.rs",
            "march/entry/first_contact.rs",
            "march/entry/equations.rs",
            "march/entry/kept_contact.rs",
            "march/entry/motion.rs",
        ],
    },
    Method {
        name: "order of entry",
        off: |m| m.order_of_entry = false,
        files: &[
            "march/entry/order.rs",
            "march/entry/view.rs",
            "march/entry/screened.rs",
            "march/entry/neighbours.rs",
            "march/entry/least_squares.rs",
        ],
    },
    Method {
        name: "turn of the slip",
        off: |m| m.slip_rotation = false,
        files: &["solvers/no_slip/turn.rs"],
    },
    Method {
        name: "correction of the residual slip",
        off: |m| m.residual_slip = false,
        files: &[],
    },
    Method {
        name: "inexact inner loops",
        off: |m| m.inexact = false,
        files: &[],
    },
    Method {
        name: "slip of new cells",
        off: |m| m.new_cells_slip = false,
        files: &[],
    },
    Method {
        name: "Anderson acceleration",
        off: |m| m.anderson = false,
        files: &["solvers/intermediate/anderson.rs"],
    },
    Method {
        name: "partial cells at borders",
        off: |m| m.partial_cells = false,
        files: &[
            "march/accounts/areas.rs",
            "zones/level.rs",
            "zones/edge.rs",
            "zones/parabola.rs",
        ],
    },
];

/// A run: its increments, and the tractions at the ends of the branches.
struct Run {
    increments: Vec<Increment>,
    ends: Vec<Tractions>,
    elapsed: Duration,
    processor: Duration,
}

fn run(scene: &Scene, off: impl Fn(&mut Methods)) -> Result<Run, Error> {
    let mut plan = Plan::new(scene);
    off(&mut plan.methods);
    let mut march = March::planned(scene, plan, &Arc::default())?;
    let (begun, processor) = (Instant::now(), ProcessTime::now());
    let (mut increments, mut ends) = (Vec::new(), Vec::new());
    while let Some(increment) = march.advance() {
        let increment = increment?;
        if increment.point.ends_branch {
            ends.push(march.tractions());
        }
        increments.push(increment);
    }
    Ok(Run {
        increments,
        ends,
        elapsed: begun.elapsed(),
        processor: processor.elapsed(),
    })
}

/// Repetitions of a run that is timed.
const REPETITIONS: usize = 3;

/// A run with a method switched off, and its time over that with all methods.
fn timed(scene: &Scene, method: &Method) -> Result<(Run, f64), Error> {
    let threads = ThreadPoolBuilder::new();
    let pool = if method.is_of_threads() {
        threads.build()
    } else {
        threads.num_threads(1).build()
    };
    let pool = pool.expect("threads");
    let time = |run: &Run| {
        if method.is_of_threads() {
            run.elapsed
        } else {
            run.processor
        }
    };
    pool.install(|| {
        let off = run(scene, method.off)?;
        let (mut least, mut with_all) = (time(&off), Duration::MAX);
        for _ in 0..REPETITIONS {
            with_all = with_all.min(time(&run(scene, |_| {})?));
            least = least.min(time(&run(scene, method.off)?));
        }
        Ok((off, least.as_secs_f64() / with_all.as_secs_f64()))
    })
}

/// Squares of the shear.
fn squares([_, x, y]: &Tractions) -> f64 {
    let sum = |f: &Array2<f64>| f.iter().map(|f| f * f).sum::<f64>();
    sum(x) + sum(y)
}

impl Run {
    fn convolutions(&self) -> f64 {
        self.increments.iter().map(|i| i.work.convolutions).sum()
    }

    /// Errors of the shear after the first branch and at the ends of the others, over the largest
    /// of the path, and of the radii of contact and stick zone, in cells.
    fn errors(&self, reference: &Self, cell: f64) -> [f64; 4] {
        let pairs = self.ends.iter().zip(&reference.ends);
        let off = pairs.map(|(a, b)| squares(&[0, 1, 2].map(|k| &a[k] - &b[k])).sqrt());
        let largest = reference
            .ends
            .iter()
            .map(squares)
            .fold(0.0, f64::max)
            .sqrt();
        let off: Vec<f64> = off.map(|off| off / largest).collect();
        let ends = |run: &Self| -> Vec<[f64; 2]> {
            let ends = run.increments.iter().filter(|i| i.point.ends_branch);
            let radius = |area: f64| (area / std::f64::consts::PI).sqrt();
            ends.map(|i| [radius(i.contact_area), radius(i.stick_area)])
                .collect()
        };
        let (radii, truths) = (ends(self), ends(reference));
        let radius = |k: usize| {
            let off = radii
                .iter()
                .zip(&truths)
                .map(|(a, b)| (a[k] - b[k]).abs() / cell);
            off.fold(0.0, f64::max)
        };
        let later = off.iter().skip(1).copied().fold(0.0, f64::max);
        [off[0], later, radius(0), radius(1)]
    }
}

/// Lines of code of files under `src`.
fn lines(files: &[&str]) -> usize {
    let source = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let text =
        |file: &&str| std::fs::read_to_string(source.join(file)).expect("a file of a method");
    files.iter().map(|file| text(file).lines().count()).sum()
}

fn table(trial: &Trial) -> Result<(), Error> {
    let cell = trial.scene.grid.dx;
    let reference = run(&trial.reference, |_| {})?;
    let all = run(&trial.scene, |_| {})?;
    println!("\n## {}\n", trial.name);
    println!(
        "{} increments; reference {} increments.\n",
        all.increments.len(),
        reference.increments.len()
    );
    println!(
        "| switched off | lines | convolutions | time | q after the first branch | q at the ends | contact radius | stick radius |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let row = |name: &str, lines: usize, run: &Run, time: f64| {
        let [first, later, a, c] = run.errors(&reference, cell);
        println!(
            "| {name} | {lines} | {:.0} ({:+.0} %) | {time:.2} | {first:.1e} | {later:.1e} | {a:.3} | {c:.3} |",
            run.convolutions(),
            100.0 * (run.convolutions() / all.convolutions() - 1.0),
        );
    };
    row("nothing", 0, &all, 1.0);
    for method in &METHODS {
        let lines = lines(method.files);
        match timed(&trial.scene, method) {
            Ok((run, time)) => row(method.name, lines, &run, time),
            Err(failure) => println!("| {} | {lines} | {failure} | | | | | |", method.name),
        }
    }
    Ok(())
}

fn main() -> Result<(), Error> {
    println!("{}", include_str!("introduction.md").trim_end());
    let only = std::env::args().nth(1);
    for trial in trials()? {
        if only
            .as_ref()
            .is_none_or(|only| trial.name.contains(only.as_str()))
        {
            table(&trial)?;
        }
    }
    Ok(())
}
