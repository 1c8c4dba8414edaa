//! Every variable of the store: name, unit, meaning, and its source in the results.

mod fields;
mod scalars;
mod yielded;

pub use self::fields::FIELDS;
pub use self::scalars::SCALARS;
pub use self::yielded::{POINTS, PointVariable, YIELDED, from_rows, to_rows};

use contact_core::march::{Fields, Increment};
use contact_core::scene::Grid;
use ndarray::Array2;

/// Storage type of the numbers of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Real number, 8 bytes.
    Real,
    /// Whole number, 4 bytes.
    Count,
    /// One of a few cases, 1 byte.
    Code,
    /// Yes or no.
    Flag,
}

/// A number of every increment.
#[derive(Clone, Copy, Debug)]
pub struct Scalar {
    /// Name.
    pub name: &'static str,
    /// Unit; `1` for a number without.
    pub units: &'static str,
    /// Meaning, for people.
    pub long_name: &'static str,
    /// Storage type.
    pub kind: Kind,
    /// Its value.
    pub value: fn(&Increment) -> f64,
}

/// Name and meaning of the `contact_radius` of a line contact.
pub(super) const HALF_WIDTH: (&str, &str) = ("half_width", "half the width of the contact");

impl Scalar {
    /// Adapts the variable to a grid. In a line contact half the width replaces the radius, and
    /// units are per metre.
    #[must_use]
    pub fn for_grid(self, grid: &Grid) -> Self {
        let (name, long_name) = match self.name {
            "contact_radius" if grid.plane_strain => HALF_WIDTH,
            name => (name, self.long_name),
        };
        Self {
            name,
            units: grid.unit_of(self.units),
            long_name,
            ..self
        }
    }
}

/// A field of the increments that are saved.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Name.
    pub name: &'static str,
    /// Unit; `1` for a number without.
    pub units: &'static str,
    /// Meaning, for people.
    pub long_name: &'static str,
    /// Storage type.
    pub kind: Kind,
    /// Its values.
    pub values: fn(&Fields) -> FieldView<'_>,
}

/// The values of a field, shape (nx, ny).
#[derive(Clone, Copy, Debug)]
pub enum FieldView<'a> {
    /// A real number per cell.
    Real(&'a Array2<f64>),
    /// Yes or no per cell.
    Mask(&'a Array2<bool>),
}

/// A coordinate that does not follow from an increment.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    /// Name.
    pub name: &'static str,
    /// Its dimension.
    pub dim: &'static str,
    /// Unit; `1` for a number without.
    pub units: &'static str,
    /// Meaning, for people.
    pub long_name: &'static str,
    /// Storage type.
    pub kind: Kind,
}

/// The coordinates of the cells, and of the increments whose fields are kept.
pub const AXES: [Axis; 4] = [
    Axis {
        name: "x",
        dim: "x",
        units: "m",
        long_name: "position along x",
        kind: Kind::Real,
    },
    Axis {
        name: "y",
        dim: "y",
        units: "m",
        long_name: "position along y",
        kind: Kind::Real,
    },
    Axis {
        name: "saved_increment",
        dim: "saved",
        units: "1",
        long_name: "increment whose fields are kept",
        kind: Kind::Count,
    },
    Axis {
        name: "saved_t",
        dim: "saved",
        units: "1",
        long_name: "path time at which fields are kept",
        kind: Kind::Real,
    },
];

/// Words for the codes of `status`, in their order.
pub const STATUS_MEANINGS: &str = "no_contact full_stick partial_slip gross_slip";
