//! From stress to decision: the fretting-fatigue rig of titanium, layers, averages, cycles that are
//! not settled.

#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use contact_assess::{
    Averaging, CriterionJudge, Distance, Judge, Judged, Site, YieldJudge, find_worst_point,
    inclination, judge, judge_means, layer_materials,
};
use contact_core::march::solve;
use contact_core::scene::{
    Body, Coating, Elastic, Friction, Grid, LoadPath, Profile, ResidualStress, Scene, Settings,
    Shape,
};
use contact_subsurface::{CycleRecorder, CycleSource, note_on_cycle, traction_drift};
use contact_subsurface::{Line, Side, default_depths};
use fatigue::{Material, PointResult, Search};

const TITANIUM: Elastic = Elastic { E: 116e9, nu: 0.33 };
const TIN: Elastic = Elastic { E: 450e9, nu: 0.25 };
/// Half width of the contact \[m\].
const A: f64 = 6.255e-4;
const BELOW: Line = Line::AlongX(0.0);

/// Pads of 50 mm radius on a flat, 400 N/mm, shear of +-0.6 mu P in phase with a bulk stress of 0
/// to 350 MPa.
fn rig(n: usize, coatings: Vec<Coating>, branches: usize) -> Scene {
    let (W, mu) = (4e5, 0.6);
    let T = 0.6 * mu * W;
    let path = (0..branches).fold(LoadPath::start().normal(W, 10), |path, k| {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let to = move |loads: &mut contact_core::scene::Loads| {
            loads.T_x = sign * T;
            loads.sigma_B = if sign > 0.0 { 350e6 } else { 0.0 };
        };
        path.change_to(to, 12)
    });
    let mut flat = Body::homogeneous(TITANIUM, Shape::Flat);
    flat.coatings = coatings;
    Scene {
        title: "fretting fatigue".into(),
        body1: Body::homogeneous(
            TITANIUM,
            Shape::Cylinder {
                R: 0.05,
                length: f64::INFINITY,
                angle: 0.0,
            },
        ),
        body2: flat,
        friction: Friction::coulomb(mu),
        grid: Grid::strip(2.6 * A, n, 1.0).unwrap(),
        path,
        settings: Settings::default(),
    }
}

fn material(name: &str, E: f64) -> Material {
    let numbers = [
        ("E", E),
        ("nu", 0.33),
        ("s_f", 1.6e9),
        ("b", -0.095),
        ("e_f", 0.5),
        ("c", -0.6),
        ("s_D", 5e8),
        ("t_D", 3e8),
    ];
    let sourced = numbers.map(|(name, value)| (name.to_owned(), value, "made up".to_owned()));
    Material::new(name, name, sourced).unwrap()
}

fn recorded(scene: &Scene) -> CycleRecorder {
    let last = *scene.path.cycles().last().unwrap();
    let mut kept = CycleRecorder::new(Side::Body2, last);
    solve(scene, &mut kept).unwrap();
    kept
}

fn site<'a>(
    scene: &'a Scene,
    cycle: &'a dyn CycleSource,
    residual: &'a ResidualStress,
) -> Site<'a> {
    Site {
        body: &scene.body2,
        side: Side::Body2,
        grid: &scene.grid,
        residual,
        cycle,
        stop: Arc::default(),
        cache: Arc::default(),
    }
}

fn swt(body: &Body, given: Vec<Option<Material>>) -> CriterionJudge {
    let materials = layer_materials(body, given).unwrap();
    CriterionJudge::new("smith_watson_topper", body, &materials, Search::default()).unwrap()
}

fn section<J: Judge + Clone>(site: &Site<'_>, of: &J) -> Judged<J::Judgement> {
    let depths = default_depths(site.body, A, 2.0 * A, 1.0).unwrap();
    judge(site, BELOW, &depths, std::slice::from_ref(of))
        .unwrap()
        .remove(0)
}

/// The closed form has 3.348 MPa at the trailing rim, where the samples have 3.0 at 128 cells: the
/// error of the value there covers it.
#[test]
fn worst_point_of_the_titanium_rig() {
    for n in [128, 200, 256] {
        let scene = rig(n, vec![], 5);
        let cycle = recorded(&scene);
        let none = ResidualStress::default();
        let site = site(&scene, &cycle, &none);
        let of = swt(&scene.body2, vec![Some(material("titanium", 116e9))]);
        let judged = section(&site, &of);
        let worst = find_worst_point(&site, &judged, &of, 0).unwrap().unwrap();
        assert!(
            (worst.extremum.value / 3.348e6 - 1.0).abs() < 0.015,
            "{n}: {worst:?}"
        );
        assert!(
            (worst.extremum.value - 3.348e6).abs() < worst.extremum.error.sum().max(0.01 * 3.348e6),
            "{worst:?}"
        );
        assert!(
            (worst.extremum.x.abs() / A - 1.0).abs() < 0.01 && worst.extremum.depth.z < 0.01 * A,
            "{worst:?}"
        );
        let angle = inclination(worst.judgement.normal, BELOW).to_degrees();
        assert!(angle.abs() < 30.0, "{angle}");
        let mean = Distance {
            method: Averaging::Line,
            length: 20e-6,
            layer: 0,
        };
        let means = judge_means(&site, BELOW, &mean, &of).unwrap();
        let most = means.iter().flatten().map(|f| f.value).fold(0.0, f64::max);
        assert!(
            most < worst.extremum.value && most > 0.2 * worst.extremum.value,
            "{most}"
        );
        assert!(traction_drift(&cycle).unwrap().unwrap() < 0.02);
    }
}

/// A material belongs to the substrate; the distance lies in the layer that is named.
#[test]
fn below_a_coating() {
    let coating = Coating {
        material: TIN,
        thickness: 20e-6,
    };
    let scene = rig(64, vec![coating], 3);
    let cycle = recorded(&scene);
    let layers = [-2.5e9, 0.0].map(Profile::uniform);
    let residual = ResidualStress::from_profiles(&scene.body2, &layers).unwrap();
    let site = site(&scene, &cycle, &residual);
    let of = swt(&scene.body2, vec![Some(material("titanium", 150e9))]);
    assert!(!of.judges(0) && of.judges(1));
    assert!(
        of.notes.len() == 1 && of.notes[0].contains("the scene has E = 116"),
        "{:?}",
        of.notes
    );
    let judged = section(&site, &of);
    assert!(
        judged
            .depths
            .iter()
            .zip(&judged.judgements)
            .all(|(d, f)| f.is_some() == (d.layer == 1))
    );
    assert!(find_worst_point(&site, &judged, &of, 0).unwrap().is_none());
    let point = find_worst_point(&site, &judged, &of, 1).unwrap().unwrap();
    assert!(
        point.extremum.depth.layer == 1 && point.extremum.depth.z >= 20e-6,
        "{point:?}"
    );
    let in_layer = |layer, length| Distance {
        method: Averaging::Line,
        length,
        layer,
    };
    let below = judge_means(&site, BELOW, &in_layer(1, 20e-6), &of).unwrap();
    let most = below
        .iter()
        .flatten()
        .map(|f: &PointResult| f.value)
        .fold(0.0, f64::max);
    assert!(
        most > 0.1 * point.extremum.value && most < 1.001 * point.extremum.value,
        "{most} {point:?}"
    );
    let refused = judge_means(&site, BELOW, &in_layer(0, 20e-6), &of)
        .unwrap_err()
        .to_string();
    assert!(
        refused.contains("`layer` counts from 0; the substrate is 1"),
        "{refused}"
    );
    assert!(layer_materials(&scene.body2, vec![None; 3]).is_err());
    // Three branches end in the cycle that begins with the first shear.
    let much = traction_drift(&cycle).unwrap().unwrap();
    assert!(much > 0.02, "{much}");
    let note = note_on_cycle(&cycle).unwrap().unwrap();
    assert!(
        note.contains(&format!("by up to {:.0} %", 100.0 * much)),
        "{note}"
    );
    let yields = YieldJudge {
        s_y: vec![None, Some(9e8)],
        residual: ResidualStress::default(),
        safety_factor: |found| found.von_mises,
    };
    let judged = section(&site, &yields);
    let least = find_worst_point(&site, &judged, &yields, 1)
        .unwrap()
        .unwrap();
    assert!(
        least.judgement.von_mises > 0.5 && least.judgement.shakedown >= least.judgement.von_mises
    );
}
