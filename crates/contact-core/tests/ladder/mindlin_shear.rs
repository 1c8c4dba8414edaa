//! Kernel and convolution alone: a Hertz-shaped shear and Mindlin's displacement under it.

use contact_core::convolution::{DcFft, Displacements, SurfaceOperator, Tractions};
use contact_core::kernels::influence_coefficients;
use contact_core::plan::Mirror;
use contact_core::scene::{Body, Elastic, Grid, KernelSettings, Shape};
use contact_reference::mindlin_shear_displacement;

/// Largest error of (u_x, u_y) on r < 0.9 a, over the displacement in the middle.
fn error(nu: f64, n: usize) -> f64 {
    let (a, q0) = (1e-3, 1e8);
    let material = Elastic { E: 2e11, nu };
    let grid = Grid::centred(2.2 * a, n).expect("a grid");
    let body = Body::homogeneous(material, Shape::Flat);
    let settings = KernelSettings::default();
    let c = influence_coefficients(&body, &grid, &settings, true, None).expect("coefficients");
    let mut op = DcFft::new(&c, Mirror::None, true);
    let shear = |x: f64, y: f64| q0 * (1.0 - (x * x + y * y) / (a * a)).max(0.0).sqrt();
    let q_x = grid.map(shear);
    let (mut u_x, mut u_y) = (vec![0.0; n * n], vec![0.0; n * n]);
    op.apply(
        Tractions {
            q_x: q_x.as_slice(),
            ..Tractions::default()
        },
        Displacements {
            u_x: Some(&mut u_x),
            u_y: Some(&mut u_y),
            u_z: None,
        },
    );
    let (middle, _) = mindlin_shear_displacement(material, q0, a, (0.0, 0.0));
    let mut worst = 0.0_f64;
    for i in 0..n {
        for j in 0..n {
            let at = (grid.x(i), grid.y(j));
            if at.0.hypot(at.1) < 0.9 * a {
                let (x, y) = mindlin_shear_displacement(material, q0, a, at);
                let k = i * n + j;
                worst = worst.max((u_x[k] - x).hypot(u_y[k] - y));
            }
        }
    }
    worst / middle
}

#[test]
fn displacements_converge_faster_than_the_cell_for_every_nu() {
    for nu in [-0.4, 0.0, 0.3, 0.499] {
        let (coarse, fine) = (error(nu, 48), error(nu, 192));
        // The total load is off by the 3/2 power of the cell at the rim: eight times less.
        assert!(fine < 5e-4, "{nu}: {fine:e}");
        assert!(fine < coarse / 5.0, "{nu}: {coarse:e} {fine:e}");
    }
}
