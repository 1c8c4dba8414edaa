//! Stress intensity of cracks below a contact, over the states of a cycle.
//!
//! The stress of the body without the crack is asked for along the crack's line once for all
//! lengths; the crate [`fracture`] does the rest. Plane strain in the plane of the crack.

mod along;
mod grown;
mod intensity;
mod prepared;

use fracture::{Crack, Path};
use rayon::prelude::*;

use self::along::STEP;
pub use self::grown::{Grown, Growth, direction_named, grown};
use self::intensity::{NEAREST, QUADRATURE, Stressed, on_line, range_on_line};
pub use self::intensity::{OverCycle, to_core_error};
use self::prepared::Cells;
pub use self::prepared::Prepared;
use contact_core::Error;

/// Cracks from one place, of several lengths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cracks {
    /// Place of the mouth along x, or along the plane of the cracks \[m\].
    pub x: f64,
    /// Angle from the inward normal, positive towards +x \[rad\] (default 0).
    pub angle: f64,
    /// Length \[m\] after which cracks go on at another angle \[rad\] (default: they are straight).
    pub kink: Option<(f64, f64)>,
    /// Angle of the plane of the cracks about the axis of depth, from the x axis \[rad\] (default 0);
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
    /// The path of the longest of the cracks.
    fn path(&self, longest: f64) -> Path {
        match self.kink {
            Some((first, angle)) if first < longest => {
                let legs = [(first, self.angle), (longest - first, angle)];
                Path::kinked(self.x, &legs)
            }
            _ => Path::straight(self.x, longest, self.angle),
        }
    }

    /// The shortest and the longest length \[m\]; fails at lengths that no crack has.
    fn check_lengths(&self) -> Result<[f64; 2], Error> {
        let longest = self.lengths.iter().copied().fold(0.0, f64::max);
        let shortest = self.lengths.iter().copied().fold(f64::INFINITY, f64::min);
        if self.lengths.is_empty() || !(shortest > 0.0 && longest.is_finite()) {
            let found = format!("{:?}", self.lengths);
            return Err(Error::invalid("lengths of the crack", found, "above 0 m"));
        }
        if let Some((first, _)) = self.kink
            && !(first > 0.0 && first.is_finite())
        {
            let key = "length of the crack to its kink";
            return Err(Error::invalid(key, first, "above 0 m"));
        }
        Ok([shortest, longest])
    }
}

/// Computes K of the cracks below a contact under each of its states, one length after the other. If the place
/// of the mouth is off by `mouth_error` \[m\], the change of K by it is part of the error.
///
/// K belongs to a crack in a homogeneous half-plane under the stress of the layered body. Where
/// layers differ, the error includes the change of K of published partial cracks in films.
pub fn over_cycle(
    contact: &Prepared,
    cracks: &Cracks,
    mouth_error: Option<f64>,
) -> Result<Vec<OverCycle>, Error> {
    let [shortest, longest] = cracks.check_lengths()?;
    let path = cracks.path(longest);
    // Straight ones are alike.
    let unit = Path::straight(cracks.x, longest, cracks.angle);
    let unit = Crack::with_step(unit, QUADRATURE).map_err(to_core_error)?;
    let mut along =
        contact.stress_in_plane((cracks.azimuth, cracks.offset), NEAREST * shortest, STEP)?;
    let stressed = Stressed::new(&mut along, &path, mouth_error)?;
    let at_length = |length: &f64| {
        let part = path.up_to(*length);
        let crack = if part.legs.len() > 1 {
            Crack::with_step(part, QUADRATURE)
        } else {
            unit.similar(cracks.x, *length)
        };
        let crack = crack
            .map_err(to_core_error)?
            .with_interfaces(&contact.breaks);
        on_line(&contact.body, &stressed, &crack, cracks.friction)
    };
    cracks.lengths.par_iter().map(at_length).collect()
}

/// Step of ln(distance from the mouth) between samples of cracks that are compared.
const COMPARED_STEP: f64 = 0.45;
/// Cracks whose range of K on cells twice as large, with faces that may pass through each other, is
/// below this part of the largest are not compared.
const COMPARED: f64 = 0.8;

/// The number of the crack with the largest range of K_I over the states, at any of its lengths.
/// Cracks differ in their place. Those that are far from the largest are sorted out by the tractions on
/// cells twice as large.
pub fn widest_range(contact: &Prepared, cracks: &[Cracks]) -> Result<usize, Error> {
    let mut compared: Vec<usize> = (0..cracks.len()).collect();
    if cracks.len() > 2 {
        let ranges = compared
            .iter()
            .map(|n| range_of(contact, &cracks[*n], Cells::Doubled(0), false));
        let ranges = ranges.collect::<Result<Vec<f64>, _>>()?;
        let largest = ranges.iter().copied().fold(0.0, f64::max);
        compared.retain(|n| ranges[*n] >= COMPARED * largest);
    }
    let mut widest = (compared.first().copied().unwrap_or(0), f64::NEG_INFINITY);
    if compared.len() > 1 {
        for n in compared {
            let range = range_of(contact, &cracks[n], Cells::Grid, true)?;
            if range > widest.1 {
                widest = (n, range);
            }
        }
    }
    Ok(widest.0)
}

/// The largest range of K_I over the states, at any of the lengths, by the tractions on `cells`; `touch` if
/// faces touch.
fn range_of(contact: &Prepared, cracks: &Cracks, cells: Cells, touch: bool) -> Result<f64, Error> {
    let [shortest, longest] = cracks.check_lengths()?;
    let path = cracks.path(longest);
    let unit = Crack::with_step(path.clone(), QUADRATURE).map_err(to_core_error)?;
    let plane = (cracks.azimuth, cracks.offset);
    let mut along = contact.stress_in_plane(plane, NEAREST * shortest, COMPARED_STEP)?;
    let line = along.sample_path(&path, cells)?;
    let at_length = |length: &f64| {
        let crack = unit.similar(cracks.x, *length).map_err(to_core_error)?;
        let crack = crack.with_interfaces(&contact.breaks);
        range_on_line(&line, &crack, touch.then_some(cracks.friction))
    };
    let ranges: Vec<f64> = cracks
        .lengths
        .par_iter()
        .map(at_length)
        .collect::<Result<_, _>>()?;
    Ok(ranges.into_iter().fold(0.0, f64::max))
}
