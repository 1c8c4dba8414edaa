//! Whole cycles of a load path.
//!
//! The path is a polygon whose nodes are the ends of its branches. A cycle goes from a node to a later
//! node with the same loads. A path also passes the same loads twice in one period: a sine passes half
//! of its amplitude on its way up and on its way down. So a node at which no load turns closes a cycle
//! only if the path passes it in the same direction at both ends. A load turns where the sign of its
//! change changes.

use super::LoadPath;
use crate::error::Error;
use crate::scene::{Loads, RigidMotion};

/// Loads that agree to this part of the largest are the same.
const SAME: f64 = 1e-9;
/// Difference of the loads at the two ends of a given period, over the largest, up to which it is a cycle.
const OF_PERIOD: f64 = 0.02;
/// Difference of a time and the nearest end of a branch, over the period, up to which they are the same.
const ON_TIME: f64 = 1e-6;
/// Channels of a path: six motions or their loads, two bulk stresses, the way rolled.
const CHANNELS: usize = 9;
/// Channels that are compared at the ends of a cycle: all but the way rolled.
const COMPARED: usize = 8;

/// Names of the channels after the six motions.
const BULK: [&str; 3] = ["sigma_B", "sigma_B1", "rolled"];

/// The nodes of a path.
struct Nodes {
    /// Loads at each, from the unloaded state on.
    ends: Vec<Loads>,
    /// Values of the channels, over the largest of its kind.
    values: Vec<[f64; CHANNELS]>,
    /// Sign of the last change before each node, and of the next change after it.
    arrives: Vec<[i8; CHANNELS]>,
    leaves: Vec<[i8; CHANNELS]>,
    /// Node at which the loads of each began to be what they are.
    since: Vec<usize>,
}

/// The loads, motions and bulk stresses that cycles are compared by, in the order of the channels.
fn channels(loads: &Loads) -> [f64; CHANNELS] {
    let mut values = [0.0; CHANNELS];
    for (value, motion) in values.iter_mut().zip(RigidMotion::ALL) {
        *value = loads.prescribed(motion).value();
    }
    values[6..].copy_from_slice(&[loads.sigma_B, loads.sigma_B1, loads.rolled]);
    values
}

/// Number of the kind of a channel; channels of one kind (forces, shifts, moments, rotations, bulk stresses,
/// distances rolled) have a common scale.
fn kind(channel: usize, loads: &Loads) -> usize {
    match RigidMotion::ALL.get(channel) {
        Some(motion) => {
            2 * usize::from(motion.is_rotation())
                + usize::from(loads.prescribed(*motion).is_motion())
        }
        None if channel < COMPARED => 4,
        None => 5,
    }
}

impl Nodes {
    /// Reads the nodes of a path, which are its start and the ends of its branches, with the directions in
    /// which each channel arrives and leaves.
    fn new(path: &LoadPath) -> Self {
        let ends: Vec<Loads> = std::iter::once(Loads::default())
            .chain(path.branches.iter().map(|b| b.to))
            .collect();
        let mut largest = [0.0_f64; 6];
        for end in &ends {
            for (channel, value) in channels(end).into_iter().enumerate() {
                let largest = &mut largest[kind(channel, end)];
                *largest = largest.max(value.abs());
            }
        }
        let values: Vec<[f64; CHANNELS]> = (ends.iter())
            .map(|end| {
                let mut values = channels(end);
                for (channel, value) in values.iter_mut().enumerate() {
                    let scale = largest[kind(channel, end)];
                    *value = if scale > 0.0 { *value / scale } else { 0.0 };
                }
                values
            })
            .collect();
        let signs = |from: usize, to: usize| -> [i8; CHANNELS] {
            std::array::from_fn(|channel| {
                let kinds = [from, to].map(|node| kind(channel, &ends[node]));
                // A motion that was free counts from 0.
                let before = if kinds[0] == kinds[1] {
                    values[from][channel]
                } else {
                    0.0
                };
                let change = values[to][channel] - before;
                if change.abs() <= SAME {
                    0
                } else {
                    change.signum() as i8
                }
            })
        };
        let count = ends.len();
        let none = [0; CHANNELS];
        let (mut arrives, mut leaves) = (vec![none; count], vec![none; count]);
        let mut since = vec![0; count];
        for node in 1..count {
            arrives[node] = signs(node - 1, node);
            since[node] = node;
            if arrives[node] == none {
                (arrives[node], since[node]) = (arrives[node - 1], since[node - 1]);
            }
        }
        for node in (0..count - 1).rev() {
            leaves[node] = signs(node, node + 1);
            if leaves[node] == none {
                leaves[node] = leaves[node + 1];
            }
        }
        Self {
            ends,
            values,
            arrives,
            leaves,
            since,
        }
    }

    /// Largest difference of the loads of two nodes, over the largest of their kind, and its channel;
    /// infinite where a load is given at one node and its motion at the other.
    fn difference(&self, a: usize, b: usize) -> (f64, usize) {
        let channel_difference = |channel: usize| {
            if kind(channel, &self.ends[a]) == kind(channel, &self.ends[b]) {
                (self.values[a][channel] - self.values[b][channel]).abs()
            } else {
                f64::INFINITY
            }
        };
        let differences = (0..COMPARED).map(|channel| (channel_difference(channel), channel));
        differences.fold(
            (0.0, 0),
            |worst, now| if now.0 > worst.0 { now } else { worst },
        )
    }

    /// Whether a load changes its direction at a node. The start and the end of the path count as turns.
    fn turns(&self, node: usize) -> bool {
        let last = self.since[self.ends.len() - 1];
        node == 0 || node >= last || self.arrives[node] != self.leaves[node]
    }

    /// Whether the path from one node to a later one is a whole cycle: the same loads at both, passed in the
    /// same direction or turned at.
    fn is_whole(&self, from: usize, to: usize) -> bool {
        let changes = self.since[to] > from;
        if !changes || to < from + 2 || self.difference(from, to).0 > SAME {
            return false;
        }
        let arrive_alike = self.arrives[from] == self.arrives[to];
        if self.since[self.ends.len() - 1] <= to {
            // The path ends: where it would go on is not given.
            return arrive_alike || self.turns(from);
        }
        let leave_alike = self.leaves[from] == self.leaves[to];
        match (self.turns(from), self.turns(to)) {
            (true, true) => true,
            (false, false) => arrive_alike && leave_alike,
            _ => arrive_alike || leave_alike,
        }
    }

    /// Sorts nodes into classes that may have the same loads. Returns the class of each node, and the nodes of
    /// each class in order.
    fn classes(&self) -> (Vec<usize>, Vec<Vec<usize>>) {
        // A sum with weights that no loads share by chance.
        let key = |node: usize| -> f64 {
            let weights = (0..COMPARED).map(|channel| 1.0 + 0.618_033_988_75 * channel as f64);
            weights.zip(self.values[node]).map(|(w, v)| w * v).sum()
        };
        let mut order: Vec<(f64, usize)> = (0..self.ends.len()).map(|n| (key(n), n)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut class = vec![0; order.len()];
        let mut classes: Vec<Vec<usize>> = Vec::new();
        let mut before = f64::NEG_INFINITY;
        for (key, node) in order {
            if key - before > 64.0 * SAME || classes.is_empty() {
                classes.push(Vec::new());
            }
            before = key;
            class[node] = classes.len() - 1;
            classes[class[node]].push(node);
        }
        for nodes in &mut classes {
            nodes.sort_unstable();
        }
        (class, classes)
    }

    /// First and last branch (from 0) of the cycles that follow each other, each the shortest from its first
    /// node.
    fn cycles(&self) -> Vec<(usize, usize)> {
        let (class, classes) = self.classes();
        let mut cycles = Vec::new();
        let mut start = 0;
        while start < self.ends.len() {
            let alike = &classes[class[start]];
            let later = alike.partition_point(|node| *node < start + 2);
            let end = alike[later..]
                .iter()
                .find(|end| self.is_whole(start, **end));
            match end {
                // Branch n ends at node n + 1.
                Some(end) => {
                    cycles.push((start, end - 1));
                    start = *end;
                }
                None => start += 1,
            }
        }
        cycles
    }

    /// First and last branch (from 0) of the shortest whole cycle that ends with the path; none if there is
    /// none.
    fn last_whole_cycle(&self) -> Option<(usize, usize)> {
        let end = self.ends.len() - 1;
        let start = (0..end).rev().find(|start| self.is_whole(*start, end));
        start.map(|start| (start, end - 1))
    }

    /// Whether a load reverses at a node.
    fn reverses(&self, node: usize) -> bool {
        let signs = self.arrives[node].iter().zip(&self.leaves[node]);
        signs.into_iter().any(|(before, after)| before * after < 0)
    }

    /// First and last branch (from 0) of a single swing, a load that reverses once and comes back: from the
    /// node on the way there at which the loads were those at the end of the path. None if there is none.
    fn single_swing(&self) -> Option<(usize, usize)> {
        let end = self.ends.len() - 1;
        let first = (1..end).find(|node| self.reverses(*node))?;
        let start = (1..=first)
            .rev()
            .find(|start| self.difference(*start, end).0 <= SAME)?;
        (end >= start + 2 && self.since[end] > start).then_some((start, end - 1))
    }

    /// First and last branch (from 0) of a path that starts from contact without shear and ends with motions of
    /// 0 in the plane, if motions drive it: a motion that was free counts from 0. None if there is none.
    fn cycle_from_no_shear(&self) -> Option<(usize, usize)> {
        let end = self.ends.len() - 1;
        let free = |of| Loads::default().prescribed(of);
        let in_plane = || RigidMotion::ALL.into_iter().filter(|of| of.is_in_plane());
        let unloaded =
            |node: &usize| in_plane().all(|of| self.ends[*node].prescribed(of) == free(of));
        let start = (0..end).take_while(unloaded).last()?;
        let mut restored = self.ends[end];
        for of in in_plane() {
            if restored.prescribed(of).value() == 0.0 {
                restored.prescribe(of, free(of));
            }
        }
        let [begins, ends] = [&self.ends[start], &restored].map(channels);
        let same = (0..COMPARED)
            .all(|k| kind(k, &self.ends[start]) == kind(k, &restored) && begins[k] == ends[k]);
        (same && end >= start + 2).then_some((start, end - 1))
    }
}

/// A load or motion that does not return in a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Open {
    /// Its name.
    pub name: &'static str,
    /// Its values at the start and at the end of the cycle.
    pub values: [f64; 2],
}

impl LoadPath {
    /// First and last branch of every whole cycle of the path. The cycles follow each other and do not
    /// overlap. With a given [`Self::period`] they are counted back from the end of the path. Otherwise a
    /// cycle goes from a node to the first later node with the same loads, motions and bulk stresses, which
    /// the path passes in the same direction or at which it turns. A branch that changes nothing is no cycle.
    pub fn cycles(&self) -> Vec<(usize, usize)> {
        let nodes = Nodes::new(self);
        if let Some(period) = self.period {
            return self.cycles_of_period(&nodes, period).unwrap_or_default();
        }
        let cycles = nodes.cycles();
        if cycles.is_empty() {
            let only = nodes.single_swing().or_else(|| nodes.cycle_from_no_shear());
            return only.into_iter().collect();
        }
        cycles
    }

    /// The last whole cycle: the one that ends with the path, if there is one.
    pub fn last_cycle(&self) -> Option<(usize, usize)> {
        let at_end = self
            .period
            .is_none()
            .then(|| Nodes::new(self).last_whole_cycle());
        at_end.flatten().or_else(|| self.cycles().last().copied())
    }

    /// The load that differs most between the two ends of a cycle, if its ends are not the same.
    pub fn opens(&self, (first, last): (usize, usize)) -> Option<Open> {
        let nodes = Nodes::new(self);
        let (difference, channel) = nodes.difference(first, last + 1);
        let may = if self.period.is_some() {
            OF_PERIOD
        } else {
            SAME
        };
        (difference > may).then(|| Open {
            name: nodes.name(channel, last + 1),
            values: [first, last + 1].map(|node| channels(&nodes.ends[node])[channel]),
        })
    }

    /// First and last branch (from 0) of the cycles of a given period, counted back from the end of the path;
    /// the error is why the last one is none.
    fn cycles_of_period(&self, nodes: &Nodes, period: f64) -> Result<Vec<(usize, usize)>, String> {
        let times: Vec<f64> = std::iter::once(0.0)
            .chain(self.branches.iter().map(|b| b.t_end))
            .collect();
        let (mut end, mut cycles) = (times.len() - 1, Vec::new());
        loop {
            let t = times[end] - period;
            let near = times.partition_point(|time| *time < t - ON_TIME * period);
            let refused = if near >= end || (times[near] - t).abs() > ON_TIME * period {
                format!(
                    "no branch ends at the time {t:.6e}, one period before {:.6e}",
                    times[end]
                )
            } else {
                let (difference, channel) = nodes.difference(near, end);
                if difference <= OF_PERIOD && near > 0 {
                    cycles.push((near, end - 1));
                    end = near;
                    continue;
                }
                let name = nodes.name(channel, end);
                format!(
                    "{name} at the times {t:.6e} and {:.6e} differs by {difference:.1e} of its largest value",
                    times[end]
                )
            };
            cycles.reverse();
            return if cycles.is_empty() {
                Err(refused)
            } else {
                Ok(cycles)
            };
        }
    }

    /// Why the path has no whole cycle, and what to do; for errors.
    pub fn no_cycle(&self) -> Error {
        let nodes = Nodes::new(self);
        let allowed = "a load path with a whole closed cycle: its last branch ends where an earlier one ended, as in \
                       [T, -T, T] of T_x";
        let miss = match self.period {
            Some(period) => self.cycles_of_period(&nodes, period).err(),
            None => nodes.nearest(),
        };
        let miss = miss.map_or_else(String::new, |miss| format!(": {miss}"));
        Error::invalid("path", format!("no closed cycle{miss}"), allowed)
    }
}

impl Nodes {
    /// The name of the load or motion of a channel at a node.
    fn name(&self, channel: usize, node: usize) -> &'static str {
        match RigidMotion::ALL.get(channel) {
            Some(motion) => self.ends[node].prescribed(*motion).name(*motion),
            None => BULK[channel - RigidMotion::ALL.len()],
        }
    }

    /// A sentence on the node whose loads come nearest to the loads at the end of the path, for errors; none if
    /// no load comes back within half of its largest value.
    fn nearest(&self) -> Option<String> {
        let end = self.ends.len() - 1;
        let arrives = |node: &usize| self.arrives[*node] == self.arrives[end];
        let nodes = (1..end.saturating_sub(1)).filter(arrives);
        let misses = nodes.map(|node| (self.difference(node, end), node));
        let ((difference, channel), node) = misses
            .filter(|((difference, _), _)| *difference > SAME && difference.is_finite())
            .min_by(|a, b| a.0.0.total_cmp(&b.0.0))?;
        (difference < 0.5).then(|| {
            format!(
                "{} at the end of branch {} comes back within {:.1e} of its largest value at the end of the path. With \
                 noise, give the period: path.repeats(period=...)",
                self.name(channel, end),
                node - 1,
                difference
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::load_path::Increments;

    /// A path of waypoints after a pressing branch.
    fn sampled(names: &[&str], rows: impl Iterator<Item = Vec<f64>>) -> LoadPath {
        let rows: Vec<Vec<f64>> = rows.collect();
        let path = LoadPath::start().normal(10.0, 1);
        path.waypoints(names, &rows, Increments::Each(1))
            .expect("a path")
    }

    /// Way of `T_x` to and fro in a cycle \[N\].
    fn travel(path: &LoadPath, (first, last): (usize, usize)) -> f64 {
        let T_x = |n: usize| path.branches[n].to.T_x;
        (first..=last).map(|n| (T_x(n) - T_x(n - 1)).abs()).sum()
    }

    /// Random periodic functions of two channels, some periods of them.
    fn history(rng: &mut fastrand::Rng, points: usize, periods: usize, cut: usize) -> LoadPath {
        let amplitudes: Vec<[f64; 4]> = (0..3)
            .map(|_| std::array::from_fn(|_| rng.f64() - 0.5))
            .collect();
        let value = move |n: usize, channel: usize| -> f64 {
            let angle = std::f64::consts::TAU * (n % points) as f64 / points as f64;
            let waves = amplitudes.iter().enumerate().map(|(k, a)| {
                let (sin, cos) = (angle * (k + 1) as f64).sin_cos();
                a[2 * channel] * sin + a[2 * channel + 1] * cos
            });
            waves.sum()
        };
        let count = periods * points + 1 - cut;
        sampled(
            &["T_x", "delta_y"],
            (0..count).map(move |n| vec![value(n, 0), 1e-6 * value(n, 1)]),
        )
    }

    #[test]
    fn a_sine_of_any_phase_has_one_cycle_a_period() {
        for points in [8, 16, 64] {
            for shift in 0..points {
                let value = |n: usize| {
                    let angle =
                        std::f64::consts::TAU * ((n + shift) % points) as f64 / points as f64;
                    vec![2.0 * angle.sin()]
                };
                let rows = (0..points).map(|n| value(n)[0]);
                let peak = rows.fold(0.0, f64::max);
                // Way up from the lowest point to the peak, and back.
                let is_whole = |path: &LoadPath, cycle| {
                    let miss = travel(path, cycle) - 4.0 * peak;
                    assert!(miss.abs() < 1e-9, "{points} points from {shift}: {cycle:?}");
                };
                let path = sampled(&["T_x"], (0..=2 * points).map(value));
                let cycles = path.cycles();
                assert!(!cycles.is_empty());
                // The first may begin without shear: the way to the first point belongs to it.
                for cycle in cycles.into_iter().filter(|(first, _)| *first > 1) {
                    is_whole(&path, cycle);
                }
                let (first, last) = path.last_cycle().expect("a cycle");
                assert_eq!((last + 1 - first, last + 1), (points, path.branches.len()));
                // Half a period more or less leaves whole cycles only.
                let path = sampled(&["T_x"], (0..=3 * points / 2).map(value));
                let swings = path.cycles().into_iter().filter(|(first, _)| *first > 1);
                for cycle in swings.chain(path.last_cycle().filter(|(first, _)| *first > 1)) {
                    is_whole(&path, cycle);
                }
            }
        }
    }

    #[test]
    fn random_histories_repeat_with_their_period() {
        let mut rng = fastrand::Rng::with_seed(7);
        for n in 0..50 {
            let points = rng.usize(5..70);
            let path = history(&mut rng, points, 3, 0);
            let cycles = path.cycles();
            assert_eq!(
                cycles.len(),
                3,
                "history {n} of {points} points: {cycles:?}"
            );
            assert!(
                cycles
                    .iter()
                    .all(|(first, last)| last + 1 - first == points)
            );
            let cut = rng.usize(1..points);
            let path = history(&mut rng, points, 1, cut);
            assert!(path.cycles().is_empty(), "history {n} is no whole period");
            assert!(path.no_cycle().to_string().contains("no closed cycle"));
        }
    }

    #[test]
    fn noise_is_refused_or_its_period_is_given() {
        let mut rng = fastrand::Rng::with_seed(3);
        let points: usize = 16;
        let rows: Vec<Vec<f64>> = (0..=3 * points)
            .map(|n| {
                let angle = std::f64::consts::TAU * n as f64 / points as f64;
                vec![n as f64 + 1.0, angle.sin() + 2e-3 * (rng.f64() - 0.5)]
            })
            .collect();
        let mut path = LoadPath::start().push_branch(super::super::Branch::new(
            LoadPath::start().normal(10.0, 1).end_point().0,
            1,
            0.5,
        ));
        path = path
            .waypoints(&["t", "T_x"], &rows, Increments::Each(1))
            .expect("a path");
        assert!(path.cycles().is_empty());
        let text = path.no_cycle().to_string();
        assert!(text.contains("period"), "{text}");
        path.period = Some(points as f64);
        let cycles = path.cycles();
        assert_eq!(cycles, [(2, 17), (18, 33), (34, 49)]);
        assert_eq!(path.opens(cycles[1]), None);
        path.period = Some(points as f64 / 2.0 + 1.0);
        assert!(path.cycles().is_empty());
        assert!(path.no_cycle().to_string().contains("T_x at the times"));
        path.period = Some(7.3);
        assert!(
            path.no_cycle()
                .to_string()
                .contains("no branch ends at the time")
        );
    }

    #[test]
    fn a_load_that_pulsates_once_is_a_cycle() {
        for rows in [
            &[2.0, 10.0, 2.0][..],
            &[2.0, 5.0, 10.0, 4.0, 2.0],
            &[0.0, 7.0, 10.0, 7.0, 0.0],
        ] {
            let path = sampled(&["T_x"], rows.iter().map(|T| vec![*T]));
            let start = if rows[0] == 0.0 { 1 } else { 2 };
            assert_eq!(path.cycles(), [(start, rows.len())], "{rows:?}");
        }
        let path = sampled(
            &["T_x"],
            [7.0, 10.0, 7.0, 0.0, -7.0, -10.0, -7.0]
                .map(|T| vec![T])
                .into_iter(),
        );
        assert!(path.cycles().is_empty());
    }

    #[test]
    fn a_period_of_motions_from_no_shear_is_a_cycle() {
        let value = |n: usize| vec![1e-6 * (std::f64::consts::TAU * (n % 8) as f64 / 8.0).sin()];
        let path = sampled(&["delta_x"], (1..=8).map(value));
        assert_eq!(path.cycles(), [(1, 8)]);
        let path = sampled(&["delta_x"], (1..=6).map(value));
        assert!(path.cycles().is_empty());
    }
}
