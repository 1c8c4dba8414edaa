//! The fields of one increment on the whole grid.

use ndarray::Array2;

use super::domain::on_grid;
use super::{March, Motion, State};
use crate::convolution;
use crate::plan::Parity;
use crate::yielding::Yielded;
use crate::zones::Outline;

/// p, `q_x`, `q_y` \[Pa\], each of shape (nx, ny).
pub type Tractions = [Array2<f64>; 3];

/// Fields at the end of an increment, each of shape (nx, ny).
#[derive(Clone, Debug, PartialEq)]
pub struct Fields {
    /// Pressure p \[Pa\], compression positive.
    pub p: Array2<f64>,
    /// Shear traction on body 2 along x \[Pa\].
    pub q_x: Array2<f64>,
    /// Shear traction on body 2 along y \[Pa\].
    pub q_y: Array2<f64>,
    /// Relative surface displacement u(2) - u(1) along x \[m\], under the tractions.
    pub u_x: Array2<f64>,
    /// Relative surface displacement along y \[m\].
    pub u_y: Array2<f64>,
    /// Relative surface displacement along z, into body 2 \[m\].
    pub u_z: Array2<f64>,
    /// Gap h \[m\], >= 0.
    pub gap: Array2<f64>,
    /// Permanent indentation under the hardness, of both surfaces together \[m\].
    pub indentation: Array2<f64>,
    /// Slip along x added up over the load path \[m\], in cells while in contact.
    pub slip_x: Array2<f64>,
    /// Slip along y added up over the load path \[m\].
    pub slip_y: Array2<f64>,
    /// Energy dissipated per area, added up over the load path \[J/m^2\].
    pub dissipated: Array2<f64>,
    /// Cells that transmit pressure.
    pub contact: Array2<bool>,
    /// Contact cells that do not slip in this increment.
    pub stick: Array2<bool>,
    /// Contact cells whose shear is at the limit of friction; their slip is within the solver's
    /// tolerance.
    pub at_limit: Array2<bool>,
    /// Plastic strain of bodies that yield, with a grid of its own.
    pub yielded: Option<Box<Yielded>>,
}

impl March {
    /// The shear tractions q_x, q_y after the last increment on the whole grid \[Pa\], shape (nx,
    /// ny).
    pub fn shear(&self) -> [Array2<f64>; 2] {
        self.shear_of(&self.caught_up())
    }

    /// The shear tractions q_x, q_y of a state on the whole grid \[Pa\].
    fn shear_of(&self, state: &State) -> [Array2<f64>; 2] {
        let unfold = |f: &[f64], half| on_grid(&self.problem, state, f, half);
        let [q_x, q_y] = &state.interface.q;
        let q_y = unfold(q_y, Parity::Odd) * self.problem.scene.friction.axis_ratio();
        [unfold(q_x, Parity::Even), q_y]
    }

    /// p, `q_x`, `q_y` after the last increment on the whole grid \[Pa\], shape (nx, ny).
    pub fn tractions(&self) -> Tractions {
        let state = self.caught_up();
        let p = on_grid(&self.problem, &state, &state.interface.p, Parity::Even);
        let [q_x, q_y] = self.shear_of(&state);
        [p, q_x, q_y]
    }

    /// The outline of the contact after the last increment; `None` without one.
    pub fn outline(&self) -> Option<Outline> {
        let [p, q_x, q_y] = self.tractions();
        let tractions = convolution::Tractions {
            p: p.as_slice(),
            q_x: q_x.as_slice(),
            q_y: q_y.as_slice(),
        };
        Outline::new(&self.problem.scene.grid, &tractions)
    }

    /// The fields after the last increment on the whole grid.
    pub fn fields(&self) -> Fields {
        let s = &*self.caught_up();
        let unfold = |f: &[f64], half| on_grid(&self.problem, s, f, half);
        let now = &s.interface;
        let Motion {
            delta_z,
            phi_x,
            phi_y,
            ..
        } = s.motion;
        let stretch = self.problem.scene.friction.axis_ratio();
        let rigid = self
            .problem
            .scene
            .grid
            .map(|x, y| delta_z + y * phi_x - x * phi_y);
        let [q_x, q_y] = self.shear_of(s);
        let p = unfold(&now.p, Parity::Even);
        let [u_x, u_y, u_z] = self.domain.displacements(&self.problem, s);
        let mask = |mask: &[bool]| {
            let field: Vec<f64> = mask.iter().map(|&yes| f64::from(u8::from(yes))).collect();
            unfold(&field, Parity::Even).mapv(|yes| yes > 0.0)
        };
        let (slips, at_limit) = (mask(&now.slips), mask(&s.at_limit));
        let contact = p.mapv(|p| p > 0.0);
        let indentation = if s.indented.is_empty() {
            Array2::zeros(p.dim())
        } else {
            unfold(&s.indented, Parity::Even)
        };
        let stick = ndarray::Zip::from(&contact)
            .and(&slips)
            .and(&at_limit)
            .map_collect(|&c, &slips, &at_limit| c && (!slips || at_limit));
        // Cells beside them that stick below the limit belong to the state's mask, not here.
        let at_limit = ndarray::Zip::from(&slips)
            .and(&at_limit)
            .map_collect(|&slips, &at_limit| slips && at_limit);
        Fields {
            gap: self.offset_gap(u_z.clone() + self.problem.scene.h_init() - rigid) + &indentation,
            indentation,
            q_x,
            q_y,
            u_x,
            u_y: u_y / stretch,
            slip_x: unfold(&s.total_slip[0], Parity::Even),
            slip_y: unfold(&s.total_slip[1], Parity::Odd) / stretch,
            dissipated: unfold(&s.dissipated, Parity::Even),
            p,
            u_z,
            contact,
            stick,
            at_limit,
            yielded: self.state.yielded.clone(),
        }
    }
}
