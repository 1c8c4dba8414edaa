//! How wide the scar of all cycles becomes, before the run: the grid has to hold it.
//!
//! Gross slip wears the volume `V = k W s N`, s being the way slipped in a cycle (J. F. Archard, J. Appl.
//! Phys. 24 (1953) 981-988). The scar is taken as the cut of a plane through the gap of the unworn
//! bodies, R the radius of the gap:
//!
//! ```text
//! point: V = pi c^4/(4 R)      line: V/L = 2 c^3/(3 R)
//! ```
//!
//! In a point contact the bodies give way by `3 mu W ((2 - nu_1)/G_1 + (2 - nu_2)/G_2)/(16 a)` before
//! they slide (R. D. Mindlin, J. Appl. Mech. 16 (1949) 259), in and out at both reversals. In partial
//! slip, and in a line contact, the way slipped is less than taken here.

use std::f64::consts::PI;

use contact_core::scene::{Elastic, Scene};

use super::law::CellCycle;
use super::settings::Wear;

/// Margin of a grid beside a scar, over its width.
const MARGIN: f64 = 1.2;

/// The scar of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scar {
    /// Volume that both bodies lose, less what stays as debris \[m^3\], per length in plane strain \[m^2\].
    pub volume: f64,
    /// Half its width along x, the amplitude of the shift included \[m\].
    pub half_width: f64,
    /// Cycles after which the scar is as wide as the grid.
    pub cycles_on_grid: f64,
}

impl Wear {
    /// The scar after all cycles; `None` without a shift that drives the bodies, or without a Hertz
    /// contact.
    pub fn scar(&self, scene: &Scene) -> Option<Scar> {
        let hertz = scene.hertz()?;
        let first = self.first_branch(scene).ok()?;
        let shifts = scene.path.branches.get(first.checked_sub(1)?..)?.iter();
        let shifts: Vec<f64> = shifts
            .map(|branch| branch.to.given.delta_x)
            .collect::<Option<_>>()?;
        let turns = shifts.windows(2).filter(|of| of[0] != of[1]).count() as f64;
        let driven: f64 = shifts.windows(2).map(|of| (of[1] - of[0]).abs()).sum();
        let amplitude = shifts
            .iter()
            .fold(0.0, |most: f64, shift| most.max(shift.abs()));
        let line = scene.grid.plane_strain;
        let mu = scene.friction.mu;
        let compliance = |body: Elastic| {
            if body.is_rigid() {
                0.0
            } else {
                (2.0 - body.nu) / body.G()
            }
        };
        let gives = if line {
            0.0
        } else {
            let compliances = compliance(scene.body1.substrate) + compliance(scene.body2.substrate);
            3.0 * mu * hertz.W * compliances / (16.0 * hertz.a)
        };
        let slip = driven - 2.0 * gives * turns;
        if slip <= 0.0 {
            return None;
        }
        let width = if line { scene.grid.dy } else { 1.0 };
        let (W, area) = if line {
            (hertz.W / width, 2.0 * hertz.a)
        } else {
            (hertz.W, PI * hertz.a * hertz.a)
        };
        let (pressure_times_slip, zero) = ([W / area * slip], [0.0]);
        let cycle = CellCycle {
            pressure_times_slip: &pressure_times_slip,
            slip_distance: &[slip],
            dissipated: &[mu * pressure_times_slip[0]],
            worn: &zero,
            energy: &zero,
            cycles: 0.0,
            frequency: self.frequency.unwrap_or(f64::NAN),
        };
        // Of several layers the one that wears fastest: the others are worn through.
        let depths = self.bodies.iter().map(|body| {
            let depths = body.laws.iter().map(|law| {
                let mut depth = [0.0];
                law.depth(&cycle, &mut depth).ok().map(|()| depth[0])
            });
            let deepest = depths.collect::<Option<Vec<_>>>()?;
            let deepest = deepest.into_iter().fold(0.0, f64::max);
            Some(body.share.unwrap_or(1.0) * deepest)
        });
        let per_cycle: f64 = depths.collect::<Option<Vec<_>>>()?.into_iter().sum();
        let volume = self.opens() * per_cycle * area * self.cycles;
        let (k_1, k_2) = scene.principal_curvatures();
        let (scar, power) = if line {
            ((1.5 * volume / k_1).cbrt(), 3)
        } else {
            ((4.0 * volume / (PI * (k_1 * k_2).sqrt())).powf(0.25), 4)
        };
        let (extent_x, extent_y) = scene.grid.extent();
        let along_x = 0.5 * extent_x - amplitude;
        let fits = if line {
            along_x
        } else {
            along_x.min(0.5 * extent_y)
        };
        Some(Scar {
            volume,
            half_width: scar.max(hertz.a) + amplitude,
            cycles_on_grid: self.cycles * (fits.max(0.0) / scar).powi(power),
        })
    }

    /// A warning before the run: the scar of all cycles is wider than the grid.
    pub fn doubt_of_grid(&self, scene: &Scene) -> Option<String> {
        let scar = self.scar(scene)?;
        (scar.cycles_on_grid < self.cycles).then(|| {
            let (extent, _) = scene.grid.extent();
            let unit = if scene.grid.plane_strain { "m^2" } else { "m^3" };
            let needed = 2.0 * MARGIN * scar.half_width;
            format!(
                "{:.3e} cycles wear off up to V = k W s N = {:.2e} {unit}: the scar becomes {:.2e} m wide, the grid is \
                 {extent:.2e} m long. The contact leaves it after about {:.1e} cycles; use a grid of {needed:.2e} m, {} \
                 times as many cells along a side",
                self.cycles,
                scar.volume,
                2.0 * scar.half_width,
                scar.cycles_on_grid,
                (needed / extent * 10.0).ceil() / 10.0,
            )
        })
    }
}
