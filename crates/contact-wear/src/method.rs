//! The method of a run, by the stroke beside the size of a spot of the contact.
//!
//! A march keeps the worn surfaces in place: it holds for strokes that are small against each spot. Sliding takes
//! every cell to slip by the motion of the bodies: it holds for strokes that are large against the elastic
//! shift of the contact, `3 mu W (2 - nu)/(16 G a)` of balls, which is at most 1.5 mu times the approach
//! (R. D. Mindlin, J. Appl. Mech. 16 (1949) 259-268, nu = 1/2).

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_core::Error;
use contact_core::plan::Plan;
use contact_core::scene::{Branch, Scene};

use super::pressing::Pressing;
use super::settings::{Cycling, Wear};
use super::spots::half_width_in_cells;
use super::stroke::stroke;

/// Stroke over the half-width of a spot up to which a march keeps the worn surfaces where they are, and from
/// which on it is refused.
const SHORT: f64 = 0.2;
const LONG: f64 = 1.0;
/// Elastic shift of the contact over mu times the approach, at most, and stroke over it of gross slip.
const ELASTIC: f64 = 1.5;
const GROSS: f64 = 2.0;

/// The method of a run, and why.
pub(crate) struct Method {
    pub(crate) cycling: Cycling,
    /// The method, in a sentence; empty without a given shift.
    pub(crate) note: String,
    /// A doubt about it.
    pub(crate) doubt: Option<String>,
    /// Half-width along x of the spots of the first contact \[m\]; `None` where it was not needed.
    pub(crate) half_width: Option<f64>,
}

impl Method {
    /// The method that is given, or the one that suits the stroke of the cycle.
    pub(crate) fn new(
        scene: &Scene,
        wear: &Wear,
        first_branch: usize,
        stop: &Arc<AtomicBool>,
    ) -> Result<Self, Error> {
        let corners = stroke(scene, first_branch);
        let amplitude = match &corners {
            Ok((_, corners)) => half_range(corners.iter().map(|[_, d, _]| *d)),
            Err(_) => given_amplitude(&scene.path.branches[first_branch - 1..]),
        };
        let plain = |cycling| Self {
            cycling,
            note: String::new(),
            doubt: None,
            half_width: None,
        };
        if amplitude == 0.0 {
            return Ok(plain(match wear.cycling {
                Cycling::Sliding => Cycling::Sliding,
                Cycling::Auto | Cycling::March => Cycling::March,
            }));
        }
        let half_width = half_width(scene, stop)?;
        let ratio = amplitude / half_width;
        let size = format!(
            "the stroke of +-{amplitude:.3e} m is {ratio:.2} of the half-width of the spots, {half_width:.3e} m (lower quartile by load)"
        );
        let slides = amplitude > GROSS * ELASTIC * scene.friction.mu * scene.reference_approach();
        let chosen = match (wear.cycling, &corners) {
            // Sliding passes all branches of a cycle equally often.
            (Cycling::Auto, Ok(_)) if ratio > SHORT && slides && wear.branch_counts.is_empty() => {
                Cycling::Sliding
            }
            (Cycling::Auto, _) => Cycling::March,
            (given, _) => given,
        };
        let reason = |error: &Error| match error {
            Error::InvalidScene { key, value, .. } => format!("{key} = {value}"),
            error => error.to_string(),
        };
        let instead = match &corners {
            Ok(_) => "\"sliding\", which moves the worn surfaces".to_owned(),
            Err(error) => format!(
                "\"sliding\", which moves the worn surfaces and does not take this scene ({})",
                reason(error)
            ),
        };
        if chosen == Cycling::March && ratio > LONG && slides {
            let value = format!("\"march\", which keeps the worn surfaces in place, where {size}");
            return Err(Error::invalid("wear.cycling", value, instead));
        }
        let doubt = (chosen == Cycling::March && ratio > SHORT).then(|| {
            format!(
                "wear.cycling = \"march\" keeps the worn surfaces in place: {size}, and the depth is too large by up to \
                 some {:.0} %. Use {instead}",
                100.0 * ratio
            )
        });
        let name = if chosen == Cycling::Sliding {
            "sliding"
        } else {
            "march"
        };
        Ok(Self {
            cycling: chosen,
            note: format!("cycling = \"{name}\": {size}"),
            doubt,
            half_width: Some(half_width),
        })
    }
}

/// Half the range of some numbers; 0 if there are none.
fn half_range(values: impl Iterator<Item = f64>) -> f64 {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    (0.5 * (high - low)).max(0.0)
}

/// Half the range of the larger shift that branches give \[m\].
fn given_amplitude(branches: &[Branch]) -> f64 {
    let along = |k: usize| half_range(branches.iter().filter_map(move |b| b.to.given.motions()[k]));
    along(3).max(along(4))
}

/// Half-width along x of the spots of the contact on the unworn surfaces under the largest normal force \[m\]:
/// spots at most as wide bear a quarter of the load.
pub(crate) fn half_width(scene: &Scene, stop: &Arc<AtomicBool>) -> Result<f64, Error> {
    let W = scene.path.W_max();
    let dx = scene.grid.dx;
    if !(W > 0.0) {
        let (extent, _) = scene.grid.extent();
        return Ok(scene.hertz().map_or(0.25 * extent, |hertz| hertz.a));
    }
    let plan = Plan::new(scene);
    plan.check_memory(scene)?;
    let mut pressing = Pressing::new(scene, &plan, stop)?;
    let h = plan.mirror.fold(&scene.h_init());
    let lowest = h.iter().fold(f64::INFINITY, |m, h| m.min(*h));
    let approach = scene.reference_approach();
    let guess = |h: &f64| (1.0 - 2.0 * (h - lowest) / approach).max(0.0).sqrt();
    let mut p: Vec<f64> = h.iter().map(guess).collect();
    let drive = pressing.drive(W);
    pressing.solve(&h, &vec![0.0; h.len()], drive, &mut p, 10.0)?;
    let rows = pressing.rows();
    Ok(dx * half_width_in_cells(&p, rows))
}
