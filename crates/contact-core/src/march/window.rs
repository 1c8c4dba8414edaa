//! The part of the grid that is solved on: cells far from the contact are left out.
//!
//! Tractions act in the contact alone, and displacements of other cells matter only where these might
//! touch. So an increment is solved in a window around the contact, with room between the two, and
//! ends with a look at the gap beyond: where cells overlap there, it is solved again on the whole
//! grid. What a look has found clear stays so until the tractions have changed by enough to close it.
//! The window begins around the first guess of the contact and grows with it (`room`).

use std::sync::atomic::AtomicBool;
use std::sync::{Mutex, PoisonError};

use ndarray::Array2;

use super::slip_datum::Datum;
use super::{March, State};
use crate::convolution::{
    CirculantInverse, DcFft, Displacements, FrequencyDomain, Half, Mirror, SurfaceOperator,
    Tractions,
};
use crate::error::Error;
use crate::kernels::{InfluenceCoefficients, Quadrant, norm, pair_coefficients_until};
use crate::scene::{Grid, KernelMethod, Plan, Preset, Scene};
use crate::solvers::{Arms, CoupledInfo, CoupledWorkspace, Interface, Response, sums};
use crate::stop::NOBODY;

/// Cells in the middle of the grid, and what the solvers need to know of them.
pub(super) struct Window {
    /// The cells; those of the scene's grid where nothing is left out.
    pub(super) grid: Grid,
    /// Gap between the undeformed surfaces on the kept cells \[m\].
    pub(super) h_init: Vec<f64>,
    /// Where the kept cells are.
    pub(super) arms: Arms,
    /// Factor of the friction coefficient over the kept cells; empty where it is 1.
    pub(super) friction_map: Vec<f64>,
    pub(super) op: Box<dyn SurfaceOperator + Send>,
    pub(super) inverse: Option<CirculantInverse>,
}

/// What windows are cut from.
pub(super) struct Whole {
    /// The coefficients on the whole grid.
    pair: InfluenceCoefficients,
    /// Norms of the kernels of u_z under q_x, q_y and p on the whole plane \[m/Pa\].
    norms: [f64; 3],
    /// The whole grid, for what is beyond the window; there once it has been needed.
    pub(super) grid: Mutex<Option<Window>>,
    /// Transforms done in windows that were given up.
    transforms: usize,
}

impl Whole {
    /// Computes the coefficients that a plan needs; ends when `stop` is raised.
    pub(super) fn new(scene: &Scene, plan: &Plan, stop: &AtomicBool) -> Result<Self, Error> {
        let settings = &scene.settings;
        let pair = pair_coefficients_until(
            (&scene.body1, &scene.body2),
            &scene.grid,
            &settings.kernel,
            settings.skip.equal_layers,
            plan.kernels(),
            stop,
        )?;
        let mut pair = pair.stretched(scene.friction.stretch());
        if let Some(K) = scene.path.rig_stiffness.filter(|_| plan.friction) {
            // A spring in series: the force sum of q_x dA moves every cell by as much, eq. (7).
            pair.xx += scene.grid.cell_area() / K;
        }
        let shear = plan.friction && plan.coupling;
        let norms = [(&pair.xz, shear), (&pair.yz, shear), (&pair.zz, true)];
        Ok(Self {
            norms: norms.map(|(kernel, acts)| if acts { norm(kernel) } else { 0.0 }),
            pair,
            grid: Mutex::default(),
            transforms: 0,
        })
    }

    /// C_zz \[m/Pa\].
    pub(super) fn normal_kernel(&self) -> &Quadrant {
        &self.pair.zz
    }

    /// The nx x ny cells in the middle of the scene's grid; ends when `stop` is raised.
    pub(super) fn window(
        &self,
        scene: &Scene,
        plan: &Plan,
        (nx, ny): (usize, usize),
        stop: &AtomicBool,
    ) -> Result<Window, Error> {
        let grid = Grid {
            nx,
            ny,
            ..scene.grid
        };
        let settings = &scene.settings;
        let cut;
        let pair = if grid == scene.grid {
            &self.pair
        } else {
            cut = self.pair.within((nx, ny));
            &cut
        };
        let inverse = match settings.solver.preset {
            Preset::Fast => {
                let inverse = CirculantInverse::until(pair, plan.mirror, plan.single, stop)?;
                Some(inverse)
            }
            Preset::Spinu2020 => None,
        };
        let op: Box<dyn SurfaceOperator + Send> = match settings.kernel.method {
            KernelMethod::FrequencyDomain { lambda } => Box::new(FrequencyDomain::until(
                (&scene.body1, &scene.body2),
                &grid,
                lambda,
                plan.coupling,
                pair,
                stop,
            )?),
            _ => Box::new(DcFft::until(
                pair,
                plan.mirror,
                plan.coupling,
                plan.single,
                stop,
            )?),
        };
        let extent = scene.grid.extent();
        let length = if grid.plane_strain {
            0.5 * extent.0
        } else {
            0.5 * extent.0.max(extent.1)
        };
        let fold = |field: Array2<f64>| plan.mirror.fold(&field);
        let map = scene.friction.map.as_ref();
        Ok(Window {
            h_init: fold(middle(&scene.h_init(), (nx, ny))),
            arms: Arms {
                length,
                x: fold(grid.map(|x, _| x / length)),
                y: fold(grid.map(|_, y| y / length)),
                stretch: scene.friction.stretch(),
            },
            friction_map: map.map_or_else(Vec::new, |map| fold(grid.map(|x, y| map.at(x, y)))),
            op,
            inverse,
            grid,
        })
    }
}

impl Window {
    /// Cells along x and along y.
    pub(super) fn shape(&self) -> (usize, usize) {
        shape_of(&self.grid)
    }

    /// Shape of the fields: cells along x, kept rows.
    fn kept(&self, mirror: Mirror) -> (usize, usize) {
        (self.grid.nx, mirror.rows(self.grid.ny))
    }
}

pub(super) fn shape_of(grid: &Grid) -> (usize, usize) {
    (grid.nx, grid.ny)
}

/// The nx x ny entries in the middle of a field.
fn middle(field: &Array2<f64>, (nx, ny): (usize, usize)) -> Array2<f64> {
    let (i, j) = ((field.nrows() - nx) / 2, (field.ncols() - ny) / 2);
    Array2::from_shape_fn((nx, ny), |(a, b)| field[(i + a, j + b)])
}

/// A field of kept cells on more cells around the same middle, `elsewhere` on the new ones; or on fewer.
pub(super) fn embedded<T: Copy>(
    field: &[T],
    from: (usize, usize),
    to: (usize, usize),
    mirror: Mirror,
    elsewhere: T,
) -> Vec<T> {
    // Where the one begins in the other.
    let begins =
        |from: usize, to: usize| (to.saturating_sub(from) / 2, from.saturating_sub(to) / 2);
    let (i, i_from) = begins(from.0, to.0);
    let (j, j_from) = match mirror {
        Mirror::None => begins(from.1, to.1),
        // The half begins in the middle.
        Mirror::Y => (0, 0),
    };
    let (columns, rows) = (from.0.min(to.0), from.1.min(to.1));
    let mut embedded = vec![elsewhere; to.0 * to.1];
    for column in 0..columns {
        let values = &field[(i_from + column) * from.1 + j_from..][..rows];
        embedded[(i + column) * to.1 + j..][..rows].copy_from_slice(values);
    }
    embedded
}

impl Interface {
    /// The same in another window; in a wider one the displacements are not those of the new cells.
    fn embedded(&self, from: (usize, usize), to: (usize, usize), mirror: Mirror) -> Self {
        let wide = |f: &Vec<f64>| embedded(f, from, to, mirror, 0.0);
        let pair = |f: &[Vec<f64>; 2]| [wide(&f[0]), wide(&f[1])];
        Self {
            p: wide(&self.p),
            q: pair(&self.q),
            u: pair(&self.u),
            u_z: wide(&self.u_z),
            slip: embedded(&self.slip, from, to, mirror, false),
            owed: self.owed.map(wide),
            rounding: self.rounding,
        }
    }
}

impl State {
    /// The same in another window; in a wider one the displacements are not those of the new cells.
    fn embedded(&self, from: (usize, usize), to: (usize, usize), mirror: Mirror) -> Self {
        let wide = |f: &Vec<f64>| embedded(f, from, to, mirror, 0.0);
        let pair = |f: &[Vec<f64>; 2]| [wide(&f[0]), wide(&f[1])];
        Self {
            interface: self.interface.embedded(from, to, mirror),
            slip: pair(&self.slip),
            slip_length: wide(&self.slip_length),
            dissipated: wide(&self.dissipated),
            p_before: wide(&self.p_before),
            q_before: pair(&self.q_before),
            missed: pair(&self.missed),
            ..*self
        }
    }
}

impl March {
    /// Whether cells are left out.
    pub(super) fn is_windowed(&self) -> bool {
        self.window.grid != self.scene.grid
    }

    /// Two-dimensional transforms done so far.
    pub(super) fn transforms(&self) -> usize {
        let beyond = (self.whole.grid.lock()).unwrap_or_else(PoisonError::into_inner);
        let beyond = beyond.as_ref().map_or(0, |grid| grid.op.transforms());
        self.whole.transforms + self.window.op.transforms() + beyond
    }

    /// How far the cells beyond the window are at least from overlapping in this solution \[m\]; `None`
    /// where some do overlap, and the window is the whole grid now. Fails where the run is stopped
    /// meanwhile.
    pub(super) fn clear_beyond(
        &mut self,
        now: &Interface,
        info: &CoupledInfo,
    ) -> Result<Option<f64>, Error> {
        if !self.is_windowed() {
            return Ok(Some(0.0));
        }
        let left = self.state.clear - self.closes_beyond(now, info);
        if left > 0.0 {
            return Ok(Some(left));
        }
        let mirror = self.plan.mirror;
        let known = (self.whole.grid.get_mut())
            .unwrap_or_else(PoisonError::into_inner)
            .take();
        let mut grid = match known {
            Some(grid) => grid,
            None => self.laid_out(shape_of(&self.scene.grid))?,
        };
        let (scene, plan) = (&self.scene, &self.plan);
        let (from, to) = (self.window.kept(mirror), grid.kept(mirror));
        let wide = |f: &[f64]| embedded(f, from, to, mirror, 0.0);
        let (p, q) = (wide(&now.p), [wide(&now.q[0]), wide(&now.q[1])]);
        let shear = plan.friction && plan.coupling;
        let mut u_z = vec![0.0; p.len()];
        grid.op.respond(
            Tractions {
                q_x: shear.then_some(&q[0]),
                q_y: shear.then_some(&q[1]),
                p: Some(&p),
            },
            Displacements {
                u_z: Some(&mut u_z),
                ..Displacements::default()
            },
        );
        let inside = embedded(&vec![true; now.p.len()], from, to, mirror, false);
        let allowed = scene.tolerance() * self.approach;
        let clear = (0..p.len())
            .filter(|&n| !inside[n])
            .map(|n| grid.h_init[n] + u_z[n] - grid.arms.across(info.approach, n) + allowed)
            .fold(f64::INFINITY, f64::min);
        let whole = &mut self.whole;
        *whole.grid.get_mut().unwrap_or_else(PoisonError::into_inner) = Some(grid);
        if clear < 0.0 {
            self.move_into(shape_of(&self.scene.grid))?;
            return Ok(None);
        }
        Ok(Some(clear))
    }

    /// What the gap closes by at most beyond the window from the last increment to this solution \[m\]:
    /// no displacement changes by more than the norm of a kernel times that of the change of traction.
    fn closes_beyond(&self, now: &Interface, info: &CoupledInfo) -> f64 {
        let (last, before) = (&self.state.interface, self.approach_before());
        let squares = sums((now.tractions(), last.tractions()), |_, (now, last)| {
            std::array::from_fn::<f64, 3, _>(|k| (now[k] - last[k]).powi(2))
        });
        let of_tractions: f64 = (self.whole.norms.iter().zip(squares))
            .map(|(norm, squares)| norm * (self.plan.mirror.multiplicity() * squares).sqrt())
            .sum();
        // The arms are at most 1.
        let rigid: f64 = (0..3).map(|k| (info.approach[k] - before[k]).abs()).sum();
        of_tractions + rigid
    }

    /// A window of that shape; fails where the run is stopped meanwhile.
    pub(super) fn laid_out(&self, shape: (usize, usize)) -> Result<Window, Error> {
        let window = (self.whole).window(&self.scene, &self.plan, shape, &self.stop);
        window.or_else(|failure| {
            self.unless_stopped()?;
            Err(failure)
        })
    }

    /// Lays out a wider window, or a narrower one, and puts the present state into it; where the run is
    /// stopped meanwhile nothing is changed.
    pub(super) fn move_into(&mut self, shape: (usize, usize)) -> Result<(), Error> {
        let whole = (self.whole.grid.get_mut()).unwrap_or_else(PoisonError::into_inner);
        let known = whole.take_if(|whole| whole.shape() == shape);
        let next = match known {
            Some(window) => window,
            None => self.laid_out(shape)?,
        };
        let last = std::mem::replace(&mut self.window, next);
        if last.grid == self.scene.grid {
            *(self.whole.grid.get_mut()).unwrap_or_else(PoisonError::into_inner) = Some(last);
        } else {
            self.whole.transforms += last.op.transforms();
        }
        let cells = self.window.h_init.len();
        self.carried = None;
        self.mu = vec![self.scene.friction.mu; cells];
        self.datum = Datum::new(cells);
        self.workspace = CoupledWorkspace::new(cells);
        let state = std::mem::replace(&mut self.state, State::unloaded((0, 0), 0));
        self.put(state);
        Ok(())
    }

    /// Takes a state, which may be older than the window; such a one is kept as it is, too.
    pub(super) fn put(&mut self, state: State) {
        if state.window == self.window.shape() {
            self.state = state;
            return;
        }
        let mirror = self.plan.mirror;
        let from = (state.window.0, mirror.rows(state.window.1));
        let to = self.window.kept(mirror);
        self.state = state.embedded(from, to, mirror);
        self.state.window = self.window.shape();
        let old = embedded(&vec![true; from.0 * from.1], from, to, mirror, false);
        self.unwidened.get_or_insert(state);
        if !old.contains(&false) {
            return;
        }
        let mut computed = self.state.interface.clone();
        computed.evaluate(&mut plain(&mut *self.window.op), self.plan.friction);
        let now = &mut self.state.interface;
        let ([x, y], [new_x, new_y]) = (&mut now.u, computed.u);
        for (now, new) in [(x, new_x), (y, new_y), (&mut now.u_z, computed.u_z)] {
            for n in (0..old.len()).filter(|&n| !old[n]) {
                now[n] = new[n];
            }
        }
    }

    /// What a field on the whole grid is in the window, on the kept cells.
    pub(super) fn in_window(&self, field: &Array2<f64>) -> Vec<f64> {
        self.plan.mirror.fold(&middle(field, self.window.shape()))
    }

    /// A field of the window on the whole grid, zero beyond the window.
    pub(super) fn on_grid(&self, field: &[f64], half: Half) -> Array2<f64> {
        let (grid, mirror) = (&self.scene.grid, self.plan.mirror);
        let to = (grid.nx, mirror.rows(grid.ny));
        let wide = embedded(field, self.window.kept(mirror), to, mirror, 0.0);
        mirror.unfold(&wide, grid.nx, grid.ny, half)
    }

    /// The displacements u_x, u_y, u_z of the last increment on the whole grid.
    pub(super) fn displacements(&self) -> [Array2<f64>; 3] {
        let (grid, mirror) = (&self.scene.grid, self.plan.mirror);
        let now = &self.state.interface;
        let halves = [Half::Even, Half::Odd, Half::Even];
        let solved = [&now.u[0], &now.u[1], &now.u_z];
        if !self.is_windowed() {
            return [0, 1, 2].map(|c| self.on_grid(solved[c], halves[c]));
        }
        let to = (grid.nx, mirror.rows(grid.ny));
        let mut whole = now.embedded(self.window.kept(mirror), to, mirror);
        // Asked for what there is, also of a run that has been stopped.
        let lay_out = || {
            let (shape, stop) = (shape_of(grid), AtomicBool::new(false));
            let window = self.whole.window(&self.scene, &self.plan, shape, &stop);
            window.expect(NOBODY)
        };
        let mut beyond = (self.whole.grid.lock()).unwrap_or_else(PoisonError::into_inner);
        let beyond = beyond.get_or_insert_with(lay_out);
        whole.evaluate(&mut plain(&mut *beyond.op), self.plan.friction);
        let computed = [&whole.u[0], &whole.u[1], &whole.u_z];
        let part = &self.window.grid;
        let (i, j) = ((grid.nx - part.nx) / 2, (grid.ny - part.ny) / 2);
        [0, 1, 2].map(|c| {
            let mut u = mirror.unfold(computed[c], grid.nx, grid.ny, halves[c]);
            let solved = mirror.unfold(solved[c], part.nx, part.ny, halves[c]);
            for ((a, b), u_solved) in solved.indexed_iter() {
                u[(i + a, j + b)] = *u_solved;
            }
            u
        })
    }
}

fn plain(op: &mut dyn SurfaceOperator) -> Response<'_> {
    Response {
        op,
        inverse: None,
        stop: None,
        exact: false,
    }
}
