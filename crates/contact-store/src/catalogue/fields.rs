//! The variables over the cells.

use contact_core::march::Fields;

use super::{Field, FieldView, Kind};

/// A field of numbers over the cells.
const fn real_field(
    name: &'static str,
    units: &'static str,
    long_name: &'static str,
    values: fn(&Fields) -> FieldView<'_>,
) -> Field {
    Field {
        name,
        units,
        long_name,
        kind: Kind::Real,
        values,
    }
}

/// A field of true and false over the cells.
const fn mask(
    name: &'static str,
    long_name: &'static str,
    values: fn(&Fields) -> FieldView<'_>,
) -> Field {
    Field {
        name,
        units: "1",
        long_name,
        kind: Kind::Flag,
        values,
    }
}

/// The variables over `saved`, `x`, `y`.
pub const FIELDS: &[Field] = &[
    real_field("p", "Pa", "pressure", |f| FieldView::Real(&f.p)),
    real_field("q_x", "Pa", "shear traction on body 2 along x", |f| {
        FieldView::Real(&f.q_x)
    }),
    real_field("q_y", "Pa", "shear traction on body 2 along y", |f| {
        FieldView::Real(&f.q_y)
    }),
    real_field("u_x", "m", "relative surface displacement along x", |f| {
        FieldView::Real(&f.u_x)
    }),
    real_field("u_y", "m", "relative surface displacement along y", |f| {
        FieldView::Real(&f.u_y)
    }),
    real_field("u_z", "m", "relative surface displacement along z", |f| {
        FieldView::Real(&f.u_z)
    }),
    real_field("gap", "m", "gap between the surfaces", |f| {
        FieldView::Real(&f.gap)
    }),
    real_field(
        "indentation",
        "m",
        "permanent indentation under the hardness",
        |f| FieldView::Real(&f.indentation),
    ),
    real_field("slip_x", "m", "slip along x added up over the path", |f| {
        FieldView::Real(&f.slip_x)
    }),
    real_field("slip_y", "m", "slip along y added up over the path", |f| {
        FieldView::Real(&f.slip_y)
    }),
    real_field(
        "dissipated_density",
        "J/m^2",
        "energy dissipated per area",
        |f| FieldView::Real(&f.dissipated),
    ),
    mask("contact", "cells that transmit pressure", |f| {
        FieldView::Mask(&f.contact)
    }),
    mask("stick", "contact cells that do not slip", |f| {
        FieldView::Mask(&f.stick)
    }),
    mask(
        "at_limit",
        "cells that stick at the limit of friction",
        |f| FieldView::Mask(&f.at_limit),
    ),
];
