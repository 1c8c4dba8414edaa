//! One variable of the store: an array of Zarr version 2 that grows along its first dimension.

use std::fs::File;
use std::io::{self, BufReader, Read, Write};
use std::sync::Arc;

use flate2::read::MultiGzDecoder;
use rayon::prelude::*;
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
    /// The CRC-32 of the values of each chunk along the first dimension.
    checksums: Vec<u32>,
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

    /// The kind of a data type.
    fn named(dtype: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.dtype() == dtype)
    }

    /// Values as they stand in a chunk, little endian.
    fn encode(self, values: &[f64]) -> Vec<u8> {
        let each = values.iter();
        match self {
            Self::Real => each.flat_map(|v| v.to_le_bytes()).collect(),
            Self::Count => each.flat_map(|v| (*v as i32).to_le_bytes()).collect(),
            Self::Code => each.flat_map(|v| (*v as i8).to_le_bytes()).collect(),
            Self::Flag => each.map(|v| u8::from(*v != 0.0)).collect(),
        }
    }

    /// The CRC-32 of values as they stand in a chunk.
    fn checksum(self, values: &[f64]) -> u32 {
        crc32fast::hash(&self.encode(values))
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
            checksums: Vec::new(),
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

    pub(super) fn checksums(&self) -> &[u32] {
        &self.checksums
    }

    /// Takes over the checksums of chunks that are stored already.
    pub(super) fn set_checksums(&mut self, checksums: &[u32]) {
        self.checksums = checksums.to_vec();
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

    /// Stores a chunk of real numbers, the first along all dimensions but the first, converted to the
    /// variable's kind; a short one is filled up with zeros. Returns the checksum of the numbers.
    pub(super) fn store(
        &self,
        folder: &Arc<Folder>,
        chunk: &[u64],
        values: impl ExactSizeIterator<Item = f64>,
    ) -> Result<u32, Error> {
        let array = self.array(folder)?;
        let size = self.chunks.iter().product::<u64>() as usize;
        let mut values: Vec<f64> = values.take(size).collect();
        let checksum = self.kind.checksum(&values);
        values.resize(size, 0.0);
        // A chunk of zeros is stored like any other: there is no fill value to stand for it.
        let options = CodecOptions::default().with_store_empty_chunks(true);
        let counts = || values.iter().map(|v| *v as i32).collect::<Vec<_>>();
        let codes = || values.iter().map(|v| *v as i8).collect::<Vec<_>>();
        let flags = || values.iter().map(|v| *v != 0.0).collect::<Vec<_>>();
        match self.kind {
            Kind::Real => array.store_chunk_opt(chunk, &values, &options),
            Kind::Count => array.store_chunk_opt(chunk, counts(), &options),
            Kind::Code => array.store_chunk_opt(chunk, codes(), &options),
            Kind::Flag => array.store_chunk_opt(chunk, flags(), &options),
        }
        .map_err(|e| folder.error(&format!("{}: {e}", self.name)))?;
        Ok(checksum)
    }

    /// Stores the chunk `n` along the first dimension and keeps its checksum, which is the last one
    /// then.
    pub(super) fn store_last(
        &mut self,
        folder: &Arc<Folder>,
        n: usize,
        values: impl ExactSizeIterator<Item = f64>,
    ) -> Result<(), Error> {
        let mut chunk = vec![0; self.shape.len()];
        chunk[0] = n as u64;
        let checksum = self.store(folder, &chunk, values)?;
        self.checksums.truncate(n);
        self.checksums.push(checksum);
        Ok(())
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

/// An array of a store being read, with the checksums of its chunks.
pub(super) struct Stored<'a> {
    array: Array<Folder>,
    kind: Kind,
    checksums: &'a [u32],
}

impl<'a> Stored<'a> {
    pub(super) fn new(
        folder: &Arc<Folder>,
        name: &str,
        zarray: &Value,
        checksums: &'a [u32],
    ) -> Result<Self, Error> {
        let failed = |message: &str| folder.error(&format!("{name}: {message}"));
        let array = open_array(folder, name, zarray.clone())?;
        let kind = zarray["dtype"].as_str().and_then(Kind::named);
        let kind = kind.ok_or_else(|| failed("has numbers of an unknown type"))?;
        if array.shape().is_empty() {
            return Err(failed("has no dimension"));
        }
        Ok(Self {
            array,
            kind,
            checksums,
        })
    }

    pub(super) fn shape(&self) -> &[u64] {
        self.array.shape()
    }

    /// All of it.
    pub(super) fn all(&self) -> ArraySubset {
        self.array.subset_all()
    }

    /// Fails at the first chunk that is missing or damaged.
    pub(super) fn verify(&self, part: &ArraySubset) -> Result<(), String> {
        let chunks = self.array.chunks_in_array_subset(part);
        let chunks = chunks.map_err(|e| e.to_string())?;
        let chunks: Vec<_> = chunks.into_iter().flat_map(|c| c.indices()).collect();
        chunks.par_iter().try_for_each(|chunk| self.check(chunk))
    }

    /// Fails if a chunk is not there, if it would unfold to more than its values take, or if those
    /// that count are not the ones that were written.
    fn check(&self, chunk: &[u64]) -> Result<(), String> {
        let shape = self.array.chunk_shape(chunk).map_err(|e| e.to_string())?;
        let product = |n: Option<u64>, m: u64| n.and_then(|n| n.checked_mul(m));
        let values = shape.iter().map(|n| n.get()).fold(Some(1), product);
        let values = values.filter(|n| *n <= MOST_VALUES);
        let size = self.kind.bytes() * values.ok_or("has chunks larger than any grid")?;
        // A chunk reaches over the end of the first dimension alone.
        let row = size / shape[0].get();
        let begin = chunk[0].saturating_mul(shape[0].get());
        let rows = self.shape()[0].saturating_sub(begin).min(shape[0].get());
        let key = self.array.chunk_key(chunk);
        let failed = |e: &dyn std::fmt::Display| format!("the file {key} {e}");
        let damaged = |why: &dyn std::fmt::Display| failed(&format!("is damaged: {why}"));
        let path = self.array.storage().root().join(key.as_str());
        let file = match File::open(path) {
            Err(e) if e.kind() == io::ErrorKind::NotFound => return Err(failed(&"is missing")),
            file => file.map_err(|e| failed(&e))?,
        };
        let mut sum = Sum {
            counts: rows * row,
            crc: crc32fast::Hasher::new(),
        };
        let mut unfolded = MultiGzDecoder::new(BufReader::new(file)).take(size + 1);
        match io::copy(&mut unfolded, &mut sum) {
            Ok(n) if n == size => {}
            Ok(_) => return Err(damaged(&"it is of another length")),
            Err(e) => return Err(damaged(&e)),
        }
        let expected = self.checksums.get(chunk[0] as usize).copied();
        if expected != Some(sum.crc.finalize()) {
            return Err(damaged(&"its numbers are not those that were written"));
        }
        Ok(())
    }

    /// The numbers of a part, of whatever kind.
    pub(super) fn numbers(&self, part: &ArraySubset) -> Result<Vec<f64>, String> {
        self.verify(part)?;
        let array = &self.array;
        let f64s = match self.kind {
            Kind::Real => array.retrieve_array_subset(part),
            Kind::Count => of::<i32>(array, part, f64::from),
            Kind::Code => of::<i8>(array, part, f64::from),
            Kind::Flag => of::<bool>(array, part, |yes| f64::from(u8::from(yes))),
        };
        f64s.map_err(|e| e.to_string())
    }
}

/// Sums up the first bytes that it is given.
struct Sum {
    counts: u64,
    crc: crc32fast::Hasher,
}

impl Write for Sum {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.counts.min(bytes.len() as u64);
        self.crc.update(&bytes[..count as usize]);
        self.counts -= count;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
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
            let values = values.iter().copied();
            self.variable.store_last(folder, first + i, values)?;
        }
        let full = self.tail.len() / chunk * chunk;
        self.tail.drain(..full);
        Ok(())
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
