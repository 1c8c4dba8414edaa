//! Stress below one loaded cell, in any layer of any body.
//!
//! With the amplitudes of [`WaveFields`], M = (rr + tt)/2, E, F = (rr - tt)/4 -+ rt/2 under q,
//! theta the azimuth and J_n for the Hankel integral of order n:
//!
//! ```text
//!        under p               under q_x
//! zz     J_0                   J_1 cos(theta)
//! xx,yy  J_0[M] -+ J_2 cos 2theta   J_1[M +- E] cos(theta) -+ J_3[F] cos 3theta
//! xy     -J_2 sin 2theta       J_1[E] sin(theta) - J_3[F] sin 3theta
//! xz     J_1 cos(theta)        -J_0 + J_2 cos 2theta
//! yz     J_1 sin(theta)        J_2 sin 2theta
//! ```

use std::sync::atomic::AtomicBool;

use ndarray::Array4;

use super::Quadrant;
use super::cell::Cell;
use super::coefficients::at_offset;
use super::depth_frf::WaveFields;
use super::depth_kernel::{DepthKernel, quadrants};
use super::half_space_stress::{self, StressResponse};
use super::layered_frf::{HalfSpace, Stack};
use super::quantity::Quantity;
use crate::error::Error;
use crate::magnitude::LARGEST;
use crate::memory::fits;
use crate::scene::{Body, Grid};

/// Memory of the stress coefficients of a body per cell while they are computed: eighteen
/// quadrants, twice \[bytes\].
const NUMBERS: f64 = 36.0 * 8.0;

/// The six stresses.
pub struct Stress;

/// The stresses at a depth as functions of the offset.
pub(crate) type StressKernel = DepthKernel<Stress, 10, 6>;

impl Quantity<10, 6> for Stress {
    const ORDERS: [usize; 10] = [0, 0, 2, 1, 1, 1, 1, 3, 0, 2];

    /// The ten radial amplitudes of the stress at a wave number k, from the fields of the wave. They include
    /// the factor k of k dk.
    fn amplitudes(k: f64, f: &WaveFields) -> [f64; 10] {
        let t = f.traction;
        let mean = |n: usize| f64::midpoint(f.s_rr[n], f.s_tt[n]);
        let deviation = |n: usize| (f.s_rr[n] - f.s_tt[n]) / 2.0;
        [
            -t.3,
            mean(1),
            deviation(1),
            t.1,
            -t.2,
            mean(0),
            (deviation(0) - f.s_rt) / 2.0,
            f64::midpoint(deviation(0), f.s_rt),
            f64::midpoint(t.0, f.q_t),
            (t.0 - f.q_t) / 2.0,
        ]
        .map(|a| k * a)
    }

    /// Adds the stress at (x, y) from the ten radial functions over powers of r: rows xx, yy, zz, xy, xz, yz,
    /// columns q_x, q_y, p.
    fn add(s: &mut StressResponse, x: f64, y: f64, g: [f64; 10]) {
        let [zz, mean, deviation, rz, zz_q, mean_q, e, f, p, q] = g;
        let (c2, s2) = (x * x - y * y, 2.0 * x * y);
        let (c3, s3) = (x * (x * x - 3.0 * y * y), y * (3.0 * x * x - y * y));
        let stress = [
            [
                (mean_q + e) * x - f * c3,
                (mean_q - e) * y - f * s3,
                mean - deviation * c2,
            ],
            [
                (mean_q - e) * x + f * c3,
                (mean_q + e) * y + f * s3,
                mean + deviation * c2,
            ],
            [zz_q * x, zz_q * y, zz],
            [e * y - f * s3, e * x + f * c3, -deviation * s2],
            [q * c2 - p, q * s2, rz * x],
            [q * s2, -q * c2 - p, rz * y],
        ];
        for (sum, row) in s.iter_mut().zip(stress) {
            for (sum, value) in sum.iter_mut().zip(row) {
                *sum += value;
            }
        }
    }

    /// The radial functions of a half-space at s = r^2 and the depth z.
    fn radial(material: &HalfSpace, s: f64, z: f64) -> [f64; 10] {
        half_space_stress::radial_functions(s, z, material.nu)
    }

    /// The closed form of one corner of a loaded cell.
    fn corner(
        material: &HalfSpace,
        (x, y, z): (f64, f64, f64),
        edge: (f64, f64),
    ) -> StressResponse {
        half_space_stress::corner(x, y, z, edge, material.nu)
    }

    /// Whether the entry is odd in x and in y.
    fn is_odd(row: usize, column: usize) -> (bool, bool) {
        let (x, y) = match row {
            3 => (true, true),
            4 => (true, false),
            5 => (false, true),
            _ => (false, false),
        };
        (x != (column == 0), y != (column == 1))
    }

    /// The entry that it becomes when x and y change places.
    fn transposed(row: usize, column: usize) -> (usize, usize) {
        ([1, 0, 2, 3, 5, 4][row], [1, 0, 2][column])
    }

    /// Whether the component has exactly one index z: xz and yz.
    fn has_one_z(row: usize) -> bool {
        row >= 4
    }

    /// Reference for errors of the table, which compares r times the stress under unit forces: 1/zeta \[1/m\].
    /// At the depth zeta the stress is about 1/zeta^2 (up to 1/(2 pi)) at r ~ zeta, and decays like 1/r^2.
    fn error_scale(_: &Stack, zeta: f64) -> f64 {
        1.0 / zeta
    }
}

/// Stress coefficients at one depth: the stress at the offset (i dx, j dy) from the middle of a
/// cell under unit traction, tension positive, dimensionless.
#[derive(Clone, Debug, PartialEq)]
pub struct StressCoefficients {
    /// Depth \[m\].
    pub z: f64,
    /// Layer from the surface down; the number of coatings for the substrate.
    pub layer: usize,
    /// Rows xx, yy, zz, xy, xz, yz; columns q_x, q_y, p; each of shape (nx, ny).
    pub s: [[Quadrant; 3]; 6],
}

impl StressCoefficients {
    /// Whether an entry is odd in x and in y.
    pub fn is_odd(row: usize, column: usize) -> (bool, bool) {
        Stress::is_odd(row, column)
    }

    /// The stress on all offsets, shape (6, 3, 2 nx - 1, 2 ny - 1) with the offset (0, 0) in the
    /// middle.
    pub fn matrix(&self) -> Array4<f64> {
        let (nx, ny) = self.s[0][0].dim();
        Array4::from_shape_fn((6, 3, 2 * nx - 1, 2 * ny - 1), |(row, column, a, b)| {
            let odd = Self::is_odd(row, column);
            at_offset(&self.s[row][column], (a, b), odd)
        })
    }
}

/// The stress at `point` (x, y, z) \[m\] under unit traction on the cell of sides `cell` \[m\]
/// centred at the origin; `layer` decides at an interface (default: the upper one).
///
/// On the surface the stress jumps at the cell's border, and on the border it has no value.
pub fn stress_of_cell_at(
    body: &Body,
    cell: (f64, f64),
    point: (f64, f64, f64),
    layer: Option<usize>,
) -> Result<StressResponse, Error> {
    body.check_alone()?;
    Grid::from_spacing((1, 1), cell)?.check_alone()?;
    for (key, value) in [("point.x", point.0), ("point.y", point.1)] {
        if value.is_nan() || value.abs() > LARGEST {
            let allowed = format!("a place in m, at most {LARGEST:e}");
            return Err(Error::invalid(key, value, allowed));
        }
    }
    let stack = Stack::new(body);
    let place = stack.locate_depth(point.2, layer)?;
    let rectangle = Cell {
        x: point.0,
        y: point.1,
        half_x: cell.0 / 2.0,
        half_y: cell.1 / 2.0,
    };
    check_not_rigid(body, place.layer)?;
    let r_max = (point.0.abs() + cell.0).hypot(point.1.abs() + cell.1);
    Ok(StressKernel::new(&stack, place, r_max, cell)?.response_to_cell(&rectangle))
}

/// The stress coefficients of a body on a grid at the depth `z` \[m\]; `layer` decides at an
/// interface (default: the upper one).
///
/// Fails when `stop` is raised, if there is one: [`Error::Interrupted`] after increment 0.
pub fn stress_coefficients(
    body: &Body,
    grid: &Grid,
    z: f64,
    layer: Option<usize>,
    stop: Option<&AtomicBool>,
) -> Result<StressCoefficients, Error> {
    body.check_alone()?;
    grid.check_alone()?;
    fits("the stress coefficients", NUMBERS * grid.cells() as f64)?;
    let stack = Stack::new(body);
    let place = stack.locate_depth(z, layer)?;
    check_not_rigid(body, place.layer)?;
    let r_max = (grid.nx as f64 * grid.dx).hypot(grid.ny as f64 * grid.dy);
    let kernel = StressKernel::new(&stack, place, r_max, (grid.dx, grid.dy))?;
    let never = AtomicBool::new(false);
    let stop = stop.unwrap_or(&never);
    Ok(StressCoefficients {
        z,
        layer: place.layer,
        s: quadrants(&kernel, (grid.nx, grid.ny), (grid.dx, grid.dy), stop)?,
    })
}

/// Fails for a rigid material, where stress has no meaning.
pub fn check_not_rigid(body: &Body, layer: usize) -> Result<(), Error> {
    if layer == body.coatings.len() && body.substrate.is_rigid() {
        return Err(Error::invalid(
            "layer",
            "a rigid material",
            "an elastic one, where stress is defined",
        ));
    }
    Ok(())
}
