//! A closed cycle of a result store.

use contact_core::Error;
use contact_subsurface::{
    CycleSource, EigenstressSolver, Moments, Side, Yielding, finished_cycles,
};

use crate::Store;

/// The kept increments of a closed cycle of a store.
pub struct StoredCycle<'a> {
    store: &'a Store,
    /// Indices among the stored increments.
    kept: Vec<usize>,
    /// Index of the increment before the cycle.
    before: Option<usize>,
    /// Bulk stress of the body at every increment \[Pa\].
    sigma_B: Vec<f64>,
    /// Increment of every index, from 1.
    increments: Vec<usize>,
    /// Solver of the residual stress, for a body that yields.
    eigenstresses: Option<EigenstressSolver>,
}

impl<'a> StoredCycle<'a> {
    /// Finds a closed cycle of the load path, from 0 or from the end if negative; without one all
    /// increments that were kept. Fails if there is no such cycle, or if fewer than two of its
    /// increments were kept.
    pub fn new(store: &'a Store, cycle: Option<i64>, side: Side) -> Result<Self, Error> {
        let whole = |name: &str| -> Result<Vec<usize>, Error> {
            let column = store.column(name)?;
            Ok(column.into_iter().map(|v| v as usize).collect())
        };
        let increments = whole("saved_increment")?;
        let branches = whole("branch_of_increment")?;
        let name = if side == Side::Body1 {
            "sigma_B1"
        } else {
            "sigma_B"
        };
        let sigma_B = store.column(name)?;
        let branch = |increment: usize| branches.get(increment.wrapping_sub(1)).copied();
        let (mut kept, mut before) = ((0..increments.len()).collect::<Vec<_>>(), None);
        if let Some(cycle) = cycle {
            let (first, last) = find_cycle(store, &branches, cycle)?;
            let inside = |k: &usize| {
                branch(increments[*k]).is_some_and(|branch| (first..=last).contains(&branch))
            };
            kept.retain(inside);
            let start = branches.iter().position(|branch| *branch == first);
            // Increments count from 1: the one before the first of the cycle.
            before = start.and_then(|start| increments.iter().position(|n| *n == start));
        }
        if kept.len() < 2 {
            let selection = if cycle.is_none() { "path" } else { "cycle" };
            return Err(Error::invalid(
                format!("kept increments of the {selection}"),
                kept.len(),
                "at least 2: solve with save = \"all\" or more of them",
            ));
        }
        let scene = store.scene();
        let yields = side.body(scene).yields();
        Ok(Self {
            eigenstresses: yields.then(|| EigenstressSolver::new(scene, side)),
            store,
            kept,
            before,
            sigma_B,
            increments,
        })
    }

    /// The increments, from 1.
    pub fn increments(&self) -> Vec<usize> {
        self.kept.iter().map(|k| self.increments[*k]).collect()
    }

    /// The moments of the increments at these places among the saved ones.
    fn moments_at(&self, places: &[usize]) -> Result<Moments, Error> {
        let mut moments = Moments::default();
        for &place in places {
            let field = |name: &str| self.store.field(name, place);
            moments
                .tractions
                .push([field("q_x")?, field("q_y")?, field("p")?]);
            moments.stick.push(field("stick")?.mapv(|v| v != 0.0));
            let row = self.increments[place].wrapping_sub(1);
            let sigma_B = self.sigma_B.get(row).copied().ok_or_else(|| {
                let allowed = "one of the increments of the store";
                Error::invalid("saved_increment", self.increments[place], allowed)
            })?;
            moments.sigma_B.push(sigma_B);
            if let Some(of) = &self.eigenstresses {
                let yielded = self.store.yielded(self.increments[place])?;
                moments.eigenstress.push(of.eigenstress(yielded.as_ref())?);
            }
        }
        Ok(moments)
    }
}

impl CycleSource for StoredCycle<'_> {
    /// Number of moments whose fields are saved.
    fn count(&self) -> usize {
        self.kept.len()
    }

    /// The moments with these numbers among the saved ones of the cycle.
    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        let places: Vec<_> = which.iter().map(|n| self.kept[*n]).collect();
        self.moments_at(&places)
    }

    /// The moment before the cycle, if its fields are saved.
    fn start(&self) -> Result<Option<Moments>, Error> {
        self.before
            .map(|place| self.moments_at(&[place]))
            .transpose()
    }

    /// Largest error of the shear at the ends of the branches by the increments; none if these were given.
    fn path_error(&self) -> Option<f64> {
        let errors = self.store.attributes().get("path_error")?.as_array()?;
        let numbers = errors.iter().filter_map(serde_json::Value::as_f64);
        numbers.reduce(f64::max)
    }

    /// The plastic work in the cycle, and the work of friction to compare it with; none if the bodies stay
    /// elastic.
    fn yielding(&self) -> Result<Option<Yielding>, Error> {
        let kept = self.increments();
        let (Some(first), Some(last), true) =
            (kept.first(), kept.last(), self.eigenstresses.is_some())
        else {
            return Ok(None);
        };
        let [plastic, rubbed] = [
            self.store.column("plastic_work")?,
            self.store.column("dissipated")?,
        ];
        // Increments count from 1: those after the first that was kept.
        let inside = |column: &[f64]| {
            column
                .get(*first..*last)
                .map_or(0.0, |part| part.iter().sum())
        };
        let friction: f64 = inside(&rubbed);
        Ok(Some(Yielding {
            plastic: inside(&plastic),
            beside: if friction > 0.0 {
                friction
            } else {
                plastic.iter().sum()
            },
        }))
    }
}

/// First and last branch of a cycle that the run has completed; `cycle` counts from 0, or from the end if
/// negative.
fn find_cycle(store: &Store, branches: &[usize], cycle: i64) -> Result<(usize, usize), Error> {
    let path = &store.scene().path;
    let finished = finished_cycles(path, branches.len());
    if finished.is_empty() {
        return Err(path.no_cycle());
    }
    let count = finished.len() as i64;
    let n = if cycle < 0 { count + cycle } else { cycle };
    let branches_of_cycle = usize::try_from(n)
        .ok()
        .and_then(|n| finished.get(n).copied());
    branches_of_cycle.ok_or_else(|| {
        let allowed = format!("{} to {}, a cycle of the path", -count, count - 1);
        Error::invalid("cycle", cycle, allowed)
    })
}
