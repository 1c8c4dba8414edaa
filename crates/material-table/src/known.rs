//! How a number of a material is known: from a source, by a rule, or from memory alone.

use crate::estimate;
use crate::material::Material;

/// Begin of the source of a number from memory.
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
    /// The way in which a number is known (from a source, estimated, from memory), by the mark at the beginning
    /// of its source.
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

    /// The worst known of some numbers, and their source, in words; `None` where each has a source.
    pub fn estimate_of(&self, names: &[&str]) -> Option<String> {
        let kind = self.known(names);
        let of = self.numbers.iter();
        let of = of.filter(|(name, of)| names.contains(name) && Known::of(&of.source) == kind);
        let which: Vec<_> = of.map(|(name, _)| *name).collect();
        let how = match (kind, which.len()) {
            (Known::Known, _) => return None,
            (Known::Estimate, 1) => "is an estimate by a rule",
            (Known::Estimate, _) => "are estimates by a rule",
            (Known::Recalled, 1) => "is from memory, without a source",
            (Known::Recalled, _) => "are from memory, without a source",
        };
        let (which, name) = (which.join(", "), &self.name);
        Some(format!("{which} of {name} {how}: take numbers of your own"))
    }
}
