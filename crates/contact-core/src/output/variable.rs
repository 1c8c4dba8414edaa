//! One variable of the store: an array of Zarr version 2 that grows along its first dimension.

use std::fs::File;
use std::io::{self, BufReader, Read};
use std::sync::Arc;

use flate2::read::MultiGzDecoder;
use serde_json::{Map, Value, json};
use zarrs::array::{
    Array, ArrayError, ArrayMetadata, ArrayMetadataV2, ArraySubset, CodecOptions, ElementOwned,
};

use super::catalogue::Kind;
use super::folder::Folder;
use crate::error::Error;

/// Increments in a chunk of a scalar.
const SCALAR_CHUNK: u64 = 1024;
/// Effort of the compressor, 1 to 9: the fields are full-precision numbers and hardly shrink more.
const GZIP_LEVEL: u32 = 1;

/// Name, dimensions and attributes of an array, and its present shape.
pub(super) struct Variable {
    name: &'static str,
    kind: Kind,
    shape: Vec<u64>,
    chunks: Vec<u64>,
    attributes: Map<String, Value>,
}

impl Kind {
    const ALL: [Self; 4] = [Self::Real, Self::Count, Self::Code, Self::Flag];

    /// The data type of Zarr version 2.
    fn dtype(self) -> &'static str {
        match self {
            Self::Real => "<f8",
            Self::Count => "<i4",
            Self::Code => "|i1",
            Self::Flag => "|b1",
        }
    }

    /// Bytes of a value.
    fn bytes(self) -> u64 {
        match self {
            Self::Real => 8,
            Self::Count => 4,
            Self::Code | Self::Flag => 1,
        }
    }
}

impl Variable {
    pub(super) fn new(
        name: &'static str,
        kind: Kind,
        (units, long_name): (&str, &str),
        dims: &[&str],
        shape: Vec<u64>,
        chunks: Vec<u64>,
    ) -> Self {
        let mut attributes = Map::new();
        attributes.insert("_ARRAY_DIMENSIONS".into(), json!(dims));
        attributes.insert("units".into(), json!(units));
        attributes.insert("long_name".into(), json!(long_name));
        Self {
            name,
            kind,
            shape,
            chunks,
            attributes,
        }
    }

    /// A field over `saved`, `x`, `y`: one chunk per saved increment.
    pub(super) fn field(
        name: &'static str,
        kind: Kind,
        words: (&str, &str),
        (nx, ny): (usize, usize),
    ) -> Self {
        let (nx, ny) = (nx as u64, ny as u64);
        let dims = ["saved", "x", "y"];
        Self::new(name, kind, words, &dims, vec![0, nx, ny], vec![1, nx, ny])
    }

    pub(super) fn with_attribute(mut self, key: &str, value: Value) -> Self {
        self.attributes.insert(key.to_owned(), value);
        self
    }

    pub(super) fn name(&self) -> &'static str {
        self.name
    }

    /// Sets the length of the first dimension.
    pub(super) fn set_length(&mut self, length: usize) {
        self.shape[0] = length as u64;
    }

    pub(super) fn attributes(&self) -> Value {
        Value::Object(self.attributes.clone())
    }

    /// The content of `.zarray`. Without a fill value, so that no reader takes a zero for a gap.
    pub(super) fn zarray(&self) -> Value {
        json!({
            "zarr_format": 2,
            "shape": self.shape,
            "chunks": self.chunks,
            "dtype": self.kind.dtype(),
            "compressor": { "id": "gzip", "level": GZIP_LEVEL },
            "fill_value": null,
            "order": "C",
            "filters": null,
            "dimension_separator": ".",
        })
    }

    fn array(&self, folder: &Arc<Folder>) -> Result<Array<Folder>, Error> {
        open_array(folder, self.name, self.zarray())
    }

    /// Stores one chunk of real numbers, converted to the variable's kind; a short one is filled
    /// up with zeros.
    pub(super) fn store(
        &self,
        folder: &Arc<Folder>,
        chunk: &[u64],
        values: impl ExactSizeIterator<Item = f64>,
    ) -> Result<(), Error> {
        let array = self.array(folder)?;
        let size = self.chunks.iter().product::<u64>() as usize;
        let values = values.chain(std::iter::repeat(0.0)).take(size);
        // A chunk of zeros is stored like any other: there is no fill value to stand for it.
        let options = CodecOptions::default().with_store_empty_chunks(true);
        match self.kind {
            Kind::Real => array.store_chunk_opt(chunk, values.collect::<Vec<_>>(), &options),
            Kind::Count => array.store_chunk_opt(
                chunk,
                values.map(|v| v as i32).collect::<Vec<_>>(),
                &options,
            ),
            Kind::Code => {
                array.store_chunk_opt(chunk, values.map(|v| v as i8).collect::<Vec<_>>(), &options)
            }
            Kind::Flag => array.store_chunk_opt(
                chunk,
                values.map(|v| v != 0.0).collect::<Vec<_>>(),
                &options,
            ),
        }
        .map_err(|e| folder.error(&format!("{}: {e}", self.name)))
    }
}

/// The array of a `.zarray`.
pub(super) fn open_array(
    folder: &Arc<Folder>,
    name: &str,
    zarray: Value,
) -> Result<Array<Folder>, Error> {
    let failed = |e: &dyn std::fmt::Display| folder.error(&format!("{name}: {e}"));
    let metadata: ArrayMetadataV2 = serde_json::from_value(zarray).map_err(|e| failed(&e))?;
    Array::new_with_metadata(
        folder.clone(),
        &format!("/{name}"),
        ArrayMetadata::V2(metadata),
    )
    .map_err(|e| failed(&e))
}

/// Largest number of values in a chunk: that of a field of the largest grid.
const MOST_VALUES: u64 = 1 << 28;

/// Fails if a chunk is not there, or if it would unfold to more than its values take: what is
/// written in a file need not be what the store says.
fn check_chunk(array: &Array<Folder>, chunk: &[u64], kind: Kind) -> Result<(), String> {
    let values: Option<u64> = array
        .chunk_shape(chunk)
        .map_err(|e| e.to_string())?
        .iter()
        .try_fold(1_u64, |product, n| product.checked_mul(n.get()));
    let values = values.filter(|n| *n <= MOST_VALUES);
    let size = kind.bytes() * values.ok_or("has chunks larger than any grid")?;
    let key = array.chunk_key(chunk);
    let failed = |e: &dyn std::fmt::Display| format!("the file {key} {e}");
    let path = array.storage().root().join(key.as_str());
    let file = match File::open(path) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Err(failed(&"is missing")),
        file => file.map_err(|e| failed(&e))?,
    };
    let unfolded = io::copy(
        &mut MultiGzDecoder::new(BufReader::new(file)).take(size + 1),
        &mut io::sink(),
    );
    match unfolded {
        Ok(n) if n == size => Ok(()),
        Ok(_) => Err(failed(&"is damaged: it is of another length")),
        Err(e) => Err(failed(&format!("is damaged: {e}"))),
    }
}

/// The numbers of a part of an array, of whatever kind.
pub(super) fn numbers(
    array: &Array<Folder>,
    dtype: Option<&str>,
    part: &ArraySubset,
) -> Result<Vec<f64>, String> {
    let kind = Kind::ALL
        .into_iter()
        .find(|kind| Some(kind.dtype()) == dtype);
    let kind = kind.ok_or("has numbers of an unknown type")?;
    let chunks = array.chunks_in_array_subset(part);
    for chunk in chunks
        .map_err(|e| e.to_string())?
        .into_iter()
        .flat_map(|c| c.indices())
    {
        check_chunk(array, &chunk, kind)?;
    }
    let f64s = match kind {
        Kind::Real => array.retrieve_array_subset(part),
        Kind::Count => of::<i32>(array, part, f64::from),
        Kind::Code => of::<i8>(array, part, f64::from),
        Kind::Flag => of::<bool>(array, part, |yes| f64::from(u8::from(yes))),
    };
    f64s.map_err(|e| e.to_string())
}

fn of<T: ElementOwned>(
    array: &Array<Folder>,
    part: &ArraySubset,
    to_f64: impl Fn(T) -> f64,
) -> Result<Vec<f64>, ArrayError> {
    let values: Vec<T> = array.retrieve_array_subset(part)?;
    Ok(values.into_iter().map(to_f64).collect())
}

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
            self.variable
                .store(folder, &[(first + i) as u64], values.iter().copied())?;
        }
        let full = self.tail.len() / chunk * chunk;
        self.tail.drain(..full);
        Ok(())
    }

    pub(super) fn variable(&self) -> &Variable {
        &self.variable
    }
}
