//! Bounds of a criterion over all planes, and on triangles of them.

use super::OnPlanes;
use crate::combination::Combination;
use crate::critical_plane::Peak;
use crate::forms::{EDGES, gather_corners};
use crate::hemisphere::Face;
use crate::lanes::{LANES, ROUNDING};
use crate::plane_function::{BestPlane, Plane, PlaneFunction};
use crate::refine::First;
use crate::shear_bound::BestPlaneBound;

/// Stresses below this part of the largest component are rounding.
const NOTHING: f64 = 1e-12;

impl OnPlanes<'_> {
    /// The plane of histories that need no search: no tension where the criterion requires it, or a stress that
    /// changes hydrostatically only, so that no plane is sheared. None if a search is needed.
    ///
    /// The normal is NaN where the value is 0 on all planes.
    ///
    /// The normal is NaN where the value is 0 on all planes.
    pub(crate) fn without_search(&mut self) -> Option<Peak> {
        let (tension, along) = self.tension;
        let strain_factor = self
            .strain
            .map_or(0.0, |[along, across]| along + 3.0 * across);
        let first = if self.has_shear {
            self.tresca.1
        } else {
            strain_factor * self.sizes[1]
        };
        let no_plane = |missed: f64| {
            let n = [f64::NAN; 3];
            Some(Peak {
                n,
                value: 0.0,
                missed,
                planes: 0,
            })
        };
        let needs_tension = matches!(
            self.combination,
            Combination::Product | Combination::Raised(_)
        );
        if needs_tension && self.combination.value([first, tension - NOTHING]) <= 0.0 {
            return no_plane(self.combination.value([first, tension]));
        }
        if self.tresca.1 > NOTHING {
            return None;
        }
        let parts = self.parts(along);
        let value = self.combination.value(parts);
        let change = self.strain.map_or(0.0, |[along, _]| along * self.tresca.1);
        let ceiling = match (self.has_shear, self.strain) {
            (true, None) => [self.tresca.1, tension],
            (true, Some(_)) => [self.tresca.1, parts[1] + change],
            (false, _) => [parts[0] + change, tension],
        };
        let missed = (self.combination.value(ceiling) - value).max(0.0);
        Some(Peak {
            n: along,
            value,
            missed,
            planes: 0,
        })
    }

    /// Bounds of the rounding errors of the two parts.
    pub(super) fn slack(&self) -> [f64; 2] {
        let spacing = if self.in_double {
            f64::EPSILON
        } else {
            f64::from(f32::EPSILON)
        };
        let [stress, shear] = self.sizes.map(|size| ROUNDING * spacing * size);
        let strain = self
            .strain
            .map(|[along, across]| (along + 3.0 * across) * shear);
        if self.has_shear {
            [shear, strain.unwrap_or(stress)]
        } else {
            [strain.unwrap_or(stress), stress]
        }
    }

    /// Upper bound of the second part on all planes: no component of a unit normal is larger
    /// than 1.
    pub(super) fn max_second_part(&self) -> f64 {
        let [stress, strained] = self.sizes;
        let strain_bound = |[along, across]: [f64; 2]| (along + across) * strained;
        3.0 * self.strain.map_or(stress, strain_bound)
    }

    /// Lowers the bounds by the [`BestPlaneBound`], if two instants define its circle, as long as
    /// that excludes faces.
    pub(super) fn shear_bounds(&mut self, faces: &mut [Face], planes: &[Plane], known: &BestPlane) {
        if self.best != known.n {
            self.best = known.n;
            let First::Shear([a, b, c]) = self.deciding_piece(known.n).first else {
                return;
            };
            let ends = if a == b {
                Some([a, c])
            } else {
                (b == c).then_some([a, b])
            };
            self.near_best = ends.map(|on| {
                BestPlaneBound::load(
                    known.n,
                    on,
                    self.histories.strained(),
                    &mut self.buffers.squares,
                )
            });
        }
        let Some(near_best) = &self.near_best else {
            return;
        };
        let slack = self.slack()[1];
        let second = |eight: &[Face]| {
            if self.combination.tie() > 0.0 {
                // Its weight is tiny: an upper bound over all planes is enough.
                return [[self.max_second_part(); LANES]; 3];
            }
            let corners = gather_corners(eight);
            EDGES.map(|(i, j)| {
                let (a, b) = (&corners[i], &corners[j]);
                let normal_max = if self.in_double {
                    self.buffers.double.mixed(a, b, None).normal_max
                } else {
                    let mixed = self.buffers.single.mixed(a, b, None);
                    mixed.normal_max.map(f64::from)
                };
                normal_max.map(|most| most + slack)
            })
        };
        let first = known.parts[0].max(f64::MIN_POSITIVE);
        if !near_best.bounds(&self.buffers.squares, first, second, (faces, planes), known) {
            self.near_best = None;
        }
    }
}
