//! An approximate inverse of the surface operator, one transform on the unpadded grid.
//!
//! The coefficients, cut at half the grid and continued periodically (G. Strang, Stud. Appl. Math.
//! 74 (1986) 171-176), are a circulant matrix, which a transform inverts. It knows the layers,
//! 74 (1986) 171-176), are a circulant matrix, which a transform inverts. It includes the layers,
//! since it is made of their coefficients. Masked to the contact it is used for C restricted to

use std::sync::atomic::AtomicBool;

use super::good_size::fast_length;
use super::{ApproximateInverse, Displacements, Spectra, SpectralProduct, Tractions};
use crate::error::Error;
use crate::kernels::{InfluenceCoefficients, Quadrant};
use crate::plan::Mirror;
use crate::stop::{NOBODY, unless};

/// Circulant inverse of the normal and of the tangential part of an operator.
pub struct CirculantInverse {
    product: Product,
}

/// A guess needs few digits; but a last digit of the solution needs all of a guess's symmetry.
enum Product {
    Single(SpectralProduct<f32>),
    Double(SpectralProduct<f64>),
}

impl CirculantInverse {
    /// Builds the inverse for the coefficients of a pair of bodies, on the whole grid or its mirrored half, in single
    /// precision if `single`.
    pub fn new(c: &InfluenceCoefficients, mirror: Mirror, single: bool) -> Self {
        Self::new_unless_stopped(c, mirror, single, &AtomicBool::new(false)).expect(NOBODY)
    }

    /// Inverts the kernels in the frequency domain, cut off at half of their range and without the coupling of
    /// normal and tangential directions. Stored in single precision if `single`; fails when `stop` is raised.
    pub(crate) fn new_unless_stopped(
        c: &InfluenceCoefficients,
        mirror: Mirror,
        single: bool,
        stop: &AtomicBool,
    ) -> Result<Self, Error> {
        let shape = c.zz.dim();
        let period = (fast_length(shape.0), fast_length(shape.1));
        let cut = |q: &Quadrant, odd: bool| cut_at_half(q, period, odd);
        let half = InfluenceCoefficients {
            xx: cut(&c.xx, false),
            yy: cut(&c.yy, false),
            zz: cut(&c.zz, false),
            xy: cut(&c.xy, true),
            xz: Quadrant::zeros((0, 0)),
            yz: Quadrant::zeros((0, 0)),
        };
        let forward = Spectra::from_coefficients(&half, period, false, stop)?;
        let inverse = invert(&forward, (period.0 * period.1) as f64);
        unless(stop)?;
        let product = if single {
            Product::Single(SpectralProduct::new(shape, mirror, &inverse, period, stop)?)
        } else {
            Product::Double(SpectralProduct::new(shape, mirror, &inverse, period, stop)?)
        };
        Ok(Self { product })
    }

    /// Applies the inverse spectra in the precision that they are kept in.
    fn apply(&mut self, tractions: Tractions<'_>, displacements: Displacements<'_>) {
        match &mut self.product {
            Product::Single(product) => product.apply(tractions, displacements),
            Product::Double(product) => product.apply(tractions, displacements),
        }
    }
}

impl ApproximateInverse for CirculantInverse {
    /// z ~ C_zz^-1 r, of the pressure from the normal displacement.
    fn normal(&mut self, r: &[f64], z: &mut [f64]) {
        let tractions = Tractions {
            p: Some(r),
            ..Tractions::default()
        };
        let displacements = Displacements {
            u_z: Some(z),
            ..Displacements::default()
        };
        self.apply(tractions, displacements);
    }

    /// z ~ C_tt^-1 r, of the shear from the tangential displacements.
    fn tangential(&mut self, r: [&[f64]; 2], z: [&mut [f64]; 2]) {
        let [z_x, z_y] = z;
        let tractions = Tractions {
            q_x: Some(r[0]),
            q_y: Some(r[1]),
            p: None,
        };
        let displacements = Displacements {
            u_x: Some(z_x),
            u_y: Some(z_y),
            u_z: None,
        };
        self.apply(tractions, displacements);
    }
}

/// Keeps the coefficients at offsets up to half the `period`. At exactly half, where both ends of the period
/// meet, an odd kernel is zero.
fn cut_at_half(q: &Quadrant, period: (usize, usize), odd: bool) -> Quadrant {
    let (nx, ny) = q.dim();
    if q.is_empty() {
        return q.clone();
    }
    let shape = (nx.min(period.0 / 2 + 1), ny.min(period.1 / 2 + 1));
    Quadrant::from_shape_fn(shape, |(i, j)| {
        let is_at_half_period = 2 * i == period.0 || 2 * j == period.1;
        if odd && is_at_half_period {
            0.0
        } else {
            q[(i, j)]
        }
    })
}

/// Inverts frequency by frequency: 1/zz, and the 2 x 2 block of xx, xy, yy.
///
/// `cells` undoes the factor of the inverse transform inside the spectra and puts it back.
fn invert(s: &Spectra, cells: f64) -> Spectra {
    let positive_spectrum = |s: &[f64]| {
        // A cut kernel can dip below zero where it should be small; the inverse must not.
        let floor = s.iter().fold(0.0, |m: f64, v| m.max(v.abs())) * 1e-6;
        s.iter().map(|v| v.max(floor) * cells).collect::<Vec<_>>()
    };
    let (xx, yy, zz) = (
        positive_spectrum(&s.xx),
        positive_spectrum(&s.yy),
        positive_spectrum(&s.zz),
    );
    let xy: Vec<f64> = (s.xy.iter().zip(&xx).zip(&yy))
        .map(|((xy, xx), yy)| {
            let limit = 0.999 * (xx * yy).sqrt();
            (xy * cells).clamp(-limit, limit)
        })
        .collect();
    let mut inverse = Spectra {
        zz: zz.iter().map(|zz| 1.0 / (zz * cells)).collect(),
        xy,
        ..Spectra::default()
    };
    for (k, xy) in inverse.xy.iter_mut().enumerate() {
        let det = (xx[k] * yy[k] - *xy * *xy) * cells;
        inverse.xx.push(yy[k] / det);
        inverse.yy.push(xx[k] / det);
        *xy = -*xy / det;
    }
    inverse
}
