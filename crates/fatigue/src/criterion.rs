//! A criterion with its numbers.

use std::fmt::{self, Debug, Formatter};

use crate::definition::{Acts, Definition, Numbers};
use crate::error::Error;

/// A criterion: one number for the stress history of a point, compared with a limit or a life.
#[derive(Clone, Copy)]
pub struct Criterion {
    definition: &'static Definition,
    numbers: Numbers,
}

impl Criterion {
    /// Looks up a criterion of [`crate::CRITERIA`] by its name, with its numbers by their names,
    /// each once.
    ///
    /// ```
    /// let findley = fatigue::Criterion::new("findley", &[("k", 0.3)])?;
    /// assert_eq!(findley.unit(), "Pa");
    /// # Ok::<(), fatigue::Error>(())
    /// ```
    pub fn new(name: &str, numbers: &[(&str, f64)]) -> Result<Self, Error> {
        let definition = Definition::find(name)?;
        let parameters = definition.parameters;
        let parameter_names = || {
            parameters
                .iter()
                .map(|p| p.name)
                .collect::<Vec<_>>()
                .join(", ")
        };
        if let Some((other, value)) = numbers
            .iter()
            .find(|(name, _)| !parameters.iter().any(|p| p.name == *name))
        {
            let key = format!("{name}.{other}");
            return Err(Error::argument(
                key,
                value,
                format!("one of {}", parameter_names()),
            ));
        }
        let mut ordered = [0.0; 4];
        for (n, parameter) in parameters.iter().enumerate() {
            let entry = numbers.iter().find(|(name, _)| *name == parameter.name);
            let (_, value) = entry.ok_or_else(|| {
                let key = format!("{name}.{}", parameter.name);
                Error::argument(
                    key,
                    "nothing",
                    format!("given; {name} takes {}", parameter_names()),
                )
            })?;
            ordered[n] = *value;
        }
        Self::from_ordered(definition, ordered)
    }

    /// Takes the numbers in the order of the parameters.
    pub(crate) fn from_ordered(
        definition: &'static Definition,
        numbers: Numbers,
    ) -> Result<Self, Error> {
        for (parameter, value) in definition.parameters.iter().zip(numbers) {
            if !parameter.allowed.holds(value) {
                let key = format!("{}.{}", definition.name, parameter.name);
                return Err(Error::argument(key, value, parameter.allowed.wanted()));
            }
        }
        Ok(Self {
            definition,
            numbers,
        })
    }

    /// The definition: everything except the numbers.
    pub fn definition(&self) -> &'static Definition {
        self.definition
    }

    /// Name, as in Python and on the command line.
    pub fn name(&self) -> &'static str {
        self.definition.name
    }

    /// Unit of its value: Pa, or 1 for a strain.
    pub fn unit(&self) -> &'static str {
        self.definition.unit
    }

    /// Its numbers, each with its name.
    pub fn numbers(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        let names = self.definition.parameters.iter().map(|p| p.name);
        names.zip(self.numbers)
    }

    /// The number of this name.
    pub fn number(&self, name: &str) -> Option<f64> {
        self.numbers().find(|(n, _)| *n == name).map(|(_, v)| v)
    }

    /// Returns the criterion with a number changed, or unchanged if it does not have that number.
    pub fn with_number(&self, name: &str, value: f64) -> Result<Self, Error> {
        let mut numbers = self.numbers;
        let index = self
            .definition
            .parameters
            .iter()
            .position(|p| p.name == name);
        if let Some(n) = index {
            numbers[n] = value;
        }
        Self::from_ordered(self.definition, numbers)
    }

    /// Checks that the criterion depends on a plane.
    pub fn has_plane(&self) -> bool {
        matches!(self.acts(1.0), Acts::OnPlanes(_))
    }

    /// Checks that the criterion takes strains. The others take the stress alone.
    pub fn takes_strain(&self) -> bool {
        self.twice_shear_modulus().is_some()
    }

    /// 2 G \[Pa\], for criteria of strains.
    pub(crate) fn twice_shear_modulus(&self) -> Option<f64> {
        let (E, nu) = self.number("E").zip(self.number("nu"))?;
        Some(E / (1.0 + nu))
    }

    /// How the criterion is evaluated: a combination on planes or a function of the smallest sphere. Stresses
    /// are in a `unit` \[Pa\].
    pub(crate) fn acts(&self, unit: f64) -> Acts {
        (self.definition.method)(self.numbers, unit)
    }

    /// Its numbers in the order of the parameters.
    pub(crate) fn ordered_numbers(&self) -> Numbers {
        self.numbers
    }
}

impl PartialEq for Criterion {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name() && self.numbers == other.numbers
    }
}

impl Debug for Criterion {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let numbers: Vec<_> = self.numbers().map(|(n, v)| format!("{n}={v:?}")).collect();
        write!(f, "{}({})", self.name(), numbers.join(", "))
    }
}
