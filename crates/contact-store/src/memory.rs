//! A run kept in memory, with the contents of a store.

use contact_core::Error;
use contact_core::estimate::ErrorBars;
use contact_core::march::{Fields, Increment, March, Observer, Reached};
use contact_core::scene::{Grid, LoadPoint};
use ndarray::Array2;
use serde_json::{Map, Value};

use super::attributes::{conclude, group_attributes};
use super::catalogue::{FIELDS, FieldView, SCALARS, YIELDED, to_rows};
use super::error_bars::{doubt_bars, to_attributes};

/// The fields of one name of all increments that keep theirs, each of shape (nx, ny).
#[derive(Clone, Debug)]
pub enum KeptField {
    /// Real numbers.
    Real(Vec<Array2<f64>>),
    /// Yes or no.
    Mask(Vec<Array2<bool>>),
}

/// Collects a run as it is solved. Give it to [`contact_core::march::solve`].
#[derive(Default)]
pub struct Columns {
    /// The numbers of every increment, as in [`SCALARS`].
    pub scalars: Vec<Vec<f64>>,
    /// Increments whose fields are kept, from 1, and the path times at their ends.
    pub saved: Vec<(usize, f64)>,
    /// Their fields, as in [`FIELDS`].
    pub fields: Vec<KeptField>,
    /// The points that have yielded in them, as in [`YIELDED`](super::YIELDED); empty where no body may.
    pub points: Vec<Vec<f64>>,
    /// The attributes of the run.
    pub attributes: Map<String, Value>,
    last: Option<LoadPoint>,
    reached: Reached,
}

impl Columns {
    /// Adds the error bars of the branches, or the reason why there are none.
    pub fn set_error_bars(&mut self, bars: &Result<Vec<ErrorBars>, Error>, grid: &Grid) {
        match bars {
            Ok(bars) => drop(
                self.attributes
                    .insert("error_bars".into(), to_attributes(bars, grid)),
            ),
            Err(why) => drop(doubt_bars(&mut self.attributes, why)),
        }
    }

    /// Takes the attributes of a run that begins, and empties the columns.
    fn begin(&mut self, march: &March) {
        self.attributes = group_attributes(march.scene(), march.plan());
        self.scalars = SCALARS.iter().map(|_| Vec::new()).collect();
    }

    /// Keeps the fields of an increment.
    fn keep(&mut self, index: usize, t: f64, fields: &Fields) {
        self.saved.push((index, t));
        if let Some(yielded) = &fields.yielded {
            self.points.resize(YIELDED.len(), Vec::new());
            let rows = to_rows(index, yielded);
            for (column, rows) in self.points.iter_mut().zip(rows) {
                column.extend(rows);
            }
        }
        if self.fields.is_empty() {
            let none = FIELDS.iter().map(|field| match (field.values)(fields) {
                FieldView::Real(_) => KeptField::Real(Vec::new()),
                FieldView::Mask(_) => KeptField::Mask(Vec::new()),
            });
            self.fields = none.collect();
        }
        for (kept, field) in self.fields.iter_mut().zip(FIELDS) {
            match ((field.values)(fields), kept) {
                (FieldView::Real(values), KeptField::Real(kept)) => kept.push(values.clone()),
                (FieldView::Mask(values), KeptField::Mask(kept)) => kept.push(values.clone()),
                _ => {}
            }
        }
    }
}

impl Observer for Columns {
    /// Keeps the scalars of an increment, and its fields if the scene asks for them.
    fn on_increment(&mut self, march: &March, increment: &Increment) -> Result<(), Error> {
        if self.scalars.is_empty() {
            self.begin(march);
        }
        for (column, scalar) in self.scalars.iter_mut().zip(SCALARS) {
            column.push((scalar.value)(increment));
        }
        self.last = Some(increment.point);
        self.reached.see(increment);
        let last = increment.index == march.points().len();
        let save = &march.scene().settings.save;
        if save.keeps(&increment.point, increment.index, last) {
            self.keep(increment.index, increment.point.t, &march.fields());
        }
        Ok(())
    }

    /// Keeps the fields of the last increment in any case, and completes the attributes.
    fn on_end(&mut self, march: &March, failure: Option<&Error>) -> Result<(), Error> {
        let (index, saved) = (march.state().increments, self.saved.last());
        if failure.is_none()
            && saved.is_none_or(|(kept, _)| *kept != index)
            && let Some(point) = self.last
        {
            self.keep(index, point.t, &march.fields());
        }
        conclude(&mut self.attributes, march.scene(), &self.reached, failure);
        Ok(())
    }
}
