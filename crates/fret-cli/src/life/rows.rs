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
use crate::json::{missing, number, or_missing};
use crate::units::{mega, um};

/// Reasons why there is no plane, no mean, and no range of the distance.
const NO_PLANE: &str = "the criterion has no plane";
const NO_MEAN: &str = "no mean over a distance";
const GIVEN: &str = "the distance was given";

/// The line of a layer.
#[derive(Clone)]
pub(super) struct Row {
    pub(super) line: String,
    pub(super) json: Value,
    pub(super) notes: Vec<String>,
    /// True if the value belongs to a point on the rim of the contact.
    pub(super) at_rim: bool,
    /// True if no other layer has less margin.
    pub(super) decides: bool,
}

/// A layer with its worst point of all sections, and its range.
struct Layer<'a> {
    /// Name of the layer.
    name: String,
    worst: WorstPoint<PointResult>,
    line: Line,
    of: &'a Assessment,
    range: MarginRange,
}

/// The body, its sections and materials, and the options.
pub(super) struct LayerAssessor<'a> {
    pub(super) options: &'a Options,
    pub(super) site: &'a Site<'a>,
    pub(super) lines: &'a [Line],
    pub(super) body: &'a Body,
    pub(super) materials: &'a [Option<Material>],
}

impl LayerAssessor<'_> {
    /// Returns a line for every layer with a material; the one with the least margin is marked.
    pub(super) fn rows_of_layers(
        &self,
        sections: &[&Judged<PointResult>],
        judge: &CriterionJudge,
    ) -> Result<Vec<Row>, Error> {
        let mut layers = Vec::new();
        for layer in 0..=self.body.coatings.len() {
            layers.extend(self.assess_layer(sections, judge, layer)?);
        }
        let margin = |layer: &Layer<'_>| layer.of.uncapped_margin(layer.worst.extremum.value);
        let least = layers
            .iter()
            .map(margin)
            .fold(
                f64::INFINITY,
                |least, margin| if margin < least { margin } else { least },
            );
        let row = |layer: &Layer<'_>| layer.point_row(!(margin(layer) > least));
        Ok(layers.iter().map(row).collect())
    }

    /// The line of the largest mean over the critical distance `length` \[m\].
    pub(super) fn row_of_mean(
        &self,
        sections: &[&Judged<PointResult>],
        judge: &CriterionJudge,
        length: f64,
    ) -> Result<Row, Error> {
        let layer = self.averaged_layer(judge)?;
        let (mean, line) = self.largest_mean_of_lines(judge, layer, length)?;
        let Some(layer_found) = self.assess_layer(sections, judge, layer)? else {
            let allowed = "a layer that has a depth";
            return Err(Error::invalid("--layer", layer, allowed));
        };
        Ok(layer_found.mean_row(&mean, line, self.options, length))
    }

    /// The layer in which the critical distance is measured: the one of `--layer`, else the outermost with a
    /// material.
    fn averaged_layer(&self, judge: &CriterionJudge) -> Result<usize, Error> {
        let outermost = judge.assessments.iter().position(Option::is_some);
        let layer = self.options.layer.or(outermost).unwrap_or_default();
        if judge.assessment(layer).is_none() {
            let allowed = "a layer that has a material";
            return Err(Error::invalid("--layer", layer, allowed));
        }
        Ok(layer)
    }

    /// Computes the means over a distance along the first line, at the depth of the top of their
    /// layer.
    pub(super) fn means_along_line(
        &self,
        judge: &CriterionJudge,
        length: f64,
    ) -> Result<Judged<PointResult>, Error> {
        let (layer, line) = (self.averaged_layer(judge)?, self.lines[0]);
        let means = judge_means(
            self.site,
            line,
            &self.critical_distance(layer, length),
            judge,
        )?;
        let places = line.places(self.site.grid).into_iter().zip(means);
        let (along, means) = places.filter_map(|(s, means)| Some((s, means?))).unzip();
        let above = self.body.coatings.iter().take(layer);
        let z = above.map(|coating| coating.thickness).sum();
        Ok(Judged {
            line,
            along,
            depths: vec![Depth { z, layer }],
            judgements: vec![Some(means)],
        })
    }

    /// Finds the worst point of a layer and its range; returns `None` if the layer is not assessed.
    fn assess_layer<'b>(
        &self,
        sections: &[&Judged<PointResult>],
        judge: &'b CriterionJudge,
        layer: usize,
    ) -> Result<Option<Layer<'b>>, Error> {
        let Some(assessment) = judge.assessment(layer) else {
            return Ok(None);
        };
        let mut worst_so_far: Option<(WorstPoint<PointResult>, Line)> = None;
        for judged in sections {
            let candidate = find_worst_point(self.site, judged, judge, layer)?;
            if let Some(worst) = candidate
                && worst_so_far.is_none_or(|(known, _)| worst.extremum.value > known.extremum.value)
            {
                worst_so_far = Some((worst, judged.line));
            }
        }
        let Some((worst, line)) = worst_so_far else {
            return Ok(None);
        };
        let options = RangeOptions {
            scatter: self.options.scatter,
            length: self.options.distance,
            half_width: half_width(self.site.cycle, self.site.grid, self.lines[0])?,
        };
        let at = (worst.extremum.value, worst.extremum.error.sum());
        let mean = |length: f64, with_error: bool| {
            let (mean, line) = match self.largest_mean_of_lines(judge, layer, length) {
                Ok(worst_so_far) => worst_so_far,
                Err(stopped @ Error::Interrupted { .. }) => return Err(stopped),
                Err(refused) => return Ok(Err(refused)),
            };
            let error = if with_error {
                let distance = self.critical_distance(layer, length);
                error_of_largest_mean(self.site, line, &distance, judge, mean.value)?
            } else {
                0.0
            };
            Ok(Ok((mean.value, error)))
        };
        let material = self.materials.get(layer).and_then(Option::as_ref);
        let range = margin_range(assessment, material, at, &options, mean)?;
        Ok(Some(Layer {
            name: self.body.layer_name(layer),
            worst,
            line,
            of: assessment,
            range,
        }))
    }

    /// The critical distance in a layer, with the chosen region.
    fn critical_distance(&self, layer: usize, length: f64) -> Distance {
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
    fn largest_mean_of_lines(
        &self,
        judge: &CriterionJudge,
        layer: usize,
        length: f64,
    ) -> Result<(LargestMean, Line), Error> {
        let distance = self.critical_distance(layer, length);
        let mut best: Option<(LargestMean, Line)> = None;
        for line in self.lines {
            let candidate = largest_mean(self.site, *line, &distance, judge)?;
            if let Some(candidate) = candidate
                && best.is_none_or(|(known, _)| candidate.value > known.value)
            {
                best = Some((candidate, *line));
            }
        }
        best.ok_or_else(|| {
            let allowed = "so short that the mean stays above the grid";
            Error::invalid("--distance", length, allowed)
        })
    }
}

impl Layer<'_> {
    /// "life" or "safety factor".
    fn margin_name(&self) -> &'static str {
        if self.of.gives_lives() {
            "life"
        } else {
            "safety_factor"
        }
    }

    /// The range and the worst point.
    fn point_row(&self, decides: bool) -> Row {
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
        let mut json = self.range_to_json();
        let object = json!({
            self.margin_name(): self.margin_to_json(point.best), "at_point": [self.margin_to_json(point.low), self.margin_to_json(point.high)],
            "value": number(extreme.value), "error": number(error), "error_x": number(extreme.error.x),
            "error_y": number(extreme.error.y), "error_z": number(extreme.error.z),
            "error_tractions": or_missing(json!(extreme.error.tractions.map(number)), "not computed"), "x": extreme.x, "y": extreme.y,
            "z": extreme.depth.z, "at": or_missing(json!(at), "on no border"), "normal": or_missing(json!(normal), NO_PLANE),
            "inclination": angle.map_or_else(|| missing(NO_PLANE), number),
            "decides": decides,
        });
        merge(&mut json, object);
        let least = if decides {
            ", the least of this body"
        } else {
            ""
        };
        // One margin in a line: the margin of the mean replaces the margin of the point.
        let over = self.range.length.map_or_else(
            || format!("{}: {}{least} at a point", self.name, self.describe_range()),
            |length| {
                format!(
                    "{}: {} of the mean over L = {}\n{}, worst point: {}, 10 to 90 %{least}",
                    self.name,
                    self.describe_range(),
                    um(length),
                    self.name,
                    describe_margin(&point, self.of)
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
            let angle_text = degrees(angle);
            let _ = write!(line, ", plane {angle_text} from the surface normal");
        }
        if let Some(at) = at {
            let _ = write!(line, ", at the {at}");
        }
        Row {
            line,
            json,
            notes: self.range.notes.clone(),
            at_rim: extreme.at == Some(Zone::Contact) && self.range.length.is_none(),
            decides,
        }
    }

    /// The line of the largest mean over `length` \[m\] along a line: margin, range, place.
    fn mean_row(&self, mean: &LargestMean, along: Line, options: &Options, length: f64) -> Row {
        let (criterion, unit) = (self.of.criterion.name(), self.of.criterion.unit());
        let axis = along.name();
        let mut json = self.range_to_json();
        let object = json!({
            self.margin_name(): self.margin_to_json(self.of.margin(mean.value)), "value": mean.value,
            "method": options.method, axis: mean.place,
        });
        merge(&mut json, object);
        let line = format!(
            "{}: {} of the mean over L = {} ({} method), limited by {criterion} = {} at {axis} = {}",
            self.name,
            self.describe_range(),
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
            decides: true,
        }
    }

    /// A margin for programs, with the reason why it is infinite.
    fn margin_to_json(&self, margin: f64) -> Value {
        let why = match (self.of.gives_lives(), self.range.point.low.is_infinite()) {
            (false, _) => "infinite: the stress does no damage".to_owned(),
            (true, true) => "endless: the stress does no damage".to_owned(),
            (true, false) => format!("beyond {LONGEST:e} cycles, where the curve has no tests"),
        };
        if margin.is_infinite() {
            missing(&why)
        } else {
            number(margin)
        }
    }

    /// The range in words.
    fn describe_range(&self) -> String {
        format!(
            "{}, 10 to 90 %",
            describe_margin(&self.range.range.range, self.of)
        )
    }

    /// The range of 10 to 90 % as JSON.
    fn range_to_json(&self) -> Value {
        let Range { low, best, high } = self.range.range.range;
        let three = |range: Range| [range.low, range.best, range.high].map(number);
        let no_range = if self.range.length.is_some() {
            GIVEN
        } else {
            NO_MEAN
        };
        json!({
            "layer": self.worst.extremum.depth.layer, "criterion": self.of.criterion.name(),
            "unit": self.of.criterion.unit(), "low": self.margin_to_json(low), "best": self.margin_to_json(best), "high": self.margin_to_json(high),
            "of_stress": three(self.range.range.stress), "of_material": self.range.range.material,
            "of_distance": or_missing(json!(self.range.range.distance.map(three)), no_range),
            "L": or_missing(json!(self.range.length), NO_MEAN),
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
fn describe_margin(range: &Range, assessment: &Assessment) -> String {
    let Range { low, best, high } = *range;
    let text = with_range(best, [low, high]);
    match assessment.gives_lives() {
        true if low.is_infinite() => "endless life".into(),
        true => format!("life {text} cycles"),
        false => format!("safety factor {text}"),
    }
}
