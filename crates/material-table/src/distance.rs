//! The critical distance of a material.

use std::f64::consts::PI;

use crate::error::Error;
use crate::known::Known;
use crate::material::Material;

/// Numbers of the critical distance.
const DISTANCE: [&str; 2] = ["dK_th", "s_D"];

impl Material {
    /// Critical distance L = (dK_th/(2 s_D))^2/pi \[m\], both fully reversed (D. Taylor, The Theory
    /// of Critical Distances, Elsevier 2007); fails with the number that is missing.
    pub fn critical_distance(&self) -> Result<f64, Error> {
        Ok((self.number("dK_th")? / (2.0 * self.number("s_D")?)).powi(2) / PI)
    }

    /// Longest over shortest critical distance, which goes with the square of a threshold over a
    /// strength: a default.
    pub fn scatter_of_distance(&self) -> f64 {
        match self.known(&DISTANCE) {
            Known::Known => 2.0,
            Known::Estimate | Known::Recalled => 3.0,
        }
    }
}
