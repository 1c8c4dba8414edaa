//! What the solvers ask of the bodies: displacements under tractions, and a guess of the inverse.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::cells::{dot, set};
use crate::convolution::{ApproximateInverse, Displacements, SurfaceOperator, Tractions};

/// The surface operator and, where there is one, its approximate inverse.
pub struct Response<'a> {
    /// u = C * q.
    pub op: &'a mut dyn SurfaceOperator,
    /// Preconditioner; without it the conjugate gradients are plain.
    pub inverse: Option<&'a mut dyn ApproximateInverse>,
    /// Raised from outside to end the iterations.
    pub stop: Option<&'a AtomicBool>,
    /// Transforms of the operator after which the iterations end.
    pub last_transform: usize,
    /// Whether changes of the tractions are answered with all digits too.
    pub exact: bool,
    /// Sum of the squares of the changes that have been added up since the last evaluation \[Pa^2\].
    pub squares: f64,
}

impl<'a> Response<'a> {
    /// Of an operator alone.
    pub fn plain(op: &'a mut dyn SurfaceOperator) -> Self {
        Self {
            op,
            inverse: None,
            stop: None,
            last_transform: usize::MAX,
            exact: false,
            squares: 0.0,
        }
    }

    /// Whether the iterations are to end, converged or not.
    pub(crate) fn stopped(&self) -> bool {
        let raised = self.stop.is_some_and(|flag| flag.load(Ordering::Relaxed));
        raised || self.op.transforms() >= self.last_transform
    }

    /// What the displacements may miss by the changes that they are made of \[m\]; zero where all have
    /// all digits. Each change misses a part of its size, whatever is left of it by those that follow.
    pub(crate) fn rounded(&self) -> f64 {
        if self.exact {
            0.0
        } else {
            self.op.rounding() * self.squares.sqrt()
        }
    }

    /// Takes note of a change that displacements have followed, the sum of its squares \[Pa^2\].
    pub(crate) fn changed(&mut self, squares: f64) {
        self.squares += squares;
    }

    /// The displacements under a change of the tractions, which are added up.
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

    /// u_z under a change of p alone; whoever adds it up, or a multiple, notes the change.
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

    /// u_x, u_y under a change of shear alone; whoever adds them up, or a multiple, notes the change.
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

    /// u_z under a change of shear alone, which is added up.
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
