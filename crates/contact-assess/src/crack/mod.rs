//! Stress intensity of cracks below a contact, over the states of a cycle.
//!
//! The stress of the body without the crack is asked for along the crack's line once for all
//! lengths; the crate [`fracture`] does the rest. Plane strain in the plane of the crack.

mod along;
mod grown;
mod intensity;

use fracture::{Crack, Path};
use rayon::prelude::*;

pub use self::grown::{Grown, Growth, direction_named, grown};
pub use self::intensity::{Below, OverCycle, refused};
use self::intensity::{NEAREST, QUADRATURE, on_line};
use contact_core::Error;
use contact_subsurface::States;

/// Cracks from one place, of several lengths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cracks {
    /// Place of the mouth along x, or along the plane of the cracks \[m\].
    pub x: f64,
    /// Angle from the inward normal, positive towards +x \[rad\] (default 0).
    pub angle: f64,
    /// Length \[m\] after which cracks go on at another angle \[rad\] (default: they are straight).
    pub kink: Option<(f64, f64)>,
    /// Angle of the plane of the cracks about the axis of depth from that of x \[rad\] (default 0);
    /// x is the distance from the axis along it.
    pub azimuth: f64,
    /// Distance of that plane from the axis of depth, to the left of its direction \[m\] (default 0).
    pub offset: f64,
    /// Lengths \[m\], ascending.
    pub lengths: Vec<f64>,
    /// Coefficient of friction between the faces (default 0).
    pub friction: f64,
}

impl Cracks {
    /// The longest of the cracks.
    fn path(&self, longest: f64) -> Path {
        match self.kink {
            Some((first, angle)) if first < longest => {
                let legs = [(first, self.angle), (longest - first, angle)];
                Path::kinked(self.x, &legs)
            }
            _ => Path::straight(self.x, longest, self.angle),
        }
    }
}

/// K of the cracks below a contact under each of the states, one length after the other.
///
/// K is that of a crack in a homogeneous half-plane under the stress of the layered body. Where
/// layers differ, the error includes the change of K of published partial cracks in films.
pub fn over_cycle(
    below: &Below<'_>,
    states: &States<'_>,
    cracks: &Cracks,
) -> Result<Vec<OverCycle>, Error> {
    let longest = cracks.lengths.iter().copied().fold(0.0, f64::max);
    let shortest = cracks.lengths.iter().copied().fold(f64::INFINITY, f64::min);
    if cracks.lengths.is_empty() || !(shortest > 0.0 && longest.is_finite()) {
        let found = format!("{:?}", cracks.lengths);
        return Err(Error::invalid("lengths of the crack", found, "above 0 m"));
    }
    if let Some((first, _)) = cracks.kink
        && !(first > 0.0 && first.is_finite())
    {
        return Err(Error::invalid(
            "length of the crack to its kink",
            first,
            "above 0 m",
        ));
    }
    let path = cracks.path(longest);
    // Straight ones are alike.
    let unit = Path::straight(cracks.x, longest, cracks.angle);
    let unit = Crack::with_step(unit, QUADRATURE).map_err(refused)?;
    let line = below
        .along(states, (cracks.azimuth, cracks.offset), NEAREST * shortest)?
        .on(&path)?;
    let breaks = below.breaks(states);
    let of = |length: &f64| {
        let part = path.up_to(*length);
        let crack = if part.legs.len() > 1 {
            Crack::with_step(part, QUADRATURE)
        } else {
            unit.similar(cracks.x, *length)
        };
        let crack = crack.map_err(refused)?.with_interfaces(&breaks);
        on_line(below.body, &line, &crack, cracks.friction)
    };
    cracks.lengths.par_iter().map(of).collect()
}
