//! A crack that chooses its direction below a contact.

use contact_core::Error;
use fracture::{Crack, Direction, End, Growing, Path, PlaneStress, Point, grow};
use rayon::prelude::*;

use super::along::{Line, STEP};
use super::intensity::{NEAREST, OverCycle, QUADRATURE, Stressed, on_line, to_core_error};
use super::prepared::{Cells, Prepared};

/// How a crack grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Place of the mouth along x, or along the plane of the crack \[m\].
    pub x: f64,
    /// Angle of the first crack from the inward normal, positive towards +x \[rad\].
    pub angle: f64,
    /// Angle of the plane of the crack, about the axis of depth, from the x axis \[rad\].
    pub azimuth: f64,
    /// Distance of that plane from the axis of depth, to the left of its direction \[m\].
    pub offset: f64,
    /// Length of the first crack \[m\].
    pub start: f64,
    /// Rules for the direction, the length to grow to, the friction of the faces, the tolerance.
    pub growing: Growing,
}

/// A grown crack.
#[derive(Clone, Debug, PartialEq)]
pub struct Grown {
    /// Tips on the way, the first crack's first; x is along the plane of the crack.
    pub tips: Vec<Point>,
    /// K over the states with the tip at each.
    pub over: Vec<OverCycle>,
    /// Distance between the last tip and the tip of the path with half of the pieces \[m\].
    pub error: f64,
    /// Why it ends.
    pub end: End,
}

/// Error that ends the growth, of this crate or of the crack.
struct Refused(Error);

impl From<Error> for Refused {
    /// Wraps an error of the core.
    fn from(error: Error) -> Self {
        Self(error)
    }
}

impl From<fracture::Error> for Refused {
    /// Wraps an error of fracture as one of the core.
    fn from(error: fracture::Error) -> Self {
        Self(to_core_error(error))
    }
}

/// Grows a crack below a contact, in steps, in the direction of the largest range of the opening stress over
/// the states.
pub fn grown(contact: &Prepared, growth: &Growth) -> Result<Grown, Error> {
    let start = growth.start;
    if !(start > 0.0 && start.is_finite()) {
        return Err(Error::invalid(
            "length of the first crack",
            start,
            "above 0 m",
        ));
    }
    let plane = (growth.azimuth, growth.offset);
    let mut along = contact.stress_in_plane(plane, NEAREST * start, STEP)?;
    let stress = |crack: &Crack| -> Result<Vec<Vec<PlaneStress>>, Refused> {
        let line: Line = along.sample_path(crack.path(), Cells::Grid)?;
        let stencils = line.stencils(&crack.points());
        let of_state = |state| line.stress(state, &stencils);
        Ok((0..line.states()).map(of_state).collect())
    };
    let first = Path::straight(growth.x, start, growth.angle);
    let found =
        grow(&first, &growth.growing, &contact.breaks, stress).map_err(|Refused(error)| error)?;
    let stressed = Stressed::new(&mut along, &found.path, None)?;
    let of = |tip: &fracture::Tip| {
        let crack =
            Crack::with_step(found.path.up_to(tip.at.s), QUADRATURE).map_err(to_core_error)?;
        let crack = crack.with_interfaces(&contact.breaks);
        on_line(&contact.body, &stressed, &crack, growth.growing.friction)
    };
    let over = found
        .tips
        .par_iter()
        .map(of)
        .collect::<Result<_, Error>>()?;
    Ok(Grown {
        tips: found.tips.iter().map(|tip| tip.at).collect(),
        over,
        error: found.error,
        end: found.end,
    })
}

/// The rule of direction with this name; the error lists the names.
pub fn direction_named(name: &str) -> Result<Direction, Error> {
    match name {
        "tangential_stress" => Ok(Direction::TangentialStress),
        "opening_intensity" => Ok(Direction::OpeningIntensity),
        other => {
            let allowed = "tangential_stress or opening_intensity";
            Err(Error::invalid("direction", other, allowed))
        }
    }
}
