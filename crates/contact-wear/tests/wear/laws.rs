//! Laws of wear: those drawn for random runs, and what each of them promises.

use std::sync::Arc;

use contact_core::scene::{Coating, Elastic, Grid, Shape};
use contact_core::{Error, Scene};
use contact_wear::{
    Archard, BodyWear, CellCycle, Cycling, DissipatedEnergy, Jumps, Law, Wear, WornThrough,
};

use crate::audit::Audit;
use crate::bench::{archard, cylinder, pulled, run, scene, to_and_fro, wear};
use crate::splitmix::Draw;

/// A law of one's own: Archard's, that fades as a cell wears.
#[derive(Debug)]
struct RunningIn {
    k: f64,
    over: f64,
}

impl Law for RunningIn {
    fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error> {
        for (n, depth) in depth.iter_mut().enumerate() {
            *depth =
                self.k * cycle.pressure_times_slip[n] * (1.0 + (-cycle.worn[n] / self.over).exp());
        }
        Ok(())
    }
}

/// Laws of two bodies, and the volume that each loses per energy where that is one number.
pub(crate) struct Drawn {
    pub(crate) bodies: [BodyWear; 2],
    pub(crate) per_energy: Option<[f64; 2]>,
}

/// Laws for bodies of so many layers each, under one coefficient of friction where it is `plain`.
pub(crate) fn draw_laws(draw: &mut Draw, layers: [usize; 2], mu: f64, plain: bool) -> Drawn {
    let mut per_energy = Some([0.0; 2]);
    let mut body = |b: usize, must: bool| {
        let share = (draw.next() < 0.3).then(|| draw.next());
        let law = |draw: &mut Draw| -> (Arc<dyn Law>, Option<f64>) {
            let size = draw.between(1e-15, 1e-13);
            match (5.0 * draw.next()) as usize {
                0 => {
                    let threshold = draw.between(1e-10, 1e-7);
                    (Arc::new(Archard { k: size, threshold }), None)
                }
                1 => {
                    let (alpha, threshold) = (size, draw.between(1e-2, 1e2));
                    (Arc::new(DissipatedEnergy { alpha, threshold }), None)
                }
                2 => {
                    let (k, threshold) = (size, 0.0);
                    (
                        Arc::new(Archard { k, threshold }),
                        plain.then_some(size / mu),
                    )
                }
                3 => (
                    Arc::new(RunningIn {
                        k: size,
                        over: 1e-7,
                    }),
                    None,
                ),
                _ => {
                    let (alpha, threshold) = (size, 0.0);
                    (Arc::new(DissipatedEnergy { alpha, threshold }), Some(size))
                }
            }
        };
        if !must && draw.next() < 0.25 {
            return BodyWear::default();
        }
        let (first, per) = law(draw);
        let mut laws = vec![first];
        if layers[b] > 1 && draw.next() < 0.5 {
            laws.extend((1..layers[b]).map(|_| law(draw).0));
            per_energy = None;
        }
        per_energy = per_energy.zip(per).map(|(mut all, per)| {
            all[b] = share.unwrap_or(1.0) * per;
            all
        });
        BodyWear { laws, share }
    };
    let one = body(0, false);
    let two = body(1, one.laws.is_empty());
    Drawn {
        bodies: [one, two],
        per_energy,
    }
}

/// The cycles of a cylinder, body 2, that keeps its place under a flat that slides to and fro.
fn sliding(stroke: f64) -> contact_core::scene::Scene {
    let grid = Grid::strip(0.5e-3, 64, 1.0).unwrap();
    let mut scene = scene(cylinder(6e-3), grid, to_and_fro(18.5e3, stroke, 1), 0.9);
    std::mem::swap(&mut scene.body1, &mut scene.body2);
    scene
}

/// Volume that body 2 loses in so many cycles of sliding by a law.
fn lost(stroke: f64, body2: BodyWear, change: impl FnOnce(&mut Wear)) -> f64 {
    lost_in(&sliding(stroke), body2, change)
}

/// The same in a scene.
fn lost_in(scene: &Scene, body2: BodyWear, change: impl FnOnce(&mut Wear)) -> f64 {
    let mut wear = wear([BodyWear::default(), body2], 1e3, Cycling::Sliding);
    wear.jumps = Jumps::Number(2);
    change(&mut wear);
    let (_, jumps) = run(scene, &wear);
    jumps.last().unwrap().volume[1]
}

fn assert_near(found: f64, asked: f64, part: f64) {
    assert!(
        (found / asked - 1.0).abs() < part,
        "{found:e}, not {asked:e}"
    );
}

#[test]
fn a_law_of_ones_own_wears_as_it_says() {
    let own = |over| BodyWear::with_law(RunningIn { k: 1e-14, over });
    let (W, stroke, cycles) = (18.5e3, 2e-6, 1e3);
    let fast = 2e-14 * W * 4.0 * stroke * cycles;
    // It never fades: twice Archard's k; it has faded at once: k.
    assert_near(lost(stroke, own(1.0), |_| ()), fast, 1e-6);
    assert_near(
        lost(stroke, own(1e-15), |w| w.jumps = Jumps::Number(40)),
        0.5 * fast,
        0.03,
    );
    let between = lost(stroke, own(1e-7), |_| ()) / fast;
    assert!(between > 0.55 && between < 0.95, "{between}");
}

#[test]
fn shares_and_thresholds_take_their_parts() {
    let (W, stroke, cycles, k) = (18.5e3, 2e-6, 1e3, 2e-14);
    let whole = k * W * 4.0 * stroke * cycles;
    let shared = BodyWear {
        share: Some(0.3),
        ..archard(k)
    };
    assert_near(lost(stroke, shared, |_| ()), 0.3 * whole, 1e-7);
    // Every cell of the flat slips 4 strokes a cycle; what is beyond the threshold counts.
    let threshold = |part: f64| {
        let threshold = part * 4.0 * stroke;
        lost(stroke, BodyWear::with_law(Archard { k, threshold }), |_| ())
    };
    assert_near(threshold(0.25), 0.75 * whole, 1e-7);
    assert!(threshold(1.01) == 0.0);
    // The energy per area of a cell: none has more than mu p_max times the way at first.
    let most = 0.9 * sliding(stroke).hertz().unwrap().p0 * 4.0 * stroke;
    let energy = |threshold: f64| {
        let alpha = k / 0.9;
        lost(
            stroke,
            BodyWear::with_law(DissipatedEnergy { alpha, threshold }),
            |_| (),
        )
    };
    assert!(energy(1.1 * most) == 0.0);
    let part = energy(0.1 * most) / whole;
    assert!(part > 0.7 && part < 0.95, "{part}");
}

#[test]
fn every_layer_wears_by_its_own_law() {
    let (W, stroke, k) = (18.5e3, 1e-6, 1e-14);
    let grid = Grid::strip(0.4e-3, 64, 1.0).unwrap();
    let mut scene = scene(cylinder(6e-3), grid, to_and_fro(W, stroke, 1), 0.5);
    let layer = |E: f64| Coating {
        material: Elastic { E, nu: 0.25 },
        thickness: 20e-9,
    };
    // Three layers of laws k, 0 and 5 k: wear ends at the bottom of the first, wherever there is
    // contact.
    scene.body2.coatings = vec![layer(300e9), layer(250e9)];
    let law = |k: f64| -> Arc<dyn Law> { Arc::new(Archard { k, threshold: 0.0 }) };
    let laws = vec![law(k), law(0.0), law(5.0 * k)];
    let body2 = BodyWear { laws, share: None };
    let mut wear = wear([BodyWear::default(), body2], 4e4, Cycling::Sliding);
    (wear.worn_through, wear.jumps) = (WornThrough::GoOn, Jumps::Number(400));
    let (_, jumps) = run(&scene, &wear);
    let depth = 1e9 * jumps.last().unwrap().depth[1];
    // A jump may wear a cell past the bottom of the layer that it began in.
    assert!((20.0..21.5).contains(&depth), "{depth} nm");
}

#[test]
fn a_rig_gives_way_by_what_friction_pulls() {
    let (W, mu, k, u, cycles) = (18.5e3, 0.9, 2e-14, 5e-6, 1e3);
    let K = mu * W / 2e-6;
    let slid = 4.0 * (u - mu * W / K);
    let mut rigged = sliding(u);
    rigged.path.rig_stiffness = Some(K);
    let found = lost_in(&rigged, archard(k), |_| ());
    assert_near(found, k * W * slid * cycles, 1e-7);
    // Through increments: as if the bodies themselves were moved by what is left of the shift.
    let (W, mu) = (50.0, 0.6);
    let K = mu * W / 2e-6;
    let energy = |stroke: f64, rig_stiffness: f64| {
        let grid = Grid::centred(0.4e-3, 16).unwrap();
        let mut scene = scene(
            Shape::Sphere { R: 10e-3 },
            grid,
            to_and_fro(W, stroke, 4),
            mu,
        );
        scene.path.rig_stiffness = Some(rig_stiffness).filter(|K| K.is_finite());
        let mut wear = wear([BodyWear::default(), archard(k)], 100.0, Cycling::March);
        wear.jumps = Jumps::Number(1);
        let (run, jumps) = run(&scene, &wear);
        let block = run.block();
        let ends = block.friction_loop.iter().map(|at| at[0]);
        let ends = ends.fold(0.0, |m: f64, u| m.max(u.abs()));
        // The shifts of the loop are those of the rig.
        assert_near(ends, stroke, 1e-9);
        jumps.last().unwrap().dissipated
    };
    assert_near(energy(u, K), energy(u - mu * W / K, f64::INFINITY), 1e-3);
}

#[test]
fn wear_follows_a_load_that_changes_within_the_cycle() {
    // From W to a part of it and back as the bodies slide to and fro: k times the mean W.
    let (W, mu, k, stroke, cycles, part) = (50.0, 0.6, 2e-14, 10e-6, 50.0, 0.4);
    let grid = Grid::centred(0.4e-3, 24).unwrap();
    let mut scene = scene(
        Shape::Sphere { R: 10e-3 },
        grid,
        to_and_fro(W, stroke, 8),
        mu,
    );
    scene.path.branches[2].to.W = part * W;
    let mean = 0.5 * (1.0 + part) * W;
    for cycling in [Cycling::Sliding, Cycling::March] {
        let mut wear = wear([archard(k), archard(0.5 * k)], cycles, cycling);
        wear.jumps = Jumps::Number(2);
        let per = Some([k / mu, 0.5 * k / mu]);
        let jumps = Audit::new("changing W", &scene, &wear, per)
            .run(&wear)
            .unwrap();
        let found = jumps.last().unwrap().volume[0];
        let slides = k * mean * 4.0 * stroke * cycles;
        if cycling == Cycling::Sliding {
            assert_near(found, slides, 1e-7);
        } else {
            // Until everything slips after a turn the bodies give way elastically.
            let gives = scene.hertz().unwrap();
            let onset = 3.0 * mu * W / (16.0 * gives.a) * 2.0 * (2.0 - 0.3) * 2.6 / 200e9;
            let least = 1.0 - 2.0 * onset / stroke;
            let part = found / slides;
            assert!(part < 1.0 && part > least, "{part}, {least}");
        }
    }
}

#[test]
fn jumps_too_long_by_a_thousand_stay_sound_in_partial_slip() {
    let grid = Grid::centred(0.5e-3, 20).unwrap();
    let scene = scene(Shape::Sphere { R: 10e-3 }, grid, pulled(50.0, 20.0, 2), 0.6);
    let mut once = wear([archard(2e-14), archard(3e-14)], 1e8, Cycling::March);
    once.jumps = Jumps::Number(1);
    let per = Some([2e-14, 3e-14].map(|k| k / 0.6));
    Audit::new("one jump", &scene, &once, per)
        .run(&once)
        .unwrap();
}
