//! The bodies as seen by the solvers: displacements under tractions, and an approximate inverse.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::cells::{dot, set_fields};
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
    pub max_work: Convolutions,
    /// Whether responses to changes of the tractions are computed in double precision too.
    pub exact: bool,
    /// Sum of the squares of the changes whose responses have been added since the last full
    /// evaluation \[Pa^2\].
    pub squares: f64,
}

impl<'a> Response<'a> {
    /// Wraps an operator without a preconditioner.
    pub fn plain(op: &'a mut dyn SurfaceOperator) -> Self {
        Self {
            op,
            inverse: None,
            stop: None,
            max_work: Convolutions::MAX,
            exact: false,
            squares: 0.0,
        }
    }

    /// Whether the iterations must end, converged or not.
    pub(crate) fn must_stop(&self) -> bool {
        let raised = self.stop.is_some_and(|flag| flag.load(Ordering::Relaxed));
        raised || self.op.work() >= self.max_work
    }

    /// Estimated rounding error of the displacements \[m\]: `rounding` times the root of the sum of
    /// the squared changes, since each response has a relative error of its own; zero in double
    /// precision.
    pub(crate) fn rounding_error(&self) -> f64 {
        if self.exact {
            0.0
        } else {
            self.op.rounding() * self.squares.sqrt()
        }
    }

    /// Adds the sum of squares of a change of the tractions \[Pa^2\] to the estimate of rounding.
    pub(crate) fn count_change(&mut self, squares: f64) {
        self.squares += squares;
    }

    /// Computes the displacements under a change of the tractions, and counts it for rounding.
    pub(crate) fn respond(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        let parts = [tractions.q_x, tractions.q_y, tractions.p];
        let squares = parts.into_iter().flatten().map(|part| dot(part, part));
        self.count_change(squares.sum());
        self.apply_or_respond(tractions, displacements);
    }

    /// Computes the displacements in double precision where `exact` is set, otherwise in the precision for
    /// changes.
    fn apply_or_respond(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        if self.exact {
            self.op.apply(tractions, displacements);
        } else {
            self.op.respond(tractions, displacements);
        }
    }

    /// Computes u_z under a change of p alone; the caller counts it for rounding ([`Self::count_change`]).
    pub(crate) fn respond_to_pressure(&mut self, p: &[f64], u_z: &mut [f64]) {
        let tractions = Tractions {
            p: Some(p),
            ..Tractions::default()
        };
        self.apply_or_respond(
            tractions,
            Displacements {
                u_z: Some(u_z),
                ..Displacements::default()
            },
        );
    }

    /// Computes u_x, u_y under a change of shear alone; the caller counts it for rounding
    /// ([`Self::count_change`]).
    pub(crate) fn respond_to_shear(&mut self, q: [&[f64]; 2], u: [&mut [f64]; 2]) {
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
        self.apply_or_respond(tractions, displacements);
    }

    /// Computes u_z under a change of shear alone, and counts it for rounding.
    pub(crate) fn respond_normally_to_shear(&mut self, q: [&[f64]; 2], u_z: &mut [f64]) {
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

    /// Computes z ~ C_zz^-1 r, up to a factor; copies r without a preconditioner, or unless `precondition`.
    pub(crate) fn invert_normal(&mut self, r: &[f64], z: &mut [f64], precondition: bool) {
        match &mut self.inverse {
            Some(inverse) if precondition => inverse.normal(r, z),
            _ => z.copy_from_slice(r),
        }
    }

    /// Computes z ~ C_tt^-1 r; without a preconditioner r / C_xx(0,0).
    pub(crate) fn invert_tangential(&mut self, r: [&[f64]; 2], z: [&mut [f64]; 2]) {
        let (c_xx, _) = self.op.self_coefficients();
        match &mut self.inverse {
            Some(inverse) => inverse.tangential(r, z),
            None => set_fields(r, z, |_, r, _| r.map(|r| r / c_xx)),
        }
    }
}
