//! Heathcote slip: bodies that roll in a groove, whose common surface is curved across the rolling direction.
//!
//! At the distance y from the middle of a contact whose common surface has the curvature k across the rolling
//! direction x, the rolling radii of both bodies differ by k y^2/2 from those in the middle. The creep of
//! the surfaces changes by `k y^2/2 (1/R_1 + 1/R_2)` (K. L. Johnson, Contact Mechanics (1985), section 8.5). Full
//! slip of a flat contact of the half-width a takes the creep `mu a (1/R_1 + 1/R_2)` (section 8.3).

use super::Scene;
use crate::hertz::hertz_ellipse;

/// Creep at the edge of the contact over the creep of full slip of a doubt.
const CURVED: f64 = 0.2;

impl Scene {
    /// Creep at the edge by the curvature of the common surface, over the creep of full slip; 0 without
    /// rolling or curvature.
    fn heathcote_ratio(&self) -> Option<f64> {
        let rolls = self.path.branches.iter().any(|b| b.to.rolled != 0.0);
        let mu = self.friction.mu;
        if !rolls || self.grid.plane_strain || !(mu > 0.0 && mu.is_finite()) {
            return None;
        }
        let hertz = self.hertz()?;
        // Bodies of one modulus meet halfway between their surfaces.
        let k = 0.5 * (self.body1.shape.curvature()[2] - self.body2.shape.curvature()[2]).abs();
        let (steep, shallow) = self.principal_curvatures();
        if shallow <= 1e-9 * steep {
            return None;
        }
        let ellipse = hertz_ellipse(1.0 / shallow, 1.0 / steep, 1.0, 1.0);
        let size = hertz.a / (ellipse.a_x * ellipse.a_y).sqrt();
        let [cos, sin] = self.steepest_direction();
        let (long, short) = (size * ellipse.a_x, size * ellipse.a_y);
        let [along, across] = [
            (short * cos).hypot(long * sin),
            (short * sin).hypot(long * cos),
        ];
        Some(0.5 * k * across * across / (mu * along))
    }

    /// Doubts rolling whose slip depends on the curvature of the common surface, which is taken as flat.
    pub(super) fn doubt_of_heathcote_slip(&self) -> Option<String> {
        let ratio = self.heathcote_ratio().filter(|ratio| *ratio > CURVED)?;
        Some(format!(
            "the bodies roll in a groove, and their common surface is curved. Its edges slip by {ratio:.2} of the creep of \
             full slip (Heathcote). The contact is taken as flat, without this slip"
        ))
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{
        Body, Elastic, Friction, Grid, LoadPath, Prescribed, RigidMotion, Scene, Settings, Shape,
    };

    /// A ball that rolls on a track of a radius across \[m\]; infinite: a flat.
    fn ball_on_track(across: f64) -> Scene {
        let steel = Elastic { E: 207e9, nu: 0.3 };
        let R = 6.35e-3;
        let track = Shape::Cylinder {
            R: across,
            length: f64::INFINITY,
            angle: std::f64::consts::FRAC_PI_2,
        };
        let press = |to: &mut crate::scene::Loads| {
            to.prescribe(RigidMotion::DeltaZ, Prescribed::Load(200.0));
            to.rolled = 1e-4;
        };
        Scene {
            body1: Body::homogeneous(steel, Shape::sphere(R)),
            body2: Body::homogeneous(steel, track),
            friction: Friction::coulomb(0.1),
            grid: Grid::centred(2e-3, 64).expect("a grid"),
            path: LoadPath::start().change_to(press, 1),
            settings: Settings::default(),
            title: String::new(),
        }
    }

    #[test]
    fn a_groove_is_doubted_and_a_flat_is_not() {
        let groove = ball_on_track(-0.52 * 2.0 * 6.35e-3);
        assert!(groove.heathcote_ratio().expect("a ratio") > 0.3);
        assert!(
            groove
                .doubt_of_heathcote_slip()
                .expect("a doubt")
                .contains("Heathcote")
        );
        assert_eq!(ball_on_track(1e6).doubt_of_heathcote_slip(), None);
    }
}
