//! The cells that are solved for: a window around the contact.
//!
//! Tractions act in the contact alone, and displacements of other cells matter only where these
//! might touch. So an increment is solved in a window around the contact, with a margin between the
//! two, and ends with a check of the gap beyond. The window changes between increments only
//! ([`Domain::fit`], [`Domain::widen`]): an increment that finds its window too small is begun
//! again in a wider one.

mod beyond;
mod embed;
mod fit;
mod nested;
mod shape;

use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use ndarray::Array2;

pub(super) use self::embed::state as embedded_state;
pub(super) use self::nested::FirstPressure;
pub(super) use self::shape::half_lengths;
use self::shape::{first, middle, shape_of};
use super::State;
use super::problem::Problem;
use crate::cells::{Arms, set_fields};
use crate::convolution::{
    ApproximateInverse, Convolutions, SurfaceOperator, approximate_inverse, surface_operator,
};
use crate::error::Error;
use crate::kernels::{InfluenceCoefficients, norm, pair_coefficients};
use crate::plan::{Mirror, Parity, Plan};
use crate::scene::{Grid, Scene};
use crate::solvers::Response;

/// Cells between the contact and the border of a window in which cells may enter: the radius within
/// which their motion is fitted.
pub(super) const AROUND: usize = 7;

/// The cells that are solved for, and the data on them.
pub(super) struct Geometry {
    /// The cells; all of the scene's grid where nothing is left out.
    pub(super) grid: Grid,
    /// Gap between the unloaded surfaces on the kept cells \[m\].
    pub(super) h_init: Vec<f64>,
    /// This gap before the first indentation under the hardness; empty for elastic bodies.
    bare: Vec<f64>,
    /// Lever arms of the kept cells.
    pub(super) arms: Arms,
    /// Factor of the friction coefficient over the kept cells; empty where it is 1.
    pub(super) friction_map: Vec<f64>,
}

/// Cells in the middle of the grid, with the response of the bodies on them.
pub(super) struct Window {
    pub(super) geometry: Geometry,
    pub(super) op: Box<dyn SurfaceOperator>,
    pub(super) inverse: Option<Box<dyn ApproximateInverse>>,
}

/// The coefficients that windows are cut from.
pub(super) struct Kernels {
    /// Builds the domain on the whole grid.
    pub(super) pair: InfluenceCoefficients,
    /// Norms of the kernels of u_z under q_x, q_y and p on the whole plane \[m/Pa\].
    norms: [f64; 3],
}

/// The window, and the whole grid for what lies beyond it.
pub(super) struct Domain {
    pub(super) kernels: Kernels,
    pub(super) window: Window,
    /// The whole grid, once it has been needed.
    pub(super) whole: Mutex<Option<Window>>,
    /// The first pressure of a first contact, while it may be needed again.
    pub(super) first_pressure: FirstPressure,
    /// Work done in windows that have been replaced.
    replaced: Convolutions,
    /// Work after which an increment has failed.
    limit: Convolutions,
}

impl Domain {
    /// Computes the coefficients that a plan needs; ends when `stop` is raised.
    pub(super) fn new(scene: &Scene, plan: &Plan, stop: &AtomicBool) -> Result<Self, Error> {
        let settings = &scene.settings;
        let pair = pair_coefficients(
            (&scene.body1, &scene.body2),
            &scene.grid,
            &settings.kernel,
            settings.skip.equal_layers,
            plan.kernels(),
            Some(stop),
        )?;
        let mut pair = pair.scale_y(scene.friction.axis_ratio());
        if let Some(K) = scene.path.rig_stiffness.filter(|_| plan.friction) {
            // A spring in series: the force sum of q_x dA moves every cell by as much, eq. (7).
            pair.xx += scene.grid.cell_area() / K;
        }
        let shear = plan.friction && plan.coupling;
        let norms = [(&pair.xz, shear), (&pair.yz, shear), (&pair.zz, true)];
        let kernels = Kernels {
            norms: norms.map(|(kernel, acts)| if acts { norm(kernel) } else { 0.0 }),
            pair,
        };
        let window = kernels.window(scene, plan, first(scene, plan), stop)?;
        Ok(Self {
            kernels,
            window,
            whole: Mutex::default(),
            first_pressure: FirstPressure::default(),
            replaced: Convolutions::default(),
            limit: Convolutions::MAX,
        })
    }

    /// Cells along x and along y that are solved on.
    pub(super) fn shape(&self) -> (usize, usize) {
        shape_of(&self.window.geometry.grid)
    }

    /// Cells that are solved for.
    pub(super) fn cells(&self) -> usize {
        self.window.geometry.h_init.len()
    }

    /// Work done so far.
    pub(super) fn work(&self) -> Convolutions {
        let whole = (self.whole.lock()).unwrap_or_else(PoisonError::into_inner);
        let whole = whole
            .as_ref()
            .map_or_else(Convolutions::default, |grid| grid.op.work());
        self.replaced + self.window.op.work() + whole
    }

    /// Allows so many more convolutions from now on.
    pub(super) fn allow(&mut self, more: Convolutions) {
        self.limit = self.work() + more;
    }

    /// Whether the allowed work is used up.
    pub(super) fn is_spent(&self) -> bool {
        self.work() >= self.limit
    }

    /// The total work of the window's operator at which the allowed work is used up.
    pub(super) fn most_work(&self) -> Convolutions {
        self.limit
            .remaining_after(self.work() - self.window.op.work())
    }

    /// Lays out a window of that shape. If this is stopped, the error has the number of `increments` done.
    pub(super) fn laid_out(
        &self,
        problem: &Problem,
        shape: (usize, usize),
        increments: usize,
    ) -> Result<Window, Error> {
        let Problem {
            scene, plan, stop, ..
        } = problem;
        let window = self.kernels.window(scene, plan, shape, stop);
        window.or_else(|failure| {
            problem.unless_stopped(increments)?;
            Err(failure)
        })
    }

    /// The displacements u_x, u_y, u_z of a state on the whole grid \[m\].
    pub(super) fn displacements(&self, problem: &Problem, state: &State) -> [Array2<f64>; 3] {
        let (scene, plan) = (&problem.scene, &problem.plan);
        let (grid, mirror) = (&scene.grid, plan.mirror);
        let now = &state.interface;
        let halves = [Parity::Even, Parity::Odd, Parity::Even];
        let solved = [&now.u[0], &now.u[1], &now.u_z];
        let part = state.window;
        if part == shape_of(grid) {
            return [0, 1, 2].map(|c| on_grid(problem, state, solved[c], halves[c]));
        }
        let to = (grid.nx, mirror.rows(grid.ny));
        let from = (part.0, mirror.rows(part.1));
        let mut whole = embed::interface(now, from, to, mirror);
        // Fields can be read after a stop, too.
        let lay_out = || {
            let (shape, stop) = (shape_of(grid), AtomicBool::new(false));
            let window = self.kernels.window(scene, plan, shape, &stop);
            window.expect(crate::stop::NOBODY)
        };
        let mut beyond = (self.whole.lock()).unwrap_or_else(PoisonError::into_inner);
        let beyond = beyond.get_or_insert_with(lay_out);
        whole.evaluate(&mut Response::plain(&mut *beyond.op), plan.friction);
        let computed = [&whole.u[0], &whole.u[1], &whole.u_z];
        let (i, j) = ((grid.nx - part.0) / 2, (grid.ny - part.1) / 2);
        [0, 1, 2].map(|c| {
            let mut u = mirror.unfold(computed[c], grid.nx, grid.ny, halves[c]);
            let solved = mirror.unfold(solved[c], part.0, part.1, halves[c]);
            for ((a, b), u_solved) in solved.indexed_iter() {
                u[(i + a, j + b)] = *u_solved;
            }
            u
        })
    }
}

/// A field of the kept cells of a state on the whole grid; zero beyond its window.
pub(super) fn on_grid(
    problem: &Problem,
    state: &State,
    field: &[f64],
    half: Parity,
) -> Array2<f64> {
    let (grid, mirror) = (&problem.scene.grid, problem.plan.mirror);
    let to = (grid.nx, mirror.rows(grid.ny));
    let from = (state.window.0, mirror.rows(state.window.1));
    let wide = embed::embedded(field, from, to, mirror, 0.0);
    mirror.unfold(&wide, grid.nx, grid.ny, half)
}

impl Kernels {
    /// The nx x ny cells in the middle of the scene's grid; ends when `stop` is raised.
    pub(super) fn window(
        &self,
        scene: &Scene,
        plan: &Plan,
        shape: (usize, usize),
        stop: &AtomicBool,
    ) -> Result<Window, Error> {
        let geometry = Geometry::new(scene, plan.mirror, shape);
        let cut;
        let pair = if geometry.grid == scene.grid {
            &self.pair
        } else {
            cut = self.pair.truncate(shape);
            &cut
        };
        Ok(Window {
            inverse: approximate_inverse(plan, pair, stop)?,
            op: surface_operator(scene, plan, &geometry.grid, pair, stop)?,
            geometry,
        })
    }
}

impl Geometry {
    /// Lays out geometry, gap and friction map on the nx x ny cells in the middle of the scene's grid.
    fn new(scene: &Scene, mirror: Mirror, (nx, ny): (usize, usize)) -> Self {
        let grid = Grid {
            nx,
            ny,
            ..scene.grid
        };
        let extent = scene.grid.extent();
        let length = if grid.plane_strain {
            0.5 * extent.0
        } else {
            0.5 * extent.0.max(extent.1)
        };
        let fold = |field: Array2<f64>| mirror.fold(&field);
        let map = scene.friction.map.as_ref();
        let h_init = fold(middle(&scene.h_init(), (nx, ny)));
        Self {
            bare: if scene.hardness() < f64::INFINITY {
                h_init.clone()
            } else {
                Vec::new()
            },
            h_init,
            arms: Arms {
                length,
                x: fold(grid.map(|x, _| x / length)),
                y: fold(grid.map(|_, y| y / length)),
                axis_ratio: scene.friction.axis_ratio(),
            },
            friction_map: map
                .map_or_else(Vec::new, |map| fold(grid.map(|x, y| map.interpolate(x, y)))),
            grid,
        }
    }

    /// The approach \[m\] at which the undeformed surfaces just touch anywhere on the grid of the scene. Of the
    /// motion (approach and tilts, as lengths) the tilts count.
    pub(super) fn touching(&self, scene: &Scene, [_, of_x, of_y]: [f64; 3]) -> f64 {
        let least = |least: f64, h: f64| least.min(h);
        if self.grid == scene.grid {
            let cells = self.h_init.iter().enumerate();
            let tilted =
                |(n, h): (usize, &f64)| h - self.arms.displacement_across([0.0, of_x, of_y], n);
            return cells.map(tilted).fold(f64::INFINITY, least);
        }
        let length = self.arms.length;
        let tilt = scene.grid.map(|x, y| (y * of_x - x * of_y) / length);
        (scene.h_init() - tilt)
            .iter()
            .copied()
            .fold(f64::INFINITY, least)
    }

    /// Sets the gap to the bare gap plus the permanent indentation of a state.
    pub(super) fn indent(&mut self, indented: &[f64]) {
        if self.bare.is_empty() {
            return;
        }
        if indented.is_empty() {
            self.h_init.clone_from(&self.bare);
            return;
        }
        set_fields(
            [&self.bare[..], indented],
            [&mut self.h_init],
            |_, [bare, depth], _| [bare + depth],
        );
    }

    /// Shape of the fields: cells along x, kept rows.
    fn kept(&self, mirror: Mirror) -> (usize, usize) {
        (self.grid.nx, mirror.rows(self.grid.ny))
    }

    /// A field on the whole grid cut to the kept cells of the window.
    pub(super) fn cut(&self, mirror: Mirror, field: &Array2<f64>) -> Vec<f64> {
        mirror.fold(&middle(field, shape_of(&self.grid)))
    }
}
