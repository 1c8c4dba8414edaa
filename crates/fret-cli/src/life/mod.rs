//! `fret life`.

mod options;
mod rows;
mod table;

use std::sync::Arc;

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
use self::rows::{LayerAssessor, Row};
use crate::failure::Failure;
use crate::json;
use crate::layout::Page;
use crate::printed::print;
use crate::stress::{given_residual, stop_on_interrupt};
use crate::terminal::print_message;

/// Assesses a result and prints the lives or safety factors.
pub(crate) fn life(options: &Options) -> Result<(), Failure> {
    let lines = life_lines(options).map_err(|error| match error {
        Error::Interrupted { .. } => Failure::Stopped,
        error => Failure::BadInput(error),
    })?;
    if options.json {
        return lines.iter().try_for_each(|line| print(line));
    }
    let mut page = Page::new();
    for line in &lines {
        page.text(line);
    }
    page.print()
}

/// Note on a worst point at the rim.
const AT_RIM: &str = "the worst point is at the rim of the contact: a point value depends on the grid, use a critical \
                      distance (--distance)";

/// Assesses a result and returns the lines to print; notes go to the standard error.
fn life_lines(options: &Options) -> Result<Vec<String>, Error> {
    table::check(options)?;
    let store = Store::open_to_read(&options.store)?;
    let scene = store.scene();
    let (side, body) = if options.body == 1 {
        (Side::Body1, &scene.body1)
    } else {
        (Side::Body2, &scene.body2)
    };
    let materials_given = given_materials(options)?;
    for doubt in materials_given.iter().flatten().flat_map(Material::doubts) {
        print_message(&format!("fret: warning: {doubt}"));
    }
    let of_layers = layer_materials(body, materials_given)?;
    let criterion_by_name =
        |name: &String| CriterionJudge::new(name, body, &of_layers, Search::default());
    let criteria: Vec<_> = options
        .criterion
        .iter()
        .map(criterion_by_name)
        .collect::<Result<_, _>>()?;
    let cycle = StoredCycle::new(&store, Some(options.cycle), side)?;
    let residual = given_residual(body, &options.residual)?;
    let site = Site {
        body,
        side,
        grid: &scene.grid,
        residual: &residual,
        cycle: &cycle,
        stop: stop_on_interrupt(),
        cache: Arc::default(),
    };
    let lines = match (options.along_x, options.along_y) {
        (_, Some(x)) => vec![Line::AlongY(x)],
        (Some(y), None) => vec![Line::AlongX(y)],
        (None, None) => main_sections(&cycle, &scene.grid, &residual)?,
    };
    let mut notes = criteria[0].notes.clone();
    notes.extend(note_on_cycle(&cycle)?);
    let last = cycle.moments(&[cycle.count() - 1])?;
    let length = scene.reference_length(&last.tractions[0][2]);
    let depths_requested = if options.depths.is_empty() {
        default_depths(body, length, 2.0 * length, 1.0)?
    } else {
        depths(body, &options.depths)?
    };
    let below = lines
        .iter()
        .map(|line| judge(&site, *line, &depths_requested, &criteria));
    let below = below.collect::<Result<Vec<_>, _>>()?;
    let judging = LayerAssessor {
        options,
        site: &site,
        lines: &lines,
        body,
        materials: &of_layers,
    };
    write_table(&judging, &below[0], &criteria)?;
    let rows = criteria.iter().enumerate().map(|(n, criteria)| {
        let judged: Vec<_> = below.iter().map(|judged| &judged[n]).collect();
        match options.distance {
            Some(length) => judging
                .row_of_mean(&judged, criteria, length)
                .map(|row| vec![row]),
            None => judging.rows_of_layers(&judged, criteria),
        }
    });
    let mut rows_of_all = rows.collect::<Result<Vec<_>, _>>()?.concat();
    if !options.json {
        // People read the layers that decide first.
        rows_of_all.sort_by_key(|row| !row.decides);
    }
    // Each line has the notes of the cycle and its own notes, each once. The standard error has all
    // notes, each once.
    let notes_of_row = |row: &Row| {
        let rim = row.at_rim.then(|| AT_RIM.to_owned());
        let own_notes = row.notes.iter().cloned().chain(rim);
        own_notes
            .filter(|note| !notes.contains(note))
            .collect::<Vec<_>>()
    };
    let own_notes: Vec<Vec<String>> = rows_of_all.iter().map(notes_of_row).collect();
    let line = |(row, own_notes): (&Row, &Vec<String>)| {
        let mut object = row.json.clone();
        object["notes"] = json!(notes.iter().chain(own_notes).collect::<Vec<_>>());
        if options.json {
            json::line(object)
        } else {
            row.line.clone()
        }
    };
    if !options.json {
        let mut printed: Vec<&String> = Vec::new();
        for note in notes.iter().chain(own_notes.iter().flatten()) {
            if !printed.contains(&note) {
                printed.push(note);
                print_message(&format!("fret: {note}"));
            }
        }
    }
    Ok(rows_of_all.iter().zip(&own_notes).map(line).collect())
}

/// Writes the requested table: the points of the first section, or the means below it.
fn write_table(
    judging: &LayerAssessor<'_>,
    points: &[Judged<PointResult>],
    judges: &[CriterionJudge],
) -> Result<(), Error> {
    let Some(out) = &judging.options.out else {
        return Ok(());
    };
    let means = |length: f64| {
        judges
            .iter()
            .map(|judges| judging.means_along_line(judges, length))
            .collect()
    };
    let means: Option<Result<Vec<_>, _>> = judging.options.distance.map(means);
    let means = means.transpose()?;
    let rows = means.as_deref().unwrap_or(points);
    table::write(out, &judging.options.criterion, rows, judges)
}

/// Materials of the layers by the names in the options, from the surface down; none for a layer without.
fn given_materials(options: &Options) -> Result<Vec<Option<Material>>, Error> {
    let mut table = materials();
    let mut names = options.material.clone();
    if let Some(file) = &options.materials {
        let (text, name) = read_text(file)?;
        let own_materials = read(&text, &name).map_err(|e| from_fatigue(e.into()))?;
        if names.is_empty() && own_materials.len() == 1 {
            names = own_materials.keys().cloned().collect();
        }
        table.extend(own_materials);
    }
    let known_names = || table.keys().cloned().collect::<Vec<_>>().join(", ");
    if names.is_empty() {
        return Err(Error::invalid(
            "--material",
            "nothing",
            format!("one of {}", known_names()),
        ));
    }
    let by_name = |name: String| {
        if name == "none" {
            return Ok(None);
        }
        let material = find(&table, &name).cloned().map(Some);
        material.ok_or_else(|| {
            Error::invalid(
                "--material",
                &name,
                format!("one of {}, or none", known_names()),
            )
        })
    };
    names.into_iter().map(by_name).collect()
}
