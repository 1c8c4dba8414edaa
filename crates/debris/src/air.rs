//! The oxygen that diffuses into the closed region and is consumed there.

use super::conjugate_gradients::NotConverged;
use super::fitted;
use super::matrix::Matrix;
use super::region::Region;
use super::solve::solve;

/// Error of the partial pressure, over its threshold.
pub const ACCURACY: f64 = 1e-3;

/// Computes the partial pressure of oxygen over the ambient one: `lambda^2 lap P = P` in the region,
/// P = 1 on its border and in open cells. `lambda_squared` = D/r of each cell \[m^2\] is infinite
/// where nothing is consumed. The error is at most [`ACCURACY`] times the `threshold`. A `guess`
/// shortens the iterations.
///
/// The scheme is fitted to waves along the axes of the grid: the oxygen distance d of a
/// strip of constant lambda is exact on any grid. Along a diagonal it is too small by (dx/lambda)^2 d/48.
pub fn diffuse_air(
    region: &Region,
    lambda_squared: &[f64],
    threshold: f64,
    guess: Option<&[f64]>,
) -> Result<Vec<f64>, NotConverged> {
    let sizes: Vec<[f64; 2]> = (region.cells.iter())
        .map(|&n| fitted::sizes(region, lambda_squared[n]))
        .collect();
    let reaction: Vec<f64> = (region.cells.iter().zip(&region.sides).zip(&sizes))
        .map(|((&n, sides), u)| fitted::reacting_part(sides, *u) / lambda_squared[n])
        .collect();
    let matrix = Matrix::new(region, &reaction, |c, axis, theta| {
        fitted::conductance(sizes[c][axis], theta)
    });
    let mut P = match guess {
        Some(guess) => region.gather(guess),
        None => vec![0.0; reaction.len()],
    };
    // By the maximum principle no error exceeds the largest residual times the solution for the
    // residual 1, which is at most lambda^2, or width^2/8 without any reaction.
    let slowest = reaction.iter().fold(f64::INFINITY, |m, r| m.min(*r));
    let response = (1.0 / slowest).min(region.width().powi(2) / 8.0);
    let tolerance = ACCURACY * threshold / response;
    solve(&matrix, &matrix.border, &mut P, tolerance)?;
    Ok(region.scatter(&P, 1.0))
}
