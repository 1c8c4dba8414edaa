//! Influence coefficients: the surface displacement that unit traction on one cell causes.

use ndarray::{Array2, Array4};

/// One coefficient on the non-negative offsets, shape (nx, ny): entry (i, j) belongs to the offset
/// (i dx, j dy) of the observed cell from the loaded one. The other quadrants follow by parity.
pub type Quadrant = Array2<f64>;

/// The independent surface coefficients of a body, or of a pair of bodies \[m/Pa\].
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
#[derive(Clone, Debug, PartialEq)]
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

impl InfluenceCoefficients {
    /// The same operation on all six.
    fn map2(&self, other: &Self, f: impl Fn(&Quadrant, &Quadrant, f64) -> Quadrant) -> Self {
        Self {
            xx: f(&self.xx, &other.xx, 1.0),
            yy: f(&self.yy, &other.yy, 1.0),
            zz: f(&self.zz, &other.zz, 1.0),
            xy: f(&self.xy, &other.xy, 1.0),
            xz: f(&self.xz, &other.xz, -1.0),
            yz: f(&self.yz, &other.yz, -1.0),
        }
    }

    /// The coefficients of the pair, eq. (4) of the paper, `self` being body 2: those that keep to
    /// one direction family add, those that couple normal and tangential subtract.
    #[must_use]
    pub fn pair(&self, body1: &Self) -> Self {
        self.map2(body1, |c2, c1, sign| c2 + &(c1 * sign))
    }

    /// The coefficients between u_y times and q_y over `stretch`.
    pub(crate) fn stretched(mut self, stretch: f64) -> Self {
        self.yy *= stretch * stretch;
        self.xy *= stretch;
        self.yz *= stretch;
        self
    }

    /// C_ij on all offsets, shape (3, 3, 2 nx - 1, 2 ny - 1) with the offset (0, 0) in the middle.
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

/// The coefficient at (a - nx + 1, b - ny + 1) cells, by its parity along x and y.
pub(super) fn at_offset(part: &Quadrant, (a, b): (usize, usize), odd: (bool, bool)) -> f64 {
    let (nx, ny) = part.dim();
    let mirrored = (a + 1 < nx && odd.0) != (b + 1 < ny && odd.1);
    let value = part[(a.abs_diff(nx - 1), b.abs_diff(ny - 1))];
    if mirrored { -value } else { value }
}
