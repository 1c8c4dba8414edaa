//! Frequency response of a stack of layers on a half-space.
//!
//! Tractions exp(i k.x) split into an in-plane problem along the wave vector (r, z) and an
//! out-of-plane problem across it (t). With u_r = i U, q_r = i Q the in-plane problem is real:
//! the material below a plane answers the tractions T = (Q, p) on it with (U, u_z) = Y T / k,
//! Y symmetric. In a layer of shear modulus G and Poisson's ratio nu, fields that decay downwards
//! obey Y = Y_d, those that decay upwards Y = Y_u,
//!
//! ```text
//! Y_d = [a b; b a],  Y_u = [-a b; b -a],  a = (1 - nu)/G,  b = (1 - 2 nu)/(2 G),
//! ```
//!
//! so that Y_u - Y_d = -2 a, and over a thickness x = k h their tractions change by
//!
//! ```text
//! P_d = exp(-x) (1 + x [-1 -1; 1 1]),  P_u = exp(-x) (1 + x [-1 1; -1 1]),
//! ```
//!
//! for every nu (from p' = k Q, Q' = k s_rr and Hooke's law). Above a stack that answers with Y_s
//! the tractions of the two families stand in the ratio R_0 = -(2a + D)^-1 D at the bottom of the
//! layer, D = Y_s - Y_d, and R = P_u R_0 P_d at its top, where therefore
//!
//! ```text
//! Y - Y_d = -2a R (1 + R)^-1.
//! ```
//!
//! Only decaying exponentials occur, and the difference to the half-space of the layer's own
//! material comes out with full relative accuracy. With S = 2a (2a + D)^-1 = 1 + R_0, the matrix
//! 1 + R = (1 - P_u P_d) + P_u S P_d adds positive parts, and Y - Y_s is found without
//! cancellation where x is small.
//!
//! A bond of the compliance (c_s, c_n) adds to the response of the material below it: Y + k
//! diag(c_s, c_n) in the plane, Y + k c_s out of it; the tractions are the same on both sides.

use super::matrix::Matrix2;
use crate::error::Error;
use crate::scene::{Body, Bond, Elastic};

/// Phase thickness k h below which Y is computed as a change of the response of the material below
/// the layer, and above which as a change of the response of the layer's half-space; both forms are
/// valid on either side.
const THIN: f64 = 0.5;

/// Ratio of the response of the material below a thin layer to the layer's own above which the
/// second form is used for the thin layer, too: the change by the layer would be nearly the whole
/// response.
const SOFT: f64 = 1e4;

/// The constants of a material: k times its half-space compliance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    /// u_z/p and u_r/q_r: (1 - nu)/G \[1/Pa\].
    pub(crate) a: f64,
    /// u_r/(i p): (1 - 2 nu)/(2 G) \[1/Pa\].
    pub(crate) b: f64,
    /// u_t/q_t: 1/G \[1/Pa\].
    pub(crate) c: f64,
    /// Poisson's ratio.
    pub(crate) nu: f64,
}

impl HalfSpace {
    /// The constants of a material in the formulas: (1 - nu)/G, (1/2 - nu)/G and 1/G \[1/Pa\].
    pub(crate) fn new(material: Elastic) -> Self {
        let (G, nu) = (material.G(), material.nu);
        Self {
            a: (1.0 - nu) / G,
            b: (0.5 - nu) / G,
            c: 1.0 / G,
            nu,
        }
    }

    /// Y_d: displacements over tractions of fields that decay downwards, times k.
    pub(crate) fn down(&self) -> Matrix2 {
        Matrix2(self.a, self.b, self.b, self.a)
    }

    /// Y_u: displacements over tractions of fields that decay upwards, times k.
    pub(crate) fn up(&self) -> Matrix2 {
        Matrix2(-self.a, self.b, self.b, -self.a)
    }
}

/// Surface response times k: four real functions of k \[1/Pa\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RadialResponse {
    /// k u_z / p.
    pub zz: f64,
    /// k u_r / q_r, along the wave vector.
    pub rr: f64,
    /// k u_t / q_t, across it.
    pub tt: f64,
    /// k u_r / (i p) = k u_z / (-i q_r).
    pub rz: f64,
}

/// P_d: change of the tractions of the downward family over x = k h.
pub(crate) fn propagate_down(x: f64) -> Matrix2 {
    let e = (-x).exp();
    let xe = if e == 0.0 { 0.0 } else { x * e };
    Matrix2(e - xe, -xe, xe, e + xe)
}

/// P_u: change of the tractions of the upward family over x = k h.
pub(crate) fn propagate_up(x: f64) -> Matrix2 {
    let e = (-x).exp();
    let xe = if e == 0.0 { 0.0 } else { x * e };
    Matrix2(e - xe, xe, -xe, e + xe)
}

/// 1 - P_u P_d, the change of the tractions over a way down and up the layer, without cancellation as x = k h
/// -> 0.
fn one_minus_round_trip(x: f64) -> Matrix2 {
    let e = (-2.0 * x).exp();
    if e == 0.0 {
        return Matrix2::ONE;
    }
    let first = -(-2.0 * x).exp_m1() + e * (2.0 * x - 2.0 * x * x);
    // 1 - exp(-2x) (1 + 2x + 2x^2) = exp(-2x) times the rest of the exponential series.
    let last = if x < 1.0 {
        let y = 2.0 * x;
        let mut term = y * y * y / 6.0;
        let mut sum = 0.0;
        let mut n = 4.0;
        while term > sum * f64::EPSILON / 4.0 {
            sum += term;
            term *= y / n;
            n += 1.0;
        }
        e * sum
    } else {
        1.0 - e * (1.0 + 2.0 * x + 2.0 * x * x)
    };
    let off = -e * 2.0 * x * x;
    Matrix2(first, off, off, last)
}

/// The response of the material below a plane.
#[derive(Clone, Copy, Debug)]
struct ResponseBelow {
    /// Response in the plane.
    y: Matrix2,
    /// The same minus the response of the half-space of the uppermost material.
    y_remainder: Matrix2,
    /// Out-of-plane response.
    t: f64,
    /// The same minus the response of the half-space of the uppermost material.
    t_remainder: f64,
    /// The uppermost material.
    top: HalfSpace,
}

/// The two families of fields in one layer at one wave number, from the recursion.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LayerWaves {
    /// R_0: upward over downward tractions at the bottom, in-plane.
    pub(crate) r0: Matrix2,
    /// S = 1 + R_0.
    pub(crate) s: Matrix2,
    /// R = P_u R_0 P_d: the same ratio at the top.
    pub(crate) r: Matrix2,
    /// (1 + R)^-1: downward traction at the top over the traction there.
    pub(crate) down: Matrix2,
    /// Ratios r0, s, r and down of the out-of-plane problem.
    pub(crate) r0_t: f64,
    pub(crate) s_t: f64,
    pub(crate) r_t: f64,
    pub(crate) down_t: f64,
}

impl ResponseBelow {
    /// The response of a half-space, of which nothing is left when the half-space is subtracted.
    fn half_space(material: HalfSpace) -> Self {
        Self {
            y: material.down(),
            y_remainder: Matrix2::default(),
            t: material.c,
            t_remainder: 0.0,
            top: material,
        }
    }

    /// The response minus the response of the half-space of `layer`, by the one of its two forms
    /// that cancels less.
    fn mismatch(&self, layer: HalfSpace) -> (Matrix2, f64) {
        let in_plane = if self.y_remainder.size() < 0.5 * self.top.a {
            (self.top.down() - layer.down()) + self.y_remainder
        } else {
            self.y - layer.down()
        };
        let out_of_plane = if self.t_remainder.abs() < 0.5 * self.top.c {
            (self.top.c - layer.c) + self.t_remainder
        } else {
            self.t - layer.c
        };
        (in_plane, out_of_plane)
    }

    /// Adds the compliance of a bond on top to the response, at the wave number k \[1/m\].
    fn add_bond(self, bond: Bond, k: f64) -> Self {
        let (shear, normal) = (k * bond.shear, k * bond.normal);
        let compliance = Matrix2(shear, 0.0, 0.0, normal);
        Self {
            y: self.y + compliance,
            y_remainder: self.y_remainder + compliance,
            t: self.t + shear,
            t_remainder: self.t_remainder + shear,
            top: self.top,
        }
    }

    /// The response with `layer` of phase thickness x = k h on top, and the waves in the layer.
    fn add_layer(&self, layer: HalfSpace, x: f64) -> (Self, LayerWaves) {
        let (d, d_t) = self.mismatch(layer);
        let (a2, c2) = (2.0 * layer.a, 2.0 * layer.c);
        let sum = Matrix2::ONE * a2 + d;
        let inverse = sum.inverse();
        let (r0, s) = (-(inverse * d), inverse * a2);
        let (pd, pu) = (propagate_down(x), propagate_up(x));
        let r = pu * r0 * pd;
        let closed = one_minus_round_trip(x);
        let down = (closed + pu * s * pd).inverse();
        let y_rest = (r * down * -a2).symmetric();

        let (r0_t, s_t) = (-d_t / (c2 + d_t), c2 / (c2 + d_t));
        let round_trip = (-2.0 * x).exp();
        let closed_t = -(-2.0 * x).exp_m1();
        let r_t = r0_t * round_trip;
        let down_t = 1.0 / (closed_t + s_t * round_trip);
        let t_rest = -c2 * r_t * down_t;

        let (y, t) = if x < THIN && d.size() < SOFT * layer.a {
            let em = (-x).exp_m1();
            let xe = x * (-x).exp();
            let (ed, eu) = (
                Matrix2(em - xe, -xe, xe, em + xe),
                Matrix2(em - xe, xe, -xe, em + xe),
            );
            let change = closed + eu * s + s * ed + eu * s * ed;
            let change_t = -closed_t * r0_t;
            (
                self.y - (sum * change * down).symmetric(),
                self.t - (c2 + d_t) * change_t * down_t,
            )
        } else {
            (layer.down() + y_rest, layer.c + t_rest)
        };
        let below = Self {
            y,
            y_remainder: y_rest,
            t,
            t_remainder: t_rest,
            top: layer,
        };
        let waves = LayerWaves {
            r0,
            s,
            r,
            down,
            r0_t,
            s_t,
            r_t,
            down_t,
        };
        (below, waves)
    }
}

/// A stack of layers on a half-space, ready for any wave number.
#[derive(Clone, Debug, PartialEq)]
pub struct Stack {
    /// Layers from the surface down, with their thickness \[m\].
    pub(crate) layers: Vec<(HalfSpace, f64)>,
    /// The bond below each layer.
    pub(crate) bonds: Vec<Bond>,
    /// The half-space below.
    pub(crate) substrate: HalfSpace,
}

impl Stack {
    /// Builds the stack of a body; fails if the body has no meaning.
    pub fn from_checked_body(body: &Body) -> Result<Self, Error> {
        body.check_alone()?;
        Ok(Self::new(body))
    }

    /// Builds the stack of a body.
    pub fn new(body: &Body) -> Self {
        let layer = |c: &crate::scene::Coating| (HalfSpace::new(c.material), c.thickness);
        Self {
            layers: body.coatings.iter().map(layer).collect(),
            bonds: (0..body.coatings.len()).map(|n| body.bond(n)).collect(),
            substrate: HalfSpace::new(body.substrate),
        }
    }

    /// The material at the surface.
    pub(crate) fn outermost(&self) -> HalfSpace {
        self.layers.first().map_or(self.substrate, |l| l.0)
    }

    /// Computes the response at the surface from the substrate up.
    fn response_at_surface(&self, k: f64) -> ResponseBelow {
        let start = ResponseBelow::half_space(self.substrate);
        let layers = self.layers.iter().zip(&self.bonds).rev();
        layers.fold(start, |below, ((layer, h), bond)| {
            below.add_bond(*bond, k).add_layer(*layer, k * h).0
        })
    }

    /// The surface response times k, at the wave number `k` \[1/m\] >= 0.
    pub fn response(&self, k: f64) -> RadialResponse {
        let ResponseBelow { y, t, .. } = self.response_at_surface(k);
        RadialResponse {
            zz: y.3,
            rr: y.0,
            tt: t,
            rz: y.1,
        }
    }

    /// The surface response times k minus the response of the half-space of the outermost material; it
    /// decays like exp(-2 k h) with the thickness h of the outermost layer.
    pub fn remainder(&self, k: f64) -> RadialResponse {
        let ResponseBelow {
            y_remainder: y_rest,
            t_remainder: t_rest,
            ..
        } = self.response_at_surface(k);
        RadialResponse {
            zz: y_rest.3,
            rr: y_rest.0,
            tt: t_rest,
            rz: y_rest.1,
        }
    }

    /// The two families of fields in every layer, from the surface down.
    pub(crate) fn waves(&self, k: f64) -> Vec<LayerWaves> {
        let mut below = ResponseBelow::half_space(self.substrate);
        let mut waves = Vec::with_capacity(self.layers.len());
        for ((layer, h), bond) in self.layers.iter().zip(&self.bonds).rev() {
            let (with_layer, wave) = below.add_bond(*bond, k).add_layer(*layer, k * h);
            waves.push(wave);
            below = with_layer;
        }
        waves.reverse();
        waves
    }

    /// The largest 1/G of the layers and the substrate \[1/Pa\].
    pub(crate) fn largest_compliance(&self) -> f64 {
        let materials = self.layers.iter().map(|l| l.0).chain([self.substrate]);
        materials.map(|m| m.c).fold(0.0, f64::max)
    }

    /// A wave number well within the radius of convergence of the power series of the response at
    /// k = 0: the nearest singularity lies at 1/(H contrast) or beyond, H being the height of the
    /// stack; a bond counts as a layer of the softest material with the same compliance.
    pub(crate) fn lowest_scale(&self) -> f64 {
        let materials = || self.layers.iter().map(|l| l.0).chain([self.substrate]);
        let finite = || materials().map(|m| m.c).filter(|c| *c > 0.0);
        let stiffest = finite().fold(f64::INFINITY, f64::min);
        let softest = finite().fold(0.0, f64::max);
        let height: f64 = self.layers.iter().map(|l| l.1).sum();
        let bonds: f64 = self.bonds.iter().map(|b| b.normal + b.shear).sum();
        stiffest / (softest * height + bonds)
    }
}
