//! Friction of the surface that is there: its bare layer, the oxygen and the debris on it.
//!
//! ```text
//! mu_0 = starved + (mu_layer - starved) s,   mu = mu_bed + (mu_0 - mu_bed) exp(-h/h_ref)
//! ```
//!
//! s is the aerated share, h the debris per area. The coefficient is constant within a cycle.

use contact_core::scene::{BedFriction, Body, Dependence, Scene};

use super::law::layer_at;
use super::mixed_cells::FrictionOfCells;
use super::settings::thicknesses;

/// Friction that depends on what wear exposes.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceFriction {
    /// Coefficient of each layer; one for all layers otherwise.
    layers: Vec<f64>,
    /// The body that these layers belong to.
    pub(crate) body: usize,
    /// Thicknesses of its coatings \[m\].
    coatings: Vec<f64>,
    starved: Option<f64>,
    bed: Option<BedFriction>,
}

impl SurfaceFriction {
    /// The friction of a scene; `None` where it does not depend on the exposed surface.
    pub(crate) fn new(scene: &Scene) -> Option<Self> {
        let friction = &scene.friction;
        friction.depends_on(Dependence::Surface).then(|| {
            let coated = |body: &Body| !body.coatings.is_empty();
            let body = usize::from(!coated(&scene.body1));
            let layers = if friction.layers.is_empty() {
                vec![friction.mu]
            } else {
                friction.layers.clone()
            };
            Self {
                layers,
                body,
                coatings: thicknesses([&scene.body1, &scene.body2][body]),
                starved: friction.starved,
                bed: friction.bed,
            }
        })
    }

    /// Whether the coefficient depends on the layer.
    pub(crate) fn has_layers(&self) -> bool {
        self.layers.len() > 1
    }

    /// Whether the coefficient depends on the aerated share.
    pub(crate) fn depends_on_air(&self) -> bool {
        self.starved.is_some()
    }

    /// The layer that is bare at a worn depth of its body \[m\].
    pub(crate) fn layer(&self, worn: f64) -> usize {
        layer_at(worn, &self.coatings)
    }

    /// The coefficient of a layer in air, without debris.
    pub(crate) fn mu_of_layer(&self, layer: usize) -> f64 {
        self.layers[layer.min(self.layers.len() - 1)]
    }

    /// The coefficient of cell c, from the one of its bare layer, with the factors of oxygen and debris; empty
    /// fields leave a factor out.
    pub(crate) fn combine(&self, of_layer: f64, c: usize, aerated: &[f64], bed: &[f64]) -> f64 {
        let mut mu = of_layer;
        if let (Some(starved), Some(s)) = (self.starved, aerated.get(c)) {
            mu = starved + (mu - starved) * s;
        }
        match (self.bed, bed.get(c)) {
            (Some(friction), Some(h)) => friction.coefficient(mu, *h),
            _ => mu,
        }
    }

    /// Error of the mean coefficient of friction by the cells, over it: `ways` and `mu` of the cells of the body
    /// whose layers count, at worn depths \[m\].
    pub(crate) fn error(&self, rows: usize, ways: &[f64], mu: &[f64], worn: &[f64]) -> f64 {
        if !self.has_layers() {
            return 0.0;
        }
        let layer: Vec<usize> = worn.iter().map(|worn| self.layer(*worn)).collect();
        let cells = FrictionOfCells {
            rows,
            ways,
            mu,
            layer: &layer,
        };
        cells.error()
    }

    /// Coefficients of the bare layers at worn depths of their body \[m\].
    pub(crate) fn mu_of_layers(&self, worn: &[f64]) -> Vec<f64> {
        worn.iter()
            .map(|depth| self.mu_of_layer(self.layer(*depth)))
            .collect()
    }

    /// The coefficients of cells of the grid, on which the surfaces do not move, at the worn depths of the body
    /// \[m\].
    pub(crate) fn of_cells(&self, worn: &[f64], aerated: &[f64], bed: &[f64]) -> Vec<f64> {
        let mu = |(c, worn): (usize, &f64)| {
            self.combine(self.mu_of_layer(self.layer(*worn)), c, aerated, bed)
        };
        worn.iter().enumerate().map(mu).collect()
    }
}
