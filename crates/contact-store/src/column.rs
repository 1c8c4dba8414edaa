//! A variable of one number per increment.

use std::sync::Arc;

use contact_core::Error;
use serde_json::Value;

use super::catalogue::Kind;
use super::folder::Folder;
use super::variable::Variable;

/// Increments in a chunk of a scalar.
const SCALAR_CHUNK: u64 = 1024;

/// A variable of one dimension whose values come one by one.
pub(super) struct Column {
    variable: Variable,
    /// Values of the chunks that are not full.
    tail: Vec<f64>,
    /// Values in all.
    length: usize,
}

impl Column {
    pub(super) fn new(
        name: &'static str,
        kind: Kind,
        words: (&str, &str),
        dim: &str,
        attributes: &[(&str, Value)],
    ) -> Self {
        let variable = Variable::new(name, kind, words, &[dim], vec![0], vec![SCALAR_CHUNK]);
        let variable = attributes.iter().fold(variable, |v, (key, value)| {
            v.with_attribute(key, value.clone())
        });
        Self {
            variable,
            tail: Vec::new(),
            length: 0,
        }
    }

    pub(super) fn push(&mut self, value: f64) {
        self.tail.push(value);
        self.length += 1;
    }

    pub(super) fn extend(mut self, values: impl Iterator<Item = f64>) -> Self {
        values.for_each(|value| self.push(value));
        self
    }

    /// Stores what came since the last flush; the metadata is left to the caller.
    pub(super) fn flush(&mut self, folder: &Arc<Folder>) -> Result<(), Error> {
        self.variable.set_length(self.length);
        let chunk = SCALAR_CHUNK as usize;
        let first = (self.length - self.tail.len()) / chunk;
        for (i, values) in self.tail.chunks(chunk).enumerate() {
            let values = values.iter().copied();
            self.variable.store_last(folder, first + i, values)?;
        }
        let full = self.tail.len() / chunk * chunk;
        self.tail.drain(..full);
        Ok(())
    }

    /// The values, of a column that is not flushed.
    pub(super) fn values(&self) -> &[f64] {
        &self.tail
    }

    pub(super) fn variable(&self) -> &Variable {
        &self.variable
    }

    /// The checksums of a column of these values.
    pub(super) fn checksums_of(kind: Kind, values: &[f64]) -> Vec<u32> {
        let chunks = values.chunks(SCALAR_CHUNK as usize);
        chunks.map(|chunk| kind.checksum(chunk)).collect()
    }
}
