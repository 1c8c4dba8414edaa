//! Tables of `tests/data/cracks.json`: dislocations and a Schwarz-Christoffel map agree on them to
//! 3e-10; F = K/(s sqrt(pi l)).

use std::f64::consts::PI;

use fracture::{PlaneStress, Point};
use num_complex::Complex64;
use serde_json::Value;

/// The file.
pub(crate) fn tables() -> Value {
    serde_json::from_str(include_str!("../data/cracks.json")).unwrap()
}

/// Numbers of a row.
pub(crate) fn numbers(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap();
    list.iter().map(|v| v.as_f64().unwrap()).collect()
}

/// F of K \[Pa m^0.5\] under the stress 1.
pub(crate) fn shape(K: f64, length: f64) -> f64 {
    K / (PI * length).sqrt()
}

/// Hertz contact of half-width 1 and peak pressure 1 under shear, with bulk stress in phase.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Fretting {
    pub(crate) pressure: f64,
    /// mu times the sign of the shear.
    pub(crate) shear: f64,
    /// Stick half-width and the middle of the stick zone.
    pub(crate) stick: (f64, f64),
    pub(crate) bulk: f64,
}

impl Fretting {
    /// The cases of the tables by name.
    pub(crate) fn named(name: &str) -> Self {
        let sign = if name.ends_with('-') { -1.0 } else { 1.0 };
        let slip = |mu: f64, stick, bulk| Self {
            pressure: 1.0,
            shear: sign * mu,
            stick,
            bulk,
        };
        let c = 0.5_f64.sqrt();
        match name.trim_end_matches(['+', '-']) {
            "p" => slip(0.0, (0.0, 0.0), 0.0),
            "q" => Self {
                shear: 1.0,
                ..Self::default()
            },
            "FS.3" => slip(0.3, (0.0, 0.0), 0.0),
            "FS.6" => slip(0.6, (0.0, 0.0), 0.0),
            "PS.3" => slip(0.3, (c, 0.0), 0.0),
            "PSB.3" => slip(0.3, (c, 0.125), sign * 0.15),
            other => panic!("no case {other}"),
        }
    }

    /// By Muskhelishvili's functions of sqrt(1 - ((x - e)/c)^2).
    pub(crate) fn at(&self, x: f64, z: f64) -> PlaneStress {
        let zeta = Complex64::new(x, z);
        let i = Complex64::i();
        let ellipse = |c: f64, e: f64| {
            let w = (zeta - e) / c;
            let root = (w - 1.0).sqrt() * (w + 1.0).sqrt();
            (i / 2.0 * (w - root), i / 2.0 * (1.0 - w / root) / c)
        };
        let (h, h1) = ellipse(1.0, 0.0);
        let (mut q, mut q1) = (h * self.shear, h1 * self.shear);
        let (c, e) = self.stick;
        if c > 0.0 {
            let (s, s1) = ellipse(c, e);
            q -= s * self.shear * c;
            q1 -= s1 * self.shear * c;
        }
        let (p, p1) = (h * self.pressure, h1 * self.pressure);
        let (phi, phi1) = (-p + i * q, -p1 + i * q1);
        let psi = -phi - zeta * phi1 + (-p - i * q);
        let sum = 4.0 * phi.re;
        let difference = 2.0 * (zeta.conj() * phi1 + psi);
        [
            (sum - difference.re) / 2.0 + self.bulk,
            f64::midpoint(sum, difference.re),
            difference.im / 2.0,
        ]
    }

    /// At the points of a crack.
    pub(crate) fn along(&self, points: &[Point]) -> Vec<PlaneStress> {
        points.iter().map(|p| self.at(p.x, p.z)).collect()
    }
}
