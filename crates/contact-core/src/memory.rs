//! Memory that there is on this machine.

use sysinfo::{MemoryRefreshKind, System};

use crate::error::Error;

/// Memory that a process may still take \[bytes\]: what the system has to give, or what the control
/// group or the limit of address space of the process leaves. Infinite where the system does not
/// report it.
pub fn available_memory() -> f64 {
    system_memory().min(left_of_limit().unwrap_or(f64::INFINITY))
}

/// What the limit of address space leaves (`ulimit -v`); `None` where there is none, or none that
/// can be read.
fn left_of_limit() -> Option<f64> {
    let limits = std::fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"))?;
    let limit: f64 = line.split_whitespace().next()?.parse().ok()?;
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let taken = status
        .lines()
        .find_map(|line| line.strip_prefix("VmSize:"))?;
    let taken: f64 = taken.split_whitespace().next()?.parse().ok()?;
    Some((limit - 1024.0 * taken).max(0.0))
}

/// Free memory of the system or of the process's control group \[bytes\], whichever is less; infinite where the
/// system does not report it.
fn system_memory() -> f64 {
    let mut system = System::new();
    system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
    let of_group = system.cgroup_limits().map_or(u64::MAX, |l| l.free_memory);
    match system.available_memory().min(of_group) {
        // Some systems do not report it.
        0 => f64::INFINITY,
        bytes => bytes as f64,
    }
}

/// Fails if `needed` bytes are more than the free memory; `what` is named in the error.
pub fn fits(what: &'static str, needed: f64) -> Result<(), Error> {
    let available = available_memory();
    if needed <= available {
        return Ok(());
    }
    Err(Error::TooLarge {
        what,
        needed,
        available,
    })
}
