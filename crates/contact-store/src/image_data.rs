//! VTK image data (`.vti`), which ParaView, PyVista and VTK open.
//!
//! XML with the numbers appended raw, little endian, x fastest, as 4-byte reals; the places of all
//! blocks are known beforehand, so that planes are written as they come.

use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use contact_core::Error;
use contact_core::scene::Grid;
use contact_subsurface::{Depth, Probe, Side};
use ndarray::Array2;

use super::folder::hidden_sibling;
use super::volume::VolumeSink;

/// Share of the spacing by which depths may be uneven.
const UNEVEN: f64 = 1e-6;

/// An image being written; it takes its name when it is finished.
pub struct ImageData {
    path: PathBuf,
    unfinished: PathBuf,
    file: Mutex<File>,
    /// Place of the first block of numbers.
    start: u64,
    shape: (usize, usize, usize),
    /// Depth grows against z in body 1.
    upwards: bool,
}

impl ImageData {
    /// Begins the file `path` for `probes` at the centres of the cells and at the `depths`, which must be
    /// evenly spaced. Fails if there is a file already.
    pub fn create(
        path: impl AsRef<Path>,
        grid: &Grid,
        side: Side,
        depths: &[Depth],
        probes: &[Probe],
    ) -> Result<Self, Error> {
        let path = path.as_ref();
        if path.exists() {
            return Err(file_error(path, "exists: choose another path"));
        }
        let spacing = spacing(depths)?;
        let upwards = side == Side::Body1;
        let first = match (upwards, depths) {
            (false, [first, ..]) => first.z,
            (true, [.., last]) => -last.z,
            _ => 0.0,
        };
        let shape = (grid.nx, grid.ny, depths.len());
        let header = header(grid, (first, spacing), shape, probes);
        let unfinished = hidden_sibling(path, "unfinished");
        let begin = || {
            let mut file = File::create(&unfinished)?;
            file.write_all(header.as_bytes())?;
            let bytes = block_length(shape);
            for n in 0..probes.len() as u64 {
                file.seek(SeekFrom::Start(header.len() as u64 + n * (8 + bytes)))?;
                file.write_all(&bytes.to_le_bytes())?;
            }
            let end = header.len() as u64 + probes.len() as u64 * (8 + bytes);
            file.seek(SeekFrom::Start(end))?;
            file.write_all(b"\n  </AppendedData>\n</VTKFile>\n")?;
            Ok(file)
        };
        let file = begin().map_err(|e: std::io::Error| file_error(path, e))?;
        Ok(Self {
            path: path.to_owned(),
            unfinished,
            file: Mutex::new(file),
            start: header.len() as u64,
            shape,
            upwards,
        })
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<(), Error> {
        fs::rename(&self.unfinished, &self.path).map_err(|e| file_error(&self.path, e))
    }
}

impl VolumeSink for ImageData {
    /// Writes the values of a probe at a depth to their place in the file.
    fn put(&self, probe: usize, depth: usize, values: &Array2<f64>) -> Result<(), Error> {
        let (nx, ny, nz) = self.shape;
        let plane = if self.upwards { nz - 1 - depth } else { depth };
        let block = self.start + probe as u64 * (8 + block_length(self.shape)) + 8;
        let at = block + (plane * nx * ny * 4) as u64;
        let bytes: Vec<u8> = (0..ny)
            .flat_map(|j| (0..nx).map(move |i| values[(i, j)] as f32))
            .flat_map(f32::to_le_bytes)
            .collect();
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        file.seek(SeekFrom::Start(at))
            .and_then(|_| file.write_all(&bytes))
            .map_err(|e| file_error(&self.path, e))
    }
}

impl Drop for ImageData {
    fn drop(&mut self) {
        // Only what was not finished is still there; nothing can be done if it stays.
        let _ = fs::remove_file(&self.unfinished);
    }
}

/// Bytes of the numbers of a field, in single precision.
fn block_length((nx, ny, nz): (usize, usize, usize)) -> u64 {
    (nx * ny * nz * 4) as u64
}

/// An error of the file at `path`.
fn file_error(path: &Path, message: impl std::fmt::Display) -> Error {
    Error::File {
        path: path.display().to_string(),
        message: message.to_string(),
    }
}

/// Distance of the depths \[m\]; 1 for a single depth. Fails if they are not evenly spaced.
fn spacing(depths: &[Depth]) -> Result<f64, Error> {
    let [first, .., last] = depths else {
        return match depths.len() {
            0 => Err(Error::invalid("z", "[]", "at least one depth")),
            _ => Ok(1.0),
        };
    };
    let step = (last.z - first.z) / (depths.len() - 1) as f64;
    for (n, depth) in depths.iter().enumerate() {
        let even = first.z + n as f64 * step;
        if step <= 0.0 || (depth.z - even).abs() > UNEVEN * step {
            return Err(Error::invalid(
                "z",
                depth.z,
                "evenly spaced and growing, each depth once: image data has no other",
            ));
        }
    }
    Ok(step)
}

/// The head of the file in XML: extent, origin, spacing, and the fields with their places in the file.
fn header(
    grid: &Grid,
    (first, spacing): (f64, f64),
    (nx, ny, nz): (usize, usize, usize),
    probes: &[Probe],
) -> String {
    let extent = format!("0 {} 0 {} 0 {}", nx - 1, ny - 1, nz - 1);
    let (x, y, dx, dy) = (grid.x(0), grid.y(0), grid.dx, grid.dy);
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" \
         header_type=\"UInt64\">\n  \
         <ImageData WholeExtent=\"{extent}\" Origin=\"{x} {y} {first}\" \
         Spacing=\"{dx} {dy} {spacing}\">\n    <Piece Extent=\"{extent}\">\n      <PointData>\n"
    );
    for (n, probe) in probes.iter().enumerate() {
        let offset = n as u64 * (8 + block_length((nx, ny, nz)));
        let name = probe.name();
        let _ = writeln!(
            text,
            "        <DataArray type=\"Float32\" Name=\"{name}\" format=\"appended\" \
             offset=\"{offset}\"/>"
        );
    }
    text.push_str(
        "      </PointData>\n    </Piece>\n  </ImageData>\n  <AppendedData encoding=\"raw\">\n_",
    );
    text
}
