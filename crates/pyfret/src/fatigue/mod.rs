//! Fatigue criteria, yield and shakedown on plain stress histories.

mod assessment;
mod criterion;
mod damage;
mod material;
mod on_stress;
mod turns;

pub(crate) use assessment::Assessment;
pub(crate) use criterion::{Criterion, add_criteria, criteria};
pub(crate) use damage::{damage_of_values, damage_on, spectral_cycles};
pub(crate) use material::{
    Material, find_material, known_as, material_quantities, materials, nearest_materials,
};
pub(crate) use on_stress::{AT_POINT, FACTORS, criterion_on, dang_van_path, yielding_on};
pub(crate) use turns::find_turns;
