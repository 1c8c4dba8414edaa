//! Error against time of every conversion, as CSV on the standard output.
//!
//! The body of the paper's figure 6: a coating four times as stiff as its substrate, eight cells
//! thick, on a grid of 64 x 64 cells (or as many as the first argument says). Errors are those of
//! C33 over its exact value: at the cell itself, at half the length of the grid, and the largest of
//! all offsets over C33(0,0). The operator of the paper's reference \[15\] uses the same samples as
//! the inverse transform without alias sums and errs alike; its time is that of one convolution
//! more each.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use contact_core::Error;
use contact_core::convolution::{
    DcFft, Displacements, FrequencyDomain, SurfaceOperator, Tractions,
};
use contact_core::kernels::{InfluenceCoefficients, clear_cache, influence_coefficients};
use contact_core::plan::Mirror;
use contact_core::scene::{Body, Coating, Elastic, Grid, KernelMethod, KernelSettings, Shape};

/// Runs of which the shortest counts.
const REPEATS: usize = 5;

fn main() -> Result<(), Error> {
    let n = std::env::args()
        .nth(1)
        .and_then(|n| n.parse().ok())
        .unwrap_or(64);
    let grid = Grid::from_spacing((n, n), (1e-6, 1e-6))?;
    let substrate = Elastic::new(210e9, 0.3)?;
    let indenter = Body::homogeneous(substrate, Shape::Flat);
    let coating = Coating::new(Elastic::new(840e9, 0.3)?, 8e-6)?;
    let coated = Body::coated(substrate, [coating], Shape::Flat);

    let mut methods = vec![KernelMethod::Hankel];
    for aliases in [0, 1] {
        let lambdas = [1, 2, 4, 8, 12];
        methods.extend(lambdas.map(|lambda| KernelMethod::InverseFft { lambda, aliases }));
    }
    methods.extend([2, 4, 8].map(|lambda| KernelMethod::FrequencyDomain { lambda }));

    let coefficients = |method| -> Result<(InfluenceCoefficients, f64), Error> {
        let settings = KernelSettings {
            method,
            ..KernelSettings::default()
        };
        let (mut shortest, mut result) = (f64::INFINITY, None);
        for _ in 0..REPEATS {
            clear_cache();
            let start = Instant::now();
            result = Some(influence_coefficients(
                &coated, &grid, &settings, true, None,
            )?);
            shortest = shortest.min(start.elapsed().as_secs_f64());
        }
        Ok((result.expect("repeated"), shortest))
    };
    let exact = coefficients(KernelMethod::Hankel)?.0;
    let other = influence_coefficients(&indenter, &grid, &KernelSettings::default(), true, None)?;

    println!("method,lambda,aliases,kernel_s,convolution_s,error_self,error_far,error_largest");
    for method in methods {
        let (name, lambda, aliases) = match method {
            KernelMethod::Hankel => ("hankel", 1, 0),
            KernelMethod::InverseFft { lambda, aliases } => ("inverse_fft", lambda, aliases),
            KernelMethod::FrequencyDomain { lambda } => ("frequency_domain", lambda, 0),
        };
        let (ours, kernel_s, convolution_s) =
            if let KernelMethod::FrequencyDomain { lambda } = method {
                let start = Instant::now();
                let bodies = (&indenter, &coated);
                let pair = exact.clone().pair(&other);
                let mut op = FrequencyDomain::new(bodies, &grid, lambda, true, &pair);
                let kernel_s = start.elapsed().as_secs_f64();
                let samples = KernelMethod::InverseFft { lambda, aliases: 0 };
                (coefficients(samples)?.0, kernel_s, convolution(&mut op))
            } else {
                let (ours, kernel_s) = coefficients(method)?;
                let mut op = DcFft::new(&ours.clone().pair(&other), Mirror::None, true);
                (ours, kernel_s, convolution(&mut op))
            };
        let error = |at: (usize, usize)| ours.zz[at] / exact.zz[at] - 1.0;
        let largest = (&ours.zz - &exact.zz).fold(0.0, |m: f64, v| m.max(v.abs()));
        println!(
            "{name},{lambda},{aliases},{kernel_s:.3e},{convolution_s:.3e},{:.3e},{:.3e},{:.3e}",
            error((0, 0)),
            error((n / 2, 0)),
            largest / exact.zz[(0, 0)],
        );
    }
    Ok(())
}

/// Seconds that one convolution of all three components takes.
fn convolution(op: &mut dyn SurfaceOperator) -> f64 {
    let (nx, ny) = op.shape();
    let q = vec![1.0; nx * ny];
    let (mut u_x, mut u_y, mut u_z) = (q.clone(), q.clone(), q.clone());
    let mut shortest = f64::INFINITY;
    for _ in 0..REPEATS {
        let start = Instant::now();
        op.apply(
            Tractions {
                q_x: Some(&q),
                q_y: Some(&q),
                p: Some(&q),
            },
            Displacements {
                u_x: Some(&mut u_x),
                u_y: Some(&mut u_y),
                u_z: Some(&mut u_z),
            },
        );
        shortest = shortest.min(start.elapsed().as_secs_f64());
    }
    shortest
}
