//! How a number of a material is known: from a source, by a rule, or from memory alone.

use crate::estimate;
use crate::material::Material;

/// What the source of a number from memory begins with.
pub(crate) const RECALLED: &str = "recalled: ";

/// How a number is known, from the best to the worst.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Known {
    /// From a source.
    Known,
    /// By a published rule, such as the uniform material law.
    Estimate,
    /// From memory: the source was not looked up.
    Recalled,
}

impl Known {
    /// How a number is known, by what its source begins with.
    pub fn of(source: &str) -> Self {
        let marked = |mark: &str| source.starts_with(mark.trim_end());
        if marked(RECALLED) {
            Self::Recalled
        } else if marked(estimate::MARK) {
            Self::Estimate
        } else {
            Self::Known
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Known => "known",
            Self::Estimate => "estimate",
            Self::Recalled => "recalled",
        }
    }
}

impl Material {
    /// How the worst known of some numbers is known; numbers that are missing do not count.
    pub fn known(&self, names: &[&str]) -> Known {
        let of = names.iter().filter_map(|name| self.numbers.get(name));
        let kinds = of.map(|number| Known::of(&number.source));
        kinds.max().unwrap_or(Known::Known)
    }
}
