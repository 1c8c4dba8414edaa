//! The wave numbers of the sums, and their weights: sums free of periodic images.
//!
//! A sum over the wave numbers of a grid is periodic. The images come from the singularity of the
//! response at k = 0, which that grid does not resolve. The response is therefore split,
//!
//! ```text
//! F = F (1 - b) + F b,      b(k) = erfc(BUMP (k/K - 1/2))/2,      K = REACH dk
//! ```
//!
//! The first part is smooth on the scale of dk, so that its answer dies within half a period and is
//! summed by fast transforms of twice the cells. The second part, k < K, is an integral in polar
//! coordinates, in which F has no singularity: Gauss-Legendre nodes in k, equal angles. In plane strain it
//! is an integral over k alone.

use std::f64::consts::{PI, TAU};

use quadrature::gauss_legendre;

use crate::mesh::Cells;

/// Steepness of the bump b: it leaves out erfc(BUMP/2)/2 of F at k = 0, and images of
/// exp(-(pi REACH/(2 BUMP))^2) of what it cuts off.
const BUMP: f64 = 4.8;
/// End of b, over the step of the wave numbers of the fast transforms.
const REACH: f64 = 9.0;

/// A wave of the sums.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wave {
    /// Wave vector \[1/m\].
    pub(crate) k: [f64; 2],
    /// Weight of its answer.
    pub(crate) weight: f64,
}

/// Weight of the wave number k in the integral over slow waves; it falls from 1 to 0 around half of `reach`.
fn bump(k: f64, reach: f64) -> f64 {
    0.5 * libm::erfc(BUMP * (k / reach - 0.5))
}

/// Numbers of points of the fast transforms along y (x in plane strain) and along x. On a point grid both
/// are odd, at least twice the cells less one: every wave has its opposite, and both axes are alike. In plane
/// strain the number is even.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Periods {
    pub(crate) fast: usize,
    pub(crate) slow: usize,
}

impl Periods {
    /// The periods of the fast transforms in cells: long enough that images do not overlap, and of small prime
    /// factors.
    pub(crate) fn from_cells(cells: &Cells) -> Self {
        if cells.plane_strain {
            return Self {
                fast: smooth(2 * cells.nx, 2),
                slow: 1,
            };
        }
        Self {
            fast: smooth(2 * cells.ny - 1, 1),
            slow: smooth(2 * cells.nx - 1, 1),
        }
    }

    /// Number of complex values that the transform of a real row along y has: n/2 + 1.
    pub(crate) fn half(&self) -> usize {
        self.fast / 2 + 1
    }

    /// Waves of the fast transforms.
    pub(crate) fn len(&self) -> usize {
        self.half() * self.slow
    }
}

/// The least n from `least` on that is `times` a product of 3, 5, 7, 11 (and 2 if `times` is even).
fn smooth(least: usize, times: usize) -> usize {
    let fits = |n: usize| {
        if n % 2 != (times % 2) {
            return false;
        }
        let mut left = n;
        for factor in [2, 3, 5, 7, 11] {
            while left.is_multiple_of(factor) {
                left /= factor;
            }
        }
        left == 1
    };
    let mut n = least.max(1);
    while !fits(n) {
        n += 1;
    }
    n
}

/// Steps of the wave numbers of the fast transforms along (x, y) \[1/m\].
fn steps(cells: &Cells, periods: Periods) -> [f64; 2] {
    if cells.plane_strain {
        return [TAU / (periods.fast as f64 * cells.dx); 2];
    }
    [
        TAU / (periods.slow as f64 * cells.dx),
        TAU / (periods.fast as f64 * cells.dy),
    ]
}

/// The waves of the fast transforms, one row along x after the other.
pub(crate) fn of_transforms(cells: &Cells, periods: Periods) -> Vec<Wave> {
    let [x, y] = steps(cells, periods);
    let reach = REACH * x.max(y);
    let points = (periods.fast * periods.slow) as f64;
    let wave = |k: [f64; 2]| Wave {
        k,
        weight: (1.0 - bump(k[0].hypot(k[1]), reach)) / points,
    };
    if cells.plane_strain {
        return (0..periods.half())
            .map(|n| wave([n as f64 * x, 0.0]))
            .collect();
    }
    let signed = |n: usize| {
        if 2 * n > periods.slow {
            n as f64 - periods.slow as f64
        } else {
            n as f64
        }
    };
    (0..periods.half())
        .flat_map(|m| (0..periods.slow).map(move |n| (m, n)))
        .map(|(m, n)| wave([signed(n) * x, m as f64 * y]))
        .collect()
}

/// The waves of the integral over k < K, a half plane of them.
pub(crate) fn of_integral(cells: &Cells, periods: Periods) -> Vec<Wave> {
    let [x, y] = steps(cells, periods);
    let reach = REACH * x.max(y);
    let (length, width) = (cells.nx as f64 * cells.dx, cells.ny as f64 * cells.dy);
    if cells.plane_strain {
        let n = nodes(reach * length);
        return gauss_legendre(n, 0.0, 1.0)
            .into_iter()
            .map(|(at, weight)| {
                let k = at * reach;
                // Twice the real part of k > 0.
                let weight = weight * reach * bump(k, reach) * cells.dx / PI;
                Wave {
                    k: [k, 0.0],
                    weight,
                }
            })
            .collect();
    }
    let farthest = length.hypot(width);
    let n = nodes(reach * farthest);
    let mut waves = Vec::new();
    for (at, weight) in gauss_legendre(n, 0.0, 1.0) {
        let k = at * reach;
        // An even number, which makes both axes alike.
        let directions = 2.0 * (0.25 * (k * farthest + ANGLES)).ceil();
        let step = PI / directions;
        let weight = weight * reach * k * step * bump(k, reach) * cells.area() / (2.0 * PI * PI);
        waves.extend((0..directions as usize).map(|n| {
            let (sin, cos) = ((n as f64 + 0.5) * step).sin_cos();
            Wave {
                k: [k * cos, k * sin],
                weight,
            }
        }));
    }
    waves
}

/// Angles of the full circle beyond the phase k r that resolve the wave e^(i k r cos) and the
/// direction of the response.
const ANGLES: f64 = 14.0;

/// Gauss-Legendre nodes for a wave of this phase \[rad\] at the end of the interval, times the bump.
fn nodes(phase: f64) -> usize {
    (0.5 * phase).ceil() as usize + 8
}

/// Largest wave number \[1/m\] of the integral over all waves that gives the stress: REACH times the largest
/// step of the wave numbers.
pub(crate) fn reach(cells: &Cells, periods: Periods) -> f64 {
    let [x, y] = steps(cells, periods);
    REACH * x.max(y)
}
