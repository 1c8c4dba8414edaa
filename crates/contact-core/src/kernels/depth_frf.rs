//! Frequency response below the surface: displacements and stresses at any depth.
//!
//! From the recursion of [`super::layered_frf`] the tractions are carried down again. At the top
//! of a layer the downward family takes (1 + R)^-1 of the traction; at depth z in it
//!
//! ```text
//! T_d(z) = P_d(k z) T_d(0),   T_u(z) = P_u(k (h - z)) R_0 P_d(k h) T_d(0),
//! ```
//!
//! and S P_d(k h) T_d(0) is handed to the layer below. Hooke's law gives the stress along the wave
//! vector, s_rr = -2 Q - p in the downward family and 2 Q - p in the upward one, for every nu.

use rustfft::num_complex::Complex64;

use super::layered_frf::{HalfSpace, LayerWaves, Stack, propagate_down, propagate_up};
use super::matrix::Matrix2;
use crate::error::Error;
use crate::magnitude::{LARGEST, SMALLEST};

/// Share of the stack's height by which a depth may miss its layer, for rounded sums of
/// thicknesses.
const ROUNDING: f64 = 1e-12;

/// Displacements and stresses under tractions exp(i(k_x x + k_y y)); columns q_x, q_y, p.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrequencyResponse {
    /// u_x, u_y, u_z \[m/Pa\].
    pub u: [[Complex64; 3]; 3],
    /// s_xx, s_yy, s_zz, s_xy, s_xz, s_yz \[-\], tension positive.
    pub s: [[Complex64; 3]; 6],
}

/// A depth and the material at this depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthPoint {
    /// Depth \[m\].
    pub(crate) z: f64,
    /// Layer from the surface down; the number of coatings for the substrate.
    pub layer: usize,
    /// Depth below the top of the layer \[m\].
    pub(crate) below_top: f64,
}

/// The response at depth in the frame of the wave vector. Matrices act on (Q, p).
#[derive(Clone, Copy, Debug, Default)]
pub struct WaveFields {
    /// Tractions (Q, p) on a plane.
    pub(crate) traction: Matrix2,
    /// k (U, u_z) \[1/Pa\].
    pub(crate) u: Matrix2,
    /// s_rr under Q and under p.
    pub(crate) s_rr: [f64; 2],
    /// s_tt under Q and under p.
    pub(crate) s_tt: [f64; 2],
    /// q_t under q_t.
    pub(crate) q_t: f64,
    /// k u_t under q_t \[1/Pa\].
    pub(crate) u_t: f64,
    /// s_rt / i under q_t.
    pub(crate) s_rt: f64,
}

impl WaveFields {
    /// Adds up displacements and stresses of the downward and the upward family in a material. `down` and `up`
    /// are their tractions in the plane of the wave (columns: load), `down_t` and `up_t` across it.
    fn new(m: &HalfSpace, down: Matrix2, up: Matrix2, down_t: f64, up_t: f64) -> Self {
        let traction = down + up;
        let s_rr = [
            2.0 * (up.0 - down.0) - traction.2,
            2.0 * (up.1 - down.1) - traction.3,
        ];
        Self {
            traction,
            u: m.down() * down + m.up() * up,
            s_rr,
            s_tt: [m.nu * (s_rr[0] - traction.2), m.nu * (s_rr[1] - traction.3)],
            q_t: down_t + up_t,
            u_t: m.c * (down_t - up_t),
            s_rt: down_t - up_t,
        }
    }
}

impl Stack {
    /// Finds the layer of a depth; `layer` decides at an interface (default: the upper one).
    pub fn locate_depth(&self, z: f64, layer: Option<usize>) -> Result<DepthPoint, Error> {
        let height: f64 = self.layers.iter().map(|l| l.1).sum();
        let slack = ROUNDING * height;
        if !(z >= 0.0 && z.is_finite()) {
            return Err(Error::invalid("z", z, "a depth in m, 0 or more"));
        }
        let mut top = 0.0;
        for (n, thickness) in self
            .layers
            .iter()
            .map(|l| l.1)
            .chain([f64::INFINITY])
            .enumerate()
        {
            let inside = z >= top - slack && z <= top + thickness + slack;
            if inside && layer.is_none_or(|l| l == n) {
                return Ok(DepthPoint {
                    z,
                    layer: n,
                    below_top: (z - top).clamp(0.0, thickness),
                });
            }
            top += thickness;
        }
        Err(Error::invalid(
            "layer",
            layer.unwrap_or_default(),
            format!(
                "the layer (0 to {}) in which z = {z} m lies",
                self.layers.len()
            ),
        ))
    }

    /// The stresses and displacements at a depth per unit traction of wave number k \[1/m\] on the surface.
    /// `remainder` subtracts the half-space of the outermost material, which decays slower (only for places in
    /// the outermost layer).
    pub(crate) fn fields(&self, k: f64, place: &DepthPoint, remainder: bool) -> WaveFields {
        let mut fields = WaveFields::default();
        let places = std::slice::from_ref(place);
        self.fields_of_places(k, places, remainder, |_, response| fields = response);
        fields
    }

    /// The responses at several depths by one recursion over the layers; `put` takes each response with
    /// the number of its depth. `remainder` as in [`Self::fields`].
    pub(crate) fn fields_of_places(
        &self,
        k: f64,
        places: &[DepthPoint],
        remainder: bool,
        mut put: impl FnMut(usize, WaveFields),
    ) {
        let waves = self.waves(k);
        let deepest = places.iter().map(|place| place.layer).max().unwrap_or(0);
        // Tractions on the top of each layer.
        let mut tops = Vec::with_capacity(deepest + 1);
        tops.push((Matrix2::ONE, 1.0));
        for (wave, (_, h)) in waves.iter().zip(&self.layers).take(deepest) {
            let (traction, traction_t) = tops[tops.len() - 1];
            let x = k * h;
            tops.push((
                wave.s * propagate_down(x) * wave.down * traction,
                traction_t * (wave.s_t * (-x).exp() * wave.down_t),
            ));
        }
        for (n, place) in places.iter().enumerate() {
            let wave = waves.get(place.layer);
            put(
                n,
                self.fields_in_layer(k, place, (wave, tops[place.layer]), remainder),
            );
        }
    }

    /// The response in a layer with its waves, under the tractions on its top.
    fn fields_in_layer(
        &self,
        k: f64,
        place: &DepthPoint,
        (wave, (traction, traction_t)): (Option<&LayerWaves>, (Matrix2, f64)),
        remainder: bool,
    ) -> WaveFields {
        let x = k * place.below_top;
        let decay_down = propagate_down(x);
        let Some((wave, (material, h))) = wave.zip(self.layers.get(place.layer)) else {
            let (down, down_t) = (decay_down * traction, (-x).exp() * traction_t);
            return WaveFields::new(&self.substrate, down, Matrix2::default(), down_t, 0.0);
        };
        let (start, start_t) = (wave.down * traction, wave.down_t * traction_t);
        let phase_to_bottom = k * h - x;
        let up = propagate_up(phase_to_bottom) * wave.r0 * propagate_down(k * h) * start;
        let up_t = wave.r0_t * (-phase_to_bottom - k * h).exp() * start_t;
        let (down, down_t) = if remainder {
            // (1 + R)^-1 - 1 = -R (1 + R)^-1
            (
                -(decay_down * wave.r * wave.down),
                -(-x).exp() * wave.r_t * wave.down_t,
            )
        } else {
            (decay_down * start, (-x).exp() * start_t)
        };
        WaveFields::new(material, down, up, down_t, up_t)
    }

    /// Surface displacements under tractions exp(i(k_x x + k_y y)) \[m/Pa\]: rows u_x, u_y, u_z,
    /// columns q_x, q_y, p; (k_x, k_y) \[1/m\] not both zero.
    pub fn surface_frf(&self, k_x: f64, k_y: f64) -> Result<[[Complex64; 3]; 3], Error> {
        let k = wave_number(k_x, k_y)?;
        let r = self.response(k);
        let u = Matrix2(r.rr, r.rz, r.rz, r.zz);
        Ok(displacements(u, r.tt, (k_x, k_y, k)))
    }

    /// Displacements and stresses at the depth `z` \[m\] under tractions exp(i(k_x x + k_y y));
    /// `layer` (the number of coatings for the substrate) decides at an interface, by default the upper one.
    pub fn frf(
        &self,
        k_x: f64,
        k_y: f64,
        z: f64,
        layer: Option<usize>,
    ) -> Result<FrequencyResponse, Error> {
        let k = wave_number(k_x, k_y)?;
        let place = self.locate_depth(z, layer)?;
        let f = self.fields(k, &place, false);
        let wave = (k_x, k_y, k);
        Ok(FrequencyResponse {
            u: displacements(f.u, f.u_t, wave),
            s: stresses(&f, wave),
        })
    }
}

/// Length of the wave vector \[1/m\]; fails at zero and beyond the range of the arithmetic.
fn wave_number(k_x: f64, k_y: f64) -> Result<f64, Error> {
    let k = k_x.hypot(k_y);
    if (SMALLEST..=LARGEST).contains(&k) {
        return Ok(k);
    }
    Err(Error::invalid(
        "(k_x, k_y)",
        format!("({k_x}, {k_y})"),
        format!("of a size from {SMALLEST:e} to {LARGEST:e}: at zero the response is singular"),
    ))
}

/// Rotates k (U, u_z) and k u_t from the wave vector's frame; U = u_r/i, Q = q_r/i.
fn displacements(u: Matrix2, u_t: f64, wave: (f64, f64, f64)) -> [[Complex64; 3]; 3] {
    let (k_x, k_y, k) = wave;
    let (c, s) = (k_x / k, k_y / k);
    let re = |v: f64| Complex64::new(v / k, 0.0);
    let im = |v: f64| Complex64::new(0.0, v / k);
    let shear = re((u.0 - u_t) * c * s);
    [
        [re(u.0 * c * c + u_t * s * s), shear, im(u.1 * c)],
        [shear, re(u.0 * s * s + u_t * c * c), im(u.1 * s)],
        [im(-u.2 * c), im(-u.2 * s), re(u.3)],
    ]
}

/// Rotates the stresses: rows s_xx, s_yy, s_zz, s_xy, s_xz, s_yz, columns q_x, q_y, p.
fn stresses(f: &WaveFields, wave: (f64, f64, f64)) -> [[Complex64; 3]; 6] {
    let (c, s) = (wave.0 / wave.2, wave.1 / wave.2);
    // Columns in the frame of the wave: under q_r = i Q, q_t and p.
    let over_i = |v: f64| Complex64::new(0.0, -v);
    let real = |v: f64| Complex64::new(v, 0.0);
    let imaginary = |v: f64| Complex64::new(0.0, v);
    let zero = Complex64::default();
    // (rr, tt, zz, rt, rz, tz); s_rz = -q_r = -i Q.
    let t = f.traction;
    let under_r = [
        over_i(f.s_rr[0]),
        over_i(f.s_tt[0]),
        over_i(-t.2),
        zero,
        real(-t.0),
        zero,
    ];
    let under_t = [zero, zero, zero, imaginary(f.s_rt), zero, real(-f.q_t)];
    let under_p = [
        real(f.s_rr[1]),
        real(f.s_tt[1]),
        real(-t.3),
        zero,
        imaginary(-t.1),
        zero,
    ];
    let rotate_to_xy = |[rr, tt, zz, rt, rz, tz]: [Complex64; 6]| {
        [
            rr * c * c + tt * s * s - rt * 2.0 * c * s,
            rr * s * s + tt * c * c + rt * 2.0 * c * s,
            zz,
            (rr - tt) * c * s + rt * (c * c - s * s),
            rz * c - tz * s,
            rz * s + tz * c,
        ]
    };
    let (r, t, p) = (
        rotate_to_xy(under_r),
        rotate_to_xy(under_t),
        rotate_to_xy(under_p),
    );
    std::array::from_fn(|row| [r[row] * c - t[row] * s, r[row] * s + t[row] * c, p[row]])
}
