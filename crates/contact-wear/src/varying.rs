//! A wear coefficient that is not constant: a law times a factor by a table.

use std::cmp::Ordering;
use std::sync::Arc;

use contact_core::Error;
use contact_core::scene::{FrictionHistory, History};

use super::law::{CellCycle, Law};
use super::variable::FactorVariable;

/// A factor of a wear coefficient, piecewise linear, level beyond its ends.
///
/// A jump ends at the places of a table of cycles, and follows each cell from place to place of a
/// table of the energy. Pressure and power density are taken from the last solved cycle. The
/// comparison with two halves shows their change. A factor that changes faster than in proportion
/// to the pressure makes the pressure of long jumps oscillate.
#[derive(Clone, Debug, PartialEq)]
pub struct Factor {
    /// The variable.
    pub variable: FactorVariable,
    /// Pairs of the variable, ascending, and the factor.
    pub table: Vec<(f64, f64)>,
}

impl Factor {
    /// Fails at a table of the factor that is empty, does not rise, or has a negative factor.
    pub(crate) fn check(&self, key: &str) -> Result<(), Error> {
        let key = format!("{key}.factor.table");
        if self.table.is_empty() {
            return Err(Error::invalid(key, "empty", "at least one pair"));
        }
        let grows = |w: &[(f64, f64)]| w[1].0.partial_cmp(&w[0].0) == Some(Ordering::Greater);
        if let Some(pair) = self.table.windows(2).find(|w| !grows(w)) {
            let allowed = format!(
                "more than {:e}: the first numbers of the pairs grow",
                pair[0].0
            );
            return Err(Error::invalid(key, pair[1].0, allowed));
        }
        let bad =
            |(at, factor): &&(f64, f64)| !(at.is_finite() && *factor >= 0.0 && factor.is_finite());
        match self.table.iter().find(bad) {
            Some((at, factor)) => Err(Error::invalid(
                key,
                format!("[{at:?}, {factor:?}]"),
                "finite numbers, the factor >= 0",
            )),
            None => Ok(()),
        }
    }

    /// Multiplies the depth of every cell by its factor.
    fn multiply(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) {
        let table = FrictionHistory {
            of: History::Cycles,
            table: self.table.clone(),
        };
        let everywhere = table.factor(cycle.cycles);
        for (n, depth) in depth.iter_mut().enumerate() {
            *depth *= match self.variable {
                FactorVariable::Cycles => everywhere,
                FactorVariable::Pressure if cycle.slip_distance[n] > 0.0 => {
                    table.factor(cycle.pressure_times_slip[n] / cycle.slip_distance[n])
                }
                FactorVariable::Pressure => table.factor(0.0),
                FactorVariable::PowerDensity => table.factor(cycle.dissipated[n] * cycle.frequency),
                FactorVariable::Energy => table.factor(cycle.energy[n]),
            };
        }
    }

    /// The factor as a table of a scene file.
    fn to_toml(&self) -> String {
        let pairs: Vec<String> = self
            .table
            .iter()
            .map(|(at, f)| format!("[{at:?}, {f:?}]"))
            .collect();
        format!(
            "{{ of = \"{}\", table = [{}] }}",
            self.variable.name(),
            pairs.join(", ")
        )
    }
}

/// A law whose coefficient changes by a factor.
#[derive(Clone, Debug)]
pub struct Varying {
    /// The law where the factor is 1.
    pub law: Arc<dyn Law>,
    /// The factor.
    pub factor: Factor,
}

impl Law for Varying {
    /// The depth by the law, times the factor of each cell.
    fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error> {
        self.law.depth(cycle, depth)?;
        self.factor.multiply(cycle, depth);
        Ok(())
    }

    /// Fails if the law or its factor has no meaning.
    fn check(&self, key: &str) -> Result<(), Error> {
        self.law.check(key)?;
        self.factor.check(key)
    }

    /// The law as a table of a scene file, with its factor.
    fn to_toml(&self) -> Option<String> {
        let law = self.law.to_toml()?;
        let keys = law.strip_suffix(" }")?;
        Some(format!("{keys}, factor = {} }}", self.factor.to_toml()))
    }

    /// Warnings on the law.
    fn doubts(&self, key: &str) -> Vec<String> {
        self.law.doubts(key)
    }

    /// Whether the law, or its factor of power density, needs a frequency.
    fn needs_frequency(&self) -> bool {
        self.factor.variable == FactorVariable::PowerDensity || self.law.needs_frequency()
    }

    /// Whether cycles below a threshold do not wear.
    fn has_threshold(&self) -> bool {
        self.law.has_threshold()
    }

    /// Part of the depth that the law wears without oxygen; the factor does not change it.
    fn starved_part(&self, aerated: f64) -> f64 {
        self.law.starved_part(aerated)
    }

    /// Whether the law depends on the aerated share.
    fn depends_on_air(&self) -> bool {
        self.law.depends_on_air()
    }

    /// Whether law and factor depend on the loading of the cycle alone, and not on depth, energy and cycles so
    /// far.
    fn is_steady(&self) -> bool {
        let of_loading = matches!(
            self.factor.variable,
            FactorVariable::Pressure | FactorVariable::PowerDensity
        );
        of_loading && self.law.is_steady()
    }

    /// Bends of the law, and the rows of the factor's table over this variable.
    fn bends(&self, variable: FactorVariable) -> Vec<f64> {
        let mut bends = self.law.bends(variable);
        if self.factor.variable == variable {
            bends.extend(self.factor.table.iter().map(|(at, _)| at));
        }
        bends
    }
}

#[cfg(test)]
mod tests {
    use super::{Factor, Varying};
    use crate::FactorVariable;
    use crate::{Archard, CellCycle, Law};
    use std::sync::Arc;

    #[test]
    fn the_coefficient_follows_its_table() {
        let cycle = CellCycle {
            pressure_times_slip: &[2.0, 4.0],
            slip_distance: &[1.0, 1.0],
            dissipated: &[1.0, 3.0],
            worn: &[0.0; 2],
            energy: &[10.0, 20.0],
            cycles: 5.0,
            frequency: 10.0,
            ..CellCycle::default()
        };
        for (of, table, asked) in [
            (
                FactorVariable::Cycles,
                vec![(0.0, 1.0), (10.0, 2.0)],
                [3.0, 6.0],
            ),
            (
                FactorVariable::Pressure,
                vec![(2.0, 1.0), (4.0, 0.5)],
                [2.0, 2.0],
            ),
            (
                FactorVariable::PowerDensity,
                vec![(10.0, 3.0), (20.0, 1.0)],
                [6.0, 4.0],
            ),
            (
                FactorVariable::Energy,
                vec![(0.0, 0.0), (20.0, 2.0)],
                [2.0, 8.0],
            ),
        ] {
            let law = Arc::new(Archard {
                k: 1.0,
                threshold: 0.0,
            });
            let law = Varying {
                law,
                factor: Factor {
                    variable: of,
                    table,
                },
            };
            let mut depth = [0.0; 2];
            law.depth(&cycle, &mut depth).unwrap();
            assert_eq!(depth, asked, "{of:?}");
            assert!(law.check("wear.body1").is_ok());
        }
        let wrong = Factor {
            variable: FactorVariable::Cycles,
            table: vec![(1.0, 1.0), (1.0, 2.0)],
        };
        assert!(wrong.check("wear.body1").is_err());
    }
}
