//! Pressure of a first contact; of uneven surfaces by nested iteration from coarser cells.
//!
//! The contact of rough surfaces has no closed form to start from. It is solved without friction on
//! cells twice as large, which are solved on cells four times as large, and so on: the pressure is
//! constant on the larger cells, and their gap and their displacement are means over them. With
//! v = (1, 2, 1)/2 the coefficients of cells twice as large are
//!
//! ```text
//! K'(I, J) = sum over i, j in {-1, 0, 1} of v_i v_j K(2 I + i, 2 J + j)
//! ```
//!
//! (a Galerkin projection: the minimum of the same energy over fewer unknowns. Cascadic iteration:
//! F. A. Bornemann, P. Deuflhard, Numer. Math. 75 (1996) 135-152). Each level costs a quarter of the
//! next one, works in a window around the contact of the level before, and gives its pressure as the
//! first guess.

use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, PoisonError};

use ndarray::Array2;

use super::shape::{half_lengths, middle, shape_for};
use crate::cells::{Arms, Drive};
use crate::convolution::{CirculantInverse, DcFft, SurfaceOperator, Tractions};
use crate::convolution::{Convolutions, Displacements};
use crate::error::Error;
use crate::kernels::{InfluenceCoefficients, Quadrant};
use crate::march::State;
use crate::march::first_pressure::pressure_of_paraboloid;
use crate::march::problem::{Drives, Problem};
use crate::plan::Mirror;
use crate::scene::{Grid, LoadPoint};
use crate::solvers::Response;
use crate::solvers::inner::{
    NormalParams, NormalProblem, NormalWorkspace, scale_pressure, solve_normal,
};

/// Cells along the shorter side of the coarsest level, at most.
const COARSEST: usize = 48;
/// Gap that a level leaves, over the approach.
const TOLERANCE: f64 = 1e-3;
/// Most iterations of a level: its solution is a guess.
const ITERATIONS: usize = 40;
/// Cells of a level between the contact of the level before and the border of its window.
const MARGIN: usize = 6;

/// The first pressure of the last load point for which it was computed: the window is laid out by it, and the
/// increment starts from it, in every window that is tried.
#[derive(Default)]
pub(in crate::march) struct FirstPressure(Mutex<Option<(LoadPoint, Arc<Array2<f64>>)>>);

impl FirstPressure {
    /// Returns the first pressure under the loads of a point; `kernel` is C_zz on the whole grid.
    pub(in crate::march) fn get_or_compute(
        &self,
        problem: &Problem,
        kernel: &Quadrant,
        point: &LoadPoint,
    ) -> Arc<Array2<f64>> {
        let mut last = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((at, p)) = &*last
            && at == point
        {
            return p.clone();
        }
        let p = Arc::new(first_pressure(problem, kernel, point));
        *last = Some((*point, p.clone()));
        p
    }

    /// Frees the memory, once the bodies touch.
    pub(super) fn clear(&mut self) {
        *self.0.get_mut().unwrap_or_else(PoisonError::into_inner) = None;
    }
}

/// Initial pressure of bodies that have not touched, on the whole grid, up to a factor: from larger
/// cells where the surfaces are uneven, else the pressure of a paraboloid; uniform without
/// [`Methods::first_contact`](crate::plan::Methods::first_contact). `kernel` is C_zz on the whole grid.
fn first_pressure(problem: &Problem, kernel: &Quadrant, point: &LoadPoint) -> Array2<f64> {
    let h_init = problem.scene.h_init();
    if !problem.plan.methods.first_contact {
        return Array2::ones(h_init.dim());
    }
    let cell = problem.scene.grid.cell_area();
    nested_pressure(problem, kernel, point)
        .unwrap_or_else(|| pressure_of_paraboloid(problem, point, &h_init, cell))
}

/// The pressure of a first contact under the loads of a point on the grid of the scene \[Pa\], up to a
/// factor; none if the surfaces are smooth, if the plan has no such guess, or if nothing touches.
fn nested_pressure(problem: &Problem, kernel: &Quadrant, point: &LoadPoint) -> Option<Array2<f64>> {
    let (scene, plan) = (&problem.scene, &problem.plan);
    let grid = scene.grid;
    let pays = plan.methods.first_contact
        && plan.methods.preconditioner
        && plan.mirror == Mirror::None
        && !grid.plane_strain
        && scene.is_uneven()
        && grid.nx.min(grid.ny) > COARSEST;
    if !pays {
        return None;
    }
    let (grid, h, kernel) = coarser(&grid, &scene.h_init(), kernel);
    let p = solve_level(problem, point, &grid, &h, &kernel).ok()?;
    let p = refined(&p, (scene.grid.nx, scene.grid.ny));
    p.iter().any(|&p| p > 0.0).then_some(p)
}

/// The pressure on the cells of a level \[Pa\]; fails where the run is stopped.
fn solve_level(
    problem: &Problem,
    point: &LoadPoint,
    grid: &Grid,
    h: &Array2<f64>,
    kernel: &Quadrant,
) -> Result<Array2<f64>, Error> {
    let guess = if grid.nx.min(grid.ny) <= COARSEST {
        pressure_of_paraboloid(problem, point, h, grid.cell_area())
    } else {
        let (coarse_grid, coarse_h, coarse_kernel) = coarser(grid, h, kernel);
        let p = solve_level(problem, point, &coarse_grid, &coarse_h, &coarse_kernel)?;
        refined(&p, (grid.nx, grid.ny))
    };
    let guess = if guess.iter().any(|&p| p > 0.0) {
        guess
    } else {
        Array2::ones(guess.dim())
    };
    let flat = guess.as_standard_layout();
    let half = half_lengths(
        flat.as_slice().unwrap_or_default(),
        grid.ny,
        (grid.nx, grid.ny),
    );
    let (nx, ny) = shape_for(grid, half.map(|half| 2 * (half + MARGIN)));
    let window = Grid { nx, ny, ..*grid };
    let cut = Quadrant::from_shape_fn((nx, ny), |at| kernel[at]);
    let p = solve_window(
        problem,
        point,
        &window,
        (&middle(h, (nx, ny)), cut),
        &middle(&guess, (nx, ny)),
    )?;
    let (i, j) = ((grid.nx - nx) / 2, (grid.ny - ny) / 2);
    Ok(Array2::from_shape_fn((grid.nx, grid.ny), |(a, b)| {
        let inside = (i..i + nx).contains(&a) && (j..j + ny).contains(&b);
        if inside { p[(a - i, b - j)] } else { 0.0 }
    }))
}

/// Solves the normal problem on the cells of a window with the gap `h` and the coefficients `kernel`, from a
/// guess of the pressure; returns the pressure \[Pa\].
fn solve_window(
    problem: &Problem,
    point: &LoadPoint,
    grid: &Grid,
    (h, kernel): (&Array2<f64>, Quadrant),
    guess: &Array2<f64>,
) -> Result<Array2<f64>, Error> {
    let stop: &AtomicBool = &problem.stop;
    let pair = InfluenceCoefficients {
        zz: kernel,
        ..InfluenceCoefficients::default()
    };
    let single = problem.plan.methods.single_precision;
    let mut op = DcFft::new_unless_stopped(&pair, Mirror::None, false, single, stop)?;
    let mut inverse = CirculantInverse::new_unless_stopped(&pair, Mirror::None, single, stop)?;
    let scene = &problem.scene;
    let (along_x, along_y) = scene.grid.extent();
    let length = 0.5 * along_x.max(along_y);
    let flatten = |field: &Array2<f64>| field.iter().copied().collect::<Vec<f64>>();
    let arms = Arms {
        length,
        x: flatten(&grid.map(|x, _| x / length)),
        y: flatten(&grid.map(|_, y| y / length)),
        axis_ratio: scene.friction.axis_ratio(),
    };
    let state = State::unloaded((1, 1), 1, 0.0);
    let drive = Drives::new(problem, &arms, &state, point).normal;
    let larger = grid.cell_area() / scene.grid.cell_area();
    let drive = Drive {
        sums: drive.sums.map(|sum| sum / larger),
        ..drive
    };
    let normal = NormalProblem {
        h_init: &flatten(h),
        arms: &arms,
        drive,
        hardness: problem.hardness,
    };
    let mut p = flatten(guess);
    if drive.free[0] {
        scale_pressure(&mut p, drive.sums[0], problem.hardness);
    }
    let mut u_z = vec![0.0; p.len()];
    op.respond(
        Tractions {
            p: Some(&p),
            ..Tractions::default()
        },
        Displacements {
            u_z: Some(&mut u_z),
            ..Displacements::default()
        },
    );
    let mut response = Response {
        inverse: Some(&mut inverse),
        stop: Some(stop),
        max_work: Convolutions::MAX,
        ..Response::plain(&mut op)
    };
    let tolerance = TOLERANCE * problem.approach;
    let params = NormalParams {
        enough: tolerance,
        tolerance,
        max_iterations: ITERATIONS,
    };
    let mut ws = NormalWorkspace::new(p.len());
    // Where the iterations end early the pressure is a guess all the same.
    let _ = solve_normal(&mut response, &normal, &mut p, &mut u_z, &mut ws, &params);
    problem.unless_stopped(0)?;
    Ok(Array2::from_shape_vec((grid.nx, grid.ny), p).expect("a field of the window"))
}

/// The grid, the gap and the coefficients of cells twice as large each way; the last cells of an odd
/// grid reach beyond it.
fn coarser(grid: &Grid, h: &Array2<f64>, kernel: &Quadrant) -> (Grid, Array2<f64>, Quadrant) {
    let (nx, ny) = (grid.nx.div_ceil(2), grid.ny.div_ceil(2));
    let coarse = Grid {
        nx,
        ny,
        dx: 2.0 * grid.dx,
        dy: 2.0 * grid.dy,
        ..*grid
    };
    let (last_x, last_y) = (grid.nx - 1, grid.ny - 1);
    let mean = Array2::from_shape_fn((nx, ny), |(i, j)| {
        let [x, y] = [(i, last_x), (j, last_y)].map(|(k, last)| [2 * k, (2 * k + 1).min(last)]);
        0.25 * (h[(x[0], y[0])] + h[(x[0], y[1])] + h[(x[1], y[0])] + h[(x[1], y[1])])
    });
    let (mx, my) = kernel.dim();
    let folded = Quadrant::from_shape_fn((nx, ny), |(i, j)| {
        let mut sum = 0.0;
        for (a, v) in [(-1, 0.5), (0, 1.0), (1, 0.5)] {
            for (b, w) in [(-1, 0.5), (0, 1.0), (1, 0.5)] {
                let x = (2 * i as isize + a).unsigned_abs().min(mx - 1);
                let y = (2 * j as isize + b).unsigned_abs().min(my - 1);
                sum += v * w * kernel[(x, y)];
            }
        }
        sum
    });
    (coarse, mean, folded)
}

/// A field on cells half as large: each has the value of its larger cell.
fn refined(coarse: &Array2<f64>, shape: (usize, usize)) -> Array2<f64> {
    Array2::from_shape_fn(shape, |(i, j)| coarse[(i / 2, j / 2)])
}
