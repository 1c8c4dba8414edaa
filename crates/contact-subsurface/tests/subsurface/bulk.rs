//! The bulk stress of the body, beside what its tractions cause.

use contact_core::Error;
use contact_core::convolution::Tractions;
use contact_core::march::{March, Observer};
use contact_core::scene::{
    Body, Coating, Elastic, Friction, Grid, LoadPath, Profile, ResidualStress, Scene, Settings,
    Shape,
};
use contact_subsurface::{
    Accumulate, Depth, Line, Moment, Points, Section, Side, Slices, States, Stream, depths,
};
use ndarray::Array2;

use crate::{coated, states, tractions};

const SIGMA: f64 = 0.7;

/// Far below the contact there is the bulk stress alone: sigma_B along x in the substrate, in a
/// layer what its own modulus makes of the same strains.
#[test]
fn far_below_the_contact_the_bulk_stress_is_left() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let z = 1e3;
    let far = depths(&body, &[z]).unwrap();
    let force: f64 = q.iter().flatten().map(|q| q.abs() * grid.cell_area()).sum();
    let ways = |side| {
        let tractions = [states(&q)];
        let pulled = States {
            sigma_B: &[SIGMA],
            ..States::from(&tractions)
        };
        let slices = Slices::new(&body, side, &grid, pulled.clone()).unwrap();
        let plane = slices.stress(far[0]).unwrap();
        let points = Points::new(&body, side, &grid, pulled).unwrap();
        let point = points.stress(&[(3.0, 2.0, far[0])]);
        [
            [0, 1, 2, 3, 4, 5].map(|c| plane[0][c][(7, 4)]),
            point.unwrap()[0][0],
        ]
    };
    for side in [Side::Body1, Side::Body2] {
        for stress in ways(side) {
            for (s, bulk) in stress.iter().zip([SIGMA, 0.0, 0.0, 0.0, 0.0, 0.0]) {
                // A point load leaves less than its size over the depth squared.
                assert!((s - bulk).abs() < force / (z * z), "{stress:?}");
                assert!(force / (z * z) < 1e-3 * SIGMA);
            }
        }
    }
}

#[test]
fn it_is_added_in_every_layer_and_in_every_way() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let (none, two) = ([states(&q)], [states(&q), states(&q)]);
    let depths = depths(&body, &[0.0, 4.0, 9.5, 11.0, 40.0]).unwrap();
    // E (eps_x + nu eps_y)/(1 - nu^2) and its like, eps_x = SIGMA, eps_y = -0.3 SIGMA (E = 1).
    let of_layer = [(3.0, 0.25), (0.4, 0.4), (1.0, 0.3)].map(|(E, nu): (f64, f64)| {
        let modulus = E / (1.0 - nu * nu);
        [
            modulus * (1.0 - 0.3 * nu) * SIGMA,
            modulus * (nu - 0.3) * SIGMA,
        ]
    });
    for (line, exchanged) in [(Line::AlongX(0.4), false), (Line::AlongY(1.0), true)] {
        let at = |tractions: &[Tractions<'_>], sigma_B: &[f64]| {
            let states = States {
                sigma_B,
                ..States::from(tractions)
            };
            Section::new(&body, Side::Body2, &grid, line, states).unwrap()
        };
        let bare = at(&none, &[]).stress(&depths).unwrap().remove(0);
        // The second state alone is pulled.
        let pulled = at(&two, &[0.0, SIGMA]);
        let both = pulled.stress(&depths).unwrap();
        for (k, depth) in depths.iter().enumerate() {
            for i in 0..if exchanged { grid.ny } else { grid.nx } {
                for c in 0..6 {
                    let bulk = of_layer[depth.layer].get(c).copied().unwrap_or(0.0);
                    let [without, with] =
                        [0, 1].map(|state| both[state][(c, k, i)] - bare[(c, k, i)]);
                    assert!(without.abs() < 1e-14, "{without}");
                    assert!((with - bulk).abs() < 1e-14, "{depth:?} {c}: {with} {bulk}");
                }
            }
        }
        // The tractions on planes z = const are not touched.
        let u = pulled.displacement(&depths).unwrap();
        assert_eq!(u[0], u[1]);
    }
}

/// Of each point on the line the damage of Findley's criterion, the largest of (half the range of
/// the shear + K times the largest tension) over planes across x and z, with what it takes: along
/// each plane the extremes of both. A fatigue criterion as anyone could write it.
struct Findley {
    normals: Vec<[f64; 2]>,
}

const K: f64 = 0.3;

/// Shear and normal stress on a plane.
fn on_plane(s: [f64; 6], [n_x, n_z]: [f64; 2]) -> [f64; 2] {
    let (t_x, t_z) = (s[0] * n_x + s[4] * n_z, s[4] * n_x + s[2] * n_z);
    [t_z * n_x - t_x * n_z, t_x * n_x + t_z * n_z]
}

/// By place and plane: smallest and largest shear, largest tension.
type Extremes = Vec<Vec<[f64; 3]>>;

impl Accumulate for Findley {
    type Accumulator = Extremes;

    fn start(&self, _: Depth, places: usize) -> Extremes {
        let nothing = [f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        vec![vec![nothing; self.normals.len()]; places]
    }

    fn add(&self, kept: &mut Extremes, _: Moment, stress: &Array2<f64>) {
        for (of_place, s) in kept.iter_mut().zip(stress.columns()) {
            for (of_plane, normal) in of_place.iter_mut().zip(&self.normals) {
                let [shear, tension] = on_plane(std::array::from_fn(|c| s[c]), *normal);
                let [low, high, pulled] = *of_plane;
                *of_plane = [low.min(shear), high.max(shear), pulled.max(tension)];
            }
        }
    }
}

impl Findley {
    fn damage(of_planes: &[[f64; 3]]) -> f64 {
        let damage = of_planes
            .iter()
            .map(|[low, high, pulled]| 0.5 * (high - low) + K * pulled);
        damage.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// A path with bulk stresses in both bodies, streamed through a criterion that the library does not
/// know, against the same from all increments at once.
#[test]
fn a_fatigue_criterion_streams_with_the_bulk_stress() -> Result<(), Error> {
    let steel = Elastic::new(210e9, 0.3)?;
    let (W, mu) = (1e3, 0.3);
    let mut body2 = Body::homogeneous(steel, Shape::Flat);
    body2.coatings = vec![Coating {
        material: Elastic::new(400e9, 0.25)?,
        thickness: 2e-4,
    }];
    let pulled = |T: f64, lower: f64, upper: f64| {
        move |to: &mut contact_core::scene::Loads| {
            (to.T_x, to.sigma_B, to.sigma_B1) = (T, lower, upper);
        }
    };
    let scene = Scene {
        title: "fatigue".into(),
        body1: Body::homogeneous(steel, Shape::Sphere { R: 0.018 }),
        body2,
        friction: Friction::coulomb(mu),
        grid: Grid::centred(1.2e-3, 16)?,
        path: LoadPath::start()
            .normal(W, 2)
            .change_to(pulled(0.5 * mu * W, 2e8, 5e7), 3)
            .change_to(pulled(-0.5 * mu * W, -1e8, 5e7), 3),
        settings: Settings::default(),
    };
    let normals: Vec<[f64; 2]> = (0..18)
        .map(|i| f64::from(i) * std::f64::consts::PI / 18.0)
        .map(|angle| [angle.cos(), angle.sin()])
        .collect();
    for (side, body) in [(Side::Body1, &scene.body1), (Side::Body2, &scene.body2)] {
        let depths = depths(body, &[0.0, 1e-4, 2e-4, 1e-3])?;
        let line = Line::AlongX(0.0);
        let criterion = Findley {
            normals: normals.clone(),
        };
        let mut stream = Stream::new(
            body,
            side,
            &scene.grid,
            Some(line),
            depths.clone(),
            criterion,
        )?;
        let mut every = Vec::new();
        let mut march = March::new(&scene)?;
        while let Some(increment) = march.advance() {
            let increment = increment?;
            stream.on_increment(&march, &increment)?;
            let f = march.fields();
            let state = Tractions {
                q_x: f.q_x.as_slice(),
                q_y: f.q_y.as_slice(),
                p: f.p.as_slice(),
            };
            let sigma_B = match side {
                Side::Body1 => increment.point.loads.sigma_B1,
                Side::Body2 => increment.point.loads.sigma_B,
            };
            let (tractions, sigma_B) = ([state], [sigma_B]);
            let states = States {
                sigma_B: &sigma_B,
                ..States::from(&tractions)
            };
            let section = Section::new(body, side, &scene.grid, line, states)?;
            every.push(section.stress(&depths)?.remove(0));
        }
        let (_, kept) = stream.finish()?;
        let p_H = scene.hertz().expect("a Hertz contact").p0;
        for (k, places) in kept.iter().enumerate() {
            for (i, of_planes) in places.iter().enumerate() {
                let on = |normal: &[f64; 2]| {
                    let passed = every
                        .iter()
                        .map(|s| on_plane(std::array::from_fn(|c| s[(c, k, i)]), *normal));
                    let nothing = [f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
                    passed.fold(nothing, |[low, high, most], [shear, tension]| {
                        [low.min(shear), high.max(shear), most.max(tension)]
                    })
                };
                let all: Vec<[f64; 3]> = normals.iter().map(on).collect();
                let (ours, truth) = (Findley::damage(of_planes), Findley::damage(&all));
                assert!(
                    (ours - truth).abs() < 1e-9 * p_H,
                    "{side:?} {k} {i}: {ours} {truth}"
                );
            }
        }
        let largest = kept.iter().flatten().map(|planes| Findley::damage(planes));
        assert!(largest.fold(0.0, f64::max) > 0.1 * p_H);
    }
    Ok(())
}

/// A residual stress of each layer adds to s_xx and s_yy of that layer alone, below lines, on
/// planes, at points and along a path; other numbers of layers and stresses that are none are
/// refused.
#[test]
fn residual_stress_is_added_in_its_layer_alone() {
    let body = coated();
    let grid = Grid::from_spacing((15, 12), (1.0, 0.8)).unwrap();
    let q = tractions(&grid);
    let tractions = [states(&q)];
    let residual = [-3.0, 0.5, 0.25];
    let given = |layers: &[f64]| {
        let layers: Vec<_> = layers.iter().copied().map(Profile::uniform).collect();
        ResidualStress::from_profiles(&body, &layers)
    };
    let with = |residual| States {
        residual: Some(residual),
        sigma_B: &[SIGMA],
        ..States::from(&tractions)
    };
    let (line, side) = (Line::AlongX(0.4), Side::Body2);
    let depths = depths(&body, &[0.0, 4.0, 9.5, 11.0, 40.0]).unwrap();
    let section = |states| Section::new(&body, side, &grid, line, states).unwrap();
    let [none, whole] = [&[][..], &residual].map(|layers| given(layers).unwrap());
    let [bare, pressed] = [&none, &whole].map(|given| {
        let below = section(with(given)).stress(&depths).unwrap().remove(0);
        let slices = Slices::new(&body, side, &grid, with(given)).unwrap();
        let points = Points::new(&body, side, &grid, with(given)).unwrap();
        (below, slices, points)
    });
    for (k, depth) in depths.iter().enumerate() {
        let (mut planes, mut points) = (Vec::new(), Vec::new());
        for (_, slices, at) in [&bare, &pressed] {
            planes.push(slices.stress(*depth).unwrap().remove(0));
            points.push(at.stress(&[(0.5, 0.4, *depth)]).unwrap()[0][0]);
        }
        for c in 0..6 {
            let own = if c < 2 { residual[depth.layer] } else { 0.0 };
            let added = [
                pressed.0[(c, k, 7)] - bare.0[(c, k, 7)],
                planes[1][c][(7, 4)] - planes[0][c][(7, 4)],
                points[1][c] - points[0][c],
            ];
            for added in added {
                assert!((added - own).abs() < 1e-14, "{depth:?} {c}: {added} {own}");
            }
        }
    }
    for (wrong, message) in [
        (
            &[1.0, 2.0][..],
            "residual = 2 of them: must be one for each of the 3 layers",
        ),
        (
            &[0.0, f64::NAN, 0.0],
            "residual[1] = NaN: must be a finite stress",
        ),
    ] {
        let error = given(wrong).unwrap_err();
        assert!(error.to_string().starts_with(message), "{error}");
    }
}
