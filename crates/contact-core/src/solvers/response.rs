//! The bodies as the solvers know them: displacements under tractions, and an approximate inverse.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::cells::{dot, set};
use crate::convolution::{
    ApproximateInverse, Convolutions, Displacements, SurfaceOperator, Tractions,
};

/// The surface operator and, where there is one, its approximate inverse.
pub struct Response<'a> {
    /// u = C * q.
    pub op: &'a mut dyn SurfaceOperator,
    /// Preconditioner; without it the conjugate gradients are plain.
    pub inverse: Option<&'a mut dyn ApproximateInverse>,
    /// Raised from outside to end the iterations.
    pub stop: Option<&'a AtomicBool>,
    /// Work of the operator after which the iterations end.
    pub most_work: Convolutions,
    /// Whether responses to changes of the tractions are computed in double precision too.
    pub exact: bool,
    /// Sum of the squares of the changes whose responses have been added since the last full
    /// evaluation \[Pa^2\].
    pub squares: f64,
}

impl<'a> Response<'a> {
    /// Of an operator alone.
    pub fn plain(op: &'a mut dyn SurfaceOperator) -> Self {
        Self {
            op,
            inverse: None,
            stop: None,
            most_work: Convolutions::MAX,
            exact: false,
            squares: 0.0,
        }
    }

    /// Whether the iterations are to end, converged or not.
    pub(crate) fn stopped(&self) -> bool {
        let raised = self.stop.is_some_and(|flag| flag.load(Ordering::Relaxed));
        raised || self.op.work() >= self.most_work
    }

    /// Estimated rounding error of the displacements \[m\]: `rounding` times the root of the sum of
    /// the squared changes, since each response has a relative error of its own; zero in double
    /// precision.
    pub(crate) fn rounded(&self) -> f64 {
        if self.exact {
            0.0
        } else {
            self.op.rounding() * self.squares.sqrt()
        }
    }

    /// Adds the sum of squares of a change of the tractions \[Pa^2\] to the estimate of rounding.
    pub(crate) fn changed(&mut self, squares: f64) {
        self.squares += squares;
    }

    /// The displacements under a change of the tractions; counted for rounding.
    pub(crate) fn respond(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        let parts = [tractions.q_x, tractions.q_y, tractions.p];
        let squares = parts.into_iter().flatten().map(|part| dot(part, part));
        self.changed(squares.sum());
        self.answer(tractions, displacements);
    }

    fn answer(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        if self.exact {
            self.op.apply(tractions, displacements);
        } else {
            self.op.respond(tractions, displacements);
        }
    }

    /// u_z under a change of p alone; the caller counts it for rounding ([`Self::changed`]).
    pub(crate) fn normal(&mut self, p: &[f64], u_z: &mut [f64]) {
        let tractions = Tractions {
            p: Some(p),
            ..Tractions::default()
        };
        self.answer(
            tractions,
            Displacements {
                u_z: Some(u_z),
                ..Displacements::default()
            },
        );
    }

    /// u_x, u_y under a change of shear alone; the caller counts it for rounding
    /// ([`Self::changed`]).
    pub(crate) fn tangential(&mut self, q: [&[f64]; 2], u: [&mut [f64]; 2]) {
        let [u_x, u_y] = u;
        let tractions = Tractions {
            q_x: Some(q[0]),
            q_y: Some(q[1]),
            p: None,
        };
        let displacements = Displacements {
            u_x: Some(u_x),
            u_y: Some(u_y),
            u_z: None,
        };
        self.answer(tractions, displacements);
    }

    /// u_z under a change of shear alone; counted for rounding.
    pub(crate) fn normal_under_shear(&mut self, q: [&[f64]; 2], u_z: &mut [f64]) {
        let tractions = Tractions {
            q_x: Some(q[0]),
            q_y: Some(q[1]),
            p: None,
        };
        self.respond(
            tractions,
            Displacements {
                u_z: Some(u_z),
                ..Displacements::default()
            },
        );
    }

    /// z ~ C_zz^-1 r, up to a factor; r itself without a preconditioner, or if it is not wanted.
    pub(crate) fn invert_normal(&mut self, r: &[f64], z: &mut [f64], wanted: bool) {
        match &mut self.inverse {
            Some(inverse) if wanted => inverse.normal(r, z),
            _ => z.copy_from_slice(r),
        }
    }

    /// z ~ C_tt^-1 r; without a preconditioner r / C_xx(0,0).
    pub(crate) fn invert_tangential(&mut self, r: [&[f64]; 2], z: [&mut [f64]; 2]) {
        let (c_xx, _) = self.op.self_coefficients();
        match &mut self.inverse {
            Some(inverse) => inverse.tangential(r, z),
            None => set(r, z, |_, r, _| r.map(|r| r / c_xx)),
        }
    }
}
