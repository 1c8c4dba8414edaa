//! Time of one three-component convolution on one thread and on two, as CSV on the standard output.
//!
//! Kernels of a coated body, whole grid, all nine of them: the work that two-dimensional transforms
//! of six fields bound from below. Arguments: the numbers of cells along a side.
#![allow(clippy::print_stdout)]

use std::time::{Duration, Instant};

use contact_core::convolution::{DcFft, Displacements, SurfaceOperator, Tractions};
use contact_core::kernels::influence_coefficients;
use contact_core::plan::Mirror;
use contact_core::scene::{Body, Coating, Elastic, Grid, KernelSettings, Shape};
use rayon::ThreadPoolBuilder;

/// Processors raise their clock within about this time of steady work.
const WARM_UP: Duration = Duration::from_millis(1500);
/// Time of the repetitions of one measurement.
const REPEAT: Duration = Duration::from_millis(1500);

/// The best of as many convolutions as fit into the time \[s\].
fn best(op: &mut DcFft, n: usize) -> f64 {
    let field = |phase: usize| -> Vec<f64> {
        let value = |cell: usize| ((cell + phase) % 97) as f64 / 97.0;
        (0..n * n).map(value).collect()
    };
    let (q_x, q_y, p) = (field(1), field(2), field(3));
    let [mut u_x, mut u_y, mut u_z] = [field(0), field(0), field(0)];
    let mut best = f64::INFINITY;
    let begun = Instant::now();
    while begun.elapsed() < WARM_UP + REPEAT {
        let start = Instant::now();
        let tractions = Tractions {
            q_x: Some(&q_x),
            q_y: Some(&q_y),
            p: Some(&p),
        };
        let displacements = Displacements {
            u_x: Some(&mut u_x),
            u_y: Some(&mut u_y),
            u_z: Some(&mut u_z),
        };
        op.apply(tractions, displacements);
        best = best.min(start.elapsed().as_secs_f64());
    }
    best
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let steel = Elastic::new(210e9, 0.3)?;
    let coating = Coating::new(Elastic::new(420e9, 0.3)?, 5e-4)?;
    let body = Body::coated(steel, [coating], Shape::Flat);
    println!("cells,threads,seconds");
    for argument in std::env::args().skip(1) {
        let n = argument.parse()?;
        let grid = Grid::centred(1.2e-3, n)?;
        let coefficients =
            influence_coefficients(&body, &grid, &KernelSettings::default(), true, None)?;
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build()?;
            let seconds = pool.install(|| {
                let mut op = DcFft::new(&coefficients, Mirror::None, true);
                best(&mut op, n)
            });
            println!("{n},{threads},{seconds:.6e}");
        }
    }
    Ok(())
}
