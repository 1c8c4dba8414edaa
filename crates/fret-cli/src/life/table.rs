//! The table of `fret life`: a line of each point.

use std::fmt::Write as _;
use std::path::Path;

use contact_assess::{ByCriterion, Judged};
use contact_core::Error;
use contact_subsurface::Line;
use fatigue::{Assessment, AtPoint};

use super::options::Options;

pub(super) fn check(options: &Options) -> Result<(), Error> {
    let Some(out) = &options.out else {
        return Ok(());
    };
    if options.criterion.len() > 1 {
        let allowed = "one criterion, whose table it is";
        return Err(Error::invalid(
            "--criterion",
            options.criterion.join(","),
            allowed,
        ));
    }
    if let Some(length) = options.distance {
        let allowed = "left out with --out, whose table has the points; means stand in fatigue.average in Python";
        return Err(Error::invalid("--distance", length, allowed));
    }
    let ending = out.extension().map(|e| e.to_string_lossy().to_lowercase());
    if ending.as_deref() != Some("csv") {
        return Err(Error::invalid(
            "--out",
            out.display(),
            "a table (.csv) of points; figures are drawn by pyfret.plot.criterion_map in Python, and the fields are \
             those of result.life(..).dataset",
        ));
    }
    Ok(())
}

/// Writes value, margin and plane of every point.
pub(super) fn write(out: &Path, judged: &Judged<AtPoint>, of: &ByCriterion) -> Result<(), Error> {
    let along_y = matches!(judged.line, Line::AlongY(_));
    let (axis, across) = if along_y { ("y", "x") } else { ("x", "y") };
    let unit = of.assessments.iter().flatten().next();
    let unit = unit.map_or("1", |assessment| assessment.criterion.unit());
    let lives = of.assessments.iter().flatten().any(Assessment::gives_lives);
    let (of_value, margin) = match (unit, lives) {
        ("1", true) => (String::new(), "life [cycles]"),
        (unit, true) => (format!(" [{unit}]"), "life [cycles]"),
        (unit, false) => (format!(" [{unit}]"), "safety_factor"),
    };
    let mut text = format!(
        "{axis} [m],{across} [m],z [m],layer,value{of_value},missed{of_value},{margin},n_x,n_y,n_z,\
         shear_amplitude [Pa],normal_max [Pa],normal_min [Pa]\n"
    );
    for (depth, found) in judged.depths.iter().zip(&judged.found) {
        let (Some(found), Some(assessment)) = (found, of.of(depth.layer)) else {
            continue;
        };
        for (s, f) in judged.along.iter().zip(found) {
            let [n_x, n_y, n_z] = f.normal;
            let (x, y) = judged.line.at(*s);
            let (s, place) = if along_y { (y, x) } else { (x, y) };
            let margin = assessment.margin(f.value);
            let _ = writeln!(
                text,
                "{s:e},{place:e},{:e},{},{:e},{:e},{margin:e},{n_x},{n_y},{n_z},{:e},{:e},{:e}",
                depth.z,
                depth.layer,
                f.value,
                f.missed,
                f.shear_amplitude,
                f.normal_max,
                f.normal_min
            );
        }
    }
    std::fs::write(out, text).map_err(|e| Error::File {
        path: out.display().to_string(),
        message: e.to_string(),
    })
}
