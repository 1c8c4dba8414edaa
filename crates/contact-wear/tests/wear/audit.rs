//! What every run of wear owes: volumes that balance, surfaces that do not grow, a contact that
//! touches and does not overlap, finite numbers.

use std::sync::Arc;

use contact_core::convolution::{DcFft, Displacements, SurfaceOperator, Tractions};
use contact_core::kernels::pair_coefficients;
use contact_core::plan::{KernelSet, Mirror, Plan};
use contact_core::scene::{Scene, Shape};
use contact_wear::{Block, Cycling, Jump, Wear, WearRun};
use ndarray::Array2;

/// What sums over the cells and over the halves of a jump lose to rounding, and a margin.
const ROUNDING: f64 = 1e-9;
/// Points by which the mean over an increment of a stroke is taken.
const POINTS: usize = 2000;

/// A run under audit.
pub(crate) struct Audit<'a> {
    name: &'a str,
    scene: &'a Scene,
    /// Volume that body 1 and 2 lose per energy \[m^3/J\], where that is known.
    per_energy: Option<[f64; 2]>,
    /// C p, where the pressure of a block has to touch and not to overlap.
    normal: Option<DcFft>,
    /// Part of the worn depth by which the gap grows.
    opens: f64,
}

impl<'a> Audit<'a> {
    /// Of a scene; `per_energy` is the volume per energy of body 1 and 2, where that is known.
    pub(crate) fn new(
        name: &'a str,
        scene: &'a Scene,
        wear: &Wear,
        per_energy: Option<[f64; 2]>,
    ) -> Self {
        let mut audit = Self {
            name,
            scene,
            per_energy,
            normal: None,
            opens: 1.0 - wear.debris_kept,
        };
        if audit.complements(wear) {
            let pair = pair_coefficients(
                (&scene.body1, &scene.body2),
                &scene.grid,
                &scene.settings.kernel,
                scene.settings.skip.equal_layers,
                KernelSet::Normal,
                None,
            );
            audit.normal = Some(DcFft::new(&pair.unwrap(), Mirror::None, false));
        }
        audit
    }

    /// Steps through a run to its end or its first error, and checks every jump.
    pub(crate) fn run(&mut self, wear: &Wear) -> Result<Vec<Jump>, contact_core::Error> {
        let mut run = WearRun::new(self.scene, wear, &Arc::default())?;
        let mut last = run.block();
        let mut jumps: Vec<Jump> = Vec::new();
        while let Some(jump) = run.advance() {
            let (jump, now) = (jump?, run.block());
            self.check_growth(&last, &now);
            self.check_volumes(jumps.last(), &jump, &now);
            self.check_contact(wear, &now);
            last = now;
            jumps.push(jump);
        }
        Ok(jumps)
    }

    /// Whether the pressure of a block and the gap at its place complement each other: in gross
    /// slip always; in a march, whose pressure is a mean of the cycle, if shear does not act on it
    /// and the normal load stays.
    fn complements(&self, wear: &Wear) -> bool {
        let of = |b: usize| {
            let to = self.scene.path.branches[b].to;
            (to.W, to.M_x, to.M_y, to.given.delta_z)
        };
        let mut cycle = wear.first_branch(self.scene).unwrap()..self.scene.path.branches.len();
        let level = of(0).1 == 0.0 && of(0).2 == 0.0;
        wear.cycling == Cycling::Sliding
            || level && !Plan::new(self.scene).coupling && cycle.all(|b| of(b) == of(0))
    }

    fn check_growth(&self, last: &Block, now: &Block) {
        for (before, now) in [(&last.worn1, &now.worn1), (&last.worn2, &now.worn2)] {
            let mut cells = before.iter().zip(now);
            assert!(
                cells.all(|(before, now)| now >= before && now.is_finite()),
                "{}: a surface grows",
                self.name
            );
        }
    }

    /// The jump says what the profiles hold, and each body loses what the energy says.
    fn check_volumes(&self, last: Option<&Jump>, jump: &Jump, now: &Block) {
        let name = self.name;
        let numbers = [jump.error, jump.pressure_error, jump.depth_error];
        let more = [jump.dissipated_per_cycle, jump.p_max, jump.contact_area];
        let mut numbers = numbers.iter().chain(&more);
        assert!(
            numbers.all(|n| n.is_finite() && *n >= 0.0),
            "{name}: {jump:?}"
        );
        for (b, worn) in [&now.worn1, &now.worn2].into_iter().enumerate() {
            let sum = worn.sum() * self.scene.grid.cell_area();
            assert!((sum - jump.volume[b]).abs() <= ROUNDING * sum, "{name}");
            let Some(per) = self.per_energy else { continue };
            let (volume, energy) = last.map_or((0.0, 0.0), |j| (j.volume[b], j.dissipated));
            let (lost, spent) = (jump.volume[b] - volume, jump.dissipated - energy);
            assert!(
                (lost - per[b] * spent).abs() <= ROUNDING * jump.volume[b].max(lost),
                "{name}: body {} loses {lost:e} m^3 for {spent:e} J, not {:e} m^3/J",
                b + 1,
                per[b]
            );
        }
    }

    /// No tension; the force is one of the cycle; no gap under pressure (root mean square) and no
    /// overlap, as the tolerance of the scene says.
    fn check_contact(&mut self, wear: &Wear, now: &Block) {
        let (name, scene) = (self.name, self.scene);
        assert!(
            now.p.iter().all(|p| *p >= 0.0 && p.is_finite()),
            "{name}: p"
        );
        let first = wear.first_branch(scene).unwrap();
        let cycle = &scene.path.branches[first - 1..];
        if cycle.iter().all(|branch| branch.to.given.delta_z.is_none()) {
            let of = cycle.iter().map(|branch| branch.to.W);
            let (low, high) = of.fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), W| {
                (l.min(W), h.max(W))
            });
            let W = now.p.sum() * scene.grid.cell_area();
            let holds = W >= (1.0 - 1e-6) * low && W <= (1.0 + 1e-6) * high;
            assert!(holds, "{name}: W = {W:e} N, not {low:e} to {high:e}");
        }
        let Some(gap) = self.gap(now) else { return };
        let touching: Vec<f64> = cells(&gap, &now.p, true).collect();
        let rest = mean(&touching);
        let rms = touching.iter().map(|g| (g - rest).powi(2)).sum::<f64>();
        let rms = (rms / touching.len().max(1) as f64).sqrt();
        let overlap = cells(&gap, &now.p, false).fold(0.0, |m: f64, g| m.max(rest - g));
        let allowed = scene.tolerance() * scene.reference_approach();
        assert!(
            rms <= allowed && overlap <= allowed,
            "{name}: gap {rms:e}, overlap {overlap:e}, allowed {allowed:e} m"
        );
    }

    /// Approach of the bodies, where pressure and gap complement each other \[m\].
    pub(crate) fn approach(&mut self, now: &Block) -> f64 {
        let gap = self.gap(now).unwrap();
        mean(&cells(&gap, &now.p, true).collect::<Vec<_>>())
    }

    /// Gap between the worn surfaces, but for the approach \[m\].
    fn gap(&mut self, now: &Block) -> Option<Array2<f64>> {
        let op = self.normal.as_mut()?;
        let mut u_z = vec![0.0; now.p.len()];
        op.apply(
            Tractions {
                p: now.p.as_slice(),
                ..Tractions::default()
            },
            Displacements {
                u_z: Some(&mut u_z),
                ..Displacements::default()
            },
        );
        let u_z = Array2::from_shape_vec(now.p.raw_dim(), u_z).unwrap();
        let dx = self.scene.grid.dx;
        // The mean over the increment, by many points.
        let moved = |field: &Array2<f64>, way: f64| {
            let points = if now.shift_length > 0.0 { POINTS } else { 1 };
            let point = |k: usize| (k as f64 + 0.5) / points as f64 - 0.5;
            let shift = |k: usize| way * (now.shift + point(k) * now.shift_length) / dx;
            let sum = (0..points).map(|k| shifted(field, shift(k)));
            sum.reduce(|sum, field| sum + field).unwrap() / points as f64
        };
        let (one, two) = if self.scene.body1.shape == Shape::Flat {
            (moved(&now.worn1, -1.0), now.worn2.clone())
        } else {
            (now.worn1.clone(), moved(&now.worn2, 1.0))
        };
        Some(self.scene.h_init() + (one + two) * self.opens + u_z)
    }
}

/// A field as it is found so many cells further along x, linear between the cells; zero beyond the
/// grid.
fn shifted(field: &Array2<f64>, by: f64) -> Array2<f64> {
    let (nx, ny) = field.dim();
    let at = |i: f64, j: usize| {
        let inside = i >= 0.0 && i < nx as f64;
        if inside { field[(i as usize, j)] } else { 0.0 }
    };
    let (whole, part) = (by.floor(), by - by.floor());
    Array2::from_shape_fn((nx, ny), |(i, j)| {
        let i = i as f64 + whole;
        (1.0 - part) * at(i, j) + part * at(i + 1.0, j)
    })
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// The gap of the cells that carry pressure, or of the others.
fn cells<'a>(
    gap: &'a Array2<f64>,
    p: &'a Array2<f64>,
    pressed: bool,
) -> impl Iterator<Item = f64> + 'a {
    let cells = gap.iter().zip(p);
    cells.filter_map(move |(g, p)| ((*p > 0.0) == pressed).then_some(*g))
}
