//! The nominal contact: the contact of the shapes without their unevenness.

use super::Scene;
use crate::error::Error;
use crate::hertz::{contact_modulus, hertz_ellipse, line_contact};

/// Principal curvatures of a line contact: the smaller is below this part of the larger.
const LINE: f64 = 1e-9;
/// Largest part of the grid that carries the load at the hardness.
const FULL: f64 = 0.7;

/// The nominal contact under a normal force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nominal {
    /// Its area \[m^2\].
    pub(crate) area: f64,
    /// Direction of the smaller semi-axis, and both semi-axes \[m\]; none where it is the whole grid.
    ellipse: Option<([f64; 2], [f64; 2])>,
}

impl Nominal {
    /// Whether a point of the contact plane lies in it \[m\].
    pub(crate) fn covers(&self, [x, y]: [f64; 2]) -> bool {
        self.ellipse.is_none_or(|([cos, sin], [a, b])| {
            ((cos * x + sin * y) / a).hypot((cos * y - sin * x) / b) <= 1.0
        })
    }
}

impl Scene {
    /// Whether the surface of a body has hills and valleys, so that the contact may consist of spots.
    pub fn is_uneven(&self) -> bool {
        self.body1.shape.is_uneven() || self.body2.shape.is_uneven()
    }

    /// Largest pressure that the surfaces bear \[Pa\]: the hardness of the softer one, infinite for elastic ones.
    pub fn hardness(&self) -> f64 {
        self.body1.hardness.min(self.body2.hardness)
    }

    /// Fails where a hardness is given with loads for which the indentation is not computed, or that the
    /// grid cannot carry.
    pub(super) fn check_hardness(&self) -> Result<(), Error> {
        let hardness = self.hardness();
        if hardness == f64::INFINITY {
            return Ok(());
        }
        let key = if self.body1.hardness <= self.body2.hardness {
            "body1.hardness"
        } else {
            "body2.hardness"
        };
        if self.yields() {
            let allowed = "left out where a body has plastic: choose one of both";
            return Err(Error::invalid(key, hardness, allowed));
        }
        if self.path.branches.iter().any(|b| b.to.rolled != 0.0) {
            let allowed = "left out where the bodies roll";
            return Err(Error::invalid(key, hardness, allowed));
        }
        let (along_x, along_y) = self.grid.extent();
        let mean = self.path.W_max() / (along_x * along_y);
        if mean >= FULL * hardness {
            let allowed = format!(
                "above {:.3e} Pa, or a larger grid: the load needs {:.0} % of the grid at the hardness",
                mean / FULL,
                100.0 * mean / hardness
            );
            return Err(Error::invalid(key, hardness, allowed));
        }
        Ok(())
    }

    /// The nominal contact under the normal force W \[N\]: the Hertz contact of the uncoated pair, of flat
    /// shapes and without a force the grid.
    pub(crate) fn nominal_contact(&self, W: f64) -> Nominal {
        let (along_x, along_y) = self.grid.extent();
        let whole = Nominal {
            area: along_x * along_y,
            ellipse: None,
        };
        let E_star = contact_modulus(self.body1.substrate, self.body2.substrate);
        if !(W > 0.0 && E_star.is_finite()) {
            return whole;
        }
        let (steep, shallow) = if self.grid.plane_strain {
            let k = self.body1.shape.curvature()[0] + self.body2.shape.curvature()[0];
            (k, 0.0)
        } else {
            self.principal_curvatures()
        };
        if !(steep > 0.0 && shallow >= 0.0) {
            return whole;
        }
        if shallow <= LINE * steep {
            // A strip across the whole grid.
            let direction = if self.grid.plane_strain {
                [1.0, 0.0]
            } else {
                self.steepest_direction()
            };
            let across = along_x * direction[1].abs() + along_y * direction[0].abs();
            let a = line_contact(1.0 / steep, E_star, W / across).a;
            return Nominal {
                area: 2.0 * a * across,
                ellipse: Some((direction, [a, f64::INFINITY])),
            };
        }
        let ellipse = hertz_ellipse(1.0 / steep, 1.0 / shallow, E_star, W);
        Nominal {
            area: std::f64::consts::PI * ellipse.a_x * ellipse.a_y,
            ellipse: Some((self.steepest_direction(), [ellipse.a_x, ellipse.a_y])),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Body, Friction, Grid, LoadPath, Shape};
    use super::*;
    use crate::material::Elastic;

    fn scene(shape: Shape) -> Scene {
        let steel = Elastic::new(210e9, 0.3).expect("a solid");
        let grid = Grid::centred(1e-3, 16).expect("a grid");
        let path = LoadPath::start().normal(10.0, 1);
        let [upper, lower] = [shape, Shape::Flat].map(|shape| Body::homogeneous(steel, shape));
        Scene::new(upper, lower, Friction::coulomb(0.0), grid, path)
    }

    #[test]
    fn a_ball_has_its_hertz_circle_and_a_flat_the_grid() {
        let ball = scene(Shape::sphere(0.01));
        let nominal = ball.nominal_contact(10.0);
        let a = ball.hertz().expect("a contact").a;
        assert!((nominal.area / (std::f64::consts::PI * a * a) - 1.0).abs() < 1e-9);
        assert!(nominal.covers([0.99 * a, 0.0]) && !nominal.covers([0.0, 1.01 * a]));
        let flat = scene(Shape::Flat).nominal_contact(10.0);
        assert!((flat.area - 1e-6).abs() < 1e-18 && flat.covers([1.0, 1.0]));
    }
}
