//! Integrals over one rectangular cell.

use quadrature::gauss;

/// Most Gauss nodes along one side; a cell that needs more is halved.
const MOST_NODES: usize = 10;

/// A rectangle of the contact plane, relative to the point where the effect is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Cell {
    /// Middle \[m\].
    pub x: f64,
    /// See `x`.
    pub y: f64,
    /// Half lengths of the sides \[m\].
    pub half_x: f64,
    /// See `half_x`.
    pub half_y: f64,
}

impl Cell {
    /// Gauss nodes along x and y that integrate functions of x, y analytic for x^2 + y^2 != -zeta^2
    /// to about the relative error `tolerance`, or `None` if they are too many.
    ///
    /// Along a side the integrand is analytic within the ellipse through the nearest of the points
    /// +- i sqrt(zeta^2 + y^2); with rho the sum of its half axes the error is rho^(-2 n).
    pub(crate) fn orders(&self, zeta: f64, tolerance: f64) -> Option<(usize, usize)> {
        let order = |x: f64, half_x: f64, y: f64, half_y: f64| {
            let nearest = (y.abs() - half_y).max(0.0);
            let square = (zeta * zeta + nearest * nearest) / (half_x * half_x);
            let (left, right) = (x / half_x - 1.0, x / half_x + 1.0);
            let to_end = |end: f64| (end * end + square).sqrt();
            let axis = f64::midpoint(to_end(left), to_end(right));
            let rho = axis + (axis * axis - 1.0).max(0.0).sqrt();
            let mut error = 1.0 / (rho * rho);
            let mut n = 1;
            while error > tolerance && n <= MOST_NODES {
                error /= rho * rho;
                n += 1;
            }
            n
        };
        let nx = order(self.x, self.half_x, self.y, self.half_y);
        let ny = order(self.y, self.half_y, self.x, self.half_x);
        (nx <= MOST_NODES && ny <= MOST_NODES).then_some((nx, ny))
    }

    /// Calls `f` with x, y \[m\] and weight \[m^2\] of each node of a product Gauss rule over the cell;
    /// `orders` are the numbers of nodes along x and y.
    pub(crate) fn nodes(&self, orders: (usize, usize), mut f: impl FnMut(f64, f64, f64)) {
        for (tx, wx) in gauss(orders.0) {
            for (ty, wy) in gauss(orders.1) {
                let weight = wx * wy * self.half_x * self.half_y;
                f(self.x + tx * self.half_x, self.y + ty * self.half_y, weight);
            }
        }
    }

    /// Calls `f` with the Gauss nodes (x, y, weight \[m^2\]) of the cell, which is halved until its parts are
    /// small against the scale `zeta` \[m\] of the integrand.
    pub fn nodes_of_parts(&self, zeta: f64, tolerance: f64, f: &mut impl FnMut(f64, f64, f64)) {
        if let Some(orders) = self.orders(zeta, tolerance) {
            self.nodes(orders, f);
            return;
        }
        for side in [-0.5, 0.5] {
            let mut part = *self;
            if self.half_x > self.half_y {
                part.half_x /= 2.0;
                part.x += side * self.half_x;
            } else {
                part.half_y /= 2.0;
                part.y += side * self.half_y;
            }
            part.nodes_of_parts(zeta, tolerance, f);
        }
    }
}
