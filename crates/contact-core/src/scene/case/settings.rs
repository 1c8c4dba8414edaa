//! The settings of a scene file: a row for each key reads it, refuses others and writes it.

use std::fmt::Write as _;

use toml::{Table, Value};

use super::fault::Fault;
use super::section::{Section, count};
use crate::error::Error;
use crate::scene::{
    KernelMethod, KernelSettings, PathGrid, Preset, SaveFields, Settings, SkipSettings,
    SolverSettings,
};

/// Where a key stands among the settings `T` of its section.
enum Place<T> {
    Flag(fn(&mut T) -> &mut bool),
    /// A whole number from 1.
    Count(fn(&mut T) -> &mut usize),
    Number(fn(&mut T) -> &mut f64),
    /// A number that may be left to its default.
    Open(fn(&mut T) -> &mut Option<f64>),
    Preset(fn(&mut T) -> &mut Preset),
    PathGrid(fn(&mut T) -> &mut PathGrid),
    Kernel(fn(&mut T) -> &mut KernelMethod),
    Save(fn(&mut T) -> &mut SaveFields),
}

/// The keys of a section.
type Keys<T> = [(&'static str, Place<T>)];

const KERNEL: &Keys<KernelSettings> = &[
    ("method", Place::Kernel(|k| &mut k.method)),
    ("tolerance", Place::Number(|k| &mut k.tolerance)),
];
const SOLVER: &Keys<SolverSettings> = &[
    ("preset", Place::Preset(|s| &mut s.preset)),
    ("tolerance", Place::Open(|s| &mut s.tolerance)),
    ("entering", Place::Flag(|s| &mut s.entering)),
    ("turning", Place::Flag(|s| &mut s.turning)),
    ("path_tolerance", Place::Number(|s| &mut s.path_tolerance)),
    ("path_grid", Place::PathGrid(|s| &mut s.path_grid)),
    (
        "max_alternations",
        Place::Count(|s| &mut s.max_alternations),
    ),
    ("max_iterations", Place::Count(|s| &mut s.max_iterations)),
];
const SKIP: &Keys<SkipSettings> = &[
    ("equal_layers", Place::Flag(|s| &mut s.equal_layers)),
    ("coupling", Place::Flag(|s| &mut s.coupling)),
    ("mirror", Place::Flag(|s| &mut s.mirror)),
    ("digits", Place::Flag(|s| &mut s.digits)),
    ("far", Place::Flag(|s| &mut s.far)),
    ("path", Place::Flag(|s| &mut s.path)),
];
const OUTPUT: &Keys<SaveFields> = &[("save", Place::Save(|s| s))];
/// The words of the presets.
const PRESETS: [(&str, Preset); 2] = [("fast", Preset::Fast), ("spinu2020", Preset::Spinu2020)];

pub(super) fn settings(root: &Section<'_>) -> Result<Settings, Fault> {
    let mut settings = Settings::default();
    read(root, "kernel", KERNEL, &mut settings.kernel)?;
    read(root, "solver", SOLVER, &mut settings.solver)?;
    read(root, "skip", SKIP, &mut settings.skip)?;
    read(root, "output", OUTPUT, &mut settings.save)?;
    Ok(settings)
}

impl Settings {
    /// Settings from the tables `[kernel]`, `[solver]`, `[skip]`, `[output]` of a scene file, checked.
    pub fn from_table(tables: &Table) -> Result<Self, Error> {
        let names = ["kernel", "solver", "skip", "output"];
        let read = Section::root(tables, &names).and_then(|root| settings(&root));
        let settings = read.map_err(Fault::into_error)?;
        settings.check()?;
        Ok(settings)
    }

    /// The tables of a scene file, every key in full.
    pub fn to_table(&self) -> Table {
        toml::from_str(&text(self)).unwrap_or_default()
    }
}

/// The sections of the settings, every key in full.
pub(super) fn text(settings: &Settings) -> String {
    let mut settings = settings.clone();
    let mut text = String::new();
    write(&mut text, "kernel", KERNEL, &mut settings.kernel);
    write(&mut text, "solver", SOLVER, &mut settings.solver);
    write(&mut text, "skip", SKIP, &mut settings.skip);
    write(&mut text, "output", OUTPUT, &mut settings.save);
    text
}

/// Reads a section; keys that are missing stay as they are.
fn read<T>(root: &Section<'_>, name: &str, keys: &Keys<T>, into: &mut T) -> Result<(), Fault> {
    let names: Vec<_> = keys.iter().map(|(key, _)| *key).collect();
    let Some(section) = root.section(name, &names)? else {
        return Ok(());
    };
    for (key, place) in keys {
        match place {
            Place::Flag(of) => *of(into) = section.flag_or(key, *of(into))?,
            Place::Count(of) => *of(into) = section.count_or(key, 1, *of(into))?,
            Place::Number(of) => *of(into) = section.number_or(key, *of(into), &[])?,
            Place::Open(of) => *of(into) = section.number_if(key, &[])?.or(*of(into)),
            Place::Preset(of) => *of(into) = section.choice(key, &PRESETS)?,
            Place::PathGrid(of) => *of(into) = path_grid(&section)?,
            Place::Kernel(of) => *of(into) = kernel_method(&section)?,
            Place::Save(of) => *of(into) = save(&section)?,
        }
    }
    Ok(())
}

fn write<T>(text: &mut String, name: &str, keys: &Keys<T>, from: &mut T) {
    // Writing to a text cannot fail.
    let _ = writeln!(text, "\n[{name}]");
    for (key, place) in keys {
        let value = match place {
            Place::Flag(of) => Some(of(from).to_string()),
            Place::Count(of) => Some(of(from).to_string()),
            Place::Number(of) => Some(format!("{:?}", of(from))),
            Place::Open(of) => of(from).map(|number| format!("{number:?}")),
            Place::Preset(of) => {
                let preset = *of(from);
                let word = PRESETS.iter().find(|(_, of)| *of == preset);
                word.map(|(word, _)| format!("\"{word}\""))
            }
            Place::PathGrid(of) => Some(match *of(from) {
                PathGrid::Auto => "\"auto\"".to_owned(),
                PathGrid::Same => "\"same\"".to_owned(),
                PathGrid::Cells(cells) => cells.to_string(),
            }),
            Place::Kernel(of) => Some(kernel_text(*of(from))),
            Place::Save(of) => Some(save_text(of(from))),
        };
        if let Some(value) = value {
            let _ = writeln!(text, "{key} = {value}");
        }
    }
}

fn path_grid(solver: &Section<'_>) -> Result<PathGrid, Fault> {
    match solver.get("path_grid") {
        None => Ok(PathGrid::Auto),
        Some(Value::String(word)) if word == "auto" => Ok(PathGrid::Auto),
        Some(Value::String(word)) if word == "same" => Ok(PathGrid::Same),
        Some(Value::Integer(_)) => Ok(PathGrid::Cells(solver.count_or("path_grid", 1, 1)?)),
        Some(other) => {
            let what = "\"auto\", \"same\", or a half or a quarter of the cells along x";
            Err(Fault::value(&solver.path("path_grid"), other, what))
        }
    }
}

fn kernel_method(kernel: &Section<'_>) -> Result<KernelMethod, Fault> {
    let what = "\"hankel\", { inverse_fft = { lambda = 8, aliases = 0 } } or \
                { frequency_domain = { lambda = 8 } }";
    let key = kernel.path("method");
    let value = match kernel.get("method") {
        None => return Ok(KernelSettings::default().method),
        Some(Value::String(word)) if word == "hankel" => return Ok(KernelMethod::Hankel),
        Some(table @ Value::Table(inner)) if inner.len() == 1 => table,
        Some(other) => return Err(Fault::value(&key, other, what)),
    };
    let method = Section::from_value(key, value, &["inverse_fft", "frequency_domain"])?;
    if let Some(section) = method.section("inverse_fft", &["lambda", "aliases"])? {
        return Ok(KernelMethod::InverseFft {
            lambda: section.count_or("lambda", 1, 8)?,
            aliases: section.count_or("aliases", 0, 0)?,
        });
    }
    let section = method.need_section("frequency_domain", &["lambda"])?;
    Ok(KernelMethod::FrequencyDomain {
        lambda: section.count_or("lambda", 1, 8)?,
    })
}

fn save(output: &Section<'_>) -> Result<SaveFields, Fault> {
    let what = "\"branches\", \"all\" or a list of increments, counted from 1";
    let key = output.path("save");
    match output.get("save") {
        None => Ok(SaveFields::default()),
        Some(Value::String(word)) if word == "branches" => Ok(SaveFields::Branches),
        Some(Value::String(word)) if word == "all" => Ok(SaveFields::All),
        Some(Value::Array(items)) => items
            .iter()
            .enumerate()
            .map(|(i, item)| count(&format!("{key}[{i}]"), item, 1))
            .collect::<Result<_, _>>()
            .map(SaveFields::Indices),
        Some(other) => Err(Fault::value(&key, other, what)),
    }
}

fn save_text(save: &SaveFields) -> String {
    match save {
        SaveFields::Branches => "\"branches\"".to_owned(),
        SaveFields::All => "\"all\"".to_owned(),
        SaveFields::Indices(indices) => format!("{indices:?}"),
    }
}

fn kernel_text(method: KernelMethod) -> String {
    match method {
        KernelMethod::Hankel => "\"hankel\"".to_owned(),
        KernelMethod::InverseFft { lambda, aliases } => {
            format!("{{ inverse_fft = {{ lambda = {lambda}, aliases = {aliases} }} }}")
        }
        KernelMethod::FrequencyDomain { lambda } => {
            format!("{{ frequency_domain = {{ lambda = {lambda} }} }}")
        }
    }
}
