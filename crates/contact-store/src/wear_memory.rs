//! A run of wear kept in memory, with the contents of a store.

use contact_wear::WearRun;
use serde_json::Value;

use super::catalogue::Kind;
use super::variable::Variable;
use super::wear_store::{attributes, columns, fields};

/// A variable of a run, as a store would hold it.
pub struct StoredVariable {
    /// Its name.
    pub name: &'static str,
    /// Type of its numbers.
    pub kind: Kind,
    /// Its shape.
    pub shape: Vec<usize>,
    /// Dimensions (`_ARRAY_DIMENSIONS`), unit and meaning.
    pub attributes: Value,
    /// Its numbers, the last dimension first.
    pub values: Vec<f64>,
}

impl StoredVariable {
    /// A variable of this shape with its values.
    fn new(variable: &Variable, shape: Vec<usize>, values: Vec<f64>) -> Self {
        Self {
            name: variable.name(),
            kind: variable.kind(),
            shape,
            attributes: variable.attributes(),
            values,
        }
    }
}

/// Collects the blocks of a run of wear while it runs.
#[derive(Default)]
pub struct WearColumns {
    cycles: Vec<f64>,
    /// The fields of all blocks, in the order of the catalogue.
    fields: Vec<Vec<f64>>,
}

impl WearColumns {
    /// Keeps the current block of the run, if it is one to be kept.
    pub fn keep(&mut self, run: &mut WearRun) {
        if !run.takes_block() {
            return;
        }
        let block = run.block();
        let now = fields(run, &block, 1);
        self.fields.resize(now.len(), Vec::new());
        for (kept, (_, values)) in self.fields.iter_mut().zip(now) {
            kept.extend(values);
        }
        self.cycles.push(block.cycles);
    }

    /// The variables of the run, and the attributes of a store that ended with `status`.
    pub fn finish(self, run: &WearRun, status: &str) -> (Vec<StoredVariable>, Value) {
        let scalars = columns(run, &self.cycles);
        let scalars = scalars.iter().map(|column| {
            let values = column.values().to_vec();
            StoredVariable::new(column.variable(), vec![values.len()], values)
        });
        let blocks = fields(run, &run.block(), self.cycles.len());
        let fields = blocks.iter().zip(self.fields);
        let fields = fields
            .map(|((variable, _), values)| StoredVariable::new(variable, variable.shape(), values));
        (scalars.chain(fields).collect(), attributes(run, status))
    }
}
