//! One scene of the campaign and what becomes of it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use contact_core::Error;
use contact_core::march::Fields;
use contact_core::march::{Increment, March};
use contact_core::plan::Plan;
use contact_core::scene::{Loads, Scene};
use ndarray::Array2;

use crate::audit::{Audit, Violations};
use crate::draw::{Drawn, Intent, SHAPED};
use crate::misfit::{Misfit, norm};

/// A scene that takes longer is stopped: most take a second, the largest half a minute, and the
/// machine may have other things to do.
pub(crate) const LIMIT: Duration = Duration::from_mins(5);
/// Friction from which on the limit of the alternation is known.
const STRONG: f64 = 2.0;
/// What became of a scene.
#[derive(Clone, Debug)]
pub(crate) enum Fate {
    /// Solved, with the worst of each violation and the distance of its twins over what is allowed.
    Solved(Violations, Vec<(&'static str, f64)>),
    /// Refused with the reason that it was drawn for: past friction, or off the grid; there, solved
    /// on the grid that the error asks for.
    Refused,
    /// The documented limit: friction above [`STRONG`] on coupled bodies, where alternating between
    /// pressure and shear may find no solution. Refused with the residual that is left.
    Unsolved(String),
    /// Did not end within its time.
    Stopped,
    /// An error that it was not drawn for, or one whose reason is wrong.
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
pub(crate) fn audited(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<(End, Violations), Error> {
    let mut march = March::new(scene)?;
    march.stop_on(stop.clone());
    let mut audit = Audit::new(&march);
    let mut worst = Violations::default();
    let mut increments = Vec::new();
    let (mut fields, mut approach) = (march.fields(), 0.0);
    while let Some(increment) = march.advance() {
        let increment = increment?;
        let found = audit.check(&march, &increment);
        if std::env::var_os("FRET_STRESS_SEED").is_some() {
            println!("{increment:?}\n{found:?}");
        }
        worst.worse(&found);
        if increment.contact_area > 0.0 {
            fields = march.fields();
            approach = increment.motion.delta_z;
        }
        increments.push(increment);
    }
    let end = End {
        fields,
        approach,
        increments,
    };
    Ok((end, worst))
}

pub(crate) struct End {
    /// Fields and approach of the last increment in contact.
    pub(crate) fields: Fields,
    approach: f64,
    pub(crate) increments: Vec<Increment>,
}

impl End {
    /// In how many pieces each increment was solved.
    fn pieces(&self) -> impl Iterator<Item = usize> {
        self.increments.iter().map(|i| i.work.parts)
    }
}

/// Solves a scene and, of every second with a sphere, its twins, within `limit`.
pub(crate) fn outcome(seed: u64, drawn: &Drawn, limit: Duration) -> Outcome {
    let begun = Instant::now();
    let stop = Arc::<AtomicBool>::default();
    let (done, watched) = channel::<()>();
    let (fate, end) = thread::scope(|scope| {
        let flag = stop.clone();
        scope.spawn(move || {
            if let Err(RecvTimeoutError::Timeout) = watched.recv_timeout(limit) {
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
    use Intent::{Edge, OffGrid, PastFriction, Solve};
    let scene = &drawn.scene;
    let (end, violations) = match (audited(scene, stop), drawn.intent) {
        (Ok(solved), Solve | Edge) => solved,
        (Ok(_), intent) => return (Fate::Failed(format!("solved in spite of {intent:?}")), None),
        (Err(Error::InvalidScene { .. } | Error::BeyondFriction { .. }), PastFriction) => {
            return (Fate::Refused, None);
        }
        // How far the contact of ten layers reaches is not known when a scene is drawn.
        (Err(Error::OffGrid { needed, .. }), OffGrid | Edge | Solve) => {
            return (on_grid_asked_for(scene, needed, stop), None);
        }
        (Err(error), _) => return (ended(scene, "", &error), None),
    };
    let twins = if has_twins(seed) {
        compared(scene, &end, stop)
    } else {
        Ok(Vec::new())
    };
    match twins {
        Ok(twins) => (Fate::Solved(violations, twins), Some(end)),
        Err(fate) => (fate, None),
    }
}

/// Whether a scene is compared with its twins.
pub(crate) fn has_twins(seed: u64) -> bool {
    seed.is_multiple_of(2) && seed < SHAPED
}

/// Twins of a scene.
pub(crate) const TWINS: usize = 3;

/// The name of twins that are alike without the turn of the slip only.
pub(crate) const UNTURNED: &str = "unturned";

/// The distances of the twins of a scene that take the same path: not those of which an increment
/// is solved in more pieces. Where the turn of the slip cannot be followed to the end the solution
/// depends on how far it was: a pair that differs is compared without it.
fn compared(
    scene: &Scene,
    ours: &End,
    stop: &Arc<AtomicBool>,
) -> Result<Vec<(&'static str, f64)>, Fate> {
    let misfit = Misfit::of(scene);
    let run = |name: &str, scene: &Scene| match audited(scene, stop) {
        Ok((end, _)) => Ok(end),
        Err(error) => Err(ended(scene, &format!("{name} twin: "), &error)),
    };
    let unturned = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.settings.solver.turning = false;
        run("unturned", &scene)
    };
    let mut distances = Vec::new();
    for (name, twin, back) in twins_of(scene) {
        let theirs = run(name, &twin)?;
        if !theirs.pieces().eq(ours.pieces()) {
            continue;
        }
        let off = difference(ours, &theirs, &*back, &misfit);
        distances.push(if off <= 1.0 {
            (name, off)
        } else {
            let (ours, theirs) = (unturned(scene)?, unturned(&twin)?);
            (UNTURNED, difference(&ours, &theirs, &*back, &misfit))
        });
    }
    Ok(distances)
}

/// What an error comes to: a limit that is documented, too little time, or a failure.
fn ended(scene: &Scene, of: &str, error: &Error) -> Fate {
    let strong = scene.friction.mu > STRONG && Plan::new(scene).coupling;
    match error {
        Error::Interrupted { .. } => Fate::Stopped,
        // Right is the reason of an error whose numbers say that the tolerance was missed.
        Error::NotConverged {
            solver: "coupled",
            residual,
            tolerance,
            ..
        } if strong && residual > tolerance => Fate::Unsolved(format!("{of}{error}")),
        _ => Fate::Failed(format!("{of}{error}")),
    }
}

/// How often a grid may be asked for anew: the first answer knows of the normal load alone, and
/// shear stretches the contact where friction and coupling are strong.
const ANSWERS: usize = 2;

/// A scene whose contact left its grid, on the grid that the error asks for.
fn on_grid_asked_for(scene: &Scene, mut needed: f64, stop: &Arc<AtomicBool>) -> Fate {
    for answer in 1..=ANSWERS {
        match audited(&widened(scene, needed), stop) {
            Ok(_) => return Fate::Refused,
            Err(Error::OffGrid { needed: more, .. }) if answer < ANSWERS => needed = more,
            Err(error) => return ended(scene, "on the grid asked for: ", &error),
        }
    }
    Fate::Failed("no grid asked for is large enough".into())
}

/// The scene on a grid of as many cells that is as long and as wide as needed.
fn widened(scene: &Scene, needed: f64) -> Scene {
    let mut scene = scene.clone();
    let grid = &mut scene.grid;
    grid.dx = grid.dx.max(needed / grid.nx as f64);
    grid.dy = grid.dy.max(needed / grid.ny as f64);
    scene
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

/// What a twin differs by over what two solutions within the tolerance may differ by.
fn difference(ours: &End, theirs: &End, back: &dyn Fn(&Fields) -> Mapped, misfit: &Misfit) -> f64 {
    let ([p, q_x, q_y], length) = back(&theirs.fields);
    let f = &ours.fields;
    let pressure = norm(&(p - &f.p)) / misfit.pressure(f);
    let allowed = misfit
        .shear(f, ours.increments.len())
        .max(f64::MIN_POSITIVE);
    let shear = norm(&(q_x - &f.q_x)).hypot(norm(&(q_y - &f.q_y))) / allowed;
    let approach = (theirs.approach / length - ours.approach).abs() / misfit.approach(f);
    pressure.max(shear).max(approach)
}
