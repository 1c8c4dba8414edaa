//! The maximum of a smooth function of the plane, by Newton's method.

use stress_tensor::StressTensor;

use crate::circle::{radius_of_three, radius_through};
use crate::path::{Frame, dot, normal_weights, normalize, shear_weights};

/// Angle of the difference stencil \[rad\]: the truncation error of the slopes is its sixth power,
/// their rounding error 1e-16 over it.
const TURN: f64 = 5e-3;
/// A step below this length ends the search with second-order slopes, whose maximum is off by less
/// than `TURN`^2 \[rad\].
const NEARLY: f64 = 1e-3;
/// A step below this length ends the search with sixth-order slopes: the next step would be this
/// times the error of the second derivatives, `TURN`^2 \[rad\].
const CLOSE: f64 = 1e-7;
/// Longest step \[rad\].
const LONGEST: f64 = 0.2;

/// A smooth function of the plane: the criterion with the deciding instants fixed. The criterion is
/// the largest of all such functions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Three instants on the smallest circle, those with the largest and the smallest strain, and
    /// the instant of the second part.
    pub(crate) instants: [usize; 6],
    /// Stresses on the smallest circle, or a tensor whose normal component is the first part.
    pub(crate) first: First,
    /// The tensor whose normal component is the second part.
    pub(crate) second: StressTensor,
}

/// The first part of a piece.
#[derive(Clone, Copy, Debug)]
pub(crate) enum First {
    /// The radius of the smallest circle round the shear of three stresses.
    Shear([StressTensor; 3]),
    /// The normal component of a tensor.
    Normal(StressTensor),
}

impl Piece {
    /// The two parts on the plane of a unit normal.
    pub(crate) fn parts(&self, n: [f64; 3]) -> [f64; 2] {
        self.parts_with_circle(n, radius_of_three)
    }

    /// The two parts with the circle through all three points. It is smooth everywhere, but is the
    /// smallest circle only where their angles are acute.
    pub(crate) fn smooth_parts(&self, n: [f64; 3]) -> [f64; 2] {
        self.parts_with_circle(n, radius_through)
    }

    /// The two parts on the plane of a unit normal by a formula without a frame. It keeps half of the digits
    /// where the shear is small against the normal stress.
    pub(crate) fn quick_parts(&self, n: [f64; 3]) -> [f64; 2] {
        let normal = |s: &StressTensor| dot(traction(s, n), n);
        let first = match &self.first {
            First::Normal(tensor) => normal(tensor),
            First::Shear([a, b, c]) => {
                let change = |s: &StressTensor| traction(&difference(s, a), n);
                let (p, q) = (change(b), change(c));
                let (along_p, along_q) = (dot(p, n), dot(q, n));
                let (pp, qq) = (dot(p, p) - along_p * along_p, dot(q, q) - along_q * along_q);
                let pq = dot(p, q) - along_p * along_q;
                square_radius(pp, qq, pq).max(0.0).sqrt()
            }
        };
        [first, normal(&self.second)]
    }

    /// The normal of the complementary plane: the direction of the largest change of the shear
    /// between deciding instants on the plane n. If two instants decide on n, the shear amplitude
    /// there is not smaller than on n. None without shear.
    pub(crate) fn complementary(&self, n: [f64; 3]) -> Option<[f64; 3]> {
        let First::Shear(stresses) = &self.first else {
            return None;
        };
        let shear = |[a, b]: [usize; 2]| {
            let change = traction(&difference(&stresses[b], &stresses[a]), n);
            let along = dot(change, n);
            std::array::from_fn(|d| change[d] - along * n[d])
        };
        let changes = [[0, 1], [1, 2], [2, 0]].map(shear);
        let largest = changes
            .into_iter()
            .max_by(|a, b| dot(*a, *a).total_cmp(&dot(*b, *b)))?;
        (dot(largest, largest) > 0.0).then(|| normalize(largest))
    }

    /// The two parts on the plane of a unit normal; `radius` computes the radius of the circle from its three
    /// points.
    fn parts_with_circle(&self, n: [f64; 3], radius: impl Fn([[f64; 2]; 3]) -> f64) -> [f64; 2] {
        let normal = normal_weights(n);
        let component = |weights: &[f64; 6], s: &StressTensor| -> f64 {
            weights.iter().zip(s).map(|(w, s)| w * s).sum()
        };
        let first = match &self.first {
            First::Normal(tensor) => component(&normal, tensor),
            First::Shear(stresses) => {
                let Frame { u, v, .. } = Frame::from_normal(n);
                let (u, v) = (shear_weights(n, u), shear_weights(n, v));
                radius(stresses.map(|s| [component(&u, &s), component(&v, &s)]))
            }
        };
        [first, component(&normal, &self.second)]
    }
}

/// Square of the radius of the smallest circle round 0, p and q, from p.p, q.q and p.q.
fn square_radius(pp: f64, qq: f64, pq: f64) -> f64 {
    let across = pp + qq - 2.0 * pq;
    if pq <= 0.0 {
        across / 4.0
    } else if pp <= pq {
        qq / 4.0
    } else if qq <= pq {
        pp / 4.0
    } else {
        pp * qq * across / (4.0 * (pp * qq - pq * pq))
    }
}

/// The traction S.n on a plane.
fn traction(s: &StressTensor, n: [f64; 3]) -> [f64; 3] {
    [
        s[0] * n[0] + s[3] * n[1] + s[4] * n[2],
        s[3] * n[0] + s[1] * n[1] + s[5] * n[2],
        s[4] * n[0] + s[5] * n[1] + s[2] * n[2],
    ]
}

/// s - reference.
fn difference(s: &StressTensor, reference: &StressTensor) -> StressTensor {
    let mut change = *s;
    for c in 0..6 {
        change[c] -= reference[c];
    }
    change
}

/// Finds the maximum of `f` near the plane n, by Newton steps to rounding; returns its normal and value.
pub(crate) fn refine(f: &impl Fn([f64; 3]) -> f64, n: [f64; 3]) -> ([f64; 3], f64) {
    let mut best = refine_roughly(f, n, f64::NEG_INFINITY);
    for _ in 0..8 {
        let Some((turn, candidate)) = newton_step::<true>(f, best) else {
            break;
        };
        let rounding = 4.0 * f64::EPSILON * best.1.abs();
        if candidate.1 < best.1 - rounding {
            break;
        }
        best = candidate;
        if turn < CLOSE {
            break;
        }
    }
    best
}

/// Finds the maximum of `f` near the plane n as [`refine`], to `NEARLY`^2. Stops early if the gains, which
/// decrease from step to step, cannot lead above `least`.
pub(crate) fn refine_roughly(
    f: &impl Fn([f64; 3]) -> f64,
    n: [f64; 3],
    least: f64,
) -> ([f64; 3], f64) {
    let mut best = (n, f(n));
    for _ in 0..8 {
        let Some((turn, candidate)) = newton_step::<false>(f, best) else {
            break;
        };
        if candidate.1 < best.1 {
            break;
        }
        let gain = candidate.1 - best.1;
        best = candidate;
        if turn < NEARLY || best.1 + gain < least {
            break;
        }
    }
    best
}

/// Makes one Newton step with differences to planes around, shortened while the value falls.
/// Returns its angle \[rad\], the plane and the value there. Slopes are of sixth order in `TURN` if
/// `SHARP`, else of second.
fn newton_step<const SHARP: bool>(
    f: &impl Fn([f64; 3]) -> f64,
    (n, here): ([f64; 3], f64),
) -> Option<(f64, ([f64; 3], f64))> {
    let Frame { n, u, v } = Frame::from_normal(n);
    let turned = |a: f64, b: f64| {
        let along = |d: usize| n[d] + a * u[d] + b * v[d];
        normalize([along(0), along(1), along(2)])
    };
    let value_at = |a: f64, b: f64| f(turned(a * TURN, b * TURN));
    let axis = |a: f64, b: f64| {
        let [east, west] = [value_at(a, b), value_at(-a, -b)];
        let bend = east + west - 2.0 * here;
        if !SHARP {
            return ((east - west) / 2.0, bend);
        }
        let second = value_at(2.0 * a, 2.0 * b) - value_at(-2.0 * a, -2.0 * b);
        let third = value_at(3.0 * a, 3.0 * b) - value_at(-3.0 * a, -3.0 * b);
        ((45.0 * (east - west) - 9.0 * second + third) / 60.0, bend)
    };
    let (slope_u, uu) = axis(1.0, 0.0);
    let (slope_v, vv) = axis(0.0, 1.0);
    let uv = (value_at(1.0, 1.0) + value_at(-1.0, -1.0) - 2.0 * here - uu - vv) / 2.0;
    let [a, b] = top_of_quadratic([slope_u, slope_v], [uu, vv, uv], 1e-10 * here.abs())?;
    let length = a.hypot(b) * TURN;
    let mut share = (LONGEST / length).min(1.0);
    for _ in 0..6 {
        let (a, b) = (a * share * TURN, b * share * TURN);
        let candidate = turned(a, b);
        let value = f(candidate);
        if value >= here || length < 1e-6 {
            return Some((length * share, (candidate, value)));
        }
        share /= 3.0;
    }
    None
}

/// The step to the top of a quadratic with this slope and second derivatives. It uses directions that bend down
/// by more than `flat`; along others it takes the longest step uphill. None without an upward step.
fn top_of_quadratic(slope: [f64; 2], [uu, vv, uv]: [f64; 3], flat: f64) -> Option<[f64; 2]> {
    let angle = 0.5 * (2.0 * uv).atan2(uu - vv);
    let (sin, cos) = angle.sin_cos();
    let mut top = [0.0; 2];
    for [a, b] in [[cos, sin], [-sin, cos]] {
        let bend = a * a * uu + b * b * vv + 2.0 * a * b * uv;
        let uphill = slope[0] * a + slope[1] * b;
        let step = if bend < -flat {
            -uphill / bend
        } else if uphill.abs() > flat {
            uphill.signum() * LONGEST / TURN
        } else {
            0.0
        };
        top = [top[0] + step * a, top[1] + step * b];
    }
    (top != [0.0; 2]).then_some(top)
}
