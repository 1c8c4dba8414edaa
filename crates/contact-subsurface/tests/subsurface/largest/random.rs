//! Largest stresses of contacts drawn at random, against the same on much finer grids, whose own
//! errors are printed beside them.
//!
//! `make largest` runs 60 of them on 128 cells against 512 and writes what came out into
//! `docs/reliability.md`; the test runs a slice on fewer cells. `FRET_LARGEST` is the number of
//! contacts, `FRET_LARGEST_FROM` the seed of the first (default 0), `FRET_LARGEST_FINER` how much
//! finer the truth is.

use std::fmt::Write as _;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use contact_core::Error;
use fastrand::Rng;

use super::*;
use crate::document;

/// Stresses whose largest values are looked at.
const MEASURES: [&str; 3] = ["von_mises", "s_1", "s_xx"];
const W: f64 = 50.0;

/// A contact without its grid.
struct Drawn {
    what: String,
    shape: Shape,
    lower: Body,
    mu: f64,
    path: LoadPath,
    /// Length of the grid that may be too short, and whether it has one row \[m\].
    extent: f64,
    flat: bool,
}

fn draw(seed: u64) -> Drawn {
    let mut rng = Rng::with_seed(seed);
    let h = hertz(R, STEEL, STEEL, W);
    let kind = seed % 4;
    let flat = kind == 2;
    let E_star = STEEL.E / 2.0 / (1.0 - STEEL.nu * STEEL.nu);
    let (shape, name, load, a) = match kind {
        0 => (Shape::Sphere { R }, "sphere".to_owned(), W, h.a),
        1 => {
            let R_y = R * (0.4 + 0.5 * rng.f64());
            let shape = Shape::Ellipsoid {
                R_x: R,
                R_y,
                angle: 0.0,
            };
            (
                shape,
                format!("ellipsoid, R_y/R_x = {:.2}", R_y / R),
                W,
                h.a,
            )
        }
        2 => {
            let shape = Shape::Cylinder {
                R,
                length: f64::INFINITY,
                angle: 0.0,
            };
            (
                shape,
                "cylinder".to_owned(),
                1e5,
                line_contact(R, E_star, 1e5).a,
            )
        }
        _ => {
            let (radius, edge) = (1.2 * h.a, 0.3 * R * (0.5 + rng.f64()));
            let name = "punch with a rounded edge".to_owned();
            (Shape::FlatPunch { radius, edge }, name, W, 1.4 * h.a)
        }
    };
    let mut lower = Body::homogeneous(STEEL, Shape::Flat);
    let mut layer = "bare".to_owned();
    if rng.f64() < 0.6 {
        let ratio = 0.3 * 13.0_f64.powf(rng.f64());
        let thickness = 0.02 * 50.0_f64.powf(rng.f64()) * a;
        lower.coatings = vec![Coating {
            material: Elastic::new(ratio * STEEL.E, 0.2 + 0.15 * rng.f64()).unwrap(),
            thickness,
        }];
        layer = format!("E1/E2 = {ratio:.2}, h = {:.3} a", thickness / a);
    }
    let mu = 0.1 + 0.7 * rng.f64();
    let pressed = LoadPath::start().normal(load, 1);
    let (mu, path, how) = match rng.u32(0..3) {
        0 => (0.0, pressed, "no friction".to_owned()),
        1 => {
            let part = 0.3 + 0.6 * rng.f64();
            let T = part * mu * load;
            (
                mu,
                pressed.tangential(&[T], 4),
                format!("T = {part:.2} mu W, mu = {mu:.2}"),
            )
        }
        _ => {
            let shift = 20.0 * mu * h.delta_z;
            let path = pressed.change_to(|to| to.given.delta_x = Some(shift), 4);
            (mu, path, format!("sliding, mu = {mu:.2}"))
        }
    };
    Drawn {
        what: format!("{name}, {layer}, {how}"),
        shape,
        lower,
        mu,
        path,
        extent: 2.3 * a,
        flat,
    }
}

impl Drawn {
    fn scene(&self, n: usize, longer: f64) -> Scene {
        let extent = longer * self.extent;
        let grid = if self.flat {
            Grid::strip(extent, n, 1.0)
        } else {
            Grid::centred(extent, n)
        };
        let (shape, lower) = (self.shape.clone(), self.lower.clone());
        scene(shape, lower, self.mu, grid.unwrap(), self.path.clone())
    }

    /// The largest values on grids of n and `finer` times as many cells, over the largest pressure.
    fn both(&self, n: usize, finer: usize) -> Vec<(Extremum, f64)> {
        let mut longer = 1.0;
        let ends = loop {
            match self.ends(n, longer) {
                Ok(fields) => break fields,
                Err(Error::OffGrid { .. } | Error::GridTooSmall { .. }) if longer < 8.0 => {
                    longer *= 1.15;
                }
                Err(error) => panic!("{}: {error}", self.what),
            }
        };
        let truth = self.ends(finer * n, longer).unwrap();
        let [coarse, fine] = [n, finer * n].map(|n| self.scene(n, longer));
        let p_max = truth.p.iter().copied().fold(0.0, f64::max);
        let of = |scene: &Scene, fields: &Fields, of: &str| {
            let m = on_section(scene, fields, of, self.extent / 2.3);
            let error = m.error.total() / p_max;
            let value = m.value / p_max;
            (Extremum { value, ..m }, error)
        };
        MEASURES
            .iter()
            .flat_map(|name| [of(&coarse, &ends, name), of(&fine, &truth, name)])
            .collect()
    }

    fn ends(&self, n: usize, longer: f64) -> Result<Fields, Error> {
        let mut march = March::new(&self.scene(n, longer))?;
        while let Some(increment) = march.advance() {
            increment?;
        }
        Ok(march.fields())
    }
}

/// Whether the value is within its error of the truth, and how far off it is over the truth.
struct Compared {
    what: String,
    of: &'static str,
    covered: bool,
    off: f64,
}

fn compared(seed: u64, n: usize, finer: usize) -> Vec<Compared> {
    let drawn = draw(seed);
    let found = drawn.both(n, finer);
    let pair = |(of, pair): (&&'static str, &[(Extremum, f64)])| {
        let ((m, error), (truth, truth_error)) = (pair[0], pair[1]);
        let off = m.value - truth.value;
        println!(
            "{seed}: {}: {of} {:.4} +- {error:.4} at ({:.3e}, {:.3e}), finer {:.4} +- {truth_error:.4} at ({:.3e}, {:.3e})",
            drawn.what, m.value, m.x, m.depth.z, truth.value, truth.x, truth.depth.z
        );
        Compared {
            what: drawn.what.clone(),
            of,
            covered: off.abs() <= error,
            off: off.abs() / truth.value.abs().max(0.05),
        }
    };
    MEASURES.iter().zip(found.chunks(2)).map(pair).collect()
}

fn all(seeds: Range<u64>, n: usize, finer: usize) -> Vec<Compared> {
    let (next, found) = (AtomicU64::new(seeds.start), Mutex::new(Vec::new()));
    let threads = thread::available_parallelism().map_or(1, usize::from);
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
                let pool = pool.unwrap();
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed >= seeds.end {
                        return;
                    }
                    let compared = pool.install(|| compared(seed, n, finer));
                    found.lock().unwrap().extend(compared);
                }
            });
        }
    });
    found.into_inner().unwrap()
}

#[test]
#[ignore = "slow"]
fn random_contacts_are_within_their_errors() {
    let number = |name: &str| std::env::var(name).ok().map(|n| n.parse::<u64>().unwrap());
    let whole = number("FRET_LARGEST");
    let (count, n) = whole.map_or((8, 64), |count| (count, 128));
    let finer = number("FRET_LARGEST_FINER").unwrap_or(4) as usize;
    let from = number("FRET_LARGEST_FROM").unwrap_or(0);
    let found = all(from..from + count, n, finer);
    let part = |is: &dyn Fn(&Compared) -> bool| {
        let yes = found.iter().filter(|c| is(c)).count();
        100.0 * yes as f64 / found.len() as f64
    };
    let mut report = format!(
        "{count} contacts on {n} cells against {} ({}): {:.1} % of the largest values within their error, {:.1} % within 2 %, \
         {:.1} % within 5 %. Not within their error, or off by more than 5 %:\n\n",
        n * finer,
        MEASURES.join(", "),
        part(&|c| c.covered),
        part(&|c| c.off <= 0.02),
        part(&|c| c.off <= 0.05)
    );
    for c in found.iter().filter(|c| !c.covered || c.off > 0.05) {
        let covered = if c.covered { "" } else { ", not covered" };
        let off = 100.0 * c.off;
        writeln!(report, "- {}: {} off by {off:.1} %{covered}", c.what, c.of).unwrap();
    }
    if report.ends_with(":\n\n") {
        report.push_str("- none\n");
    }
    println!("{report}");
    if let Ok(document) = std::env::var("FRET_LARGEST_REPORT") {
        document::insert(&document, "largest", &report);
    }
    assert!(part(&|c| c.covered) >= 90.0, "{report}");
}
