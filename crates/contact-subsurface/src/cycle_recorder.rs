//! A closed cycle of a march, recorded during the march.

use contact_core::Error;
use contact_core::march::{Increment, March, Observer};

use crate::moments::{CycleSource, Moments};
use crate::{EigenstressSolver, Side};

/// Records the states of a body in the increments of some branches of a march.
pub struct CycleRecorder {
    side: Side,
    branches: (usize, usize),
    moments: Moments,
    start: Option<Moments>,
    /// Set up with the first increment.
    eigenstresses: Option<EigenstressSolver>,
}

impl CycleRecorder {
    /// Recorder for the branches `first..=last`, zero-based ([`contact_core::scene::LoadPath::cycles`]).
    pub fn new(side: Side, branches: (usize, usize)) -> Self {
        Self {
            side,
            branches,
            moments: Moments::default(),
            start: None,
            eigenstresses: None,
        }
    }
}

impl Observer for CycleRecorder {
    /// Keeps tractions, stick cells, bulk stress and plastic stress of the increments in the branches, and of
    /// the last increment before them.
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        let (first, last) = self.branches;
        let branch = increment.point.branch;
        if branch > last || branch + 1 < first {
            return Ok(());
        }
        let (fields, loads) = (march.fields(), &increment.point.loads);
        let (side, scene) = (self.side, march.scene());
        let eigenstresses = self
            .eigenstresses
            .get_or_insert_with(|| EigenstressSolver::new(scene, side));
        let yields = side.body(scene).yields();
        let eigenstress = yields.then(|| eigenstresses.eigenstress(fields.yielded.as_deref()));
        let eigenstress = eigenstress.transpose()?;
        let mut before = Moments::default();
        let moments = if branch < first {
            &mut before
        } else {
            &mut self.moments
        };
        moments.tractions.push([fields.q_x, fields.q_y, fields.p]);
        moments.stick.push(fields.stick);
        moments.eigenstress.extend(eigenstress);
        moments.sigma_B.push(match self.side {
            Side::Body1 => loads.sigma_B1,
            Side::Body2 => loads.sigma_B,
        });
        if branch < first {
            self.start = Some(before);
        }
        Ok(())
    }
}

impl CycleSource for CycleRecorder {
    /// Number of recorded moments.
    fn count(&self) -> usize {
        self.moments.tractions.len()
    }

    /// The moments with these numbers.
    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        let moments = &self.moments;
        Ok(Moments {
            tractions: which
                .iter()
                .map(|n| moments.tractions[*n].clone())
                .collect(),
            stick: which.iter().map(|n| moments.stick[*n].clone()).collect(),
            sigma_B: which.iter().map(|n| moments.sigma_B[*n]).collect(),
            eigenstress: which
                .iter()
                .filter_map(|n| moments.eigenstress.get(*n).cloned())
                .collect(),
        })
    }

    /// The moment before the first branch, if there is one.
    fn start(&self) -> Result<Option<Moments>, Error> {
        Ok(self.start.clone())
    }
}
