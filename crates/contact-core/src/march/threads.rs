//! Threads of the pool that do not sleep while an increment is solved.
//!
//! An increment is hundreds of short parallel regions. A thread of the pool that finds nothing to
//! do for some ten microseconds goes to sleep, and waking it takes longer than many a region lasts.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use rayon::Yield;

/// How long `work` waits for the other threads.
const LONGEST_WAIT: Duration = Duration::from_micros(100);

/// Runs `work` on a thread of the pool while the other threads poll for its parallel parts instead
/// of sleeping.
///
/// A thread that is busy with another job and does not arrive within [`LONGEST_WAIT`] is left out.
/// Arriving later it might start to poll from inside a part of this `work` (by stealing the polling
/// job): that part would wait for `work` to end, and `work` for that part. With this rule a polling
/// thread suspends only jobs that began before `work`, so that no cycle of waiting can form.
pub(super) fn with_busy_threads<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    let watchers: Vec<_> = (1..rayon::current_num_threads())
        .map(|_| AtomicBool::new(false))
        .collect();
    let (closed, done) = (AtomicBool::new(false), AtomicBool::new(false));
    rayon::scope(|scope| {
        for came in &watchers {
            let (closed, done) = (&closed, &done);
            scope.spawn(move |_| {
                came.store(true, Ordering::Relaxed);
                if closed.load(Ordering::Acquire) {
                    return;
                }
                while !done.load(Ordering::Acquire) {
                    if rayon::yield_now() != Some(Yield::Executed) {
                        spin_loop();
                    }
                }
            });
        }
        let begin = Instant::now();
        while !watchers.iter().all(|came| came.load(Ordering::Relaxed))
            && begin.elapsed() < LONGEST_WAIT
        {
            spin_loop();
        }
        closed.store(true, Ordering::Release);
        let _raise = RaiseOnDrop(&done);
        work()
    })
}

/// Raises a flag at the end, also when that is a panic.
struct RaiseOnDrop<'a>(&'a AtomicBool);

impl Drop for RaiseOnDrop<'_> {
    /// Raises the flag, so that the polling threads stop, even if the work panics.
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}
