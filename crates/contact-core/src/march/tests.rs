//! A flag that is raised at any moment of an increment: how much is still computed.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::{March, State};
use crate::convolution::{Displacements, SurfaceOperator, Tractions};
use crate::error::Error;
use crate::scene::Scene;

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

/// Convolutions that may follow the raising of the flag: one that ends what the solver of the pressure
/// was at, and one each that takes the shear and its change along.
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
    op: Box<dyn SurfaceOperator + Send>,
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

    fn rounds(&self) -> bool {
        self.op.rounds()
    }

    fn transforms(&self) -> usize {
        self.op.transforms()
    }

    fn is_coupled(&self) -> bool {
        self.op.is_coupled()
    }

    fn self_coefficients(&self) -> (f64, f64) {
        self.op.self_coefficients()
    }
}

/// The increment after `state`, the flag being raised in that convolution (0: never): how it ended,
/// its convolutions, and the state after it.
fn stopped(scene: &Scene, state: &State, raised_at: usize) -> (Result<(), Error>, usize, State) {
    let mut march = March::resume(scene, state.clone()).unwrap();
    let clock = Arc::new(Clock {
        stop: Arc::default(),
        raised_at,
        done: AtomicUsize::new(0),
    });
    march.stop_on(clock.stop.clone());
    let mut window = march.whole.window(scene, &march.plan, march.window.shape());
    window.op = Box::new(Clocked {
        op: window.op,
        clock: clock.clone(),
    });
    march.window = window;
    let ended = march.advance().unwrap().map(drop);
    (ended, clock.done.load(Ordering::Relaxed), march.state)
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
            assert_eq!(ended, Ok(()));
            let mut interrupted = 0;
            let moments = (1..=convolutions).step_by(1 + convolutions / TRIALS);
            for raised_at in moments.clone() {
                let (ended, done, after) = stopped(&scene, &state, raised_at);
                let late = done - raised_at;
                assert!(
                    late <= LATE,
                    "{late} more after {raised_at} of {convolutions}"
                );
                if ended.is_err() {
                    assert_eq!(ended, Err(Error::Interrupted { increment }));
                    assert!(after == state);
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
