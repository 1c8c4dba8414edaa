//! Rows of coefficients, computed in parallel until the run is stopped.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::error::Error;
use crate::stop::unless;

/// Does the work on every row; fails once `stop` is raised, after the rows in progress.
pub(super) fn for_each_row<R: Send>(
    rows: &mut [R],
    stop: &AtomicBool,
    work: impl Fn(usize, &mut R) + Sync,
) -> Result<(), Error> {
    rows.par_iter_mut().enumerate().try_for_each(|(i, row)| {
        unless(stop)?;
        work(i, row);
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    /// No thread begins a row after the flag is up, except one that has just looked.
    #[test]
    fn a_raised_flag_ends_the_rows() {
        let (stop, begun_after) = (AtomicBool::new(false), AtomicUsize::new(0));
        let mut rows = vec![0.0; 1024];
        let result = for_each_row(&mut rows, &stop, |i, row| {
            if stop.load(Ordering::SeqCst) {
                begun_after.fetch_add(1, Ordering::SeqCst);
            }
            *row = 1.0;
            if i == 100 {
                stop.store(true, Ordering::SeqCst);
            }
        });
        assert_eq!(result, Err(Error::Interrupted { increment: 0 }));
        let late = begun_after.into_inner();
        assert!(late < rayon::current_num_threads(), "{late} rows");
        assert!(rows.contains(&0.0));
    }
}
