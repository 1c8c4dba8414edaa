//! One scene of the campaign and what becomes of it.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::{Duration, Instant};

use contact_core::Error;
use contact_core::kernels::Stack;
use contact_core::march::Fields;
use contact_core::march::{Increment, March};
use contact_core::scene::{Body, Scene, Shape};
use contact_reference::hertz;
use ndarray::{Array2, ArrayView2, s};

use super::audit::{Audit, Violations};
use super::below;
use super::draw::{Drawn, Intent};
use super::twins::{compared, has_twins};
use super::warm;

/// A scene that takes longer is stopped: most take a second, the largest half a minute, and the
/// machine may have other things to do.
pub(crate) const LIMIT: Duration = Duration::from_mins(5);
/// Friction times [`coupling`] from which on an increment may have no solution, or many.
const STRONG: f64 = 1.0;
/// How an increment says that it took all the work that it is allowed.
const BOUND: &str = "convolutions are the most for an increment";

/// What became of a scene.
#[derive(Clone, Debug)]
pub(crate) enum Fate {
    /// Solved, with the worst of each violation and the distance of its twins over what is allowed.
    Solved(Violations, Vec<(&'static str, f64)>),
    /// Refused with the reason that it was drawn for: past friction, or off the grid; there, solved
    /// on the grid that the error asks for.
    Refused,
    /// The documented limits: [`STRONG`] friction on coupled bodies, where alternating between
    /// pressure and shear may find no solution, and the most work of an increment. Refused with the
    /// residual that is left.
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
    let mut audit = Audit::new(scene);
    let mut worst = Violations::default();
    let (mut increments, mut dissipated) = (Vec::new(), Vec::new());
    let (mut fields, mut approach) = (march.fields(), 0.0);
    while let Some(increment) = march.advance() {
        let increment = increment?;
        let found = audit.check(&march, &increment);
        if std::env::var_os("FRET_STRESS_SEED").is_some() {
            println!("{increment:?}\n{found:?}");
        }
        worst.worse(&found);
        dissipated.push(march.fields().dissipated);
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
        dissipated,
    };
    Ok((end, worst))
}

pub(crate) struct End {
    /// Fields and approach of the last increment in contact.
    pub(crate) fields: Fields,
    pub(crate) approach: f64,
    pub(crate) increments: Vec<Increment>,
    /// Energy per area that friction has taken up to the end of each \[J/m^2\].
    pub(crate) dissipated: Vec<Array2<f64>>,
}

impl End {
    /// In how many pieces each increment was solved.
    pub(crate) fn pieces(&self) -> impl Iterator<Item = usize> {
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
        (Err(Error::InvalidScene { key, .. }), Solve | Edge | OffGrid)
            if cannot_be(scene, &key) =>
        {
            return (Fate::Refused, None);
        }
        (Err(Error::InvalidScene { key, .. }), Solve) if key.starts_with("path.rolled") => {
            return (on_longer_grid(scene, stop), None);
        }
        // How far the contact of ten layers reaches is not known when a scene is drawn.
        (Err(Error::OffGrid { needed, .. }), OffGrid | Edge | Solve) => {
            return (on_grid_asked_for(scene, needed, stop), None);
        }
        (Err(error), _) => return (ended(scene, "", &error), None),
    };
    if below::is_looked_at(seed)
        && let Err(why) = below::judged(scene, &end.fields, stop)
    {
        return (Fate::Failed(why), None);
    }
    if warm::is_warmed(seed)
        && let Err(why) = warm::warmed(seed, scene, &end, stop)
    {
        return (Fate::Failed(why), None);
    }
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

/// Whether what a scene is refused for is so: a contact as wide as the bodies are round, by Hertz's
/// radius for a sphere of the mean curvature, to a tenth; or a gap that is narrowest at the border
/// of the grid.
fn cannot_be(scene: &Scene, key: &str) -> bool {
    match key {
        "path" => {
            let (R_x, R_y) = match scene.body1.shape {
                Shape::Sphere { R } => (R, R),
                Shape::Ellipsoid { R_x, R_y, .. } => (R_x, R_y),
                _ => return false,
            };
            let (one, other) = (scene.body1.substrate, scene.body2.substrate);
            let a = hertz((R_x * R_y).sqrt(), one, other, scene.path.W_max()).a;
            a > 0.9 * R_x.min(R_y)
        }
        "body1.shape" => {
            let gap = scene.h_init();
            let (nx, ny) = gap.dim();
            let inside = gap.slice(s![1..nx - 1, 1..ny - 1]);
            let lowest =
                |gaps: ArrayView2<'_, f64>| gaps.iter().copied().fold(f64::INFINITY, f64::min);
            lowest(inside) > lowest(gap.view())
        }
        _ => false,
    }
}

/// What a wave of shear does to the gap over what one of pressure does, of the wave for which it is
/// most.
fn coupling(scene: &Scene) -> f64 {
    let rigid = |body: &Body| body.substrate.is_rigid() && body.coatings.is_empty();
    let of = |body: &Body, k: f64| {
        let response = (!rigid(body)).then(|| Stack::new(body).response(k));
        response.map_or([0.0; 2], |response| [response.rz, response.zz])
    };
    let at = |k: f64| {
        let ([rz_1, zz_1], [rz_2, zz_2]) = (of(&scene.body1, k), of(&scene.body2, k));
        ((rz_1 - rz_2) / (zz_1 + zz_2)).abs()
    };
    let (extent, _) = scene.grid.extent();
    let longest = 2.0 * std::f64::consts::PI / extent;
    (1..=scene.grid.nx / 2)
        .map(|n| at(n as f64 * longest))
        .fold(0.0, f64::max)
}

/// What an error comes to: a limit that is documented, too little time, or a failure.
pub(crate) fn ended(scene: &Scene, of: &str, error: &Error) -> Fate {
    let strong = scene.friction.mu * coupling(scene) > STRONG;
    match error {
        Error::Interrupted { .. } => Fate::Stopped,
        // Right is the reason of an error whose numbers say that the tolerance was missed.
        Error::NotConverged {
            solver: "coupled",
            residual,
            tolerance,
            ..
        } if strong && residual > tolerance => Fate::Unsolved(format!("{of}{error}")),
        Error::NotConverged {
            residual,
            tolerance,
            why,
            ..
        } if residual > tolerance && why.contains(BOUND) => Fate::Unsolved(format!("{of}{error}")),
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

/// A scene whose contact would roll off its grid, with as many cells again along x.
fn on_longer_grid(scene: &Scene, stop: &Arc<AtomicBool>) -> Fate {
    let mut longer = scene.clone();
    longer.grid.nx *= 2;
    match audited(&longer, stop) {
        Ok((_, violations)) if violations.hold() => Fate::Refused,
        Ok((_, violations)) => Fate::Failed(format!("on a longer grid: {violations:?}")),
        Err(error) => ended(scene, "on a longer grid: ", &error),
    }
}

/// The scene on a grid of as many cells that is as long and as wide as needed.
fn widened(scene: &Scene, needed: f64) -> Scene {
    let mut scene = scene.clone();
    let grid = &mut scene.grid;
    let longer = (needed / grid.extent().0).max(1.0);
    grid.dx *= longer;
    grid.dy = grid.dy.max(needed / grid.ny as f64);
    for branch in &mut scene.path.branches {
        branch.to.rolled *= longer;
    }
    scene
}
