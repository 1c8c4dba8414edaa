//! What the bodies bring into an increment when they roll or are stretched meanwhile.
//!
//! The grid goes with the contact. When the contact has rolled on by s along x, the material that
//! is now at x was at x + s before, and with it its displacement, its shear and its history. Bulk
//! stresses that change meanwhile stretch the surface of body 2 by d(eps) more than that of body 1
//! (`scene::bulk_stress`). Both enter the slip, eq. (7), through the displacement that means none:
//! since u = u(2) - u(1), that of the material before, less d(eps_x) x and d(eps_y) y.
//!
//! A rotation d(phi_z) that is given moves the material on its way from x + s to x by d(phi_z) (x + s/2)
//! along y, the motions of the bodies by d(phi_z) x: what they leave out is as if stretched besides. Of a
//! rotation that follows from M_z it is left out: with the shift along y given too, an error of first order
//! in s; where that is free it takes it up.

use super::slip_datum::Before;
use super::{Interface, March};
use crate::scene::{LoadPoint, Loads};

/// The last interface as the increment finds it.
pub(super) struct Carried {
    /// Tractions and displacements of the material that is now in each cell; the displacements
    /// less the stretch.
    interface: Interface,
    /// What its slip missed \[m\].
    missed: [Vec<f64>; 2],
    /// Pressure and shear of that material an increment earlier, if the contact rolled on as far in that.
    p_before: Vec<f64>,
    q_before: [Vec<f64>; 2],
    /// Cells that the contact rolls on along x.
    cells: isize,
    /// Strain d(eps_x), d(eps_y) of body 2 less that of body 1 in the increment.
    strain: [f64; 2],
    /// What a given rotation moves the rolling material along y besides \[m\].
    turned: f64,
}

impl Carried {
    pub(super) fn interface(&self) -> &Interface {
        &self.interface
    }

    pub(super) fn before(&self) -> Before<'_> {
        Before {
            p: &self.p_before,
            q: &self.q_before,
        }
    }

    pub(super) fn missed(&self) -> &[Vec<f64>; 2] {
        &self.missed
    }
}

impl March {
    /// Rolls and stretches the last interface to where the increment starts.
    pub(super) fn carry(&mut self, point: &LoadPoint) {
        let (now, before) = (&point.loads, &self.state.loads);
        let at = |rolled: f64| (rolled / self.scene.grid.dx).round() as isize;
        let cells = at(now.rolled) - at(before.rolled);
        let strain = self.scene.bulk_mismatch(&Loads {
            sigma_B: now.sigma_B - before.sigma_B,
            sigma_B1: now.sigma_B1 - before.sigma_B1,
            ..Loads::default()
        });
        let spin = now
            .given
            .phi_z
            .map_or(0.0, |to| to - self.state.motion.phi_z);
        let turned = 0.5 * spin * cells as f64 * self.scene.grid.dx;
        self.carried = None;
        if cells == 0 && strain.iter().all(|e| *e == 0.0) {
            return;
        }
        let last = &self.state.interface;
        let roll = |field: &[f64]| self.rolled(field, cells);
        let pair = |fields: &[Vec<f64>; 2]| [roll(&fields[0]), roll(&fields[1])];
        let mut interface = Interface {
            p: roll(&last.p),
            q: pair(&last.q),
            u: pair(&last.u),
            u_z: roll(&last.u_z),
            slip: (0..last.slip.len())
                .map(|n| self.source(n, cells).is_some_and(|n| last.slip[n]))
                .collect(),
            owed: last.owed.map(|field| roll(field)),
            rounding: last.rounding,
        };
        for n in 0..last.p.len() {
            let stretch = self.stretched(strain, turned, n);
            interface.u[0][n] -= stretch[0];
            interface.u[1][n] -= stretch[1];
        }
        let missed = pair(&self.state.missed);
        let earlier = |field: &Vec<f64>| self.rolled(field, 2 * cells);
        let p_before = earlier(&self.state.p_before);
        let q_before = self.state.q_before.each_ref().map(earlier);
        self.carried = Some(Carried {
            interface,
            missed,
            p_before,
            q_before,
            cells,
            strain,
            turned,
        });
    }

    /// What cell n moves before it enters the contact \[m\].
    pub(super) fn entered_at(&self, n: usize) -> [f64; 2] {
        if self.before().p[n] > 0.0 {
            return [0.0; 2];
        }
        [0, 1].map(|c| self.datum.moved[c][n])
    }

    /// The interface that slip is reckoned from.
    pub(super) fn before(&self) -> &Interface {
        let carried = self.carried.as_ref();
        carried.map_or(&self.state.interface, Carried::interface)
    }

    /// Where the material in cell n was before the increment, if that was on the grid.
    pub(super) fn origin(&self, n: usize) -> Option<usize> {
        self.source(n, self.carried.as_ref().map_or(0, |c| c.cells))
    }

    /// Whether the contact rolls on to other cells in the increment.
    pub(super) fn rolls_on(&self) -> bool {
        self.carried.as_ref().is_some_and(|c| c.cells != 0)
    }

    /// How far the stretch moves body 2 against body 1 in cell n in the increment \[m\].
    pub(super) fn stretch_at(&self, n: usize) -> [f64; 2] {
        let carried = self.carried.as_ref();
        carried.map_or([0.0; 2], |c| self.stretched(c.strain, c.turned, n))
    }

    /// How much wider the undeformed gap over the material in cell n is than before \[m\].
    pub(super) fn gap_rolled(&self, n: usize) -> f64 {
        match &self.carried {
            Some(carried) if carried.cells != 0 => {
                let from = self.origin(n).unwrap_or(n);
                self.window.h_init[n] - self.window.h_init[from]
            }
            _ => 0.0,
        }
    }

    /// What a history per cell becomes when the material moves on: new material has none.
    pub(super) fn roll_history(&mut self) {
        let Some(cells) = self.carried.as_ref().map(|c| c.cells).filter(|c| *c != 0) else {
            return;
        };
        let state = &self.state;
        let [slip_x, slip_y] = [0, 1].map(|c| self.rolled(&state.slip[c], cells));
        let slip_length = self.rolled(&state.slip_length, cells);
        let dissipated = self.rolled(&state.dissipated, cells);
        let state = &mut self.state;
        (state.slip, state.slip_length, state.dissipated) =
            ([slip_x, slip_y], slip_length, dissipated);
    }

    fn stretched(&self, strain: [f64; 2], turned: f64, n: usize) -> [f64; 2] {
        let (arms, length) = (&self.window.arms, self.window.arms.length);
        [
            strain[0] * length * arms.x[n],
            (strain[1] * length * arms.y[n] - turned) * arms.stretch,
        ]
    }

    fn source(&self, n: usize, cells: isize) -> Option<usize> {
        let rows = self.plan.mirror.rows(self.window.grid.ny);
        let from = n as isize + cells * rows as isize;
        let inside = (0..self.window.h_init.len() as isize).contains(&from);
        inside.then_some(from as usize)
    }

    fn rolled(&self, field: &[f64], cells: isize) -> Vec<f64> {
        let from = |n: usize| self.source(n, cells).map_or(0.0, |n| field[n]);
        (0..field.len()).map(from).collect()
    }
}
