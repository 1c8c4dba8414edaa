//! The third body of a jump: the oxygen and the debris between the surfaces.
//!
//! Both depend on the contact at the end of the jump, and act back on it: the aerated share on the wear
//! coefficients, the bed on the gap. The jump is the fixed point of
//!
//! ```text
//! (s, h) -> p, w = n k(s, h) sigma p -> closed region, phi = mu sigma p f -> s, h = A^-1 (h_0 + e w),
//! ```
//!
//! p being solved with the whole spring n k sigma and the bed h as a known offset of the gap. Since
//! A^-1 does not amplify, the map contracts, for long jumps by the part of the debris that stays:
//! slowly. [`Anderson`](super::anderson::Anderson) removes the few slow modes. The bed belongs to the worn depth of the same
//! evaluation, so that mass is conserved whatever residual is left.

use contact_core::Error;
use debris::{
    Bed, Lattice, MASS_ACCURACY, NotConverged, Region, aerated_share, diffuse_air, spread_bed,
};

use super::air::Air;
use super::debris_bed::DebrisBed;
use super::loss::{Debris, Worn};
use super::pressing::Pressing;
use super::settings::{Jumps, Wear};

/// Change of the worn depth and the bed in an evaluation that ends the fixed point (root mean
/// squares): over the depth worn in the jump, or over the part of the worn depth that a jump may leave
/// as an error.
pub(crate) const AGREES_IN_JUMP: f64 = 3e-3;
const AGREES_IN_ALL: f64 = 0.05;
/// The part of the worn depth where jumps are given.
const USUAL: f64 = 0.01;

/// Part of the debris that the bed of an evaluation may lose. The last one is solved to [`MASS_ACCURACY`].
const ROUGH: f64 = 1e-5;

/// Oxygen and debris between the surfaces, in the cells of the grid.
pub(crate) struct ThirdBody {
    lattice: Lattice,
    air: Option<Air>,
    bed: Option<DebrisBed>,
    frequency: f64,
    closed_below: f64,
    /// Part of the worn depth that may be left as an error.
    may_leave: f64,
}

/// The contact that the third body meets, in the cells of the grid.
pub(crate) struct Meeting<'a> {
    /// Mean gap over the cycle \[m\].
    pub(crate) gap: &'a [f64],
    /// Mean pressure over the slip \[Pa\].
    pub(crate) p: &'a [f64],
    /// Energy dissipated per area and cycle \[J/m^2\].
    pub(crate) dissipated: &'a [f64],
    /// Slip distance in a cycle \[m\].
    pub(crate) slip: &'a [f64],
}

/// The unknowns of the fixed point.
#[derive(Clone, Debug, Default)]
pub(crate) struct ThirdFields {
    /// Aerated share; empty without a model of the air.
    pub(crate) aerated: Vec<f64>,
    /// Debris per area \[m\]; empty without a bed.
    pub(crate) bed: Vec<f64>,
    /// Factor of the wear coefficients by the bed; empty without protection.
    pub(crate) protection: Vec<f64>,
    /// Partial pressure of oxygen over the ambient one, a guess for the next.
    oxygen: Vec<f64>,
    /// Debris that has left in the jump, summed over the cells \[m\].
    ejected: f64,
    /// The closed region that the fields follow from.
    region: Option<Region>,
    /// Whether the next fields follow from the same region.
    pub(crate) holds_region: bool,
}

impl ThirdFields {
    /// The fields with the present oxygen and bed, before a jump.
    pub(crate) fn present(aerated: &[f64], bed: &[f64]) -> Self {
        Self {
            aerated: aerated.to_vec(),
            bed: bed.to_vec(),
            ..Self::default()
        }
    }

    /// The fields a `part` of the way from these to the fields at the `end` of a jump.
    pub(crate) fn towards(&self, end: &Self, part: f64) -> Self {
        let mix = |start: &[f64], end: &[f64]| -> Vec<f64> {
            let cells = start.iter().zip(end);
            cells
                .map(|(start, end)| start + part * (end - start))
                .collect()
        };
        Self {
            bed: mix(&self.bed, &end.bed),
            aerated: mix(&self.aerated, &end.aerated),
            oxygen: end.oxygen.clone(),
            ..Self::default()
        }
    }

    /// The debris at the end of a jump.
    fn to_debris(&self) -> Option<Debris> {
        (!self.bed.is_empty()).then(|| Debris {
            bed: self.bed.clone(),
            ejected: self.ejected,
        })
    }
}

impl ThirdBody {
    /// The third body of a run; `None` without air and bed.
    pub(crate) fn new(wear: &Wear, pressing: &Pressing) -> Option<Self> {
        if wear.air.is_none() && wear.bed.is_none() {
            return None;
        }
        let (grid, rows) = (&pressing.grid, pressing.rows());
        let lattice = Lattice {
            columns: grid.nx,
            rows,
            dx: grid.dx,
            dy: grid.dy,
            sealed: if grid.plane_strain {
                [true; 2]
            } else {
                [rows < grid.ny, false]
            },
        };
        Some(Self {
            lattice,
            air: wear.air,
            bed: wear.bed,
            frequency: wear.frequency.unwrap_or(f64::NAN),
            closed_below: wear.closed_below,
            may_leave: AGREES_IN_ALL
                * match wear.jumps {
                    Jumps::Tolerance(tolerance) => tolerance,
                    Jumps::Number(_) | Jumps::Explicit(_) => USUAL,
                },
        })
    }

    /// The fields before a jump: the oxygen of the present contact, and the bed as it lies.
    pub(crate) fn begin(&self, worn: &Worn, meeting: &Meeting<'_>) -> Result<ThirdFields, Error> {
        let mut fields = ThirdFields::default();
        let region = self.region(meeting);
        self.aerate(&region, meeting, &mut fields)?;
        if self.bed.is_some() {
            fields.bed.clone_from(&worn.bed);
        }
        self.protect(&mut fields);
        Ok(fields)
    }

    /// The fields after a jump of n cycles: the bed with the `supply` (fresh debris per area that enters it)
    /// added and spread, and the oxygen. `lost` is the debris that left at once, `last` the fields that the
    /// jump was solved with.
    pub(crate) fn respond(
        &self,
        worn: &Worn,
        meeting: &Meeting<'_>,
        (n, supply, lost): (f64, &[f64], f64),
        last: &ThirdFields,
    ) -> Result<ThirdFields, Error> {
        let mut fields = ThirdFields {
            oxygen: last.oxygen.clone(),
            ..ThirdFields::default()
        };
        let held = last.region.clone().filter(|_| last.holds_region);
        let region = held.unwrap_or_else(|| self.region(meeting));
        self.aerate(&region, meeting, &mut fields)?;
        let jump = (n, supply, meeting.slip);
        if let Some(bed) = self.spread(worn, &region, jump, (&last.bed, ROUGH))? {
            fields.bed = bed.height;
            fields.ejected = bed.ejected + lost;
        }
        fields.region = Some(region);
        self.protect(&mut fields);
        Ok(fields)
    }

    /// The debris at the end of a jump, from the fields that it has settled with: the bed solved to the accuracy
    /// of its mass.
    pub(crate) fn debris(
        &self,
        worn: &Worn,
        slip: &[f64],
        (n, supply, lost): (f64, &[f64], f64),
        settled: &ThirdFields,
    ) -> Result<Option<Debris>, Error> {
        let Some(region) = &settled.region else {
            return Ok(settled.to_debris());
        };
        let start = (&settled.bed[..], MASS_ACCURACY);
        let bed = self.spread(worn, region, (n, supply, slip), start)?;
        Ok(bed.map(|bed| Debris {
            bed: bed.height,
            ejected: bed.ejected + lost,
        }))
    }

    /// The bed after n cycles with this supply and slip, from a guess, to an accuracy of its mass; `None` without a
    /// bed.
    fn spread(
        &self,
        worn: &Worn,
        region: &Region,
        (n, supply, slip): (f64, &[f64], &[f64]),
        (guess, accuracy): (&[f64], f64),
    ) -> Result<Option<Bed>, Error> {
        let Some(settings) = &self.bed else {
            return Ok(None);
        };
        let transport = slip
            .iter()
            .map(|slip| settings.kappa * (0.25 * slip).powi(2));
        let transport: Vec<f64> = transport.collect();
        let supply = worn.bed.iter().zip(supply).map(|(h, new)| h + new);
        let supply: Vec<f64> = supply.collect();
        let bed = spread_bed(region, &transport, n, &supply, Some(guess), accuracy);
        let mut bed = bed.map_err(|error| to_error(&error))?;
        // The residual of conjugate gradients is below the accuracy of the mass.
        bed.height.iter_mut().for_each(|h| *h = h.max(0.0));
        Ok(Some(bed))
    }

    /// The closed region: pressed, or with a gap below the limit.
    fn region(&self, meeting: &Meeting<'_>) -> Region {
        let level: Vec<f64> = meeting
            .gap
            .iter()
            .map(|gap| self.closed_below - gap.max(0.0))
            .collect();
        Region::from_levels(self.lattice, &level)
    }

    /// Computes oxygen and aerated share in the closed region.
    fn aerate(
        &self,
        region: &Region,
        meeting: &Meeting<'_>,
        fields: &mut ThirdFields,
    ) -> Result<(), Error> {
        let Some(air) = &self.air else { return Ok(()) };
        let squares: Vec<f64> = meeting
            .p
            .iter()
            .zip(meeting.dissipated)
            .map(|(p, dissipated)| {
                air.lambda_squared(*p, dissipated * self.frequency, self.frequency)
            })
            .collect();
        let threshold = air.relative_threshold();
        let guess = (!fields.oxygen.is_empty()).then_some(&fields.oxygen[..]);
        let P = diffuse_air(region, &squares, threshold, guess);
        fields.oxygen = P.map_err(|error| to_error(&error))?;
        fields.aerated = aerated_share(region, &fields.oxygen, threshold);
        Ok(())
    }

    /// Computes the factor by which the bed reduces wear, if it does.
    pub(crate) fn protect(&self, fields: &mut ThirdFields) {
        if let Some(bed) = self.bed.filter(|bed| bed.protecting_thickness.is_some()) {
            fields.protection = fields.bed.iter().map(|h| bed.protection(*h)).collect();
        }
    }

    /// The volume of debris that the worn depth of a cell supplies to the bed, and the volume that leaves at
    /// once, over the depth; `starved` is the part of the depth that is worn without oxygen.
    pub(crate) fn yields(&self, starved: f64) -> [f64; 2] {
        let Some(bed) = &self.bed else {
            return [0.0; 2];
        };
        let lost = starved * (1.0 - bed.starved_yield);
        [bed.volume_ratio * (1.0 - lost), bed.volume_ratio * lost]
    }

    /// Change between two evaluations that is small enough to end the iteration: root of the sum of squares of
    /// the depths \[m\].
    pub(crate) fn enough(&self, loss: &[Vec<f64>; 2], worn: &Worn) -> f64 {
        let norm = |depth: &[Vec<f64>; 2]| -> f64 {
            depth.iter().flatten().map(|w| w * w).sum::<f64>().sqrt()
        };
        (AGREES_IN_JUMP * norm(loss)).max(self.may_leave * norm(&worn.depth))
    }
}

/// The error of conjugate gradients, which a shorter jump may avoid.
fn to_error(error: &NotConverged) -> Error {
    Error::NotConverged {
        increment: 0,
        solver: "third body",
        residual: error.residual,
        tolerance: error.tolerance,
        iterations: error.iterations,
        why: String::new(),
    }
}
