//! A scene as a scene file in SI: every value in full, so that it reads back to an equal scene.

use std::fmt::Write as _;

use toml::Value;

use super::read::SCHEMA;
use crate::scene::{
    Body, Bond, Elastic, Friction, FrictionHistory, History, KernelMethod, Loads, Preset,
    RigidMotion, SaveFields, Scene, Spacing,
};

impl Scene {
    /// The scene in the format of the scene file, every number in SI, nothing left to a default.
    pub fn to_toml(&self) -> String {
        let mut text = format!("schema = {SCHEMA}\ntitle = {}\n", quoted(&self.title));
        let mut line = |line: std::fmt::Arguments<'_>| {
            // Writing to a text cannot fail.
            let _ = writeln!(text, "{line}");
        };
        for (name, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            line(format_args!("\n[{name}]\n{}", substrate(body)));
            for (n, coating) in body.coatings.iter().enumerate() {
                line(format_args!("\n[[{name}.coatings]]"));
                line(format_args!("{}", material(coating.material)));
                line(format_args!("thickness = {:?}", coating.thickness));
                let bond = body.bond(n);
                if bond != Bond::PERFECT {
                    line(format_args!("bond_normal = {:?}", bond.normal));
                    line(format_args!("bond_shear = {:?}", bond.shear));
                }
            }
        }
        line(format_args!("\n[friction]\n{}", friction(&self.friction)));
        let grid = &self.grid;
        line(format_args!("\n[grid]\nn = [{}, {}]", grid.nx, grid.ny));
        line(format_args!("spacing = [{:?}, {:?}]", grid.dx, grid.dy));
        line(format_args!("plane_strain = {}", grid.plane_strain));
        for branch in &self.path.branches {
            line(format_args!("\n[[path]]"));
            for motion in RigidMotion::ALL {
                let prescribed = branch.to.prescribed(motion);
                let (name, value) = (prescribed.name(motion), prescribed.value());
                line(format_args!("{name} = {value:?}"));
            }
            let Loads {
                sigma_B,
                sigma_B1,
                rolled,
                ..
            } = branch.to;
            line(format_args!(
                "sigma_B = {sigma_B:?}\nsigma_B1 = {sigma_B1:?}"
            ));
            line(format_args!("rolled = {rolled:?}"));
            match branch.increments {
                Some(n) => line(format_args!("increments = {n}")),
                None => line(format_args!("increments = \"auto\"")),
            }
            if let Some(error) = branch.path_error {
                line(format_args!("path_error = {error:?}"));
            }
            line(format_args!("t = {:?}", branch.t_end));
            let spacing = match branch.spacing {
                Spacing::Uniform => "uniform",
                Spacing::EqualRadius => "equal_radius",
                Spacing::ShortFirst => "short_first",
            };
            line(format_args!("spacing = \"{spacing}\""));
        }
        let settings = &self.settings;
        let method = kernel_method(settings.kernel.method);
        line(format_args!("\n[kernel]\nmethod = {method}"));
        line(format_args!("tolerance = {:?}", settings.kernel.tolerance));
        let solver = &settings.solver;
        let preset = match solver.preset {
            Preset::Fast => "fast",
            Preset::Spinu2020 => "spinu2020",
        };
        line(format_args!("\n[solver]\npreset = \"{preset}\""));
        if let Some(tolerance) = solver.tolerance {
            line(format_args!("tolerance = {tolerance:?}"));
        }
        line(format_args!("entering = {}", solver.entering));
        line(format_args!("turning = {}", solver.turning));
        line(format_args!("path_tolerance = {:?}", solver.path_tolerance));
        line(format_args!(
            "max_alternations = {}",
            solver.max_alternations
        ));
        line(format_args!("max_iterations = {}", solver.max_iterations));
        let skip = &settings.skip;
        line(format_args!(
            "\n[skip]\nequal_layers = {}",
            skip.equal_layers
        ));
        line(format_args!(
            "coupling = {}\nmirror = {}\ndigits = {}\nfar = {}\npath = {}",
            skip.coupling, skip.mirror, skip.digits, skip.far, skip.path
        ));
        let save = match &settings.save {
            SaveFields::Branches => "\"branches\"".to_owned(),
            SaveFields::All => "\"all\"".to_owned(),
            SaveFields::Indices(indices) => format!("{indices:?}"),
        };
        line(format_args!("\n[output]\nsave = {save}"));
        text
    }
}

fn friction(friction: &Friction) -> String {
    let mut lines = vec![if friction.mu.is_finite() {
        format!("mu = {:?}", friction.mu)
    } else {
        "mu = \"stick\"".to_owned()
    }];
    for (key, mu) in [("mu_y", friction.mu_y), ("kinetic", friction.kinetic)] {
        lines.extend(mu.map(|mu| format!("{key} = {mu:?}")));
    }
    let map = friction.map.as_ref();
    lines.extend(map.map(|map| format!("map = {{ {} }}", super::shape::map_text(map))));
    if let Some(FrictionHistory { of, table }) = &friction.history {
        let of = match of {
            History::Slip => "slip",
            History::Dissipated => "dissipated",
            History::Increment => "increment",
        };
        let pairs: Vec<_> = table
            .iter()
            .map(|(at, f)| format!("[{at:?}, {f:?}]"))
            .collect();
        let table = pairs.join(", ");
        lines.push(format!("history = {{ of = \"{of}\", table = [{table}] }}"));
    }
    lines.join("\n")
}

fn quoted(text: &str) -> String {
    Value::String(text.to_owned()).to_string()
}

fn substrate(body: &Body) -> String {
    let shape = super::shape::text(&body.shape);
    format!("shape = {shape}\n{}", material(body.substrate))
}

fn material(material: Elastic) -> String {
    let E = if material.is_rigid() {
        "\"rigid\"".to_owned()
    } else {
        format!("{:?}", material.E)
    };
    format!("E = {E}\nnu = {:?}", material.nu)
}

fn kernel_method(method: KernelMethod) -> String {
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
