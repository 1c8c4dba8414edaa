//! What a run leaves behind: stores whole at every moment, runs resumed, damage, files of stress.

mod checkpoint;
mod damage;
mod documents;
#[path = "../../../contact-core/tests/files/mod.rs"]
mod files;
mod path_stress;
#[allow(dead_code, reason = "these tests draw no logarithms")]
#[path = "../../../contact-core/tests/splitmix/mod.rs"]
mod splitmix;
mod written;
