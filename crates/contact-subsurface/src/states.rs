//! The states that act on a body, and the shared data of sections, slices and points.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::kernels::{DepthKernel, Quantity, Stack, check_not_rigid};
use contact_core::scene::{Body, Grid, ResidualStress};
use contact_core::stop::unless;
use stress_tensor::StressTensor;

use super::continuation::{Continuation, Window};
use super::near_rim::NearRim;
use super::uniform::Uniform;
use super::{Depth, Eigenstress, Side};

/// Tractions and uniform stresses of a body in one or several states of a contact. A slice or array
/// of [`Tractions`] converts to states with defaults for everything else.
#[derive(Clone, Debug, Default)]
pub struct States<'a> {
    /// Tractions of each state \[Pa\], each field of shape (nx, ny) of the grid.
    pub tractions: &'a [Tractions<'a>],
    /// Bulk stress of the body in each state \[Pa\] (default: 0, also for states beyond the list).
    /// In each layer it enters with that layer's modulus.
    pub sigma_B: &'a [f64],
    /// Residual stress of the layers, which replaces the stress of the body (default: the stress of
    /// the body).
    pub residual: Option<&'a ResidualStress>,
    /// Residual stress of the plastic strain of the body in each state; `None` where nothing has yielded.
    /// A body that may yield asks for one in each state ([`super::EigenstressSolver`]); another has none
    /// (default: none).
    pub eigenstress: &'a [Option<Eigenstress>],
    /// The cells that stick in each state. If given, the tractions belong to contacts (states
    /// beyond the list slip at their rim) and vary within the cells near the rim, the stick zone
    /// and the surface (default: `None`, tractions constant in each cell).
    pub stick: Option<&'a [&'a [bool]]>,
    /// The tractions within the cells that were computed before for these states of this body
    /// ([`Continuation::new`]); they are used where they hold the samples (default: none).
    pub continuations: &'a [Continuation],
    /// Once raised, ends the computation with [`Error::Interrupted`] (default: never).
    pub stop: Arc<AtomicBool>,
}

impl<'a> From<&'a [Tractions<'a>]> for States<'a> {
    /// Tractions alone, constant in each cell.
    fn from(tractions: &'a [Tractions<'a>]) -> Self {
        Self {
            tractions,
            ..Self::default()
        }
    }
}

impl<'a, const N: usize> From<&'a [Tractions<'a>; N]> for States<'a> {
    /// Tractions alone, constant in each cell.
    fn from(tractions: &'a [Tractions<'a>; N]) -> Self {
        tractions.as_slice().into()
    }
}

impl<'a> From<&'a Vec<Tractions<'a>>> for States<'a> {
    /// Tractions alone, constant in each cell.
    fn from(tractions: &'a Vec<Tractions<'a>>) -> Self {
        tractions.as_slice().into()
    }
}

/// A body under states of a contact.
pub(super) struct Loaded {
    pub(super) body: Body,
    pub(super) side: Side,
    pub(super) grid: Grid,
    /// Number of states.
    pub(super) states: usize,
    /// The correction for tractions that vary within the cells, if any.
    pub(super) rim: Option<NearRim>,
    pub(super) stop: Arc<AtomicBool>,
    stack: Stack,
    uniform: Uniform,
}

impl Loaded {
    /// Prepares samples in a window of columns and rows of the grid.
    pub(super) fn new(
        body: &Body,
        side: Side,
        grid: &Grid,
        states: &States<'_>,
        window: impl FnOnce() -> Result<Window, Error>,
    ) -> Result<Self, Error> {
        body.check_alone()?;
        grid.check_alone()?;
        let window = window()?;
        let near = |stick| {
            let (tractions, continuations) = (states.tractions, states.continuations);
            NearRim::new((body, side), grid, tractions, stick, continuations, &window)
        };
        Ok(Self {
            stack: Stack::new(body),
            body: body.clone(),
            side,
            grid: *grid,
            states: states.tractions.len(),
            uniform: Uniform::new(
                (body, grid),
                states.sigma_B,
                states.residual,
                states.eigenstress,
                states.tractions.len(),
            )?,
            rim: states.stick.map(near),
            stop: states.stop.clone(),
        })
    }

    /// The kernel at a depth, out to a distance from the load \[m\].
    pub(super) fn kernel<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        depth: Depth,
        reach: f64,
    ) -> Result<DepthKernel<Q, N, R>, Error> {
        check_not_rigid(&self.body, depth.layer)?;
        unless(&self.stop)?;
        let position = self.stack.locate_depth(depth.z, Some(depth.layer))?;
        let (dx, dy) = (self.grid.dx, self.grid.dy);
        DepthKernel::new(&self.stack, position, reach, (dx, dy))
    }

    /// Tabulates the kernels at several depths together, for [`Self::kernel`] with the same reach. A
    /// depth that has no kernel is left to [`Self::kernel`], which refuses it.
    pub(super) fn tabulate_kernels<Q: Quantity<N, R>, const N: usize, const R: usize>(
        &self,
        depths: &[Depth],
        reach: f64,
    ) -> Result<(), Error> {
        unless(&self.stop)?;
        let locate = |depth: &Depth| {
            check_not_rigid(&self.body, depth.layer).ok()?;
            self.stack.locate_depth(depth.z, Some(depth.layer)).ok()
        };
        let places: Vec<_> = depths.iter().filter_map(locate).collect();
        DepthKernel::<Q, N, R>::prepare(&self.stack, &places, reach)
    }

    /// s_xx and s_yy of a state at a depth that are the same all over the depth \[Pa\].
    pub(super) fn uniform(&self, state: usize, depth: Depth) -> [f64; 4] {
        self.uniform.stress(&self.body, state, depth)
    }

    /// The residual stress of plastic strain in a state, at a place \[Pa\]; `None` without plastic
    /// strain.
    pub(super) fn eigenstress_at(
        &self,
        state: usize,
        place: (f64, f64),
        depth: Depth,
    ) -> Option<StressTensor> {
        self.uniform.eigenstress_at(state, place, depth)
    }
}
