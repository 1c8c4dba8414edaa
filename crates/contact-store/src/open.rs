//! A store during the run: the scalars of its increments, its saved fields, its metadata.

use std::sync::Arc;
use std::time::{Duration, Instant};

use contact_core::Error;
use contact_core::march::{Fields, Increment, Reached, State};
use contact_core::plan::Plan;
use contact_core::scene::{LoadPoint, Scene};
use rayon::prelude::*;
use serde_json::{Map, Value, json};

use super::attributes::group_attributes;
use super::catalogue::{
    AXES, FIELDS, FieldView, Kind, POINTS, SCALARS, STATUS_MEANINGS, YIELDED, to_rows,
};
use super::checkpoint::Checkpoints;
use super::consolidated::{Checksums, Consolidated, FILE};
use super::folder::Folder;
use super::place::PendingFolder;
use super::{column::Column, variable::Variable};

/// Largest part of the time that goes to checkpoints.
const MAX_TIME_SHARE: f64 = 0.03;
/// Assumed cost of a checkpoint before one has been timed.
const FIRST_COST: Duration = Duration::from_millis(30);

/// Variables that readers take for coordinates.
const COORDINATES: &str = "t branch_of_increment saved_increment saved_t";

/// A store during the run.
pub(super) struct Open {
    pub(super) folder: Arc<Folder>,
    pub(super) attributes: Map<String, Value>,
    /// Over `increment`, as in [`SCALARS`].
    scalars: Vec<Column>,
    /// x, y, `saved_increment`, `saved_t`.
    others: Vec<Column>,
    fields: Vec<Variable>,
    /// Over the points that have yielded, as in [`YIELDED`]; none where no body may.
    points: Vec<Column>,
    last: Option<(usize, LoadPoint)>,
    /// The largest errors over the increments.
    pub(super) reached: Reached,
    saved: usize,
    pub(super) saved_increment: usize,
    /// Metadata as they were last written.
    written: Consolidated,
    pub(super) checkpoints: Option<Checkpoints>,
    /// Increments that the store on the disk holds.
    pub(super) on_disk: usize,
    /// When the last checkpoint was written, and how long that took.
    last_checkpoint: Instant,
    cost: Duration,
    /// Checkpoints so far, and how long they took together.
    pub(super) checkpoints_so_far: (usize, Duration),
}

impl Open {
    /// A store for a run of the scene, with empty columns; nothing is written yet.
    pub(super) fn new(folder: Arc<Folder>, scene: &Scene, plan: &Plan) -> Self {
        let grid = &scene.grid;
        let scalars = SCALARS.iter().map(|s| {
            let s = s.for_grid(grid);
            let codes = [
                ("flag_values", json!([0, 1, 2, 3])),
                ("flag_meanings", json!(STATUS_MEANINGS)),
            ];
            let attributes = if s.kind == Kind::Code {
                &codes[..]
            } else {
                &[]
            };
            Column::new(
                s.name,
                s.kind,
                (s.units, s.long_name),
                "increment",
                attributes,
            )
        });
        let others = AXES.iter().map(|of| {
            let column = Column::new(of.name, of.kind, (of.units, of.long_name), of.dim, &[]);
            match of.name {
                "x" => column.extend((0..grid.nx).map(|i| grid.x(i))),
                "y" => column.extend((0..grid.ny).map(|j| grid.y(j))),
                _ => column,
            }
        });
        let fields = FIELDS
            .iter()
            .map(|f| Variable::field(f.name, f.kind, (f.units, f.long_name), (grid.nx, grid.ny)));
        let may_yield = YIELDED.iter().filter(|_| scene.yields());
        let points =
            may_yield.map(|p| Column::new(p.name, p.kind, (p.units, p.long_name), POINTS, &[]));
        let mut attributes = group_attributes(scene, plan);
        attributes.insert("coordinates".into(), json!(COORDINATES));
        Self {
            folder,
            attributes,
            scalars: scalars.collect(),
            others: others.collect(),
            fields: fields.collect(),
            points: points.collect(),
            last: None,
            reached: Reached::default(),
            saved: 0,
            saved_increment: 0,
            written: Consolidated::default(),
            checkpoints: None,
            on_disk: 0,
            last_checkpoint: Instant::now(),
            cost: FIRST_COST,
            checkpoints_so_far: (0, Duration::ZERO),
        }
    }

    /// Creates the folder, with the group but without a variable, and a place for checkpoints, and moves it to
    /// its final place. If `replace`, an old store there is replaced.
    pub(super) fn begin(&mut self, replace: bool) -> Result<(), Error> {
        let unfinished = PendingFolder::begin(self.folder.root())?;
        let final_folder = std::mem::replace(&mut self.folder, unfinished.folder().clone());
        self.write_metadata(Consolidated {
            documents: self.group_documents(),
            checksums: Checksums::new(),
        })?;
        self.folder = final_folder;
        let scene = self.attributes["scene"].as_str().unwrap_or_default();
        let checkpoints = Checkpoints::begin(unfinished.folder(), scene)?;
        unfinished.finish(replace)?;
        self.checkpoints = Some(checkpoints.moved_to(&self.folder));
        Ok(())
    }

    /// Restores the state from an interrupted run: its increments, the store on the disk with
    /// `on_disk` of them or more and these checksums, and the points that have yielded. `keeps`
    /// selects the increments that keep their fields.
    pub(super) fn restore(
        &mut self,
        checkpoints: Checkpoints,
        increments: &[Increment],
        (on_disk, checksums): (usize, &Checksums),
        points: &[Vec<f64>],
        keeps: impl Fn(&Increment) -> bool,
    ) {
        let kept: Vec<usize> = increments
            .iter()
            .filter(|i| keeps(i))
            .map(|i| i.index)
            .collect();
        if let Some(of) = points.first() {
            for (column, values) in self.points.iter_mut().zip(points) {
                let rows = of.iter().zip(values);
                let rows_kept =
                    rows.filter(|(increment, _)| kept.contains(&(**increment as usize)));
                rows_kept.for_each(|(_, value)| column.push(*value));
            }
        }
        self.checkpoints = Some(checkpoints);
        self.on_disk = on_disk;
        for increment in increments {
            self.append_scalars(increment);
            if keeps(increment) {
                self.count_saved(increment.index, &increment.point);
            }
        }
        for field in &mut self.fields {
            let of_field = checksums.get(field.name()).map_or(&[][..], Vec::as_slice);
            field.set_checksums(&of_field[..self.saved.min(of_field.len())]);
        }
    }

    /// Appends an increment to the columns.
    pub(super) fn append(&mut self, increment: &Increment) -> Result<(), Error> {
        self.append_scalars(increment);
        match &mut self.checkpoints {
            Some(checkpoints) => checkpoints.push(increment),
            None => Ok(()),
        }
    }

    /// Appends the scalars of an increment.
    fn append_scalars(&mut self, increment: &Increment) {
        for (column, scalar) in self.scalars.iter_mut().zip(SCALARS) {
            column.push((scalar.value)(increment));
        }
        self.last = Some((increment.index, increment.point));
        self.reached.see(increment);
    }

    /// Whether a checkpoint is to be written now.
    pub(super) fn is_due(&self, interval: Duration, ends_branch: bool) -> bool {
        let elapsed = self.last_checkpoint.elapsed();
        interval.is_zero()
            || ((ends_branch || elapsed >= interval)
                && elapsed.mul_f64(MAX_TIME_SHARE) >= self.cost)
    }

    /// Brings the store up to date, then writes the checkpoint, so that it is never ahead of the
    /// store.
    pub(super) fn checkpoint(&mut self, state: &State) -> Result<(), Error> {
        let begun = Instant::now();
        self.flush()?;
        if let Some(checkpoints) = &mut self.checkpoints {
            checkpoints.write(state)?;
        }
        self.last_checkpoint = Instant::now();
        self.cost = self.last_checkpoint - begun;
        let (count, time) = &mut self.checkpoints_so_far;
        (*count, *time) = (*count + 1, *time + self.cost);
        Ok(())
    }

    /// Stores the fields of the last increment; they belong to the store from the next flush on.
    pub(super) fn save(&mut self, fields: &Fields) -> Result<(), Error> {
        let Some((index, point)) = self.last else {
            return Ok(());
        };
        let (folder, saved) = (&self.folder, self.saved);
        self.fields
            .par_iter_mut()
            .zip(FIELDS)
            .try_for_each(|(variable, field)| match (field.values)(fields) {
                FieldView::Real(f) => variable.store_last(folder, saved, f.iter().copied()),
                FieldView::Mask(f) => {
                    let values = f.iter().map(|&yes| f64::from(u8::from(yes)));
                    variable.store_last(folder, saved, values)
                }
            })?;
        if let Some(yielded) = &fields.yielded {
            for (column, rows) in self.points.iter_mut().zip(to_rows(index, yielded)) {
                for value in rows {
                    column.push(value);
                }
            }
        }
        self.count_saved(index, &point);
        Ok(())
    }

    /// Notes that the fields of an increment are saved: its index and path time.
    fn count_saved(&mut self, index: usize, point: &LoadPoint) {
        self.saved += 1;
        self.saved_increment = index;
        for variable in &mut self.fields {
            variable.set_length(self.saved);
        }
        for column in &mut self.others {
            match column.variable().name() {
                "saved_increment" => column.push(index as f64),
                "saved_t" => column.push(point.t),
                _ => {}
            }
        }
    }

    /// Brings the store up to date: values, then the metadata of each array, then the
    /// consolidated metadata that makes all of it count at once. A store that holds more, since
    /// the run went on from an older checkpoint, keeps it; only its status changes.
    pub(super) fn flush(&mut self) -> Result<(), Error> {
        let solved = self.last.map_or(0, |(index, _)| index);
        if solved < self.on_disk {
            let mut metadata = self.written.clone();
            let attributes = Value::Object(self.attributes.clone());
            metadata.documents.insert(".zattrs".into(), attributes);
            return self.write_metadata(metadata);
        }
        let (scalars, others) = (&mut self.scalars, &mut self.others);
        let columns = scalars.iter_mut().chain(others).chain(&mut self.points);
        let mut columns: Vec<_> = columns.collect();
        columns
            .par_iter_mut()
            .try_for_each(|column| column.flush(&self.folder))?;
        let (mut documents, mut checksums) = (self.group_documents(), Checksums::new());
        let columns = self.scalars.iter().chain(&self.others).chain(&self.points);
        for variable in columns.map(Column::variable).chain(&self.fields) {
            let name = variable.name();
            documents.insert(format!("{name}/.zarray"), variable.zarray());
            documents.insert(format!("{name}/.zattrs"), variable.attributes());
            checksums.insert(name.to_owned(), variable.checksums().to_vec());
        }
        self.write_metadata(Consolidated {
            documents,
            checksums,
        })?;
        self.on_disk = solved;
        Ok(())
    }

    /// The metadata documents of the group.
    fn group_documents(&self) -> Map<String, Value> {
        let mut documents = Map::new();
        documents.insert(".zgroup".into(), json!({ "zarr_format": 2 }));
        documents.insert(".zattrs".into(), Value::Object(self.attributes.clone()));
        documents
    }

    /// Writes the metadata documents that have changed, and all of them as consolidated metadata.
    pub(super) fn write_metadata(&mut self, metadata: Consolidated) -> Result<(), Error> {
        let changed = (metadata.documents.iter())
            .filter(|(key, document)| self.written.documents.get(*key) != Some(document));
        (changed.collect::<Vec<_>>().par_iter())
            .try_for_each(|(key, document)| self.folder.put(key, &format!("{document:#}")))?;
        self.folder.put(FILE, &metadata.encode())?;
        self.written = metadata;
        Ok(())
    }
}
