//! Friction of a stroke: of the layers that wear exposes, of oxygen and debris, and of a law of the user.

use contact_core::Error;

use super::Sliding;
use crate::course::LayerFactor;
use crate::loss::Worn;
use crate::surface_friction::SurfaceFriction;
use crate::third_body::ThirdFields;

impl Sliding {
    /// Coefficients of friction of the cells of body b, before their dependence on cycles.
    fn mu_of_body(
        &self,
        surface: &SurfaceFriction,
        b: usize,
        worn: &Worn,
        fields: &ThirdFields,
    ) -> Vec<f64> {
        let aerated = &self.carry(&fields.aerated, 1.0)[b];
        let bed = &self.carry(&fields.bed, 0.0)[b];
        let of_layers = surface.mu_of_layers(&worn.depth[surface.body]);
        let of_layers = if b == surface.body || !surface.has_layers() {
            of_layers
        } else {
            self.carry_across(&of_layers, surface.body)
        };
        let cells = of_layers.iter().enumerate();
        cells
            .map(|(c, mu)| surface.combine(*mu, c, aerated, bed))
            .collect()
    }

    /// A field of body `from` in the coordinates of the other body: for each cell the mean over all cells that
    /// pass it, weighted with the pressure.
    fn carry_across(&self, field: &[f64], from: usize) -> Vec<f64> {
        let largest = self.p.iter().flatten().fold(0.0, |m: f64, p| m.max(*p));
        let least = 1e-9 * largest + f64::MIN_POSITIVE;
        let (rows, to) = (self.pressing.rows(), 1 - from);
        let mut sums = [0, 1].map(|_| vec![0.0; field.len()]);
        for (i, place) in self.places.iter().enumerate() {
            let mut at_place = vec![0.0; field.len()];
            self.shifts[i][from].read(field, rows, &mut at_place);
            let weight: Vec<f64> = self.p[i].iter().map(|p| p + least).collect();
            let product: Vec<f64> = weight.iter().zip(&at_place).map(|(w, f)| w * f).collect();
            self.shifts[i][to].put(&product, place.slip, rows, &mut sums[0]);
            self.shifts[i][to].put(&weight, place.slip, rows, &mut sums[1]);
        }
        let mean = |(c, (sum, weight)): (usize, (&f64, &f64))| {
            if *weight > 0.0 {
                sum / weight
            } else {
                field[c]
            }
        };
        let cells = sums[0].iter().zip(&sums[1]).enumerate();
        cells.map(mean).collect()
    }

    /// The coefficients of friction of body b in a jump: at its start for the body whose layers count,
    /// for the other one those that the first body has on average in the jump.
    pub(super) fn mu_in_jump(
        &self,
        b: usize,
        worn: &Worn,
        fields: &ThirdFields,
        known: &[Vec<f64>; 2],
    ) -> Option<Vec<f64>> {
        let surface = self.surface.as_ref()?;
        if b != surface.body && surface.has_layers() {
            return Some(self.carry_across(&known[surface.body], surface.body));
        }
        let factor = self.mu() / self.mu;
        let mut mu = self.mu_of_body(surface, b, worn, fields);
        for mu in &mut mu {
            *mu *= factor;
        }
        Some(mu)
    }

    /// Factor of the energy of a cell by its layer, for the body whose layers count.
    pub(super) fn layer_factor<'a>(
        &'a self,
        b: usize,
        worn: &'a Worn,
        (aerated, bed): (&'a [f64], &'a [f64]),
    ) -> Option<Box<LayerFactor<'a>>> {
        let surface = self.surface.as_ref();
        let surface = surface.filter(|s| s.body == b && s.has_layers())?;
        let mu = move |c: usize, layer: usize| {
            surface.combine(surface.mu_of_layer(layer), c, aerated, bed)
        };
        Some(Box::new(move |c, layer| {
            mu(c, layer) / mu(c, surface.layer(worn.depth[b][c]))
        }))
    }

    /// Coefficients of a user's law in the cells of the grid at every place; `None` without one.
    fn mu_at_places(
        &self,
        worn: &Worn,
        fields: &ThirdFields,
    ) -> Result<Option<Vec<Vec<f64>>>, Error> {
        let Some(law) = &self.law else {
            return Ok(None);
        };
        let (cells, rows) = (self.pressing.cells(), self.pressing.rows());
        let at_place = |i: usize| {
            let depths = [0, 1].map(|b| {
                let mut depth = vec![0.0; cells];
                self.shifts[i][b].read(&worn.depth[b], rows, &mut depth);
                depth
            });
            law.coefficients(&self.p[i], &depths, worn, (&fields.bed, &fields.aerated))
        };
        (0..self.places.len())
            .map(at_place)
            .collect::<Result<_, _>>()
            .map(Some)
    }

    /// Mean coefficients of a user's law over a cycle in the coordinates of both bodies, weighted with the
    /// pressure, whose integrals over the slip are `ways`; `None` without such a law.
    pub(super) fn mu_of_law(
        &self,
        worn: &Worn,
        fields: &ThirdFields,
        ways: &[Vec<f64>; 2],
    ) -> Result<Option<[Vec<f64>; 2]>, Error> {
        let Some(mu) = self.mu_at_places(worn, fields)? else {
            return Ok(None);
        };
        let dissipated = self.integrate(&self.shears(&mu));
        Ok(Some([0, 1].map(|b| {
            let cells = dissipated[b].iter().zip(&ways[b]);
            let mean =
                |(energy, way): (&f64, &f64)| if *way > 0.0 { energy / way } else { self.mu };
            cells.map(mean).collect()
        })))
    }

    /// The shear mu p at every place \[Pa\].
    fn shears(&self, mu: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let places = mu.iter().zip(&self.p);
        let shear =
            |(mu, p): (&Vec<f64>, &Vec<f64>)| mu.iter().zip(p).map(|(mu, p)| mu * p).collect();
        places.map(shear).collect()
    }

    /// Energy dissipated in the cells of the grid in a cycle \[J/m^2\] by a law of the user; `None` without one.
    pub(super) fn energy_of_law(
        &self,
        worn: &Worn,
        fields: &ThirdFields,
    ) -> Result<Option<Vec<f64>>, Error> {
        let Some(mu) = self.mu_at_places(worn, fields)? else {
            return Ok(None);
        };
        let mut energy = vec![0.0; self.pressing.cells()];
        for (shear, place) in self.shears(&mu).iter().zip(&self.places) {
            energy
                .iter_mut()
                .zip(shear)
                .for_each(|(energy, shear)| *energy += place.slip * shear);
        }
        Ok(Some(energy))
    }

    /// Computes the coefficients of friction of the settled contact, and the error of their mean by the cells.
    pub(super) fn settle_friction(&mut self, worn: &Worn) -> Result<(), Error> {
        let rows = self.pressing.rows();
        if let Some(mu) = self.mu_at_places(worn, &self.present)? {
            self.mu_of_places = mu;
            let (Some(law), middle) = (&self.law, self.middle()) else {
                return Ok(());
            };
            let depths = [0, 1].map(|b| {
                let mut depth = vec![0.0; self.pressing.cells()];
                self.shifts[middle][b].read(&worn.depth[b], rows, &mut depth);
                depth
            });
            self.mu_error = law.error(rows, &self.p[middle], &self.mu_of_places[middle], &depths);
            return Ok(());
        }
        let Some(surface) = &self.surface else {
            return Ok(());
        };
        self.mu_of_cells = self.mu_of_body(surface, surface.body, worn, &self.present);
        let ways = &self.integrate(&self.p)[surface.body];
        self.mu_error = surface.error(rows, ways, &self.mu_of_cells, &worn.depth[surface.body]);
        Ok(())
    }

    /// Energy dissipated in a cycle with the present pressures \[J\].
    pub(crate) fn dissipated_per_cycle(&self) -> f64 {
        if self.law.is_some() {
            return self.slid_friction() * self.pressing.cell_area();
        }
        if let Some(surface) = &self.surface {
            let ways = &self.integrate(&self.p)[surface.body];
            let products = ways.iter().zip(&self.mu_of_cells).map(|(way, mu)| way * mu);
            return products.sum::<f64>() * (self.mu() / self.mu) * self.pressing.cell_area();
        }
        self.mu() * self.slid_force() * self.pressing.cell_area()
    }

    /// Sum over places and cells of the shear by the user's law times the slip in a cycle \[Pa m\].
    fn slid_friction(&self) -> f64 {
        let shears = self.shears(&self.mu_of_places);
        let places = shears.iter().zip(&self.places);
        places
            .map(|(shear, place)| place.slip * shear.iter().sum::<f64>())
            .sum()
    }

    /// Mean coefficient of friction, weighted with the pressure.
    pub(crate) fn mean_mu(&self) -> f64 {
        if self.law.is_some() {
            let force = self.slid_force();
            return if force > 0.0 {
                self.slid_friction() / force
            } else {
                self.mu
            };
        }
        let Some(surface) = &self.surface else {
            return self.mu();
        };
        let ways = &self.integrate(&self.p)[surface.body];
        let sum: f64 = ways
            .iter()
            .zip(&self.mu_of_cells)
            .map(|(w, mu)| w * mu)
            .sum();
        let loading: f64 = ways.iter().sum();
        self.mu() / self.mu
            * if loading > 0.0 {
                sum / loading
            } else {
                self.mu
            }
    }

    /// Factor of the force in the corners of the stroke, whose coefficient is the one before any cycle.
    pub(crate) fn force_factor(&self) -> f64 {
        self.mean_mu() / self.mu
    }
}
