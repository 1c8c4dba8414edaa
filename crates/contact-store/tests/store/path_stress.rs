//! Stress over a load path, energy of loops, files.

#![allow(clippy::unwrap_used)]

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::march::{Increment, March, Observer, Status, solve};
use contact_core::scene::{Body, Elastic, Friction, Grid, LoadPath, Scene, Settings, Shape};
use contact_reference::{CattaneoMindlin, hertz};
use contact_store::{ImageData, StressStore, VolumeSink, write_volume};
use contact_subsurface::{
    Direction, Envelope, Largest, Line, LoopPoint, Probe, Search, Section, Side, Slices, States,
    Stream, depths, find_measure, largest_of_samples, loops,
};
use ndarray::Array2;

const STEEL: Elastic = Elastic { E: 210e9, nu: 0.0 };
const MU: f64 = 0.3;

/// A sphere of the substrate's material; shear kernels isotropic for nu = 0.
fn scene(n: usize, path: LoadPath) -> Scene {
    let contact = hertz(0.018, STEEL, STEEL, path.W_max());
    Scene {
        title: "sphere".into(),
        body1: Body::homogeneous(STEEL, Shape::Sphere { R: 0.018 }),
        body2: Body::homogeneous(STEEL, Shape::Flat),
        friction: Friction::coulomb(MU),
        grid: Grid::centred(2.4 * contact.a, n).unwrap(),
        path,
        settings: Settings::default(),
    }
}

#[test]
fn loops_are_mindlins() {
    let W = 1e3;
    for share in [0.5, 0.9] {
        let T = share * MU * W;
        let path = LoadPath::start().normal(W, 1).tangential(&[T, -T, T], 250);
        let scene = scene(64, path);
        let increments = solve(&scene, &mut ()).unwrap();
        let found = scene.path.cycles();
        assert_eq!(found, [(2, 3)]);
        let history: Vec<_> = increments
            .iter()
            .map(|i| LoopPoint::new(i, &scene.grid, Direction::X))
            .collect();
        let cycle = loops(&scene.path, Direction::X, &history)[0];
        assert_eq!(
            loops(&scene.path, Direction::X, &history[..history.len() - 1]),
            []
        );
        let closed = CattaneoMindlin::new(scene.hertz().unwrap(), STEEL, STEEL, MU);
        let close = |ours: f64, exact: f64, tolerance: f64, what: &str| {
            assert!(
                (ours / exact - 1.0).abs() < tolerance,
                "{what}: {ours} {exact}"
            );
        };
        close(cycle.T, T, 1e-9, "force");
        close(cycle.delta, closed.shift_loading(T), 0.01, "shift");
        close(cycle.dissipated, closed.loop_energy(T), 0.03, "energy");
        close(
            cycle.energy_ratio(),
            closed.energy_ratio(T),
            0.03,
            "energy ratio",
        );
        // No-slip stiffness; the first increment of a branch slips a little.
        let stiffness = 8.0 * closed.hertz.a * closed.G_star;
        close(cycle.stiffness, stiffness, 0.03, "stiffness");
        close(
            cycle.opening,
            closed.shift_unloading(0.0, T),
            0.03,
            "opening",
        );
        assert_eq!(cycle.status, Status::PartialSlip);
    }
}

/// Keeps every increment's tractions, to do what the stream avoids.
#[derive(Default)]
struct Keep(Vec<[Array2<f64>; 3]>);

impl Observer for Keep {
    fn on_increment(&mut self, march: &March, _: &Increment) -> Result<(), Error> {
        let f = march.fields();
        self.0.push([f.q_x, f.q_y, f.p]);
        Ok(())
    }
}

#[test]
fn envelope_is_that_of_all_increments() {
    let (W, T) = (1e3, 0.8 * MU * 1e3);
    let path = LoadPath::start().normal(W, 3).tangential(&[T, -T, T], 35);
    let scene = scene(24, path);
    let a = scene.hertz().unwrap().a;
    let z: Vec<f64> = (0..12).map(|i| 0.1 * a * f64::from(i)).collect();
    let depths = depths(&scene.body2, &z).unwrap();
    let measures = ["von_mises", "s_xx"].map(|name| *find_measure(name).unwrap());
    let envelope = Envelope {
        measures: measures.to_vec(),
        cycles: scene.path.cycles(),
    };
    let line = Line::AlongX(0.0);
    let mut stream = Stream::new(
        &scene.body2,
        Side::Body2,
        &scene.grid,
        Some(line),
        depths.clone(),
        envelope,
    )
    .unwrap();
    let mut keep = Keep::default();
    let mut march = March::new(&scene).unwrap();
    let mut points = Vec::new();
    while let Some(increment) = march.advance() {
        let increment = increment.unwrap();
        stream.on_increment(&march, &increment).unwrap();
        keep.on_increment(&march, &increment).unwrap();
        points.push(increment);
    }
    let (_, kept) = stream.finish().unwrap();
    let states: Vec<_> = keep
        .0
        .iter()
        .map(|[q_x, q_y, p]| Tractions {
            q_x: q_x.as_slice(),
            q_y: q_y.as_slice(),
            p: p.as_slice(),
        })
        .collect();
    let all = Section::new(&scene.body2, Side::Body2, &scene.grid, line, &states)
        .unwrap()
        .stress(&depths)
        .unwrap();
    let cycle = envelope_range(&points, (2, 3));
    for (k, kept) in kept.iter().enumerate() {
        for (m, measure) in measures.iter().enumerate() {
            for i in 0..scene.grid.nx {
                let values: Vec<f64> = all
                    .iter()
                    .map(|s| (measure.value)(&std::array::from_fn(|c| s[(c, k, i)])))
                    .collect();
                let max = |v: &[f64]| v.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let min = |v: &[f64]| v.iter().copied().fold(f64::INFINITY, f64::min);
                let at = (m, i);
                let scale = 1e-12 * scene.hertz().unwrap().p0;
                assert!((kept.path.max[at] - max(&values)).abs() <= scale);
                assert!((kept.path.min[at] - min(&values)).abs() <= scale);
                let first = kept.path.increment_of_max[at];
                assert!((values[first - 1] - max(&values)).abs() <= scale);
                let part = &values[cycle.clone()];
                let (amplitude, mean) = (kept.cycles[0].amplitude()[at], kept.cycles[0].mean()[at]);
                assert!((amplitude - (max(part) - min(part)) / 2.0).abs() <= scale);
                assert!((mean - f64::midpoint(max(part), min(part))).abs() <= scale);
            }
        }
    }
}

/// Places of the increments of the branches `first` to `last`.
fn envelope_range(
    increments: &[Increment],
    (first, last): (usize, usize),
) -> std::ops::Range<usize> {
    let inside = |i: &Increment| (first..=last).contains(&i.point.branch);
    let start = increments.iter().position(inside).unwrap();
    start..start + increments.iter().filter(|i| inside(i)).count()
}

#[test]
fn planes_stream_as_lines_do_and_the_largest_values_are_known() {
    let (W, T) = (1e3, 0.8 * MU * 1e3);
    let path = LoadPath::start().normal(W, 3).tangential(&[T, -T, T], 15);
    let scene = scene(24, path);
    let a = scene.hertz().unwrap().a;
    let z: Vec<f64> = (0..40).map(|i| 0.03 * a * f64::from(i)).collect();
    let depths = depths(&scene.body2, &z).unwrap();
    let measures = vec![*find_measure("von_mises").unwrap()];
    let along: Vec<f64> = (0..24).map(|i| scene.grid.x(i)).collect();
    let row = 9;
    let line = Line::AlongX(scene.grid.y(row));
    let envelope = || Envelope {
        measures: measures.clone(),
        cycles: scene.path.cycles(),
    };
    let largest = Largest {
        measures: measures.clone(),
        line,
        along: along.clone(),
    };
    let both = (envelope(), largest.clone());
    let (body, grid) = (&scene.body2, &scene.grid);
    let mut on_line =
        Stream::new(body, Side::Body2, grid, Some(line), depths.clone(), both).unwrap();
    let few = vec![depths[0], depths[16]];
    let mut on_planes =
        Stream::new(body, Side::Body2, grid, None, few.clone(), envelope()).unwrap();
    let mut march = March::new(&scene).unwrap();
    let mut expected = Vec::new();
    while let Some(increment) = march.advance() {
        let increment = increment.unwrap();
        on_line.on_increment(&march, &increment).unwrap();
        on_planes.on_increment(&march, &increment).unwrap();
        let f = march.fields();
        let state = Tractions {
            q_x: f.q_x.as_slice(),
            q_y: f.q_y.as_slice(),
            p: f.p.as_slice(),
        };
        let section = Section::new(body, Side::Body2, grid, line, &[state]).unwrap();
        let stress = section.stress(&depths).unwrap().remove(0);
        let values = measures[0].on_lines(&stress);
        expected.push(largest_of_samples(&values.view(), &depths, line, &along).unwrap());
    }
    let (_, kept) = on_line.finish().unwrap();
    let (lines, tops): (Vec<_>, Vec<_>) = kept.into_iter().unzip();
    let scale = 1e-9 * scene.hertz().unwrap().p0;
    let found = largest.over_depths(&tops);
    assert_eq!(found.len(), expected.len());
    for ((moment, of), expected) in found.iter().zip(&expected) {
        let found = of[0].unwrap();
        assert!((found.value - expected.value).abs() < scale, "{moment:?}");
        assert!(
            (found.depth.z - expected.depth.z).abs() < 1e-6 * a,
            "{moment:?}"
        );
        // Below the surface while the shear is small.
        assert!(
            moment.increment != 3 || found.depth.z > 0.3 * a,
            "{found:?}"
        );
    }
    // A row of the planes is the line.
    let (_, planes) = on_planes.finish().unwrap();
    for (plane, line) in planes.iter().zip([&lines[0], &lines[16]]) {
        for i in 0..24 {
            let cell = (0, i * 24 + row);
            assert!((plane.path.max[cell] - line.path.max[(0, i)]).abs() < scale);
            let amplitudes = [
                plane.cycles[0].amplitude()[cell],
                line.cycles[0].amplitude()[(0, i)],
            ];
            assert!((amplitudes[0] - amplitudes[1]).abs() < scale);
        }
    }
}

#[test]
fn volumes_are_stored_and_drawn() {
    let body = Body::homogeneous(STEEL, Shape::Flat);
    let grid = Grid::from_spacing((7, 5), (1e-5, 2e-5)).unwrap();
    let p = grid.map(|x, y| 1e9 * (1.0 - 1e9 * (x * x + y * y)).max(0.0) + 1e12 * x.max(0.0));
    let states = [Tractions {
        p: p.as_slice(),
        ..Tractions::default()
    }];
    let z: Vec<f64> = (0..4).map(|i| 5e-6 * f64::from(i)).collect();
    let depths = depths(&body, &z).unwrap();
    let probes = ["von_mises", "u_z", "s_zz", "u_x"];
    let probes = probes.map(|name| Probe::find(name, "of").unwrap());
    let folder = std::env::temp_dir().join(format!("pyfret-volume-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for side in [Side::Body1, Side::Body2] {
        let slices = Slices::new(&body, side, &grid, &states).unwrap();
        let search = Search::new(&body, side, &grid, None, &States::from(&states)).unwrap();
        let (file, store) = (
            folder.join(format!("{side:?}.vti")),
            folder.join(format!("{side:?}.zarr")),
        );
        let image = ImageData::create(&file, &grid, side, &depths, &probes).unwrap();
        let group =
            StressStore::create(&store, "test", &grid, side, &depths, None, &probes).unwrap();
        let sinks: [&dyn VolumeSink; 2] = [&image, &group];
        let largest = write_volume(&slices, &depths, &[], &probes, &sinks, Some(&search)).unwrap();
        image.finish().unwrap();
        group.finish().unwrap();
        assert!(ImageData::create(&file, &grid, side, &depths, &probes).is_err());
        assert!(StressStore::create(&store, "test", &grid, side, &depths, None, &probes).is_err());
        let bytes = std::fs::read(&file).unwrap();
        let start = bytes.windows(2).position(|w| w == b"\n_").unwrap() + 2;
        let block = 8 + 4 * 7 * 5 * 4;
        assert_eq!(bytes[start..start + 8], (block as u64 - 8).to_le_bytes());
        assert!(bytes[start + 4 * block..].starts_with(b"\n  </AppendedData>"));
        for (k, depth) in depths.iter().enumerate() {
            let s = slices.stress(*depth).unwrap().remove(0);
            let u = slices.displacement(*depth).unwrap().remove(0);
            for (m, probe) in probes.iter().enumerate() {
                for ((i, j), _) in s[0].indexed_iter() {
                    let value = match probe {
                        Probe::Stress(of) => (of.value)(&std::array::from_fn(|c| s[c][(i, j)])),
                        Probe::Displacement(of) if of.name == "u_x" => u[0][(i, j)],
                        Probe::Displacement(_) => u[2][(i, j)],
                    };
                    let plane = if side == Side::Body1 { 3 - k } else { k };
                    let at = start + m * block + 8 + 4 * ((plane * 5 + j) * 7 + i);
                    let drawn = f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
                    assert!((f64::from(drawn) - value).abs() <= 1e-7 * value.abs());
                    assert!(value <= largest[m].unwrap().value);
                }
            }
        }
    }
    let uneven = [depths[0], depths[1], depths[3]];
    assert!(ImageData::create(folder.join("u.vti"), &grid, Side::Body2, &uneven, &probes).is_err());
    std::fs::remove_dir_all(&folder).unwrap();
}
