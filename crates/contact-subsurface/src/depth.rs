//! Body, layer and depth.

use contact_core::Error;
use contact_core::kernels::{Stack, check_not_rigid};
use contact_core::scene::{Body, Scene};

/// A depth and the layer in which the stress is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Depth {
    /// Depth below the surface of the body \[m\].
    pub z: f64,
    /// Layer from the surface down; their number for the substrate.
    pub layer: usize,
}

/// A point: x, y \[m\] and the depth.
pub type Point = (f64, f64, Depth);

/// One of the two bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Side {
    /// The upper body: depth is counted upwards.
    Body1,
    /// The lower body, on which q_x and q_y act.
    #[default]
    Body2,
}

impl Side {
    /// The body of a scene.
    pub fn body(self, scene: &Scene) -> &Body {
        match self {
            Self::Body1 => &scene.body1,
            Self::Body2 => &scene.body2,
        }
    }

    /// Sign of the shear on the body, and of components with one index z, in the body's own frame
    /// (z into the body).
    pub(super) fn sign(self) -> f64 {
        match self {
            Self::Body1 => -1.0,
            Self::Body2 => 1.0,
        }
    }
}

/// Returns the depths `z` \[m\] with their layers; on an interface both, the upper one first.
pub fn depths(body: &Body, z: &[f64]) -> Result<Vec<Depth>, Error> {
    body.check_alone()?;
    let stack = Stack::new(body);
    let mut depths_and_layers = Vec::with_capacity(z.len());
    for &z in z {
        let upper = stack.locate_depth(z, None)?.layer;
        check_not_rigid(body, upper)?;
        depths_and_layers.push(Depth { z, layer: upper });
        let lower = upper + 1;
        if stack.locate_depth(z, Some(lower)).is_ok() && check_not_rigid(body, lower).is_ok() {
            depths_and_layers.push(Depth { z, layer: lower });
        }
    }
    Ok(depths_and_layers)
}

/// Distance of neighbouring chosen depths over their depth.
const STEP: f64 = 0.1;
/// Depth below which the distance no longer falls, over the radius of the contact.
const SHALLOW: f64 = 0.02;
/// Fewest steps across a layer.
const MIN_LAYER_STEPS: f64 = 4.0;

/// Default depths for stresses, with both sides of every interface: from the surface to the depth
/// `deepest` \[m\] under a contact of the radius `a` \[m\]. There are `finer` times as many as by
/// default, 1.
///
/// The stress under tractions on the surface varies along z over lengths of the order of z:
/// neighbours are a tenth of their depth apart, near the surface a five-hundredth of `a`; a layer
/// has five depths at least, its borders included.
pub fn default_depths(body: &Body, a: f64, deepest: f64, finer: f64) -> Result<Vec<Depth>, Error> {
    if !(deepest > 0.0 && deepest.is_finite()) {
        return Err(Error::invalid("depth", deepest, "a positive length in m"));
    }
    let shallow = SHALLOW * a;
    let mut z = vec![0.0];
    let borders = body.interfaces().into_iter().filter(|b| *b < deepest);
    for bottom in borders.chain([deepest]) {
        let top = z[z.len() - 1];
        let range = ((bottom + shallow) / (top + shallow)).ln();
        let steps = (finer * (range / STEP).max(MIN_LAYER_STEPS)).ceil();
        // Even in the logarithm.
        let inside = (1..steps as usize).map(|i| {
            let at = (range * i as f64 / steps).exp() * (top + shallow) - shallow;
            at.clamp(top, bottom)
        });
        z.extend(inside);
        z.push(bottom);
    }
    depths(body, &z)
}

/// Marks every other depth of each layer, and its first and last.
pub(super) fn coarser_depths(depths: &[Depth]) -> Vec<bool> {
    let layers = depths.chunk_by(|a, b| a.layer == b.layer);
    let kept = layers.flat_map(|of| (0..of.len()).map(|n| n % 2 == 0 || n + 1 == of.len()));
    kept.collect()
}

/// Marks the `depths` that lie on an interface: the same depth in two layers, one after the other.
pub(super) fn interface_mask(depths: &[Depth]) -> Vec<bool> {
    let same = |a: usize, b: usize| {
        depths
            .get(a)
            .zip(depths.get(b))
            .is_some_and(|(a, b)| a.z == b.z && a.layer != b.layer)
    };
    let is_on_interface = |n: usize| same(n, n + 1) || (n > 0 && same(n - 1, n));
    (0..depths.len()).map(is_on_interface).collect()
}

#[cfg(test)]
mod tests {
    use super::{default_depths, interface_mask};
    use contact_core::scene::{Body, Coating, Elastic, Shape};

    #[test]
    fn every_layer_has_its_depths_and_both_sides_of_its_borders() {
        let material = Elastic { E: 2e11, nu: 0.3 };
        let coatings = [3e-6, 2e-7, 4e-5].map(|thickness| Coating {
            material,
            thickness,
        });
        let body = Body {
            coatings: coatings.to_vec(),
            ..Body::homogeneous(material, Shape::Flat)
        };
        let (a, deepest) = (8e-5, 1.6e-4);
        let depths = default_depths(&body, a, deepest, 1.0).expect("depths");
        let of_layer = |n| depths.iter().filter(move |d| d.layer == n).map(|d| d.z);
        for layer in 0..4 {
            assert!(of_layer(layer).count() >= 5, "layer {layer}: {depths:?}");
        }
        for (n, z) in body.interfaces().into_iter().enumerate() {
            assert_eq!(of_layer(n).next_back(), Some(z));
            assert_eq!(of_layer(n + 1).next(), Some(z));
        }
        assert!(depths[0].z == 0.0 && depths.last().is_some_and(|d| d.z == deepest));
        assert!(depths.windows(2).all(|d| d[0].z <= d[1].z) && depths.len() < 80);
        assert_eq!(interface_mask(&depths).iter().filter(|on| **on).count(), 6);
        // Interfaces below the deepest depth are left out.
        let shallow = default_depths(&body, a, 1e-6, 1.0).expect("depths");
        assert!(shallow.iter().all(|d| d.layer == 0));
        assert!(default_depths(&body, a, 0.0, 1.0).is_err());
    }
}
