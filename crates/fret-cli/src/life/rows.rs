//! The lines of `fret life`: the range of a layer, and its worst point or its largest mean.

use std::fmt::Write as _;

use contact_assess::{
    Averaging, CriterionJudge, Distance, Judged, LargestMean, MarginRange, RangeOptions, Site,
    WorstPoint, error_of_largest_mean, find_worst_point, inclination, judge_means, largest_mean,
    margin_range,
};
use contact_core::Error;
use contact_core::digits::{degrees, with_range};
use contact_core::scene::Body;
use contact_subsurface::{Depth, Line, Zone, half_width};
use fatigue::{Assessment, LONGEST, Material, PointResult, Range};
use serde_json::{Value, json};

use super::options::Options;
use crate::json::{absent, number, or_why};
use crate::units::{mega, um};

/// Why there is no plane, no mean, and no range of one.
const NO_PLANE: &str = "the criterion has no plane";
const NO_MEAN: &str = "no mean over a distance";
const GIVEN: &str = "the distance was given";

/// The line of a layer.
#[derive(Clone)]
pub(super) struct Row {
    pub(super) line: String,
    pub(super) json: Value,
    pub(super) notes: Vec<String>,
    /// Whether the value is that at a point on the rim of the contact.
    pub(super) at_rim: bool,
}

/// A layer that is judged: its worst point of all sections, and its range.
struct Layer<'a> {
    /// What it is called.
    called: String,
    worst: WorstPoint<PointResult>,
    line: Line,
    of: &'a Assessment,
    range: MarginRange,
}

/// What the layers of a body are judged by.
pub(super) struct Judging<'a> {
    pub(super) options: &'a Options,
    pub(super) site: &'a Site<'a>,
    pub(super) lines: &'a [Line],
    pub(super) body: &'a Body,
    pub(super) materials: &'a [Option<Material>],
}

impl Judging<'_> {
    /// A line for every layer that is judged, the one with the least margin marked.
    pub(super) fn points(
        &self,
        sections: &[&Judged<PointResult>],
        of: &CriterionJudge,
    ) -> Result<Vec<Row>, Error> {
        let mut all = Vec::new();
        for layer in 0..=self.body.coatings.len() {
            all.extend(self.layer(sections, of, layer)?);
        }
        let margin = |layer: &Layer<'_>| layer.of.uncapped_margin(layer.worst.extremum.value);
        let least =
            all.iter().map(margin).fold(
                f64::INFINITY,
                |least, margin| if margin < least { margin } else { least },
            );
        let row = |layer: &Layer<'_>| layer.point(!(margin(layer) > least));
        Ok(all.iter().map(row).collect())
    }

    /// The line of the mean over the distance of the options.
    pub(super) fn mean(
        &self,
        sections: &[&Judged<PointResult>],
        of: &CriterionJudge,
        length: f64,
    ) -> Result<Row, Error> {
        let layer = self.averaged(of)?;
        let (mean, line) = self.largest(of, layer, length)?;
        let Some(found) = self.layer(sections, of, layer)? else {
            let allowed = "a layer that has a depth";
            return Err(Error::invalid("--layer", layer, allowed));
        };
        Ok(found.mean(&mean, line, self.options, length))
    }

    /// The layer that the distance of the options lies in.
    fn averaged(&self, of: &CriterionJudge) -> Result<usize, Error> {
        let outermost = of.assessments.iter().position(Option::is_some);
        let layer = self.options.layer.or(outermost).unwrap_or_default();
        if of.assessment(layer).is_none() {
            let allowed = "a layer that has a material";
            return Err(Error::invalid("--layer", layer, allowed));
        }
        Ok(layer)
    }

    /// The means over a distance along the first line, at the depth of the top of their layer.
    pub(super) fn means(
        &self,
        of: &CriterionJudge,
        length: f64,
    ) -> Result<Judged<PointResult>, Error> {
        let (layer, line) = (self.averaged(of)?, self.lines[0]);
        let found = judge_means(self.site, line, &self.distance(layer, length), of)?;
        let places = line.places(self.site.grid).into_iter().zip(found);
        let (along, found) = places.filter_map(|(s, found)| Some((s, found?))).unzip();
        let above = self.body.coatings.iter().take(layer);
        let z = above.map(|coating| coating.thickness).sum();
        Ok(Judged {
            line,
            along,
            depths: vec![Depth { z, layer }],
            judgements: vec![Some(found)],
        })
    }

    /// The worst point of a layer and its range; `None` if the layer is not judged.
    fn layer<'b>(
        &self,
        sections: &[&Judged<PointResult>],
        of: &'b CriterionJudge,
        layer: usize,
    ) -> Result<Option<Layer<'b>>, Error> {
        let Some(assessment) = of.assessment(layer) else {
            return Ok(None);
        };
        let mut found: Option<(WorstPoint<PointResult>, Line)> = None;
        for judged in sections {
            let here = find_worst_point(self.site, judged, of, layer)?;
            if let Some(worst) = here
                && found.is_none_or(|(known, _)| worst.extremum.value > known.extremum.value)
            {
                found = Some((worst, judged.line));
            }
        }
        let Some((worst, line)) = found else {
            return Ok(None);
        };
        let options = RangeOptions {
            scatter: self.options.scatter,
            length: self.options.distance,
            half_width: half_width(self.site.cycle, self.site.grid, self.lines[0])?,
        };
        let at = (worst.extremum.value, worst.extremum.error.sum());
        let mean = |length: f64, with_error: bool| {
            let (mean, line) = match self.largest(of, layer, length) {
                Ok(found) => found,
                Err(stopped @ Error::Interrupted { .. }) => return Err(stopped),
                Err(refused) => return Ok(Err(refused)),
            };
            let error = if with_error {
                let distance = self.distance(layer, length);
                error_of_largest_mean(self.site, line, &distance, of, mean.value)?
            } else {
                0.0
            };
            Ok(Ok((mean.value, error)))
        };
        let material = self.materials.get(layer).and_then(Option::as_ref);
        let range = margin_range(assessment, material, at, &options, mean)?;
        Ok(Some(Layer {
            called: self.body.layer_name(layer),
            worst,
            line,
            of: assessment,
            range,
        }))
    }

    /// A distance in a layer, of the region that is asked for.
    fn distance(&self, layer: usize, length: f64) -> Distance {
        let named = Averaging::ALL
            .iter()
            .find(|(name, _)| *name == self.options.method);
        Distance {
            method: named.map_or(Averaging::Line, |(_, method)| *method),
            length,
            layer,
        }
    }

    /// The largest mean over a distance along all lines.
    fn largest(
        &self,
        of: &CriterionJudge,
        layer: usize,
        length: f64,
    ) -> Result<(LargestMean, Line), Error> {
        let distance = self.distance(layer, length);
        let mut most: Option<(LargestMean, Line)> = None;
        for line in self.lines {
            let found = largest_mean(self.site, *line, &distance, of)?;
            if let Some(found) = found
                && most.is_none_or(|(known, _)| found.value > known.value)
            {
                most = Some((found, *line));
            }
        }
        most.ok_or_else(|| {
            let allowed = "so short that the mean stays above the grid";
            Error::invalid("--distance", length, allowed)
        })
    }
}

impl Layer<'_> {
    fn name(&self) -> &'static str {
        if self.of.gives_lives() {
            "life"
        } else {
            "safety_factor"
        }
    }

    /// The range and the worst point.
    fn point(&self, decides: bool) -> Row {
        let extreme = &self.worst.extremum;
        let (criterion, unit) = (self.of.criterion.name(), self.of.criterion.unit());
        let normal = self.of.criterion.has_plane();
        let normal = normal.then_some(self.worst.judgement.normal);
        let angle = normal.map(|n| inclination(n, self.line).to_degrees());
        let at = extreme.at.map(|zone| match zone {
            Zone::Contact => "rim of the contact",
            Zone::Stick => "border of the stick zone",
        });
        let error = extreme.error.sum();
        let point = self.range.point;
        let mut json = self.json();
        let own = json!({
            self.name(): self.margin(point.best), "at_point": [self.margin(point.low), self.margin(point.high)],
            "value": number(extreme.value), "error": number(error), "error_x": number(extreme.error.x),
            "error_y": number(extreme.error.y), "error_z": number(extreme.error.z),
            "error_tractions": or_why(json!(extreme.error.tractions.map(number)), "not computed"), "x": extreme.x, "y": extreme.y,
            "z": extreme.depth.z, "at": or_why(json!(at), "on no border"), "normal": or_why(json!(normal), NO_PLANE),
            "inclination": angle.map_or_else(|| absent(NO_PLANE), number),
            "decides": decides,
        });
        merge(&mut json, own);
        let least = if decides {
            ", the least of this body"
        } else {
            ""
        };
        // One margin a line: that of the mean stands above that of the point.
        let over = self.range.length.map_or_else(
            || format!("{}: {}{least} at a point", self.called, self.told()),
            |length| {
                format!(
                    "{}: {} of the mean over L = {}\n{}, worst point: {}, 10 to 90 %{least}",
                    self.called,
                    self.told(),
                    um(length),
                    self.called,
                    said(&point, self.of)
                )
            },
        );
        let mut line = format!(
            "{over}, limited by {criterion} = {} +- {} at x = {}, y = {}, z = {}",
            mega(extreme.value, unit),
            mega(error, unit),
            um(extreme.x),
            um(extreme.y),
            um(extreme.depth.z)
        );
        if let Some(angle) = angle.filter(|angle| angle.is_finite()) {
            let told = degrees(angle);
            let _ = write!(line, ", plane {told} from the surface normal");
        }
        if let Some(at) = at {
            let _ = write!(line, ", at the {at}");
        }
        Row {
            line,
            json,
            notes: self.range.notes.clone(),
            at_rim: extreme.at == Some(Zone::Contact) && self.range.length.is_none(),
        }
    }

    /// The range and the largest mean.
    fn mean(&self, mean: &LargestMean, along: Line, options: &Options, length: f64) -> Row {
        let (criterion, unit) = (self.of.criterion.name(), self.of.criterion.unit());
        let axis = along.name();
        let mut json = self.json();
        let own = json!({
            self.name(): self.margin(self.of.margin(mean.value)), "value": mean.value,
            "method": options.method, axis: mean.place,
        });
        merge(&mut json, own);
        let line = format!(
            "{}: {} of the mean over L = {} ({} method), limited by {criterion} = {} at {axis} = {}",
            self.called,
            self.told(),
            um(length),
            options.method,
            mega(mean.value, unit),
            um(mean.place),
        );
        Row {
            line,
            json,
            notes: self.range.notes.clone(),
            at_rim: false,
        }
    }

    /// A margin for programs: why one is infinite.
    fn margin(&self, margin: f64) -> Value {
        let why = match (self.of.gives_lives(), self.range.point.low.is_infinite()) {
            (false, _) => "infinite: the stress does no damage".to_owned(),
            (true, true) => "endless: the stress does no damage".to_owned(),
            (true, false) => format!("beyond {LONGEST:e} cycles, where the curve has no tests"),
        };
        if margin.is_infinite() {
            absent(&why)
        } else {
            number(margin)
        }
    }

    /// The range in words.
    fn told(&self) -> String {
        format!("{}, 10 to 90 %", said(&self.range.range.range, self.of))
    }

    /// The range as numbers.
    fn json(&self) -> Value {
        let Range { low, best, high } = self.range.range.range;
        let three = |of: Range| [of.low, of.best, of.high].map(number);
        let no_range = if self.range.length.is_some() {
            GIVEN
        } else {
            NO_MEAN
        };
        json!({
            "layer": self.worst.extremum.depth.layer, "criterion": self.of.criterion.name(),
            "unit": self.of.criterion.unit(), "low": self.margin(low), "best": self.margin(best), "high": self.margin(high),
            "of_stress": three(self.range.range.stress), "of_material": self.range.range.material,
            "of_distance": or_why(json!(self.range.range.distance.map(three)), no_range),
            "L": or_why(json!(self.range.length), NO_MEAN),
        })
    }
}

/// Adds the entries of a table to another.
fn merge(table: &mut Value, other: Value) {
    if let (Value::Object(table), Value::Object(other)) = (table, other) {
        table.extend(other);
    }
}

/// A margin and its range in words.
fn said(range: &Range, of: &Assessment) -> String {
    let Range { low, best, high } = *range;
    let told = with_range(best, [low, high]);
    match of.gives_lives() {
        true if low.is_infinite() => "endless life".into(),
        true => format!("life {told} cycles"),
        false => format!("safety factor {told}"),
    }
}
