use contact_core::scene::{LoadPath, Branch, Loads, Spacing, Elastic};
use contact_core::march::March;
use crate::bench::*;

#[test]
fn probe() {
    for mu in [0.05, 0.1, 0.2, 0.3, 0.5] { for nu in [0.0, 0.3] { for n in [32, 48, 64, 96, 128] { for inc in [13, 25, 50] {
        let m = Elastic{E:210e9, nu};
        let path = LoadPath::start().branch(Branch { to: Loads { W, T_x: 0.0, T_y: 0.0 }, increments: inc, spacing: Spacing::EqualRadius, t_end: 1.0 });
        let scene = sphere_on_flat(m, Elastic::RIGID, mu, (2.4, n), path);
        let mut march = March::new(&scene).unwrap();
        for k in 0..8 { if let Some(Err(e)) = march.advance() { println!("mu {mu} nu {nu} n {n} inc {inc} k {k} {e}"); break; } }
    }}}}
}
