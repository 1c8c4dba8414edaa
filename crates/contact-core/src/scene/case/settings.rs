//! The settings of a scene file.

use toml::Value;

use super::fault::Fault;
use super::section::{Section, count};
use crate::scene::{
    KernelMethod, KernelSettings, Preset, SaveFields, Settings, SkipSettings, SolverSettings,
};

pub(super) fn settings(root: &Section<'_>) -> Result<Settings, Fault> {
    let mut settings = Settings::default();
    if let Some(section) = root.section("kernel", &["method", "tolerance"])? {
        let default = settings.kernel;
        settings.kernel = KernelSettings {
            method: kernel_method(&section)?,
            tolerance: section.number_or("tolerance", default.tolerance, &[])?,
        };
    }
    let keys = [
        "preset",
        "tolerance",
        "entering",
        "turning",
        "path_tolerance",
        "max_alternations",
        "max_iterations",
    ];
    if let Some(section) = root.section("solver", &keys)? {
        let default = settings.solver;
        settings.solver = SolverSettings {
            preset: section.choice(
                "preset",
                &[("fast", Preset::Fast), ("spinu2020", Preset::Spinu2020)],
            )?,
            tolerance: section.number_if("tolerance", &[])?.or(default.tolerance),
            entering: section.flag_or("entering", default.entering)?,
            turning: section.flag_or("turning", default.turning)?,
            path_tolerance: section.number_or("path_tolerance", default.path_tolerance, &[])?,
            max_alternations: section.count_or("max_alternations", 1, default.max_alternations)?,
            max_iterations: section.count_or("max_iterations", 1, default.max_iterations)?,
        };
    }
    let rules = [
        "equal_layers",
        "coupling",
        "mirror",
        "digits",
        "far",
        "path",
    ];
    if let Some(section) = root.section("skip", &rules)? {
        let default = settings.skip;
        settings.skip = SkipSettings {
            equal_layers: section.flag_or("equal_layers", default.equal_layers)?,
            coupling: section.flag_or("coupling", default.coupling)?,
            mirror: section.flag_or("mirror", default.mirror)?,
            digits: section.flag_or("digits", default.digits)?,
            far: section.flag_or("far", default.far)?,
            path: section.flag_or("path", default.path)?,
        };
    }
    if let Some(section) = root.section("output", &["save"])? {
        settings.save = save(&section)?;
    }
    Ok(settings)
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
