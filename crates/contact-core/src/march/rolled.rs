//! Rolling and bulk strain: the state of the last increment carried along with the material.
//!
//! The grid goes with the contact. When the contact has rolled on by s along x, the material that
//! is now at x was at x + s before, and with it its displacement, its shear and its history. Bulk
//! stresses that change stretch the surface of body 2 by d(eps) more than the surface of body 1
//! (`scene::bulk_stress`). Both enter the slip, eq. (7), through the no-slip displacement: with u =
//! u(2) - u(1), the last displacement of the same material less (d(eps_xx) x + d(eps_xy) y, d(eps_xy) x +
//! d(eps_yy) y).
//!
//! Material from beyond the cells had the displacement u(x + s) = C * t(. + s): the response to the
//! tractions shifted with the material, which must not leave the cells.
//!
//! A given rotation d(phi_z) moves the material on its way from x + s to x by d(phi_z) (x + s/2)
//! along y; the rigid motion contains d(phi_z) x of it, and the difference d(phi_z) s/2 is added to
//! the stretch. For a rotation that follows from M_z the difference is left out: an error of first
//! order in s if the shift along y is given, none if it is free.

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
    /// Strain d(eps_xx), d(eps_yy), d(eps_xy) of body 2 less the strain of body 1.
    strain: [f64; 3],
    /// d(phi_z) s/2 of a given rotation \[m\].
    turned: f64,
}

impl Roll {
    /// The distance rolled in cells and the strain of the increment to a point.
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

    /// Whether the bodies neither roll nor are stretched.
    fn rests(&self) -> bool {
        self.cells == 0 && self.strain.iter().all(|e| *e == 0.0)
    }

    /// Relative displacement of the bodies by the stretch in cell n \[m\].
    pub(super) fn stretch_at(&self, geometry: &Geometry, n: usize) -> [f64; 2] {
        if self.rests() {
            return [0.0; 2];
        }
        let (arms, length) = (&geometry.arms, geometry.arms.length);
        let (x, y, [xx, yy, xy]) = (length * arms.x[n], length * arms.y[n], self.strain);
        [
            xx * x + xy * y,
            (xy * x + yy * y - self.turned) * arms.axis_ratio,
        ]
    }

    /// The cell in which the material of cell n was before, if on the grid.
    pub(super) fn origin(&self, geometry: &Geometry, mirror: Mirror, n: usize) -> Option<usize> {
        source(geometry, mirror, n, self.cells)
    }

    /// Increase of the undeformed gap of the material in cell n \[m\]; beyond the cells the gap is
    /// extrapolated by the parabola through the last three.
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

    /// Least distance of the contact from the border of the cells \[cells\], so that the displacement of the
    /// entering material is known.
    pub(super) fn margin(&self) -> usize {
        self.cells.unsigned_abs()
    }

    /// A field carried along with the material; zero for material from beyond the cells.
    pub(super) fn field(&self, geometry: &Geometry, mirror: Mirror, field: &[f64]) -> Vec<f64> {
        rolled(geometry, mirror, field, self.cells)
    }
}

/// The state of the last increment, carried along with the material.
pub(super) struct Rolled {
    /// Tractions and displacements of the material that is now in each cell; the displacements
    /// less the stretch.
    pub(super) interface: Interface,
    /// Its residual slip \[m\].
    pub(super) residual: [Vec<f64>; 2],
    /// Pressure and shear of that material an increment earlier, if it rolled equally far then.
    pub(super) p_before: Vec<f64>,
    pub(super) q_before: [Vec<f64>; 2],
}

impl Rolled {
    /// Carries the fields of a state along with the material. `None` without rolling and stretch. If the
    /// contact rolls off the cells it fails, with the number of free cells left.
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
        let free_cells = free_cells(roll, geometry, mirror, &state.interface.p);
        if free_cells < roll.margin() {
            return Err(RollsOff { free_cells });
        }
        let field = |f: &[f64]| rolled(geometry, mirror, f, roll.cells);
        let earlier = |f: &Vec<f64>| rolled(geometry, mirror, f, 2 * roll.cells);
        let slips = |slip: &[bool]| -> Vec<bool> {
            let slips_at_source =
                |n| source(geometry, mirror, n, roll.cells).is_some_and(|n: usize| slip[n]);
            (0..slip.len()).map(slips_at_source).collect()
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

/// The contact would roll off the cells.
pub(super) struct RollsOff {
    pub(super) free_cells: usize,
}

/// Cells along x between the contact and the border that its material moves towards.
fn free_cells(roll: &Roll, geometry: &Geometry, mirror: Mirror, p: &[f64]) -> usize {
    let rows = mirror.rows(geometry.grid.ny);
    let free = |column: &&[f64]| column.iter().all(|&p| p <= 0.0);
    if roll.cells > 0 {
        p.chunks(rows).take_while(free).count()
    } else {
        p.chunks(rows).rev().take_while(free).count()
    }
}

/// The cell in which the material of cell n was before it moved by so many `cells` along x, if that is on the
/// grid.
fn source(geometry: &Geometry, mirror: Mirror, n: usize, cells: isize) -> Option<usize> {
    let rows = mirror.rows(geometry.grid.ny);
    let from = n as isize + cells * rows as isize;
    let inside = (0..geometry.h_init.len() as isize).contains(&from);
    inside.then_some(from as usize)
}

/// A field after its material has moved by so many `cells` along x; zero for material from beyond the grid.
fn rolled(geometry: &Geometry, mirror: Mirror, field: &[f64], cells: isize) -> Vec<f64> {
    let from = |n: usize| source(geometry, mirror, n, cells).map_or(0.0, |n| field[n]);
    (0..field.len()).map(from).collect()
}
