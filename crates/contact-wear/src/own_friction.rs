//! A user's friction law in gross slip.
//!
//! The cells of the grid lie on one body, the other one slides over them. At each place of the stroke the law
//! gets the pressure there and the worn depths that meet there. Distance slipped and energy belong to the body
//! of the grid. The coefficient is constant within a cycle, and belongs to the surfaces at the start of a jump.

use contact_core::Error;
use contact_core::scene::{CellHistory, Scene, UserFriction};

use super::law::layer_at;
use super::loss::Worn;
use super::mixed_cells::FrictionOfCells;
use super::pressing::Pressing;
use super::settings::thicknesses;

/// A user's law with the cells that it is evaluated in.
pub(crate) struct OwnFriction {
    law: UserFriction,
    /// The coefficient where nothing is pressed.
    nominal: f64,
    /// Centres of the cells \[m\].
    centres: [Vec<f64>; 2],
    /// Thicknesses of the coatings \[m\].
    coatings: [Vec<f64>; 2],
    /// The body that the grid lies on.
    pub(crate) body: usize,
}

impl OwnFriction {
    /// The law of a scene; `None` without one.
    pub(crate) fn new(scene: &Scene, pressing: &Pressing, body: usize) -> Option<Self> {
        let (grid, mirror) = (&pressing.grid, pressing.mirror);
        Some(Self {
            law: scene.friction.law.clone()?,
            nominal: scene.friction.mu,
            centres: [
                mirror.fold(&grid.map(|x, _| x)),
                mirror.fold(&grid.map(|_, y| y)),
            ],
            coatings: [thicknesses(&scene.body1), thicknesses(&scene.body2)],
            body,
        })
    }

    /// Coefficients under the pressure p where these `depths` of both bodies meet.
    pub(crate) fn coefficients(
        &self,
        p: &[f64],
        depths: &[Vec<f64>; 2],
        worn: &Worn,
        (bed, aerated): (&[f64], &[f64]),
    ) -> Result<Vec<f64>, Error> {
        let field_or = |field: &[f64], value: f64| {
            if field.is_empty() {
                vec![value; p.len()]
            } else {
                field.to_vec()
            }
        };
        let layer = [0, 1].map(|b| {
            self.layers(b, &depths[b])
                .map(|layer| layer as f64)
                .collect()
        });
        let [layer1, layer2]: &[Vec<f64>; 2] = &layer;
        let cells = CellHistory {
            x: &self.centres[0],
            y: &self.centres[1],
            p,
            slip: &worn.slid,
            dissipated: &worn.energy[self.body],
            worn: [&depths[0], &depths[1]],
            layer: [layer1, layer2],
            bed: &field_or(bed, 0.0),
            aerated: &field_or(aerated, 1.0),
        };
        let mut mu = vec![self.nominal; p.len()];
        self.law.coefficients(&cells, self.nominal, &mut mu)?;
        Ok(mu)
    }

    /// Error of the mean coefficient by the borders of layers and contact, over it.
    pub(crate) fn error(&self, rows: usize, p: &[f64], mu: &[f64], depths: &[Vec<f64>; 2]) -> f64 {
        let count = self.coatings[1].len() + 1;
        let pairs = self.layers(0, &depths[0]).zip(self.layers(1, &depths[1]));
        let layer: Vec<usize> = pairs
            .map(|(first, second)| first * count + second)
            .collect();
        let cells = FrictionOfCells {
            rows,
            ways: p,
            mu,
            layer: &layer,
        };
        cells.error()
    }

    /// The layer of body b that is bare at each depth \[m\].
    fn layers(&self, b: usize, depths: &[f64]) -> impl Iterator<Item = usize> {
        depths
            .iter()
            .map(move |depth| layer_at(*depth, &self.coatings[b]))
    }
}
