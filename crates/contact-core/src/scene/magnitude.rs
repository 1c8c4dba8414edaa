//! Magnitudes that double precision carries through a solution.
//!
//! Numbers of a scene meet in products of up to four (an area times a modulus, a square of a length
//! over a radius), squared again where sums of squares are taken; between 1e-75 and 1e75 none of
//! them leaves the range of a double, 1e-308 to 1e308, unless they conspire, and the approach that
//! they result in is looked at too.

use super::shape::Range;
use super::{Body, RigidMotion, Scene, Shape};
use crate::error::Error;

const SMALLEST: f64 = 1e-75;
const LARGEST: f64 = 1e75;

impl Scene {
    /// Fails at the first number that is so small or so large that nothing could be computed from
    /// it. Zero is a number like others here, and so is infinity, which stands for no number.
    pub(crate) fn check_magnitudes(&self) -> Result<(), Error> {
        for (key, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            check_body(key, body)?;
        }
        for (key, value) in [
            ("friction.mu", self.friction.mu),
            ("grid.dx", self.grid.dx),
            ("grid.dy", self.grid.dy),
        ] {
            within(SMALLEST, key, value)?;
        }
        for (i, branch) in self.path.branches.iter().enumerate() {
            within(SMALLEST, &format!("path[{i}].W"), branch.to.W)?;
            for motion in RigidMotion::ALL {
                let prescribed = branch.to.prescribed(motion);
                let key = format!("path[{i}].{}", prescribed.name(motion));
                within(0.0, &key, prescribed.value())?;
            }
        }
        Ok(())
    }

    /// The same of what they result in.
    pub(super) fn check_yardsticks(&self) -> Result<(), Error> {
        let approach = self.approach();
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

fn check_body(key: &str, body: &Body) -> Result<(), Error> {
    within(SMALLEST, &format!("{key}.E"), body.substrate.E)?;
    for (i, coating) in body.coatings.iter().enumerate() {
        let key = format!("{key}.coatings[{i}]");
        within(SMALLEST, &format!("{key}.E"), coating.material.E)?;
        within(SMALLEST, &format!("{key}.thickness"), coating.thickness)?;
    }
    check_shape(&format!("{key}.shape"), &body.shape)
}

fn check_shape(key: &str, shape: &Shape) -> Result<(), Error> {
    for (name, value, range) in shape.parameters() {
        let smallest = if range == Range::Any { 0.0 } else { SMALLEST };
        within(smallest, &format!("{key}.{name}"), value)?;
    }
    match shape {
        Shape::HeightMap(map) => {
            let key = format!("{key}.height_map");
            within(SMALLEST, &format!("{key}.spacing"), map.spacing.0)?;
            within(SMALLEST, &format!("{key}.spacing"), map.spacing.1)?;
            let highest = map.values.iter().fold(0.0, |m: f64, z| m.max(z.abs()));
            within(0.0, &format!("{key}.z"), highest)
        }
        Shape::Rough(rough) => {
            let key = format!("{key}.rough");
            within(0.0, &format!("{key}.rms"), rough.rms)?;
            within(SMALLEST, &format!("{key}.shortest"), rough.shortest)?;
            within(SMALLEST, &format!("{key}.longest"), rough.longest)
        }
        Shape::Sum(parts) => (parts.iter().enumerate())
            .try_for_each(|(i, part)| check_shape(&format!("{key}.sum[{i}]"), part)),
        _ => Ok(()),
    }
}

fn within(smallest: f64, key: &str, value: f64) -> Result<(), Error> {
    let size = value.abs();
    if size == 0.0 || size == f64::INFINITY || (smallest..=LARGEST).contains(&size) {
        return Ok(());
    }
    let value = format!("{value:e}");
    let allowed = format!("0 or of a size from {smallest:e} to {LARGEST:e}");
    Err(Error::invalid(key, value, allowed))
}
