//! One pass up and one down through the elements, for a chunk of wave numbers.

use rustfft::num_complex::Complex64;

use crate::COMPONENTS;
use crate::column::Shapes;
use crate::factors::{Chunk, LANES, Lane};
use crate::mesh::{Mesh, PLANES_PER_ELEMENT};

/// Real and imaginary part.
pub(crate) type Parts = [Lane; 2];
const ZERO: Parts = [[0.0; LANES]; 2];

/// A symmetric tensor in the axes of the wave: 11, 22, 33, (i 13), (-i 12), 23.
type Turned = [Parts; COMPONENTS];

/// Work space of a sweep.
#[derive(Debug)]
pub(crate) struct Scratch {
    /// r_b of (v, w, u_2) of each element.
    right: Vec<[Parts; 3]>,
    /// M f_m of each element.
    middle: Vec<[Parts; 3]>,
    /// The sources of both planes of each element.
    sources: Vec<Turned>,
}

impl Scratch {
    /// Allocates the buffers of one thread.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        Self {
            right: vec![[ZERO; 3]; mesh.elements()],
            middle: vec![[ZERO; 3]; mesh.elements()],
            sources: vec![[ZERO; COMPONENTS]; mesh.planes()],
        }
    }
}

/// Input of a sweep: transforms of the sources, in rows of one wave number after the other.
#[derive(Clone, Copy)]
pub(crate) struct Rows<'a> {
    /// Six rows of the polarisation for each plane.
    pub(crate) polarisation: &'a [Complex64],
    /// Planes that have any.
    pub(crate) filled: &'a [bool],
    /// t_x, t_y, t_z.
    pub(crate) tractions: Option<&'a [Complex64]>,
    /// Whether their displacement of the surface is wanted.
    pub(crate) of_tractions: bool,
    /// Length of a row.
    pub(crate) stride: usize,
    /// Begin of the chunk in it.
    pub(crate) from: usize,
}

impl Rows<'_> {
    /// Real and imaginary parts of one row of a chunk of waves.
    fn lane(&self, all: &[Complex64], row: usize) -> Parts {
        let at = row * self.stride + self.from;
        let of = &all[at..at + LANES];
        let mut parts = ZERO;
        for l in 0..LANES {
            parts[0][l] = of[l].re;
            parts[1][l] = of[l].im;
        }
        parts
    }

    /// The polarisation stress of a plane, turned into the axes of each wave.
    fn turned(&self, chunk: &Chunk, plane: usize) -> Turned {
        let [xx, yy, zz, xy, xz, yz]: [Parts; COMPONENTS] =
            std::array::from_fn(|c| self.lane(self.polarisation, COMPONENTS * plane + c));
        let mut turned = [ZERO; COMPONENTS];
        for part in 0..2 {
            let (other, sign) = (1 - part, if part == 0 { -1.0 } else { 1.0 });
            for l in 0..LANES {
                let (c, s) = (chunk.cos[l], chunk.sin[l]);
                let double = 2.0 * c * s * xy[part][l];
                turned[0][part][l] = c * c * xx[part][l] + s * s * yy[part][l] + double;
                turned[1][part][l] = s * s * xx[part][l] + c * c * yy[part][l] - double;
                turned[2][part][l] = zz[part][l];
                // i z has the parts (-Im z, Re z), -i z has (Im z, -Re z).
                turned[3][part][l] = sign * (c * xz[other][l] + s * yz[other][l]);
                let t_12 = c * s * (yy[other][l] - xx[other][l]) + (c * c - s * s) * xy[other][l];
                turned[4][part][l] = -sign * t_12;
                turned[5][part][l] = c * yz[part][l] - s * xz[part][l];
            }
        }
        turned
    }
}

/// Output of the stress of a sweep: for each wanted plane six components, then u_x, u_y, u_z.
pub(crate) type Answers = [Parts];

/// Solves the equations of a chunk: stress on the `wanted` planes and displacement of the surface,
/// both times the weight of the wave.
pub(crate) fn sweep(
    mesh: &Mesh,
    chunk: &Chunk,
    rows: Rows<'_>,
    wanted: &[bool],
    scratch: &mut Scratch,
    answers: &mut Answers,
) {
    let (stresses, surface) = answers.split_at_mut(answers.len() - 3);
    let mut right = up(mesh, chunk, rows, scratch);
    if !rows.of_tractions {
        displacement(chunk, &of_surface(chunk, &right), surface);
    }
    if let Some(tractions) = rows.tractions {
        add_tractions(chunk, rows, tractions, &mut right);
    }
    let mut u = of_surface(chunk, &right);
    if rows.of_tractions {
        displacement(chunk, &u, surface);
    }
    let mut stresses = stresses.chunks_exact_mut(COMPONENTS);
    let lowest = wanted.iter().rposition(|wanted| *wanted);
    for element in 0..lowest.map_or(0, |plane| plane / PLANES_PER_ELEMENT + 1) {
        let [middle, lower] = lower_nodes(chunk, element, scratch, &u);
        let nodes = [&u, &middle, &lower];
        let lame = mesh.lame(element);
        let k_shapes = Shapes::at_gauss_points(mesh.height(element));
        for (side, shapes) in k_shapes.iter().enumerate() {
            let plane = PLANES_PER_ELEMENT * element + side;
            if !wanted[plane] {
                continue;
            }
            let source = rows.filled[plane].then(|| &scratch.sources[plane]);
            if let Some(to) = stresses.next() {
                stress(chunk, shapes, lame, nodes, source, to);
            }
        }
        u = lower;
    }
}

/// (v, w, u_2) of a node.
type Node = [Parts; 3];
const ZERO_NODE: Node = [ZERO; 3];

/// Solves for the displacements (v, w, u_2) of the surface from its condensed right-hand side.
fn of_surface(chunk: &Chunk, right: &Node) -> Node {
    let mut u = ZERO_NODE;
    let [vv, vw, ww, out] = &chunk.top;
    for part in 0..2 {
        for l in 0..LANES {
            let (v, w) = (right[0][part][l], right[1][part][l]);
            u[0][part][l] = vv[l] * v + vw[l] * w;
            u[1][part][l] = vw[l] * v + ww[l] * w;
            u[2][part][l] = out[l] * right[2][part][l];
        }
    }
    u
}

/// The pass from the bottom to the surface: right-hand sides of the elements, condensed; returns the one of the
/// surface.
fn up(mesh: &Mesh, chunk: &Chunk, rows: Rows<'_>, scratch: &mut Scratch) -> Node {
    let mut below = ZERO_NODE;
    let lowest = rows.filled.iter().rposition(|filled| *filled);
    let sources = lowest.map_or(0, |plane| plane / PLANES_PER_ELEMENT + 1);
    // Nothing comes from below the lowest source.
    scratch.right[sources..].fill(ZERO_NODE);
    scratch.middle[sources..].fill(ZERO_NODE);
    for element in (0..sources).rev() {
        let mut f = [ZERO_NODE; 3];
        for (side, shapes) in Shapes::at_gauss_points(mesh.height(element))
            .iter()
            .enumerate()
        {
            let plane = PLANES_PER_ELEMENT * element + side;
            if !rows.filled[plane] {
                continue;
            }
            let t = rows.turned(chunk, plane);
            let Shapes { N, dN, weight } = *shapes;
            for (node, f) in f.iter_mut().enumerate() {
                let (slope, value) = (weight * dN[node], weight * N[node]);
                for part in 0..2 {
                    for l in 0..LANES {
                        let kn = chunk.k[l] * value;
                        f[0][part][l] += kn * t[0][part][l] + slope * t[3][part][l];
                        f[1][part][l] += slope * t[2][part][l] - kn * t[3][part][l];
                        f[2][part][l] += kn * t[4][part][l] + slope * t[5][part][l];
                    }
                }
            }
            scratch.sources[plane] = t;
        }
        let F = &chunk.elements[element];
        let [upper, middle, lower] = &f;
        let (right, condensed) = (&mut scratch.right[element], &mut scratch.middle[element]);
        for part in 0..2 {
            for l in 0..LANES {
                let [v, w, u] = [0, 1, 2].map(|i| middle[i][part][l]);
                let r_v = lower[0][part][l] - F[7][l] * v - F[9][l] * w + below[0][part][l];
                let r_w = lower[1][part][l] - F[8][l] * v - F[10][l] * w + below[1][part][l];
                let r_u = lower[2][part][l] - F[20][l] * u + below[2][part][l];
                condensed[0][part][l] = F[0][l] * v + F[1][l] * w;
                condensed[1][part][l] = F[1][l] * v + F[2][l] * w;
                condensed[2][part][l] = F[18][l] * u;
                right[0][part][l] = r_v;
                right[1][part][l] = r_w;
                right[2][part][l] = r_u;
                below[0][part][l] =
                    upper[0][part][l] - F[3][l] * v - F[5][l] * w - F[14][l] * r_v - F[16][l] * r_w;
                below[1][part][l] =
                    upper[1][part][l] - F[4][l] * v - F[6][l] * w - F[15][l] * r_v - F[17][l] * r_w;
                below[2][part][l] = upper[2][part][l] - F[19][l] * u - F[22][l] * r_u;
            }
        }
    }
    below
}

/// Adds (i t_1, t_3) and t_2.
fn add_tractions(chunk: &Chunk, rows: Rows<'_>, tractions: &[Complex64], right: &mut Node) {
    let [x, y, z] = [0, 1, 2].map(|c| rows.lane(tractions, c));
    for part in 0..2 {
        let (other, sign) = (1 - part, if part == 0 { -1.0 } else { 1.0 });
        for l in 0..LANES {
            let (c, s) = (chunk.cos[l], chunk.sin[l]);
            right[0][part][l] += sign * (c * x[other][l] + s * y[other][l]);
            right[1][part][l] += z[part][l];
            right[2][part][l] += c * y[part][l] - s * x[part][l];
        }
    }
}

/// Displacements of the middle and the lower node of an element, from the upper one.
fn lower_nodes(chunk: &Chunk, element: usize, scratch: &Scratch, upper: &Node) -> [Node; 2] {
    let F = &chunk.elements[element];
    let (right, condensed) = (&scratch.right[element], &scratch.middle[element]);
    let (mut middle, mut lower) = (ZERO_NODE, ZERO_NODE);
    for part in 0..2 {
        for l in 0..LANES {
            let [v, w, u] = [0, 1, 2].map(|i| upper[i][part][l]);
            let [r_v, r_w, r_u] = [0, 1, 2].map(|i| right[i][part][l]);
            let v_b = F[11][l] * r_v + F[12][l] * r_w - F[14][l] * v - F[15][l] * w;
            let w_b = F[12][l] * r_v + F[13][l] * r_w - F[16][l] * v - F[17][l] * w;
            let u_b = F[21][l] * r_u - F[22][l] * u;
            lower[0][part][l] = v_b;
            lower[1][part][l] = w_b;
            lower[2][part][l] = u_b;
            middle[0][part][l] =
                condensed[0][part][l] - F[3][l] * v - F[4][l] * w - F[7][l] * v_b - F[8][l] * w_b;
            middle[1][part][l] =
                condensed[1][part][l] - F[5][l] * v - F[6][l] * w - F[9][l] * v_b - F[10][l] * w_b;
            middle[2][part][l] = condensed[2][part][l] - F[19][l] * u - F[20][l] * u_b;
        }
    }
    [middle, lower]
}

/// Turns the displacement of the surface into the axes of the scene: u_x, u_y, u_z.
fn displacement(chunk: &Chunk, u: &Node, to: &mut [Parts]) {
    for part in 0..2 {
        // -i v has the parts (Im v, -Re v).
        let (other, sign) = (1 - part, if part == 0 { 1.0 } else { -1.0 });
        for l in 0..LANES {
            let (c, s, weight) = (chunk.cos[l], chunk.sin[l], chunk.weight[l]);
            let (u_1, u_2) = (sign * u[0][other][l], u[2][part][l]);
            to[0][part][l] = weight * (c * u_1 - s * u_2);
            to[1][part][l] = weight * (s * u_1 + c * u_2);
            to[2][part][l] = weight * u[1][part][l];
        }
    }
}

/// The stress at a Gauss point, in the axes of the scene.
fn stress(
    chunk: &Chunk,
    shapes: &Shapes,
    [lambda, mu]: [f64; 2],
    nodes: [&Node; 3],
    source: Option<&Turned>,
    to: &mut [Parts],
) {
    let none = [ZERO; COMPONENTS];
    let tau = source.unwrap_or(&none);
    let Shapes { N, dN, .. } = *shapes;
    let at = |of: [f64; 3], i: usize, part: usize, l: usize| {
        of[0] * nodes[0][i][part][l] + of[1] * nodes[1][i][part][l] + of[2] * nodes[2][i][part][l]
    };
    let (mut s_13, mut s_12) = (ZERO, ZERO);
    let mut diagonal = [ZERO; 3];
    let mut s_23 = ZERO;
    for part in 0..2 {
        for l in 0..LANES {
            let k = chunk.k[l];
            let e_11 = k * at(N, 0, part, l);
            let e_33 = at(dN, 1, part, l);
            let g = at(dN, 0, part, l) - k * at(N, 1, part, l);
            let (u_2, slope) = (at(N, 2, part, l), at(dN, 2, part, l));
            let volume = lambda * (e_11 + e_33);
            diagonal[0][part][l] = volume + 2.0 * mu * e_11 - tau[0][part][l];
            diagonal[1][part][l] = volume - tau[1][part][l];
            diagonal[2][part][l] = volume + 2.0 * mu * e_33 - tau[2][part][l];
            s_13[part][l] = mu * g - tau[3][part][l];
            s_12[part][l] = mu * k * u_2 - tau[4][part][l];
            s_23[part][l] = mu * slope - tau[5][part][l];
        }
    }
    for part in 0..2 {
        let (other, sign) = (1 - part, if part == 0 { 1.0 } else { -1.0 });
        for l in 0..LANES {
            let (c, s, weight) = (chunk.cos[l], chunk.sin[l], chunk.weight[l]);
            let (s_11, s_22) = (diagonal[0][part][l], diagonal[1][part][l]);
            // s_13 = -i S_13, s_12 = i S_12.
            let s_13 = sign * s_13[other][l];
            let s_12 = -sign * s_12[other][l];
            let s_23 = s_23[part][l];
            to[0][part][l] = weight * (c * c * s_11 + s * s * s_22 - 2.0 * c * s * s_12);
            to[1][part][l] = weight * (s * s * s_11 + c * c * s_22 + 2.0 * c * s * s_12);
            to[2][part][l] = weight * diagonal[2][part][l];
            to[3][part][l] = weight * (c * s * (s_11 - s_22) + (c * c - s * s) * s_12);
            to[4][part][l] = weight * (c * s_13 - s * s_23);
            to[5][part][l] = weight * (s * s_13 + c * s_23);
        }
    }
}
