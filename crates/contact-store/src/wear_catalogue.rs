//! The contents of the store of a run of wear.

use contact_wear::{Block, Jump};

use super::catalogue::FieldView;

/// Name, unit, meaning and value.
pub(super) type Scalar = (&'static str, &'static str, &'static str, fn(&Jump) -> f64);

/// Every scalar over `jump`.
pub(super) const SCALARS: [Scalar; 28] = [
    ("cycles", "1", "cycles at the end of the jump", |j| j.cycles),
    ("length", "1", "cycles that the jump is long", |j| j.length),
    ("volume1", "m^3", "volume that body 1 has lost", |j| {
        j.volume[0]
    }),
    ("volume2", "m^3", "volume that body 2 has lost", |j| {
        j.volume[1]
    }),
    ("depth1", "m", "deepest worn depth of body 1", |j| {
        j.depth[0]
    }),
    ("depth2", "m", "deepest worn depth of body 2", |j| {
        j.depth[1]
    }),
    (
        "volume1_halfway",
        "m^3",
        "volume that body 1 had lost half of the jump earlier",
        |j| j.volume_halfway[0],
    ),
    (
        "volume2_halfway",
        "m^3",
        "volume that body 2 had lost half of the jump earlier",
        |j| j.volume_halfway[1],
    ),
    (
        "depth1_halfway",
        "m",
        "deepest worn depth of body 1 half of the jump earlier",
        |j| j.depth_halfway[0],
    ),
    (
        "depth2_halfway",
        "m",
        "deepest worn depth of body 2 half of the jump earlier",
        |j| j.depth_halfway[1],
    ),
    (
        "debris",
        "m^3",
        "volume that stays in the contact as debris",
        |j| j.debris,
    ),
    (
        "ejected",
        "m^3",
        "volume of debris that has left the contact",
        |j| j.ejected,
    ),
    (
        "aerated_share",
        "1",
        "share of the area of the contact that oxygen reaches",
        |j| j.aerated_share,
    ),
    (
        "dissipated",
        "J",
        "energy dissipated by friction so far",
        |j| j.dissipated,
    ),
    (
        "dissipated_per_cycle",
        "J",
        "energy dissipated in one cycle on the worn surfaces",
        |j| j.dissipated_per_cycle,
    ),
    (
        "mu",
        "1",
        "mean coefficient of friction in the jump: energy over the integral of pressure over slip",
        |j| j.mu,
    ),
    (
        "mu_error",
        "1",
        "error of the mean coefficient of friction by jump and cells, over it",
        |j| j.mu_error,
    ),
    ("p_max", "Pa", "largest pressure", |j| j.p_max),
    ("contact_area", "m^2", "area of the contact", |j| {
        j.contact_area
    }),
    (
        "stick_ratio",
        "1",
        "area that sticks all through a cycle over that of the contact",
        |j| j.stick_ratio,
    ),
    (
        "error",
        "1",
        "estimated error of the depth that the jump adds, over the depth (root mean squares)",
        |j| j.error,
    ),
    ("pressure_error", "1", "the same of the pressure", |j| {
        j.pressure_error
    }),
    (
        "depth_error",
        "1",
        "error of the deepest depth by jumps and cells, over it",
        |j| j.depth_error,
    ),
    (
        "volume_error",
        "1",
        "error of the volume by jumps and cells, over it",
        |j| j.volume_error,
    ),
    (
        "slip_cells",
        "1",
        "cells across the zone that slips, when it was widest",
        |j| j.slip_cells,
    ),
    (
        "p_max_error",
        "1",
        "error of the largest pressure by cells and jump, over it; infinite where it is singular",
        |j| j.p_max_error,
    ),
    ("retries", "1", "times that the jump was tried anew", |j| {
        j.retries as f64
    }),
    ("index", "1", "jump, from 1", |j| j.index as f64),
];

/// Name, unit, meaning and values.
type Field = (
    &'static str,
    &'static str,
    &'static str,
    fn(&Block) -> FieldView<'_>,
);

/// Every field over `block`, `x`, `y`.
pub(super) const FIELDS: [Field; 9] = [
    (
        "worn1",
        "m",
        "depth worn off body 1, in its own coordinates",
        |b| FieldView::Real(&b.worn1),
    ),
    (
        "worn2",
        "m",
        "depth worn off body 2, in its own coordinates",
        |b| FieldView::Real(&b.worn2),
    ),
    (
        "energy1",
        "J/m^2",
        "energy per area dissipated at body 1 so far, in its own coordinates",
        |b| FieldView::Real(&b.energy1),
    ),
    (
        "energy2",
        "J/m^2",
        "energy per area dissipated at body 2 so far, in its own coordinates",
        |b| FieldView::Real(&b.energy2),
    ),
    ("slid", "m", "way slipped in contact so far", |b| {
        FieldView::Real(&b.slid)
    }),
    (
        "bed",
        "m",
        "debris per area in the contact, in the coordinates of the grid",
        |b| FieldView::Real(&b.bed),
    ),
    (
        "aerated",
        "1",
        "share of the cell that oxygen reaches",
        |b| FieldView::Real(&b.aerated),
    ),
    (
        "p",
        "Pa",
        "pressure: mean of the cycle, or that in the middle of the stroke",
        |b| FieldView::Real(&b.p),
    ),
    (
        "stick",
        "1",
        "contact cells that slip nowhere in a cycle",
        |b| FieldView::Mask(&b.stick),
    ),
];

/// The friction loops over `block`, `corner`, in the order of [`Block::friction_loop`]: name, unit
/// of a contact of two directions and meaning.
pub(super) const FRICTION_LOOP: [(&str, &str, &str); 4] = [
    ("loop_delta_x", "m", "shift along x in the friction loop"),
    ("loop_T_x", "N", "force along x in the friction loop"),
    ("loop_delta_y", "m", "shift along y in the friction loop"),
    ("loop_T_y", "N", "force along y in the friction loop"),
];

/// Checks that a store of wear has an array of that name, beside its coordinates x and y.
pub(super) fn has_array(name: &str) -> bool {
    let scalars = SCALARS.iter().map(|(name, ..)| *name);
    let fields = FIELDS.iter().map(|(name, ..)| *name);
    let friction_loop = FRICTION_LOOP.iter().map(|(name, ..)| *name);
    let mut names = scalars.chain(fields).chain(friction_loop);
    name == "block_cycles" || names.any(|other| other == name)
}
