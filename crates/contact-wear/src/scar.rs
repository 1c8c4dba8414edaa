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
//! The middle of the scar is `c^2/(2 R)` deep, each body's part of it in proportion to the volume that it
//! loses. Where this part reaches the bottom of a coating the run ends, or the fastest of the bare layers
//! sets the rate from there on (`worn_through`).
//!
//! In a point contact the bodies give way by `3 mu W ((2 - nu_1)/G_1 + (2 - nu_2)/G_2)/(16 a)` before
//! they slide (R. D. Mindlin, J. Appl. Mech. 16 (1949) 259), in and out at both reversals. In partial
//! slip, and in a line contact, the way slipped is less than taken here.

use std::f64::consts::PI;

use contact_core::scene::{Elastic, Scene};

use super::law::CellCycle;
use super::settings::{Wear, WornThrough, thicknesses};

/// Margin of a grid beside a scar, over its width.
const MARGIN: f64 = 1.2;

/// The scar of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scar {
    /// Volume that both bodies lose, less what stays as debris \[m^3\], per length in plane strain \[m^2\].
    pub volume: f64,
    /// Half its width along x, the amplitude of the shift included \[m\].
    pub half_width: f64,
    /// Cycles after which the scar is as wide as the grid; infinite if it never is.
    pub cycles_on_grid: f64,
}

/// The cut of a plane through the gap of the unworn bodies.
#[derive(Clone, Copy, Debug)]
struct Cut {
    /// Radius of the gap \[m\].
    R: f64,
    line: bool,
}

impl Cut {
    /// Volume per length (line) or volume (round) of the cut of half-width c \[m\].
    fn volume(self, c: f64) -> f64 {
        if self.line {
            2.0 * c.powi(3) / (3.0 * self.R)
        } else {
            PI * c.powi(4) / (4.0 * self.R)
        }
    }

    /// Half-width of the cut \[m\] from its volume.
    fn half_width(self, volume: f64) -> f64 {
        if self.line {
            (1.5 * volume * self.R).cbrt()
        } else {
            (4.0 * volume * self.R / PI).powf(0.25)
        }
    }

    /// Depth of the cut in its middle \[m\] from its volume.
    fn depth(self, volume: f64) -> f64 {
        self.half_width(volume).powi(2) / (2.0 * self.R)
    }
}

/// Wear of a body: thicknesses of its coatings \[m\], and the volume that a cycle wears off where a layer is
/// bare \[m^3\].
#[derive(Clone, Debug)]
struct LayerRates {
    thickness: Vec<f64>,
    rates: Vec<f64>,
}

impl LayerRates {
    /// The rate of the fastest of the layers that are bare, once `through` coatings are worn through in the
    /// middle.
    fn rate(&self, through: usize) -> f64 {
        let bare = self.rates.iter().take(through + 1);
        bare.fold(0.0, |most: f64, rate| most.max(*rate))
    }

    /// Depth of the bottom of a coating \[m\].
    fn bottom(&self, coating: usize) -> Option<f64> {
        let above = self.thickness.get(..=coating)?;
        Some(above.iter().sum())
    }
}

/// Spans of constant rates: the cycles at the end of each, and the volume by which the gap has grown until
/// then. They end after all cycles, or at the bottom of a coating where the run stops there.
fn spans(bodies: &[LayerRates; 2], cut: Cut, wear: &Wear) -> Vec<(f64, f64)> {
    let mut spans = vec![(0.0, 0.0)];
    let (mut through, mut depths) = ([0; 2], [0.0; 2]);
    let (mut cycles, mut volume) = (0.0, 0.0);
    loop {
        let rates = [0, 1].map(|b| bodies[b].rate(through[b]));
        let growth = wear.opens() * (rates[0] + rates[1]);
        let end = volume + growth * (wear.cycles - cycles);
        if !(growth > 0.0) {
            break;
        }
        // Depth of a body over the depth of the gap.
        let parts = rates.map(|rate| rate / growth);
        let bottoms = [0, 1].into_iter().filter_map(|b| {
            let remaining = bodies[b].bottom(through[b])? - depths[b];
            (parts[b] > 0.0).then(|| (b, remaining.max(0.0) / parts[b]))
        });
        let reached = bottoms
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .filter(|(_, rise)| cut.depth(volume) + rise < cut.depth(end));
        let Some((b, rise)) = reached else {
            spans.push((wear.cycles, end));
            break;
        };
        let depth = cut.depth(volume) + rise;
        let at_bottom = cut.volume((2.0 * cut.R * depth).sqrt());
        cycles += (at_bottom - volume) / growth;
        volume = at_bottom;
        spans.push((cycles, volume));
        if wear.worn_through == WornThrough::Stop {
            break;
        }
        for k in 0..2 {
            depths[k] += parts[k] * rise;
        }
        through[b] += 1;
    }
    spans
}

/// Cycles after which the gap has grown by a volume; infinite if it never has.
fn cycles_to_volume(spans: &[(f64, f64)], volume: f64) -> f64 {
    let span = spans.windows(2).find(|span| span[1].1 >= volume);
    span.map_or(f64::INFINITY, |span| {
        let [(from, low), (to, high)] = [span[0], span[1]];
        from + (to - from) * (volume - low).max(0.0) / (high - low)
    })
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
            ..CellCycle::default()
        };
        let layer_rates = |body: usize| {
            let wear_of_body = &self.bodies[body];
            let coatings = [&scene.body1, &scene.body2][body];
            let thickness = thicknesses(coatings);
            let rate = |layer: usize| {
                let Some(law) = wear_of_body.law(layer) else {
                    return Some(0.0);
                };
                let mut depth = [0.0];
                law.depth(&cycle, &mut depth).ok()?;
                Some(wear_of_body.share.unwrap_or(1.0) * depth[0] * area)
            };
            let rates: Option<Vec<f64>> = (0..=thickness.len()).map(rate).collect();
            Some(LayerRates {
                thickness,
                rates: rates?,
            })
        };
        let (k_1, k_2) = scene.principal_curvatures();
        let R = if line {
            1.0 / k_1
        } else {
            1.0 / (k_1 * k_2).sqrt()
        };
        let cut = Cut { R, line };
        let spans = spans(&[layer_rates(0)?, layer_rates(1)?], cut, self);
        let volume = spans.last().map_or(0.0, |(_, volume)| *volume);
        let (extent_x, extent_y) = scene.grid.extent();
        let along_x = 0.5 * extent_x - amplitude;
        let fits = if line {
            along_x
        } else {
            along_x.min(0.5 * extent_y)
        };
        Some(Scar {
            volume,
            half_width: cut.half_width(volume).max(hertz.a) + amplitude,
            cycles_on_grid: cycles_to_volume(&spans, cut.volume(fits.max(0.0))),
        })
    }

    /// A warning before the run: the scar of all cycles is wider than the grid.
    pub fn doubt_of_grid(&self, scene: &Scene) -> Option<String> {
        // The width that a bed leaves follows from the run alone.
        let scar = self.scar(scene).filter(|_| self.bed.is_none())?;
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
