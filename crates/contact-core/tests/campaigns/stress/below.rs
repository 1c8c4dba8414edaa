//! What follows below a solved contact: largest stress, first yield and a criterion of a layer end
//! in numbers, none of them below a sample of its own section.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use contact_assess::{CriterionJudge, Judge, Site, YieldJudge, find_worst_point, judge};
use contact_core::Error;
use contact_core::march::Fields;
use contact_core::scene::{ResidualStress, Scene};
use contact_subsurface::{CycleSource, Moments};
use contact_subsurface::{Line, Side, default_depths};
use fatigue::{Material, Search};

/// Every so many scenes are looked at below.
const EVERY: u64 = 16;
/// Part of the largest sample by which the worst point may lie below it: rounding.
const ROUNDING: f64 = 1e-9;

/// The state at the end of a run and its mirror image in shear, as a cycle.
struct Reversed<'a>(&'a Fields);

impl CycleSource for Reversed<'_> {
    fn count(&self) -> usize {
        2
    }

    fn moments(&self, which: &[usize]) -> Result<Moments, Error> {
        let mut moments = Moments::default();
        for n in which {
            let sign = if *n == 0 { 1.0 } else { -1.0 };
            let shear = [&self.0.q_x, &self.0.q_y].map(|q| sign * q);
            let [q_x, q_y] = shear;
            moments.tractions.push([q_x, q_y, self.0.p.clone()]);
            moments.stick.push(self.0.stick.clone());
            moments.sigma_B.push(0.0);
        }
        Ok(moments)
    }

    fn start(&self) -> Result<Option<Moments>, Error> {
        Ok(None)
    }
}

/// Whether the scene of a seed is looked at below.
pub(crate) fn is_looked_at(seed: u64) -> bool {
    seed % EVERY == 5
}

/// Judges the section below the middle of a contact; what is wrong, in words.
pub(crate) fn judged(scene: &Scene, end: &Fields, stop: &Arc<AtomicBool>) -> Result<(), String> {
    let body = &scene.body2;
    if body.substrate.is_rigid() {
        return Ok(());
    }
    let cycle = Reversed(end);
    let site = Site {
        body,
        side: Side::Body2,
        grid: &scene.grid,
        residual: &ResidualStress::default(),
        cycle: &cycle,
        stop: stop.clone(),
        cache: Arc::default(),
    };
    let area = end.contact.iter().filter(|c| **c).count() as f64 * scene.grid.cell_area();
    let a = (area / std::f64::consts::PI).sqrt();
    let layers = body.coatings.len() + 1;
    let E = body.substrate.E;
    let of_yield = YieldJudge {
        s_y: vec![Some(1e-2 * E); layers],
        residual: ResidualStress::default(),
        safety_factor: |found| found.von_mises,
    };
    looked_at(&site, &of_yield, a)?;
    let strength = [("s_D", 1e-3 * E), ("t_D", 6e-4 * E)];
    let strength = strength.map(|(name, value)| (name.to_owned(), value, "made up".to_owned()));
    let material = Material::new("drawn", "drawn", strength).map_err(|e| e.to_string())?;
    let materials = vec![Some(material); layers];
    for name in ["findley", "crossland"] {
        let of = CriterionJudge::new(name, body, &materials, Search::default());
        looked_at(&site, &of.map_err(|e| e.to_string())?, a)?;
    }
    Ok(())
}

fn looked_at<J: Judge>(site: &Site<'_>, of: &J, a: f64) -> Result<(), String> {
    let told = |error: Error| format!("below: {error}");
    let depths = default_depths(site.body, a, 2.0 * a, 1.0).map_err(told)?;
    let line = Line::AlongX(0.0);
    let judged = judge(site, line, &depths, std::slice::from_ref(of)).map_err(told)?;
    let judged = &judged[0];
    for layer in 0..=site.body.coatings.len() {
        let here = judged.depths.iter().zip(&judged.judgements);
        let here = here.filter(|(depth, _)| depth.layer == layer);
        let scores: Vec<f64> = here
            .flat_map(|(_, found)| found.iter().flatten().map(|found| of.score(found)))
            .collect();
        if let Some(score) = scores.iter().find(|score| !score.is_finite()) {
            return Err(format!("below: a sample of layer {layer} is {score}"));
        }
        let sampled = scores.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let Some(worst) = find_worst_point(site, judged, of, layer).map_err(told)? else {
            continue;
        };
        let (value, error) = (worst.extremum.value, worst.extremum.error.sum());
        let below = value < sampled - ROUNDING * sampled.abs();
        if below || !value.is_finite() || !(error >= 0.0 && error.is_finite()) {
            return Err(format!(
                "below: the worst of layer {layer} is {value} +- {error}, a sample has {sampled}"
            ));
        }
    }
    Ok(())
}
