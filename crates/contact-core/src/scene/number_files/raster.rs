//! Text with a header: Gwyddion's export and ESRI's ASCII grid. Their lines run along x,
//! from the top. There y is smallest in a picture of Gwyddion, in which z points into the picture,
//! and largest on a map of ESRI.

use ndarray::{Array2, Axis};

use super::field::{Separator, parse_number};
use super::table::{DecimalSigns, Lines, Table, no_number_message};
use super::unit::{self, Kind};

/// Header of Gwyddion's text.
#[derive(Debug, PartialEq)]
pub(super) struct Header {
    /// Name of the channel.
    pub(super) channel: Option<String>,
    /// Width and height of the picture \[m\].
    pub(super) size: (f64, f64),
    /// Word for the unit of the values.
    pub(super) unit: Option<String>,
}

impl Header {
    /// Reads the header in the comments of a table, if there is one.
    pub(super) fn parse(comments: &[String]) -> Result<Option<Self>, String> {
        let entry = |key: &str| {
            let entries = comments.iter().filter_map(|line| line.split_once(':'));
            let mut values = entries.filter(|(name, _)| name.trim().eq_ignore_ascii_case(key));
            values.next().map(|(_, value)| value.trim())
        };
        let (Some(width), Some(height)) = (entry("Width"), entry("Height")) else {
            return Ok(Self::parse_other_language(comments));
        };
        Ok(Some(Self {
            channel: entry("Channel").map(ToOwned::to_owned),
            size: (parse_length(width)?, parse_length(height)?),
            unit: entry("Value units").map(ToOwned::to_owned),
        }))
    }

    /// Reads the four lines in another language: channel, width, height and unit, in this order.
    fn parse_other_language(comments: &[String]) -> Option<Self> {
        let values = |line: &'_ String| {
            line.split_once(':')
                .map(|(_, value)| value.trim().to_owned())
        };
        comments.windows(4).find_map(|lines| {
            let [channel, width, height, unit] = lines
                .iter()
                .map(values)
                .collect::<Option<Vec<_>>>()?
                .try_into()
                .ok()?;
            unit::named(&unit)?;
            Some(Self {
                channel: Some(channel),
                size: (parse_length(&width).ok()?, parse_length(&height).ok()?),
                unit: Some(unit),
            })
        })
    }

    /// The numbers of the table with x first.
    pub(super) fn values(table: &Table) -> Result<Array2<f64>, String> {
        let shape = (table.rows(), table.columns);
        let rows = Array2::from_shape_vec(shape, table.numbers.clone());
        rows.map(Array2::reversed_axes).map_err(|e| e.to_string())
    }
}

/// A length with its unit, in m.
fn parse_length(text: &str) -> Result<f64, String> {
    let (value, word) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let length_unit = unit::named(word).filter(|(kind, _)| *kind == Kind::Length);
    let length = parse_number(value)
        .zip(length_unit)
        .map(|(value, (_, size))| value * size);
    length.ok_or_else(|| {
        format!(
            "header: `{text}` is no length: must be a number and one of {}",
            unit::names(Kind::Length)
        )
    })
}

/// An ESRI ASCII grid: numbers and their distance along x and y, in the unit of the file.
pub(super) struct EsriGrid {
    pub(super) values: Array2<f64>,
    pub(super) pitch: (f64, f64),
}

const KEYS: [&str; 12] = [
    "ncols",
    "nrows",
    "xllcorner",
    "yllcorner",
    "xllcenter",
    "yllcenter",
    "cellsize",
    "dx",
    "dy",
    "nodata_value",
    "nodata",
    "byteorder",
];
/// First words of grids of other programs, whose lines begin elsewhere or have other headers.
const OTHERS: [(&str, &str); 6] = [
    ("dsaa", "Surfer (DSAA)"),
    ("dsbb", "Surfer (DSBB)"),
    ("dsrb", "Surfer (DSRB)"),
    ("north:", "GRASS"),
    ("proj:", "GRASS"),
    ("isnm", "SurfStand"),
];
/// Number for a missing value where the header gives none.
const NODATA: f64 = -9999.0;
/// Largest number of samples along a side that a header may give.
const MOST_SAMPLES: f64 = 1e9;

impl EsriGrid {
    /// Reads a text that begins with the header of an ESRI grid; none if it does not.
    pub(super) fn parse(text: &str) -> Option<Result<Self, String>> {
        let Lines { lines, .. } = Lines::split(text);
        let first = lines.first()?.1.split_whitespace().next()?.to_lowercase();
        if let Some((_, program)) = OTHERS.iter().find(|(mark, _)| **mark == first) {
            return Some(Err(format!(
                "is a grid of {program}: export it as an ESRI ASCII grid, or as points x, y and height"
            )));
        }
        KEYS.contains(&first.as_str())
            .then(|| Self::parse_lines(&lines))
    }

    /// Reads header and numbers of the grid; the error gives the line at fault.
    fn parse_lines(lines: &[(usize, &str)]) -> Result<Self, String> {
        let mut entries = [None; KEYS.len()];
        let mut remaining = lines;
        while let Some((&(n, line), after)) = remaining.split_first() {
            let mut words = line.split_whitespace();
            let key = words.next().unwrap_or_default().to_lowercase();
            let Some(key_index) = KEYS.iter().position(|known| **known == key) else {
                break;
            };
            let word = words.next().unwrap_or_default();
            if key == "byteorder" {
                return Err("header: byteorder belongs to a binary grid (.hdr, .flt): export it as an ASCII grid".into());
            }
            entries[key_index] =
                Some(parse_number(word).ok_or_else(|| no_number_message(n, 1, word))?);
            remaining = after;
        }
        let entry = |key: &str| {
            KEYS.iter()
                .position(|known| *known == key)
                .and_then(|n| entries[n])
        };
        let count_of = |key: &str| {
            let number = entry(key).ok_or_else(|| format!("header: {key} is missing"))?;
            if number >= 1.0 && number.fract() == 0.0 && number <= MOST_SAMPLES {
                Ok(number as usize)
            } else {
                Err(format!(
                    "header: {key} = {number}: must be a whole number from 1 to {MOST_SAMPLES:.0e}"
                ))
            }
        };
        let (nx, ny) = (count_of("ncols")?, count_of("nrows")?);
        let length = |key: &str| {
            let length = entry(key).or(entry("cellsize")).filter(|d| *d > 0.0);
            length.ok_or_else(|| "header: cellsize must be a positive length".to_owned())
        };
        let pitch = (length("dx")?, length("dy")?);
        let nodata = entry("nodata_value").or(entry("nodata")).unwrap_or(NODATA);
        let parting = Separator::detect(remaining);
        let (mut numbers, mut signs) = (Vec::new(), DecimalSigns::default());
        for &(n, line) in remaining {
            for (column, field) in parting.fields(line).iter().enumerate() {
                signs.check(n, field)?;
                let value =
                    parse_number(field).ok_or_else(|| no_number_message(n, column, field))?;
                numbers.push(if value == nodata { f64::NAN } else { value });
            }
        }
        let number_count = numbers.len();
        let mut rows = Array2::from_shape_vec((ny, nx), numbers).map_err(|_| {
            format!("has {number_count} numbers: must have ncols x nrows = {nx} x {ny}")
        })?;
        // The first line is the northernmost.
        rows.invert_axis(Axis(0));
        Ok(Self {
            values: rows.reversed_axes(),
            pitch,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Header;

    #[test]
    fn the_header_of_gwyddion_is_read_in_any_language() {
        let lines = |text: &str| text.lines().map(ToOwned::to_owned).collect::<Vec<_>>();
        let header =
            lines("Channel: Topography\nWidth: 48.0 \u{b5}m\nHeight: 40 \u{3bc}m\nValue units: nm");
        let english = Header::parse(&header).expect("a header");
        let header = lines(
            "Kanal: Topography\nBreite: 48,0 \u{b5}m\nH\u{f6}he: 40 \u{b5}m\nWerteinheiten: nm",
        );
        assert_eq!(Header::parse(&header), Ok(english));
        for lines_without_header in [
            "a: 1 um\nb: 2 um",
            "Rig: A\nStroke: 4 um\nDrift: 1 um\nMade by: me",
        ] {
            assert_eq!(Header::parse(&lines(lines_without_header)), Ok(None));
        }
        assert!(Header::parse(&lines("Width: 4 apples\nHeight: 3 um")).is_err());
    }
}
