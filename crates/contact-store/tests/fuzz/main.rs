//! Hostile input: whatever a file holds, it is read or refused by a sentence, soon, and in little
//! memory.
//!
//! `make fuzz` runs each target for ten minutes and writes what came out into
//! `docs/reliability.md`; the test runs a slice. `FRET_FUZZ` is the number of seconds,
//! `FRET_FUZZ_SEED` another start of the inputs.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

#[path = "../../../contact-core/tests/document/mod.rs"]
mod document;
#[path = "../../../contact-core/tests/files/mod.rs"]
mod files;
mod heights;
mod mutate;
mod scene;
mod store;

use std::alloc::System;
use std::fmt::Debug;
use std::time::{Duration, Instant};

use cap::Cap;
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// Memory of the whole process: an input that asks for more ends it. The largest inputs that are
/// solved announce a tenth of it.
#[global_allocator]
static MEMORY: Cap<System> = Cap::new(System, 1 << 30);
/// Announced memory up to which a scene is solved \[bytes\].
const ANNOUNCED: f64 = 1e8;

/// Seconds of the slice, each target.
const SLICE: u64 = 5;
/// Inputs between two looks at the clock.
const ROUND: u32 = 32;
/// An input that takes longer is a hang: most take a millisecond, solving is stopped after two
/// seconds.
const PATIENCE: Duration = Duration::from_mins(1);

fn number(variable: &str) -> Option<u64> {
    std::env::var(variable).ok().map(|n| n.parse().unwrap())
}

/// Runs `test`, which says whether the input was taken, on inputs of the strategy.
fn fuzz<S: Strategy>(name: &str, strategy: S, test: impl Fn(&S::Value) -> bool)
where
    S::Value: Debug,
{
    let config = Config {
        cases: ROUND,
        failure_persistence: None,
        ..Config::default()
    };
    let mut seed = [0; 32];
    seed[..8].copy_from_slice(&number("FRET_FUZZ_SEED").unwrap_or(1).to_le_bytes());
    let time = Duration::from_secs(number("FRET_FUZZ").unwrap_or(SLICE));
    let begun = Instant::now();
    let (inputs, taken) = (std::cell::Cell::new(0), std::cell::Cell::new(0));
    for round in 0_u64.. {
        if begun.elapsed() >= time {
            break;
        }
        // A runner counts its inputs once and for all: each round has its own.
        seed[8..16].copy_from_slice(&round.to_le_bytes());
        let random = TestRng::from_seed(RngAlgorithm::ChaCha, &seed);
        let mut runner = TestRunner::new_with_rng(config.clone(), random);
        let outcome = runner.run(&strategy, |input| {
            let begun = Instant::now();
            let took = test(&input);
            assert!(begun.elapsed() < PATIENCE, "took {:?}", begun.elapsed());
            inputs.set(inputs.get() + 1);
            taken.set(taken.get() + u64::from(took));
            Ok(())
        });
        if let Err(error) = outcome {
            panic!("{name}: {error}");
        }
    }
    let (inputs, taken) = (inputs.get(), taken.get());
    assert!(
        taken > 0 && taken < inputs,
        "{taken} of {inputs} inputs of {name} were taken"
    );
    let text = format!(
        "{inputs} inputs in {:.0} s, {taken} taken, {} refused; no panic, no hang, within {} MB.",
        begun.elapsed().as_secs_f64(),
        inputs - taken,
        MEMORY.max_allocated().div_ceil(1_000_000),
    );
    println!("{name}: {text}");
    if let Ok(document) = std::env::var("FRET_FUZZ_REPORT") {
        document::insert(&document, &format!("fuzz {name}"), &text);
    }
}

/// A folder of its own, in memory where there is such a place: what is written is brought to the
/// disk, which takes its time.
fn folder() -> tempfile::TempDir {
    let in_memory = std::path::Path::new("/dev/shm");
    if in_memory.is_dir() {
        tempfile::tempdir_in(in_memory).unwrap()
    } else {
        tempfile::tempdir().unwrap()
    }
}

/// Each mistake of a scene file is a sentence on a line of its own.
fn a_sentence_each(error: &contact_core::Error) {
    let text = error.to_string();
    let told = |line: &str| !line.trim().is_empty();
    assert!(!text.is_empty() && text.lines().all(told), "{text:?}");
}

/// An error is one sentence.
fn one_sentence(error: &contact_core::Error) {
    let text = error.to_string();
    assert!(!text.is_empty() && text.lines().count() == 1, "{text:?}");
}
