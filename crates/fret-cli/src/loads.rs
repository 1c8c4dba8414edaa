//! The tractions of an increment, from a result store.

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_store::Store;
use contact_subsurface::{Eigenstress, EigenstressSolver, Side};
use ndarray::Array2;

/// The tractions of one increment.
pub(crate) struct Loads {
    pub(crate) increment: usize,
    q_x: Array2<f64>,
    q_y: Array2<f64>,
    pub(crate) p: Array2<f64>,
    stick: Array2<bool>,
    /// Bulk stress of the body in Pa.
    pub(crate) sigma_B: f64,
    /// Residual stress of the plastic strain of the body, if it may yield.
    pub(crate) eigenstress: Vec<Option<Eigenstress>>,
    /// Error bar of the stress, over it.
    pub(crate) error: Option<f64>,
}

impl Loads {
    /// Reads the given increment, or the last one kept, for body 1 or 2, with or without its bulk
    /// stress.
    pub(crate) fn read(
        store: &Store,
        increment: Option<usize>,
        body: u8,
        bulk: bool,
    ) -> Result<Self, Error> {
        let kept: Vec<usize> = store
            .column("saved_increment")?
            .into_iter()
            .map(|v| v as usize)
            .collect();
        let index = match increment {
            None => kept.len().checked_sub(1),
            Some(n) => kept.iter().position(|k| *k == n),
        };
        let Some(index) = index else {
            let requested = increment.map_or("nothing".into(), |n| n.to_string());
            return Err(Error::invalid(
                "--increment",
                requested,
                format!("one whose fields were kept: {kept:?}"),
            ));
        };
        let sigma_B = if bulk {
            let name = if body == 1 { "sigma_B1" } else { "sigma_B" };
            // Rows are increments from 1.
            let row = kept[index].wrapping_sub(1);
            let stress = store.column(name)?.get(row).copied();
            stress.ok_or_else(|| {
                let allowed = "one of the increments of the store";
                Error::invalid("saved_increment", kept[index], allowed)
            })?
        } else {
            0.0
        };
        let side = if body == 1 { Side::Body1 } else { Side::Body2 };
        let mut eigenstress = Vec::new();
        if side.body(store.scene()).yields() {
            let yielded = store.yielded(kept[index])?;
            eigenstress
                .push(EigenstressSolver::new(store.scene(), side).eigenstress(yielded.as_ref())?);
        }
        Ok(Self {
            eigenstress,
            increment: kept[index],
            sigma_B,
            error: store.stress_error(kept[index])?,
            q_x: store.field("q_x", index)?,
            q_y: store.field("q_y", index)?,
            p: store.field("p", index)?,
            stick: store.field("stick", index)?.mapv(|v| v != 0.0),
        })
    }

    /// The tractions by reference.
    pub(crate) fn tractions(&self) -> Tractions<'_> {
        Tractions {
            q_x: self.q_x.as_slice(),
            q_y: self.q_y.as_slice(),
            p: self.p.as_slice(),
        }
    }

    /// The cells that stick.
    pub(crate) fn stick(&self) -> [&[bool]; 1] {
        [self.stick.as_slice().unwrap_or_default()]
    }
}
