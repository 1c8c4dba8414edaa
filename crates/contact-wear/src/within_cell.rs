//! Error of the worn depth by the place of the border of the stick zone within its cell.
//!
//! A contact that is worn until nothing changes rests on its stick zone, and the surfaces outside
//! are worn by their overlap. If the zone is narrower by half a cell on one side,
//! its outermost cell is recessed by `beta p`, beta = B for phi = 1/2 (`border`): with the pressure
//! `p'` of the zone so recessed and p of the zone itself, both of the same force, the overlap grows
//! by
//!
//! ```text
//! dw = [C (p - p')] - [C (p - p')]_zone.
//! ```
//!
//! This is the error of the worn depth if the border is known to half a cell, times the
//! part of its pressure that the slip zone has lost.

use contact_core::Error;
use contact_core::cells::Lattice;

use super::border::{BORDER_STIFFNESS, Cut};
use super::loss::Worn;
use super::pressing::Pressing;

/// Error to which the pressure is solved, over the tolerance of the scene.
const ROUGH_TOLERANCE: f64 = 10.0;
/// Cells worn so deep, over the deepest, count as the deepest ones.
const DEEP: f64 = 0.9;

/// The error of the deepest depth worn off a body of a line contact, in the limit of endless wear
/// \[m\]. The border of the zone of cells that `stick` is known to half a cell. The error is zero
/// if each border lies in one of the `cuts`. p is the pressure.
pub(crate) fn half_cell_error(
    pressing: &mut Pressing,
    stick: &[bool],
    cuts: &[Cut],
    p: &[f64],
    (worn, opens): (&Worn, f64),
) -> Result<f64, Error> {
    if !pressing.grid.plane_strain || opens <= 0.0 {
        return Ok(0.0);
    }
    let pressed: Vec<bool> = stick.iter().zip(p).map(|(s, p)| *s && *p > 0.0).collect();
    let border = Lattice::new(&pressing.grid, pressing.mirror).border(&pressed);
    let is_unknown_border =
        |n: &usize| pressed[*n] && !cuts.iter().any(|cut| cut.cell.abs_diff(*n) <= 1);
    let is_unknown_border: Vec<usize> = border.into_iter().filter(is_unknown_border).collect();
    if is_unknown_border.is_empty() {
        return Ok(0.0);
    }
    let of_zone = |values: &[f64]| -> Vec<f64> {
        let cells = values.iter().zip(&pressed);
        cells
            .map(|(v, pressed)| if *pressed { *v } else { 0.0 })
            .collect()
    };
    let p = of_zone(p);
    let u = pressing.response(&p);
    let deepest = u.iter().fold(0.0, |m: f64, u| m.max(*u));
    // The zone touches under p, and no other cell ever does.
    let gap = u.iter().zip(&pressed);
    let h: Vec<f64> = gap
        .map(|(u, pressed)| deepest - u + if *pressed { 0.0 } else { deepest })
        .collect();
    let mut compliance = vec![0.0; p.len()];
    for n in is_unknown_border {
        compliance[n] = BORDER_STIFFNESS * pressing.shortest_waves();
    }
    let drive = pressing.drive(p.iter().sum::<f64>() * pressing.cell_area());
    let mut recessed = p.clone();
    pressing.begin();
    match pressing.solve(&h, &compliance, drive, &mut recessed, ROUGH_TOLERANCE) {
        // An estimate that fails ends no run: nothing is known of the depth.
        Err(Error::NotConverged { .. }) => return Ok(worn.deepest()),
        solved => solved?,
    };
    pressing.begin();
    let change: Vec<f64> = p.iter().zip(&recessed).map(|(p, r)| p - r).collect();
    let change = pressing.response(&change);
    let inside: Vec<f64> = (0..p.len())
        .filter(|n| pressed[*n] && compliance[*n] == 0.0)
        .map(|n| change[n])
        .collect();
    let zone = inside.iter().sum::<f64>() / (inside.len() as f64).max(1.0);
    let of_body = |depth: &Vec<f64>| {
        let deepest = depth.iter().fold(0.0, |m: f64, w| m.max(*w));
        let deep = (0..p.len()).filter(|n| !pressed[*n] && depth[*n] > DEEP * deepest);
        let error = deep.map(|n| {
            let part = depth[n] / (worn.depth[0][n] + worn.depth[1][n]);
            part * (change[n] - zone).abs() / opens
        });
        error.fold(0.0, f64::max)
    };
    let [depth1, depth2] = &worn.depth;
    Ok(of_body(depth1).max(of_body(depth2)))
}
