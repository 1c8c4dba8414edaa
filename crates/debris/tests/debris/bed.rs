//! Beds of debris, and their mass.

use debris::{Bed, MASS_ACCURACY, Region, spread_bed};

use crate::rows::{Half, Strip, near, row};

/// The bed after some cycles under a constant source per cycle, in `jumps` equal jumps extrapolated with
/// twice as many, and the sum of what left.
fn bed_after(region: &Region, K: &[f64], source: &[f64], cycles: f64, jumps: usize) -> Bed {
    let run = |jumps: usize| {
        let n = cycles / jumps as f64;
        let mut bed = Bed {
            height: vec![0.0; source.len()],
            ejected: 0.0,
        };
        for _ in 0..jumps {
            let supply: Vec<f64> = bed
                .height
                .iter()
                .zip(source)
                .map(|(h, q)| h + n * q)
                .collect();
            let next = spread_bed(region, K, n, &supply, Some(&bed.height), MASS_ACCURACY).unwrap();
            let (before, after) = (supply.iter().sum::<f64>(), next.height.iter().sum::<f64>());
            assert!((before - after - next.ejected).abs() <= 1e-9 * before);
            bed = Bed {
                ejected: bed.ejected + next.ejected,
                ..next
            };
        }
        bed
    };
    let (coarse, mut fine) = (run(jumps), run(2 * jumps));
    for (fine, coarse) in fine.height.iter_mut().zip(&coarse.height) {
        *fine = 2.0 * *fine - coarse;
    }
    fine.ejected = 2.0 * fine.ejected - coarse.ejected;
    fine
}

#[test]
fn a_bed_in_a_strip_fills_and_settles() {
    let strip = row("strip_transient");
    let (b, K, q) = (
        strip.input("half_width"),
        strip.input("transport"),
        strip.input("source"),
    );
    let line = Strip::new(b, 200);
    let region = Region::from_mask(line.lattice, &line.map(|x| x.abs() < b));
    let inside = |value: f64| line.map(|x| if x.abs() < b { value } else { 0.0 });
    let cycles = strip.list("input", "cycles");
    let centres = strip.list("output", "h_centre");
    let kept = strip.list("output", "kept");
    for ((cycles, centre), kept) in cycles.iter().zip(&centres).zip(&kept) {
        let bed = bed_after(&region, &inside(K), &inside(q), *cycles, 100);
        near(
            line.interpolate(&bed.height, 0.0),
            *centre,
            2e-3,
            "h_centre",
        );
        let volume = line.lattice.dx * bed.height.iter().sum::<f64>();
        near(volume / (2.0 * b * q * cycles), *kept, 3e-3, "kept");
        let worn = 2.0 * b * q * cycles / line.lattice.dx;
        near(
            bed.height.iter().sum::<f64>() + bed.ejected,
            worn,
            1e-9,
            "mass",
        );
    }
}

#[test]
fn a_bed_in_a_disc_fills_and_settles() {
    let disc = row("disc_transient");
    let (a, K, q) = (
        disc.input("radius"),
        disc.input("transport"),
        disc.input("source"),
    );
    let half = Half::new(a, 100);
    let region = Region::from_levels(half.lattice, &half.map(|x, y| a - x.hypot(y)));
    let inside = |value: f64| half.map(|x, y| if x.hypot(y) < a { value } else { 0.0 });
    let (cycles, centres) = (
        disc.list("input", "cycles"),
        disc.list("output", "h_centre"),
    );
    for (cycles, centre) in cycles.iter().zip(&centres) {
        let bed = bed_after(&region, &inside(K), &inside(q), *cycles, 40);
        near(
            bed.height[half.lattice.columns / 2 * half.lattice.rows],
            *centre,
            5e-3,
            "disc",
        );
    }
}

#[test]
fn a_bed_in_a_square_settles_as_a_membrane() {
    let square = row("square_steady");
    let (a, K, q) = (
        square.input("half_x"),
        square.input("transport"),
        square.input("source"),
    );
    let half = Half::new(a, 100);
    let region = Region::from_mask(half.lattice, &half.map(|x, y| x.abs() < a && y < a));
    let inside = |value: f64| half.map(|x, y| if x.abs() < a && y < a { value } else { 0.0 });
    // One long jump: the limit of endless cycles.
    let n = 1e12;
    let bed = spread_bed(&region, &inside(K), n, &inside(n * q), None, MASS_ACCURACY).unwrap();
    near(
        half.log_at(&bed.height, 0.0, 0.0),
        square.output("h_centre"),
        1e-3,
        "centre",
    );
    for [x, y, exact] in square.points("h_at") {
        near(half.log_at(&bed.height, x, y), exact, 1e-3, "place");
    }
}

#[test]
fn debris_does_not_pass_a_stick_zone() {
    let strip = row("strip_stick");
    let (b, c, K, q) = (
        strip.input("half_width"),
        strip.input("stick"),
        strip.input("K"),
        strip.input("q"),
    );
    let line = Strip::new(b, 500);
    let region = Region::from_mask(line.lattice, &line.map(|x| x.abs() < b));
    let slips = |value: f64| {
        line.map(|x| {
            if x.abs() < b && x.abs() > c {
                value
            } else {
                0.0
            }
        })
    };
    let n = 1e12;
    let bed = spread_bed(&region, &slips(K), n, &slips(n * q), None, MASS_ACCURACY).unwrap();
    let at = |x: f64| line.interpolate(&bed.height, x);
    near(
        at(c + 0.5 * line.lattice.dx),
        strip.output("h_at_stick"),
        1e-3,
        "stick",
    );
    near(at(7e-4), strip.output("h_at_7e_4"), 1e-3, "7e-4");
    assert_eq!(at(0.0), 0.0);
}

#[test]
fn a_bed_that_protects_lets_the_middle_of_a_pad_wear_less() {
    let pad = row("pad_protected");
    let (b, W, energy, alpha, K, protecting) = (
        pad.input("half_width"),
        pad.input("W_per_m"),
        pad.input("energy_per_force"),
        pad.input("alpha"),
        pad.input("transport"),
        pad.input("protecting_thickness"),
    );
    let line = Strip::new(b, 400);
    let region = Region::from_mask(line.lattice, &line.map(|x| x.abs() < b));
    let inside = |value: f64| line.map(|x| if x.abs() < b { value } else { 0.0 });
    // A rigid pad recedes evenly: v = alpha energy p/(1 + h/h_ref) everywhere.
    let (mut low, mut high) = (0.0, alpha * energy * W / (2.0 * b));
    let n = 1e12;
    let steady = |v: f64| {
        spread_bed(&region, &inside(K), n, &inside(n * v), None, MASS_ACCURACY)
            .unwrap()
            .height
    };
    let pressure = |v: f64, h: f64| v * (1.0 + h / protecting) / (alpha * energy);
    for _ in 0..60 {
        let v = 0.5 * (low + high);
        let h = steady(v);
        let cells = line.x.iter().zip(&h).filter(|(x, _)| x.abs() < b);
        let force: f64 = cells.map(|(_, h)| line.lattice.dx * pressure(v, *h)).sum();
        if force > W {
            high = v;
        } else {
            low = v;
        }
    }
    let h = line.interpolate(&steady(low), 0.0);
    near(low, pad.output("recession"), 1e-4, "recession");
    near(h, pad.output("h_centre"), 1e-3, "h_centre");
    near(pressure(low, h), pad.output("p_centre"), 1e-3, "p_centre");
    near(pressure(low, 0.0), pad.output("p_edge"), 1e-3, "p_edge");
}

#[test]
fn debris_of_cells_that_open_leaves() {
    let half = Half::new(1.0, 16);
    let mut seed = 3_u64;
    let mut number = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (seed >> 40) as f64 / f64::from(1_u32 << 24)
    };
    for _ in 0..20 {
        let level: Vec<f64> = half
            .map(|_, _| 0.0)
            .iter()
            .map(|_| number() - 0.4)
            .collect();
        let supply: Vec<f64> = level.iter().map(|_| number()).collect();
        let K: Vec<f64> = level.iter().map(|_| (number() - 0.3).max(0.0)).collect();
        let region = Region::from_levels(half.lattice, &level);
        let bed = spread_bed(&region, &K, 10.0 * number(), &supply, None, MASS_ACCURACY).unwrap();
        let sum = |f: &[f64]| f.iter().sum::<f64>();
        near(sum(&bed.height) + bed.ejected, sum(&supply), 1e-9, "mass");
        assert!(bed.height.iter().zip(&level).all(|(h, l)| if *l > 0.0 {
            *h >= -1e-9
        } else {
            *h == 0.0
        }));
    }
}
