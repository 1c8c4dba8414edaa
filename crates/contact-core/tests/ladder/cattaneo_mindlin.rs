use contact_core::scene::LoadPath;
use contact_core::reference::CattaneoMindlin;

use crate::bench::*;

#[test]
fn probe() {
    for m in [CORK, STEEL] { for n in [64, 128, 256] {
        let mu = 0.3;
        let T = 0.9 * mu * W;
        let scene = sphere_on_flat(m, m, mu, (2.4, n), LoadPath::start().normal(W, 1).tangential(&[T, -T, T], 50));
        let c = CattaneoMindlin::new(hertz_of(&scene), m, m, mu);
        let t = std::time::Instant::now();
        let mut diss = 0.0;
        run(&scene, |march, i| {
            let T_x = i.point.loads.T_x;
            if i.point.branch > 1 { diss += i.energy.dissipated; }
            if !i.point.ends_branch && i.index % 7 != 0 { return; }
            let f = march.fields();
            let (q, s): (Box<dyn Fn(f64)->f64>, f64) = match i.point.branch { 0 => (Box::new(|_| 1.0), 1.0), 1 => (Box::new(|r| c.q_loading(r, T_x)), c.shift_loading(T_x)), 2 => (Box::new(|r| c.q_unloading(r, T_x, T)), c.shift_unloading(T_x, T)), _ => (Box::new(|r| c.q_reloading(r, T_x, T)), c.shift_reloading(T_x, T)) };
            let truth = scene.grid.map(|x, y| q(x.hypot(y)));
            let st = match i.point.branch { 1 => c.stick_radius(T_x), 2 => c.stick_radius_reversed(T_x, T), _ => c.stick_radius_reversed(T_x, -T) };
            println!("{n} {} T {T_x} L2 {:.2e} shift {:+.2e} stick {:+.2e}  qy {:.1e} E {:.1e} bal {:.1e}", i.point.branch, distance(&f.q_x, &truth), (i.motion.delta_x-s)/c.shift_limit(), ((i.stick_area/3.14159265358979).sqrt()-st)/c.hertz.a,  f.q_y.iter().fold(0f64, |a,b| a.max(b.abs()))/mu/c.hertz.p0, i.residuals.energy, i.residuals.balance);
        });
        println!("loop {} {:?}", diss/c.loop_energy(T)-1.0, t.elapsed());
    } }
}
