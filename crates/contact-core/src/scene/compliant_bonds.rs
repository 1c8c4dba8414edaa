//! Bonds so soft that the layers above them sink by more than the grid is long.
//!
//! A plate of the bending stiffness D on springs of the compliance c \[m/Pa\] gives way under a point
//! load W by (H. Hertz, Wiedemanns Ann. Phys. Chem. 22 (1884) 449-455; S. Timoshenko, S.
//! Woinowsky-Krieger, Theory of Plates and Shells (1959), art. 57 and, of a line load, M. Hetenyi,
//! Beams on Elastic Foundation (1946), eq. 6a)
//!
//! ```text
//! w = (W/8) sqrt(c/D)                       point load
//! w = (W'/2) c (4 c D)^(-1/4)               line load W' per length
//! ```
//!
//! With the largest D that the layers can have, E h^3/(12 (1 - nu^2)) of the stiffest one and nu = 1/2,
//! this is less than the bodies approach, whatever the substrate adds. Where the approach is given the
//! plate bends over about its length
//!
//! ```text
//! l = (c D)^(1/4),
//! ```
//!
//! and the part of it beyond the grid does not resist.

use super::{Body, Prescribed, RigidMotion, Scene};
use crate::error::Error;

/// 12 (1 - nu^2) at nu = 1/2.
const BENDING: f64 = 9.0;

impl Scene {
    /// Fails where the load of the path makes a bond alone give way by more than the length of the
    /// grid, or where a given approach bends the layers above a bond over more than that.
    pub(super) fn check_bonds(&self) -> Result<(), Error> {
        let W = self.path.W_max();
        let prescribes_approach = |branch: &super::Branch| {
            matches!(
                branch.to.prescribed(RigidMotion::DeltaZ),
                Prescribed::Motion(_)
            )
        };
        let approach_is_given = self.path.branches.iter().any(prescribes_approach);
        for (key, body) in [("body1", &self.body1), ("body2", &self.body2)] {
            for (layer, c) in (0..body.coatings.len()).map(|n| (n, body.bond(n).normal)) {
                let (most, D) = (self.grid.extent().0, bending_stiffness(body, layer));
                let bending_length = (c * D).powf(0.25);
                if approach_is_given && bending_length > most {
                    return Err(Error::invalid(
                        format!("{key}.coatings[{layer}].bond_normal"),
                        c,
                        format!(
                            "at most {:.1e} m/Pa where delta_z is given. This bond lets the layers above it bend over \
                             {bending_length:.1e} m, more than the length of the grid, {most:.1e} m",
                            most.powi(4) / D
                        ),
                    ));
                }
                let approach = self.least_approach(W, c, D);
                if c > 0.0 && approach > most {
                    // w grows with c^(1/2), of a line load with c^(3/4).
                    let power = if self.grid.plane_strain {
                        4.0 / 3.0
                    } else {
                        2.0
                    };
                    let softest = c * (most / approach).powf(power);
                    return Err(Error::invalid(
                        format!("{key}.coatings[{layer}].bond_normal"),
                        c,
                        format!(
                            "at most {softest:.1e} m/Pa: under W = {W:.3e} {} this bond alone gives way by {approach:.1e} m, \
                             more than the length of the grid, {most:.1e} m",
                            self.grid.unit_of("N")
                        ),
                    ));
                }
            }
        }
        Ok(())
    }

    /// Least approach under a load W by a bond of the compliance `c` below layers of the bending
    /// stiffness `D` \[m\].
    fn least_approach(&self, W: f64, c: f64, D: f64) -> f64 {
        if self.grid.plane_strain {
            0.5 * (W / self.grid.dy) * c * (4.0 * c * D).powf(-0.25)
        } else {
            0.125 * W * (c / D).sqrt()
        }
    }
}

/// Upper bound of the bending stiffness of the layers above the bond `n` \[N m\].
fn bending_stiffness(body: &Body, n: usize) -> f64 {
    let above = &body.coatings[..=n];
    let height: f64 = above.iter().map(|layer| layer.thickness).sum();
    let stiffest = above
        .iter()
        .map(|layer| layer.material.E)
        .fold(0.0, f64::max);
    stiffest * height.powi(3) / BENDING
}

#[cfg(test)]
mod tests {
    use crate::Scene;

    /// A sphere of steel on a coated flat with a bond of a compliance; W = 100 N, 0.56 mm of grid.
    fn refusal(bond: f64) -> Option<String> {
        refusal_under("W = 100.0", bond)
    }

    fn refusal_under(drive: &str, bond: f64) -> Option<String> {
        let text = format!(
            "schema = 1\nbody1 = {{ shape.sphere.R = 0.01, E = 210e9, nu = 0.3 }}\nfriction.mu = 0.3\n\
             grid = {{ n = 48, extent = 5.6e-4 }}\npath = [{{ {drive}, increments = 2 }}]\n\
             [body2]\nshape = \"flat\"\nE = 210e9\nnu = 0.3\n\
             [[body2.coatings]]\nE = 300e9\nnu = 0.25\nthickness = 4.7e-5\nbond_normal = {bond:e}\n"
        );
        let scene = Scene::from_toml_str(&text, "bond", &[]);
        let checked = scene.and_then(|scene| scene.check());
        checked.err().map(|error| error.to_string())
    }

    #[test]
    fn under_a_given_approach_the_layers_bend_on_the_grid() {
        for bond in [0.0, 1e-15, 1e-13, 1e-11] {
            assert_eq!(refusal_under("delta_z = 2e-6", bond), None, "{bond:e}");
        }
        for bond in [1e-10, 1e-6, 1e12] {
            let message = refusal_under("delta_z = 2e-6", bond).expect("a refusal");
            assert!(
                message.contains("body2.coatings[0].bond_normal"),
                "{message}"
            );
            assert!(message.contains("where delta_z is given"), "{message}");
            let bound = message.split("at most ").nth(1).expect("a bound");
            let bound: f64 = bound.split(' ').next().unwrap().parse().unwrap();
            assert_eq!(
                refusal_under("delta_z = 2e-6", 0.9 * bound),
                None,
                "{message}"
            );
        }
    }

    #[test]
    fn a_bond_that_sinks_beyond_the_grid_is_refused_by_its_name() {
        for bond in [0.0, 1e-17, 1e-14, 1e-13] {
            assert_eq!(refusal(bond), None, "{bond:e}");
        }
        for bond in [1e-11, 1e-8, 1e4, 1e18] {
            let message = refusal(bond).expect("a refusal");
            assert!(
                message.contains("body2.coatings[0].bond_normal"),
                "{message}"
            );
            // The bound that it names is allowed.
            let bound = message.split("at most ").nth(1).expect("a bound");
            let bound: f64 = bound.split(' ').next().unwrap().parse().unwrap();
            assert_eq!(refusal(0.9 * bound), None, "{message}");
            assert!(refusal(1.2 * bound).is_some(), "{message}");
        }
    }
}
