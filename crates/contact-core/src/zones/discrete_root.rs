//! A border from the root of the distance, as tractions constant in the cells represent it.
//!
//! Near a border the body is a half-space, whatever lies below its outermost layer, and the solved
//! tractions of the outermost cells depend on the position of the border within them alone. Their
//! squares L_1, L_2, L_3, outermost first, differ from the squares of the root at the middles of the
//! cells. The distance s of the outermost middle from the border, inwards, is
//!
//! ```text
//! s = sum_k C_k r^(k/2),   r = L_1/(L_2 - L_1 - (L_3 - 2 L_2 + L_1)),   -0.17 < s < 0.83,
//! ```
//!
//! r being the distance at which the parabola through the three vanishes. Where a layer a few cells
//! thick or a narrow slip ring bends the square, this border is right to 0.06 of a cell, and one
//! extrapolated from cells further in is off by up to half a cell.

use super::parabola::Parabola;

/// C_k along an axis: a cylinder on 1000 cells, borders at 48 places within a cell, against Hertz;
/// off by at most 5e-4 of a cell.
const ALONG_AXIS: [f64; 5] = [-0.1740, 0.9540, 1.0990, -1.6656, 0.6058];
/// C_k along a diagonal of the cells, in steps along it: spheres on 200 to 220 cells against Hertz,
/// normals within 22.5 degrees; off by 0.012 of a step, at most 0.04.
const ALONG_DIAGONAL: [f64; 5] = [-0.0907, 0.9395, -0.7648, 0.8832, 0.0];
/// Excess of L_2 over the rise of L per cell, from the same contacts: a parabola in s.
const SECOND: [[f64; 3]; 2] = [[0.0411, -0.0895, 0.0593], [0.0110, -0.0307, 0.0235]];
/// Largest second difference of the three over the first: beyond it there is no root.
const BEND: f64 = 0.5;
/// Largest r of a cell whose neighbour outside is not in the zone.
const LARGEST: f64 = 1.1;

impl Parabola {
    /// Fits the squares of the outermost cells along an axis or a diagonal: zero at the border,
    /// exact in the second and the third cell; s counts from the second. `None` where the three
    /// values do not belong to a root.
    pub(crate) fn from_discrete_root(levels: &[f64], diagonal: bool) -> Option<Self> {
        let &[first, second, third, ..] = levels else {
            return None;
        };
        let (rise, bend) = (second - first, third - 2.0 * second + first);
        let r = first / (rise - bend);
        let is_root = rise > 0.0 && bend.abs() <= BEND * rise && (0.0..=LARGEST).contains(&r);
        if !is_root {
            return None;
        }
        let series = |c: &[f64], x: f64| c.iter().rev().fold(0.0, |sum, c| sum * x + c);
        let (places, excess) = if diagonal {
            (&ALONG_DIAGONAL, &SECOND[1])
        } else {
            (&ALONG_AXIS, &SECOND[0])
        };
        let s = series(places, r.sqrt());
        let [second, third] = [
            (second - rise * series(excess, s)) / (s + 1.0),
            third / (s + 2.0),
        ];
        let bend = third - second;
        let slope = second - bend * (s + 1.0);
        let c = [second * (s + 1.0), slope + 2.0 * bend * (s + 1.0), bend];
        (slope > 0.0).then(|| Self::new(c, 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hertz::line_contact;
    use crate::march::March;
    use crate::scene::{Body, Elastic, Friction, Grid, LoadPath, Scene, Settings, Shape};

    /// Hertz: every place of the border within a cell, and the pressure next to it.
    #[test]
    fn the_border_of_a_cylinder_is_within_a_hundredth_of_a_cell() {
        let (E, nu, R, W, n) = (210e9, 0.3, 0.01, 1e5, 400);
        let material = Elastic { E, nu };
        let a = line_contact(R, E / 2.0 / (1.0 - nu * nu), W).a;
        for k in 0..13 {
            // Number of cells beside the contact.
            let cells_outside = 40.0 + (f64::from(k) + 0.5) / 13.0;
            let cells = 0.5 * n as f64 - cells_outside;
            let grid = Grid::strip(n as f64 * a / cells, n, 1.0).expect("a grid");
            let shape = Shape::Cylinder {
                R,
                length: f64::INFINITY,
                angle: 0.0,
            };
            let scene = Scene {
                title: String::new(),
                body1: Body::homogeneous(material, shape),
                body2: Body::homogeneous(material, Shape::Flat),
                friction: Friction::coulomb(0.0),
                grid,
                path: LoadPath::start().normal(W, 1),
                settings: Settings::default(),
            };
            let mut march = March::new(&scene).expect("a scene");
            while let Some(increment) = march.advance() {
                increment.expect("a solution");
            }
            let p = march.fields().p;
            let first = p.iter().position(|p| *p > 0.0).expect("a contact");
            let levels: Vec<f64> = p.iter().skip(first).take(3).map(|p| p * p).collect();
            let root = Parabola::from_discrete_root(&levels, false).expect("a root");
            let inside = first as f64 + 0.5 - cells_outside;
            // The root of the parabola, by Newton's method.
            let mut border = root.outermost;
            (0..9).for_each(|_| border -= root.evaluate(border) / root.slope(border));
            let error = root.outermost - border - inside;
            assert!(error.abs() < 0.01, "{inside}: off by {error}");
            // p^2 = p0^2 (1 - x^2/a^2) half a cell from the border.
            let p0 = 2.0 * W / (std::f64::consts::PI * a);
            let exact = p0 * p0 / cells * (1.0 - 0.25 / cells);
            let half = root.evaluate(border + 0.5) / exact;
            // Within 2.5 % of p: most where the outermost middle lies outside.
            assert!((half - 1.0).abs() < 0.05, "{inside}: {half}");
        }
    }
}
