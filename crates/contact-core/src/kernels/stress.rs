//! Stress below one loaded cell, in any layer of any body.
//!
//! In the outermost layer the stress is that of a half-space of its material, in closed form, plus
//! a remainder that decays like exp(-k (2h - z)); further down all of it decays like exp(-k z).
//! What decays is tabulated over the radius and integrated over the cell. With the amplitudes of
//! [`WaveFields`], M = (rr + tt)/2, E, F = (rr - tt)/4 -+ rt/2 under q, theta the azimuth and J_n
//! for the Hankel integral of order n:
//!
//! ```text
//!        under p               under q_x
//! zz     J_0                   J_1 cos(theta)
//! xx,yy  J_0[M] -+ J_2 cos 2theta   J_1[M +- E] cos(theta) -+ J_3[F] cos 3theta
//! xy     -J_2 sin 2theta       J_1[E] sin(theta) - J_3[F] sin 3theta
//! xz     J_1 cos(theta)        -J_0 + J_2 cos 2theta
//! yz     J_1 sin(theta)        J_2 sin 2theta
//! ```

use ndarray::{Array2, Array4};
use rayon::prelude::*;

use super::Quadrant;
use super::cell::Cell;
use super::coefficients::at_offset;
use super::depth_frf::{Place, WaveFields};
use super::half_space_stress::{StressResponse, corner, difference, under_cell};
use super::layered_frf::Stack;
use super::radial_table::{Hankel, RadialTable};
use crate::error::Error;
use crate::scene::{Body, Grid};

/// Relative error that a cell's Gauss rule may leave, against the stress under the load.
const CUBATURE: f64 = 1e-13;
/// Largest error of the tabulated part over the traction.
const TOLERANCE: f64 = 1e-9;

/// Stress coefficients at one depth: the stress at the offset (i dx, j dy) from the middle of a
/// cell under unit traction, tension positive, dimensionless.
#[derive(Clone, Debug, PartialEq)]
pub struct StressCoefficients {
    /// Depth \[m\].
    pub z: f64,
    /// Layer from the surface down; their number for the substrate.
    pub layer: usize,
    /// Rows xx, yy, zz, xy, xz, yz; columns q_x, q_y, p; each of shape (nx, ny).
    pub s: [[Quadrant; 3]; 6],
}

impl StressCoefficients {
    /// Whether an entry changes its sign with x and with y.
    pub fn is_odd(row: usize, column: usize) -> (bool, bool) {
        let (x, y) = match row {
            3 => (true, true),
            4 => (true, false),
            5 => (false, true),
            _ => (false, false),
        };
        (x != (column == 0), y != (column == 1))
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

/// The stress at a depth as a function of the offset.
struct StressKernel {
    place: Place,
    /// Poisson's ratio of the outermost material where its closed form takes part.
    closed: Option<f64>,
    smooth: Option<(RadialTable<10>, f64)>,
}

impl StressKernel {
    fn new(stack: &Stack, place: Place, r_max: f64) -> Result<Self, Error> {
        let outermost = place.layer == 0;
        let closed = outermost.then(|| stack.outermost().nu);
        let zeta = match stack.layers.first() {
            None => {
                return Ok(Self {
                    place,
                    closed,
                    smooth: None,
                });
            }
            Some((_, h)) if outermost => 2.0 * h - place.z,
            Some(_) => place.z,
        };
        let hankel = Hankel {
            amplitude: &|k| amplitudes(k, &stack.fields(k, &place, outermost)),
            orders: [0, 0, 2, 1, 1, 1, 1, 3, 0, 2],
            zeta,
            k_low: stack.lowest_scale(),
        };
        let table = hankel.tabulate(r_max);
        // Stress falls off like 1/r^2: against 1/(2 pi zeta^2), the most that a unit force causes.
        let estimate = hankel.error(&table, r_max) * zeta;
        if estimate.is_nan() || estimate > TOLERANCE {
            return Err(Error::StressInaccurate {
                z: place.z,
                estimate,
                tolerance: TOLERANCE,
            });
        }
        Ok(Self {
            place,
            closed,
            smooth: Some((table, zeta)),
        })
    }

    /// Adds the tabulated part at (0, 0) under unit traction on the cell.
    fn add_smooth(&self, s: &mut StressResponse, cell: &Cell) {
        let Some((table, zeta)) = &self.smooth else {
            return;
        };
        cell.nodes_of_parts(*zeta, CUBATURE, &mut |x, y, w| {
            add_kernel(s, x, y, table.at(x * x + y * y).map(|g| w * g));
        });
    }

    /// The stress at the offset of the cell's middle.
    fn under(&self, cell: &Cell) -> StressResponse {
        let mut s = self
            .closed
            .map_or([[0.0; 3]; 6], |nu| under_cell(cell, self.place.z, nu));
        self.add_smooth(&mut s, cell);
        s
    }
}

/// The ten amplitudes, the k of k dk included.
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

/// Adds the stress at (x, y) from a point load; `g` are the radial functions over r^m.
fn add_kernel(s: &mut StressResponse, x: f64, y: f64, g: [f64; 10]) {
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

/// The stress at `point` (x, y, z) \[m\] under unit traction on the cell of sides `cell` \[m\]
/// centred at the origin; `layer` decides at an interface (default: the upper one).
///
/// On the surface the stress jumps at the cell's border, and on the border it has no value.
pub fn stress_at(
    body: &Body,
    cell: (f64, f64),
    point: (f64, f64, f64),
    layer: Option<usize>,
) -> Result<StressResponse, Error> {
    body.check("body")?;
    let stack = Stack::new(body);
    let place = stack.place(point.2, layer)?;
    Grid::from_spacing((1, 1), cell)?;
    let rectangle = Cell {
        x: point.0,
        y: point.1,
        half_x: cell.0 / 2.0,
        half_y: cell.1 / 2.0,
    };
    if rigid_at(body, place.layer) {
        return Err(rigid());
    }
    let reach = (point.0.abs() + cell.0).hypot(point.1.abs() + cell.1);
    Ok(StressKernel::new(&stack, place, reach)?.under(&rectangle))
}

/// The stress coefficients of a body on a grid at the depth `z` \[m\]; `layer` decides at an
/// interface (default: the upper one).
pub fn stress_coefficients(
    body: &Body,
    grid: &Grid,
    z: f64,
    layer: Option<usize>,
) -> Result<StressCoefficients, Error> {
    body.check("body")?;
    let stack = Stack::new(body);
    let place = stack.place(z, layer)?;
    if rigid_at(body, place.layer) {
        return Err(rigid());
    }
    let Grid { nx, ny, dx, dy } = *grid;
    let r_max = (nx as f64 * dx).hypot(ny as f64 * dy);
    let kernel = StressKernel::new(&stack, place, r_max)?;
    let corners = |i: usize| -> Vec<StressResponse> {
        let Some(nu) = kernel.closed else {
            return vec![[[0.0; 3]; 6]; ny + 1];
        };
        let x = (i as f64 - 0.5) * dx;
        (0..=ny)
            .map(|j| corner(x, (j as f64 - 0.5) * dy, z, nu))
            .collect()
    };
    // Where cells are square, exchange of the axes gives one octant from the other.
    let square = if dx.to_bits() == dy.to_bits() {
        nx.min(ny)
    } else {
        0
    };
    let mirrored = |i: usize, j: usize| i < j && j < square;
    let rows: Vec<Vec<StressResponse>> = (0..nx)
        .into_par_iter()
        .map(|i| {
            let (low, high) = (corners(i), corners(i + 1));
            let stress = |j: usize| {
                if mirrored(i, j) {
                    return StressResponse::default();
                }
                let mut s = difference(&high[j + 1], &low[j + 1], &high[j], &low[j]);
                let cell = Cell {
                    x: i as f64 * dx,
                    y: j as f64 * dy,
                    half_x: dx / 2.0,
                    half_y: dy / 2.0,
                };
                kernel.add_smooth(&mut s, &cell);
                s
            };
            (0..ny).map(stress).collect()
        })
        .collect();
    let exchanged_row = [1, 0, 2, 3, 5, 4];
    let exchanged_column = [1, 0, 2];
    let entry = |row: usize, column: usize| {
        let odd = StressCoefficients::is_odd(row, column);
        Array2::from_shape_fn((nx, ny), |(i, j)| {
            let vanishes = odd.0 && i == 0 || odd.1 && j == 0;
            if vanishes {
                0.0
            } else if mirrored(i, j) {
                rows[j][i][exchanged_row[row]][exchanged_column[column]]
            } else {
                rows[i][j][row][column]
            }
        })
    };
    Ok(StressCoefficients {
        z,
        layer: place.layer,
        s: std::array::from_fn(|row| std::array::from_fn(|column| entry(row, column))),
    })
}

fn rigid_at(body: &Body, layer: usize) -> bool {
    layer == body.coatings.len() && body.substrate.is_rigid()
}

fn rigid() -> Error {
    Error::invalid(
        "layer",
        "a rigid material",
        "an elastic one, where stress is defined",
    )
}
