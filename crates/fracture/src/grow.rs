//! The path of a crack that chooses its direction.

use super::Error;
use super::crack::{Crack, Intensity};
use super::curve::Extremes;
use super::direction::Direction;
use super::friction::Faces;
use super::path::{Leg, Path};
use super::rule::step;
use super::stress::{PlaneStress, Point};

/// Turn at the tip below which a piece's end has its direction \[rad\].
const STRAIGHT: f64 = 2e-3;
/// Turn on the way beyond which the crack would not bend but kink \[rad\]: the direction jumps
/// where another instant or another mode takes the lead.
const SHARP: f64 = 0.5;
/// Corrections of a piece's end.
const CORRECTIONS: usize = 4;
/// Step of the quadrature that directions need: K to 1e-3 in closed cracks.
const COARSE: f64 = 0.2;
/// Most pieces of a path, and of one that ends early.
const MOST_PIECES: usize = 64;
const ENOUGH_PIECES: usize = 16;

/// How a crack grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growing {
    /// The criterion for the direction.
    pub direction: Direction,
    /// Length to grow to \[m\].
    pub to: f64,
    /// Coefficient of friction between the faces.
    pub friction: f64,
    /// Distance by which the tip may be off sideways, over the length grown (default 1e-2).
    pub tolerance: f64,
}

impl Default for Growing {
    /// The default direction, without friction, to a tolerance of 1 %; the length to grow to is 0.
    fn default() -> Self {
        Self {
            direction: Direction::default(),
            to: 0.0,
            friction: 0.0,
            tolerance: 1e-2,
        }
    }
}

/// A tip on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Tip {
    /// Place of the tip.
    pub at: Point,
    /// K over the cycle.
    pub cycle: Vec<Intensity>,
}

impl Tip {
    /// Largest and smallest K_I of the cycle.
    pub fn extremes(&self) -> Extremes {
        extremes(&self.cycle)
    }
}

/// Largest and smallest K_I of a cycle.
pub(crate) fn extremes(cycle: &[Intensity]) -> Extremes {
    let values = || cycle.iter().map(|k| k.K_I);
    Extremes {
        K_max: values().fold(f64::NEG_INFINITY, f64::max),
        K_min: values().fold(f64::INFINITY, f64::min),
    }
}

/// A grown crack.
#[derive(Clone, Debug, PartialEq)]
pub struct Grown {
    /// Its path.
    pub path: Path,
    /// The tips at the ends of its pieces, the first one's included.
    pub tips: Vec<Tip>,
    /// Distance between the tips of this path and of that with half of the pieces \[m\].
    pub error: f64,
    /// Why it ends.
    pub end: End,
}

/// Why a crack grows no further.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// It has the length to grow to.
    Reached,
    /// Nothing opens it any more.
    Closed,
    /// It comes back to the surface.
    Surface,
    /// Its direction jumps by more than 0.5 rad: another instant, or shear, takes the lead.
    Kinks,
}

/// K over a cycle with faces that touch: `stress` are the stresses at the crack's points of one
/// instant after the other.
pub(crate) fn cycle(
    crack: &Crack,
    friction: f64,
    stress: &[Vec<PlaneStress>],
) -> Result<Vec<Intensity>, Error> {
    let mut faces = Faces::new(crack, friction)?;
    let mut cycle = Vec::with_capacity(stress.len());
    for instant in stress {
        faces = faces.next(instant)?;
        cycle.push(faces.intensity);
    }
    Ok(cycle)
}

/// Grows a crack from `start` in the direction that its cycle asks for. `stress` gives the stress
/// of the body without the crack at a crack's points, one instant of the cycle after the other. It
/// jumps at the depths `interfaces` \[m\].
///
/// Pieces are curved so that at the end of each the crack has no reason to turn; their number is
/// doubled until the tip moves less than the tolerance. A crack ends early where nothing opens it,
/// where it comes back to the surface and where its direction jumps, which is known to a piece.
pub fn grow<E: From<Error>>(
    start: &Path,
    growing: &Growing,
    interfaces: &[f64],
    mut stress: impl FnMut(&Crack) -> Result<Vec<Vec<PlaneStress>>, E>,
) -> Result<Grown, E> {
    start.check()?;
    if !(growing.to > start.length() && growing.to.is_finite()) {
        let allowed = format!(
            "above the length of the first crack, {:.4e} m",
            start.length()
        );
        return Err(Error::invalid("length to grow to", growing.to, allowed).into());
    }
    if !(growing.tolerance > 0.0 && growing.tolerance < 1.0) {
        return Err(Error::invalid("tolerance", growing.tolerance, "above 0 and below 1").into());
    }
    let mut pieces = 4;
    let mut at_tip = |path: &Path| -> Result<Tip, E> {
        let crack = Crack::with_step(path.clone(), step(path).max(COARSE))?;
        let crack = crack.with_interfaces(interfaces);
        let stress = stress(&crack)?;
        Ok(Tip {
            at: path.tip(),
            cycle: cycle(&crack, growing.friction, &stress)?,
        })
    };
    let mut coarse = in_pieces(start, growing, pieces, &mut at_tip)?;
    loop {
        pieces *= 2;
        let mut fine = in_pieces(start, growing, pieces, &mut at_tip)?;
        let (a, b) = (coarse.path.tip(), fine.path.tip());
        fine.error = (a.x - b.x).hypot(a.z - b.z);
        let grown = fine.path.length() - start.length();
        if fine.error <= growing.tolerance * grown
            || pieces >= MOST_PIECES
            || (fine.end != End::Reached && pieces >= ENOUGH_PIECES)
        {
            return Ok(fine);
        }
        coarse = fine;
    }
}

/// Grows a crack in so many pieces; `at_tip` returns K and direction at a tip.
fn in_pieces<E: From<Error>>(
    start: &Path,
    growing: &Growing,
    pieces: usize,
    at_tip: &mut impl FnMut(&Path) -> Result<Tip, E>,
) -> Result<Grown, E> {
    let first = at_tip(start)?;
    let mut grown = Grown {
        path: start.clone(),
        tips: vec![first],
        error: f64::INFINITY,
        end: End::Reached,
    };
    let factor = (growing.to / start.length()).powf(1.0 / pieces as f64);
    for n in 0..pieces {
        let last = &grown.tips[grown.tips.len() - 1];
        let Some((turn, _)) = growing.direction.turn(&last.cycle) else {
            grown.end = End::Closed;
            return Ok(grown);
        };
        let length = grown.path.length() * (factor - 1.0);
        let from = last.at.angle;
        if n > 0 && turn.abs() > SHARP {
            grown.end = End::Kinks;
            return Ok(grown);
        }
        let kink = n == 0 && turn.abs() > STRAIGHT;
        let mut end = from + turn;
        let mut path = with_piece(&grown.path, kink, (length, end), end);
        if path.check().is_err() {
            grown.end = End::Surface;
            return Ok(grown);
        }
        let mut tip = at_tip(&path)?;
        for _ in 0..CORRECTIONS {
            let Some((more, _)) = growing.direction.turn(&tip.cycle) else {
                break;
            };
            if more.abs() <= STRAIGHT || more.abs() > SHARP {
                break;
            }
            let next = with_piece(&grown.path, kink, (length, end + more), from + turn);
            if next.check().is_err() {
                grown.end = End::Surface;
                return Ok(grown);
            }
            (end, path) = (end + more, next);
            tip = at_tip(&path)?;
        }
        grown.path = path;
        grown.tips.push(tip);
    }
    Ok(grown)
}

/// The path with one more curved piece (length, curvature), in a new leg if `kink`. The piece `begins` at this
/// length from the mouth.
fn with_piece(path: &Path, kink: bool, piece: (f64, f64), begins: f64) -> Path {
    let mut path = path.clone();
    if kink {
        path.legs.push(Leg {
            start: begins,
            pieces: vec![piece],
        });
    } else if let Some(leg) = path.legs.last_mut() {
        leg.pieces.push(piece);
    }
    path
}
