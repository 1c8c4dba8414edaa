//! Friction laws.

use std::cmp::Ordering;

use super::{FrictionLaw, Grid, SurfaceMap, UserFriction};
use crate::error::Error;
use crate::magnitude::{SMALLEST, check_range};

/// Largest factor of a coefficient of friction over the surface, in the other direction, in motion
/// or over the history: six orders of magnitude are more than any surface has, and the equations of
/// cells that differ by more can't be solved to six digits together.
const FACTOR: f64 = 1e6;

/// Coulomb's law, `|q| <= mu p`, with a coefficient that may depend on the direction, the position and
/// the history of each cell.
///
/// The coefficient of an increment belongs to the history at its end, extrapolated from the last
/// the path goes on.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// Coefficient mu >= 0, along x where it depends on the direction; 0 for a frictionless
    /// contact, infinite for one that never slips.
    pub mu: f64,
    /// Coefficient along y; `None` for an isotropic law. The bound is the ellipse
    /// (q_x/mu)^2 + (q_y/mu_y)^2 <= p^2, and slip is normal to it.
    pub mu_y: Option<f64>,
    /// Coefficient, along x, of cells that slipped in the increment before; `None` for mu.
    pub kinetic: Option<f64>,
    /// Factor of the coefficient over the surface.
    pub map: Option<SurfaceMap>,
    /// Factor of the coefficient as a function of the history of a cell.
    pub history: Option<FrictionHistory>,
    /// Coefficient of each layer that wear exposes: the coatings of the coated body from the outermost
    /// on, then its substrate. The first one is `mu`. Empty for one coefficient of all layers.
    pub layers: Vec<f64>,
    /// Coefficient where no oxygen arrives; `None` for the same. The aerated share s of a cell gives
    /// `starved + (mu - starved) s`.
    pub starved: Option<f64>,
    /// Friction on a bed of debris.
    pub bed: Option<BedFriction>,
    /// A user's law of the coefficient along x, in place of `mu`. Then `mu` is a typical value of
    /// the law, which scales tolerances and dimensionless results. No map, history or kinetic
    /// coefficient beside it.
    pub law: Option<UserFriction>,
}

/// Friction on a bed of debris, of the volume h per area:
///
/// ```text
/// mu = mu_bed + (mu_0 - mu_bed) exp(-h/h_ref),
/// ```
///
/// mu_0 being the coefficient of the surface without debris.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BedFriction {
    /// Coefficient mu_bed of a thick bed.
    pub mu: f64,
    /// Thickness h_ref \[m\].
    pub thickness: f64,
}

impl BedFriction {
    /// The coefficient on the bed h \[m\], from the one of the surface without debris.
    pub fn coefficient(&self, mu_0: f64, h: f64) -> f64 {
        self.mu + (mu_0 - self.mu) * (-h / self.thickness).exp()
    }
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
    /// Distance that the cell has slipped \[m\].
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
            layers: Vec::new(),
            starved: None,
            bed: None,
            law: None,
        }
    }

    /// A user's law; `mu` is a typical value of it.
    pub fn from_law(mu: f64, law: impl FrictionLaw + 'static) -> Self {
        Self {
            law: Some(UserFriction::new(law)),
            ..Self::coulomb(mu)
        }
    }

    /// Coefficient that scales displacements: mu, or 1 for a contact that never slips.
    pub fn reference_mu(&self) -> f64 {
        if self.mu.is_finite() { self.mu } else { 1.0 }
    }

    /// The coefficient along y over that along x.
    pub fn axis_ratio(&self) -> f64 {
        self.mu_y.map_or(1.0, |mu_y| mu_y / self.mu)
    }

    /// Returns the laws beside the coefficient mu. A field that is added here needs a [`Law`], and a
    /// law must answer every question of this file.
    pub(crate) fn laws(&self) -> impl Iterator<Item = Law<'_>> {
        let Self {
            mu: _,
            mu_y,
            kinetic,
            map,
            history,
            layers,
            starved,
            bed,
            law,
        } = self;
        let layers = (!layers.is_empty()).then_some(&layers[..]);
        let laws = [
            mu_y.map(Law::Direction),
            kinetic.map(Law::Kinetic),
            map.as_ref().map(Law::Place),
            history.as_ref().map(Law::History),
            layers.map(Law::Layers),
            starved.map(Law::Starved),
            bed.as_ref().map(Law::Bed),
            law.as_ref().map(|_| Law::Own),
        ];
        laws.into_iter().flatten()
    }

    /// Returns the coefficients beside mu, by their keys in a scene file.
    pub fn coefficients(&self) -> impl Iterator<Item = (&'static str, f64)> {
        self.laws().filter_map(|law| law.coefficient())
    }

    /// Returns the coefficients beside mu by reference, by their keys in a scene file.
    pub(super) fn coefficients_mut(&mut self) -> [(&'static str, &mut Option<f64>); 3] {
        let Self {
            mu_y,
            kinetic,
            starved,
            ..
        } = self;
        [("mu_y", mu_y), ("kinetic", kinetic), ("starved", starved)]
    }

    /// Whether the coefficient depends on this.
    pub fn depends_on(&self, what: Dependence) -> bool {
        self.laws().any(|law| law.depends_on().contains(&what))
    }

    /// Whether the coefficient depends on these alone.
    pub fn depends_only_on(&self, allowed: &[Dependence]) -> bool {
        self.laws()
            .all(|law| law.depends_on().iter().all(|on| allowed.contains(on)))
    }

    /// Whether the coefficient of a cell changes along the path. What wear exposes changes between
    /// cycles only.
    pub(crate) fn varies(&self) -> bool {
        !self.depends_only_on(&[
            Dependence::Direction,
            Dependence::Place,
            Dependence::Surface,
        ])
    }

    /// The coefficient along x, before factors of place and history, of a cell that slipped in the
    /// increment before, or did not.
    pub(crate) fn mu_of_cell(&self, slipped: bool) -> f64 {
        self.kinetic.filter(|_| slipped).unwrap_or(self.mu)
    }

    /// The largest tangential force under `W`, if the law alone gives it.
    pub(crate) fn max_tangential_force(&self, W: f64) -> Option<f64> {
        self.depends_only_on(&[Dependence::LastSlip])
            .then_some(if W > 0.0 { self.mu * W } else { 0.0 })
    }

    /// Describes the law: names with their values, and facts without one.
    pub fn describe(&self) -> Vec<(&'static str, Option<f64>)> {
        let mut description = vec![("mu", Some(self.mu))];
        description.extend(self.laws().map(|law| law.describe()));
        description
    }

    /// Fails if a coefficient, map or history has no meaning, or, given a `grid`, does not cover
    /// it.
    pub fn check(&self, grid: Option<&Grid>) -> Result<(), Error> {
        if self.mu < 0.0 || self.mu.is_nan() {
            return Err(Error::invalid("friction.mu", self.mu, "a number >= 0"));
        }
        self.laws().try_for_each(|law| law.check(self.mu, grid))?;
        let compatible = [
            Dependence::Direction,
            Dependence::Place,
            Dependence::Pressure,
            Dependence::Cells,
        ];
        let without_map_and_history = self.map.is_none() && self.history.is_none();
        if let Some(first) = self.layers.first().filter(|first| **first != self.mu) {
            let allowed = format!("left out beside friction.layers, or the first of them, {first}");
            return Err(Error::invalid("friction.mu", self.mu, allowed));
        }
        if self.law.is_some() && !(without_map_and_history && self.depends_only_on(&compatible)) {
            let allowed =
                "without map, history, kinetic, layers, starved and bed: the law takes all of them";
            return Err(Error::invalid("friction.law", "a law of your own", allowed));
        }
        Ok(())
    }

    /// Fails unless the layers belong to the one coated body of `counts` layers each.
    pub(super) fn check_layers(&self, counts: [usize; 2]) -> Result<(), Error> {
        let number = self.layers.len();
        let allowed = match (number, counts) {
            (0, _) => return Ok(()),
            (_, [1, 1]) => "left out: no body has a coating".to_owned(),
            (_, [1, layers] | [layers, 1]) if number == layers => return Ok(()),
            (_, [1, layers] | [layers, 1]) => format!(
                "{layers} coefficients, one for each coating and one for the substrate of the coated body"
            ),
            _ => "left out where both bodies are coated: a law of your own takes layer1 and layer2"
                .to_owned(),
        };
        let value = format!("{number} coefficients");
        Err(Error::invalid("friction.layers", value, allowed))
    }

    /// Fails at coefficients or factors that are so small or so large that nothing could be computed
    /// from them.
    pub(super) fn check_magnitudes(&self) -> Result<(), Error> {
        check_range(SMALLEST, "friction.mu", self.mu)?;
        self.laws()
            .try_for_each(|law| law.check_magnitudes(self.mu))
    }
}

/// A law beside the coefficient mu: its dependences, its range, its description.
pub(crate) enum Law<'a> {
    /// Another coefficient along y.
    Direction(f64),
    /// Another coefficient of cells that slip.
    Kinetic(f64),
    /// A factor over the surface.
    Place(&'a SurfaceMap),
    /// A factor of the history.
    History(&'a FrictionHistory),
    /// A coefficient of each layer.
    Layers(&'a [f64]),
    /// Another coefficient without oxygen.
    Starved(f64),
    /// Another coefficient on a bed of debris.
    Bed(&'a BedFriction),
    /// A user's function.
    Own,
}

/// A variable that a coefficient of friction depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dependence {
    /// The direction of the shear.
    Direction,
    /// The position of a cell.
    Place,
    /// The pressure of a cell.
    Pressure,
    /// Whether a cell slipped in the increment before.
    LastSlip,
    /// The number of increments.
    Increments,
    /// The number of cycles.
    Cycles,
    /// Slip or energy of a cell so far.
    Cells,
    /// The surface that wear exposes: its layer, the oxygen and the debris on it.
    Surface,
}

impl Law<'_> {
    /// The variables (place, history, cycles, ...) that the coefficient of this law depends on.
    pub(crate) fn depends_on(&self) -> &'static [Dependence] {
        match self {
            Self::Direction(_) => &[Dependence::Direction],
            Self::Kinetic(_) => &[Dependence::LastSlip],
            Self::Place(_) => &[Dependence::Place],
            Self::History(history) => match history.of {
                History::Increment => &[Dependence::Increments],
                History::Cycles => &[Dependence::Cycles],
                History::Slip | History::Dissipated => &[Dependence::Cells],
            },
            Self::Layers(_) | Self::Starved(_) | Self::Bed(_) => &[Dependence::Surface],
            Self::Own => &[Dependence::Place, Dependence::Pressure, Dependence::Cells],
        }
    }

    /// The key and the value of a law that is one number in a scene file.
    fn coefficient(&self) -> Option<(&'static str, f64)> {
        match self {
            Self::Direction(mu_y) => Some(("mu_y", *mu_y)),
            Self::Kinetic(kinetic) => Some(("kinetic", *kinetic)),
            Self::Starved(starved) => Some(("starved", *starved)),
            Self::Place(_) | Self::History(_) | Self::Layers(_) | Self::Bed(_) | Self::Own => None,
        }
    }

    /// Reason why the coefficient may differ between y and -y, if it may; `is_even` checks whether a
    /// map is the same at both.
    pub(crate) fn is_uneven(&self, is_even: impl Fn(&SurfaceMap) -> bool) -> Option<&'static str> {
        match self {
            Self::Own => Some("friction is a law of the user's own"),
            Self::Place(map) if !is_even(map) => Some("the friction is not mirror-symmetric in y"),
            Self::Place(_)
            | Self::Direction(_)
            | Self::Kinetic(_)
            | Self::History(_)
            | Self::Layers(_)
            | Self::Starved(_)
            | Self::Bed(_) => None,
        }
    }

    /// A phrase that describes the law, and its value if it is one number.
    fn describe(&self) -> (&'static str, Option<f64>) {
        match self {
            Self::Direction(mu) => ("mu along y", Some(*mu)),
            Self::Kinetic(mu) => ("mu of cells that slip", Some(*mu)),
            Self::Place(_) => ("varies over the surface", None),
            Self::History(history) => match history.of {
                History::Increment => ("changes with the increments", None),
                History::Cycles => ("changes with the cycles", None),
                History::Slip => ("changes with the way slipped", None),
                History::Dissipated => ("changes with the energy dissipated", None),
            },
            Self::Layers(_) => ("follows the layer that wear exposes", None),
            Self::Starved(mu) => ("mu without oxygen", Some(*mu)),
            Self::Bed(bed) => ("mu on a thick bed of debris", Some(bed.mu)),
            Self::Own => ("a function of your own", None),
        }
    }

    /// Fails if it has no meaning beside `mu`, or, given a `grid`, does not cover it.
    fn check(&self, mu: f64, grid: Option<&Grid>) -> Result<(), Error> {
        let positive = |mu: f64| mu > 0.0 && mu.is_finite();
        if let Some((key, value)) = self.coefficient()
            && !(positive(value) && positive(mu))
        {
            let allowed = "a positive number, as friction.mu";
            return Err(Error::invalid(format!("friction.{key}"), value, allowed));
        }
        match self {
            Self::Place(map) => {
                map.check("friction.map")?;
                if let Some(grid) = grid {
                    map.check_on(grid, "friction.map")?;
                }
                match map.values.iter().find(|f| **f < 0.0) {
                    Some(factor) => Err(Error::invalid("friction.map", factor, "factors >= 0")),
                    None => Ok(()),
                }
            }
            Self::History(history) => history.check(),
            Self::Layers(layers) => match layers.iter().find(|mu| !positive(**mu)) {
                Some(bad) => {
                    let allowed = "finite coefficients above 0, one for each layer";
                    Err(Error::invalid("friction.layers", bad, allowed))
                }
                None => Ok(()),
            },
            Self::Bed(bed) => {
                let positive_number = |key: &str, value: f64, allowed: &str| {
                    if positive(value) {
                        return Ok(());
                    }
                    Err(Error::invalid(
                        format!("friction.bed.{key}"),
                        value,
                        allowed,
                    ))
                };
                positive_number("mu", bed.mu, "a finite coefficient above 0")?;
                positive_number("thickness", bed.thickness, "a finite number above 0 in m")
            }
            Self::Own if !positive(mu) => {
                let allowed = "a finite number > 0: about what the law gives";
                Err(Error::invalid("friction.mu", mu, allowed))
            }
            Self::Direction(_) | Self::Kinetic(_) | Self::Starved(_) | Self::Own => Ok(()),
        }
    }

    /// Fails at a coefficient or factor that is far from the order of one.
    fn check_magnitudes(&self, mu: f64) -> Result<(), Error> {
        let is_far = |ratio: f64| ratio.is_finite() && !(1.0 / FACTOR..=FACTOR).contains(&ratio);
        if let Some((key, value)) = self.coefficient()
            && is_far(value / mu)
        {
            let allowed = format!("between 1/{FACTOR:e} and {FACTOR:e} of friction.mu");
            return Err(Error::invalid(format!("friction.{key}"), value, allowed));
        }
        let (key, factors): (_, Vec<f64>) = match self {
            Self::Direction(_) | Self::Kinetic(_) | Self::Starved(_) | Self::Own => return Ok(()),
            Self::Layers(layers) => (
                "friction.layers",
                layers.iter().map(|of_layer| of_layer / mu).collect(),
            ),
            Self::Bed(bed) => ("friction.bed.mu", vec![bed.mu / mu]),
            Self::Place(map) => ("friction.map", map.values.iter().copied().collect()),
            Self::History(FrictionHistory { table, .. }) => {
                let factors = table.iter().map(|(_, factor)| *factor);
                ("friction.history.table", factors.collect())
            }
        };
        match factors.into_iter().find(|f| *f > 0.0 && is_far(*f)) {
            Some(factor) => {
                let allowed = format!("factors that are 0 or between 1/{FACTOR:e} and {FACTOR:e}");
                Err(Error::invalid(key, format!("{factor:e}"), allowed))
            }
            None => Ok(()),
        }
    }
}

impl FrictionHistory {
    /// Fails if the table of history and factor is empty, does not grow, or has a number without meaning.
    fn check(&self) -> Result<(), Error> {
        let (key, table) = ("friction.history.table", &self.table);
        if table.is_empty() {
            return Err(Error::invalid(key, "empty", "at least one pair"));
        }
        let does_not_grow =
            |w: &&[(f64, f64)]| w[1].0.partial_cmp(&w[0].0) != Some(Ordering::Greater);
        if let Some(pair) = table.windows(2).find(does_not_grow) {
            return Err(Error::invalid(key, pair[1].0, "a history that grows"));
        }
        match table.iter().find(|(_, f)| !(*f >= 0.0 && f.is_finite())) {
            Some((_, f)) => Err(Error::invalid(key, f, "finite factors >= 0")),
            None => Ok(()),
        }
    }

    /// The factor of the coefficient after a history: linear between the rows of the table, constant beyond
    /// them.
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
    use super::{Dependence, Friction, FrictionHistory, History};
    use crate::scene::{Grid, SurfaceMap};

    /// Returns one law of every kind.
    fn all_laws() -> Vec<Friction> {
        let plain = Friction::coulomb(0.3);
        let history = |of| FrictionHistory {
            of,
            table: vec![(0.0, 1.0), (1.0, 2.0)],
        };
        let map = Grid::centred(1e-3, 4).unwrap().map(|_, _| 1.0);
        let mut laws = vec![
            Friction {
                mu_y: Some(0.2),
                ..plain.clone()
            },
            Friction {
                kinetic: Some(0.2),
                ..plain.clone()
            },
            Friction {
                map: Some(
                    SurfaceMap::new(map, (3e-4, 3e-4), crate::scene::Missing::default()).unwrap(),
                ),
                ..plain.clone()
            },
            Friction {
                law: Some(super::UserFriction::unavailable()),
                ..plain.clone()
            },
        ];
        laws.push(Friction {
            layers: vec![0.3, 0.6],
            ..plain.clone()
        });
        laws.push(Friction {
            starved: Some(0.8),
            ..plain.clone()
        });
        laws.push(Friction {
            bed: Some(super::BedFriction {
                mu: 0.5,
                thickness: 1e-6,
            }),
            ..plain.clone()
        });
        for variable in [
            History::Increment,
            History::Cycles,
            History::Slip,
            History::Dissipated,
        ] {
            laws.push(Friction {
                history: Some(history(variable)),
                ..plain.clone()
            });
        }
        laws
    }

    #[test]
    fn every_law_has_a_description_and_dependences() {
        let plain = Friction::coulomb(0.3);
        assert!(plain.laws().next().is_none() && plain.describe().len() == 1);
        for friction in all_laws() {
            assert_eq!(friction.laws().count(), 1, "{friction:?}");
            assert_eq!(friction.describe().len(), 2);
            let mut same = friction.clone();
            let coefficients = same.coefficients_mut();
            let kept = coefficients
                .into_iter()
                .filter_map(|(key, mu)| Some((key, (*mu)?)));
            assert!(kept.eq(friction.coefficients()), "{friction:?}");
            assert!(friction.check(None).is_ok() && friction.check_magnitudes().is_ok());
            let dependences = friction.laws().flat_map(|law| law.depends_on().iter());
            let on: Vec<_> = dependences.copied().collect();
            assert!(!on.is_empty() && friction.depends_only_on(&on));
            let fixed = [
                Dependence::Direction,
                Dependence::Place,
                Dependence::Surface,
            ];
            assert_eq!(friction.varies(), on.iter().any(|d| !fixed.contains(d)));
        }
    }

    #[test]
    fn a_users_law_allows_only_another_coefficient_along_y() {
        let user = Friction {
            law: Some(super::UserFriction::unavailable()),
            ..Friction::coulomb(0.3)
        };
        for user_or_other in all_laws() {
            let with_law = Friction {
                law: user.law.clone(),
                ..user_or_other.clone()
            };
            let allowed = user_or_other.law.is_some() || user_or_other.mu_y.is_some();
            assert_eq!(with_law.check(None).is_ok(), allowed, "{user_or_other:?}");
        }
    }

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
