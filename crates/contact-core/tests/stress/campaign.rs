//! One scene of the campaign and what becomes of it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use contact_core::march::{Increment, March};
use contact_core::scene::{Loads, Scene};
use contact_core::{Error, march::Fields};
use ndarray::Array2;

use crate::audit::{Audit, Violations};
use crate::draw::{Drawn, Intent};

/// A scene that takes longer is stopped.
const LIMIT: Duration = Duration::from_mins(1);
/// How far twins may differ that were solved to 1e-6: waves of a few cells make of a misfit a
/// hundred times as much traction.
const ALIKE: f64 = 100.0;

/// What became of a scene.
#[derive(Clone, Debug)]
pub(crate) enum Fate {
    /// Solved, with the worst of each violation and the distance of its twins over what is allowed.
    Solved(Violations, Vec<(&'static str, f64)>),
    /// Refused before anything was solved, or off the grid, as it was drawn to be.
    Refused,
    /// An error that it was not drawn for.
    Failed(String),
    /// A panic.
    Panicked(String),
}

#[derive(Clone, Debug)]
pub(crate) struct Outcome {
    pub(crate) seed: u64,
    pub(crate) fate: Fate,
    pub(crate) increments: usize,
    pub(crate) in_pieces: usize,
    pub(crate) convolutions: f64,
    pub(crate) seconds: f64,
}

/// Runs a scene and audits every increment.
fn audited(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<(End, Violations), Error> {
    let mut march = March::new(scene)?;
    march.stop_on(stop.clone());
    let mut audit = Audit::new(&march);
    let mut worst = Violations::default();
    let mut increments = Vec::new();
    while let Some(increment) = march.advance() {
        let increment = increment?;
        worst.worse(&audit.check(&march, &increment));
        increments.push(increment);
    }
    let fields = march.fields();
    Ok((End { fields, increments }, worst))
}

struct End {
    fields: Fields,
    increments: Vec<Increment>,
}

/// Solves a scene and, of every fourth, its twins.
pub(crate) fn outcome(seed: u64, drawn: &Drawn) -> Outcome {
    let begun = Instant::now();
    let stop = Arc::<AtomicBool>::default();
    let (done, watched) = channel::<()>();
    let (fate, end) = thread::scope(|scope| {
        let flag = stop.clone();
        scope.spawn(move || {
            if let Err(RecvTimeoutError::Timeout) = watched.recv_timeout(LIMIT) {
                flag.store(true, Ordering::Relaxed);
            }
        });
        let result = catch_unwind(AssertUnwindSafe(|| fate(seed, drawn, &stop)));
        drop(done);
        result.unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().cloned();
            let text = text.or_else(|| panic.downcast_ref::<&str>().map(ToString::to_string));
            (Fate::Panicked(text.unwrap_or_default()), None)
        })
    });
    let increments = end.map(|end| end.increments).unwrap_or_default();
    Outcome {
        seed,
        fate,
        increments: increments.len(),
        in_pieces: increments.iter().filter(|i| i.work.parts > 1).count(),
        convolutions: increments.iter().map(|i| i.work.convolutions).sum(),
        seconds: begun.elapsed().as_secs_f64(),
    }
}

fn fate(seed: u64, drawn: &Drawn, stop: &Arc<AtomicBool>) -> (Fate, Option<End>) {
    let scene = &drawn.scene;
    let (end, violations) = match (audited(scene, stop), drawn.intent) {
        (Ok(solved), Intent::Solve) => solved,
        (Ok(_), intent) => return (Fate::Failed(format!("solved in spite of {intent:?}")), None),
        (Err(Error::InvalidScene { .. } | Error::BeyondFriction { .. }), Intent::PastFriction)
        | (Err(Error::OffGrid { .. }), Intent::OffGrid) => return (Fate::Refused, None),
        (Err(error), _) => return (Fate::Failed(error.to_string()), None),
    };
    let mut twins = Vec::new();
    if seed.is_multiple_of(4) {
        let allowed = ALIKE * scene.settings.solver.tolerance;
        for (name, twin, map) in twins_of(scene) {
            let distance = match audited(&twin, stop) {
                Ok((theirs, _)) => distance(&end, &theirs, &*map) / allowed,
                Err(error) => return (Fate::Failed(format!("{name} twin: {error}")), None),
            };
            twins.push((name, distance));
        }
    }
    (Fate::Solved(violations, twins), Some(end))
}

/// p, q_x, q_y of a twin as those of the scene, and the factor of the twin's lengths.
type Mapped = ([Array2<f64>; 3], f64);
/// How the fields of a twin are mapped back.
type Back = Box<dyn Fn(&Fields) -> Mapped>;

fn twins_of(scene: &Scene) -> Vec<(&'static str, Scene, Back)> {
    let mut twins: Vec<(&'static str, Scene, Back)> = Vec::new();
    let with_loads = |f: &dyn Fn(Loads) -> Loads| {
        let mut twin = scene.clone();
        for branch in &mut twin.path.branches {
            branch.to = f(branch.to);
        }
        twin
    };

    // Lengths a thousandth, moduli sixty-four times.
    let (length, modulus) = (1e-3, 64.0);
    let force = modulus * length * length;
    let mut scaled = with_loads(&|l| Loads {
        W: l.W * force,
        T_x: l.T_x * force,
        T_y: l.T_y * force,
        ..l
    });
    for body in [&mut scaled.body1, &mut scaled.body2] {
        if let contact_core::scene::Shape::Sphere { R } = &mut body.shape {
            *R *= length;
        }
        body.substrate.E *= modulus;
        for coating in &mut body.coatings {
            coating.material.E *= modulus;
            coating.thickness *= length;
        }
    }
    scaled.grid.dx *= length;
    scaled.grid.dy *= length;
    twins.push((
        "scaled",
        scaled,
        Box::new(move |f| {
            let back = |f: &Array2<f64>| f / modulus;
            ([back(&f.p), back(&f.q_x), back(&f.q_y)], length)
        }),
    ));

    let mirrored = with_loads(&|l| Loads { T_y: -l.T_y, ..l });
    let flip = |f: &Array2<f64>, sign: f64| f.slice(ndarray::s![.., ..;-1]).mapv(|v| sign * v);
    twins.push((
        "mirrored",
        mirrored,
        Box::new(move |f| {
            (
                [flip(&f.p, 1.0), flip(&f.q_x, 1.0), flip(&f.q_y, -1.0)],
                1.0,
            )
        }),
    ));

    // A quarter turn: x to y, y to -x.
    let mut rotated = with_loads(&|l| Loads {
        T_x: -l.T_y,
        T_y: l.T_x,
        ..l
    });
    (rotated.grid.nx, rotated.grid.ny) = (scene.grid.ny, scene.grid.nx);
    (rotated.grid.dx, rotated.grid.dy) = (scene.grid.dy, scene.grid.dx);
    let turn = |f: &Array2<f64>| f.slice(ndarray::s![..;-1, ..]).t().to_owned();
    twins.push((
        "rotated",
        rotated,
        Box::new(move |f| ([turn(&f.p), turn(&f.q_y), -turn(&f.q_x)], 1.0)),
    ));
    twins
}

/// L2 distance of the tractions over the norm of p (of mu p for shear below one), and of the approach.
fn distance(ours: &End, theirs: &End, back: &dyn Fn(&Fields) -> Mapped) -> f64 {
    let norm = |f: &Array2<f64>| f.iter().map(|v| v * v).sum::<f64>().sqrt();
    let ([p, q_x, q_y], length) = back(&theirs.fields);
    let f = &ours.fields;
    let scale = norm(&f.p).max(f64::MIN_POSITIVE);
    let tractions = [
        norm(&(p - &f.p)),
        norm(&(q_x - &f.q_x)),
        norm(&(q_y - &f.q_y)),
    ];
    let tractions = tractions.into_iter().fold(0.0, f64::max) / scale;
    let approach = |end: &End| {
        end.increments
            .iter()
            .fold(0.0_f64, |m, i| m.max(i.motion.delta_z))
    };
    tractions.max((approach(theirs) / length / approach(ours) - 1.0).abs())
}
