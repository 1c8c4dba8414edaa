//! A variable of one number per increment.

use std::sync::Arc;

use contact_core::Error;
use serde_json::Value;

use super::catalogue::{Kind, POINTS};
use super::folder::Folder;
use super::variable::Variable;

/// Increments in a chunk of a scalar.
pub(super) const SCALAR_CHUNK: usize = 1024;
/// Points in a chunk of a column over points.
pub(super) const POINT_CHUNK: usize = 1 << 15;

/// A variable of one dimension with a growing number of values.
pub(super) struct Column {
    variable: Variable,
    /// Values in a chunk.
    chunk: usize,
    /// Values of the chunks that are not full.
    tail: Vec<f64>,
    /// Values in all.
    length: usize,
}

impl Column {
    /// An empty column with its description; `words` are unit and meaning, `dim` its dimension.
    pub(super) fn new(
        name: &'static str,
        kind: Kind,
        words: (&str, &str),
        dim: &str,
        attributes: &[(&str, Value)],
    ) -> Self {
        let chunk = if dim == POINTS {
            POINT_CHUNK
        } else {
            SCALAR_CHUNK
        };
        let variable = Variable::new(name, kind, words, &[dim], vec![0], vec![chunk as u64]);
        let variable = attributes.iter().fold(variable, |v, (key, value)| {
            v.with_attribute(key, value.clone())
        });
        Self {
            variable,
            chunk,
            tail: Vec::new(),
            length: 0,
        }
    }

    /// Appends a value.
    pub(super) fn push(&mut self, value: f64) {
        self.tail.push(value);
        self.length += 1;
    }

    /// Appends values.
    pub(super) fn extend(mut self, values: impl Iterator<Item = f64>) -> Self {
        values.for_each(|value| self.push(value));
        self
    }

    /// Stores the values since the last flush; the caller writes the metadata.
    pub(super) fn flush(&mut self, folder: &Arc<Folder>) -> Result<(), Error> {
        self.variable.set_length(self.length);
        let chunk = self.chunk;
        let first = (self.length - self.tail.len()) / chunk;
        for (i, values) in self.tail.chunks(chunk).enumerate() {
            let values = values.iter().copied();
            self.variable.store_last(folder, first + i, values)?;
        }
        let full = self.tail.len() / chunk * chunk;
        self.tail.drain(..full);
        Ok(())
    }

    /// The values since the last flush; all values of a column that is never flushed.
    pub(super) fn values(&self) -> &[f64] {
        &self.tail
    }

    /// The description of the column.
    pub(super) fn variable(&self) -> &Variable {
        &self.variable
    }

    /// The checksums of a column with these values, for chunks of `chunk` values.
    pub(super) fn checksums_of_chunks(kind: Kind, values: &[f64], chunk: usize) -> Vec<u32> {
        let chunks = values.chunks(chunk);
        chunks.map(|chunk| kind.checksum(chunk)).collect()
    }
}
