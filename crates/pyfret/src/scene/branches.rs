//! Branches appended to a load path.

use contact_core::scene::{self as core, Prescribed, RigidMotion};

use super::branch::Spacing;
use super::increments::Values;
use crate::error::Answer;
use crate::hints::Numbers;
use crate::prelude::*;

/// Appends a branch to the loads and motions that `change` makes of the present ones; `t` is its path time
/// (default: one unit later).
pub(super) fn branch(
    path: &core::LoadPath,
    increments: Option<usize>,
    spacing: Spacing,
    t: Option<f64>,
    change: impl FnOnce(&mut core::Loads),
) -> core::LoadPath {
    let (mut to, t_before) = path.end_point();
    change(&mut to);
    path.clone().push_branch(core::Branch {
        spacing: spacing.into(),
        ..core::Branch::new(to, increments, t.unwrap_or(t_before + 1.0))
    })
}

/// A number of every increment of the path, as an array.
pub(super) fn column<'py>(
    path: &core::LoadPath,
    py: Python<'py>,
    of: impl Fn(&core::LoadPoint) -> f64,
) -> Answer<Numbers<'py>> {
    path.check_length()?;
    let column: Vec<f64> = path.points().iter().map(of).collect();
    Ok(column.to_pyarray(py).into())
}

/// Appends branches to motions of body 1 (`named`, in the order of all motions); one of them may have several
/// values, which are visited in turn.
pub(super) fn moved(
    path: &core::LoadPath,
    named: [Option<Values>; 6],
    increments: Option<usize>,
    spacing: Spacing,
    t: Option<f64>,
) -> Answer<core::LoadPath> {
    let several = |v: &Option<Values>| matches!(v, Some(Values::Several(_)));
    let first = |v: &Option<Values>| v.as_ref().and_then(|v| v.slice().first().copied());
    let motions = named.each_ref().map(|v| first(v).map(Prescribed::Motion));
    if named.iter().all(Option::is_none) {
        refuse!("displace: give a motion, such as delta_x=2e-6");
    }
    if named.iter().filter(|v| several(v)).count() > 1 {
        refuse!(
            "displace: one motion at a time may be a sequence; waypoints(delta_x=.., delta_y=..) \
             takes several"
        );
    }
    let Some(k) = named.iter().position(several) else {
        return Ok(branch(path, increments, spacing, t, |to| {
            prescribe(to, motions);
        }));
    };
    if t.is_some() {
        refuse!("displace: t goes with a single value");
    }
    let values = named[k].as_ref().map(Values::slice).unwrap_or_default();
    let others = std::array::from_fn(|n| motions[n].filter(|_| n != k));
    let (start, of) = (path.branches.len(), RigidMotion::ALL[k]);
    let mut path = path
        .clone()
        .visit_values(of, Prescribed::Motion, values, increments);
    for branch in &mut path.branches[start..] {
        branch.spacing = spacing.into();
        prescribe(&mut branch.to, others);
    }
    Ok(path)
}

/// Appends `n` cycles of the one load or motion that is `named`.
pub(super) fn cycled(
    path: &core::LoadPath,
    n: usize,
    named: [(RigidMotion, Option<Prescribed>); 6],
    increments: Option<usize>,
) -> Answer<core::LoadPath> {
    let branches: Vec<_> = named
        .into_iter()
        .filter_map(|(of, p)| Some((of, p?)))
        .collect();
    let [(of, amplitude)] = branches[..] else {
        refuse!(
            "cycles: give the amplitude of one load or motion, such as T_x=100.0 or delta_x=2e-6"
        );
    };
    let kind: fn(f64) -> Prescribed = if amplitude.is_motion() {
        Prescribed::Motion
    } else {
        Prescribed::Load
    };
    core::LoadPath::check_branches(n.saturating_mul(2))?;
    let values = core::LoadPath::cycle(amplitude.value(), n);
    Ok(path.clone().visit_values(of, kind, &values, increments))
}

/// Prescribes the given motions or loads of the six.
pub(super) fn prescribe(to: &mut core::Loads, given: [Option<Prescribed>; 6]) {
    for (of, given) in RigidMotion::ALL.into_iter().zip(given) {
        if let Some(prescribed) = given {
            to.prescribe(of, prescribed);
        }
    }
}
