//! The units in which the forces of a path were written.

use crate::error::Error;
use crate::scene::Grid;

/// A force of each dimension as it was written, `50 N` and `300 N/mm`, if any was.
///
/// A path is written before its scene is known. Numbers are in N, or in N/m where the contact is a
/// line; a text has its own dimension, which the scene compares with its own. Two paths of the same
/// numbers are equal, whatever units they were written in.
#[derive(Clone, Debug, Default)]
pub struct ForceUnits {
    /// A text with the unit of a force.
    pub force: Option<String>,
    /// A text with the unit of a force per length.
    pub per_length: Option<String>,
}

impl PartialEq for ForceUnits {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl ForceUnits {
    /// The dimension of a text that is a force or a force per length.
    pub fn from_text(text: &str) -> Self {
        let text = text.trim();
        let written = Some(text.to_owned());
        if text.contains('/') {
            Self {
                per_length: written,
                ..Self::default()
            }
        } else {
            Self {
                force: written,
                ..Self::default()
            }
        }
    }

    /// Adds the texts of other forces of the same path.
    pub fn add(&mut self, more: Self) {
        self.force = self.force.take().or(more.force);
        self.per_length = self.per_length.take().or(more.per_length);
    }

    /// Fails where a force has the dimension of another contact.
    ///
    /// In plane strain, forces are per length on a row of 1 m, the default, and forces on a row of
    /// another length.
    pub(crate) fn check(&self, grid: &Grid) -> Result<(), Error> {
        let per_metre = grid.plane_strain && grid.dy == 1.0;
        let (wrong, allowed) = if per_metre {
            let allowed = "a force per length, such as N/m or N/mm: the contact is a line";
            (&self.force, allowed.to_owned())
        } else if grid.plane_strain {
            let allowed = format!(
                "a force on the {} m of the row of cells, such as N",
                grid.dy
            );
            (&self.per_length, allowed)
        } else {
            let allowed = "a force, such as N or kN: the contact is no line";
            (&self.per_length, allowed.to_owned())
        };
        match wrong {
            Some(text) => Err(Error::invalid("path", format!("{text:?}"), allowed)),
            None => Ok(()),
        }
    }
}
