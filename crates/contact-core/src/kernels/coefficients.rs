//! Influence coefficients: the surface displacement that unit traction on one cell causes.

use crate::plan::KernelSet;
use ndarray::{Array2, Array4};

/// One coefficient on the non-negative offsets, shape (nx, ny): entry (i, j) belongs to the offset
/// (i dx, j dy) of the observed cell from the loaded one. The other quadrants follow by parity.
pub type Quadrant = Array2<f64>;

/// The independent surface coefficients of a body, or of a pair of bodies \[m/Pa\]; coefficients
/// outside the requested set are empty.
///
/// `C_ij(x)` is the displacement u_i at offset x under unit traction q_j on the cell at the
/// origin (q_1 = q_x, q_2 = q_y, q_3 = p). Isotropic layers leave six of the nine independent:
///
/// | | parity in x | parity in y |
/// |---|---|---|
/// | `xx`, `yy`, `zz` | even | even |
/// | `xy` = C_xy = C_yx | odd | odd |
/// | `xz` = C_xz = -C_zx | odd | even |
/// | `yz` = C_yz = -C_zy | even | odd |
///
/// For a homogeneous half-space of nu < 1/2 pressure draws the surface inwards: `xz < 0` at x > 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct InfluenceCoefficients {
    /// u_x under q_x.
    pub xx: Quadrant,
    /// u_y under q_y.
    pub yy: Quadrant,
    /// u_z under p.
    pub zz: Quadrant,
    /// u_x under q_y.
    pub xy: Quadrant,
    /// u_x under p.
    pub xz: Quadrant,
    /// u_y under p.
    pub yz: Quadrant,
}

/// The norm of a kernel over all offsets \[m/Pa\], root of the sum of squares, from the offsets >= 0.
pub(crate) fn norm(quarter: &Quadrant) -> f64 {
    2.0 * quarter.iter().map(|k| k * k).sum::<f64>().sqrt()
}

impl InfluenceCoefficients {
    /// The coefficients of the pair, eq. (4) of the paper, `self` being body 2: coefficients within
    /// one direction family add, those that couple normal and tangential subtract.
    #[must_use]
    pub fn pair(mut self, body1: &Self) -> Self {
        for (c2, c1) in [
            (&mut self.xx, &body1.xx),
            (&mut self.yy, &body1.yy),
            (&mut self.zz, &body1.zz),
            (&mut self.xy, &body1.xy),
        ] {
            *c2 += c1;
        }
        self.xz -= &body1.xz;
        self.yz -= &body1.yz;
        self
    }

    /// [`Self::pair`] of two bodies that both have these coefficients.
    pub(crate) fn pair_of_equal_bodies(mut self) -> Self {
        for c in [&mut self.xx, &mut self.yy, &mut self.zz, &mut self.xy] {
            *c *= 2.0;
        }
        self.xz.fill(0.0);
        self.yz.fill(0.0);
        self
    }

    /// Empties the coefficients that are not in a set.
    pub(crate) fn keep_only(mut self, set: KernelSet) -> Self {
        if set != KernelSet::All {
            (self.xz, self.yz) = (empty_quadrant(), empty_quadrant());
        }
        if set == KernelSet::Normal {
            (self.xx, self.yy, self.xy) = (empty_quadrant(), empty_quadrant(), empty_quadrant());
        }
        self
    }

    /// C_xx(0,0), zero if it is not in the set, and C_zz(0,0).
    pub(crate) fn self_coefficients(&self) -> (f64, f64) {
        let value = |c: &Quadrant| c.get((0, 0)).copied().unwrap_or_default();
        (value(&self.xx), value(&self.zz))
    }

    /// The coefficients between `ratio` u_y and q_y / `ratio`.
    pub(crate) fn scale_y(mut self, ratio: f64) -> Self {
        self.yy *= ratio * ratio;
        self.xy *= ratio;
        self.yz *= ratio;
        self
    }

    /// Truncates to the offsets within nx x ny cells.
    pub(crate) fn truncate(&self, (nx, ny): (usize, usize)) -> Self {
        let truncated = |q: &Quadrant| {
            let shape = if q.is_empty() { (0, 0) } else { (nx, ny) };
            Quadrant::from_shape_fn(shape, |at| q[at])
        };
        Self {
            xx: truncated(&self.xx),
            yy: truncated(&self.yy),
            zz: truncated(&self.zz),
            xy: truncated(&self.xy),
            xz: truncated(&self.xz),
            yz: truncated(&self.yz),
        }
    }

    /// C_ij on all offsets, of all six coefficients, shape (3, 3, 2 nx - 1, 2 ny - 1) with the
    /// offset (0, 0) in the middle.
    pub fn matrix(&self) -> Array4<f64> {
        let (nx, ny) = self.zz.dim();
        let mut matrix = Array4::zeros((3, 3, 2 * nx - 1, 2 * ny - 1));
        let parts = [
            [(&self.xx, 1.0), (&self.xy, 1.0), (&self.xz, 1.0)],
            [(&self.xy, 1.0), (&self.yy, 1.0), (&self.yz, 1.0)],
            [(&self.xz, -1.0), (&self.yz, -1.0), (&self.zz, 1.0)],
        ];
        for ((i, j, a, b), entry) in matrix.indexed_iter_mut() {
            let (part, sign) = parts[i][j];
            let odd = ((i == 0) != (j == 0), (i == 1) != (j == 1));
            *entry = sign * at_offset(part, (a, b), odd);
        }
        matrix
    }
}

/// Whether xx, yy, zz, xy, xz, yz are odd along x and y.
pub(super) const ODD: [(bool, bool); 6] = [
    (false, false),
    (false, false),
    (false, false),
    (true, true),
    (true, false),
    (false, true),
];

/// A coefficient outside the requested set.
pub(super) fn empty_quadrant() -> Quadrant {
    Quadrant::zeros((0, 0))
}

/// The coefficient at the index (a, b) of the full table, which is the offset (a - nx + 1, b - ny + 1) in
/// cells, from the offsets >= 0 and the parity (`odd`) along x and y.
pub(super) fn at_offset(part: &Quadrant, (a, b): (usize, usize), odd: (bool, bool)) -> f64 {
    let (nx, ny) = part.dim();
    let mirrored = (a + 1 < nx && odd.0) != (b + 1 < ny && odd.1);
    let value = part[(a.abs_diff(nx - 1), b.abs_diff(ny - 1))];
    if mirrored { -value } else { value }
}
