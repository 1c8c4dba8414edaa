//! `fret stress`.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::{Body, Profile, ResidualStress, Scene};
use contact_core::zones::Outline;
use contact_store::{ImageData, Store, StressStore, VolumeSink, write_volume};
use contact_subsurface::{
    BodyMaximum, BodySearch, Depth, Line, Loads as LoadedBody, Probe, Search, Section, Side,
    Slices, States, default_depths, depths,
};
use ndarray::Axis;

use crate::failure::Failure;
use crate::largest::{Largest, Units};
use crate::layout::Page;
use crate::loads::Loads;
use crate::printed::print;
use crate::quantity::{length, stress as stress_of};
use crate::terminal::print_message;
use crate::units::um;

/// Options of `fret stress`.
#[derive(Args)]
pub(crate) struct Options {
    /// Result store of `fret run`
    store: PathBuf,
    /// File to write: image data (.vti) of a volume, or a Zarr folder (.zarr or no ending)
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Increment whose fields were kept; by default the last
    #[arg(long, value_name = "N")]
    increment: Option<usize>,
    /// Body below (2) or above (1) the contact plane
    #[arg(long, default_value = "2", value_parser = clap::value_parser!(u8).range(1..=2))]
    body: u8,
    /// Section along x at this y [m, or with a unit]
    #[arg(long, value_name = "Y", value_parser = length, allow_hyphen_values = true, conflicts_with_all = ["along_y", "volume"])]
    along_x: Option<f64>,
    /// Section along y at this x [m, or with a unit]
    #[arg(
        long,
        value_name = "X",
        value_parser = length,
        allow_hyphen_values = true,
        conflicts_with = "volume"
    )]
    along_y: Option<f64>,
    /// The whole volume under the grid, plane by plane (default: the section along the shear
    /// through the centre of the contact, and the largest values of the whole body)
    #[arg(long)]
    volume: bool,
    /// Print one JSON object per measure, for programs
    #[arg(long)]
    json: bool,
    /// Units of the lines: MPa and um, or over Hertz's pressure and radius
    #[arg(long, value_enum, default_value = "si", ignore_case = true)]
    units: Units,
    /// Residual stress of each layer from the surface down, the substrate's last [Pa, or with a unit], tension
    /// positive; write --residual=-1e9,0 if the first is negative
    #[arg(
        long,
        value_name = "STRESSES",
        value_parser = stress_of,
        value_delimiter = ',',
        allow_hyphen_values = true
    )]
    residual: Vec<f64>,
    /// Leave out the bulk stress of the body
    #[arg(long)]
    no_bulk: bool,
    /// Largest depth [m, or with a unit]; by default 2 a_H, or where there is no Hertz contact the width of
    /// the contact
    #[arg(long, value_name = "Z", value_parser = length)]
    depth: Option<f64>,
    /// Number of depths to write, evenly from the surface, such as 64, or the depths themselves
    /// [m, or with a unit], such as 0,5e-6,10e-6; by default those that the layers ask for, both sides of every
    /// interface among them, and 256 in image data. Largest values are looked for at these and at
    /// those that the layers ask for
    #[arg(long, value_name = "N or Z,Z,...", value_parser = Depths::read)]
    depths: Option<Depths>,
    /// Quantities to print or write, for example von_mises,s_xx,tresca,s_1,hydrostatic,u_z
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "von_mises"
    )]
    of: Vec<String>,
}

/// Depths to write: so many, or these \[m\].
#[derive(Clone, Debug)]
enum Depths {
    Number(u16),
    Places(Vec<f64>),
}

impl Depths {
    /// Reads depths: their number, or depths in m separated by commas.
    fn read(text: &str) -> Result<Self, String> {
        let allowed = "a number of depths from 1 to 65535, or depths in m, not negative, such as 0,5e-6,10e-6";
        if let Ok(n) = text.parse::<u16>() {
            return if n > 0 {
                Ok(Self::Number(n))
            } else {
                Err(allowed.into())
            };
        }
        let places = text.split(',').map(|z| length(z).ok());
        let places: Option<Vec<f64>> = places.collect();
        match places {
            Some(z) if z.iter().all(|z| *z >= 0.0 && z.is_finite()) => {
                let mut z = z;
                z.sort_by(f64::total_cmp);
                Ok(Self::Places(z))
            }
            _ => Err(allowed.into()),
        }
    }
}

/// The probes and places to compute.
struct Task {
    scene: Scene,
    side: Side,
    /// The depths that are written.
    depths: Vec<Depth>,
    /// The default depths of the layers; the largest values are searched here as well.
    chosen: Vec<Depth>,
    /// True if lines are for programs.
    json: bool,
    units: Units,
    probes: Vec<Probe>,
    loads: Loads,
    residual: ResidualStress,
    /// Raised by Ctrl-C.
    stop: Arc<AtomicBool>,
}

/// Residual stress of a body: the stress given for each layer \[Pa\], else the stress of the body.
pub(crate) fn given_residual(body: &Body, given: &[f64]) -> Result<ResidualStress, Error> {
    let layers: Vec<_> = given.iter().copied().map(Profile::uniform).collect();
    ResidualStress::from_profiles(body, &layers)
}

/// Computes the stress below the contact of a result: the command `fret stress`.
pub(crate) fn stress(options: &Options) -> Result<(), Failure> {
    check_ending(options).map_err(Failure::BadInput)?;
    let task = Task::new(options, stop_on_interrupt()).map_err(Failure::BadInput)?;
    let lines = match (options.along_x, options.along_y, options.volume) {
        (_, _, true) => task.volume(options),
        (_, Some(x), _) => task.section(options, Line::AlongY(x), false),
        (Some(y), None, _) => task.section(options, Line::AlongX(y), false),
        (None, None, _) => task.section(options, task.main_section(), true),
    };
    let lines = lines.map_err(|error| match error {
        Error::Interrupted { .. } => Failure::Stopped,
        error => Failure::BadInput(error),
    })?;
    if options.json {
        return print(&lines.join("\n"));
    }
    let mut page = Page::new();
    for line in &lines {
        page.text(line);
    }
    page.print()
}

/// Rejects a file that is neither image data nor a Zarr folder, for example a figure.
fn check_ending(options: &Options) -> Result<(), Error> {
    let Some(out) = &options.out else {
        return Ok(());
    };
    let ending = out.extension().map(|e| e.to_string_lossy().to_lowercase());
    match ending.as_deref() {
        None | Some("zarr" | "vti") => Ok(()),
        Some(_) => Err(Error::invalid(
            "--out",
            out.display(),
            "a .vti file of a --volume or a Zarr folder (.zarr or no ending); figures are drawn by \
             pyfret.plot.stress_map in Python",
        )),
    }
}

/// A flag that the first Ctrl-C raises; the second ends the process at once, and may leave
/// unfinished files behind.
pub(crate) fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let flag = stop.clone();
    let handler = move || {
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(1);
        }
    };
    if let Err(error) = ctrlc::set_handler(handler) {
        print_message(&format!("fret: Ctrl-C will end this at once: {error}"));
    }
    stop
}

impl Task {
    /// Reads the result and the options.
    fn new(options: &Options, stop: Arc<AtomicBool>) -> Result<Self, Error> {
        let store = Store::open_to_read(&options.store)?;
        let scene = store.scene().clone();
        let side = if options.body == 1 {
            Side::Body1
        } else {
            Side::Body2
        };
        let body = if options.body == 1 {
            &scene.body1
        } else {
            &scene.body2
        };
        let probes = options.of.iter().map(|name| Probe::find(name, "--of"));
        let probes = probes.collect::<Result<Vec<_>, _>>()?;
        check_interfaces(body, &probes)?;
        let loads = Loads::read(&store, options.increment, options.body, !options.no_bulk)?;
        let length = scene.reference_length(&loads.p);
        let deepest = options.depth.unwrap_or(2.0 * length);
        let chosen = default_depths(body, length, deepest, 1.0)?;
        let evenly = |n: u16| {
            let steps = f64::from(n.max(2) - 1);
            let z = (0..n).map(|i| deepest * f64::from(i) / steps);
            depths(body, &z.collect::<Vec<_>>())
        };
        let mut written = match &options.depths {
            Some(Depths::Number(n)) => evenly(*n)?,
            Some(Depths::Places(z)) => depths(body, z)?,
            None if is_image(options) => evenly(256)?,
            None => chosen.clone(),
        };
        if options.volume {
            // A volume has one value per place: the value in the upper layer.
            written.dedup_by_key(|d| d.z.to_bits());
        }
        warn_of_thin_layer(&scene, body);
        Ok(Self {
            residual: given_residual(body, &options.residual)?,
            probes,
            loads,
            scene,
            side,
            depths: written,
            chosen,
            json: options.json,
            units: options.units,
            stop,
        })
    }

    /// The body below the contact.
    fn body(&self) -> &Body {
        match self.side {
            Side::Body1 => &self.scene.body1,
            Side::Body2 => &self.scene.body2,
        }
    }

    /// The formatter of the largest values of this result.
    fn largest(&self) -> Largest<'_> {
        Largest {
            scene: &self.scene,
            body: self.body(),
            increment: self.loads.increment,
            error: self.loads.error,
            json: self.json,
            units: self.units,
        }
    }

    /// Opens the file to write to, if one is given.
    fn store(&self, options: &Options, line: Option<Line>) -> Result<Option<StressStore>, Error> {
        let Some(out) = &options.out else {
            return Ok(None);
        };
        let title = format!("{}, increment {}", self.scene.title, self.loads.increment);
        StressStore::create(
            out,
            &title,
            &self.scene.grid,
            self.side,
            &self.depths,
            line,
            &self.probes,
        )
        .map(Some)
    }

    /// The loads of the increment as loads of a contact.
    fn states<'a>(&'a self, tractions: &'a [Tractions<'a>], stick: &'a [&'a [bool]]) -> States<'a> {
        States {
            tractions,
            sigma_B: std::slice::from_ref(&self.loads.sigma_B),
            residual: Some(&self.residual),
            eigenstress: &self.loads.eigenstress,
            stick: Some(stick),
            stop: self.stop.clone(),
            continuations: &[],
        }
    }

    /// The section along the shear, through the centre of the contact.
    fn main_section(&self) -> Line {
        let outline = Outline::new(&self.scene.grid, &self.loads.tractions());
        let outlines: Vec<&Outline> = outline.iter().collect();
        let lines = Line::for_outlines(&outlines, &[]);
        lines.first().copied().unwrap_or(Line::AlongX(0.0))
    }

    /// Computes a section. The largest values are below its line, or in the whole body if
    /// `anywhere`.
    fn section(&self, options: &Options, line: Line, anywhere: bool) -> Result<Vec<String>, Error> {
        let grid = &self.scene.grid;
        if is_image(options) {
            let allowed = "a Zarr folder: image data (.vti) is of a --volume";
            return Err(Error::invalid("--out", "a section", allowed));
        }
        let store = self.store(options, Some(line))?;
        let (tractions, stick) = ([self.loads.tractions()], self.loads.stick());
        let states = self.states(&tractions, &stick);
        let search = Search::new(self.body(), self.side, grid, Some(line), &states)?;
        let section = Section::new(self.body(), self.side, grid, line, states.clone())?;
        let (axis, along) = (line.name(), line.places(grid));
        let mut depths: Vec<Depth> = self.chosen.clone();
        depths.extend(self.depths.iter().filter(|d| !self.chosen.contains(d)));
        depths.sort_by(|a, b| a.z.total_cmp(&b.z).then(a.layer.cmp(&b.layer)));
        let rows: Vec<usize> = (0..depths.len())
            .filter(|n| self.depths.contains(&depths[*n]))
            .collect();
        let of_chosen: Vec<usize> = (0..depths.len())
            .filter(|n| self.chosen.contains(&depths[*n]))
            .collect();
        let values_and_largest = section.probe(&depths, &along, &self.probes, &search)?;
        let largest_of = self.largest();
        let mut lines = Vec::new();
        // All measures share one search.
        let mut kept_search: Option<BodySearch> = None;
        for (n, (probe, (values, largest))) in
            self.probes.iter().zip(&values_and_largest).enumerate()
        {
            if let Some(store) = &store {
                store.put_section(n, &values.select(Axis(0), &rows))?;
            }
            match probe {
                Probe::Stress(measure) if anywhere => {
                    let samples = values.select(Axis(0), &of_chosen);
                    let samples = samples.view();
                    let search = match kept_search.take_if(|search| search.serves_all_measures()) {
                        Some(search) => search,
                        None => BodySearch::new(
                            self.loaded_body(&states),
                            (line, true),
                            (&self.chosen, &samples),
                        )?,
                    };
                    let values_and_largest = search.find(measure, &samples, None)?;
                    kept_search = Some(search);
                    warn_of_rising_stress(probe, self.body(), &values_and_largest);
                    let axes: &[&str] = if grid.plane_strain {
                        &["x"]
                    } else {
                        &["x", "y"]
                    };
                    lines.extend(
                        values_and_largest
                            .largest
                            .map(|m| largest_of.line(probe, &m, axes)),
                    );
                }
                _ => lines.extend(largest.map(|m| largest_of.line(probe, &m, &[axis]))),
            }
        }
        store.map_or(Ok(()), StressStore::finish)?;
        Ok(lines)
    }

    /// The body under the loads of the increment.
    fn loaded_body<'a>(&'a self, states: &'a States<'a>) -> LoadedBody<'a> {
        LoadedBody {
            body: self.body(),
            side: self.side,
            grid: &self.scene.grid,
            states,
        }
    }

    /// Computes planes at all depths; returns the lines on the largest values.
    fn volume(&self, options: &Options) -> Result<Vec<String>, Error> {
        let grid = &self.scene.grid;
        let (mut image, mut store) = (None, None);
        match &options.out {
            Some(out) if is_image(options) => {
                let (depths, probes) = (&self.depths, &self.probes);
                image = Some(ImageData::create(out, grid, self.side, depths, probes)?);
            }
            _ => store = self.store(options, None)?,
        }
        let mut sinks: Vec<&dyn VolumeSink> = Vec::new();
        sinks.extend(image.as_ref().map(|i| i as &dyn VolumeSink));
        sinks.extend(store.as_ref().map(|s| s as &dyn VolumeSink));
        let (tractions, stick) = ([self.loads.tractions()], self.loads.stick());
        let states = self.states(&tractions, &stick);
        let search = Search::new(self.body(), self.side, grid, None, &states)?;
        let slices = Slices::new(self.body(), self.side, grid, states)?;
        let (depths, chosen) = (&self.depths, &self.chosen);
        let largest = write_volume(&slices, depths, chosen, &self.probes, &sinks, Some(&search))?;
        image.map_or(Ok(()), ImageData::finish)?;
        store.map_or(Ok(()), StressStore::finish)?;
        let largest_of = self.largest();
        let probes_and_largest = self.probes.iter().zip(&largest);
        let line = |(probe, m): (&Probe, &Option<_>)| {
            let m = m.as_ref()?;
            Some(largest_of.line(probe, m, &["x", "y"]))
        };
        Ok(probes_and_largest.filter_map(line).collect())
    }
}

/// Rejects a measure of interfaces for a body without interfaces.
fn check_interfaces(body: &Body, probes: &[Probe]) -> Result<(), Error> {
    let on_interfaces = |p: &&Probe| matches!(p, Probe::Stress(m) if m.on_interfaces);
    match probes.iter().find(on_interfaces) {
        Some(probe) if body.coatings.is_empty() => {
            let allowed = "another measure, or --body: this body has no coating and no interface";
            Err(Error::invalid("--of", probe.name(), allowed))
        }
        _ => Ok(()),
    }
}

/// Warns if the first interface is nearer to the surface than a cell is long: the tractions are
/// known per cell.
fn warn_of_thin_layer(scene: &Scene, body: &Body) {
    let cell = if scene.grid.plane_strain {
        scene.grid.dx
    } else {
        scene.grid.dx.min(scene.grid.dy)
    };
    if let Some(first) = body.interfaces().first().filter(|first| **first < cell) {
        print_message(&format!(
            "fret: warning: the first interface is {} below the surface, {:.2} cells: the \
             tractions are known per cell; a finer grid shows whether that matters",
            um(*first),
            first / cell
        ));
    }
}

/// Whether the file to write is image data (.vti).
fn is_image(options: &Options) -> bool {
    let extension = options.out.as_ref().and_then(|out| out.extension());
    extension.is_some_and(|e| e.eq_ignore_ascii_case("vti"))
}

/// Warns of layers whose stress still rises at the end of the longest section.
fn warn_of_rising_stress(probe: &Probe, body: &Body, maximum: &BodyMaximum) {
    let name = probe.name();
    for layer in &maximum.still_rises {
        let layer = body.layer_name(*layer);
        let consequence = if maximum.largest.is_some() {
            "a larger value may lie beyond; use a longer grid"
        } else {
            "it is negative and has no largest value near the contact"
        };
        print_message(&format!(
            "fret: warning: {name} in {layer} still rises 8 lengths of the grid away from it: {consequence}"
        ));
    }
}
