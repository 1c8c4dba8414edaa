//! A flag that is raised at any moment of an increment: how much is still computed. What is known
//! of the cells beyond the window without a check. Displacements and tractions.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::{Increment, March, State};
use crate::convolution::{Convolutions, Displacements, SurfaceOperator, Tractions};
use crate::error::Error;
use crate::scene::Scene;
use crate::solvers::Response;
use crate::solvers::intermediate::AlternationInfo;

/// A coated contact with friction that turns back after partial slip.
const COATED: &str = r#"
schema = 1
body1 = { shape.sphere.R = 0.018, E = 210e9, nu = 0.3 }
friction.mu = 0.3
grid = { n = 32, extent = { a_H = 2.4 } }
path = [
    { W = 1000.0, increments = 2 },
    { T_x = { mu_W = 0.9 }, increments = 1 },
    { T_x = { mu_W = -0.9 }, increments = 1 },
]
[body2]
shape = "flat"
E = 210e9
nu = 0.3
coatings = [{ E = { E_substrate = 4.0 }, nu = 0.3, thickness = { a_H = 1.0 } }]
"#;

/// Convolutions that may follow the raising of the flag: one that ends what the solver of the
/// pressure was at, and one each that takes the shear and its change along.
const LATE: usize = 3;
/// Moments tried in an increment.
const TRIALS: usize = 30;

/// Convolutions of an increment, and when the flag is to be raised.
struct Clock {
    stop: Arc<AtomicBool>,
    raised_at: usize,
    done: AtomicUsize,
}

/// An operator that raises the flag in the middle of one of its convolutions.
struct Clocked {
    op: Box<dyn SurfaceOperator>,
    clock: Arc<Clock>,
}

impl Clocked {
    fn tick(&self) {
        if self.clock.done.fetch_add(1, Ordering::Relaxed) + 1 == self.clock.raised_at {
            self.clock.stop.store(true, Ordering::Relaxed);
        }
    }
}

impl SurfaceOperator for Clocked {
    fn shape(&self) -> (usize, usize) {
        self.op.shape()
    }

    fn apply(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        self.tick();
        self.op.apply(tractions, displacements);
    }

    fn respond(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        self.tick();
        self.op.respond(tractions, displacements);
    }

    fn rounding(&self) -> f64 {
        self.op.rounding()
    }

    fn work(&self) -> Convolutions {
        self.op.work()
    }

    fn is_coupled(&self) -> bool {
        self.op.is_coupled()
    }

    fn self_coefficients(&self) -> (f64, f64) {
        self.op.self_coefficients()
    }
}

/// The increment after `state`, the flag being raised in that convolution (0: never): how it ended,
/// its convolutions, and the march after it.
fn stopped(
    scene: &Scene,
    state: &State,
    raised_at: usize,
) -> (Result<Increment, Error>, usize, March) {
    let mut march = March::resume(scene, state.clone()).unwrap();
    let clock = Arc::new(Clock {
        stop: Arc::default(),
        raised_at,
        done: AtomicUsize::new(0),
    });
    march.stop_on(clock.stop.clone());
    let grid = &scene.grid;
    let clocked = |shape| {
        let mut window = march.domain.laid_out(&march.problem, shape, 0).unwrap();
        window.op = Box::new(Clocked {
            op: window.op,
            clock: clock.clone(),
        });
        window
    };
    let window = clocked(state.window);
    // The window that it may become.
    let whole = clocked((grid.nx, grid.ny));
    march.domain.window = window;
    *march.domain.whole.get_mut().unwrap() = Some(whole);
    let ended = march.advance().unwrap();
    (ended, clock.done.load(Ordering::Relaxed), march)
}

#[test]
fn a_raised_flag_ends_an_increment_within_three_convolutions() {
    for settings in [&[][..], &["solver.preset=\"spinu2020\""]] {
        let settings: Vec<_> = settings.iter().map(ToString::to_string).collect();
        let scene = Scene::from_toml_str(COATED, "coated.toml", &settings).unwrap();
        let mut march = March::new(&scene).unwrap();
        for increment in 0..march.points().len() {
            let state = march.state().clone();
            let (ended, convolutions, _) = stopped(&scene, &state, 0);
            assert!(ended.is_ok());
            let mut interrupted = 0;
            let moments = (1..=convolutions).step_by(1 + convolutions / TRIALS);
            for raised_at in moments.clone() {
                let (ended, done, march) = stopped(&scene, &state, raised_at);
                let late = done - raised_at;
                assert!(
                    late <= LATE,
                    "{late} more after {raised_at} of {convolutions}"
                );
                if ended.is_err() {
                    assert_eq!(ended, Err(Error::Interrupted { increment }));
                    assert!(*march.state() == state);
                    interrupted += 1;
                }
            }
            // Only what accounts for the solution cannot be interrupted.
            let tried = moments.count();
            assert!(interrupted + LATE >= tried, "{interrupted} of {tried}");
            march.advance().unwrap().unwrap();
        }
    }
}

/// A contact that outgrows its window while it is solved.
#[test]
fn a_flag_raised_in_a_wider_window_leaves_the_state_of_the_narrow_one() {
    let settings = [
        "path=[{ W = 200.0, increments = 1 }, { W = 1000.0, increments = 1 }]",
        "grid.n=64",
    ];
    let settings: Vec<_> = settings.iter().map(ToString::to_string).collect();
    let scene = Scene::from_toml_str(COATED, "coated.toml", &settings).unwrap();
    let mut march = March::new(&scene).unwrap();
    march.advance().unwrap().unwrap();
    let narrow = march.state().clone();
    let wide = march.advance().unwrap().unwrap();
    assert_ne!(march.domain.shape(), narrow.window);

    let (_, convolutions, _) = stopped(&scene, &narrow, 0);
    let mut widened = 0;
    for raised_at in 1..=convolutions {
        let (ended, _, march) = stopped(&scene, &narrow, raised_at);
        if ended.is_ok() || march.domain.shape() == narrow.window {
            continue;
        }
        widened += 1;
        assert!(*march.state() == narrow);
        // Fields can be had all the same, and the run goes on as if it had not been stopped.
        assert_eq!(march.fields().p.dim(), (64, 64));
        let mut again = March::resume(&scene, march.state().clone()).unwrap();
        assert_eq!(again.advance(), Some(Ok(wide)));
    }
    assert!(widened > 0);
}

/// Coefficients are there; the window of the first increment is not.
#[test]
fn a_raised_flag_lays_out_no_window() {
    let frequency_domain = "kernel.method={ frequency_domain = { lambda = 2 } }".to_owned();
    for settings in [&[][..], &[frequency_domain]] {
        let scene = Scene::from_toml_str(COATED, "coated.toml", settings).unwrap();
        let march = March::new(&scene).unwrap();
        let stop = AtomicBool::new(true);
        let kernels = &march.domain.kernels;
        let window = kernels.window(&scene, march.plan(), (32, 32), &stop);
        assert!(window.is_err_and(|e| e == Error::Interrupted { increment: 0 }));
    }
}

/// The gap beyond the window is never smaller than what is known of it, and mostly it is not looked
/// at.
#[test]
fn cells_beyond_the_window_are_as_far_as_they_are_known_to_be() {
    let overrides = ["grid.n=96", "grid.extent.a_H=5.0", "path.0.increments=8"];
    let settings = overrides
        .into_iter()
        .chain(["path.1.increments=12", "path.2.increments=12"]);
    let settings: Vec<String> = settings.map(str::to_owned).collect();
    let scene = Scene::from_toml_str(COATED, "coated", &settings).unwrap();
    let mut march = March::new(&scene).unwrap();
    let (mut increments, mut not_looked) = (0, 0);
    while let Some(increment) = march.advance() {
        increment.unwrap();
        assert_ne!(march.domain.shape(), (96, 96));
        let clearance = std::mem::replace(&mut march.state.clear, 0.0);
        let now = march.state.interface.clone();
        let info = AlternationInfo {
            approach: march.state.approach(&march.domain.window.geometry.arms),
            ..AlternationInfo::default()
        };
        // With nothing known there is a look.
        let seen = (march.domain).clear_beyond(&march.problem, &march.state, &now, &info);
        let seen = seen.unwrap().unwrap();
        assert!(
            0.0 < clearance && clearance <= seen,
            "{clearance:e} {seen:e}"
        );
        not_looked += usize::from(clearance < seen);
        increments += 1;
        march.state.clear = clearance;
    }
    assert!(2 * not_looked > increments, "{not_looked} of {increments}");
}

/// Displacements belong to the tractions in every increment: nothing adds up along the path.
#[test]
fn displacements_are_those_of_the_tractions() {
    let overrides = ["grid.n=64", "solver.tolerance=1e-5", "path.0.increments=10"];
    let settings = overrides
        .into_iter()
        .chain(["path.1.increments=40", "path.2.increments=80"]);
    let settings: Vec<String> = settings.map(str::to_owned).collect();
    let scene = Scene::from_toml_str(COATED, "coated", &settings).unwrap();
    let mut march = March::new(&scene).unwrap();
    // A tenth of the tolerance may be rounded, and in a pass a tenth of that of the slip is
    // negligible.
    let allowed = 0.2 * scene.tolerance() * march.problem.approach;
    while let Some(increment) = march.advance() {
        increment.unwrap();
        let kept = &march.state.interface;
        let mut evaluated = kept.clone();
        evaluated.evaluate(&mut Response::plain(&mut *march.domain.window.op), true);
        let pairs = [&kept.u[0], &kept.u[1], &kept.u_z].into_iter();
        for (kept, u) in pairs.zip([&evaluated.u[0], &evaluated.u[1], &evaluated.u_z]) {
            let off = kept.iter().zip(u).map(|(a, b)| (a - b).abs());
            let off = off.fold(0.0, f64::max);
            assert!(off <= allowed, "{off:e} {allowed:e}");
        }
    }
}
