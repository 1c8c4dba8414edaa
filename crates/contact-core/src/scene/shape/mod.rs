//! Shapes of the undeformed surfaces.

mod rough;

pub use rough::Rough;

use std::f64::consts::TAU;

use ndarray::Array2;

use super::{Grid, SurfaceMap};
use crate::error::Error;

/// The undeformed surface of a body, as the height that it falls back from the contact plane.
///
/// Near the contact every curved surface is replaced by its parabola, as in Hertz's theory. An `angle`
/// turns the shape about z, from x towards y \[rad\].
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// The contact plane itself.
    Flat,
    /// A sphere.
    Sphere {
        /// Radius R \[m\]; negative for a hollow one.
        R: f64,
    },
    /// An ellipsoid, or any surface with two principal radii.
    Ellipsoid {
        /// Principal radius in the direction `angle` \[m\]; negative for a hollow one.
        R_x: f64,
        /// Principal radius across it \[m\].
        R_y: f64,
        /// Direction of the first one \[rad\].
        angle: f64,
    },
    /// A cylinder with sharp ends; its axis is y turned by the angle.
    Cylinder {
        /// Radius R \[m\]; negative for a hollow one.
        R: f64,
        /// Length along the axis \[m\]; infinite for a cylinder that leaves the grid.
        length: f64,
        /// Turn of the axis from y \[rad\].
        angle: f64,
    },
    /// A cylinder whose ends are rounded off; its axis is y turned by the angle.
    CrownedRoller {
        /// Radius R \[m\].
        R: f64,
        /// Length of the straight part \[m\], 0 for a crown all along.
        length: f64,
        /// Radius of the crown along the axis beyond the straight part \[m\].
        crown: f64,
        /// Turn of the axis from y \[rad\].
        angle: f64,
    },
    /// A cone with its tip at the origin.
    Cone {
        /// Slope of the flank, the tangent of its angle to the contact plane.
        slope: f64,
    },
    /// Two flanks that meet in an edge; the edge is y turned by the angle.
    Wedge {
        /// Slope of the flanks, the tangent of their angle to the contact plane.
        slope: f64,
        /// Turn of the edge from y \[rad\].
        angle: f64,
    },
    /// A round flat punch with a rounded edge.
    FlatPunch {
        /// Radius of the flat \[m\].
        radius: f64,
        /// Radius of the rounding beyond it \[m\].
        edge: f64,
    },
    /// A round ridge along a circle about the origin: a ring, an O-ring, the rim of a cup.
    Ring {
        /// Radius of the circle of its crest \[m\].
        radius: f64,
        /// Radius of its cross-section \[m\].
        R: f64,
    },
    /// Parallel ridges along y turned by the angle, symmetric about the origin.
    Ridges {
        /// Radius of a ridge \[m\].
        R: f64,
        /// Distance of neighbouring crests \[m\].
        spacing: f64,
        /// Number of ridges; infinite for a row without an end.
        count: f64,
        /// Turn of the ridges from y \[rad\].
        angle: f64,
    },
    /// A wave along the direction `angle`, with a crest at the origin for phase 0.
    Waviness {
        /// Height of a crest above the mean \[m\].
        amplitude: f64,
        /// Distance of the crests \[m\].
        wavelength: f64,
        /// Direction \[rad\].
        angle: f64,
        /// Phase at the origin \[rad\].
        phase: f64,
    },
    /// Heights \[m\] out of the body, towards the other one.
    HeightMap(SurfaceMap),
    /// A random self-affine surface.
    Rough(Rough),
    /// Several on top of one another: a wavy sphere, a rough punch.
    Sum(Vec<Self>),
}

impl Shape {
    /// A sphere of radius R \[m\].
    pub fn sphere(R: f64) -> Self {
        Self::Sphere { R }
    }

    /// A cylinder of radius R \[m\] along y that leaves the grid, as of a line contact.
    pub fn cylinder(R: f64) -> Self {
        Self::Cylinder {
            R,
            length: f64::INFINITY,
            angle: 0.0,
        }
    }

    /// Drop of the surface below the contact plane at the cell centres \[m\], shape (nx, ny).
    pub fn drop(&self, grid: &Grid) -> Array2<f64> {
        match self {
            Self::Sum(parts) => parts
                .iter()
                .fold(Array2::zeros((grid.nx, grid.ny)), |sum, s| {
                    sum + s.drop(grid)
                }),
            Self::Rough(rough) => rough.drop(grid),
            shape => grid.map(|x, y| shape.drop_at(x, y)),
        }
    }

    /// [`Self::drop`] of the surface that lies at x + `shift` \[m\] over the cells; `None` of random
    /// roughness, which is known on the grid alone.
    pub fn drop_shifted(&self, grid: &Grid, shift: f64) -> Option<Array2<f64>> {
        match self {
            Self::Rough(_) => None,
            Self::Sum(parts) => {
                let zero = Array2::zeros((grid.nx, grid.ny));
                let mut parts = parts.iter();
                parts.try_fold(zero, |sum, part| {
                    Some(sum + part.drop_shifted(grid, shift)?)
                })
            }
            shape => Some(grid.map(|x, y| shape.drop_at(x + shift, y))),
        }
    }

    /// Whether the surface is the same at every x, so that it may slide along x in place.
    pub fn is_straight_along_x(&self) -> bool {
        let across = |angle: f64| angle.cos().abs() < 1e-12;
        match self {
            Self::Flat => true,
            Self::Cylinder { length, angle, .. } => length.is_infinite() && across(*angle),
            Self::Wedge { angle, .. }
            | Self::Ridges { angle, .. }
            | Self::Waviness { angle, .. } => across(*angle),
            Self::Sum(parts) => parts.iter().all(Self::is_straight_along_x),
            _ => false,
        }
    }

    /// Drop below the contact plane at (x, y) \[m\]; zero for shapes that need the whole grid.
    fn drop_at(&self, x: f64, y: f64) -> f64 {
        let perpendicular_coordinate = |angle: f64| x * angle.cos() + y * angle.sin();
        let axial_coordinate = |angle: f64| y * angle.cos() - x * angle.sin();
        let squared_excess = |r: f64, radius: f64| {
            let excess = (r.abs() - radius).max(0.0);
            excess * excess
        };
        match *self {
            Self::Flat | Self::Rough(_) | Self::Sum(_) => 0.0,
            Self::Sphere { R } => (x * x + y * y) / (2.0 * R),
            Self::Ellipsoid { R_x, R_y, angle } => {
                perpendicular_coordinate(angle).powi(2) / (2.0 * R_x)
                    + axial_coordinate(angle).powi(2) / (2.0 * R_y)
            }
            Self::Cylinder { R, length, angle } => {
                // Beyond its ends there is nothing that could touch.
                let end = if 2.0 * axial_coordinate(angle).abs() > length {
                    R.abs()
                } else {
                    0.0
                };
                perpendicular_coordinate(angle).powi(2) / (2.0 * R) + end
            }
            Self::CrownedRoller {
                R,
                length,
                crown,
                angle,
            } => {
                perpendicular_coordinate(angle).powi(2) / (2.0 * R)
                    + squared_excess(axial_coordinate(angle), 0.5 * length) / (2.0 * crown)
            }
            Self::Cone { slope } => slope * x.hypot(y),
            Self::Wedge { slope, angle } => slope * perpendicular_coordinate(angle).abs(),
            Self::FlatPunch { radius, edge } => squared_excess(x.hypot(y), radius) / (2.0 * edge),
            Self::Ring { radius, R } => (x.hypot(y) - radius).powi(2) / (2.0 * R),
            Self::Ridges {
                R,
                spacing,
                count,
                angle,
            } => {
                let crest = nearest_crest(perpendicular_coordinate(angle) / spacing, count);
                (perpendicular_coordinate(angle) - spacing * crest).powi(2) / (2.0 * R)
            }
            Self::Waviness {
                amplitude,
                wavelength,
                angle,
                phase,
            } => {
                amplitude
                    * (1.0 - (TAU * perpendicular_coordinate(angle) / wavelength + phase).cos())
            }
            Self::HeightMap(ref map) => -map.interpolate(x, y),
        }
    }

    /// Second derivatives (xx, xy, yy) of the drop at the origin \[1/m\] of the nominal shape:
    /// waves, roughness and measured heights are left out, edges and flats have none.
    pub fn curvature(&self) -> [f64; 3] {
        let rotated = |k_x: f64, k_y: f64, angle: f64| {
            let (s, c) = angle.sin_cos();
            [
                k_x * c * c + k_y * s * s,
                (k_x - k_y) * s * c,
                k_x * s * s + k_y * c * c,
            ]
        };
        match self {
            Self::Sphere { R } => [1.0 / R, 0.0, 1.0 / R],
            Self::Ellipsoid { R_x, R_y, angle } => rotated(1.0 / R_x, 1.0 / R_y, *angle),
            Self::Cylinder { R, angle, .. } => rotated(1.0 / R, 0.0, *angle),
            Self::CrownedRoller {
                R,
                length,
                crown,
                angle,
            } => {
                let along = if *length > 0.0 { 0.0 } else { 1.0 / crown };
                rotated(1.0 / R, along, *angle)
            }
            Self::Sum(parts) => parts.iter().fold([0.0; 3], |sum, part| {
                let k = part.curvature();
                std::array::from_fn(|i| sum[i] + k[i])
            }),
            _ => [0.0; 3],
        }
    }

    /// Fails with the key of a parameter that is out of its range.
    pub fn check(&self, key: &str) -> Result<(), Error> {
        let refuse = |name: &str, value: f64, allowed: &str| {
            Err(Error::invalid(format!("{key}.{name}"), value, allowed))
        };
        let radius = "a finite radius in m, not zero";
        let positive = "a finite positive number";
        for (name, value, kind) in self.parameters() {
            let (good, allowed) = match kind {
                Range::Radius => (value.is_finite() && value != 0.0, radius),
                Range::Positive => (value.is_finite() && value > 0.0, positive),
                Range::NotNegative => (value.is_finite() && value >= 0.0, "a number >= 0"),
                Range::Length => (value > 0.0, "a positive length in m"),
                Range::Any => (value.is_finite(), "a finite number"),
                Range::Count => (
                    value >= 1.0 && (value.fract() == 0.0 || value.is_infinite()),
                    "a whole number from 1 on, or infinite",
                ),
            };
            if !good {
                return refuse(name, value, allowed);
            }
        }
        match self {
            Self::HeightMap(map) => map.check(&format!("{key}.height_map")),
            Self::Rough(rough) => rough.check(&format!("{key}.rough")),
            Self::Sum(parts) => parts
                .iter()
                .enumerate()
                .try_for_each(|(i, part)| part.check(&format!("{key}.sum[{i}]"))),
            _ => Ok(()),
        }
    }

    /// Fails if the shape has too few data for the cells of the grid.
    pub(crate) fn check_on(&self, grid: &Grid, key: &str) -> Result<(), Error> {
        match self {
            Self::HeightMap(map) => map.check_on(grid, &format!("{key}.height_map")),
            Self::Rough(rough) => rough.check_on(grid, &format!("{key}.rough")),
            Self::Sum(parts) => parts
                .iter()
                .enumerate()
                .try_for_each(|(i, part)| part.check_on(grid, &format!("{key}.sum[{i}]"))),
            _ => Ok(()),
        }
    }

    /// Returns the shape with other maps in the place of its own.
    pub(crate) fn with_maps(&self, change: &impl Fn(&SurfaceMap) -> SurfaceMap) -> Self {
        match self {
            Self::HeightMap(map) => Self::HeightMap(change(map)),
            Self::Sum(parts) => Self::Sum(parts.iter().map(|of| of.with_maps(change)).collect()),
            shape => shape.clone(),
        }
    }

    /// Whether it has measured heights.
    pub(crate) fn has_map(&self) -> bool {
        match self {
            Self::HeightMap(_) => true,
            Self::Sum(parts) => parts.iter().any(Self::has_map),
            _ => false,
        }
    }

    /// Whether it has hills and valleys: measured heights, roughness, waves.
    pub fn is_uneven(&self) -> bool {
        match self {
            Self::HeightMap(_) | Self::Rough(_) | Self::Waviness { .. } => true,
            Self::Sum(parts) => parts.iter().any(Self::is_uneven),
            _ => false,
        }
    }

    /// Name of the shape in a scene file.
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::Sphere { .. } => "sphere",
            Self::Ellipsoid { .. } => "ellipsoid",
            Self::Cylinder { .. } => "cylinder",
            Self::CrownedRoller { .. } => "crowned_roller",
            Self::Cone { .. } => "cone",
            Self::Wedge { .. } => "wedge",
            Self::FlatPunch { .. } => "flat_punch",
            Self::Ring { .. } => "ring",
            Self::Ridges { .. } => "ridges",
            Self::Waviness { .. } => "waviness",
            Self::HeightMap(_) => "height_map",
            Self::Rough(_) => "rough",
            Self::Sum(_) => "sum",
        }
    }

    /// Name, value and range of every number of an elementary shape, in the order of its fields.
    pub(crate) fn parameters(&self) -> Vec<(&'static str, f64, Range)> {
        use Range::{Any, Count, Length, NotNegative, Positive, Radius};
        match *self {
            Self::Flat | Self::HeightMap(_) | Self::Rough(_) | Self::Sum(_) => Vec::new(),
            Self::Sphere { R } => vec![("sphere.R", R, Radius)],
            Self::Ellipsoid { R_x, R_y, angle } => vec![
                ("ellipsoid.R_x", R_x, Radius),
                ("ellipsoid.R_y", R_y, Radius),
                ("ellipsoid.angle", angle, Any),
            ],
            Self::Cylinder { R, length, angle } => vec![
                ("cylinder.R", R, Radius),
                ("cylinder.length", length, Length),
                ("cylinder.angle", angle, Any),
            ],
            Self::CrownedRoller {
                R,
                length,
                crown,
                angle,
            } => vec![
                ("crowned_roller.R", R, Positive),
                ("crowned_roller.length", length, NotNegative),
                ("crowned_roller.crown", crown, Positive),
                ("crowned_roller.angle", angle, Any),
            ],
            Self::Cone { slope } => vec![("cone.slope", slope, Positive)],
            Self::Wedge { slope, angle } => vec![
                ("wedge.slope", slope, Positive),
                ("wedge.angle", angle, Any),
            ],
            Self::FlatPunch { radius, edge } => vec![
                ("flat_punch.radius", radius, Positive),
                ("flat_punch.edge", edge, Positive),
            ],
            Self::Ring { radius, R } => {
                vec![("ring.radius", radius, Positive), ("ring.R", R, Positive)]
            }
            Self::Ridges {
                R,
                spacing,
                count,
                angle,
            } => vec![
                ("ridges.R", R, Positive),
                ("ridges.spacing", spacing, Positive),
                ("ridges.count", count, Count),
                ("ridges.angle", angle, Any),
            ],
            Self::Waviness {
                amplitude,
                wavelength,
                angle,
                phase,
            } => vec![
                ("waviness.amplitude", amplitude, Any),
                ("waviness.wavelength", wavelength, Positive),
                ("waviness.angle", angle, Any),
                ("waviness.phase", phase, Any),
            ],
        }
    }
}

/// Range of a number of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Range {
    /// Finite, not zero.
    Radius,
    /// Finite, above zero.
    Positive,
    /// Finite, not below zero.
    NotNegative,
    /// Above zero, infinity included.
    Length,
    /// Finite.
    Any,
    /// Whole and above zero, infinity included.
    Count,
}

/// The crest next to a place, in numbers of spacings from the origin, of `count` crests about the origin.
fn nearest_crest(place: f64, count: f64) -> f64 {
    if count.is_infinite() {
        return place.round();
    }
    let outermost = 0.5 * (count - 1.0);
    ((place + outermost).round() - outermost).clamp(-outermost, outermost)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ridges_are_cylinders_side_by_side() {
        let (R, spacing) = (2e-3, 1e-4);
        let ridges = |count| Shape::Ridges {
            R,
            spacing,
            count,
            angle: 0.3,
        };
        let cylinder = |n: f64, x: f64, y: f64| {
            let u = x * 0.3_f64.cos() + y * 0.3_f64.sin() - n * spacing;
            u * u / (2.0 * R)
        };
        // The optimiser of rustc 1.95 loses a term of `fold(f64::INFINITY, f64::min)` over constants.
        let least_of = |drops: &mut dyn Iterator<Item = f64>| {
            drops.min_by(f64::total_cmp).expect("at least one crest")
        };
        for (x, y) in [(0.0, 0.0), (1.3e-4, 2e-5), (-4.1e-4, 1e-4), (2.6e-4, -3e-4)] {
            for (count, crests) in [
                (1.0, vec![0.0]),
                (2.0, vec![-0.5, 0.5]),
                (3.0, vec![-1.0, 0.0, 1.0]),
            ] {
                let least = least_of(&mut crests.iter().map(|n| cylinder(*n, x, y)));
                let drop = ridges(count).drop_at(x, y);
                assert!(
                    (drop - least).abs() < 1e-18,
                    "{count} at {x}, {y}: {drop}, {least}"
                );
            }
            let least = least_of(&mut (-20..=20).map(|n| cylinder(f64::from(n), x, y)));
            assert!((ridges(f64::INFINITY).drop_at(x, y) - least).abs() < 1e-18);
        }
        let key = ridges(2.5).check("shape").expect_err("refused").to_string();
        assert!(key.contains("ridges.count = 2.5"), "{key}");
    }

    #[test]
    fn a_ring_is_round_along_its_circle() {
        let ring = Shape::Ring {
            radius: 1e-3,
            R: 2e-3,
        };
        assert_eq!(ring.drop_at(1e-3, 0.0), 0.0);
        let (near, away) = (ring.drop_at(0.6e-3, 0.8e-3), ring.drop_at(0.0, 1.2e-3));
        assert!(near.abs() < 1e-30 && (away - 1e-5).abs() < 1e-18);
    }
}
