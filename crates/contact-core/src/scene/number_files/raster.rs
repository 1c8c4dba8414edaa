//! Text with a header of its own: Gwyddion's export and ESRI's ASCII grid. Their lines run along x,
//! from the top. There y is smallest in a picture of Gwyddion, in which z points into the picture,
//! and largest on a map of ESRI.

use ndarray::{Array2, Axis};

use super::field::{Parting, number};
use super::table::{Lines, Signs, Table, no_number};
use super::unit::{self, Kind};

/// What the header of Gwyddion's text says of the rows below it.
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
    /// The header in the comments of a table, if it is one.
    pub(super) fn of(comments: &[String]) -> Result<Option<Self>, String> {
        let entry = |key: &str| {
            let of_key = comments.iter().filter_map(|line| line.split_once(':'));
            let mut values = of_key.filter(|(name, _)| name.trim().eq_ignore_ascii_case(key));
            values.next().map(|(_, value)| value.trim())
        };
        let (Some(width), Some(height)) = (entry("Width"), entry("Height")) else {
            return Ok(Self::of_another_language(comments));
        };
        Ok(Some(Self {
            channel: entry("Channel").map(ToOwned::to_owned),
            size: (length(width)?, length(height)?),
            unit: entry("Value units").map(ToOwned::to_owned),
        }))
    }

    /// The same four lines in another language: channel, width, height and unit, in this order.
    fn of_another_language(comments: &[String]) -> Option<Self> {
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
                size: (length(&width).ok()?, length(&height).ok()?),
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
fn length(text: &str) -> Result<f64, String> {
    let (value, word) = text.split_once(char::is_whitespace).unwrap_or((text, ""));
    let known = unit::named(word).filter(|(kind, _)| *kind == Kind::Length);
    let length = number(value)
        .zip(known)
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
/// What stands for no number where the header does not say it.
const NODATA: f64 = -9999.0;
/// Most samples along a side that a header may ask for.
const MOST_SAMPLES: f64 = 1e9;

impl EsriGrid {
    /// The grid of a text, if it begins as one.
    pub(super) fn of(text: &str) -> Option<Result<Self, String>> {
        let Lines { lines, .. } = Lines::of(text);
        let first = lines.first()?.1.split_whitespace().next()?.to_lowercase();
        if let Some((_, program)) = OTHERS.iter().find(|(mark, _)| **mark == first) {
            return Some(Err(format!(
                "is a grid of {program}: export it as an ESRI ASCII grid, or as points x, y and height"
            )));
        }
        KEYS.contains(&first.as_str()).then(|| Self::read(&lines))
    }

    fn read(lines: &[(usize, &str)]) -> Result<Self, String> {
        let mut entries = [None; KEYS.len()];
        let mut rest = lines;
        while let Some((&(n, line), after)) = rest.split_first() {
            let mut words = line.split_whitespace();
            let key = words.next().unwrap_or_default().to_lowercase();
            let Some(place) = KEYS.iter().position(|known| **known == key) else {
                break;
            };
            let word = words.next().unwrap_or_default();
            if key == "byteorder" {
                return Err("header: byteorder belongs to a binary grid (.hdr, .flt): export it as an ASCII grid".into());
            }
            entries[place] = Some(number(word).ok_or_else(|| no_number(n, 1, word))?);
            rest = after;
        }
        let entry = |key: &str| {
            KEYS.iter()
                .position(|known| *known == key)
                .and_then(|n| entries[n])
        };
        let count = |key: &str| {
            let found = entry(key).ok_or_else(|| format!("header: {key} is missing"))?;
            if found >= 1.0 && found.fract() == 0.0 && found <= MOST_SAMPLES {
                Ok(found as usize)
            } else {
                Err(format!(
                    "header: {key} = {found}: must be a whole number from 1 to {MOST_SAMPLES:.0e}"
                ))
            }
        };
        let (nx, ny) = (count("ncols")?, count("nrows")?);
        let length = |key: &str| {
            let length = entry(key).or(entry("cellsize")).filter(|d| *d > 0.0);
            length.ok_or_else(|| "header: cellsize must be a positive length".to_owned())
        };
        let pitch = (length("dx")?, length("dy")?);
        let nodata = entry("nodata_value").or(entry("nodata")).unwrap_or(NODATA);
        let parting = Parting::of(rest);
        let (mut numbers, mut signs) = (Vec::new(), Signs::default());
        for &(n, line) in rest {
            for (column, field) in parting.fields(line).iter().enumerate() {
                signs.see(n, field)?;
                let value = number(field).ok_or_else(|| no_number(n, column, field))?;
                numbers.push(if value == nodata { f64::NAN } else { value });
            }
        }
        let found = numbers.len();
        let mut rows = Array2::from_shape_vec((ny, nx), numbers)
            .map_err(|_| format!("has {found} numbers: must have ncols x nrows = {nx} x {ny}"))?;
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
    fn the_header_of_gwyddion_is_known_in_any_language() {
        let lines = |text: &str| text.lines().map(ToOwned::to_owned).collect::<Vec<_>>();
        let said =
            lines("Channel: Topography\nWidth: 48.0 \u{b5}m\nHeight: 40 \u{3bc}m\nValue units: nm");
        let english = Header::of(&said).expect("a header");
        let said = lines(
            "Kanal: Topography\nBreite: 48,0 \u{b5}m\nH\u{f6}he: 40 \u{b5}m\nWerteinheiten: nm",
        );
        assert_eq!(Header::of(&said), Ok(english));
        for none in [
            "a: 1 um\nb: 2 um",
            "Rig: A\nStroke: 4 um\nDrift: 1 um\nMade by: me",
        ] {
            assert_eq!(Header::of(&lines(none)), Ok(None));
        }
        assert!(Header::of(&lines("Width: 4 apples\nHeight: 3 um")).is_err());
    }
}
