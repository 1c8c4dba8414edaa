//! The bed of debris over a jump of cycles.

use super::conjugate_gradients::NotConverged;
use super::matrix::Matrix;
use super::region::Region;
use super::solve::solve;

/// Part of the debris that the sum of the residuals may lose, for a bed that is kept.
pub const MASS_ACCURACY: f64 = 1e-10;

/// Debris at the end of a jump.
#[derive(Clone, Debug, PartialEq)]
pub struct Bed {
    /// Volume of debris per area in each cell, zero in open cells \[m\].
    pub height: Vec<f64>,
    /// Sum over the cells of what left through the border, and of what lies in cells that are open
    /// \[m\]; times the area of a cell it is a volume.
    pub ejected: f64,
}

/// Computes the bed after n cycles by one implicit Euler step,
/// `(I - n div K grad) h = h_0 + n source`, h = 0 on the border of the region. `supply` is the
/// right-hand side \[m\], `transport` the K of each cell \[m^2 per cycle\]. Bed and ejected debris together
/// differ from the supply by the part `accuracy` of it at most ([`MASS_ACCURACY`]).
/// A `guess` shortens the iterations.
pub fn spread_bed(
    region: &Region,
    transport: &[f64],
    n: f64,
    supply: &[f64],
    guess: Option<&[f64]>,
    accuracy: f64,
) -> Result<Bed, NotConverged> {
    let conductance: Vec<f64> = region.cells.iter().map(|&c| n * transport[c]).collect();
    let reaction = vec![1.0; conductance.len()];
    let matrix = Matrix::new(region, &reaction, |c, _, theta| conductance[c] / theta);
    let b = region.gather(supply);
    let total: f64 = b.iter().map(|b| b.abs()).sum();
    let mut h = region.gather(guess.unwrap_or(supply));
    solve(&matrix, &b, &mut h, accuracy * total)?;
    let leaves: f64 = h.iter().zip(&matrix.border).map(|(h, c)| h * c).sum();
    let open = supply.iter().sum::<f64>() - b.iter().sum::<f64>();
    Ok(Bed {
        height: region.scatter(&h, 0.0),
        ejected: leaves + open,
    })
}
