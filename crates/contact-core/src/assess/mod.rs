//! Stage 7: FROM STRESS TO DECISION.
//!
//! [`crack`] takes the stress below a contact to the tip of a crack.

pub mod crack;
