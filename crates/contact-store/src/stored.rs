//! An array of a store: reading gives the written values or an error.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::sync::Arc;

use contact_core::Error;
use flate2::bufread::{MultiGzDecoder, ZlibDecoder};
use rayon::prelude::*;
use serde_json::Value;
use zarrs::array::{Array, ArrayError, ArraySubset, ElementOwned};

use super::catalogue::Kind;
use super::folder::Folder;
use super::variable::{BOOLEAN, Compressor, open_array};

/// Largest number of values in a chunk: a field of the largest grid.
const MOST_VALUES: u64 = 1 << 28;

/// An array of a store being read, with the checksums of its chunks.
pub(super) struct Stored<'a> {
    array: Array<Folder>,
    kind: Kind,
    compressor: Compressor,
    /// Whether flags are stored as booleans.
    has_booleans: bool,
    /// Checksums of the chunks; a copy has none.
    checksums: Option<&'a [u32]>,
}

impl<'a> Stored<'a> {
    /// Opens the array `name` with its metadata `zarray`; `checksums` of its chunks, if known.
    pub(super) fn new(
        folder: &Arc<Folder>,
        name: &str,
        zarray: &Value,
        checksums: Option<&'a [u32]>,
    ) -> Result<Self, Error> {
        let failed = |message: &str| folder.error(&format!("{name}: {message}"));
        let array = open_array(folder, name, zarray.clone())?;
        let kind = zarray["dtype"].as_str().and_then(Kind::from_dtype);
        let kind = kind.ok_or_else(|| failed("has numbers of an unknown type"))?;
        let compressor = Compressor::from_zarray(zarray);
        let compressor = compressor.ok_or_else(|| failed("has an unknown compressor"))?;
        if array.shape().is_empty() {
            return Err(failed("has no dimension"));
        }
        Ok(Self {
            array,
            kind,
            compressor,
            has_booleans: zarray["dtype"] == BOOLEAN,
            checksums,
        })
    }

    /// The shape of the array.
    pub(super) fn shape(&self) -> &[u64] {
        self.array.shape()
    }

    /// The whole array.
    pub(super) fn whole(&self) -> ArraySubset {
        self.array.subset_all()
    }

    /// Fails at the first chunk that is missing or damaged.
    pub(super) fn verify(&self, part: &ArraySubset) -> Result<(), String> {
        let chunks = self.array.chunks_in_array_subset(part);
        let chunks = chunks.map_err(|e| e.to_string())?;
        let chunks: Vec<_> = chunks.into_iter().flat_map(|c| c.indices()).collect();
        chunks
            .par_iter()
            .try_for_each(|chunk| self.check_chunk(chunk))
    }

    /// Fails if a chunk is missing, larger than its values, or differs from its checksum.
    fn check_chunk(&self, chunk: &[u64]) -> Result<(), String> {
        let Some(checksums) = self.checksums else {
            return Ok(());
        };
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
        let mut file = BufReader::new(file);
        let unfolded: Box<dyn Read + '_> = match self.compressor {
            Compressor::None => Box::new(&mut file),
            Compressor::Gzip => Box::new(MultiGzDecoder::new(&mut file)),
            Compressor::Zlib => Box::new(ZlibDecoder::new(&mut file)),
        };
        match io::copy(&mut unfolded.take(size + 1), &mut sum) {
            Ok(n) if n == size => {}
            Ok(_) => return Err(damaged(&"it is of another length")),
            Err(e) => return Err(damaged(&e)),
        }
        match file.fill_buf() {
            Ok([]) => {}
            Ok(_) => return Err(damaged(&"bytes follow its end")),
            Err(e) => return Err(damaged(&e)),
        }
        let expected = checksums.get(chunk[0] as usize).copied();
        if expected != Some(sum.crc.finalize()) {
            return Err(damaged(&"its numbers are not those that were written"));
        }
        Ok(())
    }

    /// The numbers in a part of the array, converted to f64.
    pub(super) fn numbers(&self, part: &ArraySubset) -> Result<Vec<f64>, String> {
        self.verify(part)?;
        let array = &self.array;
        let f64s = match self.kind {
            Kind::Real => array.retrieve_array_subset(part),
            Kind::Count => read_as_f64::<i32>(array, part, f64::from),
            Kind::Code => read_as_f64::<i8>(array, part, f64::from),
            Kind::Flag if self.has_booleans => {
                read_as_f64::<bool>(array, part, |yes| f64::from(u8::from(yes)))
            }
            Kind::Flag => read_as_f64::<u8>(array, part, f64::from),
        };
        f64s.map_err(|e| e.to_string())
    }
}

/// Sums up the checksum of the first `counts` bytes.
struct Sum {
    counts: u64,
    crc: crc32fast::Hasher,
}

impl Write for Sum {
    /// Adds bytes to the checksum.
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

/// Reads a part of an array and converts its numbers.
fn read_as_f64<T: ElementOwned>(
    array: &Array<Folder>,
    part: &ArraySubset,
    to_f64: impl Fn(T) -> f64,
) -> Result<Vec<f64>, ArrayError> {
    let values: Vec<T> = array.retrieve_array_subset(part)?;
    Ok(values.into_iter().map(to_f64).collect())
}
