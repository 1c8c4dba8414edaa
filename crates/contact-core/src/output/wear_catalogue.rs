//! The contents of the store of a run of wear.

use crate::wear::Jump;

/// Name, unit, meaning and value.
pub(super) type Scalar = (&'static str, &'static str, &'static str, fn(&Jump) -> f64);

/// Every scalar over `jump`.
pub(super) const SCALARS: [Scalar; 21] = [
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
        "bound of the error that the jumps leave of the deepest depth, over it",
        |j| j.depth_error,
    ),
    ("retries", "1", "times that the jump was tried anew", |j| {
        j.retries as f64
    }),
    ("index", "1", "jump, from 1", |j| j.index as f64),
];

/// The other arrays: cycles of the blocks, the fields and the friction loops over `block`.
const BLOCKS: [&str; 12] = [
    "block_cycles",
    "worn1",
    "worn2",
    "energy1",
    "energy2",
    "slid",
    "p",
    "stick",
    "loop_delta_x",
    "loop_T_x",
    "loop_delta_y",
    "loop_T_y",
];

/// Whether such a store has an array of that name, beside its coordinates x and y.
pub(super) fn holds(name: &str) -> bool {
    BLOCKS.contains(&name) || SCALARS.iter().any(|(scalar, ..)| *scalar == name)
}
