//! Load paths that have no meaning, refused before anything is computed.

use super::LoadPath;
use super::build::CHORDS;
use crate::error::Error;
use crate::memory::fits;
use crate::scene::{Friction, Grid, Prescribed, RigidMotion};

/// Most increments of a path: the points alone take some 60 bytes each.
const MOST_INCREMENTS: usize = 100_000_000;
/// Memory of a point of the path \[bytes\].
const POINT: f64 = 256.0;
/// Memory of a branch while the path is built, its copies included \[bytes\].
const BRANCH: f64 = 1024.0;

impl LoadPath {
    /// Fails if the path has more increments than fit into memory.
    pub fn check_length(&self) -> Result<(), Error> {
        if self.increments() > MOST_INCREMENTS {
            return Err(Error::invalid(
                "path",
                "of more increments",
                format!("at most {MOST_INCREMENTS} increments in all"),
            ));
        }
        fits("the load path", POINT * self.increments() as f64)
    }

    /// Fails if [`Self::ellipse`] would make more increments than a path may have.
    pub fn check_turns(turns: usize, increments: impl Into<Option<usize>>) -> Result<(), Error> {
        Self::check_branches(turns.saturating_mul(increments.into().unwrap_or(CHORDS)))
    }

    /// Fails if that many branches are more than a path may have, or do not fit into memory.
    pub fn check_branches(branches: usize) -> Result<(), Error> {
        Self::start().normal(0.0, branches).check_length()?;
        fits("the load path", BRANCH * branches as f64)
    }

    /// Fails at a load, motion or time that no scene can have: one that is not finite, bodies
    /// pulled apart by W, or a time that does not grow.
    pub fn check_values(&self) -> Result<(), Error> {
        let mut t = 0.0;
        for (i, b) in self.branches.iter().enumerate() {
            let key = |name: &str| format!("path[{i}].{name}");
            b.to.check_values(&key)?;
            if !(b.t_end > t && b.t_end.is_finite()) {
                return Err(Error::invalid(
                    key("t"),
                    b.t_end,
                    format!("a time after {t}, the end of the branch before"),
                ));
            }
            t = b.t_end;
        }
        Ok(())
    }

    /// Fails at a period that is no time.
    pub fn check_period(&self) -> Result<(), Error> {
        match self.period.filter(|t| !(*t > 0.0 && t.is_finite())) {
            Some(period) => Err(Error::invalid(
                "cycle.period",
                period,
                "a positive path time",
            )),
            None => Ok(()),
        }
    }

    /// Fails where the increments of a branch are yet to be chosen.
    pub(crate) fn check_increments_chosen(&self) -> Result<(), Error> {
        match self.branches.iter().position(|b| b.increments.is_none()) {
            None => Ok(()),
            Some(branch) => Err(Error::invalid(
                format!("path.{branch}.increments"),
                "auto",
                "a number: estimate::choose_increments gives one to each branch",
            )),
        }
    }

    /// Fails at a path without meaning: no branch, bad increments, or loads beyond the limit of `friction`.
    pub(crate) fn check_for_friction(&self, friction: &Friction) -> Result<(), Error> {
        if self.branches.is_empty() {
            return Err(Error::invalid("path", "empty", "at least one branch"));
        }
        if let Some(K) = self.rig_stiffness.filter(|K| !(*K > 0.0 && K.is_finite())) {
            return Err(Error::invalid(
                "rig.stiffness",
                K,
                "a positive stiffness in N/m",
            ));
        }
        self.check_period()?;
        self.check_length()?;
        self.check_values()?;
        for (i, b) in self.branches.iter().enumerate() {
            let key = |name: &str| format!("path[{i}].{name}");
            if b.increments == Some(0) {
                return Err(Error::invalid(
                    key("increments"),
                    0,
                    "at least one increment",
                ));
            }
            b.to.check(&key, friction)?;
        }
        Ok(())
    }

    /// Fails where the grid cannot represent the path: the contact rolls whole cells in an increment, along x and
    /// so about y, and a strip neither twists nor tilts about its length.
    pub(crate) fn check_on(&self, grid: &Grid) -> Result<(), Error> {
        let mut rolled = 0.0;
        for (i, b) in self.branches.iter().enumerate() {
            let key = |name: &str| format!("path[{i}].{name}");
            let cells = (b.to.rolled - rolled) / grid.dx / b.count() as f64;
            if (cells - cells.round()).abs() > 1e-6 * cells.abs().max(1.0) {
                return Err(Error::invalid(
                    key("rolled"),
                    b.to.rolled,
                    format!(
                        "whole cells of {} m per increment further than before",
                        grid.dx
                    ),
                ));
            }
            let rolls = cells.round() != 0.0;
            for motion in RigidMotion::ALL {
                let allowed = match motion {
                    RigidMotion::PhiY if rolls => {
                        "left out while the contact rolls, which is a turn about y itself"
                    }
                    RigidMotion::PhiX | RigidMotion::PhiZ if grid.plane_strain => {
                        "left out in plane strain: nothing turns about x or z"
                    }
                    _ => continue,
                };
                let prescribed = b.to.prescribed(motion);
                if prescribed != Prescribed::Motion(0.0) {
                    let name = prescribed.name(motion);
                    return Err(Error::invalid(key(name), prescribed.value(), allowed));
                }
            }
            if rolls && b.increments.is_none() {
                return Err(Error::invalid(
                    key("increments"),
                    "auto",
                    "a number where the contact rolls: whole cells in each",
                ));
            }
            rolled = b.to.rolled;
        }
        Ok(())
    }
}
