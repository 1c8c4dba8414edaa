//! The surface temperature that a heat flux causes.

use contact_core::Error;
use contact_core::convolution::{Displacements, SurfaceOperator, Tractions, scalar_operator};
use contact_core::kernels::Complex64;
use contact_core::scene::Grid;
use ndarray::Array2;

use super::coefficients::coefficients;
use super::conductor::Layers;

/// The response of a surface, or the sum of two, to a flux that goes on at one angular frequency.
///
/// Fields are amplitudes: the flux is Re q exp(i w t) into the body \[W/m^2\], the temperature Re T
/// exp(i w t) above that far away \[K\], one number per cell in row-major (nx, ny) order.
pub struct Conduction {
    coefficients: Array2<Complex64>,
    /// Real part of the coefficients, and the imaginary one where there is any.
    re: Box<dyn SurfaceOperator>,
    im: Option<Box<dyn SurfaceOperator>>,
}

impl Conduction {
    /// Conduction of a body on a grid at the angular frequency w >= 0 \[1/s\]; w = 0 is the steady state.
    ///
    /// Fails in plane strain, where the steady temperature has no bound, for w that is negative or
    /// no number, and if the coefficients of a coated body are not accurate.
    pub fn new(body: &Layers, grid: &Grid, w: f64) -> Result<Self, Error> {
        grid.check_alone()?;
        if grid.plane_strain {
            let allowed =
                "false: the heat of a contact without end along y has no steady temperature";
            return Err(Error::invalid("grid.plane_strain", true, allowed));
        }
        if !(w >= 0.0 && w.is_finite()) {
            let allowed = "0 or more, in 1/s";
            return Err(Error::invalid("angular frequency", w, allowed));
        }
        Ok(Self::from_coefficients(coefficients(body, grid, w)?))
    }

    /// Plans the convolution with complex coefficients.
    fn from_coefficients(coefficients: Array2<Complex64>) -> Self {
        let scalar = |part: fn(&Complex64) -> f64| {
            let zz = coefficients.map(part);
            scalar_operator(zz)
        };
        let swings = coefficients.iter().any(|c| c.im != 0.0);
        Self {
            re: scalar(|c| c.re),
            im: swings.then(|| scalar(|c| c.im)),
            coefficients,
        }
    }

    /// The response of two bodies that take the same flux.
    pub(super) fn sum(&self, other: &Self) -> Self {
        Self::from_coefficients(&self.coefficients + &other.coefficients)
    }

    /// The temperature of a cell under unit flux on itself alone \[m^2 K/W\].
    pub fn self_coefficient(&self) -> Complex64 {
        self.coefficients[(0, 0)]
    }

    /// The temperature of the cells \[K\] that a flux \[W/m^2\] causes.
    ///
    /// # Panics
    /// If the flux does not have nx ny entries.
    pub fn temperature(&mut self, flux: &[Complex64]) -> Vec<Complex64> {
        let (q_re, q_im): (Vec<f64>, Vec<f64>) = flux.iter().map(|q| (q.re, q.im)).unzip();
        let re = [
            convolved(&mut *self.re, &q_re),
            convolved(&mut *self.re, &q_im),
        ];
        let im = self
            .im
            .as_mut()
            .map(|im| [convolved(&mut **im, &q_re), convolved(&mut **im, &q_im)]);
        let at = |n: usize| {
            let [crossed_re, crossed_im] = im.as_ref().map_or([0.0; 2], |[a, b]| [a[n], b[n]]);
            Complex64::new(re[0][n] - crossed_im, re[1][n] + crossed_re)
        };
        (0..flux.len()).map(at).collect()
    }
}

/// One real convolution; zeros if the field is zero.
fn convolved(operator: &mut dyn SurfaceOperator, field: &[f64]) -> Vec<f64> {
    let mut result = vec![0.0; field.len()];
    if field.iter().any(|value| *value != 0.0) {
        let tractions = Tractions {
            p: Some(field),
            ..Tractions::default()
        };
        let displacements = Displacements {
            u_z: Some(&mut result),
            ..Displacements::default()
        };
        operator.apply(tractions, displacements);
    }
    result
}
