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

/// Access to the value of a key among the settings `T` of its section.
enum Access<T> {
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
type Keys<T> = [(&'static str, Access<T>)];

const KERNEL: &Keys<KernelSettings> = &[
    ("method", Access::Kernel(|k| &mut k.method)),
    ("tolerance", Access::Number(|k| &mut k.tolerance)),
];
const SOLVER: &Keys<SolverSettings> = &[
    ("preset", Access::Preset(|s| &mut s.preset)),
    ("tolerance", Access::Open(|s| &mut s.tolerance)),
    (
        "cell_entry_correction",
        Access::Flag(|s| &mut s.cell_entry_correction),
    ),
    (
        "slip_rotation_correction",
        Access::Flag(|s| &mut s.slip_rotation_correction),
    ),
    ("path_tolerance", Access::Number(|s| &mut s.path_tolerance)),
    ("path_grid", Access::PathGrid(|s| &mut s.path_grid)),
    (
        "max_alternations",
        Access::Count(|s| &mut s.max_alternations),
    ),
    ("max_iterations", Access::Count(|s| &mut s.max_iterations)),
];
const SKIP: &Keys<SkipSettings> = &[
    ("equal_layers", Access::Flag(|s| &mut s.equal_layers)),
    ("coupling", Access::Flag(|s| &mut s.coupling)),
    ("mirror", Access::Flag(|s| &mut s.mirror)),
    (
        "single_precision",
        Access::Flag(|s| &mut s.single_precision),
    ),
    ("contact_window", Access::Flag(|s| &mut s.contact_window)),
    (
        "path_independent_branches",
        Access::Flag(|s| &mut s.path_independent_branches),
    ),
];
const OUTPUT: &Keys<SaveFields> = &[("save", Access::Save(|s| s))];
/// The words of the presets.
const PRESETS: [(&str, Preset); 2] = [("fast", Preset::Fast), ("spinu2020", Preset::Spinu2020)];

/// Reads the sections `[kernel]`, `[solver]`, `[skip]`, `[output]`; keys that are left out have their defaults.
pub(super) fn settings(root: &Section<'_>) -> Result<Settings, Fault> {
    let mut settings = Settings::default();
    read_section(root, "kernel", KERNEL, &mut settings.kernel)?;
    read_section(root, "solver", SOLVER, &mut settings.solver)?;
    read_section(root, "skip", SKIP, &mut settings.skip)?;
    read_section(root, "output", OUTPUT, &mut settings.save)?;
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
        toml::from_str(&to_text(self)).unwrap_or_default()
    }
}

/// The sections `[kernel]`, `[solver]`, `[skip]`, `[output]` of a scene file, every key in full.
pub(super) fn to_text(settings: &Settings) -> String {
    let mut settings = settings.clone();
    let mut text = String::new();
    write_section(&mut text, "kernel", KERNEL, &mut settings.kernel);
    write_section(&mut text, "solver", SOLVER, &mut settings.solver);
    write_section(&mut text, "skip", SKIP, &mut settings.skip);
    write_section(&mut text, "output", OUTPUT, &mut settings.save);
    text
}

/// Reads a section into the settings `into`; keys that are missing keep their values there.
fn read_section<T>(
    root: &Section<'_>,
    name: &str,
    keys: &Keys<T>,
    into: &mut T,
) -> Result<(), Fault> {
    let names: Vec<_> = keys.iter().map(|(key, _)| *key).collect();
    let Some(section) = root.section(name, &names)? else {
        return Ok(());
    };
    for (key, access) in keys {
        match access {
            Access::Flag(of) => *of(into) = section.flag_or(key, *of(into))?,
            Access::Count(of) => *of(into) = section.count_or(key, 1, *of(into))?,
            Access::Number(of) => *of(into) = section.number_or(key, *of(into), &[])?,
            Access::Open(of) => *of(into) = section.number_if(key, &[])?.or(*of(into)),
            Access::Preset(of) => *of(into) = section.choice(key, &PRESETS)?,
            Access::PathGrid(of) => *of(into) = path_grid(&section)?,
            Access::Kernel(of) => *of(into) = kernel_method(&section)?,
            Access::Save(of) => *of(into) = save_fields(&section)?,
        }
    }
    Ok(())
}

/// Writes a section with all its keys that have a value.
fn write_section<T>(text: &mut String, name: &str, keys: &Keys<T>, from: &mut T) {
    // Writing to a text cannot fail.
    let _ = writeln!(text, "\n[{name}]");
    for (key, access) in keys {
        let value = match access {
            Access::Flag(of) => Some(of(from).to_string()),
            Access::Count(of) => Some(of(from).to_string()),
            Access::Number(of) => Some(format!("{:?}", of(from))),
            Access::Open(of) => of(from).map(|number| format!("{number:?}")),
            Access::Preset(of) => {
                let preset = *of(from);
                let word = PRESETS.iter().find(|(_, of)| *of == preset);
                word.map(|(word, _)| format!("\"{word}\""))
            }
            Access::PathGrid(of) => Some(match *of(from) {
                PathGrid::Auto => "\"auto\"".to_owned(),
                PathGrid::Same => "\"same\"".to_owned(),
                PathGrid::Cells(cells) => cells.to_string(),
            }),
            Access::Kernel(of) => Some(kernel_text(*of(from))),
            Access::Save(of) => Some(save_text(of(from))),
        };
        if let Some(value) = value {
            let _ = writeln!(text, "{key} = {value}");
        }
    }
}

/// Reads the path grid: "auto", "same" or a number of cells along x.
fn path_grid(solver: &Section<'_>) -> Result<PathGrid, Fault> {
    match solver.get("path_grid") {
        None => Ok(PathGrid::Auto),
        Some(Value::String(word)) if word == "auto" => Ok(PathGrid::Auto),
        Some(Value::String(word)) if word == "same" => Ok(PathGrid::Same),
        Some(Value::Integer(_)) => Ok(PathGrid::Cells(solver.count_or("path_grid", 1, 1)?)),
        Some(other) => {
            let expected = "\"auto\", \"same\", or a half or a quarter of the cells along x";
            Err(Fault::value(&solver.path("path_grid"), other, expected))
        }
    }
}

/// Reads the method for the influence coefficients.
fn kernel_method(kernel: &Section<'_>) -> Result<KernelMethod, Fault> {
    let expected = "\"hankel\", { inverse_fft = { lambda = 8, aliases = 0 } } or \
                { frequency_domain = { lambda = 8 } }";
    let key = kernel.path("method");
    let value = match kernel.get("method") {
        None => return Ok(KernelSettings::default().method),
        Some(Value::String(word)) if word == "hankel" => return Ok(KernelMethod::Hankel),
        Some(table @ Value::Table(inner)) if inner.len() == 1 => table,
        Some(other) => return Err(Fault::value(&key, other, expected)),
    };
    let method = Section::from_value(key, value, &["inverse_fft", "frequency_domain"])?;
    if let Some(section) = method.section("inverse_fft", &["lambda", "aliases"])? {
        return Ok(KernelMethod::InverseFft {
            lambda: section.count_or("lambda", 1, 8)?,
            aliases: section.count_or("aliases", 0, 0)?,
        });
    }
    let section = method.require_section("frequency_domain", &["lambda"])?;
    Ok(KernelMethod::FrequencyDomain {
        lambda: section.count_or("lambda", 1, 8)?,
    })
}

/// Reads which increments keep their fields.
fn save_fields(output: &Section<'_>) -> Result<SaveFields, Fault> {
    let expected = "\"branches\", \"all\" or a list of increments, counted from 1";
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
        Some(other) => Err(Fault::value(&key, other, expected)),
    }
}

/// The value of `save` in a scene file.
fn save_text(save: &SaveFields) -> String {
    match save {
        SaveFields::Branches => "\"branches\"".to_owned(),
        SaveFields::All => "\"all\"".to_owned(),
        SaveFields::Indices(indices) => format!("{indices:?}"),
    }
}

/// The value of the kernel method in a scene file.
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
