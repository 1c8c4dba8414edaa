//! The load history.

use contact_core::scene::{self as core, Prescribed, RigidMotion};
use contact_subsurface::finished_cycles;

use super::branch::{Branch, Spacing};
use super::branches::{branch, column, cycled, moved, prescribe};
use super::forces::{Force, Forces, values_and_units};
use super::increments::{Count, Values, Visited};
use crate::error::Answer;
use crate::hints::Numbers;
use crate::prelude::*;
use crate::python::from_python;

/// The load history, from two bodies just touching.
///
/// Built by chaining; every call gives a new path with more branches.
///
/// Parameters
/// ----------
/// branches : list of Branch
///     Its branches, where they are at hand.
///
/// Examples
/// --------
/// >>> path = LoadPath.start().normal(1e3, increments=100)
/// >>> path.tangential([270.0, -270.0, 270.0], increments=500)
/// LoadPath(4 branches, 600 increments)
#[pyclass(frozen, eq, module = "pyfret")]
#[derive(Clone, PartialEq)]
pub(crate) struct LoadPath(pub(crate) core::LoadPath);

parts!(LoadPath: branches, rig_stiffness, period);
takes!(
    LoadPath,
    "a load path, such as LoadPath.start().normal(100.0).tangential([20.0, -20.0])"
);

/// The path, if all its loads and motions have values that a scene can have.
pub(super) fn checked(path: core::LoadPath) -> Answer<LoadPath> {
    path.check_values()?;
    Ok(LoadPath(path))
}

/// Adds the dimensions in which the new forces of a path were written.
pub(super) fn written(mut path: core::LoadPath, units: core::ForceUnits) -> core::LoadPath {
    path.units.add(units);
    path
}

#[pymethods]
impl LoadPath {
    #[new]
    #[pyo3(signature = (branches = List(Vec::new()), *, rig_stiffness: "Stiffness | None" = None, period: "float | None" = None))]
    fn new(
        branches: List<Branch>,
        #[pyo3(from_py_with = Optional::rig_stiffness)] rig_stiffness: Option<f64>,
        #[pyo3(from_py_with = number)] period: Option<f64>,
    ) -> Self {
        let mut path = core::LoadPath {
            rig_stiffness,
            period,
            ..core::LoadPath::default()
        };
        for Branch(branch, units) in branches.0 {
            path.branches.push(branch);
            path.units.add(units);
        }
        Self(path)
    }

    /// Return the path through a rig of a stiffness K [N/m], a spring along x.
    ///
    /// The spring is in series with the contact. ``delta_x`` is the shift of its far end, given or
    /// read. The contact's own shift is ``delta_x - T_x/K``. None takes the spring out. A text may
    /// have its unit, ``"20 N/um"``.
    #[pyo3(signature = (stiffness: "Stiffness | None"))]
    fn rig(&self, #[pyo3(from_py_with = Optional::stiffness)] stiffness: Option<f64>) -> Self {
        Self(core::LoadPath {
            rig_stiffness: stiffness,
            ..self.0.clone()
        })
    }

    /// Return the path with a given period of its cycles, in path time.
    ///
    /// Without it cycles are found where the loads return exactly. With it they are counted back
    /// from the end of the path. Their ends may differ by 2 % of the largest load, the noise of a
    /// measured history. None takes the period out.
    #[pyo3(signature = (*, period: "float | None"))]
    fn repeats(&self, #[pyo3(from_py_with = number)] period: Option<f64>) -> Answer<Self> {
        let path = core::LoadPath {
            period,
            ..self.0.clone()
        };
        path.check_period()?;
        Ok(Self(path))
    }

    /// First and last branch of every whole cycle, from 0.
    ///
    /// A cycle ends where the loads return and the path goes on in the same direction, or where it
    /// turns. A sine may begin anywhere in its period. With `increments` only cycles that end
    /// within so many increments, as of a run that ended early.
    #[pyo3(signature = (*, increments: "int | None" = None))]
    fn whole_cycles(
        &self,
        #[pyo3(from_py_with = number)] increments: Option<usize>,
    ) -> Vec<(usize, usize)> {
        finished_cycles(&self.0, increments.unwrap_or(usize::MAX))
    }

    /// Why the path has no closed cycle, in words.
    fn no_cycle(&self) -> String {
        match self.0.no_cycle() {
            contact_core::Error::InvalidScene { value, .. } => format!("the load path has {value}"),
            error => error.to_string(),
        }
    }

    /// The path before its first branch.
    #[staticmethod]
    fn start() -> Self {
        Self(core::LoadPath::start())
    }

    /// Go to the normal force `W` [N], the tangential forces kept, in one unit of path time.
    ///
    /// Of several forces each is a branch of its own, with as many increments.
    #[pyo3(signature = (W: "Quantities", *, increments = Count(None)))]
    fn normal(
        &self,
        #[pyo3(from_py_with = Forces::W)] W: Forces,
        increments: Count,
    ) -> Answer<Self> {
        let several = W.values.slice().iter();
        let path = several.fold(self.0.clone(), |path, W| path.normal(*W, increments.0));
        checked(written(path, W.units))
    }

    /// Visit the tangential forces `T_x` [N] in turn.
    ///
    /// The increments are shared out in proportion to the change of force. Path time runs as in
    /// the first branch: one unit for as many increments as that one has.
    #[pyo3(signature = (T_x: "Quantities", *, increments = Count(None)))]
    fn tangential(
        &self,
        #[pyo3(from_py_with = Forces::T_x)] T_x: Forces,
        increments: Count,
    ) -> Answer<Self> {
        let path = self.0.clone().tangential(T_x.values.slice(), increments.0);
        checked(written(path, T_x.units))
    }

    /// Visit the torsional moments `M_z` [N m] in turn, as `tangential` does the forces.
    #[pyo3(signature = (M_z: "Quantities", *, increments = Count(None)))]
    fn torsion(
        &self,
        #[pyo3(from_py_with = Visited::M_z)] M_z: Values,
        increments: Count,
    ) -> Answer<Self> {
        checked(self.0.clone().torsion(M_z.slice(), increments.0))
    }

    /// Visit the normal forces `W` [N] in turn, as `tangential` does: fretting mode II.
    #[pyo3(signature = (W: "Quantities", *, increments = Count(None)))]
    fn radial(
        &self,
        #[pyo3(from_py_with = Forces::W)] W: Forces,
        increments: Count,
    ) -> Answer<Self> {
        let path = self.0.clone().radial(W.values.slice(), increments.0);
        checked(written(path, W.units))
    }

    /// Turn the tangential force around an ellipse of semi-axes `T_x`, `T_y` [N].
    ///
    /// Its middle is where the path stands. It goes to (T_x, 0) in `increments` and takes as many
    /// for each turn towards (0, T_y), each a branch by itself. With "auto" a turn has 64 branches,
    /// and as many increments as the path tolerance of the settings asks for.
    #[pyo3(signature = (*, T_x: "Force", T_y: "Force", turns: "int" = 1, increments = Count(None)))]
    fn ellipse(
        &self,
        #[pyo3(from_py_with = Force::T_x)] T_x: Option<Force>,
        #[pyo3(from_py_with = Force::T_y)] T_y: Option<Force>,
        #[pyo3(from_py_with = number)] turns: usize,
        increments: Count,
    ) -> Answer<Self> {
        let ([Some(T_x), Some(T_y)], units) = values_and_units([T_x, T_y]) else {
            refuse!("ellipse: give both semi-axes, such as T_x=20.0, T_y=10.0");
        };
        core::LoadPath::check_turns(turns, increments.0)?;
        let path = self.0.clone().ellipse((T_x, T_y), turns, increments.0);
        Ok(Self(written(path, units)))
    }

    /// Go to the given loads on a straight line; what is not named stays as it was.
    ///
    /// A load that is named is given from here on, and the motion that goes with it is free.
    ///
    /// Parameters
    /// ----------
    /// W, T_x, T_y : float, optional
    ///     Normal force and tangential forces on body 2 [N].
    /// M_x, M_y, M_z : float, optional
    ///     Tilting moments and torsional moment on body 2 [N m].
    /// sigma_B : float, optional
    ///     Bulk stress along x in body 2, tension positive: a fatigue load [Pa].
    /// sigma_B1 : float, optional
    ///     The same in body 1.
    /// rolled : float, optional
    ///     Way that the contact has rolled along x over both bodies [m], whole cells per increment.
    /// increments : int or "auto"
    ///     Number of increments (default: as many as the path tolerance of the settings asks for).
    /// spacing : Spacing
    ///     How they are spaced (default: equal increments of force).
    /// t : float, optional
    ///     Path time at the end (default: one unit later).
    #[pyo3(signature = (*, W: "Force | None" = None, T_x: "Force | None" = None, T_y: "Force | None" = None, M_x: "Moment | None" = None, M_y: "Moment | None" = None, M_z: "Moment | None" = None, sigma_B: "BulkStress | None" = None, sigma_B1: "BulkStress | None" = None, rolled: "Length | None" = None, increments = Count(None), spacing = Spacing::Uniform, t: "Time | None" = None))]
    fn force(
        &self,
        #[pyo3(from_py_with = Force::W)] W: Option<Force>,
        #[pyo3(from_py_with = Force::T_x)] T_x: Option<Force>,
        #[pyo3(from_py_with = Force::T_y)] T_y: Option<Force>,
        #[pyo3(from_py_with = Optional::M_x)] M_x: Option<f64>,
        #[pyo3(from_py_with = Optional::M_y)] M_y: Option<f64>,
        #[pyo3(from_py_with = Optional::M_z)] M_z: Option<f64>,
        #[pyo3(from_py_with = Optional::sigma_B)] sigma_B: Option<f64>,
        #[pyo3(from_py_with = Optional::sigma_B1)] sigma_B1: Option<f64>,
        #[pyo3(from_py_with = Optional::rolled)] rolled: Option<f64>,
        increments: Count,
        spacing: Spacing,
        #[pyo3(from_py_with = Optional::t)] t: Option<f64>,
    ) -> Answer<Self> {
        let ([W, T_x, T_y], units) = values_and_units([W, T_x, T_y]);
        let loads = [W, M_x, M_y, T_x, T_y, M_z].map(|load| load.map(Prescribed::Load));
        let change = |to: &mut core::Loads| {
            prescribe(to, loads);
            to.sigma_B = sigma_B.unwrap_or(to.sigma_B);
            to.sigma_B1 = sigma_B1.unwrap_or(to.sigma_B1);
            to.rolled = rolled.unwrap_or(to.rolled);
        };
        let path = branch(&self.0, increments.0, spacing, t, change);
        checked(written(path, units))
    }

    /// Go to the given rigid motions of body 1 on a straight line, or visit several in turn.
    ///
    /// A motion that is named is given from here on, and its load follows from the solution. What
    /// is not named stays as it was; without a word, rotations are given as zero.
    ///
    /// Parameters
    /// ----------
    /// delta_z, delta_x, delta_y : float or sequence of float, optional
    ///     Approach and shifts [m]. One of all the motions may be a sequence: its values are
    ///     visited in turn. The increments are then shared out in proportion to the change, as in
    ///     `tangential`.
    /// phi_x, phi_y, phi_z : float or sequence of float, optional
    ///     Tilts and rotation about z [rad].
    /// increments : int or "auto"
    ///     Number of increments (default: as many as the path tolerance of the settings asks for).
    /// spacing : Spacing
    ///     How they are spaced (default: equal increments).
    /// t : float, optional
    ///     Path time at the end (default: one unit later); not with a sequence.
    ///
    /// Examples
    /// --------
    /// >>> pressed = LoadPath.start().normal(10.0)
    /// >>> pressed.displace(delta_x=[2e-6, -2e-6, 2e-6])
    /// LoadPath(4 branches, increments to be chosen)
    #[pyo3(signature = (*, delta_z: "Quantities | None" = None, delta_x: "Quantities | None" = None, delta_y: "Quantities | None" = None, phi_x: "Quantities | None" = None, phi_y: "Quantities | None" = None, phi_z: "Quantities | None" = None, increments = Count(None), spacing = Spacing::Uniform, t: "Time | None" = None))]
    fn displace(
        &self,
        #[pyo3(from_py_with = Visited::delta_z)] delta_z: Option<Values>,
        #[pyo3(from_py_with = Visited::delta_x)] delta_x: Option<Values>,
        #[pyo3(from_py_with = Visited::delta_y)] delta_y: Option<Values>,
        #[pyo3(from_py_with = Visited::phi_x)] phi_x: Option<Values>,
        #[pyo3(from_py_with = Visited::phi_y)] phi_y: Option<Values>,
        #[pyo3(from_py_with = Visited::phi_z)] phi_z: Option<Values>,
        increments: Count,
        spacing: Spacing,
        #[pyo3(from_py_with = Optional::t)] t: Option<f64>,
    ) -> Answer<Self> {
        let motions = [delta_z, phi_x, phi_y, delta_x, delta_y, phi_z];
        moved(&self.0, motions, increments.0, spacing, t).and_then(checked)
    }

    /// Go through `n` cycles of one load or motion about zero.
    ///
    /// The path goes to the amplitude, then `n` times to its opposite and back; what is not named
    /// stays as it was.
    ///
    /// Parameters
    /// ----------
    /// n : int
    ///     Number of cycles.
    /// T_x, T_y : float, optional
    ///     Amplitude of a tangential force [N].
    /// M_z : float, optional
    ///     Amplitude of the torsional moment [N m].
    /// delta_x, delta_y : float, optional
    ///     Amplitude of a shift [m].
    /// phi_z : float, optional
    ///     Amplitude of the rotation [rad].
    /// increments : int or "auto"
    ///     Number of increments of all branches together, shared out in proportion to the change
    ///     (default: as many as the path tolerance of the settings asks for).
    ///
    /// Examples
    /// --------
    /// >>> LoadPath.start().normal(10.0).cycles(2, delta_x=2e-6)
    /// LoadPath(6 branches, increments to be chosen)
    #[pyo3(signature = (n: "int", *, T_x: "Force | None" = None, T_y: "Force | None" = None, M_z: "Moment | None" = None, delta_x: "Length | None" = None, delta_y: "Length | None" = None, phi_z: "Angle | None" = None, increments = Count(None)))]
    fn cycles(
        &self,
        #[pyo3(from_py_with = number)] n: usize,
        #[pyo3(from_py_with = Force::T_x)] T_x: Option<Force>,
        #[pyo3(from_py_with = Force::T_y)] T_y: Option<Force>,
        #[pyo3(from_py_with = Optional::M_z)] M_z: Option<f64>,
        #[pyo3(from_py_with = Optional::delta_x)] delta_x: Option<f64>,
        #[pyo3(from_py_with = Optional::delta_y)] delta_y: Option<f64>,
        #[pyo3(from_py_with = Optional::phi_z)] phi_z: Option<f64>,
        increments: Count,
    ) -> Answer<Self> {
        let ([T_x, T_y], units) = values_and_units([T_x, T_y]);
        let motions = [
            (RigidMotion::DeltaX, T_x.map(Prescribed::Load)),
            (RigidMotion::DeltaY, T_y.map(Prescribed::Load)),
            (RigidMotion::PhiZ, M_z.map(Prescribed::Load)),
            (RigidMotion::DeltaX, delta_x.map(Prescribed::Motion)),
            (RigidMotion::DeltaY, delta_y.map(Prescribed::Motion)),
            (RigidMotion::PhiZ, phi_z.map(Prescribed::Motion)),
        ];
        let path = cycled(&self.0, n, motions, increments.0)?;
        checked(written(path, units))
    }

    /// Stay at the loads and motions reached for some increments, one unit of path time.
    ///
    /// What friction makes of the history of a cell goes on meanwhile.
    #[pyo3(signature = (*, increments: "int" = 1))]
    fn hold(&self, #[pyo3(from_py_with = number)] increments: usize) -> Self {
        Self(self.0.clone().hold(increments))
    }

    fn __len__(&self) -> Answer<usize> {
        self.0.check_length()?;
        let branches = &self.0.branches;
        match branches.iter().filter(|b| b.increments.is_none()).count() {
            0 => Ok(self.0.increments()),
            open => refuse!(
                "the increments of {open} of {} branches are chosen when the path is solved; \
                 len(path.branches) is the number of branches",
                branches.len()
            ),
        }
    }

    #[expect(clippy::unused_self, reason = "Python passes it")]
    fn __bool__(&self) -> bool {
        true
    }

    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        from_python(slf.py(), "path_html")?.call1((slf,))
    }

    pub(crate) fn __repr__(&self) -> String {
        let branches = &self.0.branches;
        let total: usize = branches.iter().filter_map(|b| b.increments).sum();
        let open = branches.iter().filter(|b| b.increments.is_none()).count();
        let increments = match (total, open) {
            (total, 0) => format!("{total} increments"),
            (0, _) => "increments to be chosen".to_owned(),
            (total, open) => format!("{total} increments, more to be chosen in {open} branches"),
        };
        let rig = self.0.rig_stiffness.map_or("", |_| ", through a rig");
        format!("LoadPath({} branches, {increments}{rig})", branches.len())
    }
}

attributes!(LoadPath, self, py:
    /// Path time at the end of every increment.
    t: Answer<Numbers<'py>> = column(&self.0, py, |point| point.t);
    /// Normal force at the end of every increment [N]; NaN where the solution gives it.
    W: Answer<Numbers<'py>> = column(&self.0, py, |point| point.loads.W);
    /// Tangential force along x at the end of every increment [N].
    T_x: Answer<Numbers<'py>> = column(&self.0, py, |point| point.loads.T_x);
    /// Tangential force along y at the end of every increment [N].
    T_y: Answer<Numbers<'py>> = column(&self.0, py, |point| point.loads.T_y);
    /// Bulk stress of body 2 at the end of every increment [Pa].
    sigma_B: Answer<Numbers<'py>> = column(&self.0, py, |point| point.loads.sigma_B);
    /// Bulk stress of body 1 at the end of every increment [Pa].
    sigma_B1: Answer<Numbers<'py>> = column(&self.0, py, |point| point.loads.sigma_B1);
    /// Way rolled at the end of every increment [m].
    rolled: Answer<Numbers<'py>> = column(&self.0, py, |point| point.loads.rolled);
    /// Torsional moment at the end of every increment [N m].
    M_z: Answer<Numbers<'py>> = column(&self.0, py, |point| point.loads.M_z);
);

attributes!(LoadPath, self:
    /// Path time of a cycle; None: cycles are found where the loads return.
    period: Option<f64> = self.0.period;
    /// Stiffness of the rig along x [N/m]; None: the bodies themselves are moved.
    rig_stiffness: Option<f64> = self.0.rig_stiffness;
    /// The branches in their order.
    branches: Vec<Branch> = self.0.branches.iter().copied().map(Branch::from).collect();
);
