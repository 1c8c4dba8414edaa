//! Time of one convolution of three components: the unit of work of every solver.
#![allow(missing_docs)]

mod rig;

use std::time::Instant;

use contact_core::convolution::{
    ApproximateInverse, CirculantInverse, DcFft, Displacements, SurfaceOperator, Tractions,
};
use contact_core::kernels::{InfluenceCoefficients, influence_coefficients};
use contact_core::plan::Mirror;
use contact_core::scene::{Body, Coating, Elastic, Grid, KernelSettings, Shape};
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use rayon::{ThreadPool, ThreadPoolBuilder};

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.3 };

fn coefficients(n: usize) -> InfluenceCoefficients {
    let coating = Coating {
        material: Elastic { E: 420e9, nu: 0.3 },
        thickness: 5e-4,
    };
    let body = Body::coated(STEEL, [coating], Shape::Flat);
    let grid = Grid::centred(1.2e-3, n).expect("a positive extent");
    influence_coefficients(&body, &grid, &KernelSettings::default(), true, None).expect("a coating")
}

fn pool(threads: usize) -> ThreadPool {
    ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .expect("threads")
}

/// Tractions within the circle that fills three quarters of the grid.
fn tractions(n: usize, rows: usize) -> Vec<f64> {
    let middle = 0.5 * (n as f64 - 1.0);
    let cell = |k: usize| {
        let (x, y) = (
            (k / rows) as f64 - middle,
            (k % rows + n - rows) as f64 - middle,
        );
        let r2 = (x * x + y * y) / (0.38 * n as f64).powi(2);
        (1.0 - r2).max(0.0).sqrt()
    };
    (0..n * rows).map(cell).collect()
}

fn convolution(c: &mut Criterion) {
    let mut group = rig::stage(c, "convolution");
    for n in [64, 256, 512, 1024] {
        let coefficients = coefficients(n);
        for (name, mirror) in [("whole", Mirror::None), ("mirrored", Mirror::Y)] {
            for threads in [1, 2] {
                let pool = pool(threads);
                let mut op = pool.install(|| DcFft::new(&coefficients, mirror, true));
                let (_, rows) = op.shape();
                let q = tractions(n, rows);
                let mut u = [q.clone(), q.clone(), q.clone()];
                let mut convolve = || {
                    let [u_x, u_y, u_z] = &mut u;
                    let tractions = Tractions {
                        q_x: Some(&q),
                        q_y: Some(&q),
                        p: Some(&q),
                    };
                    let displacements = Displacements {
                        u_x: Some(u_x),
                        u_y: Some(u_y),
                        u_z: Some(u_z),
                    };
                    op.apply(tractions, displacements);
                };
                let id = BenchmarkId::new(format!("{name}/threads_{threads}"), n);
                group.bench_function(id, |b| {
                    b.iter_custom(|times| {
                        pool.install(|| {
                            let start = Instant::now();
                            (0..times).for_each(|_| convolve());
                            start.elapsed()
                        })
                    });
                });
            }
        }
        let mut inverse = CirculantInverse::new(&coefficients, Mirror::Y, true);
        let q = tractions(n, n / 2);
        let mut z = [q.clone(), q.clone()];
        group.bench_function(BenchmarkId::new("preconditioner", n), |b| {
            b.iter(|| {
                let [z_x, z_y] = &mut z;
                inverse.tangential([&q, &q], [z_x, z_y]);
            });
        });
    }
    group.finish();
}

criterion_group!(benches, convolution);
criterion_main!(benches);
