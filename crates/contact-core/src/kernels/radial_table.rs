//! Radial functions tabulated by their Hankel integrals.
//!
//! g_n(r) = 1/(2 pi) integral of A_n(k) J_m(k r) dk, with an amplitude A_n that decays like
//! exp(-k zeta). Then g_n(r)/r^m is analytic in s = r^2 except for s <= -zeta^2, so that Chebyshev
//! polynomials in s on panels that grow with s converge like 9.9^-n.
//!
//! The integral. Where k r is large the integrand oscillates, and A_n(k) is multiplied by the
//! smooth window erfc((k r_a - C)/w)/2. The neglected part is, on the contour shifted by i w^2/(2
//! r) into the upper half-plane, of the order exp(-w^2/4). A fixed number of Gauss nodes is thus
//! enough for every r. The radii of one octave [r_a, 2 r_a) share their nodes, and octaves are
//! similar: in units of r_a nodes, radii and Bessel functions are the same, so these are computed
//! once.

use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::bessel::bessel;
use quadrature::gauss;

/// Chebyshev nodes per panel: 9.9^-16 is below rounding.
const ORDER: usize = 16;
/// Panels per octave of s.
const SPLITS: usize = 2;
/// Panels per octave of r.
const PANELS: usize = 2 * SPLITS;
/// Width w of the window in k r: exp(-w^2/4) = 2e-16.
const WINDOW_WIDTH: f64 = 12.0;
/// Middle C of the window in k r: six widths from 0, where the window is 1 to rounding.
const WINDOW_MIDDLE: f64 = 72.0;
/// Phase k zeta beyond which the amplitude, exp(-k zeta) times a low power, is below rounding.
const DECAY: f64 = 48.0;
/// Longest panel of the k-integral in k r_a.
const LONGEST: f64 = 8.0;
/// Gauss nodes per panel of the k-integral: exact to rounding for J_m(2 t) over a panel, and
/// for amplitudes with singularities at 15 degrees from the real axis.
const NODES: usize = 20;

/// The functions to be tabulated.
pub struct Hankel<'a, const N: usize> {
    /// The amplitudes A_n(k).
    pub amplitude: &'a (dyn Fn(f64) -> [f64; N] + Sync),
    /// Order m of the Bessel function of each, 0 to 3.
    pub orders: [usize; N],
    /// Decay length of the amplitudes \[m\]: A_n ~ exp(-k zeta).
    pub zeta: f64,
    /// Wave number below which the amplitudes are well resolved by low polynomials \[1/m\].
    pub k_low: f64,
}

/// g_n(r)/r^m for s = r^2 from 0 to a largest one.
pub struct RadialTable<const N: usize> {
    /// End of the first panel, a power of four \[m^2\].
    s_first: f64,
    /// Chebyshev coefficients, `ORDER` per panel.
    coefficients: Vec<[f64; N]>,
}

/// Nodes and weights of the k-integral in units of 1/r_a, for r up to 2 r_a.
struct Rule(Vec<(f64, f64)>);

impl Rule {
    /// Builds the rule from 0 to `high`, with the panels doubling from `low` to the longest.
    fn new(low: f64, high: f64, nodes: usize) -> Self {
        let mut points = Vec::new();
        let mut panel = |from: f64, to: f64| {
            let (middle, half) = (f64::midpoint(from, to), (to - from) / 2.0);
            points.extend(
                gauss(nodes)
                    .iter()
                    .map(|(x, w)| (middle + half * x, half * w)),
            );
        };
        let mut to = LONGEST;
        while to > low {
            panel(to / 2.0, to);
            to /= 2.0;
        }
        panel(0.0, to);
        let mut from = LONGEST;
        while from < high {
            panel(from, from + LONGEST);
            from += LONGEST;
        }
        Self(points)
    }
}

/// Radii of the nodes of an octave in r_a, and for each of them J_0 to J_3 at the nodes of a rule.
type Octave = (Vec<f64>, Vec<Vec<[f64; 4]>>);

/// Most rules whose Bessel functions are kept, some megabyte each.
const KEPT: usize = 16;

/// Octaves computed before, by the number of nodes, which distinguishes rules from 0 to the window's
/// end: kernels at many depths share them.
static OCTAVES: Mutex<BTreeMap<usize, Arc<Octave>>> = Mutex::new(BTreeMap::new());

/// Bessel functions J_0 to J_3 at the nodes of a rule for the radii of one octave, computed once for each
/// length of the rule.
fn octave(rule: &Rule) -> Arc<Octave> {
    let lock_cache = || OCTAVES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(octave) = lock_cache().get(&rule.0.len()) {
        return octave.clone();
    }
    let radii: Vec<f64> = (0..PANELS)
        .flat_map(|panel| {
            let octave = f64::from(1 << (panel / SPLITS));
            let sub = (panel % SPLITS) as f64;
            cosines().map(|x| {
                let from = 1.0 + sub / SPLITS as f64;
                (octave * (from + f64::midpoint(1.0, x) / SPLITS as f64)).sqrt()
            })
        })
        .collect();
    let bessels_at_radius = |rho: &f64| rule.0.iter().map(|(t, _)| bessel(t * rho)).collect();
    let bessels = radii.par_iter().map(bessels_at_radius).collect();
    let octave = Arc::new((radii, bessels));
    let mut cache = lock_cache();
    if cache.len() >= KEPT {
        cache.clear();
    }
    cache.insert(rule.0.len(), octave.clone());
    octave
}

impl<const N: usize> Hankel<'_, N> {
    /// Calls `f` with these functions as a set of one.
    fn with_set<T>(&self, f: impl FnOnce(&HankelSet<'_, N>) -> Vec<T>) -> T {
        let amplitudes = |k: f64, at: &mut [[f64; N]]| at.fill((self.amplitude)(k));
        let set = HankelSet {
            amplitudes: &amplitudes,
            orders: self.orders,
            zetas: &[self.zeta],
            k_low: self.k_low,
        };
        f(&set).swap_remove(0)
    }

    /// Tabulates the functions for r <= `r_max`.
    pub fn tabulate(&self, r_max: f64) -> RadialTable<N> {
        self.with_set(|set| set.tabulate(r_max))
    }

    /// Largest deviation of the table from a finer integration, each function in the unit r^m,
    /// times `r`: one radius in each octave, off the nodes.
    pub fn max_deviation(&self, table: &RadialTable<N>, r_max: f64) -> f64 {
        self.with_set(|set| set.max_deviations(&[table], r_max))
    }
}

/// End of the first panel in r of functions of the decay length `zeta`, a power of two between 0.35
/// and 0.71 zeta, or larger if needed.
pub(super) fn first_radius(zeta: f64, r_max: f64) -> f64 {
    let zeta = (0.5 * zeta).log2().round();
    zeta.min(r_max.log2().ceil()).exp2()
}

/// Several sets of functions with one end of the first panel ([`first_radius`]): the responses at several
/// depths of a stack. They share the nodes in k, so that one recursion over the layers serves all of them.
pub(super) struct HankelSet<'a, const N: usize> {
    /// Writes the amplitudes A_n(k) of each set.
    pub(super) amplitudes: &'a (dyn Fn(f64, &mut [[f64; N]]) + Sync),
    /// Order m of the Bessel function of each function, 0 to 3.
    pub(super) orders: [usize; N],
    /// Decay length of the amplitudes of each set \[m\]: A_n ~ exp(-k zeta).
    pub(super) zetas: &'a [f64],
    /// Wave number below which the amplitudes are well resolved by low polynomials \[1/m\].
    pub(super) k_low: f64,
}

impl<const N: usize> HankelSet<'_, N> {
    /// The smallest decay length of the set \[m\].
    fn least_zeta(&self) -> f64 {
        self.zetas.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Smallest scale of a rule whose unit is 1/r \[-\].
    fn smallest_scale(&self, r: f64) -> f64 {
        self.k_low * r / 8.0
    }

    /// For each set of functions, the amplitudes at the nodes of a rule for radii from `r_a` \[m\] on, times the
    /// quadrature weight. With `window` a smooth step, 1/2 at t = `window`, ends them. A list ends where its
    /// amplitudes have decayed.
    fn weighted_amplitudes(
        &self,
        rule: &Rule,
        r_a: f64,
        window: Option<f64>,
    ) -> Vec<Vec<[f64; N]>> {
        let sets = self.zetas.len();
        let least_zeta = self.least_zeta();
        let mut weighted = vec![vec![[0.0; N]; rule.0.len()]; sets];
        let mut amplitudes = vec![[0.0; N]; sets];
        for (node, &(t, w)) in rule.0.iter().enumerate() {
            let k = t / r_a;
            if k * least_zeta > DECAY {
                continue;
            }
            let window_value = window.map_or(1.0, |c| libm::erfc((t - c) / WINDOW_WIDTH) / 2.0);
            let factor = window_value * w / r_a / (2.0 * PI);
            (self.amplitudes)(k, &mut amplitudes);
            for ((values, amplitudes), zeta) in weighted.iter_mut().zip(&amplitudes).zip(self.zetas)
            {
                if k * zeta <= DECAY {
                    values[node] = amplitudes.map(|a| a * factor);
                }
            }
        }
        // Amplitudes that have decayed end the sums.
        for values in &mut weighted {
            let is_zero = |a: &[f64; N]| a.iter().all(|a| *a == 0.0);
            let end = values.iter().rposition(|a| !is_zero(a));
            values.truncate(end.map_or(0, |last| last + 1));
        }
        weighted
    }

    /// g_n(r)/r^m of each set at r = `rho` r_a, from the weighted amplitudes.
    fn sums(&self, rule: &Rule, weighted: &[Vec<[f64; N]>], rho: f64, r_a: f64) -> Vec<[f64; N]> {
        let bessels: Vec<[f64; 4]> = rule.0.iter().map(|(t, _)| bessel(t * rho)).collect();
        let sum = |values: &Vec<[f64; N]>| self.sum(&bessels, values, rho * r_a);
        weighted.iter().map(sum).collect()
    }

    /// g_n(r)/r^m at `r`, from the Bessel functions and the weighted amplitudes at the nodes.
    fn sum(&self, bessels: &[[f64; 4]], weighted: &[[f64; N]], r: f64) -> [f64; N] {
        let mut g = [0.0; N];
        for (j, a) in bessels.iter().zip(weighted) {
            for n in 0..N {
                g[n] += a[n] * j[self.orders[n]];
            }
        }
        self.divide_by_powers(g, r)
    }

    /// Divides each function g by r to its power m.
    fn divide_by_powers(&self, mut g: [f64; N], r: f64) -> [f64; N] {
        for (g, m) in g.iter_mut().zip(self.orders) {
            *g /= r.powi(m as i32);
        }
        g
    }

    /// The functions of each set at one radius by a finer rule than the rule of the tables.
    fn evaluate_finer(&self, r: f64) -> Vec<[f64; N]> {
        let middle = 1.25 * WINDOW_MIDDLE;
        let high = (2.0 * middle).min(DECAY / self.least_zeta() * r);
        let rule = Rule::new(self.smallest_scale(r) / 2.0, high, NODES + 6);
        let window = (high > middle / 4.0).then_some(middle);
        let weighted = self.weighted_amplitudes(&rule, r, window);
        self.sums(&rule, &weighted, 1.0, r)
    }

    /// Tabulates each set of functions for radii up to `r_max` \[m\].
    pub(super) fn tabulate(&self, r_max: f64) -> Vec<RadialTable<N>> {
        let r_first = first_radius(self.zetas[0], r_max);
        let mut coefficients = self.tabulate_first_panel(r_first);
        // A radius at the very end of an octave belongs to the next one.
        let octaves = ((r_max / r_first).log2().floor() + 1.0).max(0.0) as usize;
        if octaves > 0 {
            self.add_octaves(r_first, octaves, &mut coefficients);
        }
        let table = |coefficients| RadialTable {
            s_first: r_first * r_first,
            coefficients,
        };
        coefficients.into_iter().map(table).collect()
    }

    /// The coefficients of each set in the first panel. The rule belongs to the smallest decay
    /// length with this panel, so that a table does not depend on the others of its set.
    fn tabulate_first_panel(&self, r_first: f64) -> Vec<Vec<[f64; N]>> {
        let high = DECAY / 2.0_f64.sqrt();
        let rule = Rule::new(self.smallest_scale(r_first), high, NODES);
        let weighted = self.weighted_amplitudes(&rule, r_first, None);
        let radii = cosines().map(|x| f64::midpoint(1.0, x).sqrt());
        let values = radii.map(|rho| self.sums(&rule, &weighted, rho, r_first));
        let coefficients =
            |set: usize| transform(&values.each_ref().map(|sums| sums[set])).to_vec();
        (0..self.zetas.len()).map(coefficients).collect()
    }

    /// Adds the coefficients of the octaves beyond the first panel to each set.
    fn add_octaves(&self, r_first: f64, octaves: usize, coefficients: &mut [Vec<[f64; N]>]) {
        let rule = Rule::new(self.smallest_scale(r_first), 2.0 * WINDOW_MIDDLE, NODES);
        let (radii, bessels) = &*octave(&rule);
        let tabulate = |octave: usize| -> Vec<Vec<[f64; N]>> {
            let r_a = r_first * (octave as f64).exp2();
            let weighted = self.weighted_amplitudes(&rule, r_a, Some(WINDOW_MIDDLE));
            let panels_of = |weighted: Vec<[f64; N]>| {
                let nodes = bessels.iter().zip(radii);
                let values: Vec<[f64; N]> = nodes
                    .map(|(bessels, rho)| self.sum(bessels, &weighted, rho * r_a))
                    .collect();
                let panels = values.chunks_exact(ORDER);
                panels
                    .flat_map(|v| transform(v.try_into().expect("a panel has ORDER nodes")))
                    .collect()
            };
            weighted.into_par_iter().map(panels_of).collect()
        };
        let by_octave: Vec<_> = (0..octaves).into_par_iter().map(tabulate).collect();
        for of_sets in by_octave {
            for (coefficients, more) in coefficients.iter_mut().zip(of_sets) {
                coefficients.extend(more);
            }
        }
    }

    /// Largest deviation of each table from a finer integration, each function in the unit r^m, times
    /// `r`: one radius in each octave, off the nodes.
    pub(super) fn max_deviations(&self, tables: &[&RadialTable<N>], r_max: f64) -> Vec<f64> {
        let s_first = tables[0].s_first.sqrt();
        let mut radii = vec![0.37 * s_first];
        let mut r = 1.23 * s_first;
        while r < r_max {
            radii.push(r);
            r *= 2.13;
        }
        let deviations = |r: &f64| -> Vec<f64> {
            let fine = self.evaluate_finer(*r);
            let deviation = |(fine, table): (&[f64; N], &&RadialTable<N>)| {
                let table = table.evaluate(r * r);
                let deviations =
                    (0..N).map(|n| (fine[n] - table[n]).abs() * r.powi(self.orders[n] as i32));
                // A maximum would ignore NaN.
                let largest =
                    deviations.fold(
                        0.0,
                        |m: f64, v| if v.is_nan() { f64::INFINITY } else { m.max(v) },
                    );
                r * largest
            };
            fine.iter().zip(tables).map(deviation).collect()
        };
        let larger = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(b).map(|(a, b)| a.max(b)).collect();
        let none = || vec![0.0; tables.len()];
        radii.par_iter().map(deviations).reduce(none, larger)
    }
}

impl<const N: usize> RadialTable<N> {
    /// Memory of the coefficients \[bytes\].
    pub(super) fn bytes(&self) -> usize {
        std::mem::size_of_val(self.coefficients.as_slice())
    }

    /// Evaluates the table at s = r^2 <= r_max^2: g_n(r)/r^m of each function.
    pub fn evaluate(&self, s: f64) -> [f64; N] {
        let ratio = s / self.s_first;
        let (panel, x) = if ratio < 1.0 {
            (0, 2.0 * ratio - 1.0)
        } else {
            let bits = ratio.to_bits();
            let octave = (bits >> 52) as usize - 1023;
            let mantissa = f64::from_bits((bits & ((1 << 52) - 1)) | (1023 << 52));
            let position = (mantissa - 1.0) * SPLITS as f64;
            let sub = position as usize;
            (
                1 + octave * SPLITS + sub,
                2.0 * (position - sub as f64) - 1.0,
            )
        };
        clenshaw(&self.coefficients[panel * ORDER..][..ORDER], x)
    }
}

/// The Chebyshev nodes on \[-1, 1\].
fn cosines() -> [f64; ORDER] {
    std::array::from_fn(|i| (PI * (i as f64 + 0.5) / ORDER as f64).cos())
}

/// Computes Chebyshev coefficients from values at the Chebyshev nodes.
fn transform<const N: usize>(values: &[[f64; N]; ORDER]) -> [[f64; N]; ORDER] {
    std::array::from_fn(|j| {
        let mut c = [0.0; N];
        for (i, value) in values.iter().enumerate() {
            let phase = PI * j as f64 * (i as f64 + 0.5) / ORDER as f64;
            let weight = if j == 0 { 1.0 } else { 2.0 } / ORDER as f64 * phase.cos();
            for n in 0..N {
                c[n] += weight * value[n];
            }
        }
        c
    })
}

/// Sums Chebyshev polynomials with these coefficients at x in \[-1, 1\], by Clenshaw's recurrence.
fn clenshaw<const N: usize>(coefficients: &[[f64; N]], x: f64) -> [f64; N] {
    let (mut b, mut previous) = ([0.0; N], [0.0; N]);
    for c in coefficients[1..].iter().rev() {
        for n in 0..N {
            let new = c[n] + 2.0 * x * b[n] - previous[n];
            previous[n] = b[n];
            b[n] = new;
        }
    }
    std::array::from_fn(|n| coefficients[0][n] + x * b[n] - previous[n])
}

#[cfg(test)]
mod tests {
    use super::super::cell::Cell;
    use super::super::half_space::add_kernel;
    use super::*;

    /// Amplitudes exp(-k z) of all orders, whose integrals are known, as an image source has.
    fn image_source_table(z: f64, r_max: f64) -> (RadialTable<4>, f64) {
        let hankel = Hankel {
            amplitude: &|k| [(-k * z).exp(); 4],
            orders: [0, 1, 2, 3],
            zeta: z,
            k_low: 1.0 / z,
        };
        let table = hankel.tabulate(r_max);
        let error = hankel.max_deviation(&table, r_max);
        (table, error)
    }

    /// (rho - z)^n/(r^n rho), rho^2 = r^2 + z^2; over r^n, without cancellation.
    fn exact_value(z: f64, r: f64, n: usize) -> f64 {
        let rho = r.hypot(z);
        1.0 / (rho * (rho + z).powi(n as i32)) / (2.0 * PI)
    }

    #[test]
    fn reproduces_image_sources() {
        for (z, r_max) in [(1.0, 1e5), (1e-4, 3.0), (7e3, 1.0)] {
            let (table, estimate) = image_source_table(z, r_max);
            assert!(estimate < 1e-13, "{estimate:.1e}");
            for i in 0..500 {
                let r = r_max * (f64::from(i) / 500.0).powi(4);
                let values = table.evaluate(r * r);
                for (n, value) in values.iter().enumerate() {
                    let scale = (r + z).powi(n as i32 + 1);
                    let error = (value - exact_value(z, r, n)).abs() * scale;
                    assert!(error < 1e-13, "z = {z}, r = {r}, J_{n}: {error:.1e}");
                }
            }
        }
    }

    /// The integral of 1/sqrt(r^2 + z^2) over a cell is known: the image's depth from a tenth of
    /// the short side to a hundred of it, cells up to twenty times as long as wide.
    #[test]
    fn integrates_image_sources_over_cells() {
        for (z, half_y) in [(0.05, 0.5), (0.2, 10.0), (2.0, 0.5), (100.0, 0.025)] {
            let (table, _) = image_source_table(z, 100.0);
            for (x, y) in [
                (0.0, 0.0),
                (1.0, 0.0),
                (0.0, 2.0 * half_y),
                (7.0, 4.0 * half_y),
            ] {
                let cell = Cell {
                    x,
                    y,
                    half_x: 0.5,
                    half_y,
                };
                let mut sum = [0.0; 6];
                cell.nodes_of_parts(z, 1e-14, &mut |x, y, w| {
                    let g = table.evaluate(x * x + y * y);
                    add_kernel(&mut sum, x, y, w, [g[0], 0.0, 0.0, 0.0]);
                });
                let corner = |x: f64, y: f64| {
                    let rho = x.hypot(y).hypot(z);
                    x * (y / x.hypot(z)).asinh() + y * (x / y.hypot(z)).asinh()
                        - z * (x * y / (z * rho)).atan()
                };
                let (x0, x1, y0, y1) = (x - 0.5, x + 0.5, y - half_y, y + half_y);
                let closed = corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0);
                let error = (sum[2] * 2.0 * PI / closed - 1.0).abs();
                assert!(error < 3e-13, "z = {z} at ({x}, {y}): {error:.1e}");
            }
        }
    }
}
