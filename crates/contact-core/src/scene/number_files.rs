//! Tables of numbers in files: NumPy arrays and text.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use ndarray::{Array2, ArrayView2};
use ndarray_npy::{ViewElement, ViewNpyExt};

/// A NumPy array of real or whole numbers of any size and byte order. The whole file is looked at
/// before anything is made of it: what its header says of its length need not be true.
pub(super) fn read_npy(path: &Path) -> Result<Array2<f64>, String> {
    let mut file = File::open(path).map_err(|e| e.to_string())?;
    let length = file.metadata().map_err(|e| e.to_string())?.len() as usize;
    // The numbers, which begin at a multiple of 16 bytes of the file, have to be in line.
    let mut bytes = vec![0; length + align_of::<f64>()];
    let start = bytes.as_ptr().align_offset(align_of::<f64>());
    let bytes = bytes
        .get_mut(start..start + length)
        .ok_or("cannot be read on this machine")?;
    file.read_exact(bytes).map_err(|e| e.to_string())?;
    let begin = begin_of_numbers(bytes)?;
    let header = String::from_utf8_lossy(&bytes[..begin]).into_owned();
    let kind = header
        .split_once("'descr'")
        .and_then(|(_, rest)| rest.split('\'').nth(1))
        .unwrap_or_default();
    let size = kind.get(2..).and_then(|size| size.parse::<usize>().ok());
    if kind.starts_with('>')
        && let Some(size) = size.filter(|s| (1..=8).contains(s))
    {
        for number in bytes[begin..].chunks_exact_mut(size) {
            number.reverse();
        }
        let order = bytes.iter().position(|b| *b == b'>').unwrap_or_default();
        bytes[order] = b'<';
    }
    match kind.get(1..).unwrap_or_default() {
        "f8" => numbers::<f64>(bytes, |v| v),
        "f4" => numbers::<f32>(bytes, f64::from),
        "i1" => numbers::<i8>(bytes, f64::from),
        "i2" => numbers::<i16>(bytes, f64::from),
        "i4" => numbers::<i32>(bytes, f64::from),
        "i8" => numbers::<i64>(bytes, |v| v as f64),
        "u1" => numbers::<u8>(bytes, f64::from),
        "u2" => numbers::<u16>(bytes, f64::from),
        "u4" => numbers::<u32>(bytes, f64::from),
        "u8" => numbers::<u64>(bytes, |v| v as f64),
        _ => Err(format!(
            "holds numbers of the type `{kind}`: must be real or whole numbers of 1 to 8 bytes, such as \
             float32 or int16"
        )),
    }
}

/// Length of the header. Version 1 has two bytes for it, the later ones four.
fn begin_of_numbers(bytes: &[u8]) -> Result<usize, String> {
    let begin = match *bytes {
        [0x93, b'N', b'U', b'M', b'P', b'Y', 1, _, a, b, ..] => {
            10 + usize::from(u16::from_le_bytes([a, b]))
        }
        [0x93, b'N', b'U', b'M', b'P', b'Y', _, _, a, b, c, d, ..] => {
            (u32::from_le_bytes([a, b, c, d]) as usize).saturating_add(12)
        }
        _ => return Err("is no NumPy array".into()),
    };
    if begin > bytes.len() {
        return Err("is not whole: its header is longer than the file".into());
    }
    Ok(begin)
}

fn numbers<T: ViewElement + Copy>(
    bytes: &[u8],
    real: impl Fn(T) -> f64,
) -> Result<Array2<f64>, String> {
    let view = ArrayView2::<T>::view_npy(bytes).map_err(|e| e.to_string())?;
    Ok(view.mapv(real))
}

/// Words for a number that was not measured.
const MISSING: [&str; 6] = ["", "nan", "na", "null", "bad", "-"];

/// A table of text, one line per row. A first line of titles and lines that begin with # are left
/// out; a field without a number is NaN.
pub(super) fn read_table(path: &Path) -> Result<Array2<f64>, String> {
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let lines = text.trim_start_matches('\u{feff}').lines().enumerate();
    let lines: Vec<(usize, &str)> = lines
        .map(|(n, line)| (n + 1, line.trim()))
        .filter(|(_, line)| !line.is_empty() && !line.starts_with('#'))
        .collect();
    // The line with most of them: a short last line has none.
    let partings = [';', '\t', ','];
    let fullest = lines
        .iter()
        .max_by_key(|(_, line)| line.matches(partings).count());
    let fullest = fullest.map_or("", |(_, line)| line);
    let parting = partings.into_iter().find(|c| fullest.contains(*c));
    let mut rows: Vec<Vec<f64>> = Vec::with_capacity(lines.len());
    for (n, (number, line)) in lines.iter().enumerate() {
        match row(line, parting) {
            Ok(row) => rows.push(row),
            // Titles.
            Err(_) if n == 0 => {}
            Err((column, field)) => {
                return Err(format!(
                    "line {number}, column {}: `{field}` is no number",
                    column + 1
                ));
            }
        }
    }
    // A separator at the end of every line parts nothing.
    if rows
        .iter()
        .all(|row| row.len() > 1 && row[row.len() - 1].is_nan())
        && fullest.ends_with([';', ','])
    {
        for row in &mut rows {
            row.pop();
        }
    }
    let columns = rows.first().map_or(0, Vec::len);
    if let Some(n) = rows.iter().position(|row| row.len() != columns) {
        let number = lines[n + lines.len() - rows.len()].0;
        return Err(format!(
            "line {number} has {} numbers: must have {columns}, as the first one",
            rows[n].len()
        ));
    }
    let count = rows.len();
    let all = rows.into_iter().flatten().collect();
    Array2::from_shape_vec((count, columns), all).map_err(|e| e.to_string())
}

/// The numbers of a line, or the first field that is none with its place.
fn row(line: &str, parting: Option<char>) -> Result<Vec<f64>, (usize, String)> {
    let fields: Vec<&str> = match parting {
        Some(c) => line.split(c).map(str::trim).collect(),
        None => line.split_whitespace().collect(),
    };
    let number = |(n, field): (usize, &&str)| {
        let plain = field.trim_matches('"');
        if MISSING.contains(&plain.to_lowercase().as_str()) {
            return Ok(f64::NAN);
        }
        let point = match parting {
            Some(',') => plain.to_owned(),
            _ => plain.replacen(',', ".", 1),
        };
        point.parse().map_err(|_| (n, plain.to_owned()))
    };
    fields.iter().enumerate().map(number).collect()
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::{read_npy, read_table};

    #[test]
    fn tables_are_read_whatever_parts_their_numbers() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("z.csv");
        for text in [
            "1,2.5\n3,-4e-1\n",
            "x,y\n1,2.5\n3,-4e-1\n",
            "1;2,5\n3;-0,4\n",
            "1;2.5;\n3;-0.4;\n",
            "# heights in m\n1\t2.5\r\n3\t-0.4\r\n",
            "  1   2.5\n  3  -0.4\n\n",
            "\u{feff}\"1\",2.5\n3,-.4",
        ] {
            fs::write(&path, text).expect("a file");
            let z = read_table(&path).unwrap_or_else(|e| panic!("{text:?}: {e}"));
            assert_eq!(z, ndarray::array![[1.0, 2.5], [3.0, -0.4]], "{text:?}");
        }
        fs::write(&path, "1,2\n3,four\n").expect("a file");
        let error = read_table(&path).expect_err("no number");
        assert_eq!(error, "line 2, column 2: `four` is no number");
        fs::write(&path, "a,b\n1,2\n3\n").expect("a file");
        let error = read_table(&path).expect_err("a short line");
        assert!(
            error.starts_with("line 3 has 1 numbers: must have 2"),
            "{error}"
        );
        fs::write(&path, "1,\n3,nan\n4,5").expect("a file");
        assert!(read_table(&path).expect("holes")[(0, 1)].is_nan());
    }

    #[test]
    fn arrays_are_read_whatever_their_numbers() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("z.npy");
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
            fs::write(&path, bytes).expect("a file");
            read_npy(&path)
        };
        let both = ndarray::array![[3.0, -2.0]];
        let of = |a: &[u8], b: &[u8]| [a, b].concat();
        let f4 = of(&3_f32.to_le_bytes(), &(-2_f32).to_le_bytes());
        assert_eq!(file("<f4", &f4), Ok(both.clone()));
        let f8 = of(&3_f64.to_be_bytes(), &(-2_f64).to_be_bytes());
        assert_eq!(file(">f8", &f8), Ok(both.clone()));
        let i2 = of(&3_i16.to_be_bytes(), &(-2_i16).to_be_bytes());
        assert_eq!(file(">i2", &i2), Ok(both.clone()));
        assert_eq!(file("|i1", &[3, 254]), Ok(both));
        let error = file("<c16", &[0; 32]).expect_err("complex numbers");
        assert!(error.contains("`<c16`"), "{error}");
    }
}
