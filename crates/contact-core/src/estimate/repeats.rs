//! Branches that repeat earlier ones: the increments and the error of a cycle are found once.

use crate::scene::{Branch, LoadPath};

/// For each branch, the first one that it repeats; itself if it repeats none.
pub(super) struct Repeats(Vec<usize>);

impl Repeats {
    /// Branches that lead from the same loads to the same loads in increments of the same kind, of
    /// a path with the increments of the first round, chosen in the `open` branches.
    pub(super) fn new(path: &LoadPath, open: &[bool]) -> Self {
        let branches = &path.branches;
        let from = |k: usize| k.checked_sub(1).map(|before| branches[before].to);
        let alike = |k: usize, other: usize| {
            let [a, b] = [k, other].map(|n| &branches[n]);
            a.to == b.to
                && from(k) == from(other)
                && (open[k], a.increments, a.spacing) == (open[other], b.increments, b.spacing)
        };
        Self::find(branches.len(), alike)
    }

    /// Finds branches that end at the same loads, wherever they begin.
    pub(super) fn of_ends(branches: &[Branch]) -> Self {
        Self::find(branches.len(), |k, other| {
            branches[k].to == branches[other].to
        })
    }

    /// For each branch the first one that is `alike`, itself if there is no earlier one.
    fn find(branches: usize, alike: impl Fn(usize, usize) -> bool) -> Self {
        let first = |k| (0..k).find(|&other| alike(k, other)).unwrap_or(k);
        Self((0..branches).map(first).collect())
    }

    /// Returns the case in which no branch repeats another.
    pub(super) fn none(path: &LoadPath) -> Self {
        Self((0..path.branches.len()).collect())
    }

    /// Index of the last branch that repeats no earlier one; all later ones are known from those up to it.
    pub(super) fn last(&self) -> usize {
        self.0.iter().copied().max().unwrap_or_default()
    }

    /// Copies increments and errors to each branch from the one that it repeats.
    pub(super) fn fill(&self, branches: &mut [Branch]) {
        for (k, &of) in self.0.iter().enumerate() {
            let Branch {
                increments,
                path_error,
                ..
            } = branches[of];
            (branches[k].increments, branches[k].path_error) = (increments, path_error);
        }
    }
}
