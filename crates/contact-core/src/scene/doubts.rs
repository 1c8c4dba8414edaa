//! Implausible numbers of a scene: a wrong unit, a typing error.
//!
//! Everything is compared with something else of the scene, never with what is usual, so that a
//! scene in units of its own is a scene like any other.

use plasticity::{NUMBERS, Plastic};
use plausible::unit::Kind;
use plausible::{UNITS, doubt_of, quantity};

use super::shape::Shape;
use super::validity::stiffest;
use super::{Body, Branch, Coating, Elastic, Grid, Prescribed, RigidMotion, Scene, SurfaceMap};
use crate::error::Error;

/// Peak pressure over the contact modulus, or bulk strain, beyond which strains are not small.
pub(crate) const LARGE_STRAIN: f64 = 0.1;
/// Young's modulus below the softest rubber; the numbers of all solids in MPa lie below it \[Pa\]. Lengths
/// that are hardly in metres then: of a grid, of a radius \[m\].
const GEL: f64 = 2e6;
const LONG: [f64; 2] = [0.05, 0.5];
/// Growth of the yield stress per strain, over E, below which a law hardly hardens and above which it
/// is stiffer than the elastic body: of metals it is 1e-4 to 1.
const HARDENS: [f64; 2] = [1e-5, 2.0];
/// Yield stress, its growth, and residual stress over E beyond which no solid holds: the theoretical
/// strength is E/10.
const STRONGEST: f64 = 0.2;
/// Cells in the thickness of a layer from which its own stress is known.
pub const CELLS_PER_FILM: f64 = 2.0;
/// Work of adhesion of surfaces that attract each other by van der Waals forces alone \[J/m^2\] (J. N.
/// Israelachvili, Intermolecular and Surface Forces (2011), ch. 13), and pull-off force over W of a doubt.
const WEAK_ADHESION: f64 = 0.05;
const ADHESIVE: f64 = 0.1;
/// Largest contact radius of that doubt \[m\].
const WIDEST_ADHESIVE: f64 = 1e-3;
/// Thickness over contact radius above which the substrate of a coating hardly matters.
const THICK: f64 = 1000.0;
/// Root-mean-square slope of a measured surface above which its heights are probably not in metres.
const STEEP: f64 = 0.5;
/// Cells between two points of a map from which on it is coarser than the grid.
const COARSE_MAP: f64 = 2.0;
/// Cells between points of a map from which their distance is taken to be in another unit.
const OTHER_UNIT: f64 = 100.0;
/// Shift over the longer side of the grid beyond which its unit is another one.
const FARTHEST: f64 = 200.0;
/// Part of the Hertz radius that a contact reaches for certain.
const CERTAIN: f64 = 0.97;

impl Scene {
    /// Fails at values that are impossible together: a contact as wide as a body, a shift that no contact
    /// makes, heights beyond the length of their map.
    pub(crate) fn check_plausibility(&self) -> Result<(), Error> {
        for (key, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            for map in height_maps(&body.shape) {
                let (nx, ny) = map.values.dim();
                let length = (nx as f64 * map.spacing.0).max(ny as f64 * map.spacing.1);
                let height_range = height_range(map);
                if height_range > length {
                    let allowed = format!("below the length of the map, {length:.3e} m: {UNITS}");
                    let heights = format!("heights over a range of {height_range:.3e} m");
                    return Err(Error::invalid(
                        format!("{key}.shape.height_map"),
                        heights,
                        allowed,
                    ));
                }
            }
        }
        self.check_shifts()?;
        self.check_breadth()
    }

    /// Fails at a shift that no contact of this size makes: metres that are meant as micrometres.
    fn check_shifts(&self) -> Result<(), Error> {
        let longest = FARTHEST * self.grid.longer_side();
        for (i, branch) in self.path.branches.iter().enumerate() {
            for motion in [
                RigidMotion::DeltaX,
                RigidMotion::DeltaY,
                RigidMotion::DeltaZ,
            ] {
                if let Prescribed::Motion(shift) = branch.to.prescribed(motion)
                    && shift.abs() > longest
                {
                    let allowed = format!(
                        "at most {longest:.3e} m, {FARTHEST} times the side of the grid: {UNITS}"
                    );
                    let key = format!("path[{i}].{}", motion.name());
                    return Err(Error::invalid(key, format!("{shift:e} m"), allowed));
                }
            }
        }
        Ok(())
    }

    /// Fails if the contact is certain to leave the grid, even if each body were of its stiffest
    /// material alone, or to be too small for its cells, even if it were of its softest. A scene
    /// that passes may still turn out so when it is solved.
    pub fn check_fit(&self) -> Result<(), Error> {
        let stiffest_scene = Self {
            body1: stiffest(&self.body1),
            body2: stiffest(&self.body2),
            ..self.clone()
        };
        let Some(hertz) = stiffest_scene
            .hertz()
            .filter(|_| self.is_sum_of_paraboloids())
        else {
            return self.check_resolution();
        };
        let (extent_x, extent_y) = self.grid.extent();
        let narrower_side = if self.grid.plane_strain {
            extent_x
        } else {
            extent_x.min(extent_y)
        };
        // The axes of an ellipse lie on either side of the mean; its area decides.
        let (k_1, k_2) = self.principal_curvatures();
        let fits = if self.grid.plane_strain || k_1 - k_2 <= 1e-9 * k_1 {
            2.0 * CERTAIN * hertz.a < narrower_side
        } else {
            std::f64::consts::PI * (CERTAIN * hertz.a).powi(2) < extent_x * extent_y
        };
        if fits {
            return self.check_resolution();
        }
        let units = self.doubts_of_units().into_iter().next();
        Err(Error::GridTooSmall {
            doubt: units.map_or_else(String::new, |doubt| format!("; {doubt}")),
            W: hertz.W,
            unit: self.grid.unit_of("N"),
            a: hertz.a,
            extent_x,
            extent_y,
            needed: 2.4 * self.hertz().map_or(hertz.a, |h| h.a),
        })
    }

    /// Whether both surfaces are sums of paraboloids alone, so that nothing keeps a contact small.
    pub(crate) fn is_sum_of_paraboloids(&self) -> bool {
        /// Whether a shape is flat or a paraboloid, without flanks or ends that keep a contact small.
        fn is_paraboloid(shape: &Shape) -> bool {
            match shape {
                Shape::Flat | Shape::Sphere { .. } | Shape::Ellipsoid { .. } => true,
                Shape::Cylinder { length, .. } => *length == f64::INFINITY,
                Shape::Sum(parts) => parts.iter().all(is_paraboloid),
                _ => false,
            }
        }
        is_paraboloid(&self.body1.shape) && is_paraboloid(&self.body2.shape)
    }

    /// Allowed but implausible values, one sentence each with the interpretation used.
    pub fn doubts(&self) -> Vec<String> {
        let mut doubts = self.doubts_without_breadth();
        let breadth = self.hertz_breadth();
        doubts.extend(breadth.and_then(|breadth| self.doubt_of_breadth(&breadth)));
        doubts.extend(self.doubts_of_cells());
        doubts.extend(self.doubt_of_adhesion());
        doubts.extend(self.doubt_of_heathcote_slip());
        doubts
    }

    /// The pull-off force \[N\] of the nominal shapes, of line contacts \[N/m\], for a work of adhesion w
    /// \[J/m^2\]. Of round contacts it is `1.5 pi w R` (K. L. Johnson, K. Kendall, A. D. Roberts, Proc. R. Soc. A 324
    /// (1971) 301-313), R being the mean radius of the gap, of lines `3 (pi E* w^2 R/16)^(1/3)` (M. Barquins, J.
    /// Adhesion 26 (1988) 1-12).
    pub fn pull_off_force(&self, w: f64) -> Option<f64> {
        let hertz = self.hertz()?;
        let (steep, shallow) = self.principal_curvatures();
        Some(if self.grid.plane_strain {
            3.0 * (std::f64::consts::PI * hertz.E_star * w * w / (16.0 * steep)).cbrt()
        } else {
            1.5 * std::f64::consts::PI * w / (steep * shallow).sqrt()
        })
    }

    /// Doubts a load of which adhesion of the weakest kind is no small part.
    fn doubt_of_adhesion(&self) -> Option<String> {
        let hertz = self.hertz().filter(|hertz| {
            // Larger contacts, and softer bodies than gels, are in units of their own.
            self.is_sum_of_paraboloids() && hertz.a < WIDEST_ADHESIVE && hertz.E_star > 0.1 * GEL
        })?;
        let W = hertz.W;
        let force = self.pull_off_force(WEAK_ADHESION)?;
        (force > ADHESIVE * W).then(|| {
            format!(
                "the pull-off force is {force:.2e} {unit}, {:.2} of W = {W:.2e} {unit}, for a work of adhesion of \
                 {WEAK_ADHESION} J/m^2. Clean dry surfaces have that or more. Adhesion is not in the model",
                force / W,
                unit = self.grid.unit_of("N")
            )
        })
    }

    /// Returns the doubts that need no estimate of the contact.
    pub(crate) fn doubts_without_breadth(&self) -> Vec<String> {
        let mut doubts = self.doubts_of_values();
        let longer_side = self.grid.longer_side();
        for (key, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            doubts.extend(self.doubt_of_thin_layers(key, body));
            for map in height_maps(&body.shape) {
                doubts.extend(self.doubts_of_map(map, &format!("{key}.shape.height_map")));
                let slope = rms_slope(map);
                if slope > STEEP {
                    doubts.push(format!(
                        "{key}.shape.height_map has slopes of {slope:.2} (root mean square), {:.0} \
                         degrees: {UNITS}",
                        slope.atan().to_degrees()
                    ));
                }
            }
        }
        if let Some(map) = &self.friction.map {
            doubts.extend(doubt_of_filled_points(map, "friction.map"));
        }
        doubts.extend(self.doubts_of_loads(longer_side));
        doubts
    }

    /// Returns the doubts about single values, whatever the cells are.
    pub(super) fn doubts_of_values(&self) -> Vec<String> {
        let mut doubts = self.doubts_of_units();
        let longer_side = self.grid.longer_side();
        let a = self.hertz().map_or(longer_side, |h| h.a);
        for (key, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            for (i, Coating { thickness, .. }) in body.coatings.iter().enumerate() {
                if *thickness > THICK * a {
                    doubts.push(format!(
                        "{key}.coatings[{i}].thickness = {thickness:.3e} m is {:.0} times the contact: \
                         what lies below it does not matter; {UNITS}",
                        thickness / a
                    ));
                }
            }
        }
        doubts
    }

    /// Warnings about numbers that are hardly in SI units, such as moduli in GPa and lengths in mm.
    fn doubts_of_units(&self) -> Vec<String> {
        let mut doubts = Vec::new();
        let mut stiffest: f64 = 0.0;
        let mut radius: f64 = 0.0;
        for (key, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            for n in 0..=body.coatings.len() {
                let coating = body.coatings.get(n);
                let E = coating.map_or(body.substrate, |c| c.material).E;
                let layer_key = match coating {
                    Some(_) => format!("{key}.coatings[{n}]"),
                    None => key.to_owned(),
                };
                stiffest = stiffest.max(if E.is_finite() { E } else { 0.0 });
                let mut check = |name: String, value| doubts.extend(doubt_of(&name, &name, value));
                check(format!("{layer_key}.E"), E);
                check(format!("{layer_key}.bond_normal"), body.bond(n).normal);
                if let Some(law) = body.plastic(n) {
                    doubts.extend(doubts_of_yielding(&format!("{layer_key}.plastic"), law, E));
                }
            }
            for (layer, profile) in body.residual.iter().enumerate() {
                let name = format!("{}.residual", body.layer_key(layer, key));
                let stresses = profile.rows.iter().flat_map(|[_, xx, yy]| [*xx, *yy]);
                let largest = stresses.fold(
                    0.0,
                    |extreme: f64, s| if s.abs() > extreme.abs() { s } else { extreme },
                );
                doubts.extend(doubt_of(&name, &name, largest));
                let E = body
                    .coatings
                    .get(layer)
                    .map_or(body.substrate, |c| c.material)
                    .E;
                if largest.abs() > STRONGEST * E {
                    doubts.push(format!(
                        "{name} = {largest:.3e} Pa is {:.1} times E: no solid holds that; {UNITS}",
                        largest.abs() / E
                    ));
                }
                let depths = || profile.rows.iter().map(|[z, ..]| *z).filter(|z| *z > 0.0);
                let second = depths().fold(f64::INFINITY, f64::min);
                let of_depths = doubt_of("residual.depth", &format!("{name}[..][0]"), second);
                let deepest = depths().fold(0.0, f64::max);
                doubts.extend(
                    of_depths.or_else(|| {
                        doubt_of("residual.deepest", &format!("{name}[..][0]"), deepest)
                    }),
                );
            }
            for R in radii_of_curvature(&body.shape) {
                radius = radius.max(R);
                doubts.extend(doubt_of("R", &format!("{key}.shape.R"), R));
            }
            for (name, angle) in angles(&body.shape) {
                let name = format!("{key}.shape.{name}");
                doubts.extend(doubt_of(&name, &name, angle));
            }
            if let Some(azimuth) = body.bulk.azimuth {
                let name = format!("{key}.bulk_azimuth");
                doubts.extend(doubt_of(&name, &name, azimuth));
            }
        }
        let (extent, _) = self.grid.extent();
        if (quantity("modulus").least..GEL).contains(&stiffest)
            && (extent > LONG[0] || radius > LONG[1])
        {
            doubts.push(format!(
                "moduli of at most {stiffest:.3e} Pa, as of gels, on a grid {extent:.3e} m long. Numbers in mm, N and MPa \
                 are taken as m, N and Pa, and results carry these units; {UNITS}"
            ));
        }
        for (key, mu) in [("mu", self.friction.mu)]
            .into_iter()
            .chain(self.friction.coefficients())
        {
            let key = format!("friction.{key}");
            doubts.extend(doubt_of(&key, &key, mu));
        }
        let stiffness = self.path.rig_stiffness;
        doubts.extend(stiffness.and_then(|K| doubt_of("rig.stiffness", "rig.stiffness", K)));
        doubts
    }

    /// Doubts an outermost layer thinner than a cell, if the material below it differs.
    fn doubt_of_thin_layers(&self, key: &str, body: &Body) -> Option<String> {
        let Grid { dx, dy, .. } = self.grid;
        let cell = if self.grid.plane_strain {
            dx
        } else {
            dx.min(dy)
        };
        let Coating {
            material,
            thickness,
        } = *body.coatings.first()?;
        let below = body.coatings.get(1).map_or(body.substrate, |c| c.material);
        (thickness < cell && material != below).then(|| {
            format!(
                "{key}.coatings[0].thickness = {thickness:.3e} m is {:.2} of a cell. Loads, contact size and energy are \
                 right. Tractions and stresses in the layer are averages over a cell. For these, use cells of \
                 {:.2e} m, {CELLS_PER_FILM} in its thickness",
                thickness / cell,
                thickness / CELLS_PER_FILM
            )
        })
    }

    /// Doubts measured heights whose points are farther apart than cells, or were not measured.
    fn doubts_of_map(&self, map: &SurfaceMap, key: &str) -> Vec<String> {
        let mut doubts = Vec::new();
        let (nx, ny) = map.values.dim();
        let cells_between_points =
            |points: usize, spacing: f64, cell: f64| (points > 1).then_some(spacing / cell);
        let (x, y) = (
            cells_between_points(nx, map.spacing.0, self.grid.dx),
            cells_between_points(ny, map.spacing.1, self.grid.dy),
        );
        let coarser = x.into_iter().chain(y).fold(0.0, f64::max);
        if coarser > COARSE_MAP {
            let (extent, _) = self.grid.extent();
            let remedy = if coarser > OTHER_UNIT {
                UNITS
            } else {
                "cells as wide as the points are apart lose nothing"
            };
            doubts.push(format!(
                "the points of the map {key} lie {:.3e} m by {:.3e} m apart, {coarser:.1} cells of the grid of \
                 {extent:.3e} m. Straight lines, not measurements, join them; {remedy}",
                map.spacing.0, map.spacing.1
            ));
        }
        doubts.extend(doubt_of_filled_points(map, key));
        doubts
    }

    /// The branch with the largest size of a load over the path, and the load there.
    fn largest_load(&self, load: impl Fn(&Branch) -> Option<f64>) -> Option<(usize, f64)> {
        let loads = self.path.branches.iter().map(load).enumerate();
        let loads = loads.filter_map(|(i, load)| Some((i, load?)));
        loads.reduce(|largest, next| {
            if next.1.abs() > largest.1.abs() {
                next
            } else {
                largest
            }
        })
    }

    /// Doubts the load path, on a grid with the side `longer_side`. Bulk stresses and angles are doubted
    /// where they are largest: a load that swings passes 0.
    fn doubts_of_loads(&self, longer_side: f64) -> Vec<String> {
        let mut doubts = Vec::new();
        for (name, body) in [("sigma_B", &self.body2), ("sigma_B1", &self.body1)] {
            let bulk = |branch: &Branch| match name {
                "sigma_B" => branch.to.sigma_B,
                _ => branch.to.sigma_B1,
            };
            let Some((i, sigma_B)) = self.largest_load(|branch| Some(bulk(branch))) else {
                continue;
            };
            doubts.extend(doubt_of(name, &format!("path[{i}].{name}"), sigma_B));
            let [strain, _] = body.bulk_strain(sigma_B, self.grid.plane_strain);
            if strain.abs() > LARGE_STRAIN {
                doubts.push(format!(
                    "path[{i}].{name} = {sigma_B:.3e} Pa strains the body by {strain:.2}, which is not \
                     small: {UNITS}"
                ));
            }
        }
        for motion in [RigidMotion::PhiX, RigidMotion::PhiY, RigidMotion::PhiZ] {
            let angle = |branch: &Branch| match branch.to.prescribed(motion) {
                Prescribed::Motion(angle) => Some(angle),
                Prescribed::Load(_) => None,
            };
            if let Some((i, angle)) = self.largest_load(angle) {
                let name = format!("path[{i}].{}", motion.name());
                doubts.extend(doubt_of(&name, &name, angle));
            }
        }
        for (i, branch) in self.path.branches.iter().enumerate() {
            for motion in [RigidMotion::DeltaX, RigidMotion::DeltaY] {
                if let Prescribed::Motion(shift) = branch.to.prescribed(motion)
                    && shift.abs() > longer_side
                {
                    let name = motion.name();
                    doubts.push(format!(
                        "path[{i}].{name} = {shift:.3e} m is beyond the grid, {longer_side:.3e} m: {UNITS}"
                    ));
                }
            }
        }
        doubts
    }
}

/// Stresses of a law of yielding that are hardly in Pa, alone or beside E \[Pa\].
fn doubts_of_yielding(key: &str, mut law: Plastic, E: f64) -> Vec<String> {
    let mut doubts = Vec::new();
    for number in &NUMBERS {
        let key = format!("{key}.{}", number.name);
        let is_stress = plausible::of_key(&key).is_some_and(|of| of.kind == Kind::Stress);
        // The moduli of hardening are growths per strain, the others stresses.
        let per_strain = matches!(number.name, "hardening" | "kinematic" | "chaboche_C");
        let values = (number.of)(&mut law).iter();
        let doubt = |value: &f64| {
            let ratio = value / E;
            let about_E = |what: &str| {
                Some(format!(
                    "{key} = {value:.3e} Pa is {ratio:.1e} of E: {what}; {UNITS}"
                ))
            };
            doubt_of(&key, &key, *value).or_else(|| match per_strain {
                true if ratio < HARDENS[0] => about_E("it hardly hardens"),
                true if ratio > HARDENS[1] => about_E("it is stiffer than the elastic body"),
                false if ratio > STRONGEST => about_E("no solid is as strong"),
                _ => None,
            })
        };
        let values = values.filter(|value| is_stress && **value != 0.0);
        doubts.extend(values.filter_map(doubt));
    }
    doubts
}

/// The body with all layers replaced by its softest material.
pub(super) fn softest(body: &Body) -> Body {
    let coatings = body.coatings.iter().map(|c| c.material);
    let modulus = |m: &Elastic| m.E / (1.0 - m.nu * m.nu);
    let substrate = coatings.fold(body.substrate, |s, m| {
        if modulus(&m) < modulus(&s) { m } else { s }
    });
    Body::homogeneous(substrate, body.shape.clone())
}

/// Absolute radii of curvature of a shape that is no plane \[m\].
fn radii_of_curvature(shape: &Shape) -> Vec<f64> {
    match shape {
        Shape::Sphere { R } | Shape::Cylinder { R, .. } | Shape::CrownedRoller { R, .. } => {
            vec![R.abs()]
        }
        Shape::Ellipsoid { R_x, R_y, .. } => vec![R_x.abs(), R_y.abs()],
        Shape::Sum(parts) => parts.iter().flat_map(radii_of_curvature).collect(),
        _ => Vec::new(),
    }
}

/// The angles of a shape \[rad\], each with its key.
fn angles(shape: &Shape) -> Vec<(&'static str, f64)> {
    match *shape {
        Shape::Ellipsoid { angle, .. }
        | Shape::Cylinder { angle, .. }
        | Shape::CrownedRoller { angle, .. }
        | Shape::Ridges { angle, .. }
        | Shape::Wedge { angle, .. } => vec![("angle", angle)],
        Shape::Waviness { angle, phase, .. } => vec![("angle", angle), ("phase", phase)],
        Shape::Sum(ref parts) => parts.iter().flat_map(angles).collect(),
        _ => Vec::new(),
    }
}

/// Doubts a map of which some points were filled with the mean of their neighbours.
fn doubt_of_filled_points(map: &SurfaceMap, key: &str) -> Option<String> {
    (map.filled > 0).then(|| {
        format!(
            "{} of {} points of the map {key} were not measured: each has the mean of its neighbours",
            map.filled,
            map.values.len()
        )
    })
}

/// The measured heights in a shape.
fn height_maps(shape: &Shape) -> Vec<&SurfaceMap> {
    match shape {
        Shape::HeightMap(map) => vec![map],
        Shape::Sum(parts) => parts.iter().flat_map(height_maps).collect(),
        _ => Vec::new(),
    }
}

/// Highest less lowest point of a map \[m\].
fn height_range(map: &SurfaceMap) -> f64 {
    let (low, high) = map
        .values
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), z| {
            (l.min(*z), h.max(*z))
        });
    high - low
}

/// Root mean square of the slope between neighbouring points.
fn rms_slope(map: &SurfaceMap) -> f64 {
    let (nx, ny) = map.values.dim();
    let z = &map.values;
    let (mut sum, mut n) = (0.0, 0_usize);
    for i in 1..nx {
        for j in 1..ny {
            let slope_x = (z[(i, j)] - z[(i - 1, j)]) / map.spacing.0;
            let slope_y = (z[(i, j)] - z[(i, j - 1)]) / map.spacing.1;
            sum += slope_x * slope_x + slope_y * slope_y;
            n += 1;
        }
    }
    (sum / n.max(1) as f64).sqrt()
}
