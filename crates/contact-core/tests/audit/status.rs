//! The status, the stick area and the cells that stick are one answer.

use contact_core::march::{Increment, Status};

use super::{Audit, End, Law, Violations};

impl Audit {
    /// Full stick is a stick ratio of 1 and no cell that slips, gross slip a ratio of 0 and no cell
    /// that sticks. Between them the ratio is a number between. An increment that was solved on a
    /// coarser grid has fields that are carried over, and is left out.
    pub(super) fn check_status(&self, now: &End, increment: &Increment, found: &mut Violations) {
        if increment.path_grid != self.scene.grid.nx {
            return;
        }
        let count = |mask: &ndarray::Array2<bool>| mask.iter().filter(|&&yes| yes).count();
        let (contact, stick) = (count(&now.fields.contact), count(&now.fields.stick));
        let ratio = increment.stick_ratio();
        let agrees = match increment.status {
            Status::NoContact => contact == 0 && increment.contact_area == 0.0,
            Status::FullStick => contact > 0 && stick == contact && ratio == 1.0,
            Status::PartialSlip if stick == 0 => ratio == 0.0,
            Status::PartialSlip => stick < contact && 0.0 < ratio && ratio < 1.0,
            Status::GrossSlip => contact > 0 && stick == 0 && ratio == 0.0,
        };
        found.raise(Law::Status, if agrees { 0.0 } else { f64::INFINITY });
    }
}
