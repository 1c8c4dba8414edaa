//! Long work beside the interpreter, which goes on to hear signals.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use contact_core::Error;

use crate::forked::in_this_process;
use crate::prelude::*;

/// Time between two looks at the signals.
const LOOK: Duration = Duration::from_millis(50);

/// Does `work` as [`interruptible`]; it gets the flag that an interrupt raises.
pub(crate) fn stoppable<T: Send>(
    py: Python<'_>,
    work: impl FnOnce(&Arc<AtomicBool>) -> Result<T, Error> + Send,
) -> PyResult<Result<T, Error>> {
    let stop = Arc::default();
    interruptible(py, &stop, || work(&stop))
}

#[allow(
    clippy::redundant_closure_for_method_calls,
    reason = "the method is not general enough in its lifetime"
)]
/// Does `work` in another thread without the interpreter's lock, while the caller's thread handles signals.
/// What a signal handler raises is returned; it also raises `stop`, on which the work ends early.
pub(crate) fn interruptible<T: Send>(
    py: Python<'_>,
    stop: &Arc<AtomicBool>,
    work: impl FnOnce() -> T + Send,
) -> PyResult<T> {
    let (at_work, ended) = channel::<()>();
    let running = in_this_process()?;
    py.detach(move || {
        thread::scope(|scope| {
            let worker = scope.spawn(move || {
                let _at_work = at_work;
                running.install(work)
            });
            let mut raised = None;
            while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(LOOK) {
                if raised.is_some() {
                    continue;
                }
                if let Err(error) = Python::attach(|py| py.check_signals()) {
                    stop.store(true, Ordering::Relaxed);
                    raised = Some(error);
                }
            }
            let result = worker
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic));
            raised.map_or(Ok(result), Err)
        })
    })
}
