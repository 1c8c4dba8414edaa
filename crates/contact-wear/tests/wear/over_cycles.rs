//! What changes over cycles: coefficients, friction; where a life ends; runs that begin on worn
//! surfaces.

use std::sync::Arc;

use contact_core::Error;
use contact_core::scene::{
    CellHistory, Coating, Elastic, Friction, FrictionHistory, FrictionLaw, Grid, History, LawError,
    LoadPath, Scene, Shape,
};
use contact_store::{WearStore, read_worn, resume_wear, resume_wear_with_laws};
use contact_wear::{
    Archard, BodyWear, CellCycle, Cycling, DissipatedEnergy, EventKind, Factor, FactorVariable,
    Jumps, Law, Varying, Wear, WearRun, WornStart,
};

use crate::audit::Audit;
use crate::bench::{archard, cylinder, pulled, run, scene, to_and_fro, wear};
use crate::files::files;

const W: f64 = 18.5e3;
const STROKE: f64 = 2e-6;

/// A cylinder that slides to and fro at one place.
fn sliding() -> Scene {
    let grid = Grid::strip(0.4e-3, 96, 1.0).unwrap();
    scene(cylinder(6e-3), grid, to_and_fro(W, STROKE, 1), 0.9)
}

fn partial_slip() -> Scene {
    let grid = Grid::centred(0.5e-3, 16).unwrap();
    scene(Shape::Sphere { R: 10e-3 }, grid, pulled(50.0, 20.0, 3), 0.6)
}

fn varying(law: impl Law + 'static, of: FactorVariable, table: &[(f64, f64)]) -> BodyWear {
    let table = table.to_vec();
    BodyWear::with_law(Varying {
        law: Arc::new(law),
        factor: Factor {
            variable: of,
            table,
        },
    })
}

fn near(found: f64, asked: f64, part: f64) {
    let off = (found / asked - 1.0).abs();
    assert!(off < part, "{found:e}, not {asked:e} ({off:e})");
}

#[test]
fn a_coefficient_follows_cycles_pressure_and_power() {
    let k = 2e-14;
    let lost = |body: BodyWear, frequency: Option<f64>, cycles: f64| {
        let mut wear = wear([BodyWear::default(), body], cycles, Cycling::Sliding);
        (wear.frequency, wear.jumps) = (frequency, Jumps::Number(20));
        let (_, jumps) = run(&sliding(), &wear);
        jumps.last().unwrap().volume[1]
    };
    let law = Archard { k, threshold: 0.0 };
    let per_cycle = k * W * 4.0 * STROKE;
    // From once to three times within 1000 cycles: twice on average.
    let of_cycles = varying(law, FactorVariable::Cycles, &[(0.0, 1.0), (1000.0, 3.0)]);
    near(
        lost(of_cycles, None, 1000.0),
        2.0 * per_cycle * 1000.0,
        1e-4,
    );
    // A coefficient that goes as 1/p wears alike wherever there is contact: p is the mean of the
    // way.
    let p0 = sliding().hertz().unwrap().p0;
    let table: Vec<(f64, f64)> = (1..400)
        .map(|n| 0.01 * f64::from(n) * p0)
        .map(|p| (p, p0 / p))
        .collect();
    let mut one = wear(
        [
            BodyWear::default(),
            varying(law, FactorVariable::Pressure, &table),
        ],
        1.0,
        Cycling::Sliding,
    );
    one.jumps = Jumps::Explicit(1);
    let (run, _) = run(&sliding(), &one);
    let worn = run.block().worn2;
    let at = |x: f64| worn[(((x / 0.4e-3 + 0.5) * 96.0) as usize, 0)];
    near(at(1e-6), k * p0 * 4.0 * STROKE, 0.02);
    near(at(0.03e-3), k * p0 * 4.0 * STROKE, 0.02);
}

#[test]
fn friction_that_changes_over_cycles_acts_over_jumps() {
    let history = |of, table: &[(f64, f64)]| {
        Some(FrictionHistory {
            of,
            table: table.to_vec(),
        })
    };
    // mu falls to a half within the run: 3/4 of the energy.
    for cycling in [Cycling::Sliding, Cycling::March] {
        let mut scene = sliding();
        scene.path = to_and_fro(W, 16.0 * STROKE, 3);
        let mut wear = wear([archard(1e-16), archard(1e-16)], 1000.0, cycling);
        wear.jumps = Jumps::Number(8);
        let (_, plain) = run(&scene, &wear);
        scene.friction.history = history(History::Cycles, &[(0.0, 1.0), (1000.0, 0.5)]);
        let (_, falls) = run(&scene, &wear);
        let energy = |jumps: &[contact_wear::Jump]| jumps.last().unwrap().dissipated;
        near(energy(&falls), 0.75 * energy(&plain), 0.02);
    }
    // By the way slipped: the factor is that of the way in all cycles so far, not of those solved.
    let mut scene = sliding();
    scene.path = to_and_fro(W, 16.0 * STROKE, 3);
    let mut wear = wear([archard(1e-16), archard(1e-16)], 1000.0, Cycling::March);
    wear.jumps = Jumps::Number(8);
    scene.friction.history = history(History::Slip, &[(0.0, 1.0), (64.0 * STROKE * 1000.0, 0.5)]);
    let (run_, falls) = run(&scene, &wear);
    let first = falls[0].dissipated / falls[0].cycles;
    let last = falls.last().unwrap();
    near(last.dissipated_per_cycle, 0.53 * first, 0.08);
    let slid = run_.block().slid;
    near(
        slid.iter().fold(0.0, |m: f64, s| m.max(*s)),
        62.4 * STROKE * 1000.0,
        0.05,
    );
}

#[test]
fn an_event_is_told_at_its_cycle_however_long_the_jumps() {
    let mut scene = sliding();
    let material = Elastic { E: 400e9, nu: 0.25 };
    let thickness = 2e-6;
    scene.body2.coatings = vec![Coating {
        material,
        thickness,
    }];
    let told = |jumps: Jumps| {
        let mut wear = wear([BodyWear::default(), archard(1e-14)], 8e4, Cycling::Sliding);
        (wear.jumps, wear.event_depth_fraction) = (jumps, 0.35);
        let (run, jumps) = run(&scene, &wear);
        let event = run.state().events[0];
        assert!(event.kind == EventKind::Thinned);
        (event.cycles, jumps)
    };
    let (exact, fine) = told(Jumps::Number(120));
    let end = fine
        .iter()
        .find(|j| j.depth[1] >= 0.35 * thickness)
        .unwrap();
    assert!(end.cycles >= exact && end.cycles - end.length <= exact);
    for jumps in [Jumps::Number(3), Jumps::Number(7), Jumps::default()] {
        let (found, _) = told(jumps);
        near(found, exact, 0.02);
    }
}

#[test]
fn a_run_goes_on_from_worn_surfaces() {
    for (scene, cycling, cycles) in [
        (sliding(), Cycling::Sliding, 4e4),
        (partial_slip(), Cycling::March, 4e4),
    ] {
        let energy = || {
            BodyWear::with_law(DissipatedEnergy {
                alpha: 2e-14,
                threshold: 0.0,
            })
        };
        let with = |cycles, jumps| {
            let mut wear = wear([energy(), energy()], cycles, cycling);
            wear.jumps = Jumps::Number(jumps);
            wear
        };
        let (_, whole) = run(&scene, &with(cycles, 12));
        let (first, jumps) = run(&scene, &with(0.5 * cycles, 6));
        let block = first.block();
        let start = WornStart {
            cycles: block.cycles,
            dissipated: jumps.last().unwrap().dissipated,
            worn: [block.worn1, block.worn2],
            energy: [block.energy1, block.energy2],
            slid: block.slid,
            bed: Some(block.bed),
            ejected: block.ejected,
        };
        let mut second =
            WearRun::from_worn(&scene, &with(0.5 * cycles, 6), &start, &Arc::default()).unwrap();
        let mut last = None;
        while let Some(jump) = second.advance() {
            last = Some(jump.unwrap());
        }
        let (last, whole) = (last.unwrap(), whole.last().unwrap());
        near(last.cycles, cycles, 1e-12);
        near(last.dissipated, whole.dissipated, 2e-3);
        near(last.depth[1], whole.depth[1], 0.02);
        // The energy per area of the fields is that of the run, and alpha times it the depth.
        let block = second.block();
        let sum = block.energy2.sum() * scene.grid.cell_area();
        near(sum, last.dissipated, 1e-9);
        near(block.worn2.sum(), 2e-14 * block.energy2.sum(), 1e-9);
    }
}

#[test]
fn what_is_left_open_is_chosen() {
    for (given, cycling) in [
        (sliding(), Cycling::Sliding),
        (partial_slip(), Cycling::March),
    ] {
        let mut scene = given.clone();
        for branch in &mut scene.path.branches {
            branch.increments = None;
        }
        let mut open = wear([archard(1e-14), archard(1e-14)], 100.0, cycling);
        (open.first_branch, open.jumps) = (None, Jumps::Number(1));
        let (chosen, jumps) = run(&scene, &open);
        assert_eq!(chosen.wear().first_branch, Some(2));
        assert!(!chosen.scene().path.has_open_increments());
        open.first_branch = Some(2);
        let (_, asked) = run(&given, &open);
        near(jumps[0].volume[0], asked[0].volume[0], 0.1);
    }
    let mut never = partial_slip();
    never.path = LoadPath::start().normal(50.0, 1).tangential(&[20.0], 3);
    let open = Wear::new([archard(1e-14), archard(1e-14)], 100.0);
    let told = WearRun::new(&never, &open, &Arc::default()).err().unwrap();
    assert!(told.to_string().contains("closed cycle"), "{told}");
}

/// A law of one's own.
#[derive(Debug)]
struct Own;

impl Law for Own {
    fn depth(&self, cycle: &CellCycle<'_>, depth: &mut [f64]) -> Result<(), Error> {
        for (depth, way) in depth.iter_mut().zip(cycle.pressure_times_slip) {
            *depth = 1e-14 * way;
        }
        Ok(())
    }
}

/// Friction that falls with the energy of all cycles.
#[derive(Debug)]
struct Softens;

impl FrictionLaw for Softens {
    fn coefficients(&self, cells: &CellHistory<'_>, mu: &mut [f64]) -> Result<(), LawError> {
        for (mu, energy) in mu.iter_mut().zip(cells.dissipated) {
            *mu = 0.4 + 0.2 * (-energy / 1e9).exp();
        }
        Ok(())
    }
}

#[test]
fn runs_of_tables_and_of_functions_are_taken_up_to_the_same_bytes() {
    let table = |of| {
        varying(
            Archard {
                k: 1e-14,
                threshold: 0.0,
            },
            of,
            &[(0.0, 1.0), (1e5, 0.5)],
        )
    };
    let mut sticks = partial_slip();
    sticks.friction = Friction {
        history: Some(FrictionHistory {
            of: History::Dissipated,
            table: vec![(0.0, 1.0), (1e9, 0.9)],
        }),
        ..sticks.friction
    };
    let softens = Scene {
        friction: Friction::from_law(sticks.friction.mu, Softens),
        ..partial_slip()
    };
    let cases = [
        (
            sliding(),
            Cycling::Sliding,
            [table(FactorVariable::PowerDensity), BodyWear::with_law(Own)],
        ),
        (
            sticks,
            Cycling::March,
            [table(FactorVariable::Energy), table(FactorVariable::Cycles)],
        ),
        (
            softens,
            Cycling::March,
            [table(FactorVariable::Energy), table(FactorVariable::Cycles)],
        ),
    ];
    for (scene, cycling, bodies) in cases {
        let folder = tempfile::tempdir().unwrap();
        let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
        let mut wear = wear(bodies.clone(), 2e4, cycling);
        (wear.jumps, wear.frequency, wear.debris_kept) = (Jumps::Number(4), Some(5.0), 0.8);
        let stop = Arc::default();
        let write = |place: &std::path::Path, jumps: usize| {
            let mut run = WearRun::new(&scene, &wear, &stop).unwrap();
            let mut store = WearStore::create(place, false).unwrap();
            for _ in 0..jumps {
                let Some(jump) = run.advance() else { break };
                jump.unwrap();
                store.write(&mut run).unwrap();
            }
            if jumps > 4 {
                store.finish(&run, "done").unwrap();
            }
        };
        write(&whole, 9);
        write(&broken, 2);
        let own = bodies.map(|body| body.user_laws());
        if scene == sliding() {
            let told = resume_wear(&broken, None, &stop).map(drop).unwrap_err();
            assert!(told.to_string().contains("given again"), "{told}");
        }
        let law = scene.friction.law.as_ref();
        if law.is_some() {
            let told = resume_wear_with_laws(&broken, &own, None, &stop).map(drop);
            let told = told.unwrap_err().to_string();
            assert!(told.contains("given again"), "{told}");
        }
        let (mut run, mut store) = resume_wear_with_laws(&broken, &own, law, &stop)
            .unwrap()
            .unwrap();
        while let Some(jump) = run.advance() {
            jump.unwrap();
            store.write(&mut run).unwrap();
        }
        store.finish(&run, "done").unwrap();
        assert!(files(&whole) == files(&broken));
        let worn = read_worn(&whole).unwrap();
        assert!(worn.worn[1] == run.block().worn2 && worn.cycles == 2e4);
    }
}

#[test]
fn debris_and_tables_balance_in_partial_slip() {
    let per = Some([2e-14, 3e-14]);
    let energy = |alpha| {
        BodyWear::with_law(DissipatedEnergy {
            alpha,
            threshold: 0.0,
        })
    };
    let scene = partial_slip();
    let mut wear = wear([energy(2e-14), energy(3e-14)], 1e5, Cycling::March);
    (wear.debris_kept, wear.jumps) = (0.85, Jumps::Number(5));
    let jumps = Audit::new("debris", &scene, &wear, per).run(&wear).unwrap();
    let last = jumps.last().unwrap();
    near(last.debris, 0.85 * (last.volume[0] + last.volume[1]), 1e-12);
}
