//! Time and memory of the stress below the paper's contact, kernels included: 256 x 256 cells,
//! 256 depths.
//!
//! `cargo run --release --example subsurface -- plane` computes the six components on y = 0,
//! `-- volume FILE.vti` the von Mises stress in the volume, streamed to the disk; names after the
//! file, such as `s_xx u_z`, say what else.

#![allow(clippy::print_stdout, clippy::unwrap_used)]

#[path = "../tests/stressed/mod.rs"]
mod stressed;

use std::time::Instant;

use contact_store::{ImageData, write_volume};
use contact_subsurface::{Line, Probe, Section, Side, Slices, States};

const N: usize = 256;

fn main() {
    let contact = stressed::coated(N);
    let tractions = [contact.tractions()];
    let states = States {
        stick: Some(&[]),
        ..States::from(&tractions)
    };
    let (body, grid) = (&contact.body, &contact.grid);
    let depths = contact.depths(N);
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let start = Instant::now();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["plane"] => {
            let line = Line::AlongX(0.0);
            let section = Section::new(body, Side::Body2, grid, line, states).unwrap();
            section.stress(&depths).unwrap();
        }
        ["volume", file, ref names @ ..] => {
            let names = if names.is_empty() {
                &["von_mises"]
            } else {
                names
            };
            let of: Vec<_> = names
                .iter()
                .map(|name| Probe::find(name, "probe").unwrap())
                .collect();
            let slices = Slices::new(body, Side::Body2, grid, states).unwrap();
            let image = ImageData::create(file, grid, Side::Body2, &depths, &of).unwrap();
            write_volume(&slices, &depths, &[], &of, &[&image], None).unwrap();
            image.finish().unwrap();
        }
        _ => panic!("arguments: plane, or volume FILE.vti NAMES"),
    }
    let seconds = start.elapsed().as_secs_f64();
    println!("{}: {seconds:.2} s, {}", arguments[0], peak_memory());
}

/// Largest memory that the process ever held, where the system tells.
fn peak_memory() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib: Option<f64> = peak.and_then(|v| v.split_whitespace().next()?.parse().ok());
    kib.map_or("memory unknown".into(), |kib| {
        format!("{:.0} MB", kib * 1024.0 / 1e6)
    })
}
