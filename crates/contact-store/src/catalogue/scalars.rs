//! The variables over the increments.

use contact_core::march::Increment;

use super::{Kind, Scalar};

/// A number per increment.
const fn real(
    name: &'static str,
    units: &'static str,
    long_name: &'static str,
    value: fn(&Increment) -> f64,
) -> Scalar {
    Scalar {
        name,
        units,
        long_name,
        kind: Kind::Real,
        value,
    }
}

/// A whole number per increment.
const fn count(
    name: &'static str,
    long_name: &'static str,
    value: fn(&Increment) -> f64,
) -> Scalar {
    Scalar {
        name,
        units: "1",
        long_name,
        kind: Kind::Count,
        value,
    }
}

/// The variables over `increment`, for a contact of two directions; [`Scalar::for_grid`] adapts
/// them to a run. The first three are coordinates.
pub const SCALARS: &[Scalar] = &[
    count("increment", "increment, counted from 1", |i| i.index as f64),
    real("t", "1", "path time", |i| i.point.t),
    count(
        "branch_of_increment",
        "branch of the load path, counted from 0",
        |i| i.point.branch as f64,
    ),
    real("W", "N", "normal force, compression positive", |i| {
        i.point.loads.W
    }),
    real("T_x", "N", "tangential force on body 2 along x", |i| {
        i.point.loads.T_x
    }),
    real("T_y", "N", "tangential force on body 2 along y", |i| {
        i.point.loads.T_y
    }),
    real("M_x", "N m", "tilting moment about x", |i| {
        i.point.loads.M_x
    }),
    real("M_y", "N m", "tilting moment about y", |i| {
        i.point.loads.M_y
    }),
    real("M_z", "N m", "torsional moment on body 2", |i| {
        i.point.loads.M_z
    }),
    real("sigma_B", "Pa", "bulk stress along x in body 2", |i| {
        i.point.loads.sigma_B
    }),
    real("sigma_B1", "Pa", "bulk stress along x in body 1", |i| {
        i.point.loads.sigma_B1
    }),
    real(
        "rolled",
        "m",
        "way that the contact has rolled along x",
        |i| i.point.loads.rolled,
    ),
    real("delta_z", "m", "approach of the bodies", |i| {
        i.motion.delta_z
    }),
    real(
        "delta_x",
        "m",
        "relative tangential shift of the bodies along x",
        |i| i.motion.delta_x,
    ),
    real(
        "delta_y",
        "m",
        "relative tangential shift of the bodies along y",
        |i| i.motion.delta_y,
    ),
    real("phi_x", "rad", "tilt of body 1 about x", |i| i.motion.phi_x),
    real("phi_y", "rad", "tilt of body 1 about y", |i| i.motion.phi_y),
    real("phi_z", "rad", "rotation of body 1 about z", |i| {
        i.motion.phi_z
    }),
    Scalar {
        name: "status",
        units: "1",
        long_name: "state of the interface",
        kind: Kind::Code,
        value: |i| f64::from(i.status.code()),
    },
    real("contact_area", "m^2", "area of the contact", |i| {
        i.contact_area
    }),
    real("stick_area", "m^2", "area of the stick zone", |i| {
        i.stick_area
    }),
    real(
        "stick_ratio",
        "1",
        "stick area over contact area, NaN without contact",
        Increment::stick_ratio,
    ),
    real(
        "contact_radius",
        "m",
        "radius of the circle of the contact area",
        |i| i.contact_radius,
    ),
    real(
        "cells_per_radius",
        "1",
        "cells across the radius of the contact, its half width, or that of its spots",
        |i| i.cells_per_radius,
    ),
    real(
        "real_area",
        "m^2",
        "area of the cells in contact, corrected for their perimeter",
        |i| i.spots.real_area(),
    ),
    real(
        "real_area_error",
        "m^2",
        "error of the real area by the size of the cells",
        |i| i.spots.real_area_error(),
    ),
    real(
        "nominal_area",
        "m^2",
        "area of the contact of the shapes without roughness; the grid for flats and maps",
        |i| i.spots.nominal_area,
    ),
    count("spots", "patches of cells in contact that touch", |i| {
        i.spots.count as f64
    }),
    real(
        "largest_spot",
        "m^2",
        "area of the largest spot, corrected like the real area",
        |i| i.spots.largest,
    ),
    real(
        "lone_share",
        "1",
        "part of the cells in contact that have no neighbour in contact",
        |i| i.spots.lone_share,
    ),
    real(
        "mean_gap",
        "m",
        "gap between the surfaces, mean over the nominal contact",
        |i| i.spots.mean_gap,
    ),
    real(
        "mean_pressure",
        "Pa",
        "normal force over the area of the cells in contact",
        |i| i.spots.mean_pressure(i.point.loads.W),
    ),
    real(
        "rms_slope",
        "1",
        "slopes of the gap between undeformed uneven surfaces, root mean square over the nominal contact",
        |i| i.spots.rms_slope,
    ),
    real(
        "slope_length",
        "m",
        "distance of the points between which the slopes were taken",
        |i| i.spots.slope_length,
    ),
    real("p_max", "Pa", "largest pressure", |i| i.p_max),
    real("q_max", "Pa", "largest shear traction", |i| i.q_max),
    real(
        "q_rms",
        "Pa",
        "shear traction, root mean square over the contact",
        |i| i.q_rms,
    ),
    real(
        "q_scatter",
        "Pa",
        "scatter of the shear from cell to cell where the bodies stick, at the end of a branch",
        |i| i.q_scatter.unwrap_or(f64::NAN),
    ),
    real("plastic_work", "J", "plastic work in the increment", |i| {
        i.energy.plastic
    }),
    real(
        "plastic_volume",
        "m^3",
        "volume that has yielded so far",
        |i| i.yielded.volume,
    ),
    real(
        "largest_plastic_strain",
        "1",
        "largest equivalent plastic strain so far",
        |i| i.yielded.largest,
    ),
    real(
        "strain_at_rim",
        "1",
        "1 where that strain lies at the border of slip or in a coating, where it does not converge",
        |i| f64::from(u8::from(i.yielded.at_rim)),
    ),
    real(
        "yield_ratio",
        "1",
        "largest stress of von Mises over the yield stress, 1 where a body yields",
        |i| i.yielded.reached,
    ),
    real(
        "work",
        "J",
        "work of the applied forces in the increment",
        |i| i.energy.work,
    ),
    real(
        "elastic",
        "J",
        "change of the elastic energy in the increment, that of the residual stress included",
        |i| i.energy.elastic,
    ),
    real(
        "dissipated",
        "J",
        "energy dissipated by friction in the increment",
        |i| i.energy.dissipated,
    ),
    real(
        "opening",
        "J",
        "work of the pressure on closing and opening cells",
        |i| i.energy.opening,
    ),
    real(
        "quadrature",
        "J",
        "dissipated and plastic_work less what the trapezoidal rule makes of them",
        |i| i.energy.quadrature,
    ),
    real(
        "residual_gap",
        "1",
        "root-mean-square gap in the contact over the Hertz approach",
        |i| i.residuals.gap,
    ),
    real(
        "residual_penetration",
        "1",
        "deepest penetration over the Hertz approach",
        |i| i.residuals.penetration,
    ),
    real(
        "residual_coulomb",
        "1",
        "largest |q| - mu p over mu p_max",
        |i| i.residuals.coulomb,
    ),
    real(
        "residual_stick",
        "1",
        "root-mean-square distance of stick cells from where they stick over mu approach",
        |i| i.residuals.stick,
    ),
    real(
        "residual_direction",
        "1",
        "root-mean-square slip across q over mu approach",
        |i| i.residuals.direction,
    ),
    real(
        "residual_angle",
        "rad",
        "root-mean-square angle between slip and the shear it opposes",
        |i| i.residuals.angle,
    ),
    real(
        "residual_balance",
        "1",
        "largest relative error of the force balances",
        |i| i.residuals.balance,
    ),
    real(
        "residual_energy",
        "1",
        "energy imbalance over the work done so far",
        |i| i.residuals.energy,
    ),
    real(
        "convolutions",
        "1",
        "convolutions of three components",
        |i| i.work.convolutions,
    ),
    count("alternations", "passes of the intermediate loop", |i| {
        i.work.alternations as f64
    }),
    count(
        "normal_iterations",
        "iterations of the normal solver",
        |i| i.work.normal_iterations as f64,
    ),
    count(
        "tangential_iterations",
        "iterations of the tangential solver",
        |i| i.work.tangential_iterations as f64,
    ),
    count(
        "path_grid",
        "cells along x of the grid that the increment was solved on",
        |i| i.path_grid as f64,
    ),
    count("parts", "pieces that the increment was solved in", |i| {
        i.work.parts as f64
    }),
];
