//! Oxygen and debris in the jumps of a stroke.

use contact_core::Error;

use super::{JumpEnd, Sliding};
use crate::fixed_point::{FixedPoint, MOST_EVALUATIONS, Step};
use crate::loss::{Loss, Worn};
use crate::surface_friction::SurfaceFriction;
use crate::third_body::{AGREES_IN_JUMP, Meeting, ThirdBody, ThirdFields};

/// Evaluations of the oxygen under friction that depends on it.
const AERATIONS: usize = 8;

/// The contact that the third body meets.
struct Contact {
    gap: Vec<f64>,
    p: Vec<f64>,
    dissipated: Vec<f64>,
    slip: Vec<f64>,
}

impl Contact {
    /// The fields that the third body needs, by reference.
    fn meeting(&self) -> Meeting<'_> {
        Meeting {
            gap: &self.gap,
            p: &self.p,
            dissipated: &self.dissipated,
            slip: &self.slip,
        }
    }
}

impl Sliding {
    /// Computes oxygen, debris and the coefficients of friction for the present pressures.
    pub(super) fn aerate(&mut self, worn: &Worn) -> Result<(), Error> {
        self.present = ThirdFields::default();
        if let Some(third_body) = self.third_body.take() {
            let present = self.find_present(&third_body, worn);
            self.third_body = Some(third_body);
            self.present = present?;
        }
        self.settle_friction(worn)
    }

    /// Oxygen and debris of the present contact. Friction that depends on the oxygen heats the contact that
    /// consumes it: they are computed by turns.
    fn find_present(&mut self, third_body: &ThirdBody, worn: &Worn) -> Result<ThirdFields, Error> {
        self.lay_bed(&worn.bed);
        let surface = self.surface.as_ref();
        let coupled = surface.is_some_and(SurfaceFriction::depends_on_air) || self.law.is_some();
        let mut fields = ThirdFields::default();
        for _ in 0..if coupled { AERATIONS } else { 1 } {
            let contact = self.meet(worn, &fields.aerated)?;
            fields = third_body.begin(worn, &contact.meeting())?;
        }
        Ok(fields)
    }

    /// Aerated share of the settled contact; empty without a model of the air.
    pub(crate) fn aerated(&self) -> &[f64] {
        &self.present.aerated
    }

    /// The end of the last jump.
    pub(crate) fn take_end(&mut self) -> Option<JumpEnd> {
        self.end.take()
    }

    /// Starts the iterations of the next jump a `part` of the way to the end of a longer one.
    pub(crate) fn start_towards(&mut self, end: &JumpEnd, part: f64) {
        for (p, end) in self.p.iter_mut().zip(&end.p) {
            p.iter_mut()
                .zip(end)
                .for_each(|(p, end)| *p += part * (end - *p));
        }
        self.guess = Some(self.present.towards(&end.fields, part));
    }

    /// The loss of both bodies in n cycles with oxygen and debris, which follow from the contact at the end of
    /// the jump.
    pub(super) fn jump_with_third_body(
        &mut self,
        third_body: &ThirdBody,
        worn: &Worn,
        n: f64,
        implicit: bool,
    ) -> Result<Loss, Error> {
        self.pressing.begin();
        let mut fields = self.guess.take().unwrap_or_else(|| self.present.clone());
        third_body.protect(&mut fields);
        let mut fixed_point = FixedPoint::default();
        for _ in 0..MOST_EVALUATIONS {
            self.lay_bed(&fields.bed);
            let rates = self.rates(worn, n, &fields)?;
            if implicit {
                self.iterate(worn, n, &rates, AGREES_IN_JUMP)?;
            }
            let loss = self.loss(n, &rates, &self.integrate(&self.p));
            let (supply, lost) = self.supply(third_body, worn, &loss, &rates.aerated);
            let contact = if implicit {
                let mut end = worn.clone();
                end.add(&loss);
                self.meet(&end, &fields.aerated)?
            } else {
                self.meet(worn, &fields.aerated)?
            };
            let jump = (n, &supply[..], lost);
            let image = third_body.respond(worn, &contact.meeting(), jump, &fields)?;
            let step = fixed_point.advance((third_body, implicit), (worn, loss), &fields, image);
            let (mut loss, image) = match step {
                Step::Settled(loss, image) => (loss, image),
                Step::Next(next) => {
                    fields = next;
                    continue;
                }
            };
            loss.debris = third_body.debris(worn, &contact.slip, jump, &image)?;
            self.end = implicit.then(|| JumpEnd {
                p: self.p.clone(),
                fields: image,
            });
            return Ok(loss);
        }
        Err(fixed_point.not_converged())
    }

    /// Lays the bed of debris \[m\] into the gap, if the run has one.
    pub(super) fn lay_bed(&mut self, bed: &[f64]) {
        if self.wear.bed.is_some() {
            self.bed.clear();
            self.bed.extend_from_slice(bed);
        }
    }

    /// Gap, pressure, dissipated energy and slip under the present pressures, from which oxygen and debris
    /// follow; `aerated` is the aerated share so far.
    fn meet(&mut self, worn: &Worn, aerated: &[f64]) -> Result<Contact, Error> {
        let (cells, s) = (self.pressing.cells(), self.slip_distance());
        let mut contact = Contact {
            gap: vec![0.0; cells],
            p: vec![0.0; cells],
            dissipated: Vec::new(),
            slip: vec![s; cells],
        };
        let mut h = vec![0.0; cells];
        for i in 0..self.places.len() {
            self.gap(worn, i, &mut h);
            let weight = self.places[i].slip / s;
            let gap = self.pressing.loaded_gap(&h, &self.p[i]);
            for c in 0..cells {
                contact.gap[c] += weight * gap[c];
                contact.p[c] += weight * self.p[i][c];
            }
        }
        let fields = ThirdFields::present(aerated, &self.bed);
        if let Some(dissipated) = self.energy_of_law(worn, &fields)? {
            contact.dissipated = dissipated;
            return Ok(contact);
        }
        contact.dissipated = contact.p.iter().map(|p| self.mu() * s * p).collect();
        if let Some(surface) = &self.surface {
            let of_layers = surface.mu_of_layers(&worn.depth[surface.body]);
            let mut mu = vec![0.0; cells];
            let mut at_place = vec![0.0; cells];
            for i in 0..self.places.len() {
                at_place.fill(0.0);
                let shift = &self.shifts[i][surface.body];
                shift.read(&of_layers, self.pressing.rows(), &mut at_place);
                let weight = self.places[i].slip / s;
                mu.iter_mut()
                    .zip(&at_place)
                    .for_each(|(mu, f)| *mu += weight * f);
            }
            for c in 0..cells {
                let mu = surface.combine(mu[c], c, aerated, &self.bed);
                contact.dissipated[c] *= mu / self.mu;
            }
        }
        Ok(contact)
    }

    /// The fresh debris of a loss in the cells of the grid, spread over the stroke \[m\], and the sum of what
    /// leaves the contact at once. `aerated` are the aerated shares in the coordinates of both bodies.
    fn supply(
        &self,
        third_body: &ThirdBody,
        worn: &Worn,
        loss: &Loss,
        aerated: &[Vec<f64>; 2],
    ) -> (Vec<f64>, f64) {
        let mut supply = vec![0.0; self.pressing.cells()];
        let (mut lost, s) = (0.0, self.slip_distance());
        for b in 0..2 {
            let yields = |c: usize| {
                let starved = aerated[b].get(c).map_or(0.0, |s| {
                    self.wear.bodies[b].starved_part(worn.depth[b][c], &self.coatings[b], *s)
                });
                third_body.yields(starved)
            };
            let cells = loss.depth[b].iter().enumerate();
            let [fresh, at_once]: [Vec<f64>; 2] =
                [0, 1].map(|k| cells.clone().map(|(c, w)| w * yields(c)[k]).collect());
            lost += at_once.iter().sum::<f64>();
            for (i, place) in self.places.iter().enumerate() {
                let weighted: Vec<f64> = fresh.iter().map(|w| w * place.slip / s).collect();
                self.shifts[i][b].read(&weighted, self.pressing.rows(), &mut supply);
            }
        }
        (supply, lost)
    }

    /// A field of the grid in the coordinates of each body: for each cell the mean over all that passes it,
    /// weighted with the pressure; `outside` where nothing passes.
    pub(super) fn carry(&self, field: &[f64], outside: f64) -> [Vec<f64>; 2] {
        if field.is_empty() {
            return [vec![], vec![]];
        }
        let largest = self.p.iter().flatten().fold(0.0, |m: f64, p| m.max(*p));
        let least = 1e-9 * largest + f64::MIN_POSITIVE;
        let weights: Vec<Vec<f64>> = self
            .p
            .iter()
            .map(|p| p.iter().map(|p| p + least).collect())
            .collect();
        let products: Vec<Vec<f64>> = weights
            .iter()
            .map(|p| p.iter().zip(field).map(|(p, f)| p * f).collect())
            .collect();
        let (sums, weights) = (self.integrate(&products), self.integrate(&weights));
        [0, 1].map(|b| {
            let cells = sums[b].iter().zip(&weights[b]);
            let mean =
                |(sum, weight): (&f64, &f64)| if *weight > 0.0 { sum / weight } else { outside };
            cells.map(mean).collect()
        })
    }
}
