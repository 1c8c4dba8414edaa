//! One variable of the store: an array of Zarr version 2 that grows along its first dimension.

use std::sync::Arc;

use contact_core::Error;
use serde_json::{Map, Value, json};
use zarrs::array::{Array, ArrayMetadata, ArrayMetadataV2, CodecOptions};

use super::catalogue::Kind;
use super::folder::Folder;

/// Effort of the compressor, 1 to 9: the fields are full-precision numbers and hardly shrink more.
const LEVEL: u32 = 1;

/// Data type of flags that xarray writes.
pub(super) const BOOLEAN: &str = "|b1";

/// Compressors of stores. This program writes zlib, which netCDF-C reads as well; xarray writes gzip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compressor {
    None,
    Gzip,
    Zlib,
}

impl Compressor {
    /// Finds the compressor of a `.zarray`.
    pub(super) fn from_zarray(zarray: &Value) -> Option<Self> {
        let compressor = &zarray["compressor"];
        match compressor["id"].as_str() {
            _ if compressor.is_null() => Some(Self::None),
            Some("gzip") => Some(Self::Gzip),
            Some("zlib") => Some(Self::Zlib),
            _ => None,
        }
    }
}

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

    /// The data type in Zarr version 2.
    fn dtype(self) -> &'static str {
        match self {
            Self::Real => "<f8",
            Self::Count => "<i4",
            Self::Code => "|i1",
            // netCDF-C has no booleans: an attribute marks them, as xarray writes it.
            Self::Flag => "|u1",
        }
    }

    /// Finds the kind of a data type.
    pub(super) fn from_dtype(dtype: &str) -> Option<Self> {
        if dtype == BOOLEAN {
            return Some(Self::Flag);
        }
        Self::ALL.into_iter().find(|kind| kind.dtype() == dtype)
    }

    /// Encodes values as in a chunk: little endian, masks as bytes.
    fn encode(self, values: &[f64]) -> Vec<u8> {
        let numbers = values.iter();
        match self {
            Self::Real => numbers.flat_map(|v| v.to_le_bytes()).collect(),
            Self::Count => numbers.flat_map(|v| (*v as i32).to_le_bytes()).collect(),
            Self::Code => numbers.flat_map(|v| (*v as i8).to_le_bytes()).collect(),
            Self::Flag => numbers.map(|v| u8::from(*v != 0.0)).collect(),
        }
    }

    /// The CRC-32 of values, encoded as in a chunk.
    pub(super) fn checksum(self, values: &[f64]) -> u32 {
        crc32fast::hash(&self.encode(values))
    }

    /// Bytes of a value.
    pub(super) fn bytes(self) -> u64 {
        match self {
            Self::Real => 8,
            Self::Count => 4,
            Self::Code | Self::Flag => 1,
        }
    }
}

impl Variable {
    /// A variable with its description, shape and chunks; `words` are unit and meaning.
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
        if kind == Kind::Flag {
            attributes.insert("dtype".into(), json!("bool"));
        }
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

    /// Adds an attribute.
    pub(super) fn with_attribute(mut self, key: &str, value: Value) -> Self {
        self.attributes.insert(key.to_owned(), value);
        self
    }

    /// The name of the variable.
    pub(super) fn name(&self) -> &'static str {
        self.name
    }

    /// Sets the length of the first dimension.
    pub(super) fn set_length(&mut self, length: usize) {
        self.shape[0] = length as u64;
    }

    /// The kind of its numbers.
    pub(super) fn kind(&self) -> Kind {
        self.kind
    }

    /// The shape of its array.
    pub(super) fn shape(&self) -> Vec<usize> {
        self.shape.iter().map(|n| *n as usize).collect()
    }

    /// The checksums of its chunks, in order.
    pub(super) fn checksums(&self) -> &[u32] {
        &self.checksums
    }

    /// Sets the checksums of chunks that are stored already.
    pub(super) fn set_checksums(&mut self, checksums: &[u32]) {
        self.checksums = checksums.to_vec();
    }

    /// Its attributes as JSON.
    pub(super) fn attributes(&self) -> Value {
        Value::Object(self.attributes.clone())
    }

    /// The content of `.zarray`. There is no fill value, so that no reader takes a gap for zeros.
    pub(super) fn zarray(&self) -> Value {
        json!({
            "zarr_format": 2,
            "shape": self.shape,
            "chunks": self.chunks,
            "dtype": self.kind.dtype(),
            "compressor": { "id": "zlib", "level": LEVEL },
            "fill_value": null,
            "order": "C",
            "filters": null,
            "dimension_separator": ".",
        })
    }

    /// Opens its array for writing.
    fn array(&self, folder: &Arc<Folder>) -> Result<Array<Folder>, Error> {
        open_array(folder, self.name, self.zarray())
    }

    /// Stores a chunk of real numbers, the first along all dimensions but the first, converted to
    /// the variable's kind; a short one is filled up with zeros. Returns the checksum of the
    /// numbers.
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
        let flags = || (values.iter().map(|v| u8::from(*v != 0.0))).collect::<Vec<_>>();
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

/// Fails for a codec, a filter or a type of numbers that no store of this program has. A codec is a
/// program that a file asks for, so others are rejected by name.
fn check_encoding(zarray: &Value) -> Result<(), String> {
    if Compressor::from_zarray(zarray).is_none() {
        return Err(format!(
            "is compressed by {}: pyfret reads zlib and gzip",
            zarray["compressor"]["id"]
        ));
    }
    if zarray["filters"]
        .as_array()
        .is_some_and(|all| !all.is_empty())
        || zarray["filters"].is_object()
    {
        return Err(format!(
            "has the filters {}: pyfret writes none",
            zarray["filters"]
        ));
    }
    match zarray["dtype"].as_str() {
        Some(kind) if Kind::from_dtype(kind).is_some() => Ok(()),
        _ => Err(format!(
            "has numbers of the type {}, which pyfret does not write",
            zarray["dtype"]
        )),
    }
}

/// The array of a `.zarray`.
pub(super) fn open_array(
    folder: &Arc<Folder>,
    name: &str,
    zarray: Value,
) -> Result<Array<Folder>, Error> {
    let failed = |e: &dyn std::fmt::Display| folder.error(&format!("{name}: {e}"));
    check_encoding(&zarray).map_err(|e| failed(&e))?;
    let metadata: ArrayMetadataV2 = serde_json::from_value(zarray).map_err(|e| failed(&e))?;
    Array::new_with_metadata(
        folder.clone(),
        &format!("/{name}"),
        ArrayMetadata::V2(metadata),
    )
    .map_err(|e| failed(&e))
}
