//! Processes that are copies of another one: `os.fork`, and with it `multiprocessing` where that is
//! how it starts its processes.
//!
//! A copy has none of the threads of the process that it was copied from. The pool of threads that
//! all work is shared out to is one without a thread there: whoever handed it anything would wait
//! forever. A copy gets a pool of its own. What cannot be helped is a copy made while another
//! thread was at work, which has left its locks behind; it is refused at once.
//!
//! Runs at the same time in several threads of Python have pools of their own. In a common pool
//! each waits for pieces of the others.

use std::cell::RefCell;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

use pyo3::exceptions::PyRuntimeError;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::prelude::*;

/// The process that has worked last, and its pool if it is a copy.
struct Home {
    process: u32,
    pool: Option<Arc<ThreadPool>>,
}

static HOME: Mutex<Option<Home>> = Mutex::new(None);
/// Calls at work; a copy finds what was at work when it was made.
static AT_WORK: AtomicUsize = AtomicUsize::new(0);

thread_local! {
    /// Pool of the work that this thread calls for, and the process that made it.
    static LIMITED: RefCell<Option<(u32, Arc<ThreadPool>)>> = const { RefCell::new(None) };
}

/// Most threads of a pool.
const MOST_THREADS: usize = 1024;

/// Limit the work that the calling thread asks for to a number of threads of its own.
///
/// Other threads of Python keep the threads of the process.
#[pyfunction]
pub(crate) fn limit_threads(count: usize) -> PyResult<()> {
    if !(1..=MOST_THREADS).contains(&count) {
        refuse!("count = {count}: must be 1 to {MOST_THREADS}");
    }
    let pool = ThreadPoolBuilder::new().num_threads(count).build();
    let pool = pool.map_err(|e| PyRuntimeError::new_err(e.to_string()))?;
    LIMITED.set(Some((std::process::id(), Arc::new(pool))));
    Ok(())
}

/// A call at work.
pub(crate) struct Running {
    pool: Option<Arc<ThreadPool>>,
}

impl Running {
    /// Does `work` on the threads of this process.
    pub(crate) fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.pool {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}

impl Drop for Running {
    /// Notes that the call is over.
    fn drop(&mut self) {
        AT_WORK.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Begins a call. Fails in a fork of a process that was computing when it was forked, since its threads are
/// gone.
pub(crate) fn in_this_process() -> PyResult<Running> {
    let mut home = HOME.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    let pool = match &*home {
        Some(home) if home.process == process => home.pool.clone(),
        None => None,
        Some(_) => {
            if AT_WORK.load(Ordering::Relaxed) > 0 {
                return Err(PyRuntimeError::new_err(
                    "this process was forked while pyfret was at work in another thread, and cannot \
                     use it: start processes anew, with multiprocessing.get_context(\"spawn\")",
                ));
            }
            let pool = ThreadPoolBuilder::new().build();
            Some(Arc::new(
                pool.map_err(|e| PyRuntimeError::new_err(e.to_string()))?,
            ))
        }
    };
    // A pool of the process that this one is a copy of has no threads that could be waited for.
    let before = home.replace(Home {
        process,
        pool: pool.clone(),
    });
    if let Some(before) = before
        && before.process != process
    {
        std::mem::forget(before.pool);
    }
    AT_WORK.fetch_add(1, Ordering::Relaxed);
    let limited = LIMITED.with_borrow(|limited| match limited {
        Some((made_by, pool)) if *made_by == process => Some(pool.clone()),
        _ => None,
    });
    Ok(Running {
        pool: limited.or(pool),
    })
}
