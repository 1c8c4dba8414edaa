//! NumPy arrays.

use ndarray::{Array2, ArrayView2};
use ndarray_npy::{ViewElement, ViewNpyExt};

use super::profile::profile_message;

/// Whether the bytes begin as a NumPy array does.
pub(super) fn is_npy(bytes: &[u8]) -> bool {
    bytes.starts_with(b"\x93NUMPY")
}

/// Reads a NumPy array of real or whole numbers of any size and byte order. The length in its header
/// need not be true.
pub(super) fn read(file: Vec<u8>) -> Result<Array2<f64>, String> {
    // The numbers, which begin at a multiple of 16 bytes of the file, have to be in line.
    let length = file.len();
    let mut bytes = vec![0; length + align_of::<f64>()];
    let start = bytes.as_ptr().align_offset(align_of::<f64>());
    let bytes = bytes
        .get_mut(start..start + length)
        .ok_or("cannot be read on this machine")?;
    bytes.copy_from_slice(&file);
    drop(file);
    let start_of_numbers = header_length(bytes)?;
    let header = String::from_utf8_lossy(&bytes[..start_of_numbers]).into_owned();
    let shape = header
        .split_once("'shape'")
        .and_then(|(_, rest)| rest.split(['(', ')']).nth(1))
        .unwrap_or_default();
    let sizes: Vec<&str> = shape
        .split(',')
        .map(str::trim)
        .filter(|n| !n.is_empty())
        .collect();
    if let [points] = sizes[..]
        && let Ok(points) = points.parse()
    {
        return Err(profile_message(points));
    }
    if sizes.len() != 2 {
        return Err(format!(
            "is an array of {} dimensions: must be one of two, along x and y",
            sizes.len()
        ));
    }
    let kind = header
        .split_once("'descr'")
        .and_then(|(_, rest)| rest.split('\'').nth(1))
        .unwrap_or_default();
    let size = kind.get(2..).and_then(|size| size.parse::<usize>().ok());
    if kind.starts_with('>')
        && let Some(size) = size.filter(|s| (1..=8).contains(s))
    {
        for number in bytes[start_of_numbers..].chunks_exact_mut(size) {
            number.reverse();
        }
        let order = bytes.iter().position(|b| *b == b'>').unwrap_or_default();
        bytes[order] = b'<';
    }
    match kind.get(1..).unwrap_or_default() {
        "f8" => to_f64::<f64>(bytes, |v| v),
        "f4" => to_f64::<f32>(bytes, f64::from),
        "i1" => to_f64::<i8>(bytes, f64::from),
        "i2" => to_f64::<i16>(bytes, f64::from),
        "i4" => to_f64::<i32>(bytes, f64::from),
        "i8" => to_f64::<i64>(bytes, |v| v as f64),
        "u1" => to_f64::<u8>(bytes, f64::from),
        "u2" => to_f64::<u16>(bytes, f64::from),
        "u4" => to_f64::<u32>(bytes, f64::from),
        "u8" => to_f64::<u64>(bytes, |v| v as f64),
        _ => Err(format!(
            "holds numbers of the type `{kind}`: must be real or whole numbers of 1 to 8 bytes, such as \
             float32 or int16"
        )),
    }
}

/// Length of the header. Version 1 has two bytes for it, the later ones four.
fn header_length(bytes: &[u8]) -> Result<usize, String> {
    let length = match *bytes {
        [0x93, b'N', b'U', b'M', b'P', b'Y', 1, _, a, b, ..] => {
            10 + usize::from(u16::from_le_bytes([a, b]))
        }
        [0x93, b'N', b'U', b'M', b'P', b'Y', _, _, a, b, c, d, ..] => {
            (u32::from_le_bytes([a, b, c, d]) as usize).saturating_add(12)
        }
        _ => return Err("is no NumPy array".into()),
    };
    if length > bytes.len() {
        return Err("is not whole: its header is longer than the file".into());
    }
    Ok(length)
}

/// The array of a NumPy file of type T, its numbers converted to f64.
fn to_f64<T: ViewElement + Copy>(
    bytes: &[u8],
    real: impl Fn(T) -> f64,
) -> Result<Array2<f64>, String> {
    let view = ArrayView2::<T>::view_npy(bytes).map_err(|e| e.to_string())?;
    Ok(view.mapv(real))
}

#[cfg(test)]
mod tests {
    use super::read;

    #[test]
    fn arrays_are_read_whatever_their_numbers() {
        let file = |kind: &str, numbers: &[u8]| {
            let mut header =
                format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': (1, 2), }}");
            let filled = 64 * (header.len() + 11_usize).div_ceil(64);
            header.extend(std::iter::repeat_n(' ', filled - 11 - header.len()));
            header.push('\n');
            let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
            bytes.extend((header.len() as u16).to_le_bytes());
            bytes.extend(header.as_bytes());
            bytes.extend(numbers);
            read(bytes)
        };
        let expected = ndarray::array![[3.0, -2.0]];
        let concat = |a: &[u8], b: &[u8]| [a, b].concat();
        let f4 = concat(&3_f32.to_le_bytes(), &(-2_f32).to_le_bytes());
        assert_eq!(file("<f4", &f4), Ok(expected.clone()));
        let f8 = concat(&3_f64.to_be_bytes(), &(-2_f64).to_be_bytes());
        assert_eq!(file(">f8", &f8), Ok(expected.clone()));
        let i2 = concat(&3_i16.to_be_bytes(), &(-2_i16).to_be_bytes());
        assert_eq!(file(">i2", &i2), Ok(expected.clone()));
        assert_eq!(file("|i1", &[3, 254]), Ok(expected));
        let error = file("<c16", &[0; 32]).expect_err("complex numbers");
        assert!(error.contains("`<c16`"), "{error}");
    }
}
