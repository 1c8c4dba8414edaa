//! Time and memory of the stress below the paper's contact.
//!
//! `cargo run --release --example subsurface -- plane|volume [cells] [depths]`
#![allow(clippy::print_stdout, clippy::unwrap_used)]

use std::time::Instant;

use contact_core::convolution::Tractions;
use contact_core::fields::{Line, Section, Side, Slices, depths};
use contact_core::scene::{Body, Coating, Elastic, Grid, Shape};

const A_H: f64 = 4.890_973e-4;

fn main() {
    let n = 256;
    let steel = Elastic::new(210e9, 0.3).unwrap();
    let body = Body {
        substrate: steel,
        coatings: vec![Coating {
            material: Elastic::new(420e9, 0.3).unwrap(),
            thickness: A_H,
        }],
        shape: Shape::Flat,
    };
    let grid = Grid::centred(2.4 * A_H, n).unwrap();
    let hertz = |x: f64, y: f64| (1.0 - (x * x + y * y) / (A_H * A_H)).max(0.0).sqrt();
    let p = grid.map(|x, y| 1.5e9 * hertz(x, y));
    let q_x = grid.map(|x, y| 0.3 * 1.5e9 * hertz(x, y));
    let q_y = grid.map(|x, y| 0.01 * 1.5e9 * hertz(x, y) * x * y / A_H / A_H);
    let tractions = Tractions {
        q_x: q_x.as_slice(),
        q_y: q_y.as_slice(),
        p: p.as_slice(),
    };
    let z: Vec<f64> = (0..256).map(|i| 2.0 * A_H * f64::from(i) / 255.0).collect();
    let depths = depths(&body, &z).unwrap();
    if std::env::args().nth(1).as_deref() == Some("volume") {
        let start = Instant::now();
        let slices = Slices::new(&body, Side::Body2, &grid, &[tractions]).unwrap();
        println!("loads {:.3} s", start.elapsed().as_secs_f64());
        let sums = slices
            .map_stress(&depths, |_, s| Ok(s[0][2].sum()))
            .unwrap();
        println!(
            "volume {:.3} s {}",
            start.elapsed().as_secs_f64(),
            sums[100]
        );
        return;
    }
    for _ in 0..3 {
        let start = Instant::now();
        let section =
            Section::new(&body, Side::Body2, &grid, Line::AlongX(0.0), &[tractions]).unwrap();
        println!("loads {:.3} s", start.elapsed().as_secs_f64());
        let stress = section.stress(&depths).unwrap();
        println!(
            "plane {:.3} s {}",
            start.elapsed().as_secs_f64(),
            stress[0][(2, 100, 128)]
        );
    }
}
