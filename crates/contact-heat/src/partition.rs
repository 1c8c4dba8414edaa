//! The part of the heat that each body takes: the surfaces agree in temperature wherever they touch.
//!
//! With q = q_1 + q_2 and T_1 + C_1 q_1 = T_2 + C_2 q_2 on the cells in contact, T_1 and T_2 being
//! the temperatures far away,
//!
//! ```text
//! (C_1 + C_2) q_1 = C_2 q + T_2 - T_1
//! ```
//!
//! The matrix is complex and symmetric, so that conjugate gradients with products that do not
//! conjugate solve it (H. A. van der Vorst, J. B. M. Melissen, IEEE Trans. Magnetics 26 (1990)
//! 706-708).

use contact_core::Error;
use contact_core::kernels::Complex64;

use super::conduction::Conduction;

/// Tolerance: root mean square of the temperature difference of the surfaces, over the smaller of
/// the temperatures that either body would have under all of the heat, plus the difference far
/// away.
const TOLERANCE: f64 = 1e-9;
/// Rounding error of the residual, over the right-hand side.
const ROUNDING: f64 = 1e-14;
/// Most iterations: for a matrix like 1/k they grow with the root of the cells across the contact.
const MOST_ITERATIONS: usize = 2000;

/// The heat shared out, at one frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Partition {
    /// Flux into body 1, and into body 2 \[W/m^2\].
    pub flux: [Vec<Complex64>; 2],
    /// Temperature of body 1, and of body 2, each above its own far away \[K\].
    pub rise: [Vec<Complex64>; 2],
}

/// Shares the heat q of the cells in `contact` out between two bodies; `warmer` is T_2 - T_1 far
/// away \[K\], zero but in the steady state.
///
/// # Panics
/// If the fields are not of the grid of the bodies.
pub fn partition(
    [one, two]: [&mut Conduction; 2],
    heat: &[Complex64],
    contact: &[bool],
    warmer: f64,
) -> Result<Partition, Error> {
    let heat = kept(heat, contact);
    let mut goal_temperature = two.temperature(&heat);
    let warmed = size(&kept(&goal_temperature, contact));
    for t in &mut goal_temperature {
        *t += warmer;
    }
    let goal_temperature = kept(&goal_temperature, contact);
    let alone = kept(&one.temperature(&heat), contact);
    let cells = contact.iter().filter(|touches| **touches).count() as f64;
    let scale = size(&alone).min(warmed) + warmer.abs() * cells.sqrt();
    // Exact for two half-spaces in the steady state, and for two bodies that are the same.
    let share = two.self_coefficient() / (one.self_coefficient() + two.self_coefficient());
    let guess: Vec<_> = heat.iter().map(|q| share * q).collect();
    let q_1 = solve(
        &mut one.sum(two),
        (&goal_temperature, scale),
        guess,
        contact,
    )?;
    let q_2: Vec<_> = heat.iter().zip(&q_1).map(|(q, q_1)| q - q_1).collect();
    let rise = [one.temperature(&q_1), two.temperature(&q_2)];
    Ok(Partition {
        flux: [q_1, q_2],
        rise,
    })
}

/// The field on the cells in contact, zero elsewhere.
fn kept(field: &[Complex64], contact: &[bool]) -> Vec<Complex64> {
    let cells = field.iter().zip(contact);
    cells
        .map(|(value, touches)| if *touches { *value } else { Complex64::ZERO })
        .collect()
}

/// Conjugate gradients for a symmetric complex matrix on the cells in contact, until the residual
/// is the tolerance of `scale`.
fn solve(
    matrix: &mut Conduction,
    (goal_temperature, scale): (&[Complex64], f64),
    mut x: Vec<Complex64>,
    contact: &[bool],
) -> Result<Vec<Complex64>, Error> {
    let product = kept(&matrix.temperature(&x), contact);
    let mut r: Vec<_> = goal_temperature
        .iter()
        .zip(product)
        .map(|(b, a)| b - a)
        .collect();
    let mut direction = r.clone();
    let mut rr = dot(&r, &r);
    let mut iterations = 0;
    let goal = (TOLERANCE * scale).max(ROUNDING * size(goal_temperature));
    while size(&r) > goal {
        if iterations == MOST_ITERATIONS || !rr.is_finite() {
            return Err(Error::HeatNotShared {
                residual: size(&r) / scale,
                tolerance: TOLERANCE,
                iterations,
            });
        }
        let product = kept(&matrix.temperature(&direction), contact);
        let step = rr / dot(&direction, &product);
        add_scaled(&mut x, step, &direction);
        add_scaled(&mut r, -step, &product);
        let next = dot(&r, &r);
        let turn = next / rr;
        for (d, r) in direction.iter_mut().zip(&r) {
            *d = r + turn * *d;
        }
        rr = next;
        iterations += 1;
    }
    Ok(x)
}

/// The sum of products, nothing conjugated.
fn dot(a: &[Complex64], b: &[Complex64]) -> Complex64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The root of the sum of squares.
fn size(a: &[Complex64]) -> f64 {
    a.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt()
}

/// to += factor what
fn add_scaled(to: &mut [Complex64], factor: Complex64, what: &[Complex64]) {
    for (to, what) in to.iter_mut().zip(what) {
        *to += factor * what;
    }
}
