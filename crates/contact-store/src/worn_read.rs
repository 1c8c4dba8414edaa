//! Reads the worn surfaces of a run of wear from its store.

use std::path::Path;
use std::sync::Arc;

use contact_core::Error;
use contact_wear::WornStart;
use ndarray::Array2;
use serde_json::Value;
use zarrs::array::ArraySubset;

use super::folder::Folder;
use super::variable::open_array;
use super::wear_store::verify_wear;

/// Largest number of values that a field may have.
const MOST_VALUES: u64 = 1 << 28;

/// Reads the last block of a run of wear, on which another run may begin. Fails if a file of the
/// store is missing or not as it was written.
pub fn read_worn(path: impl AsRef<Path>) -> Result<WornStart, Error> {
    verify_wear(path.as_ref())?;
    let folder = Folder::new(path.as_ref());
    let last_of = |name: &str| read_last(&folder, name);
    let field = |name: &str| -> Result<Array2<f64>, Error> {
        let (shape, values) = last_of(name)?;
        let [_, nx, ny] = shape[..] else {
            return Err(folder.error(&format!("{name}: is of shape {shape:?}, no field")));
        };
        Array2::from_shape_vec((nx as usize, ny as usize), values)
            .map_err(|e| folder.error(&format!("{name}: {e}")))
    };
    let number = |name: &str| -> Result<f64, Error> {
        let (_, values) = last_of(name)?;
        let value = values.last().copied();
        value.ok_or_else(|| folder.error(&format!("{name}: is empty")))
    };
    Ok(WornStart {
        cycles: number("block_cycles")?,
        dissipated: number("dissipated")?,
        worn: [field("worn1")?, field("worn2")?],
        energy: [field("energy1")?, field("energy2")?],
        slid: field("slid")?,
        bed: Some(field("bed")?),
        ejected: number("ejected")?,
    })
}

/// The last entry along the first dimension of an array of real numbers: shape and values.
fn read_last(folder: &Arc<Folder>, name: &str) -> Result<(Vec<u64>, Vec<f64>), Error> {
    let failed = |e: &dyn std::fmt::Display| folder.error(&format!("{name}: {e}"));
    let key = format!("{name}/.zarray");
    let text = folder.read(&key).map_err(|e| failed(&e))?;
    let text = text.ok_or_else(|| folder.error(&format!("holds no run of wear: no {name}")))?;
    let zarray: Value = serde_json::from_slice(&text).map_err(|e| failed(&e))?;
    let array = open_array(folder, name, zarray)?;
    let shape = array.shape().to_vec();
    let count = shape
        .iter()
        .skip(1)
        .try_fold(1_u64, |n, m| n.checked_mul(*m));
    if shape.first().is_none_or(|n| *n == 0) || count.is_none_or(|n| n > MOST_VALUES) {
        return Err(failed(&format!("is of shape {shape:?}")));
    }
    let mut ranges: Vec<_> = shape.iter().map(|n| 0..*n).collect();
    ranges[0] = shape[0] - 1..shape[0];
    let values = array
        .retrieve_array_subset(&ArraySubset::new_with_ranges(&ranges))
        .map_err(|e| failed(&e))?;
    Ok((shape, values))
}
