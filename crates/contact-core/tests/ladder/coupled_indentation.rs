use contact_core::scene::{LoadPath, Branch, Loads, Spacing, Elastic};
use contact_core::reference::{coupled_indentation, dundurs_beta};

use crate::bench::*;

#[test]
fn probe() {
    for (m, mu) in [(CORK, 0.5), (STEEL, 0.2), (STEEL, 0.5)] { for (n, inc) in [(64, 25), (128, 25), (128, 50), (128,100)] {
        let path = LoadPath::start().branch(Branch { to: Loads { W, T_x: 0.0, T_y: 0.0 }, increments: inc, spacing: Spacing::EqualRadius, t_end: 1.0 });
        let scene = sphere_on_flat(m, Elastic::RIGID, mu, (2.4, n), path);
        let h = hertz_of(&scene);
        let c = coupled_indentation(dundurs_beta(m, Elastic::RIGID), mu);
        let t = std::time::Instant::now();
        let all = run(&scene, |_march, _i| { });
        let a = h.a * c.W.powf(-1.0/3.0);
        for i in [&all[inc/2], &all[inc-1]] {
            println!("{n} {inc} c/a {:.5} exact {:.5} p0 {:.5} exact {:.5} a {:.5} exact {:.5} delta {:+.2e} alt {} conv {} {:?}", (i.stick_area/i.contact_area).sqrt(), c.stick_ratio, i.p_max/h.p0/(i.point.loads.W/W).cbrt(), c.p0*c.W.powf(2.0/3.0), i.contact_radius()/h.a/(i.point.loads.W/W).cbrt(), a/h.a, i.motion.delta_z/(c.delta_z*a*a/R*(i.point.loads.W/W).powf(2.0/3.0))-1.0, i.work.alternations, i.work.convolutions, t.elapsed());
        }
    } }
}
