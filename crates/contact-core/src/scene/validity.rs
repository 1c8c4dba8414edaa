//! Whether the bodies may be taken as half-spaces: the half width of the contact over the radius of
//! each body, as a body. The relative radius of a shaft in its bushing is large, the shaft is not.

use plausible::UNITS;

use super::shape::Shape;
use super::{Body, Scene};
use crate::digits::short;
use crate::error::Error;
use crate::hertz::hertz_ellipse;

/// Half width over radius up to which half-spaces hold to some per cent.
const WIDE: f64 = 0.1;
/// Half width over radius from which on the surface is no parabola and the body no half-space.
const WIDEST: f64 = 1.0;

/// The half width of a contact beside the radius of a body, where their ratio is largest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Breadth {
    /// Half width of the contact along the principal direction of the body \[m\].
    pub half_width: f64,
    /// Principal radius of the body in that direction \[m\], negative for a hollow one.
    pub R: f64,
    /// The body, 1 or 2.
    pub body: usize,
    /// Radius of the other body in that direction, if one is hollow and holds the other \[m\].
    pub conforms_to: Option<f64>,
}

impl Breadth {
    /// Half width over radius.
    pub fn ratio(&self) -> f64 {
        self.half_width / self.R.abs()
    }

    /// Describes the ratio for people.
    fn describe(&self) -> String {
        let Self {
            half_width,
            R,
            body,
            conforms_to,
        } = *self;
        let conformal = conforms_to.map_or(String::new(), |other| {
            format!(
                ", in a conformal contact with body{} (R = {} m)",
                3 - body,
                short(other)
            )
        });
        format!(
            "a/R = {:.2}: the half width of the contact is {} m, the radius of body{body} {} m{conformal}",
            self.ratio(),
            short(half_width),
            short(R)
        )
    }
}

impl Scene {
    /// The half width of the contact over the radius of a body, where this ratio is largest; `half_width` is
    /// the half width \[m\] in a direction \[rad\]. `None` where no body is curved.
    pub fn breadth(&self, half_width: impl Fn(f64) -> f64) -> Option<Breadth> {
        let bodies = [&self.body1, &self.body2];
        let mut breadths = Vec::new();
        for (n, body) in bodies.into_iter().enumerate() {
            for (k, azimuth) in self.principal_curvatures_of(&body.shape) {
                let other_curvature = normal_curvature(bodies[1 - n].shape.curvature(), azimuth);
                breadths.push(Breadth {
                    half_width: half_width(azimuth),
                    R: 1.0 / k,
                    body: n + 1,
                    conforms_to: (k * other_curvature < 0.0).then(|| 1.0 / other_curvature),
                });
            }
        }
        breadths
            .into_iter()
            .max_by(|a, b| a.ratio().total_cmp(&b.ratio()))
    }

    /// Breadth of the Hertz contact of the substrates under the largest load of the path.
    pub fn hertz_breadth(&self) -> Option<Breadth> {
        self.breadth_for_radius(self.hertz()?.a)
    }

    /// Breadth of a contact of the Hertz shape with the mean radius or half width `a` \[m\]. Without a
    /// Hertz contact the shape is taken as round.
    pub(crate) fn breadth_for_radius(&self, a: f64) -> Option<Breadth> {
        let (steep, shallow) = self.principal_curvatures();
        if self.grid.plane_strain || shallow <= 1e-9 * steep {
            return self.breadth(|_| a);
        }
        let ellipse = hertz_ellipse(1.0 / shallow, 1.0 / steep, 1.0, 1.0);
        let mean = (ellipse.a_x * ellipse.a_y).sqrt();
        let [cos, sin] = self.steepest_direction();
        let (long, short) = (a * ellipse.a_x / mean, a * ellipse.a_y / mean);
        self.breadth(|azimuth| {
            let (s, c) = azimuth.sin_cos();
            (short * (c * cos + s * sin)).hypot(long * (s * cos - c * sin))
        })
    }

    /// Fails if the contact is certain to be wider than a body, even if each were of its stiffest
    /// material alone.
    pub(super) fn check_breadth(&self) -> Result<(), Error> {
        let stiffest_scene = Self {
            body1: stiffest(&self.body1),
            body2: stiffest(&self.body2),
            ..self.clone()
        };
        let breadth = stiffest_scene.hertz_breadth();
        breadth.map_or(Ok(()), |breadth| stiffest_scene.check_ratio(&breadth))
    }

    /// Fails at a contact whose half width over the radius of a body is [`WIDEST`] or more.
    pub(crate) fn check_ratio(&self, breadth: &Breadth) -> Result<(), Error> {
        if breadth.ratio() < WIDEST {
            return Ok(());
        }
        let load = self.hertz().map_or(String::new(), |hertz| {
            format!(
                " (W = {:.3e} {}, E* = {:.3e} Pa)",
                hertz.W,
                self.grid.unit_of("N"),
                hertz.E_star
            )
        });
        Err(Error::invalid(
            "path",
            format!("a contact with {}{load}", breadth.describe()),
            format!(
                "below a/R = {WIDEST}: half-spaces hold up to a/R = {WIDE}, and a conformal contact needs another method; {UNITS}"
            ),
        ))
    }

    /// Doubts a contact that is wide for a body but not refused.
    pub(crate) fn doubt_of_breadth(&self, breadth: &Breadth) -> Option<String> {
        let pressure = self.hertz().map_or(String::new(), |hertz| {
            format!(", the peak pressure {:.2} E*", hertz.p0 / hertz.E_star)
        });
        (WIDE..WIDEST).contains(&breadth.ratio()).then(|| {
            format!(
                "{}{pressure}: half-spaces hold up to a/R = {WIDE}; {UNITS}",
                breadth.describe()
            )
        })
    }

    /// Returns the principal curvatures of a shape that are not zero \[1/m\], with their directions
    /// \[rad\]; of line contacts the one along x.
    fn principal_curvatures_of(&self, shape: &Shape) -> Vec<(f64, f64)> {
        let [xx, xy, yy] = shape.curvature();
        if self.grid.plane_strain {
            return if xx == 0.0 {
                Vec::new()
            } else {
                vec![(xx, 0.0)]
            };
        }
        let (mean, half) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let azimuth = 0.5 * xy.atan2(0.5 * (xx - yy));
        let principal_pairs = [
            (mean + half, azimuth),
            (mean - half, azimuth + std::f64::consts::FRAC_PI_2),
        ];
        let negligible = 1e-9 * mean.abs().max(half);
        let curved = principal_pairs
            .into_iter()
            .filter(|(k, _)| k.abs() > negligible);
        curved.collect()
    }
}

/// Curvature along a direction, of second derivatives xx, xy, yy \[1/m\].
fn normal_curvature([xx, xy, yy]: [f64; 3], azimuth: f64) -> f64 {
    let (s, c) = azimuth.sin_cos();
    xx * c * c + 2.0 * xy * s * c + yy * s * s
}

/// The body with all layers replaced by its stiffest material.
pub(super) fn stiffest(body: &Body) -> Body {
    let coatings = body.coatings.iter().map(|c| c.material);
    let modulus = |m: &crate::scene::Elastic| m.E / (1.0 - m.nu * m.nu);
    let substrate = coatings.fold(body.substrate, |s, m| {
        if modulus(&m) > modulus(&s) { m } else { s }
    });
    Body::homogeneous(substrate, body.shape.clone())
}
