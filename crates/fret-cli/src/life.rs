//! `fret life`.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use contact_core::Error;
use contact_core::assess::{
    Averaging, ByCriterion, Distance, Judged, OverCycle, Site, StoredCycle, Worst, average,
    inclination, judge, materials_of_layers, unsettled, worst,
};
use contact_core::fatigue::{
    Assessment, AtPoint, CRITERIA, Material, Search, materials, materials_from,
};
use contact_core::fields::{Line, Side, Zone, chosen_depths, depths, residual_of_layers};
use contact_core::output::Store;
use contact_core::scene::Body;
use serde_json::json;

use crate::failure::Failure;
use crate::printed::print;
use crate::stress::stop_on_interrupt;
use crate::terminal::say;

/// Difference of the ends of a cycle over the largest traction, above which a note is printed.
const UNSETTLED: f64 = 0.02;

/// Options of `fret life`.
#[derive(Args)]
pub(crate) struct Options {
    /// Result store of `fret run`, the increments of its cycle kept
    store: PathBuf,
    /// Name of the material, or one for each layer from the surface down, with commas; 'none' leaves a
    /// layer out. One alone is that of the substrate (default: the only one of --materials)
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    material: Vec<String>,
    /// Table of materials (TOML)
    #[arg(long, value_name = "FILE")]
    materials: Option<PathBuf>,
    /// Criterion
    #[arg(long, value_parser = CRITERIA.iter().map(|c| c.name).collect::<Vec<_>>())]
    criterion: String,
    /// Body below (2) or above (1) the contact plane
    #[arg(long, default_value = "2", value_parser = clap::value_parser!(u8).range(1..=2))]
    body: u8,
    /// Section along x at this y, in metres (default: 0)
    #[arg(
        long,
        value_name = "Y",
        allow_hyphen_values = true,
        conflicts_with = "along_y"
    )]
    along_x: Option<f64>,
    /// Section along y at this x, in metres
    #[arg(long, value_name = "X", allow_hyphen_values = true)]
    along_y: Option<f64>,
    /// Depths in metres (default: as the layers ask)
    #[arg(long, value_name = "Z", value_delimiter = ',')]
    depths: Vec<f64>,
    /// Which closed cycle of the load path, from 0; negative from the end
    #[arg(long, default_value = "-1", allow_hyphen_values = true)]
    cycle: i64,
    /// Residual stress of each layer from the surface down, the substrate's last [Pa], tension positive;
    /// write --residual=-1e9,0 if the first is negative
    #[arg(
        long,
        value_name = "STRESSES",
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    residual: Vec<f64>,
    /// Judge the mean stress over this critical distance, in metres, from the top of a layer
    #[arg(long, value_name = "L")]
    distance: Option<f64>,
    /// What is averaged over: the stress at the depth L/2, its mean down to 2 L, over the half disc or the half
    /// ball of radius L
    #[arg(long, default_value = "line", requires = "distance",
          value_parser = Averaging::ALL.map(|(name, _)| name).to_vec())]
    method: String,
    /// Layer that the distance lies in, from the surface down (default: the outermost with a material)
    #[arg(long, value_name = "N", requires = "distance")]
    layer: Option<usize>,
    /// Print one JSON object per layer, for programs; an endless life is null
    #[arg(long)]
    json: bool,
    /// Table of the section to write (.csv)
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Judges a result and prints the judgement.
pub(crate) fn life(options: &Options) -> Result<(), Failure> {
    let lines = judged(options).map_err(|error| match error {
        Error::Interrupted { .. } => Failure::Stopped,
        error => Failure::BadInput(error),
    })?;
    lines.iter().try_for_each(|line| print(line))
}

/// The text to print; notes go to the standard error.
fn judged(options: &Options) -> Result<Vec<String>, Error> {
    check_ending(options)?;
    let store = Store::open(&options.store)?;
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
    let search = Search::default();
    let of = ByCriterion::new(
        &options.criterion,
        body,
        &materials_of_layers(body, given)?,
        search,
    )?;
    let cycle = StoredCycle::of(&store, Some(options.cycle), side)?;
    let residual = residual_of_layers(body, &options.residual)?;
    let site = Site {
        body,
        side,
        grid: &scene.grid,
        residual: &residual,
        cycle: &cycle,
        stop: stop_on_interrupt(),
    };
    let line = match options.along_y {
        Some(x) => Line::AlongY(x),
        None => Line::AlongX(options.along_x.unwrap_or(0.0)),
    };
    let mut notes = of.notes.clone();
    if let Some(much) = unsettled(&cycle)?.filter(|much| *much > UNSETTLED) {
        notes.push(format!(
            "the cycle is not settled: its tractions end {:.0} % of the largest one off from where they began; go \
             through it more often",
            100.0 * much
        ));
    }
    let found = if let Some(length) = options.distance {
        vec![mean(options, &site, line, length, &of)?]
    } else {
        let last = cycle.moments(&[cycle.count() - 1])?;
        let length = scene.length(&last.tractions[0][2]);
        let asked = if options.depths.is_empty() {
            chosen_depths(body, length, 2.0 * length, 1.0)?
        } else {
            depths(body, &options.depths)?
        };
        let judged = judge(&site, line, &asked, std::slice::from_ref(&of))?.remove(0);
        if let Some(out) = &options.out {
            write_table(out, &judged, &of)?;
        }
        points(&site, &judged, &of, body)?
    };
    if found.iter().any(|row| row.at_rim) {
        notes.push(
            "the worst point is at the rim of the contact: a point value depends on the grid, use a critical distance \
             (--distance)"
                .into(),
        );
    }
    let line = |row: &Row| {
        let mut json = row.json.clone();
        json["notes"] = json!(notes);
        if options.json {
            json.to_string()
        } else {
            row.line.clone()
        }
    };
    if !options.json {
        for note in &notes {
            say(&format!("fret: {note}"));
        }
    }
    Ok(found.iter().map(line).collect())
}

/// The lines of a layer.
struct Row {
    line: String,
    json: serde_json::Value,
    at_rim: bool,
}

/// The worst point of every layer that is judged, the one that decides marked.
fn points(
    site: &Site<'_>,
    judged: &Judged<AtPoint>,
    of: &ByCriterion,
    body: &Body,
) -> Result<Vec<Row>, Error> {
    let mut all: Vec<(Worst<AtPoint>, &Assessment)> = Vec::new();
    for layer in 0..=body.coatings.len() {
        if let Some(assessment) = of.of(layer) {
            all.extend(worst(site, judged, of, layer)?.map(|worst| (worst, assessment)));
        }
    }
    let margin = |(w, a): &(Worst<AtPoint>, &Assessment)| a.margin(w.extreme.value);
    let least =
        all.iter().map(margin).fold(
            f64::INFINITY,
            |least, margin| if margin < least { margin } else { least },
        );
    let rows = all.iter().map(|one| {
        let (w, a) = one;
        let margin = margin(one);
        let decides = !(margin > least);
        let name = if a.gives_lives() { "life" } else { "safety_factor" };
        let (criterion, unit) = (a.criterion.name(), a.criterion.unit());
        let normal = a.criterion.has_plane().then_some(w.found.normal);
        let angle = normal.map(|n| inclination(n, judged.line).to_degrees());
        let at = w.extreme.at.map(|zone| match zone {
            Zone::Contact => "rim of the contact",
            Zone::Stick => "border of the stick zone",
        });
        let error = w.extreme.error.sum();
        let json = json!({
            "criterion": criterion, name: margin, "value": w.extreme.value, "unit": unit, "error": error,
            "error_x": w.extreme.error.x, "error_y": w.extreme.error.y, "error_z": w.extreme.error.z,
            "error_tractions": w.extreme.error.tractions, "x": w.extreme.x, "y": w.extreme.y, "z": w.extreme.depth.z,
            "layer": w.extreme.depth.layer, "at": at, "normal": normal, "inclination": angle,
            "decides": decides,
        });
        let mut line = format!(
            "layer {}: {}, {criterion} {:.5e} {unit} +- {error:.2e} at x = {:.4e} m, y = {:.4e} m, z = {:.4e} m",
            w.extreme.depth.layer,
            said(margin, a),
            w.extreme.value,
            w.extreme.x,
            w.extreme.y,
            w.extreme.depth.z
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
fn mean(
    options: &Options,
    site: &Site<'_>,
    line: Line,
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
    let found = average(site, line, &distance, of)?;
    let along = site.along(line);
    let judged = found
        .iter()
        .zip(&along)
        .filter_map(|(f, s)| Some((f.as_ref()?, *s)));
    let most = judged.max_by(|a, b| a.0.value.total_cmp(&b.0.value));
    let Some((most, place)) = most else {
        let allowed = "so short that the mean stays above the grid";
        return Err(Error::invalid("--distance", length, allowed));
    };
    let margin = assessment.margin(most.value);
    let name = if assessment.gives_lives() {
        "life"
    } else {
        "safety_factor"
    };
    let axis = if matches!(line, Line::AlongX(_)) {
        "x"
    } else {
        "y"
    };
    let (criterion, unit) = (assessment.criterion.name(), assessment.criterion.unit());
    let json = json!({
        "criterion": criterion, name: margin, "value": most.value, "unit": unit, "L": length,
        "method": options.method, axis: place, "layer": layer,
    });
    let line = format!(
        "layer {layer}: {}, {criterion} {:.5e} {unit} at {axis} = {place:.4e} m, {} method with L = {length:.3e} m",
        said(margin, assessment),
        most.value,
        options.method
    );
    Ok(Row {
        line,
        json,
        at_rim: false,
    })
}

fn said(margin: f64, of: &Assessment) -> String {
    match (of.gives_lives(), margin.is_finite()) {
        (true, true) => format!("{margin:.4e} cycles"),
        (true, false) => "endless life".into(),
        (false, _) => format!("safety factor {margin:.4}"),
    }
}

/// The materials named, from the surface down.
fn given_materials(options: &Options) -> Result<Vec<Option<Material>>, Error> {
    let mut table = materials();
    let mut names = options.material.clone();
    if let Some(file) = &options.materials {
        let own = materials_from(file).map_err(Error::Criterion)?;
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
        let found = table.get(&name).cloned().map(Some);
        found.ok_or_else(|| {
            Error::invalid("--material", &name, format!("one of {}, or none", known()))
        })
    };
    names.into_iter().map(named).collect()
}

fn check_ending(options: &Options) -> Result<(), Error> {
    let Some(out) = &options.out else {
        return Ok(());
    };
    let ending = out.extension().map(|e| e.to_string_lossy().to_lowercase());
    if options.distance.is_some() || ending.as_deref() != Some("csv") {
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
fn write_table(out: &Path, judged: &Judged<AtPoint>, of: &ByCriterion) -> Result<(), Error> {
    let (axis, across, place) = match judged.line {
        Line::AlongX(y) => ("x", "y", y),
        Line::AlongY(x) => ("y", "x", x),
    };
    let mut text = format!(
        "{axis} [m],{across} [m],z [m],layer,value,missed,margin,n_x,n_y,n_z,shear_amplitude [Pa],normal_max [Pa],\
         normal_min [Pa]\n"
    );
    for (depth, found) in judged.depths.iter().zip(&judged.found) {
        let (Some(found), Some(assessment)) = (found, of.of(depth.layer)) else {
            continue;
        };
        for (s, f) in judged.along.iter().zip(found) {
            let [n_x, n_y, n_z] = f.normal;
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
