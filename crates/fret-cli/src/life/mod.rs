//! `fret life`.

mod options;
mod rows;
mod table;

use contact_assess::{CriterionJudge, Judged, Site, from_fatigue, judge, layer_materials};
use contact_core::Error;
use contact_core::scene::read_text;
use contact_store::Store;
use contact_store::StoredCycle;
use contact_subsurface::{CycleSource, main_sections, note_on_cycle};
use contact_subsurface::{Line, Side, default_depths, depths};
use fatigue::{Material, PointResult, Search, find, materials, read};
use serde_json::json;

pub(crate) use self::options::Options;
use self::rows::{Judging, Row};
use crate::failure::Failure;
use crate::json;
use crate::printed::print;
use crate::stress::{given_residual, stop_on_interrupt};
use crate::terminal::say;

/// Judges a result and prints the judgement.
pub(crate) fn life(options: &Options) -> Result<(), Failure> {
    let lines = judged(options).map_err(|error| match error {
        Error::Interrupted { .. } => Failure::Stopped,
        error => Failure::BadInput(error),
    })?;
    lines.iter().try_for_each(|line| print(line))
}

/// What is told of a worst point there.
const AT_RIM: &str = "the worst point is at the rim of the contact: a point value depends on the grid, use a critical \
                      distance (--distance)";

/// The text to print; notes go to the standard error.
fn judged(options: &Options) -> Result<Vec<String>, Error> {
    table::check(options)?;
    let store = Store::open_to_read(&options.store)?;
    let scene = store.scene();
    let (side, body) = if options.body == 1 {
        (Side::Body1, &scene.body1)
    } else {
        (Side::Body2, &scene.body2)
    };
    let given = given_materials(options)?;
    for doubt in given.iter().flatten().flat_map(Material::doubts) {
        say(&format!("fret: warning: {doubt}"));
    }
    let of_layers = layer_materials(body, given)?;
    let named = |name: &String| CriterionJudge::new(name, body, &of_layers, Search::default());
    let of: Vec<_> = options
        .criterion
        .iter()
        .map(named)
        .collect::<Result<_, _>>()?;
    let cycle = StoredCycle::of(&store, Some(options.cycle), side)?;
    let residual = given_residual(body, &options.residual)?;
    let site = Site {
        body,
        side,
        grid: &scene.grid,
        residual: &residual,
        cycle: &cycle,
        stop: stop_on_interrupt(),
    };
    let lines = match (options.along_x, options.along_y) {
        (_, Some(x)) => vec![Line::AlongY(x)],
        (Some(y), None) => vec![Line::AlongX(y)],
        (None, None) => main_sections(&cycle, &scene.grid, &residual)?,
    };
    let mut notes = of[0].notes.clone();
    notes.extend(note_on_cycle(&cycle)?);
    let last = cycle.moments(&[cycle.count() - 1])?;
    let length = scene.reference_length(&last.tractions[0][2]);
    let asked = if options.depths.is_empty() {
        default_depths(body, length, 2.0 * length, 1.0)?
    } else {
        depths(body, &options.depths)?
    };
    let below = lines.iter().map(|line| judge(&site, *line, &asked, &of));
    let below = below.collect::<Result<Vec<_>, _>>()?;
    let judging = Judging {
        options,
        site: &site,
        lines: &lines,
        body,
        materials: &of_layers,
    };
    write_table(&judging, &below[0], &of)?;
    let rows = of.iter().enumerate().map(|(n, of)| {
        let judged: Vec<_> = below.iter().map(|judged| &judged[n]).collect();
        match options.distance {
            Some(length) => judging.mean(&judged, of, length).map(|row| vec![row]),
            None => judging.points(&judged, of),
        }
    });
    let found = rows.collect::<Result<Vec<_>, _>>()?.concat();
    // A line has the notes of the cycle and its own, each once; the standard error has all, each once.
    let of_row = |row: &Row| {
        let rim = row.at_rim.then(|| AT_RIM.to_owned());
        let own = row.notes.iter().cloned().chain(rim);
        own.filter(|note| !notes.contains(note)).collect::<Vec<_>>()
    };
    let own: Vec<Vec<String>> = found.iter().map(of_row).collect();
    let line = |(row, own): (&Row, &Vec<String>)| {
        let mut of_line = row.json.clone();
        of_line["notes"] = json!(notes.iter().chain(own).collect::<Vec<_>>());
        if options.json {
            json::line(of_line)
        } else {
            row.line.clone()
        }
    };
    if !options.json {
        let mut said: Vec<&String> = Vec::new();
        for note in notes.iter().chain(own.iter().flatten()) {
            if !said.contains(&note) {
                said.push(note);
                say(&format!("fret: {note}"));
            }
        }
    }
    Ok(found.iter().zip(&own).map(line).collect())
}

/// Writes the table that is asked for: the points of the first section, or the means below it.
fn write_table(
    judging: &Judging<'_>,
    points: &[Judged<PointResult>],
    of: &[CriterionJudge],
) -> Result<(), Error> {
    let Some(out) = &judging.options.out else {
        return Ok(());
    };
    let means = |length: f64| of.iter().map(|of| judging.means(of, length)).collect();
    let means: Option<Result<Vec<_>, _>> = judging.options.distance.map(means);
    let means = means.transpose()?;
    let rows = means.as_deref().unwrap_or(points);
    table::write(out, &judging.options.criterion, rows, of)
}

/// The materials named, from the surface down.
fn given_materials(options: &Options) -> Result<Vec<Option<Material>>, Error> {
    let mut table = materials();
    let mut names = options.material.clone();
    if let Some(file) = &options.materials {
        let (text, name) = read_text(file)?;
        let own = read(&text, &name).map_err(|e| from_fatigue(e.into()))?;
        if names.is_empty() && own.len() == 1 {
            names = own.keys().cloned().collect();
        }
        table.extend(own);
    }
    let known = || table.keys().cloned().collect::<Vec<_>>().join(", ");
    if names.is_empty() {
        return Err(Error::invalid(
            "--material",
            "nothing",
            format!("one of {}", known()),
        ));
    }
    let named = |name: String| {
        if name == "none" {
            return Ok(None);
        }
        let found = find(&table, &name).cloned().map(Some);
        found.ok_or_else(|| {
            Error::invalid("--material", &name, format!("one of {}, or none", known()))
        })
    };
    names.into_iter().map(named).collect()
}
