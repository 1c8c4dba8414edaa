//! The error of the largest pressure on worn surfaces.
//!
//! In gross slip wear evens the pressure out, and what varies from cell to cell is not resolved: the largest
//! pressure p_max has the error
//!
//! ```text
//! dp/p_max = 1 - p_3/p_max,
//! ```
//!
//! p_3 being the largest mean of a cell and its neighbours that touch. The pressure changes from jump to jump,
//! too, which adds the error of the jump.
//!
//! In partial slip the stick zone keeps its height while its surroundings wear, and becomes a punch with sharp
//! edges: the pressure at its border grows without end like the inverse root of the distance (M. Ciavarella,
//! D. A. Hills, Eur. J. Mech. A/Solids 18 (1999) 491-497), on finer cells without bound. There is no largest
//! pressure then.

/// Relative error of the largest pressure by the cells, `ny` of them along y; infinite if worn surfaces stick
/// (`sticks`).
pub(crate) fn error_of_largest(p: &[f64], ny: usize, sticks: bool) -> f64 {
    let largest = p.iter().fold(0.0, |most: f64, p| most.max(*p));
    if sticks {
        return f64::INFINITY;
    }
    if largest <= 0.0 {
        return 0.0;
    }
    let nx = p.len() / ny;
    let near = |i: usize, n: usize| i.saturating_sub(1)..(i + 2).min(n);
    let mean = |i: usize, j: usize| {
        let cells = near(i, nx).flat_map(|i| near(j, ny).map(move |j| i * ny + j));
        let (sum, count) = cells
            .map(|cell| p[cell])
            .filter(|p| *p > 0.0)
            .fold((0.0, 0.0), |(sum, count), p| (sum + p, count + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    };
    let cells = (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j)));
    let resolved = cells.map(|(i, j)| mean(i, j)).fold(0.0, f64::max);
    1.0 - resolved / largest
}
