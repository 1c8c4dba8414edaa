//! Time of a whole run under each conversion, as CSV on the standard output.
//!
//! Runs a scene file with the same solver and path on the whole grid, under the operator of the
//! paper's reference \[15\] (convolution with the frequency response on a domain enlarged eight
//! times), the paper's conversion, and the default one; last with the half of the grid that mirror
//! symmetry allows. Arguments: the scene file, then settings such as `grid.n=128`.
#![allow(clippy::print_stdout)]

use std::time::Instant;

use contact_core::kernels::clear_cache;
use contact_core::march::solve;
use contact_core::{Error, Scene};

const METHODS: [(&str, &str, bool); 4] = [
    (
        "frequency_domain",
        "{ frequency_domain = { lambda = 8 } }",
        false,
    ),
    (
        "inverse_fft",
        "{ inverse_fft = { lambda = 8, aliases = 0 } }",
        false,
    ),
    ("hankel", "\"hankel\"", false),
    ("hankel_mirror", "\"hankel\"", true),
];

fn main() -> Result<(), Error> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments
        .next()
        .unwrap_or_else(|| "scenes/coated_fretting.toml".into());
    let settings: Vec<String> = arguments.collect();
    println!("method,seconds,convolutions,stick_ratio,delta_x");
    for (name, method, mirror) in METHODS {
        let mut settings = settings.clone();
        settings.push(format!("kernel.method={method}"));
        settings.push(format!("skip.mirror={mirror}"));
        let scene = Scene::from_file(&file, &settings)?;
        clear_cache();
        let start = Instant::now();
        let increments = solve(&scene, &mut ())?;
        let seconds = start.elapsed().as_secs_f64();
        let convolutions: f64 = increments.iter().map(|i| i.work.convolutions).sum();
        let Some(last) = increments.last() else {
            continue;
        };
        println!(
            "{name},{seconds:.2},{convolutions:.0},{:.5},{:.6e}",
            last.stick_ratio(),
            last.motion.delta_x,
        );
    }
    Ok(())
}
