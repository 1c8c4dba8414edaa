//! The lines of `fret life`: a worst point of each layer, or a mean.

use crate::units::{mega, um};
use std::fmt::Write as _;

use contact_assess::{
    Averaging, ByCriterion, Distance, Judged, Site, Worst, average, inclination, worst,
};
use contact_core::Error;
use contact_core::digits::{short, with_range};
use contact_core::scene::Body;
use contact_subsurface::{Line, Zone};
use fatigue::{Assessment, AtPoint};
use serde_json::json;

use super::options::Options;

/// The lines of a layer.
#[derive(Clone)]
pub(super) struct Row {
    pub(super) line: String,
    pub(super) json: serde_json::Value,
    pub(super) at_rim: bool,
}

/// The worst point of every layer that is judged, of all sections, the one that decides marked.
pub(super) fn points(
    site: &Site<'_>,
    sections: &[&Judged<AtPoint>],
    of: &ByCriterion,
    body: &Body,
) -> Result<Vec<Row>, Error> {
    let mut all: Vec<(Worst<AtPoint>, &Assessment, Line)> = Vec::new();
    for layer in 0..=body.coatings.len() {
        let Some(assessment) = of.of(layer) else {
            continue;
        };
        let mut found: Option<(Worst<AtPoint>, Line)> = None;
        for judged in sections {
            let here = worst(site, judged, of, layer)?;
            if let Some(worst) = here
                && found.is_none_or(|(known, _)| worst.extreme.value > known.extreme.value)
            {
                found = Some((worst, judged.line));
            }
        }
        all.extend(found.map(|(worst, line)| (worst, assessment, line)));
    }
    let margin = |(w, a, _): &(Worst<AtPoint>, &Assessment, Line)| a.margin(w.extreme.value);
    let least =
        all.iter().map(margin).fold(
            f64::INFINITY,
            |least, margin| if margin < least { margin } else { least },
        );
    let rows = all.iter().map(|one| {
        let (w, a, line_of) = one;
        let margin = margin(one);
        let decides = !(margin > least);
        let name = if a.gives_lives() { "life" } else { "safety_factor" };
        let (criterion, unit) = (a.criterion.name(), a.criterion.unit());
        let normal = a.criterion.has_plane().then_some(w.found.normal);
        let angle = normal.map(|n| inclination(n, *line_of).to_degrees());
        let at = w.extreme.at.map(|zone| match zone {
            Zone::Contact => "rim of the contact",
            Zone::Stick => "border of the stick zone",
        });
        let error = w.extreme.error.sum();
        let [low, high] = a.range(w.extreme.value, error);
        let json = json!({
            "criterion": criterion, name: margin, "low": low, "high": high, "value": w.extreme.value, "unit": unit, "error": error,
            "error_x": w.extreme.error.x, "error_y": w.extreme.error.y, "error_z": w.extreme.error.z,
            "error_tractions": w.extreme.error.tractions, "x": w.extreme.x, "y": w.extreme.y, "z": w.extreme.depth.z,
            "layer": w.extreme.depth.layer, "at": at, "normal": normal, "inclination": angle,
            "decides": decides,
        });
        let mut line = format!(
            "layer {}: {}, {criterion} {} +- {} at x = {}, y = {}, z = {}",
            w.extreme.depth.layer,
            said(margin, [low, high], a),
            mega(w.extreme.value, unit),
            mega(error, unit),
            um(w.extreme.x),
            um(w.extreme.y),
            um(w.extreme.depth.z)
        );
        if let Some(angle) = angle.filter(|angle| angle.is_finite()) {
            let _ = write!(line, ", plane {angle:.1} degrees from the surface normal");
        }
        if let Some(at) = at {
            let _ = write!(line, ", at the {at}");
        }
        if decides {
            line.push_str(", decides");
        }
        let at_rim = w.extreme.at == Some(Zone::Contact);
        Row { line, json, at_rim }
    });
    Ok(rows.collect())
}

/// The worst place of a mean over a critical distance.
pub(super) fn mean(
    options: &Options,
    site: &Site<'_>,
    lines: &[Line],
    length: f64,
    of: &ByCriterion,
) -> Result<Row, Error> {
    let outermost = of
        .assessments
        .iter()
        .position(Option::is_some)
        .unwrap_or_default();
    let layer = options.layer.unwrap_or(outermost);
    let Some(assessment) = of.of(layer) else {
        let allowed = "a layer that has a material";
        return Err(Error::invalid("--layer", layer, allowed));
    };
    let named = Averaging::ALL
        .iter()
        .find(|(name, _)| *name == options.method);
    let method = named.map_or(Averaging::Line, |(_, method)| *method);
    let distance = Distance {
        method,
        length,
        layer,
    };
    let mut most: Option<(AtPoint, f64, Line)> = None;
    for line in lines {
        let found = average(site, *line, &distance, of)?;
        for (found, place) in found.into_iter().zip(line.places(site.grid)) {
            if let Some(found) = found
                && most.is_none_or(|(known, ..)| found.value > known.value)
            {
                most = Some((found, place, *line));
            }
        }
    }
    let Some((most, place, line)) = most else {
        let allowed = "so short that the mean stays above the grid";
        return Err(Error::invalid("--distance", length, allowed));
    };
    let margin = assessment.margin(most.value);
    let name = if assessment.gives_lives() {
        "life"
    } else {
        "safety_factor"
    };
    let axis = line.name();
    let (criterion, unit) = (assessment.criterion.name(), assessment.criterion.unit());
    let json = json!({
        "criterion": criterion, name: margin, "value": most.value, "unit": unit, "L": length,
        "method": options.method, axis: place, "layer": layer,
    });
    let line = format!(
        "layer {layer}: {}, {criterion} {} at {axis} = {}, {} method with L = {}",
        // The error of a mean is not known.
        said(margin, [f64::NAN; 2], assessment),
        mega(most.value, unit),
        um(place),
        options.method,
        um(length)
    );
    Ok(Row {
        line,
        json,
        at_rim: false,
    })
}

/// A margin and its range in words.
fn said(margin: f64, range: [f64; 2], of: &Assessment) -> String {
    match (of.gives_lives(), margin.is_finite()) {
        (true, true) => format!("{} cycles", with_range(margin, range)),
        (true, false) if range[0].is_finite() => {
            format!("endless life (at least {} cycles)", short(range[0]))
        }
        (true, false) => "endless life".into(),
        (false, _) => format!("safety factor {}", with_range(margin, range)),
    }
}
