//! Factors of all wave numbers, in lanes.

use rayon::prelude::*;

use crate::column::{FACTORS, TOP, eliminate};
use crate::mesh::Mesh;
use crate::waves::Wave;

/// Wave numbers that are computed side by side.
pub(crate) const LANES: usize = 8;
/// A number of each of them.
pub(crate) type Lane = [f64; LANES];

/// The wave numbers of a chunk, and what the elimination left of them.
#[derive(Debug)]
pub(crate) struct Chunk {
    pub(crate) k: Lane,
    /// Direction of the wave vector.
    pub(crate) cos: Lane,
    pub(crate) sin: Lane,
    /// Weight of the wave in the sum.
    pub(crate) weight: Lane,
    /// Factors of each element, from the surface down.
    pub(crate) elements: Vec<[Lane; FACTORS]>,
    pub(crate) top: [Lane; TOP],
}

impl Chunk {
    /// Computes the factors of all wave numbers, in parallel.
    fn new(mesh: &Mesh, waves: &[Wave]) -> Self {
        let mut chunk = Self {
            k: [1.0; LANES],
            cos: [1.0; LANES],
            sin: [0.0; LANES],
            weight: [0.0; LANES],
            elements: vec![[[0.0; LANES]; FACTORS]; mesh.elements()],
            top: [[0.0; LANES]; TOP],
        };
        for (lane, wave) in waves.iter().enumerate() {
            let k = wave.k[0].hypot(wave.k[1]);
            if k == 0.0 {
                // Left out: its weight in the plane is zero.
                continue;
            }
            chunk.k[lane] = k;
            chunk.cos[lane] = wave.k[0] / k;
            chunk.sin[lane] = wave.k[1] / k;
            chunk.weight[lane] = wave.weight;
            let elements = &mut chunk.elements;
            let top = eliminate(mesh, k, |element, factors| {
                for (to, of) in elements[element].iter_mut().zip(factors) {
                    to[lane] = of;
                }
            });
            for (to, of) in chunk.top.iter_mut().zip(top) {
                to[lane] = of;
            }
        }
        chunk
    }

    /// The chunks of all waves.
    pub(crate) fn all(mesh: &Mesh, waves: &[Wave]) -> Vec<Self> {
        let chunks = waves.par_chunks(LANES);
        chunks.map(|waves| Self::new(mesh, waves)).collect()
    }
}
