//! The consolidated metadata of a store, `.zmetadata`: replacing it makes all new files valid at
//! once.
//!
//! Beside the metadata documents of Zarr, which every Zarr library reads, it holds checksums, which
//! separate a whole store from a damaged one:
//!
//! ```text
//! checksums   per array the CRC-32 of the values of each chunk, in their order, little endian
//! crc32       the CRC-32 of the file up to there
//! ```
//!
//! The checksums cover values, not files. In the last chunk of a column they cover the values that
//! count. So a column that grows while it is read, or after a kill, still matches its metadata.

use std::collections::BTreeMap;

use serde_json::{Map, Value, json};

/// Name of the file.
pub(super) const FILE: &str = ".zmetadata";
/// End of the file, with the checksum in the middle.
const TAIL: (&str, &str) = (",\n  \"crc32\": \"", "\"\n}");
/// Letters of a checksum.
const LETTERS: usize = 8;

/// The CRC-32 of the values of each chunk, by the name of the array.
pub(super) type Checksums = BTreeMap<String, Vec<u32>>;

/// The contents of `.zmetadata`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Consolidated {
    /// The metadata documents of the group and the arrays, by their place in the store.
    pub(super) documents: Map<String, Value>,
    pub(super) checksums: Checksums,
}

impl Consolidated {
    /// The content of the file: all metadata documents, with checksums of the chunks.
    pub(super) fn encode(&self) -> String {
        let words = |sums: &Vec<u32>| {
            let words: Vec<_> = sums.iter().map(|sum| format!("{sum:08x}")).collect();
            json!(words.join(" "))
        };
        let checksums: Map<_, _> = self
            .checksums
            .iter()
            .map(|(name, sums)| (name.clone(), words(sums)))
            .collect();
        let contents = json!({
            "zarr_consolidated_format": 1,
            "metadata": self.documents,
            "checksums": checksums,
        });
        let mut text = format!("{contents:#}");
        // The bracket that closes the object comes after the checksum.
        text.truncate(text.len() - "\n}".len());
        let crc = crc32fast::hash(text.as_bytes());
        [&text, TAIL.0, &format!("{crc:08x}"), TAIL.1].concat()
    }

    /// Reads the content of the file. Returns it, and whether the file is complete; the error is why it is no
    /// consolidated metadata.
    pub(super) fn decode(bytes: &[u8]) -> Result<(Self, bool), String> {
        let mut value: Value = serde_json::from_slice(bytes).map_err(|e| e.to_string())?;
        let Value::Object(documents) = value["metadata"].take() else {
            return Err("it has no metadata".into());
        };
        let mut checksums = Checksums::new();
        for (name, words) in value["checksums"].as_object().into_iter().flatten() {
            let words = words.as_str().unwrap_or_default().split(' ');
            let sums = words.map_while(|word| u32::from_str_radix(word, 16).ok());
            checksums.insert(name.clone(), sums.collect());
        }
        let decoded = Self {
            documents,
            checksums,
        };
        Ok((decoded, is_whole(bytes)))
    }

    /// A document, null if there is none.
    pub(super) fn document(&self, key: &str) -> &Value {
        self.documents.get(key).unwrap_or(&Value::Null)
    }

    /// Length of the first dimension of an array, 0 if there is none.
    pub(super) fn length(&self, name: &str) -> usize {
        let length = &self.document(&format!("{name}/.zarray"))["shape"][0];
        length.as_u64().unwrap_or(0) as usize
    }
}

/// Whether the bytes end in the checksum of the ones before.
fn is_whole(bytes: &[u8]) -> bool {
    let (before, after) = (TAIL.0.as_bytes(), TAIL.1.as_bytes());
    let Some(content) = bytes.strip_suffix(after) else {
        return false;
    };
    let Some((content, crc)) = content.split_last_chunk::<LETTERS>() else {
        return false;
    };
    let Some(content) = content.strip_suffix(before) else {
        return false;
    };
    format!("{:08x}", crc32fast::hash(content)).as_bytes() == crc
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::Consolidated;

    #[test]
    fn what_is_written_is_read_and_no_bit_may_change() {
        let mut written = Consolidated::default();
        written
            .documents
            .insert(".zattrs".into(), json!({"mu": 0.3}));
        written.checksums.insert("p".into(), vec![0, 0xdead_beef]);
        let text = written.encode();
        let (read, whole) = Consolidated::decode(text.as_bytes()).expect("JSON");
        assert!(whole && read.documents == written.documents);
        assert_eq!(read.checksums, written.checksums);
        for at in 0..text.len() {
            for bit in 0..8 {
                let mut bytes = text.clone().into_bytes();
                bytes[at] ^= 1 << bit;
                let decoded = Consolidated::decode(&bytes);
                assert!(decoded.is_err() || !decoded.expect("JSON").1, "byte {at}");
            }
        }
    }
}
