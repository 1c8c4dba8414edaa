//! The fixed point of a jump with oxygen and debris: fields that follow from the contact that they make.

use contact_core::Error;

use super::anderson::Anderson;
use super::loss::{Loss, Worn};
use super::third_body::{ThirdBody, ThirdFields};

/// Most evaluations. A jump that has not settled by then is too long.
pub(crate) const MOST_EVALUATIONS: usize = 60;
/// Evaluations after which the acceleration begins again, with half of each step: a region that opens
/// and closes by turns.
const PATIENCE: usize = 15;
/// Evaluations after which the closed region stays as it is. A cell at its border may be closed by its
/// debris and open without: it has no fixed point, however short the jump.
const HOLDS_REGION: usize = 30;

/// An evaluation of the fixed point.
pub(crate) enum Step {
    /// The loss and its fields have settled.
    Settled(Loss, ThirdFields),
    /// The fields of the next evaluation.
    Next(ThirdFields),
}

/// The fixed point of a jump.
pub(crate) struct FixedPoint {
    anderson: Anderson,
    /// Scale of the bed \[m\].
    scale: f64,
    evaluations: usize,
    /// Part of a step that is taken.
    damping: f64,
    /// Loss of the last evaluation.
    last: Option<Loss>,
    /// Change of the last evaluation, and the change that is enough \[m\].
    change: f64,
    enough: f64,
}

impl Default for FixedPoint {
    /// No evaluation yet.
    fn default() -> Self {
        Self {
            anderson: Anderson::default(),
            scale: 0.0,
            evaluations: 0,
            damping: 1.0,
            last: None,
            change: f64::INFINITY,
            enough: 0.0,
        }
    }
}

impl FixedPoint {
    /// Takes the `loss` at the last fields of oxygen and debris, and their `image`, which follows from the
    /// contact after this loss. Returns both if they have settled, otherwise the fields to try next. A jump
    /// that is not `implicit` needs one evaluation.
    pub(crate) fn advance(
        &mut self,
        (third_body, implicit): (&ThirdBody, bool),
        (worn, loss): (&Worn, Loss),
        fields: &ThirdFields,
        image: ThirdFields,
    ) -> Step {
        if !implicit {
            return Step::Settled(loss, image);
        }
        self.enough = third_body.enough(&loss.depth, worn);
        if let Some(last) = &self.last {
            self.change = last.depth_change(&loss).max(misfit(fields, &image));
            if self.change <= self.enough {
                return Step::Settled(loss, image);
            }
        }
        self.last = Some(loss);
        Step::Next(self.accelerate(third_body, fields, image))
    }

    /// The error of evaluations that have not settled.
    pub(crate) fn not_converged(&self) -> Error {
        Error::NotConverged {
            increment: 0,
            solver: "wear",
            residual: self.change,
            tolerance: self.enough,
            iterations: MOST_EVALUATIONS,
            why: String::new(),
        }
    }

    /// The next fields after an evaluation at x with this image.
    fn accelerate(
        &mut self,
        third_body: &ThirdBody,
        x: &ThirdFields,
        image: ThirdFields,
    ) -> ThirdFields {
        if self.scale == 0.0 {
            self.scale = image.bed.iter().fold(f64::MIN_POSITIVE, |m, h| m.max(*h));
        }
        let pack = |fields: &ThirdFields| -> Vec<f64> {
            let bed = fields.bed.iter().map(|h| h / self.scale);
            bed.chain(fields.aerated.iter().copied()).collect()
        };
        self.evaluations += 1;
        if self.evaluations.is_multiple_of(PATIENCE) {
            self.anderson = Anderson::default();
            self.damping *= 0.5;
        }
        let (from, mut to) = (pack(x), pack(&image));
        for (to, from) in to.iter_mut().zip(&from) {
            *to = from + self.damping * (*to - from);
        }
        let packed = self.anderson.accelerate(&from, to);
        let (bed, aerated) = packed.split_at(image.bed.len());
        let mut next_fields = image;
        next_fields.holds_region = self.evaluations >= HOLDS_REGION;
        next_fields.bed = bed.iter().map(|h| (h * self.scale).max(0.0)).collect();
        next_fields.aerated = aerated.iter().map(|s| s.clamp(0.0, 1.0)).collect();
        third_body.protect(&mut next_fields);
        next_fields
    }
}

/// Root of the sum of squares of the change of the bed \[m\].
fn misfit(x: &ThirdFields, image: &ThirdFields) -> f64 {
    let pairs = x.bed.iter().zip(&image.bed);
    pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}
