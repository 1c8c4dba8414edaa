//! The table of `fret life`: a line for each point.

use std::path::Path;

use contact_assess::{CriterionJudge, Judged};
use contact_core::Error;
use contact_subsurface::Line;
use fatigue::{Assessment, PointResult};

use super::options::Options;

/// Fails unless the table that is asked for is a .csv file.
pub(super) fn check(options: &Options) -> Result<(), Error> {
    let Some(out) = &options.out else {
        return Ok(());
    };
    let ending = out.extension().map(|e| e.to_string_lossy().to_lowercase());
    if ending.as_deref() != Some("csv") {
        return Err(Error::invalid(
            "--out",
            out.display(),
            "a table (.csv) of points; figures are drawn by pyfret.plot.criterion_map in Python, and the fields are \
             in result.life(..).dataset",
        ));
    }
    Ok(())
}

/// Writes value, margin and plane of every point of a section. Several criteria stand below each other,
/// with a column each for the criterion and the unit of its value.
pub(super) fn write(
    out: &Path,
    names: &[String],
    judged: &[Judged<PointResult>],
    of: &[CriterionJudge],
) -> Result<(), Error> {
    let text = if let ([judged], [of]) = (judged, of) {
        let of_value = match value_unit(of) {
            "1" => String::new(),
            unit => format!(" [{unit}]"),
        };
        let values = format!("value{of_value},missed{of_value},{}", margin_column(of));
        let rows = rows(judged, of, |f, margin| {
            format!("{:e},{:e},{margin:e}", f.value, f.missed)
        });
        format!("{}\n{}", titles(&judged.line, &values), rows.join("\n"))
    } else {
        let mut lines = Vec::new();
        for (name, (judged, of)) in names.iter().zip(judged.iter().zip(of)) {
            let (unit, lives) = (value_unit(of), margin_column(of) == LIFE);
            if lines.is_empty() {
                let values = format!("value,missed,unit,{LIFE},{FACTOR}");
                lines.push(format!("criterion,{}", titles(&judged.line, &values)));
            }
            let rows = rows(judged, of, |f, margin| {
                let (before, after) = if lives { ("", ",") } else { (",", "") };
                format!(
                    "{:e},{:e},{unit},{before}{margin:e}{after}",
                    f.value, f.missed
                )
            });
            lines.extend(rows.iter().map(|row| format!("{name},{row}")));
        }
        lines.join("\n")
    };
    std::fs::write(out, text + "\n").map_err(|e| Error::File {
        path: out.display().to_string(),
        message: e.to_string(),
    })
}

const LIFE: &str = "life [cycles]";
const FACTOR: &str = "safety_factor";

/// The column of the margin of a criterion.
fn margin_column(of: &CriterionJudge) -> &'static str {
    let mut judged = of.assessments.iter().flatten();
    if judged.any(Assessment::gives_lives) {
        LIFE
    } else {
        FACTOR
    }
}

/// Unit of the value of a criterion.
fn value_unit(of: &CriterionJudge) -> &'static str {
    let judged = of.assessments.iter().flatten().next();
    judged.map_or("1", |assessment| assessment.criterion.unit())
}

/// Titles of a table, with `values` between the place and the plane.
fn titles(line: &Line, values: &str) -> String {
    let (axis, across) = if matches!(line, Line::AlongY(_)) {
        ("y", "x")
    } else {
        ("x", "y")
    };
    format!(
        "{axis} [m],{across} [m],z [m],layer,{values},normal_x,normal_y,normal_z,shear_amplitude [Pa],normal_max [Pa],normal_min [Pa]"
    )
}

/// Lines of the points, with value and margin by `values`.
fn rows(
    judged: &Judged<PointResult>,
    of: &CriterionJudge,
    values: impl Fn(&PointResult, f64) -> String,
) -> Vec<String> {
    let along_y = matches!(judged.line, Line::AlongY(_));
    let mut rows = Vec::new();
    for (depth, judgements) in judged.depths.iter().zip(&judged.judgements) {
        let (Some(judgements), Some(assessment)) = (judgements, of.assessment(depth.layer)) else {
            continue;
        };
        for (s, f) in judged.along.iter().zip(judgements) {
            let [n_x, n_y, n_z] = f.normal;
            let (x, y) = judged.line.place(*s);
            let (s, place) = if along_y { (y, x) } else { (x, y) };
            rows.push(format!(
                "{s:e},{place:e},{:e},{},{},{n_x},{n_y},{n_z},{:e},{:e},{:e}",
                depth.z,
                depth.layer,
                values(f, assessment.margin(f.value)),
                f.shear_amplitude,
                f.normal_max,
                f.normal_min
            ));
        }
    }
    rows
}
