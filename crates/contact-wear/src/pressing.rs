//! The normal problem of worn surfaces, with a compliance in every cell.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::cells::{Arms, Drive};
use contact_core::convolution::{
    Convolutions, Displacements, SurfaceOperator, Tractions, normal_operator,
};
use contact_core::kernels::{InfluenceCoefficients, pair_coefficients};
use contact_core::plan::{KernelSet, Mirror, Plan};
use contact_core::scene::{Grid, Scene};
use contact_core::solvers::Response;
use contact_core::solvers::inner::{
    NormalInfo, NormalParams, NormalProblem, NormalWorkspace, solve_normal,
};

use super::compliant::{Compliant, CompliantInverse, shortest_waves};

/// The pair of bodies under pressure alone, on the kept cells of the whole grid.
pub(crate) struct Pressing {
    pub(crate) grid: Grid,
    pub(crate) mirror: Mirror,
    kernel: InfluenceCoefficients,
    op: Box<dyn SurfaceOperator>,
    arms: Arms,
    params: NormalParams,
    workspace: NormalWorkspace,
    /// The approximate inverse of the last problem.
    inverse: Option<CompliantInverse>,
    u_z: Vec<f64>,
    stop: Arc<AtomicBool>,
}

impl Pressing {
    /// Computes the normal coefficients of the scene and plans their convolution.
    pub(crate) fn new(scene: &Scene, plan: &Plan, stop: &Arc<AtomicBool>) -> Result<Self, Error> {
        let (grid, settings, mirror) = (scene.grid, &scene.settings, plan.mirror);
        let kernel = pair_coefficients(
            (&scene.body1, &scene.body2),
            &grid,
            &settings.kernel,
            settings.skip.equal_layers,
            KernelSet::Normal,
            Some(stop),
        )?;
        let (length, width) = grid.extent();
        let length = 0.5
            * if grid.plane_strain {
                length
            } else {
                length.max(width)
            };
        let arms = Arms {
            length,
            x: mirror.fold(&grid.map(|x, _| x / length)),
            y: mirror.fold(&grid.map(|_, y| y / length)),
            axis_ratio: 1.0,
        };
        let cells = arms.x.len();
        let tolerance = scene.tolerance() * scene.reference_approach();
        Ok(Self {
            grid,
            mirror,
            op: normal_operator(&kernel, mirror, stop)?,
            kernel,
            arms,
            params: NormalParams {
                enough: 0.8 * tolerance,
                tolerance: 0.4 * tolerance,
                max_iterations: settings.solver.max_iterations,
            },
            workspace: NormalWorkspace::new(cells),
            inverse: None,
            u_z: vec![0.0; cells],
            stop: stop.clone(),
        })
    }

    /// Number of kept cells.
    pub(crate) fn cells(&self) -> usize {
        self.u_z.len()
    }

    /// Begins a jump: drops the inverse, which the solutions of a jump share, so that a resumed run
    /// has the same bits.
    pub(crate) fn begin(&mut self) {
        self.inverse = None;
    }

    /// Normal displacement C p \[m\].
    pub(crate) fn response(&mut self, p: &[f64]) -> Vec<f64> {
        let mut u_z = vec![0.0; p.len()];
        self.op.apply(
            Tractions {
                p: Some(p),
                ..Tractions::default()
            },
            Displacements {
                u_z: Some(&mut u_z),
                ..Displacements::default()
            },
        );
        u_z
    }

    /// Gap between the loaded surfaces \[m\], `h + C p - delta_z`, h being the gap between the unloaded
    /// ones. It is zero where the pressure acts.
    pub(crate) fn loaded_gap(&mut self, h: &[f64], p: &[f64]) -> Vec<f64> {
        let mut gap = self.response(p);
        gap.iter_mut().zip(h).for_each(|(gap, h)| *gap += h);
        let force: f64 = p.iter().sum();
        let approach = gap.iter().zip(p).map(|(g, p)| g * p).sum::<f64>() / force;
        for gap in &mut gap {
            *gap -= approach;
        }
        gap
    }

    /// C(0) - C(1), the difference of the responses of a cell and its neighbour \[m/Pa\].
    pub(crate) fn shortest_waves(&self) -> f64 {
        shortest_waves(&self.kernel)
    }

    /// Number of cells along y.
    pub(crate) fn rows(&self) -> usize {
        self.mirror.rows(self.grid.ny)
    }

    /// Area that a kept cell represents \[m^2\].
    pub(crate) fn cell_area(&self) -> f64 {
        self.grid.cell_area() * self.mirror.multiplicity()
    }

    /// Boundary conditions for pressing with the force W \[N\]: the approach is free, tilts are held. The
    /// pressures sum to W over the area of a cell.
    pub(crate) fn drive(&self, W: f64) -> Drive {
        Drive {
            free: [true, false, false],
            sums: [W / self.cell_area(), 0.0, 0.0],
            given: [0.0; 3],
        }
    }

    /// Work done so far.
    pub(crate) fn work(&self) -> Convolutions {
        self.op.work()
    }

    /// Solves `p >= 0, g = h + C p + D p - delta_z >= 0, p g = 0` for p from a guess, D being the
    /// `compliance` of each cell \[m/Pa\], to `times` the tolerance of the scene.
    pub(crate) fn solve(
        &mut self,
        h: &[f64],
        compliance: &[f64],
        drive: Drive,
        p: &mut [f64],
        times: f64,
    ) -> Result<NormalInfo, Error> {
        let inverse = CompliantInverse::new_or_reused(
            self.inverse.take(),
            &self.kernel,
            self.mirror,
            (compliance, p),
        );
        let inverse = self.inverse.insert(inverse);
        let mut op = Compliant {
            op: &mut *self.op,
            compliance,
        };
        op.apply(
            Tractions {
                p: Some(p),
                ..Tractions::default()
            },
            Displacements {
                u_z: Some(&mut self.u_z),
                ..Displacements::default()
            },
        );
        let mut response = Response {
            op: &mut op,
            inverse: Some(inverse),
            stop: Some(&self.stop),
            max_work: Convolutions::MAX,
            exact: true,
            squares: 0.0,
        };
        let problem = NormalProblem {
            h_init: h,
            arms: &self.arms,
            drive,
            hardness: f64::INFINITY,
        };
        let params = NormalParams {
            enough: times * self.params.enough,
            tolerance: times * self.params.tolerance,
            ..self.params
        };
        let info = solve_normal(
            &mut response,
            &problem,
            p,
            &mut self.u_z,
            &mut self.workspace,
            &params,
        );
        info.map_err(|e| {
            if response
                .stop
                .is_some_and(|s| s.load(std::sync::atomic::Ordering::Relaxed))
            {
                Error::Interrupted { increment: 0 }
            } else {
                Error::NotConverged {
                    increment: 0,
                    solver: e.solver,
                    residual: e.residual,
                    tolerance: e.tolerance,
                    iterations: e.iterations,
                    why: String::new(),
                }
            }
        })
    }
}
