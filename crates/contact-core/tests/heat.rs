//! Contact temperature: sources whose temperature is known, layers, sharing, cycles.

use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

use contact_core::heat::{
    Conduction, Conductor, Cycle, Layers, partition, surface_response, temperature,
};
use contact_core::kernels::Complex64;
use contact_core::scene::Grid;
use ndarray::Array2;

const STEEL: Conductor = Conductor {
    conductivity: 50.0,
    heat_capacity: 3.6e6,
};
const TITANIUM: Conductor = Conductor {
    conductivity: 7.0,
    heat_capacity: 2.4e6,
};
/// Radius of the sources \[m\].
const A: f64 = 1e-3;

fn steel() -> Layers {
    Layers::homogeneous(STEEL).expect("a body")
}

fn titanium() -> Layers {
    Layers::homogeneous(TITANIUM).expect("a body")
}

fn coated(coating: Conductor, h: f64, substrate: Conductor) -> Layers {
    Layers::new(&[coating, substrate], &[h], "body").expect("a body")
}

/// A grid with a cell in the middle, `n` cells to the radius.
fn grid(n: usize) -> Grid {
    let side = 2 * n + 7;
    Grid::centred(side as f64 * A / n as f64, side).expect("a grid")
}

/// The mean over each cell of a function of r/A.
fn source(grid: &Grid, f: impl Fn(f64) -> f64) -> Vec<Complex64> {
    const PARTS: usize = 16;
    let within = |n: usize| (n as f64 + 0.5) / PARTS as f64 - 0.5;
    let mean = grid.map(|x, y| {
        let parts = (0..PARTS * PARTS).map(|n| {
            let (x, y) = (
                x + within(n / PARTS) * grid.dx,
                y + within(n % PARTS) * grid.dy,
            );
            f(x.hypot(y) / A)
        });
        parts.sum::<f64>() / (PARTS * PARTS) as f64
    });
    mean.iter().map(|q| Complex64::new(*q, 0.0)).collect()
}

fn disc(grid: &Grid) -> Vec<Complex64> {
    source(grid, |r| if r < 1.0 { 1.0 } else { 0.0 })
}

fn respond(body: &Layers, grid: &Grid, w: f64, q: &[Complex64]) -> Vec<Complex64> {
    Conduction::new(body, grid, w)
        .expect("a response")
        .temperature(q)
}

fn close(found: f64, expected: f64, tolerance: f64) {
    let error = (found / expected - 1.0).abs();
    assert!(
        error < tolerance,
        "{found:e}, not {expected:e}: {error:.1e}"
    );
}

fn middle(grid: &Grid) -> usize {
    grid.cells() / 2
}

/// Largest q a/K and mean 8 q a/(3 pi K): Carslaw and Jaeger 1959, section 8.2.
#[test]
fn a_disc_of_heat() {
    let grid = grid(32);
    let q = disc(&grid);
    let t = respond(&steel(), &grid, 0.0, &q);
    let unit = A / STEEL.conductivity;
    close(t[middle(&grid)].re, unit, 2e-4);
    let weight: f64 = q.iter().map(|q| q.re).sum();
    let mean = q.iter().zip(&t).map(|(q, t)| q.re * t.re).sum::<f64>() / weight;
    close(mean, 8.0 * unit / (3.0 * PI), 2e-3);
}

/// pi q_0 a/(4 K) in the middle and half of it at the rim: Hertz' displacement with 1/K for (1 - nu)/G.
#[test]
fn a_source_of_the_shape_of_hertz_pressure() {
    let grid = grid(32);
    let q = source(&grid, |r| (1.0 - r * r).max(0.0).sqrt());
    let t = respond(&steel(), &grid, 0.0, &q);
    let expected = PI * A / (4.0 * STEEL.conductivity);
    close(t[middle(&grid)].re, expected, 5e-4);
    close(t[middle(&grid) + 32].re, expected / 2.0, 2e-3);
    // Of what is largest: the mean of q T over that of q.
    let weight: f64 = q.iter().map(|q| q.re).sum();
    let mean = q.iter().zip(&t).map(|(q, t)| q.re * t.re).sum::<f64>() / weight;
    // The mean of 1 - r^2/2 under sqrt(1 - r^2) is 4/5.
    close(mean, 0.8 * expected, 2e-3);
}

/// (1/(K k)) (1 + r tanh)/(r + tanh), r = K/K_s, of a layer: its two parts put together otherwise.
#[test]
fn a_layer_answers_as_its_hyperbolic_functions_say() {
    for (k, w) in [(1e-2, 0.0), (3e3, 0.0), (1e6, 0.0), (1e2, 40.0), (5e4, 3e6)] {
        let h = 2e-4;
        let body = coated(TITANIUM, h, STEEL);
        let m = |c: Conductor| {
            c.conductivity * Complex64::new(k * k, w * c.heat_capacity / c.conductivity).sqrt()
        };
        let (layer, below) = (m(TITANIUM), m(STEEL));
        let s = layer / TITANIUM.conductivity;
        // Beyond 20 the hyperbolic tangent is 1 to rounding.
        let tanh = if (s * h).re > 20.0 {
            Complex64::ONE
        } else {
            (s * h).tanh()
        };
        let expected = (layer + below * tanh) / (layer * (below + layer * tanh));
        let error = (surface_response(&body, k, w) / expected - 1.0).norm();
        assert!(error < 1e-13, "k = {k}, w = {w}: {error:.1e}");
    }
}

/// Thick, a coating is a half-space but for what the images of its lower side add; thin, it adds
/// h (1/K - K/K_s^2), its resistance less what it conducts sideways: the response to first order in k h.
#[test]
fn thick_and_thin_coatings() {
    let grid = grid(16);
    let q = disc(&grid);
    let at = |body: &Layers, w: f64| respond(body, &grid, w, &q)[middle(&grid)];
    let (bare, other) = (at(&steel(), 0.0).re, at(&titanium(), 0.0).re);

    let same = respond(&coated(STEEL, 0.3 * A, STEEL), &grid, 0.0, &q);
    close(same[middle(&grid)].re, bare, 1e-13);

    // Images of strength 2 rho^n at the depths 2 n h add q a^2 rho^n/(2 n h K) each.
    let h = 100.0 * A;
    let rho =
        (TITANIUM.conductivity - STEEL.conductivity) / (TITANIUM.conductivity + STEEL.conductivity);
    let images: f64 = (1..200).map(|n| rho.powi(n) / f64::from(n)).sum();
    let far = A * A * images / (2.0 * h * TITANIUM.conductivity);
    close(at(&coated(TITANIUM, h, STEEL), 0.0).re - other, far, 1e-3);

    let h = 1e-4 * A;
    let (k, k_s) = (TITANIUM.conductivity, STEEL.conductivity);
    let added = h * (1.0 / k - k / (k_s * k_s));
    // Next to it is a part h/a of it.
    close(at(&coated(TITANIUM, h, STEEL), 0.0).re - bare, added, 1e-3);

    // Where the heat does not reach through the layer within a period there is no substrate.
    let w = 100.0 * TITANIUM.conductivity / TITANIUM.heat_capacity / (0.2 * A * 0.2 * A);
    let error = at(&coated(TITANIUM, A, STEEL), w) / at(&titanium(), w) - 1.0;
    assert!(error.norm() < 1e-12, "{error:.1e}");
}

/// All heat leaves through the substrate: far away T = Q/(2 pi K_s r), whatever the coating.
#[test]
fn energy_reaches_the_substrate() {
    for (coating, h) in [
        (TITANIUM, 0.1 * A),
        (
            Conductor {
                conductivity: 600.0,
                ..STEEL
            },
            0.02 * A,
        ),
    ] {
        let grid = Grid::from_spacing((801, 1), (A, A)).unwrap();
        let mut q = vec![Complex64::ZERO; grid.cells()];
        q[0] = Complex64::ONE;
        let t = respond(&coated(coating, h, STEEL), &grid, 0.0, &q);
        let r = 800.0 * A;
        close(
            t[800].re * 2.0 * PI * STEEL.conductivity * r,
            grid.cell_area(),
            1e-5,
        );
    }
}

/// The steady share of half-spaces is K_1/(K_1 + K_2), that of bodies of the same make half, at any
/// frequency.
#[test]
fn heat_goes_where_it_is_conducted() {
    let grid = grid(8);
    let q = disc(&grid);
    let contact: Vec<bool> = q.iter().map(|q| q.re > 0.0).collect();
    let shares = |bodies: [&Layers; 2], w: f64| {
        let [mut one, mut two] = bodies.map(|body| Conduction::new(body, &grid, w).unwrap());
        let flux = partition([&mut one, &mut two], &q, &contact, 0.0)
            .unwrap()
            .flux;
        let cells = q.iter().zip(&flux[0]).filter(|(q, _)| q.re > 0.0);
        cells.map(|(q, one)| one / q).collect::<Vec<_>>()
    };
    let (k_1, k_2) = (STEEL.conductivity, TITANIUM.conductivity);
    for share in shares([&steel(), &titanium()], 0.0) {
        assert!((share - k_1 / (k_1 + k_2)).norm() < 1e-12, "{share}");
    }
    let layered = coated(TITANIUM, 0.2 * A, STEEL);
    for w in [0.0, 30.0] {
        for share in shares([&layered, &layered], w) {
            assert!((share - 0.5).norm() < 1e-12, "{share}");
        }
    }
}

/// A coated and a bare body, steady and swinging: what flows into both is the heat, and on every cell
/// in contact they are as warm as each other.
#[test]
fn temperatures_agree_where_bodies_touch() {
    let grid = grid(8);
    let q = source(&grid, |r| {
        (1.0 - r * r).max(0.0).sqrt() * (2.0 + (3.0 * r).sin())
    });
    let contact: Vec<bool> = q.iter().map(|q| q.re > 0.0).collect();
    let warmer = 1e-6;
    for (w, warmer) in [(0.0, 0.0), (0.0, warmer), (3.0, 0.0), (3e3, 0.0)] {
        let layered = coated(TITANIUM, 0.2 * A, STEEL);
        let [mut one, mut two] =
            [&layered, &titanium()].map(|body| Conduction::new(body, &grid, w).unwrap());
        let found = partition([&mut one, &mut two], &q, &contact, warmer).unwrap();
        let largest = found.rise[1].iter().map(|t| t.norm()).fold(0.0, f64::max);
        for n in 0..q.len() {
            let sum = found.flux[0][n] + found.flux[1][n];
            assert!((sum - q[n]).norm() < 1e-12);
            let step = found.rise[0][n] - found.rise[1][n] - warmer;
            assert!(
                !contact[n] || step.norm() < 1e-7 * largest,
                "{step} of {largest}"
            );
        }
        assert!(
            found.flux[0]
                .iter()
                .zip(&contact)
                .all(|(q, c)| *c || q.norm() == 0.0)
        );
    }
}

/// Without friction heat flows from the warmer to the colder body through the constriction of a disc:
/// Q = (T_2 - T_1)/(1/(4 K_1 a) + 1/(4 K_2 a)) (Carslaw and Jaeger 1959, section 8.2).
#[test]
fn a_disc_between_a_warm_and_a_cold_body() {
    let grid = grid(16);
    let none = vec![Complex64::ZERO; grid.cells()];
    let contact: Vec<bool> = disc(&grid).iter().map(|q| q.re >= 0.5).collect();
    let [mut one, mut two] =
        [&steel(), &titanium()].map(|body| Conduction::new(body, &grid, 0.0).unwrap());
    let found = partition([&mut one, &mut two], &none, &contact, 10.0).unwrap();
    let total: f64 = found.flux[0].iter().map(|q| q.re).sum::<f64>() * grid.cell_area();
    let resistance = (1.0 / STEEL.conductivity + 1.0 / TITANIUM.conductivity) / (4.0 * A);
    // The flux is singular at the rim, whose place the cells know to a fraction of their width.
    close(total, 10.0 / resistance, 0.25 / 16.0);
}

/// The heat q_0 (1 - cos 2 pi t) on a disc, in 40 increments.
fn pulsating(grid: &Grid, frequency: f64) -> (Vec<f64>, Vec<Array2<f64>>, Array2<bool>) {
    let shape = (grid.nx, grid.ny);
    let q = disc(grid).iter().map(|q| q.re).collect();
    let q = Array2::from_shape_vec(shape, q).expect("a number per cell");
    let ends: Vec<f64> = (1..=40).map(|n| f64::from(n) / 40.0).collect();
    let work = |t: f64| t - (2.0 * PI * t).sin() / (2.0 * PI);
    let heat = ends
        .iter()
        .map(|t| &q * ((work(*t) - work(t - 1.0 / 40.0)) / frequency));
    let contact = q.map(|q| *q > 0.0);
    (ends.clone(), heat.collect(), contact)
}

/// Slow cycles are quasi-steady, twice the mean when the heat is twice its mean; fast ones add the swing
/// of a plane wave, q/(K |s|).
#[test]
fn slow_and_fast_cycles() {
    let grid = grid(12);
    let diffusivity = STEEL.conductivity / STEEL.heat_capacity;
    let at = |frequency: f64| {
        let (ends, heat, contact) = pulsating(&grid, frequency);
        let cycle = Cycle {
            frequency,
            ends: &ends,
            heat: &heat,
            contact: &contact,
        };
        temperature(
            [&steel(), &steel()],
            [20.0, 20.0],
            &grid,
            &cycle,
            20,
            &AtomicBool::new(false),
        )
        .unwrap()
    };
    let half = 0.5;
    // Means over the increments and steps of constant heat each take sinc(pi/40) of the swing.
    let sampled = ((PI / 40.0).sin() / (PI / 40.0)).powi(2);

    let slow = at(1e-8 * diffusivity / (A * A));
    let mean = half * A / STEEL.conductivity;
    let centre = (grid.nx / 2, grid.ny / 2);
    close(slow.mean[0][centre] - 20.0, mean, 1e-3);
    close(slow.largest[0][centre] - 20.0, mean * (1.0 + sampled), 2e-3);
    let (hottest, _) = slow
        .peaks
        .iter()
        .enumerate()
        .max_by(|a, b| a.1.total_cmp(b.1))
        .unwrap();
    close(slow.instants[hottest], 0.5, 1e-12);

    let frequency = 1e3 * diffusivity / (A * A);
    let fast = at(frequency);
    close(fast.mean[1][centre] - 20.0, mean, 1e-3);
    let wave = (2.0 * PI * frequency / diffusivity).sqrt();
    let swing = half * sampled / (STEEL.conductivity * wave);
    close(fast.largest[1][centre] - fast.mean[1][centre], swing, 1e-3);
    close(fast.heat[centre], 1.0, 1e-12);
    close(fast.flux[centre], 0.5, 1e-12);
}

#[test]
fn what_makes_no_sense_is_refused() {
    let said = |error: contact_core::Error| error.to_string();
    let bad = Conductor {
        conductivity: -1.0,
        ..STEEL
    };
    let text = said(Layers::new(&[bad], &[], "conductor1").unwrap_err());
    assert!(text.contains("conductor1[0].conductivity = -1"), "{text}");
    let text = said(Layers::new(&[STEEL], &[1e-6], "conductor2").unwrap_err());
    assert!(text.contains("2 layers"), "{text}");

    let strip = Grid::strip(1e-3, 16, 1e-3).unwrap();
    let text = said(Conduction::new(&steel(), &strip, 0.0).err().unwrap());
    assert!(text.contains("plane_strain"), "{text}");

    let grid = grid(2);
    let (ends, heat, contact) = pulsating(&grid, 1.0);
    let good = Cycle {
        frequency: 1.0,
        ends: &ends,
        heat: &heat,
        contact: &contact,
    };
    let refused = |cycle: &Cycle<'_>, bulk: f64, harmonics: usize| {
        let bodies = [&steel(), &steel()];
        said(
            temperature(
                bodies,
                [bulk, 0.0],
                &grid,
                cycle,
                harmonics,
                &AtomicBool::new(false),
            )
            .unwrap_err(),
        )
    };
    let nowhere = contact.map(|_| false);
    let mut backwards = ends.clone();
    backwards[3] = 0.01;
    let text = [
        refused(
            &Cycle {
                frequency: 0.0,
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(
            &Cycle {
                ends: &ends[1..],
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(
            &Cycle {
                ends: &backwards,
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(
            &Cycle {
                contact: &nowhere,
                ..good.clone()
            },
            0.0,
            1,
        ),
        refused(&good, f64::NAN, 1),
        refused(&good, 0.0, 1000),
    ];
    for (text, expected) in text.iter().zip([
        "frequency = 0",
        "ends = 39",
        "ends = [",
        "contact = no cell",
        "bulk temperature = NaN",
        "harmonics = 1000",
    ]) {
        assert!(text.contains(expected), "{text}");
    }
}
