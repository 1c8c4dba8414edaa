//! The rim of a contact and the border of its stick zone, where the stress at the surface has its
//! cusps.

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::scene::Grid;
use contact_core::zones::{Continued, Crossing};

use super::Line;
use super::loads::Plane;

/// A zone that ends at a border.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Zone {
    /// The contact: its rim.
    Contact,
    /// The stick zone.
    Stick,
}

/// A place on the border of a zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Border {
    /// Place on the surface \[m\].
    pub x: f64,
    /// Place on the surface \[m\].
    pub y: f64,
    /// The zone that ends there.
    pub zone: Zone,
    /// True if the border is extrapolated to a place within a cell from the tractions further in;
    /// else it is assumed.
    pub within_cell: bool,
}

/// Finds the places where a line crosses the rim of the contact and the border of the stick zone.
/// The tractions have the shape (nx, ny) \[Pa\]. Without `stick` only the rim is found. Without a
/// line all rows and columns of cells are crossed.
pub fn borders(
    grid: &Grid,
    tractions: &Tractions<'_>,
    stick: Option<&[bool]>,
    line: Option<Line>,
) -> Result<Vec<Border>, Error> {
    grid.check_alone()?;
    let fields = [tractions.p, tractions.q_x, tractions.q_y];
    let sizes = fields.into_iter().flatten().map(<[f64]>::len);
    for size in sizes.chain(stick.map(<[bool]>::len)) {
        if size != grid.cells() {
            let allowed = format!("one for each of the {} cells", grid.cells());
            return Err(Error::invalid(
                "tractions",
                format!("{size} numbers"),
                allowed,
            ));
        }
    }
    let window = (0..grid.nx, 0..grid.ny);
    let continued = Continued::new(grid, tractions, stick, &window, false);
    Ok(find_borders(&continued, grid, line))
}

/// Finds the crossings of a line with rim and stick border in continued tractions; without a line, the crossings of all rows and
/// columns of cells.
pub(super) fn find_borders(continued: &Continued, grid: &Grid, line: Option<Line>) -> Vec<Border> {
    let Plane { n, d, .. } = Plane::new(grid, false);
    let [to_column, to_row] =
        [(n.0, d.0), (n.1, d.1)].map(|(n, d)| move |v: f64| v / d + (n - 1) as f64 / 2.0);
    let border = |Crossing {
                      place: [column, row],
                      stick,
                      is_within_cell: within_cell,
                  }: Crossing| Border {
        x: (column - (n.0 - 1) as f64 / 2.0) * d.0,
        y: (row - (n.1 - 1) as f64 / 2.0) * d.1,
        zone: if stick { Zone::Stick } else { Zone::Contact },
        within_cell,
    };
    let crossings: Vec<Crossing> = match line {
        Some(Line::AlongX(y)) => continued.crossings(0, to_row(y)),
        Some(Line::AlongY(x)) => continued.crossings(1, to_column(x)),
        Some(line @ Line::Through { .. }) => {
            let cells = |s: f64| {
                let (x, y) = line.place(s);
                [to_column(x), to_row(y)]
            };
            let (from, to) = (cells(0.0), cells(line.step(grid)));
            let ends = [line.places(grid).first(), line.places(grid).last()]
                .map(|end| end.map_or(0.0, |s| s / line.step(grid)));
            continued.crossings_along(from, [to[0] - from[0], to[1] - from[1]], ends)
        }
        None => {
            let rows = (0..n.1).flat_map(|j| continued.crossings(0, j as f64));
            let columns = (0..n.0).flat_map(|i| continued.crossings(1, i as f64));
            if n.1 == 1 {
                rows.collect()
            } else {
                rows.chain(columns).collect()
            }
        }
    };
    crossings.into_iter().map(border).collect()
}
