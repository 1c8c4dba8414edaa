//! What the bodies bring into an increment when they roll or are stretched meanwhile.
//!
//! The grid goes with the contact. When the contact has rolled on by s along x, the material that
//! is now at x was at x + s before, and with it its displacement, its shear and its history. Bulk
//! stresses that change meanwhile stretch the surface of body 2 by d(eps) more than that of body 1
//! (`scene::bulk_stress`). Both enter the slip, eq. (7), through the displacement that means none:
//! since u = u(2) - u(1), that of the material before, less d(eps_x) x and d(eps_y) y.
//!
//! Material that comes from beyond the cells has the displacement that the tractions gave it there, u(x + s) =
//! C * t(. + s): the response to the tractions as they have rolled on, which must not leave the cells.
//!
//! A rotation d(phi_z) that is given moves the material on its way from x + s to x by d(phi_z) (x + s/2)
//! along y, the motions of the bodies by d(phi_z) x: what they leave out is as if stretched besides. Of a
//! rotation that follows from M_z it is left out: with the shift along y given too, an error of first order
//! in s; where that is free it takes it up.

use super::State;
use super::domain::Geometry;
use super::problem::Problem;
use crate::plan::Mirror;
use crate::scene::{LoadPoint, Loads};
use crate::solvers::{Interface, Response};

/// How the material moves over the grid in an increment.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Roll {
    /// Cells that the contact rolls on along x.
    pub(super) cells: isize,
    /// Strain d(eps_x), d(eps_y) of body 2 less that of body 1.
    strain: [f64; 2],
    /// What a given rotation moves the rolling material along y besides \[m\].
    turned: f64,
}

impl Roll {
    /// On the way to a point.
    pub(super) fn new(problem: &Problem, state: &State, point: &LoadPoint) -> Self {
        let (scene, now, before) = (&problem.scene, &point.loads, &state.loads);
        let at = |rolled: f64| (rolled / scene.grid.dx).round() as isize;
        let cells = at(now.rolled) - at(before.rolled);
        let strain = scene.bulk_mismatch(&Loads {
            sigma_B: now.sigma_B - before.sigma_B,
            sigma_B1: now.sigma_B1 - before.sigma_B1,
            ..Loads::default()
        });
        let spin = now.given.phi_z.map_or(0.0, |to| to - state.motion.phi_z);
        Self {
            cells,
            strain,
            turned: 0.5 * spin * cells as f64 * scene.grid.dx,
        }
    }

    /// Whether the material stays where it is, unstretched.
    fn rests(&self) -> bool {
        self.cells == 0 && self.strain.iter().all(|e| *e == 0.0)
    }

    /// How far the stretch moves body 2 against body 1 in cell n \[m\].
    pub(super) fn stretch_at(&self, geometry: &Geometry, n: usize) -> [f64; 2] {
        if self.rests() {
            return [0.0; 2];
        }
        let (arms, length) = (&geometry.arms, geometry.arms.length);
        [
            self.strain[0] * length * arms.x[n],
            (self.strain[1] * length * arms.y[n] - self.turned) * arms.stretch,
        ]
    }

    /// Where the material in cell n was before, if that was on the grid.
    pub(super) fn origin(&self, geometry: &Geometry, mirror: Mirror, n: usize) -> Option<usize> {
        source(geometry, mirror, n, self.cells)
    }

    /// How much wider the undeformed gap over the material in cell n is than before \[m\]; that of material from
    /// beyond the cells is continued by the parabola through the last three.
    pub(super) fn gap_at(&self, geometry: &Geometry, mirror: Mirror, n: usize) -> f64 {
        if self.cells == 0 {
            return 0.0;
        }
        let h = &geometry.h_init;
        if let Some(from) = self.origin(geometry, mirror, n) {
            return h[n] - h[from];
        }
        let rows = mirror.rows(geometry.grid.ny);
        let (columns, column) = (geometry.grid.nx as isize, (n / rows) as isize + self.cells);
        let (edge, inwards) = if column < 0 {
            (0, 1)
        } else {
            (columns - 1, -1)
        };
        let beyond = (column - edge).abs() as f64;
        let [f, g, k] = [0, 1, 2].map(|m| {
            let column = (edge + m * inwards).clamp(0, columns - 1);
            h[column as usize * rows + n % rows]
        });
        let from = f + beyond * (f - g) + 0.5 * beyond * (beyond + 1.0) * (f - 2.0 * g + k);
        h[n] - from
    }

    /// Cells that a contact must be away from the border of the cells for the displacement of what rolls in.
    pub(super) fn margin(&self) -> usize {
        self.cells.unsigned_abs()
    }

    /// A field of the material, where that is now; material from beyond the grid has none.
    pub(super) fn field(&self, geometry: &Geometry, mirror: Mirror, field: &[f64]) -> Vec<f64> {
        rolled(geometry, mirror, field, self.cells)
    }
}

/// The last increment's state as the material brings it into this one.
pub(super) struct Rolled {
    /// Tractions and displacements of the material that is now in each cell; the displacements
    /// less the stretch.
    pub(super) interface: Interface,
    /// Its residual slip \[m\].
    pub(super) residual: [Vec<f64>; 2],
    /// Pressure and shear of that material an increment earlier, if the contact rolled on as far in that.
    pub(super) p_before: Vec<f64>,
    pub(super) q_before: [Vec<f64>; 2],
}

impl Rolled {
    /// `None` where the material stays where it is. Fails where the contact rolls off the cells, with the cells
    /// between the two.
    pub(super) fn new(
        roll: &Roll,
        geometry: &Geometry,
        mirror: Mirror,
        state: &State,
        (response, friction): (&mut Response<'_>, bool),
    ) -> Result<Option<Self>, RollsOff> {
        if roll.rests() {
            return Ok(None);
        }
        let room = room(roll, geometry, mirror, &state.interface.p);
        if room < roll.margin() {
            return Err(RollsOff { room });
        }
        let field = |f: &[f64]| rolled(geometry, mirror, f, roll.cells);
        let earlier = |f: &Vec<f64>| rolled(geometry, mirror, f, 2 * roll.cells);
        let slips = |slip: &[bool]| -> Vec<bool> {
            let of = |n| source(geometry, mirror, n, roll.cells).is_some_and(|n: usize| slip[n]);
            (0..slip.len()).map(of).collect()
        };
        let mut interface = state.interface.map(field, slips);
        if roll.cells != 0 {
            let mut computed = interface.clone();
            computed.evaluate(response, friction);
            let new = |n: &usize| roll.origin(geometry, mirror, *n).is_none();
            for n in (0..interface.p.len()).filter(new) {
                interface.u_z[n] = computed.u_z[n];
                for c in 0..2 {
                    interface.u[c][n] = computed.u[c][n];
                }
            }
        }
        for n in 0..interface.p.len() {
            let stretch = roll.stretch_at(geometry, n);
            interface.u[0][n] -= stretch[0];
            interface.u[1][n] -= stretch[1];
        }
        Ok(Some(Self {
            interface,
            residual: state.residual.each_ref().map(|f| field(f)),
            p_before: earlier(&state.p_before),
            q_before: state.q_before.each_ref().map(earlier),
        }))
    }
}

/// The contact would roll off the cells: so few lie between it and their border.
pub(super) struct RollsOff {
    pub(super) room: usize,
}

/// Cells along x between a contact and the border of the cells that its material rolls to.
fn room(roll: &Roll, geometry: &Geometry, mirror: Mirror, p: &[f64]) -> usize {
    let rows = mirror.rows(geometry.grid.ny);
    let free = |column: &&[f64]| column.iter().all(|&p| p <= 0.0);
    if roll.cells > 0 {
        p.chunks(rows).take_while(free).count()
    } else {
        p.chunks(rows).rev().take_while(free).count()
    }
}

fn source(geometry: &Geometry, mirror: Mirror, n: usize, cells: isize) -> Option<usize> {
    let rows = mirror.rows(geometry.grid.ny);
    let from = n as isize + cells * rows as isize;
    let inside = (0..geometry.h_init.len() as isize).contains(&from);
    inside.then_some(from as usize)
}

fn rolled(geometry: &Geometry, mirror: Mirror, field: &[f64], cells: isize) -> Vec<f64> {
    let from = |n: usize| source(geometry, mirror, n, cells).map_or(0.0, |n| field[n]);
    (0..field.len()).map(from).collect()
}
