//! The number of threads of a command.

use clap::Args;

/// The number of threads of a command.
#[derive(Args)]
pub(crate) struct Threads {
    /// Number of threads (default: one per core); the result does not depend on it
    #[arg(long = "threads", value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    number: Option<u16>,
}

impl Threads {
    /// Sets the number, before the first use of the pool. This thread is one of them: to hand an
    /// increment to another thread and wait takes longer than the work on a small one.
    pub(crate) fn set(&self) {
        // The pool has no other user in this process, so it cannot have been built before. Zero
        // means one thread per core.
        let _ = rayon::ThreadPoolBuilder::new()
            .num_threads(self.number.unwrap_or(0).into())
            .use_current_thread()
            .build_global();
    }
}
