//! A folder of files that are replaced as a whole.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use contact_core::Error;
use zarrs::storage::byte_range::{ByteRangeIterator, extract_byte_ranges};
use zarrs::storage::{
    Bytes, MaybeBytes, MaybeBytesIterator, OffsetBytesIterator, ReadableStorageTraits,
    StorageError, StoreKey, StorePrefix, WritableStorageTraits, store_set_partial_many,
};

/// Path beside a file or a folder, used before or after it is in its place. The name is one that no
/// Zarr library looks at.
pub(super) fn hidden_sibling(path: &Path, why: &str) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".");
    name.push(why);
    path.with_file_name(name)
}

/// The hidden folder beside a place in which its store is begun.
fn unfinished(path: &Path) -> PathBuf {
    hidden_sibling(path, "unfinished")
}

/// The folder of a store.
#[derive(Debug)]
pub(super) struct Folder {
    root: PathBuf,
    /// Its name in errors.
    name: PathBuf,
}

impl Folder {
    /// The folder at `root`, which is its final place.
    pub(super) fn new(root: &Path) -> Arc<Self> {
        Self::with_final_place(root, root.to_owned())
    }

    /// A folder that is at `root` and will be moved to `place`.
    pub(super) fn with_final_place(place: &Path, root: PathBuf) -> Arc<Self> {
        Arc::new(Self {
            root,
            name: place.to_owned(),
        })
    }

    /// The path of the folder.
    pub(super) fn root(&self) -> &Path {
        &self.root
    }

    /// Writes beside the file and renames: a reader sees the old file or the new one. The rename
    /// outlives the process; only a power failure can undo what was written last.
    pub(super) fn write(&self, key: &str, bytes: &[u8]) -> io::Result<()> {
        let path = self.root.join(key);
        let unfinished = unfinished(&path);
        let written = fs::write(&unfinished, bytes).or_else(|_| {
            // The folder may be missing; any other cause fails again, with its reason.
            fs::create_dir_all(path.parent().unwrap_or(&self.root))?;
            fs::write(&unfinished, bytes)
        });
        rename_or_remove(&unfinished, &path, written)
    }

    /// Writes a text as [`Self::write`]; the error names the file.
    pub(super) fn put(&self, key: &str, text: &str) -> Result<(), Error> {
        let written = self.write(key, text.as_bytes());
        written.map_err(|e| self.error(&format!("{key}: {e}")))
    }

    /// Writes a file of an existing folder by `content`, beside it and then renamed. The file is on the disk
    /// before this returns, so that after a power failure there is either the old file or the new one.
    pub(super) fn write_durably(
        &self,
        key: &str,
        content: impl FnOnce(&File) -> io::Result<()>,
    ) -> io::Result<()> {
        let path = self.root.join(key);
        let unfinished = unfinished(&path);
        let written = File::create(&unfinished).and_then(|file| {
            content(&file)?;
            file.sync_all()
        });
        rename_or_remove(&unfinished, &path, written)?;
        if cfg!(unix) {
            File::open(path.parent().unwrap_or(&self.root))?.sync_all()?;
        }
        Ok(())
    }

    /// The content of a file; `None` if there is none.
    pub(super) fn read(&self, key: &str) -> io::Result<Option<Vec<u8>>> {
        let path = self.root.join(key);
        // A pipe would be waited for, and a device has no end.
        if fs::metadata(&path).is_ok_and(|about| !about.is_file()) {
            return Err(io::Error::other("is not a file"));
        }
        match fs::read(path) {
            Ok(bytes) => Ok(Some(bytes)),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(e),
        }
    }

    /// An error about this folder.
    pub(super) fn error(&self, message: &dyn std::fmt::Display) -> Error {
        Error::File {
            path: self.name.display().to_string(),
            message: message.to_string(),
        }
    }
}

/// Renames a file to its final name if it was `written`; otherwise removes it and returns the error.
fn rename_or_remove(unfinished: &Path, path: &Path, written: io::Result<()>) -> io::Result<()> {
    let renamed = written.and_then(|()| fs::rename(unfinished, path));
    if renamed.is_err() {
        // There may be nothing to remove, and nothing more to be done if that fails.
        let _ = fs::remove_file(unfinished);
    }
    renamed
}

/// An input or output error as one of the crate zarrs.
fn storage_error(error: io::Error) -> StorageError {
    StorageError::IOError(Arc::new(error))
}

impl ReadableStorageTraits for Folder {
    /// The content of a file, by its key.
    fn get(&self, key: &StoreKey) -> Result<MaybeBytes, StorageError> {
        let bytes = self.read(key.as_str()).map_err(storage_error)?;
        Ok(bytes.map(Bytes::from))
    }

    /// Reads ranges of bytes of a file.
    fn get_partial_many<'a>(
        &'a self,
        key: &StoreKey,
        byte_ranges: ByteRangeIterator<'a>,
    ) -> Result<MaybeBytesIterator<'a>, StorageError> {
        let Some(bytes) = self.get(key)? else {
            return Ok(None);
        };
        let parts = extract_byte_ranges(&bytes, byte_ranges)?;
        Ok(Some(Box::new(
            parts.into_iter().map(|part| Ok(Bytes::from(part))),
        )))
    }

    /// Size of a file \[bytes\]; none if there is no such file.
    fn size_key(&self, key: &StoreKey) -> Result<Option<u64>, StorageError> {
        match fs::metadata(self.root.join(key.as_str())) {
            Ok(metadata) => Ok(Some(metadata.len())),
            Err(e) if e.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(storage_error(e)),
        }
    }

    /// No: files are read as a whole.
    fn supports_get_partial(&self) -> bool {
        false
    }
}

impl WritableStorageTraits for Folder {
    /// Writes a file, by its key.
    fn set(&self, key: &StoreKey, value: Bytes) -> Result<(), StorageError> {
        self.write(key.as_str(), &value).map_err(storage_error)
    }

    /// Writes ranges of a file by rewriting it.
    fn set_partial_many(
        &self,
        key: &StoreKey,
        offset_values: OffsetBytesIterator<'_>,
    ) -> Result<(), StorageError> {
        store_set_partial_many(self, key, offset_values)
    }

    /// Removes a file, if it is there.
    fn erase(&self, key: &StoreKey) -> Result<(), StorageError> {
        match fs::remove_file(self.root.join(key.as_str())) {
            Err(e) if e.kind() != io::ErrorKind::NotFound => Err(storage_error(e)),
            _ => Ok(()),
        }
    }

    /// Removes a folder.
    fn erase_prefix(&self, prefix: &StorePrefix) -> Result<(), StorageError> {
        fs::remove_dir_all(self.root.join(prefix.as_str())).map_err(storage_error)
    }

    /// No: files are written as a whole.
    fn supports_set_partial(&self) -> bool {
        false
    }
}
