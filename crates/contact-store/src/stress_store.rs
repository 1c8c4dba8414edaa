//! Stress and displacement below the surface as a Zarr group, over (`depth`, `x`, `y`) or along a
//! line.

use std::path::Path;
use std::sync::{Mutex, PoisonError};

use contact_core::Error;
use contact_core::scene::Grid;
use contact_subsurface::{Depth, Line, Probe, Side};
use ndarray::Array2;
use serde_json::{Map, Value, json};

use super::catalogue::Kind;
use super::consolidated::{Consolidated, FILE};
use super::folder::Folder;
use super::place::PendingFolder;
use super::schema::{CONVENTIONS, SCHEMA};
use super::volume::VolumeSink;
use super::{column::Column, variable::Variable};

/// A group being written; [`Self::finish`] moves it to its place.
pub struct StressStore {
    unfinished: PendingFolder,
    attributes: Map<String, Value>,
    coordinates: Vec<Column>,
    variables: Vec<Variable>,
    /// Files of one array are replaced one at a time.
    writing: Mutex<()>,
}

impl StressStore {
    /// Begins the group at `path`, which must not exist, for `probes` at `depths` of a volume, or
    /// below `line`. `title` is the title of the contact.
    pub fn create(
        path: impl AsRef<Path>,
        title: &str,
        grid: &Grid,
        side: Side,
        depths: &[Depth],
        line: Option<Line>,
        probes: &[Probe],
    ) -> Result<Self, Error> {
        let path = path.as_ref();
        if path.exists() {
            return Err(Folder::new(path).error(&"exists: choose another path"));
        }
        let unfinished = PendingFolder::begin(path)?;
        let mut shape = vec![depths.len() as u64];
        let mut dims = vec!["depth"];
        let mut coordinates = vec![
            Column::new(
                "z",
                Kind::Real,
                ("m", "depth below the surface"),
                "depth",
                &[],
            )
            .extend(depths.iter().map(|d| d.z)),
            Column::new(
                "layer",
                Kind::Count,
                ("1", "layer from the surface down, the substrate last"),
                "depth",
                &[],
            )
            .extend(depths.iter().map(|d| d.layer as f64)),
        ];
        let lines = match line {
            None => vec![Line::AlongX(0.0), Line::AlongY(0.0)],
            Some(line) => vec![line],
        };
        for line in lines {
            let (name, places) = (line.name(), line.places(grid));
            let meaning = format!("position along {name}");
            shape.push(places.len() as u64);
            dims.push(name);
            let column = Column::new(name, Kind::Real, ("m", &meaning), name, &[]);
            coordinates.push(column.extend(places.into_iter()));
        }
        let chunks = match line {
            // A plane is one chunk, a section too.
            None => [vec![1], shape[1..].to_vec()].concat(),
            Some(_) => shape.clone(),
        };
        let variable = |p: &Probe| {
            Variable::new(
                p.name(),
                Kind::Real,
                (p.unit(), p.long_name()),
                &dims,
                shape.clone(),
                chunks.clone(),
            )
        };
        let mut attributes = Map::new();
        attributes.insert("Conventions".into(), json!(CONVENTIONS));
        attributes.insert("title".into(), json!(title));
        attributes.insert("schema".into(), json!(SCHEMA));
        attributes.insert("version".into(), json!(env!("CARGO_PKG_VERSION")));
        let body = if side == Side::Body1 { 1 } else { 2 };
        attributes.insert("body".into(), json!(body));
        match line {
            None => {}
            Some(Line::AlongX(y)) => drop(attributes.insert("y".into(), json!(y))),
            Some(Line::AlongY(x)) => drop(attributes.insert("x".into(), json!(x))),
            Some(Line::Through { x, y, azimuth }) => {
                let line_attributes = [("x", x), ("y", y), ("azimuth", azimuth)];
                attributes.extend(line_attributes.map(|(name, v)| (name.into(), json!(v))));
            }
        }
        attributes.insert("coordinates".into(), json!("z layer"));
        Ok(Self {
            unfinished,
            attributes,
            coordinates,
            variables: probes.iter().map(variable).collect(),
            writing: Mutex::new(()),
        })
    }

    /// Stores a probe on a section, shape (depths, places).
    pub fn put_section(&self, probe: usize, values: &Array2<f64>) -> Result<(), Error> {
        let folder = self.unfinished.folder();
        let values = values.iter().copied();
        self.variables[probe]
            .store(folder, &[0, 0], values)
            .map(drop)
    }

    /// Writes coordinates and metadata and moves the group to its place.
    pub fn finish(mut self) -> Result<(), Error> {
        let mut documents = Map::new();
        documents.insert(".zgroup".into(), json!({ "zarr_format": 2 }));
        documents.insert(".zattrs".into(), Value::Object(self.attributes.clone()));
        for column in &mut self.coordinates {
            column.flush(self.unfinished.folder())?;
        }
        let columns = self.coordinates.iter().map(Column::variable);
        for variable in columns.chain(&self.variables) {
            let name = variable.name();
            documents.insert(format!("{name}/.zarray"), variable.zarray());
            documents.insert(format!("{name}/.zattrs"), variable.attributes());
        }
        let folder = self.unfinished.folder();
        for (key, document) in &documents {
            folder.put(key, &format!("{document:#}"))?;
        }
        let metadata = Consolidated {
            documents,
            ..Consolidated::default()
        };
        folder.put(FILE, &metadata.encode())?;
        self.unfinished.finish(false).map(drop)
    }
}

impl VolumeSink for StressStore {
    /// Writes the values of a probe at a depth.
    fn put(&self, probe: usize, depth: usize, values: &Array2<f64>) -> Result<(), Error> {
        let _one = self.writing.lock().unwrap_or_else(PoisonError::into_inner);
        let (folder, chunk) = (self.unfinished.folder(), [depth as u64, 0, 0]);
        let values = values.iter().copied();
        self.variables[probe]
            .store(folder, &chunk, values)
            .map(drop)
    }
}
