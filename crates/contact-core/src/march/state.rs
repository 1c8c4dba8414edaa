//! The state on which the next increment depends.

use serde::{Deserialize, Serialize};

use super::{Increment, Motion};
use crate::cells::Arms;
use crate::plan::Mirror;
use crate::scene::{Grid, LoadPoint, Loads};
use crate::solvers::Interface;
use crate::yielding::Yielded;

/// State after an increment, on the kept cells (half of the grid where the scene is symmetric).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Cells along x and y that the fields cover, in the middle of the grid.
    pub window: (usize, usize),
    /// Increments done.
    pub increments: usize,
    /// Loads at the end of the last one.
    pub loads: Loads,
    /// Tractions, displacements, slip set.
    pub interface: Interface,
    /// Rigid-body motion.
    pub motion: Motion,
    /// Slip added up over the path \[m\].
    pub total_slip: [Vec<f64>; 2],
    /// Length of the way slipped over the path \[m\].
    pub slip_length: Vec<f64>,
    /// Energy dissipated per area over the path \[J/m^2\].
    pub dissipated: Vec<f64>,
    /// Increment of the history that friction depends on, in the last increment \[m, J/m^2\]; zero
    /// without one.
    pub(crate) history_step: Vec<f64>,
    /// Permanent indentation under the hardness, of both surfaces together \[m\]; empty for elastic bodies.
    #[serde(default)]
    pub indented: Vec<f64>,
    /// Work of the applied forces over the path \[J\].
    pub work: f64,
    /// Area of the cells that did not slip in the last increment \[m^2\].
    pub(crate) without_slip: f64,
    /// Cells at the limit of friction in the last increment (`accounts::areas`): they count as
    /// sticking.
    pub(crate) at_limit: Vec<bool>,
    /// Lower bound of the gap beyond the window \[m\]; zero if unknown.
    pub(crate) clear: f64,
    /// Pressure before the last increment \[Pa\].
    pub(crate) p_before: Vec<f64>,
    /// Shear before the last increment \[Pa\].
    pub(crate) q_before: [Vec<f64>; 2],
    /// Residual slip of the last increment: slip that should be zero, within the solver's tolerance
    /// \[m\]. The next increment corrects it.
    pub(crate) residual: [Vec<f64>; 2],
    /// Change of the loads in the last increment.
    pub(crate) step: Loads,
    /// State of the coarser grid that the path is solved on, if there is one; the other fields are
    /// then the ones of the last increment that was solved on the grid of the scene.
    pub(crate) along: Option<Box<Along>>,
    /// Plastic strain of bodies that yield.
    pub yielded: Option<Box<Yielded>>,
}

impl State {
    /// Two bodies that just touch, at the approach `touching` \[m\], on so many kept `cells`.
    pub(crate) fn unloaded(window: (usize, usize), cells: usize, touching: f64) -> Self {
        let field = || vec![0.0; cells];
        let pair = || [field(), field()];
        Self {
            window,
            increments: 0,
            loads: Loads::default(),
            interface: Interface::unloaded(cells),
            motion: Motion {
                delta_z: touching,
                ..Motion::default()
            },
            total_slip: pair(),
            slip_length: field(),
            dissipated: field(),
            history_step: field(),
            indented: Vec::new(),
            work: 0.0,
            without_slip: 0.0,
            at_limit: vec![false; cells],
            clear: 0.0,
            p_before: field(),
            q_before: pair(),
            residual: pair(),
            step: Loads::default(),
            along: None,
            yielded: None,
        }
    }

    /// Whether it fits a grid: a window in its middle, and fields of its size.
    pub(crate) fn fits(&self, grid: &Grid, mirror: Mirror) -> bool {
        let within = |n: usize, whole: usize| n > 0 && n <= whole && (whole - n).is_multiple_of(2);
        let (nx, ny) = self.window;
        if !within(nx, grid.nx) || !within(ny, grid.ny) {
            return false;
        }
        let cells = nx * mirror.rows(ny);
        let Interface {
            p,
            q,
            u,
            u_z,
            slips,
        } = &self.interface;
        let State {
            slip_length,
            dissipated,
            history_step,
            p_before,
            ..
        } = self;
        let fields = [p, u_z, slip_length, dissipated, history_step, p_before];
        let pairs = [q, u, &self.total_slip, &self.q_before, &self.residual];
        let fields = fields.into_iter().chain(pairs.into_iter().flatten());
        let masks = [slips, &self.at_limit];
        if !self.indented.is_empty() && self.indented.len() != cells {
            return false;
        }
        fields.into_iter().all(|f| f.len() == cells) && masks.into_iter().all(|f| f.len() == cells)
    }

    /// Approach and tilts, as lengths \[m\].
    pub(super) fn approach(&self, arms: &Arms) -> [f64; 3] {
        let motions = self.motion.motions();
        [0, 1, 2].map(|k| motions[k] * arms.motion_unit(k))
    }

    /// Ratio of the change of the loads to a point to the change of the last increment, if the path goes on in
    /// its direction; else none.
    pub(super) fn going_on(&self, point: &LoadPoint) -> Option<f64> {
        let step = point.loads.since(&self.loads, self.motion.motions());
        step.projection_factor(&self.step)
            .filter(|_| self.increments > 1)
    }
}

/// State of the coarse grid along the path.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Along {
    /// State at the last increment.
    pub(super) now: State,
    /// State at the last increment that the fine grid was solved in or carried to.
    pub(super) then: State,
    /// The increment on the fine grid and on the coarse one.
    pub(super) rows: Option<[Increment; 2]>,
}

impl Along {
    /// Before the first increment, when both grids stand at the coarse grid's `state`.
    pub(super) fn beginning(state: &State) -> Self {
        Self {
            now: state.clone(),
            then: state.clone(),
            rows: None,
        }
    }

    /// Whether the fine grid is behind.
    pub(super) fn is_ahead(&self) -> bool {
        self.now.increments > self.then.increments
    }

    /// Whether its fields have the size of a grid.
    pub(super) fn fits(&self, grid: &Grid, mirror: Mirror) -> bool {
        self.now.fits(grid, mirror) && self.then.fits(grid, mirror)
    }
}
