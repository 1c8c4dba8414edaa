//! Wear laws: the depth that a cycle takes from each cell of a surface.

use std::fmt::Debug;
use std::sync::Arc;

use contact_core::Error;
use plausible::doubt_of;

use super::variable::FactorVariable;

/// Loading of each cell of a surface in one cycle, in the coordinates of its own body.
#[derive(Clone, Copy, Debug, Default)]
pub struct CellCycle<'a> {
    /// Integral of the pressure over the slip, `int p |ds|` \[Pa m\] = \[J/m^2\] per unit of mu.
    pub pressure_times_slip: &'a [f64],
    /// Slip distance in contact, `int |ds|` \[m\].
    pub slip_distance: &'a [f64],
    /// Energy dissipated by friction per area, `-int q . ds` \[J/m^2\].
    pub dissipated: &'a [f64],
    /// Depth worn so far \[m\].
    pub worn: &'a [f64],
    /// Energy dissipated per area so far \[J/m^2\].
    pub energy: &'a [f64],
    /// Cycles done so far.
    pub cycles: f64,
    /// Cycles per second \[Hz\]; not a number where none is given.
    pub frequency: f64,
    /// Share of the cell that oxygen reaches; empty without a model of the air.
    pub aerated: &'a [f64],
    /// Debris per area in the cell \[m\]; empty without a bed.
    pub debris: &'a [f64],
    /// Factor of the depth by the protection of the bed; empty without one.
    pub protection: &'a [f64],
}

/// A law of wear. The user's own is any type with this trait.
pub trait Law: Debug + Send + Sync {
    /// Writes the depth \[m\], >= 0, that one cycle takes from each cell. It is ignored where
    /// nothing is pressed or nothing slips (`pressure_times_slip` = 0), since nothing wears there.
    fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error>;

    /// Fails with the key, the value and what is allowed if a parameter is out of its range.
    fn check(&self, _key: &str) -> Result<(), Error> {
        Ok(())
    }

    /// Sentences on numbers that are allowed but unlikely; `key` names the law.
    fn doubts(&self, _key: &str) -> Vec<String> {
        Vec::new()
    }

    /// Checks that it needs a frequency.
    fn needs_frequency(&self) -> bool {
        false
    }

    /// Checks that cycles below a threshold do not wear.
    fn has_threshold(&self) -> bool {
        false
    }

    /// Checks that the depth depends on the loading of the cycle alone, not on depth, energy and
    /// cycles so far. A law that is not steady is evaluated several times in a jump.
    fn is_steady(&self) -> bool {
        false
    }

    /// Values of a variable at which the law bends, ascending. A jump ends at bends in the cycles,
    /// and a cell is followed from one value of its energy to the next.
    fn bends(&self, _of: FactorVariable) -> Vec<f64> {
        Vec::new()
    }

    /// Part of the depth that is worn without oxygen, given the aerated share of a cell.
    fn starved_part(&self, aerated: f64) -> f64 {
        1.0 - aerated
    }

    /// Checks that the depth depends on the aerated share.
    fn depends_on_air(&self) -> bool {
        false
    }

    /// The law as a table of a scene file; `None` if a file cannot represent it.
    fn to_toml(&self) -> Option<String> {
        None
    }
}

/// J. F. Archard's law (J. Appl. Phys. 24 (1953) 981-988), taken cell by cell: `dh = k p |ds|`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Archard {
    /// Local wear coefficient k \[m^2/N\] = \[1/Pa\]; 1e-8 per MPa is 1e-14.
    pub k: f64,
    /// Way slipped per cycle below which a cell does not wear, and beyond which only the rest
    /// counts \[m\] (default 0).
    pub threshold: f64,
}

impl Law for Archard {
    /// k times the integral of p ds in each cell, the part beyond the threshold of slip.
    fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error> {
        for (n, depth) in depth.iter_mut().enumerate() {
            let counts = above_threshold(cycle.slip_distance[n], self.threshold);
            *depth = self.k * counts * cycle.pressure_times_slip[n];
        }
        Ok(())
    }

    /// Fails if k or the threshold is negative or not finite.
    fn check(&self, key: &str) -> Result<(), Error> {
        check_not_negative(&format!("{key}.k"), self.k, "m^2/N")?;
        check_not_negative(
            &format!("{key}.threshold"),
            self.threshold,
            "m of slip per cycle",
        )
    }

    /// Equal cycles wear equally: the depth follows from what happens within the cycle.
    fn is_steady(&self) -> bool {
        true
    }

    /// Whether small slips do not wear.
    fn has_threshold(&self) -> bool {
        self.threshold > 0.0
    }

    /// A warning if k is implausibly large or small. A negative k is an error, not a doubt.
    fn doubts(&self, key: &str) -> Vec<String> {
        let k = doubt_of("Archard.k", &format!("{key}.k"), self.k.max(0.0));
        k.into_iter().collect()
    }

    /// The law as a table of a scene file.
    fn to_toml(&self) -> Option<String> {
        Some(format!(
            "{{ k = {:?}, threshold = {:?} }}",
            self.k, self.threshold
        ))
    }
}

/// Wear by the energy dissipated (S. Fouvry, P. Kapsa, L. Vincent, Wear 200 (1996) 186-205), taken
/// cell by cell: `dh = -alpha q . ds`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DissipatedEnergy {
    /// Energy wear coefficient alpha \[m^3/J\] = \[1/Pa\].
    pub alpha: f64,
    /// Energy per area and cycle below which a cell does not wear, and beyond which only the rest
    /// counts \[J/m^2\] (default 0).
    pub threshold: f64,
}

impl Law for DissipatedEnergy {
    /// alpha times the dissipated energy of each cell, the part beyond the threshold.
    fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error> {
        for (n, depth) in depth.iter_mut().enumerate() {
            let energy = cycle.dissipated[n];
            *depth = self.alpha * above_threshold(energy, self.threshold) * energy;
        }
        Ok(())
    }

    /// Fails if alpha or the threshold is negative or not finite.
    fn check(&self, key: &str) -> Result<(), Error> {
        check_not_negative(&format!("{key}.alpha"), self.alpha, "m^3/J")?;
        check_not_negative(
            &format!("{key}.threshold"),
            self.threshold,
            "J/m^2 per cycle",
        )
    }

    /// Equal cycles wear equally: the depth follows from what happens within the cycle.
    fn is_steady(&self) -> bool {
        true
    }

    /// Whether small energies do not wear.
    fn has_threshold(&self) -> bool {
        self.threshold > 0.0
    }

    /// A warning if alpha is implausibly large or small. A negative alpha is an error, not a doubt.
    fn doubts(&self, key: &str) -> Vec<String> {
        let key = format!("{key}.alpha");
        let alpha = doubt_of("DissipatedEnergy.alpha", &key, self.alpha.max(0.0));
        alpha.into_iter().collect()
    }

    /// The law as a table of a scene file.
    fn to_toml(&self) -> Option<String> {
        Some(format!(
            "{{ alpha = {:?}, threshold = {:?} }}",
            self.alpha, self.threshold
        ))
    }
}

/// The part of a quantity beyond its threshold; the whole quantity without one.
fn above_threshold(value: f64, threshold: f64) -> f64 {
    if threshold > 0.0 {
        if value > threshold {
            1.0 - threshold / value
        } else {
            0.0
        }
    } else {
        1.0
    }
}

/// Fails unless a constant is finite and not negative; `unit` is named in the error.
fn check_not_negative(key: &str, value: f64, unit: &str) -> Result<(), Error> {
    if value >= 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(Error::invalid(
        key,
        value,
        format!("a finite number >= 0 in {unit}"),
    ))
}

/// Wear of one body: a law for each of its layers.
#[derive(Clone, Debug, Default)]
pub struct BodyWear {
    /// A law for each coating, the outermost first, then one for the substrate. A single law holds
    /// for all layers. Without a law the body does not wear.
    pub laws: Vec<Arc<dyn Law>>,
    /// Factor of the depths of the laws for this body (default 1): how the wear of the pair is
    /// divided between its bodies.
    pub share: Option<f64>,
}

impl BodyWear {
    /// A body with one law for all its layers.
    pub fn with_law(law: impl Law + 'static) -> Self {
        Self {
            laws: vec![Arc::new(law)],
            share: None,
        }
    }

    /// The user's own laws, which no file can hold.
    pub fn user_laws(&self) -> Vec<Arc<dyn Law>> {
        let user_laws = self.laws.iter().filter(|law| law.to_toml().is_none());
        user_laws.cloned().collect()
    }

    /// Replaces the placeholders by the user's own laws, in turn.
    pub(super) fn set_user_laws(&mut self, own: &[Arc<dyn Law>]) {
        let places = self.laws.iter_mut().filter(|law| law.to_toml().is_none());
        places.zip(own).for_each(|(law, own)| law.clone_from(own));
    }

    /// The law of a layer, 0 the outermost.
    pub(super) fn law(&self, layer: usize) -> Option<&dyn Law> {
        let only = if self.laws.len() == 1 { 0 } else { layer };
        self.laws.get(only).map(|law| &**law)
    }

    /// Whether any layer has a law.
    pub(crate) fn has_wear(&self) -> bool {
        !self.laws.is_empty()
    }

    /// Fails if the laws do not fit the layers of the body, or a number is out of its range.
    pub(crate) fn check(&self, key: &str, layers: usize) -> Result<(), Error> {
        if self.laws.len() > 1 && self.laws.len() != layers {
            return Err(Error::invalid(
                format!("{key}.laws"),
                format!("{} laws", self.laws.len()),
                format!(
                    "one law, or one for each of the {layers} layers (coatings, then substrate)"
                ),
            ));
        }
        if let Some(share) = self.share.filter(|share| !(0.0..=1.0).contains(share)) {
            return Err(Error::invalid(
                format!("{key}.share"),
                share,
                "between 0 and 1",
            ));
        }
        self.laws.iter().try_for_each(|law| law.check(key))
    }

    /// Whether the coefficients stay the same in a jump, whatever the depth.
    pub(super) fn is_steady(&self) -> bool {
        self.laws.len() <= 1 && self.laws.iter().all(|law| law.is_steady())
    }

    /// Part of the depth that is worn without oxygen off the layer that is bare at a depth \[m\].
    pub(super) fn starved_part(&self, worn: f64, thickness: &[f64], aerated: f64) -> f64 {
        let law = self.law(layer_at(worn, thickness));
        law.map_or(0.0, |law| law.starved_part(aerated))
    }

    /// Values of a variable at which a law bends, ascending.
    pub(super) fn bends(&self, variable: FactorVariable) -> Vec<f64> {
        let mut bends: Vec<f64> = self
            .laws
            .iter()
            .flat_map(|law| law.bends(variable))
            .collect();
        bends.sort_by(f64::total_cmp);
        bends.dedup();
        bends
    }

    /// The depth that one cycle takes from each cell \[m\], by the law of the bare layer;
    /// `thickness` of the coatings \[m\].
    pub(super) fn depth(
        &self,
        cycle: &CellCycle<'_>,
        thickness: &[f64],
        depth: &mut [f64],
    ) -> Result<(), Error> {
        depth.fill(0.0);
        let mut of_law = vec![0.0; depth.len()];
        for layer in 0..=thickness.len() {
            let bare = |n: usize| layer_at(cycle.worn[n], thickness) == layer;
            let Some(law) = self.law(layer) else { continue };
            if !(0..depth.len()).any(bare) {
                continue;
            }
            law.depth(cycle, &mut of_law)?;
            for n in (0..depth.len()).filter(|&n| bare(n)) {
                if cycle.pressure_times_slip[n] > 0.0 {
                    depth[n] = self.share.unwrap_or(1.0) * of_law[n];
                    if let Some(factor) = cycle.protection.get(n) {
                        depth[n] *= factor;
                    }
                }
            }
        }
        match depth.iter().find(|d| !(**d >= 0.0 && d.is_finite())) {
            Some(bad) => Err(Error::invalid(
                "wear.law",
                format!("a depth of {bad:e} m in a cycle"),
                "finite and >= 0 in every cell: nothing grows",
            )),
            None => Ok(()),
        }
    }
}

/// The layer that is bare at a worn depth, 0 the outermost coating.
pub(crate) fn layer_at(worn: f64, thickness: &[f64]) -> usize {
    let mut bottom = 0.0;
    for (layer, h) in thickness.iter().enumerate() {
        bottom += h;
        if worn < bottom {
            return layer;
        }
    }
    thickness.len()
}

#[cfg(test)]
mod tests {
    use super::{Archard, BodyWear, CellCycle, DissipatedEnergy, layer_at};
    use std::sync::Arc;

    #[test]
    fn the_bare_layer_decides_how_fast_a_cell_wears() {
        let archard = |k| Archard { k, threshold: 0.0 };
        let body = BodyWear {
            laws: vec![Arc::new(archard(1.0)), Arc::new(archard(5.0))],
            share: Some(0.5),
        };
        let cycle = CellCycle {
            pressure_times_slip: &[2.0, 2.0, 0.0],
            slip_distance: &[1.0; 3],
            dissipated: &[0.2; 3],
            worn: &[0.5, 1.0, 3.0],
            energy: &[0.0; 3],
            cycles: 0.0,
            frequency: f64::NAN,
            ..CellCycle::default()
        };
        let mut depth = [9.0; 3];
        body.depth(&cycle, &[1.0], &mut depth).unwrap();
        assert_eq!(depth, [1.0, 5.0, 0.0]);
        assert_eq!(layer_at(1.5, &[1.0, 2.0]), 1);
    }

    #[test]
    fn below_the_threshold_nothing_wears() {
        let law = DissipatedEnergy {
            alpha: 2.0,
            threshold: 1.0,
        };
        let cycle = CellCycle {
            pressure_times_slip: &[1.0; 3],
            slip_distance: &[1.0; 3],
            dissipated: &[0.5, 1.0, 3.0],
            worn: &[0.0; 3],
            energy: &[0.0; 3],
            cycles: 0.0,
            frequency: f64::NAN,
            ..CellCycle::default()
        };
        let mut depth = [9.0; 3];
        super::Law::depth(&law, &cycle, &mut depth).unwrap();
        assert_eq!(depth, [0.0, 0.0, 4.0]);
    }
}
