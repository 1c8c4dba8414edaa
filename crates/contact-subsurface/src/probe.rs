//! Numbers at a place below the surface by name: measures of the stress, and displacements.

use contact_core::Error;
use ndarray::{Array2, Array3, ArrayView1, Axis};

use super::{Depth, MEASURES, Measure, Slices};

/// A number at a place below the surface.
#[derive(Clone, Copy, Debug)]
pub enum Probe {
    /// A measure of the stress \[Pa\].
    Stress(Measure),
    /// A displacement relative to infinity \[m\].
    Displacement(Component),
}

/// A component of the displacement.
#[derive(Clone, Copy, Debug)]
pub struct Component {
    /// Its name.
    pub name: &'static str,
    /// Description; all are in m.
    pub long_name: &'static str,
    axis: usize,
}

/// The displacements, in the order of the axes.
pub const DISPLACEMENTS: &[Component] = &[
    displacement("u_x", "displacement along x", 0),
    displacement("u_y", "displacement along y", 1),
    displacement("u_z", "displacement along z, into body 2", 2),
];

/// A component of the displacement along an axis: 0 for x, 1 for y, 2 for z.
const fn displacement(name: &'static str, long_name: &'static str, axis: usize) -> Component {
    Component {
        name,
        long_name,
        axis,
    }
}

impl Component {
    /// The axis of the component: 0 for x, 1 for y, 2 for z.
    pub(super) fn axis(&self) -> usize {
        self.axis
    }
}

impl Probe {
    /// All probes, the stresses first.
    pub fn all() -> impl Iterator<Item = Self> {
        let stresses = MEASURES.iter().copied().map(Self::Stress);
        stresses.chain(DISPLACEMENTS.iter().copied().map(Self::Displacement))
    }

    /// Looks up a probe by its name; `key` names the argument, for the error.
    pub fn find(name: &str, key: &str) -> Result<Self, Error> {
        Self::all().find(|p| p.name() == name).ok_or_else(|| {
            let names: Vec<_> = Self::all().map(|p| p.name()).collect();
            Error::invalid(key, name, format!("one of {}", names.join(", ")))
        })
    }

    /// The name of the measure or component.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Stress(m) => m.name,
            Self::Displacement(c) => c.name,
        }
    }

    /// A description of the measure or component.
    pub fn long_name(&self) -> &'static str {
        match self {
            Self::Stress(m) => m.long_name,
            Self::Displacement(c) => c.long_name,
        }
    }

    /// The unit of its values.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Stress(_) => "Pa",
            Self::Displacement(_) => "m",
        }
    }
}

impl Measure {
    /// Its values from stresses of shape (6, depths, places) \[Pa\].
    pub fn on_lines(&self, stress: &Array3<f64>) -> Array2<f64> {
        let value = |s: ArrayView1<'_, f64>| (self.value)(&std::array::from_fn(|c| s[c]));
        stress.map_axis(Axis(0), value)
    }
}

impl Slices {
    /// Hands the probes under the first state on a plane, each of shape (nx, ny), to `f` with
    /// their index, one by one: the stresses, then the displacements.
    pub fn probe(
        &self,
        depth: Depth,
        probes: &[Probe],
        mut f: impl FnMut(usize, Array2<f64>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let stresses = || {
            let stress_probe = |(n, p): (usize, &Probe)| match p {
                Probe::Stress(m) => Some((n, *m)),
                Probe::Displacement(_) => None,
            };
            probes.iter().enumerate().filter_map(stress_probe)
        };
        if stresses().next().is_some() {
            let s = self.stress(depth)?.swap_remove(0);
            for (n, measure) in stresses() {
                self.check_stopped()?;
                let value_at = |value_at| (measure.value)(&std::array::from_fn(|c| s[c][value_at]));
                f(n, Array2::from_shape_fn(s[0].dim(), value_at))?;
            }
        }
        let displacements = || {
            let stress_probe = |(n, p): (usize, &Probe)| match p {
                Probe::Stress(_) => None,
                Probe::Displacement(c) => Some((n, c.axis)),
            };
            probes.iter().enumerate().filter_map(stress_probe)
        };
        if displacements().next().is_some() {
            let u = self.displacement(depth)?.swap_remove(0);
            for (n, axis) in displacements() {
                self.check_stopped()?;
                f(n, u[axis].clone())?;
            }
        }
        Ok(())
    }
}
