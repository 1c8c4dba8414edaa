//! A run that starts from worn surfaces.

use contact_core::Error;
use contact_core::plan::{Mirror, Parity};
use contact_core::scene::Grid;
use ndarray::Array2;

use super::loss::Worn;

/// Worn surfaces from which a run starts, for example with another stroke; fields of shape (nx,
/// ny).
#[derive(Clone, Debug, PartialEq)]
pub struct WornStart {
    /// Cycles done.
    pub cycles: f64,
    /// Energy dissipated in them \[J\].
    pub dissipated: f64,
    /// Depth worn off body 1 and body 2, each in its own coordinates \[m\].
    pub worn: [Array2<f64>; 2],
    /// Energy per area dissipated at body 1 and body 2 \[J/m^2\].
    pub energy: [Array2<f64>; 2],
    /// Slip distance in contact \[m\].
    pub slid: Array2<f64>,
    /// Debris per area in the contact \[m\]; `None` without a bed.
    pub bed: Option<Array2<f64>>,
    /// Debris that has left \[m^3\].
    pub ejected: f64,
}

impl WornStart {
    /// Restricts the surfaces to the kept cells of a grid.
    pub(super) fn to_worn(&self, grid: &Grid, mirror: Mirror) -> Result<Worn, Error> {
        let field = |key: &str, field: &Array2<f64>| {
            let key = format!("wear.start.{key}");
            if field.dim() != (grid.nx, grid.ny) {
                let allowed = format!("of shape {} x {}, as the grid", grid.nx, grid.ny);
                return Err(Error::invalid(
                    key,
                    format!("of shape {:?}", field.dim()),
                    allowed,
                ));
            }
            let bad = |v: &&f64| !(v.is_finite() && **v >= 0.0);
            if let Some(bad) = field.iter().find(bad) {
                return Err(Error::invalid(key, bad, "finite, >= 0 in every cell"));
            }
            let kept = mirror.fold(field);
            let whole = mirror.unfold(&kept, grid.nx, grid.ny, Parity::Even);
            let largest = field.iter().fold(0.0, |m: f64, v| m.max(*v));
            let is_alike = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-6 * largest;
            if !whole.iter().zip(field).all(is_alike) {
                let allowed = "alike on both sides of y = 0 as the scene is (skip.mirror = false solves both sides)";
                return Err(Error::invalid(key, "unlike on both sides", allowed));
            }
            Ok(kept)
        };
        if !(self.cycles >= 0.0 && self.cycles.is_finite() && self.dissipated.is_finite()) {
            return Err(Error::invalid(
                "wear.start.cycles",
                self.cycles,
                "finite, >= 0",
            ));
        }
        Ok(Worn {
            cycles: self.cycles,
            depth: [
                field("worn1", &self.worn[0])?,
                field("worn2", &self.worn[1])?,
            ],
            energy: [
                field("energy1", &self.energy[0])?,
                field("energy2", &self.energy[1])?,
            ],
            slid: field("slid", &self.slid)?,
            bed: match &self.bed {
                Some(bed) => field("bed", bed)?,
                None => vec![0.0; mirror.fold(&self.slid).len()],
            },
            ejected: self.ejected / (grid.cell_area() * mirror.multiplicity()),
        })
    }
}
