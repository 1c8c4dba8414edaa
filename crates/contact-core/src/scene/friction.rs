//! Friction laws.

use std::cmp::Ordering;

use super::{FrictionLaw, Grid, OwnFriction, SurfaceMap};
use crate::error::Error;

/// Coulomb's law, `|q| <= mu p`, with a coefficient that may depend on the direction, the place and
/// the history of each cell.
///
/// The coefficient of an increment is that of the history at its end, extrapolated from the last
/// increment where the path goes on.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// Coefficient mu >= 0, where it depends on the direction that along x; 0 for a frictionless
    /// contact, infinite for one that never slips.
    pub mu: f64,
    /// Coefficient along y; `None` for that along x. The bound is the ellipse
    /// (q_x/mu)^2 + (q_y/mu_y)^2 <= p^2, and slip is normal to it.
    pub mu_y: Option<f64>,
    /// Coefficient, along x, of cells that slipped in the increment before; `None` for mu.
    pub kinetic: Option<f64>,
    /// Factor of the coefficient over the surface.
    pub map: Option<SurfaceMap>,
    /// Factor of the coefficient as a function of the history of a cell.
    pub history: Option<FrictionHistory>,
    /// A law of the user's own, which gives the coefficient, along x, in place of `mu`: that is
    /// about what it gives, the measure of tolerances and of what is dimensionless. No map, history
    /// or kinetic coefficient beside it.
    pub law: Option<OwnFriction>,
}

/// A piecewise linear function of the history of a cell, level beyond its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct FrictionHistory {
    /// The variable.
    pub of: History,
    /// Pairs of history and factor, the history growing.
    pub table: Vec<(f64, f64)>,
}

/// A history of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum History {
    /// Increments done, the same for all cells.
    Increment,
    /// Cycles of wear done, the same for all cells; a path that is run through once has done none.
    Cycles,
    /// Length of the way that the cell has slipped \[m\].
    Slip,
    /// Energy dissipated per area \[J/m^2\].
    Dissipated,
}

impl Friction {
    /// Coulomb's law with one coefficient.
    pub fn coulomb(mu: f64) -> Self {
        Self {
            mu,
            mu_y: None,
            kinetic: None,
            map: None,
            history: None,
            law: None,
        }
    }

    /// A law of the user's own; `mu` is about what it gives.
    pub fn own(mu: f64, law: impl FrictionLaw + 'static) -> Self {
        Self {
            law: Some(OwnFriction::new(law)),
            ..Self::coulomb(mu)
        }
    }

    /// The size of mu that displacements are compared with; 1 for a contact that never slips.
    pub fn scale(&self) -> f64 {
        if self.mu.is_finite() { self.mu } else { 1.0 }
    }

    /// The coefficient along y over that along x.
    pub fn stretch(&self) -> f64 {
        self.mu_y.map_or(1.0, |mu_y| mu_y / self.mu)
    }

    /// Whether the coefficient of a cell changes along the path.
    pub(crate) fn varies(&self) -> bool {
        self.kinetic.is_some() || self.history.is_some() || self.law.is_some()
    }

    /// The tangential force that friction carries at most under `W`, if the law says so alone.
    pub(crate) fn limit(&self, W: f64) -> Option<f64> {
        let plain = self.mu_y.is_none()
            && self.map.is_none()
            && self.history.is_none()
            && self.law.is_none();
        plain.then_some(if W > 0.0 { self.mu * W } else { 0.0 })
    }

    /// Fails if a coefficient, map or history has no meaning, or, given a `grid`, does not cover
    /// it.
    pub fn check(&self, grid: Option<&Grid>) -> Result<(), Error> {
        let positive = |mu: f64| mu > 0.0 && mu.is_finite();
        if self.mu < 0.0 || self.mu.is_nan() {
            return Err(Error::invalid("friction.mu", self.mu, "a number >= 0"));
        }
        for (key, mu) in [
            ("friction.mu_y", self.mu_y),
            ("friction.kinetic", self.kinetic),
        ] {
            if let Some(mu) = mu
                && !(positive(mu) && positive(self.mu))
            {
                return Err(Error::invalid(key, mu, "a positive number, as friction.mu"));
            }
        }
        if self.law.is_some() {
            if !positive(self.mu) {
                let allowed = "a finite number > 0: about what the law gives";
                return Err(Error::invalid("friction.mu", self.mu, allowed));
            }
            if self.map.is_some() || self.history.is_some() || self.kinetic.is_some() {
                let allowed = "without map, history and kinetic: the law knows place and history";
                return Err(Error::invalid("friction.law", "a law of your own", allowed));
            }
        }
        if let Some(map) = &self.map {
            map.check("friction.map")?;
            if let Some(grid) = grid {
                map.check_on(grid, "friction.map")?;
            }
            if let Some(factor) = map.values.iter().find(|f| **f < 0.0) {
                return Err(Error::invalid("friction.map", factor, "factors >= 0"));
            }
        }
        if let Some(FrictionHistory { table, .. }) = &self.history {
            let key = "friction.history.table";
            if table.is_empty() {
                return Err(Error::invalid(key, "empty", "at least one pair"));
            }
            if let Some(pair) = table
                .windows(2)
                .find(|w| w[1].0.partial_cmp(&w[0].0) != Some(Ordering::Greater))
            {
                return Err(Error::invalid(key, pair[1].0, "a history that grows"));
            }
            if let Some((_, f)) = table.iter().find(|(_, f)| !(*f >= 0.0 && f.is_finite())) {
                return Err(Error::invalid(key, f, "finite factors >= 0"));
            }
        }
        Ok(())
    }
}

impl FrictionHistory {
    /// The factor after a history.
    pub fn factor(&self, history: f64) -> f64 {
        let table = &self.table;
        let after = table.partition_point(|(at, _)| *at <= history);
        if after == 0 {
            return table[0].1;
        }
        let (from, low) = table[after - 1];
        table.get(after).map_or(low, |&(to, high)| {
            low + (high - low) * (history - from) / (to - from)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{FrictionHistory, History};

    #[test]
    fn the_history_is_linear_between_its_pairs() {
        let history = FrictionHistory {
            of: History::Slip,
            table: vec![(1.0, 2.0), (3.0, 4.0), (4.0, 1.0)],
        };
        for (at, factor) in [(0.0, 2.0), (1.0, 2.0), (2.0, 3.0), (3.5, 2.5), (9.0, 1.0)] {
            assert!((history.factor(at) - factor).abs() < 1e-15, "{at}");
        }
    }
}
