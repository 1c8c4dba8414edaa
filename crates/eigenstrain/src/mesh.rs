//! The mesh: cells in the plane, elements in depth.

use crate::error::Error;

/// Gauss points of an element: planes on which eigenstrain and stress stand.
pub const PLANES_PER_ELEMENT: usize = 2;
/// Position of the Gauss points in an element, from -1 to 1: -+ 1/sqrt(3).
pub(crate) const GAUSS_POINT: f64 = 0.577_350_269_189_625_8;
/// Growth of the height per distance from the nearest end of a layer.
const SLOPE: f64 = 0.2;
/// Growth of the height from one element to the next below the zone.
const GROWTH: f64 = 1.6;
/// Most that one side of a cell may be longer than the other: the number of waves grows with it.
const MOST_ELONGATED: f64 = 100.0;

/// A layer, or the substrate with an infinite thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layer {
    /// Young's modulus \[Pa\], positive and finite.
    pub E: f64,
    /// Poisson's ratio, -1 < nu < 1/2.
    pub nu: f64,
    /// Thickness \[m\]; infinite for the substrate.
    pub thickness: f64,
}

impl Layer {
    /// Lame's constants lambda, mu \[Pa\].
    pub fn lame(&self) -> [f64; 2] {
        let mu = self.E / (2.0 * (1.0 + self.nu));
        [2.0 * mu * self.nu / (1.0 - 2.0 * self.nu), mu]
    }

    /// Fails at moduli or a thickness without meaning; `n` is the number of the layer.
    fn check(&self, n: usize) -> Result<(), Error> {
        if !(self.E > 0.0 && self.E.is_finite()) {
            let key = format!("layers[{n}].E");
            return Err(Error::new(key, self.E, "a positive, finite modulus in Pa"));
        }
        if !(self.nu > -1.0 && self.nu < 0.5) {
            return Err(Error::new(
                format!("layers[{n}].nu"),
                self.nu,
                "-1 < nu < 0.5",
            ));
        }
        if !(self.thickness > 0.0) {
            let key = format!("layers[{n}].thickness");
            return Err(Error::new(key, self.thickness, "a positive length in m"));
        }
        Ok(())
    }
}

/// Cells in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cells {
    /// Number along x.
    pub nx: usize,
    /// Number along y; 1 in plane strain.
    pub ny: usize,
    /// Length along x \[m\].
    pub dx: f64,
    /// Length along y \[m\].
    pub dy: f64,
    /// Whether nothing depends on y.
    pub plane_strain: bool,
}

impl Cells {
    /// Fails at numbers or sides of cells that the transforms cannot take.
    fn check(&self) -> Result<(), Error> {
        for (key, n) in [("nx", self.nx), ("ny", self.ny)] {
            if n == 0 {
                return Err(Error::new(key, n, "at least 1 cell"));
            }
        }
        for (key, length) in [("dx", self.dx), ("dy", self.dy)] {
            if !(length > 0.0 && length.is_finite()) {
                return Err(Error::new(key, length, "a positive length in m"));
            }
        }
        let ratio = (self.dx / self.dy).max(self.dy / self.dx);
        if !self.plane_strain && ratio > MOST_ELONGATED {
            let allowed = format!("sides of cells within {MOST_ELONGATED} times of each other");
            return Err(Error::new(
                "dx, dy",
                format!("{}, {}", self.dx, self.dy),
                allowed,
            ));
        }
        if self.plane_strain && self.ny != 1 {
            return Err(Error::new("ny", self.ny, "1 in plane strain"));
        }
        Ok(())
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.nx * self.ny
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Area of a cell \[m^2\].
    pub fn area(&self) -> f64 {
        self.dx * self.dy
    }
}

/// Cells, layers and elements. Elements end at interfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Cells in the plane.
    pub cells: Cells,
    /// Layers from the surface down, the substrate last.
    layers: Vec<Layer>,
    /// Depth of the lower edge of each element \[m\].
    bottoms: Vec<f64>,
    /// Layer of each element.
    of_layer: Vec<usize>,
}

/// Heights of elements that grow with the distance from an end of a layer: fine + SLOPE z, at most
/// `height`.
struct Heights {
    fine: f64,
    height: f64,
}

impl Heights {
    /// Elements down to a distance from an end, int dz/h(z).
    fn count(&self, z: f64) -> f64 {
        let (full, of_growth) = self.full();
        if z <= full {
            return (SLOPE * z / self.fine).ln_1p() / SLOPE;
        }
        of_growth + (z - full) / self.height
    }

    /// The depth above which there are so many elements \[m\].
    fn depth(&self, count: f64) -> f64 {
        let (full, of_growth) = self.full();
        if count <= of_growth {
            return self.fine * (SLOPE * count).exp_m1() / SLOPE;
        }
        full + (count - of_growth) * self.height
    }

    /// The distance from which elements have the full height, and the elements down to there.
    fn full(&self) -> (f64, f64) {
        let growth = (self.height / self.fine).max(1.0);
        (self.fine * (growth - 1.0) / SLOPE, growth.ln() / SLOPE)
    }

    /// The edges between the elements of a layer of a thickness, fine at its top, or at both ends;
    /// two elements at least.
    fn of_layer(&self, thickness: f64, both: bool) -> Vec<f64> {
        let half = self.count(0.5 * thickness);
        let count = if both {
            2.0 * half
        } else {
            self.count(thickness)
        };
        let wanted = (count - 1e-9).ceil().max(2.0);
        let edge = |i: usize| {
            let at = i as f64 / wanted * count;
            if both && at > half {
                thickness - self.depth(count - at)
            } else {
                self.depth(at)
            }
        };
        (1..wanted as usize).map(edge).collect()
    }
}

/// Appends elements from `top` to `end` \[m\] that grow from `height` \[m\]; gives the last height.
fn growing(bottoms: &mut Vec<f64>, mut top: f64, end: f64, mut height: f64) -> f64 {
    while end - top > 1e-9 * end {
        height *= GROWTH;
        let left = end - top;
        top = if left < 1.5 * height {
            end
        } else {
            top + height
        };
        bottoms.push(top);
    }
    height
}

impl Mesh {
    /// Mesh with the given edges of elements: their lower ends \[m\], increasing. The interfaces must be among
    /// them, and the last one must lie in the substrate or at its upper end.
    pub fn new(cells: Cells, layers: Vec<Layer>, bottoms: Vec<f64>) -> Result<Self, Error> {
        cells.check()?;
        for (n, layer) in layers.iter().enumerate() {
            layer.check(n)?;
        }
        let Some((substrate, coatings)) = layers.split_last() else {
            return Err(Error::new("layers", "none", "at least the substrate"));
        };
        if substrate.thickness.is_finite() || coatings.iter().any(|c| c.thickness.is_infinite()) {
            let allowed = "an infinite thickness of the last one, the substrate, and of no other";
            return Err(Error::new("layers", layers.len(), allowed));
        }
        let increase = bottoms.windows(2).all(|w| w[1] > w[0]);
        if bottoms.is_empty() || !(bottoms[0] > 0.0) || !increase {
            let allowed = "at least one positive depth, increasing";
            return Err(Error::new("bottoms", bottoms.len(), allowed));
        }
        let mut interfaces = Vec::new();
        let mut depth = 0.0;
        for coating in coatings {
            depth += coating.thickness;
            let found = bottoms
                .iter()
                .any(|b| (b - depth).abs() <= 1e-9 * coating.thickness);
            if !found {
                return Err(Error::new(
                    "bottoms",
                    format!("no edge at {depth:e} m"),
                    "an edge of an element at every interface",
                ));
            }
            interfaces.push(depth);
        }
        let tops = std::iter::once(0.0).chain(bottoms.iter().copied());
        let middles = tops.zip(&bottoms).map(|(top, bottom)| 0.5 * (top + bottom));
        let of_layer = middles
            .map(|z| interfaces.iter().filter(|i| **i < z).count())
            .collect();
        Ok(Self {
            cells,
            layers,
            bottoms,
            of_layer,
        })
    }

    /// Builds a mesh whose elements grow with the distance from the surface and from interfaces.
    ///
    /// - `depth` \[m\]: down to here elements are at most `height` high; each layer that begins above has two
    ///   at least.
    /// - `fine`, `height` \[m\]: heights at the surface and at interfaces, and far from them.
    /// - `reach` \[m\]: below `depth` elements grow through all layers, and at least down to here.
    pub fn graded(
        cells: Cells,
        layers: Vec<Layer>,
        depth: f64,
        [fine, height]: [f64; 2],
        reach: f64,
    ) -> Result<Self, Error> {
        for (key, length) in [
            ("depth", depth),
            ("fine", fine),
            ("height", height),
            ("reach", reach),
        ] {
            if !(length > 0.0 && length.is_finite()) {
                return Err(Error::new(key, length, "a positive length in m"));
            }
        }
        let mut bottoms = Vec::new();
        let (mut top, mut coarse) = (0.0, height);
        for layer in &layers {
            let end = top + layer.thickness;
            let fine_end = depth.min(end);
            if top < depth {
                let heights = Heights { fine, height };
                let inside = heights.of_layer(fine_end - top, fine_end == end);
                bottoms.extend(inside.iter().map(|z| top + z));
                coarse = fine_end - bottoms.last().map_or(top, |last| last.max(top));
                bottoms.push(fine_end);
                top = fine_end;
            }
            let end = if end.is_finite() { end } else { reach.max(top) };
            coarse = growing(&mut bottoms, top, end, coarse);
            top = end;
        }
        Self::new(cells, layers, bottoms)
    }

    /// Mesh with growing elements below the last one, down to `factor` times its depth. Those above stay as they
    /// are.
    pub fn deepened(self, factor: f64) -> Result<Self, Error> {
        let mut bottoms = self.bottoms.clone();
        let last = self.elements() - 1;
        let bottom = self.edges(last)[1];
        growing(&mut bottoms, bottom, factor * bottom, self.height(last));
        Self::new(self.cells, self.layers, bottoms)
    }

    /// Number of elements in depth.
    pub fn elements(&self) -> usize {
        self.bottoms.len()
    }

    /// Number of planes of Gauss points.
    pub fn planes(&self) -> usize {
        PLANES_PER_ELEMENT * self.elements()
    }

    /// Depths of the upper and the lower end of an element \[m\].
    pub fn edges(&self, element: usize) -> [f64; 2] {
        let top = element
            .checked_sub(1)
            .map_or(0.0, |above| self.bottoms[above]);
        [top, self.bottoms[element]]
    }

    /// Height of an element \[m\].
    pub fn height(&self, element: usize) -> f64 {
        let [top, bottom] = self.edges(element);
        bottom - top
    }

    /// Depth of a Gauss plane below the surface \[m\].
    pub fn depth(&self, plane: usize) -> f64 {
        let [top, bottom] = self.edges(plane / PLANES_PER_ELEMENT);
        let sign = if plane.is_multiple_of(PLANES_PER_ELEMENT) {
            -1.0
        } else {
            1.0
        };
        0.5 * (top + bottom) + sign * GAUSS_POINT * 0.5 * (bottom - top)
    }

    /// Height that a plane stands for: half of its element \[m\].
    pub fn weight(&self, plane: usize) -> f64 {
        self.height(plane / PLANES_PER_ELEMENT) / PLANES_PER_ELEMENT as f64
    }

    /// Layer of a plane, from 0; the last one is the substrate.
    pub fn layer(&self, plane: usize) -> usize {
        self.of_layer[plane / PLANES_PER_ELEMENT]
    }

    /// The layers from the surface down, the substrate last.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// Lame's constants of an element \[Pa\].
    pub(crate) fn lame(&self, element: usize) -> [f64; 2] {
        self.layers[self.of_layer[element]].lame()
    }

    /// The half-space below the last element.
    pub(crate) fn half_space(&self) -> Layer {
        self.layers[self.layers.len() - 1]
    }
}
