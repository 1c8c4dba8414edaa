//! Refusal of numbers outside the range of the arithmetic.

use super::shape::Range;
use super::{Body, Grid, RigidMotion, Scene, Shape};
use crate::error::Error;
use crate::magnitude::{LARGEST, SMALLEST, check_range};

impl Body {
    /// Checks a body that is used by itself as in a scene, except for its shape.
    pub fn check_alone(&self) -> Result<(), Error> {
        self.check("body")?;
        check_layers("body", self)
    }
}

impl Grid {
    /// Checks a grid that is used by itself as in a scene.
    pub fn check_alone(&self) -> Result<(), Error> {
        self.check()?;
        check_range(SMALLEST, "grid.dx", self.dx)?;
        check_range(SMALLEST, "grid.dy", self.dy)
    }
}

impl Scene {
    /// Fails at the first number that is so small or so large that nothing could be computed from
    /// it. Zero and infinity are allowed here.
    pub(crate) fn check_magnitudes(&self) -> Result<(), Error> {
        for (key, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            check_body(key, body)?;
        }
        self.friction.check_magnitudes()?;
        check_range(SMALLEST, "grid.dx", self.grid.dx)?;
        check_range(SMALLEST, "grid.dy", self.grid.dy)?;
        for (i, branch) in self.path.branches.iter().enumerate() {
            check_range(SMALLEST, &format!("path[{i}].W"), branch.to.W)?;
            for motion in RigidMotion::ALL {
                let prescribed = branch.to.prescribed(motion);
                let key = format!("path[{i}].{}", prescribed.name(motion));
                check_range(0.0, &key, prescribed.value())?;
            }
            for (name, value) in [
                ("sigma_B", branch.to.sigma_B),
                ("sigma_B1", branch.to.sigma_B1),
            ] {
                check_range(0.0, &format!("path[{i}].{name}"), value)?;
            }
        }
        Ok(())
    }

    /// Fails where the approach that follows from the numbers is out of range. The approach of a line contact is negative on
    /// a grid shorter than 0.3 of its half-width, on which it does not fit
    /// ([`Self::check_fit`]).
    pub(super) fn check_approach(&self) -> Result<(), Error> {
        let approach = self.reference_approach().abs();
        if approach == 0.0 || (SMALLEST..=LARGEST).contains(&approach) {
            return Ok(());
        }
        Err(Error::invalid(
            "path",
            format!("of loads whose approach is {approach:e} m"),
            format!("of loads whose approach is 0 or {SMALLEST:e} to {LARGEST:e} m"),
        ))
    }
}

/// Fails at a number of a body beyond the range of the arithmetic; `key` is the key of the body.
fn check_body(key: &str, body: &Body) -> Result<(), Error> {
    check_layers(key, body)?;
    check_shape(&format!("{key}.shape"), &body.shape)
}

/// Fails at a modulus or a thickness beyond the range of the arithmetic; `key` is the key of the body.
fn check_layers(key: &str, body: &Body) -> Result<(), Error> {
    check_range(SMALLEST, &format!("{key}.E"), body.substrate.E)?;
    for (i, coating) in body.coatings.iter().enumerate() {
        let key = format!("{key}.coatings[{i}]");
        check_range(SMALLEST, &format!("{key}.E"), coating.material.E)?;
        check_range(SMALLEST, &format!("{key}.thickness"), coating.thickness)?;
    }
    Ok(())
}

/// Fails at a number of a shape beyond the range of the arithmetic; `key` is the key of the shape.
fn check_shape(key: &str, shape: &Shape) -> Result<(), Error> {
    for (name, value, range) in shape.parameters() {
        let smallest = if range == Range::Any { 0.0 } else { SMALLEST };
        check_range(smallest, &format!("{key}.{name}"), value)?;
    }
    match shape {
        Shape::HeightMap(map) => {
            let key = format!("{key}.height_map");
            check_range(SMALLEST, &format!("{key}.spacing"), map.spacing.0)?;
            check_range(SMALLEST, &format!("{key}.spacing"), map.spacing.1)?;
            let highest = map.values.iter().fold(0.0, |m: f64, z| m.max(z.abs()));
            check_range(0.0, &format!("{key}.z"), highest)
        }
        Shape::Rough(rough) => {
            let key = format!("{key}.rough");
            check_range(0.0, &format!("{key}.rms"), rough.rms)?;
            check_range(SMALLEST, &format!("{key}.shortest"), rough.shortest)?;
            check_range(SMALLEST, &format!("{key}.longest"), rough.longest)
        }
        Shape::Sum(parts) => (parts.iter().enumerate())
            .try_for_each(|(i, part)| check_shape(&format!("{key}.sum[{i}]"), part)),
        _ => Ok(()),
    }
}
