use contact_core::kernels::influence_coefficients;
use contact_core::scene::*;
use std::time::Instant;
fn main() {
    let s = Elastic::new(210e9, 0.3).unwrap();
    let a = 4.9e-4;
    for (n, layers, h) in [
        (256, 0, 1.0),
        (256, 1, 1.0),
        (256, 1, 1e-3),
        (256, 20, 0.05),
        (1024, 1, 1.0),
        (1024, 1, 1e-3),
        (1024, 20, 0.05),
        (1024, 0, 0.0),
    ] {
        let coatings = (0..layers)
            .map(|i| Coating {
                material: Elastic::new(
                    210e9 * (1.0 + 0.1 * (i % 7) as f64 + 1.0),
                    0.2 + 0.01 * (i % 5) as f64,
                )
                .unwrap(),
                thickness: h * a,
            })
            .collect();
        let body = Body {
            substrate: s,
            coatings,
            shape: Shape::Flat,
        };
        let grid = Grid::centred(2.4 * a, n).unwrap();
        for _ in 0..3 {
            let t = Instant::now();
            let c = influence_coefficients(
                &body,
                &grid,
                &KernelSettings {
                    tolerance: 0.9,
                    ..Default::default()
                },
                true,
            )
            .unwrap();
            println!(
                "n {n} layers {layers} h {h}: {:.4} s {:.3e}",
                t.elapsed().as_secs_f64(),
                c.zz[(0, 0)]
            );
        }
    }
}
