//! WHAT is in contact, as the user writes it: one file per part of the scene.

mod body;
mod branch;
mod branches;
mod forces;
mod friction;
pub(crate) mod friction_law;
mod grid;
mod increments;
mod load_path;
mod profile;
mod settings;
mod shape;
mod waypoints;
mod whole;

pub(crate) use crate::material::{Bond, Coating, Elastic};
pub(crate) use crate::plastic::Plastic;
pub(crate) use body::Body;
pub(crate) use branch::{Branch, Spacing};
pub(crate) use friction::{AnyFriction, Friction, History};
pub(crate) use grid::{Grid, Pitch};
pub(crate) use increments::PerRange;
pub(crate) use load_path::LoadPath;
pub(crate) use profile::{Profile, graded};
pub(crate) use settings::{Settings, check_settings};
pub(crate) use shape::{
    Cone, CrownedRoller, Cylinder, Ellipsoid, Flat, FlatPunch, Ridges, Ring, Rough, Sphere, Sum,
    SurfaceMap, Waviness, Wedge, check_sides, map_from_heights,
};
pub(crate) use whole::Scene;
