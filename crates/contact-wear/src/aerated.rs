//! A law whose coefficient depends on the oxygen in the cell.

use std::sync::Arc;

use contact_core::Error;

use super::law::{CellCycle, Law};
use super::variable::FactorVariable;

/// A law of the aerated and of the starved surface: `depth = starved + (aerated - starved) s`, s being the
/// aerated share of the cell.
#[derive(Clone, Debug)]
pub struct Aerated {
    /// The law in air.
    pub law: Arc<dyn Law>,
    /// The law without oxygen.
    pub starved_law: Arc<dyn Law>,
    /// Coefficients in air and without oxygen, in the unit of the law.
    pub coefficients: [f64; 2],
}

impl Law for Aerated {
    /// Depth by the law in air and without oxygen, weighted with the aerated share of each cell.
    fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error> {
        self.law.depth(cycle, depth)?;
        if cycle.aerated.is_empty() {
            return Ok(());
        }
        let mut starved = vec![0.0; depth.len()];
        self.starved_law.depth(cycle, &mut starved)?;
        for ((depth, starved), s) in depth.iter_mut().zip(&starved).zip(cycle.aerated) {
            *depth = starved + (*depth - starved) * s;
        }
        Ok(())
    }

    /// Fails if a number of the law, or the coefficient without oxygen, is out of its range.
    fn check(&self, key: &str) -> Result<(), Error> {
        self.law.check(key)?;
        let [_, starved] = self.coefficients;
        if starved >= 0.0 && starved.is_finite() {
            return Ok(());
        }
        let allowed = "a finite number >= 0, the coefficient without oxygen";
        Err(Error::invalid(format!("{key}.starved"), starved, allowed))
    }

    /// Warnings on the law, and one if it wears more without oxygen than in air.
    fn doubts(&self, key: &str) -> Vec<String> {
        let mut doubts = self.law.doubts(key);
        let [aerated, starved] = self.coefficients;
        if starved > aerated {
            doubts.push(format!(
                "{key}.starved = {starved} is above the coefficient in air, {aerated}: abrasion by oxides mostly \
                 wears more than adhesion without oxygen"
            ));
        }
        doubts
    }

    /// Whether the law needs a frequency.
    fn needs_frequency(&self) -> bool {
        self.law.needs_frequency()
    }

    /// Whether cycles below a threshold do not wear.
    fn has_threshold(&self) -> bool {
        self.law.has_threshold()
    }

    /// Whether both laws depend on the loading of the cycle alone, and not on depth, energy and cycles so far.
    fn is_steady(&self) -> bool {
        self.law.is_steady() && self.starved_law.is_steady()
    }

    /// Values of the variable at which the law bends.
    fn bends(&self, variable: FactorVariable) -> Vec<f64> {
        self.law.bends(variable)
    }

    /// The part of the depth that is worn without oxygen, at this aerated share.
    fn starved_part(&self, aerated: f64) -> f64 {
        let [in_air, starved] = self.coefficients;
        let starved = (1.0 - aerated) * starved;
        let sum = starved + aerated * in_air;
        if sum > 0.0 { starved / sum } else { 0.0 }
    }

    /// Always: the aerated share weights the two coefficients.
    fn depends_on_air(&self) -> bool {
        true
    }

    /// The law as a table of a scene file, with the coefficient without oxygen.
    fn to_toml(&self) -> Option<String> {
        let law = self.law.to_toml()?;
        let keys = law.strip_suffix(" }")?;
        Some(format!("{keys}, starved = {:?} }}", self.coefficients[1]))
    }
}
