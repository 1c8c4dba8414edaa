//! Stress and displacement of the surface from eigenstrains and tractions.

use rayon::prelude::*;
use rustfft::num_complex::Complex64;

use crate::COMPONENTS;
use crate::factors::{Chunk, LANES};
use crate::mesh::Mesh;
use crate::sweep::{Parts, Rows, Scratch, sweep};
use crate::transform::Transform;

/// Loads of the body.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sources<'a> {
    /// Eigenstrain: for each plane six components, each on the cells, x first.
    pub eigenstrain: Option<&'a [f64]>,
    /// t_x, t_y, t_z on the cells \[Pa\]; pressure is t_z.
    pub tractions: Option<[&'a [f64]; 3]>,
}

/// Results.
#[derive(Debug)]
pub struct Answer<'a> {
    /// Stress \[Pa\], laid out as the eigenstrain; planes that are not wanted are left as they are.
    pub stress: &'a mut [f64],
    /// Planes on which the stress is wanted.
    pub wanted: &'a [bool],
    /// u_x, u_y, u_z of the surface on the cells \[m\], one after the other.
    pub displacement: &'a mut [f64],
    /// Whether the displacement includes the tractions'; in plane strain this is relative to a
    /// point far away, whose distance the cells set. Without, it is the eigenstrain's alone.
    pub of_tractions: bool,
}

/// The response of a layered half-space, with its work space: no memory is taken after the first
/// call.
#[derive(Debug)]
pub struct Operator {
    mesh: Mesh,
    transform: Transform,
    chunks: Vec<Chunk>,
    /// Waves in a row, padded to whole chunks.
    stride: usize,
    polarisation: Vec<Complex64>,
    tractions: Vec<Complex64>,
    filled: Vec<bool>,
    answers: Vec<Parts>,
}

impl Operator {
    /// Computes the factors of every wave number of the mesh.
    pub fn new(mesh: Mesh) -> Self {
        let transform = Transform::new(&mesh.cells);
        let chunks = Chunk::all(&mesh, transform.waves());
        let stride = chunks.len() * LANES;
        Self {
            stride,
            polarisation: Vec::new(),
            tractions: Vec::new(),
            filled: vec![false; mesh.planes()],
            answers: Vec::new(),
            mesh,
            transform,
            chunks,
        }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// Length of the eigenstrain and of the stress: planes times components times cells.
    pub fn len(&self) -> usize {
        self.mesh.planes() * COMPONENTS * self.mesh.cells.len()
    }

    /// Whether there are no cells.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Stress and displacement of the surface.
    ///
    /// # Panics
    /// If a field has another length than the mesh asks for.
    pub fn apply(&mut self, sources: Sources<'_>, answer: Answer<'_>) {
        let cells = self.mesh.cells.len();
        assert_eq!(answer.stress.len(), self.len(), "the length of the stress");
        assert_eq!(answer.wanted.len(), self.mesh.planes(), "a mark per plane");
        assert_eq!(
            answer.displacement.len(),
            3 * cells,
            "the length of the displacement"
        );
        self.transform_sources(sources);
        let (wanted, of_tractions) = (answer.wanted, answer.of_tractions);
        let planes = wanted.iter().filter(|wanted| **wanted).count();
        let per_chunk = COMPONENTS * planes + 3;
        let zero = [[0.0; LANES]; 2];
        self.answers.resize(self.chunks.len() * per_chunk, zero);
        let Self {
            mesh,
            transform,
            chunks,
            answers,
            ..
        } = self;
        let (mesh, transform) = (&*mesh, &*transform);
        let (polarisation, filled, stride) = (&self.polarisation, &self.filled, self.stride);
        let tractions = sources.tractions.map(|_| &self.tractions[..]);
        let swept = answers.par_chunks_exact_mut(per_chunk).zip(&*chunks);
        swept.enumerate().for_each_init(
            || Scratch::new(mesh),
            |scratch, (n, (answers, chunk))| {
                let rows = Rows {
                    polarisation,
                    filled,
                    tractions,
                    of_tractions,
                    stride,
                    from: n * LANES,
                };
                sweep(mesh, chunk, rows, wanted, scratch, answers);
            },
        );
        let answers = &*answers;
        let wave = |row: usize, at: usize| {
            let [re, im] = &answers[at / LANES * per_chunk + row];
            Complex64::new(re[at % LANES], im[at % LANES])
        };
        let stresses = answer.stress.par_chunks_exact_mut(COMPONENTS * cells);
        let stresses = stresses.zip(wanted).filter(|(_, wanted)| **wanted);
        let stresses: Vec<&mut [f64]> = stresses.map(|(stress, _)| stress).collect();
        let fields = stresses.into_par_iter().chain([answer.displacement]);
        fields.enumerate().for_each_init(
            || transform.buffers(),
            |buffers, (plane, fields)| {
                let first = COMPONENTS * plane;
                transform.to_fields(|n, at| wave(first + n, at), fields, buffers);
            },
        );
    }

    /// Transforms the stress of the eigenstrains and the tractions to waves; marks the planes that have
    /// eigenstrain.
    fn transform_sources(&mut self, sources: Sources<'_>) {
        let (cells, stride) = (self.mesh.cells.len(), self.stride);
        let (transform, mesh) = (&self.transform, &self.mesh);
        self.filled.fill(false);
        if let Some(eigenstrain) = sources.eigenstrain {
            let block = COMPONENTS * cells;
            assert_eq!(
                eigenstrain.len(),
                mesh.planes() * block,
                "the length of the eigenstrain"
            );
            let length = mesh.planes() * COMPONENTS * stride;
            self.polarisation.resize(length, Complex64::default());
            let rows = self.polarisation.par_chunks_exact_mut(COMPONENTS * stride);
            let planes = eigenstrain.par_chunks_exact(block).zip(rows);
            let planes = planes.zip(&mut self.filled).enumerate();
            planes.for_each_init(
                || (transform.buffers(), vec![0.0; block]),
                |(buffers, tau), (plane, ((strain, rows), filled))| {
                    *filled = strain.iter().any(|e| *e != 0.0);
                    if *filled {
                        polarise(mesh.layers()[mesh.layer(plane)].lame(), strain, tau);
                        transform.to_waves(tau, rows, stride, buffers);
                    }
                },
            );
        }
        if let Some(tractions) = sources.tractions {
            self.tractions.resize(3 * stride, Complex64::default());
            let mut buffers = transform.buffers();
            for (field, to) in tractions
                .iter()
                .zip(self.tractions.chunks_exact_mut(stride))
            {
                assert_eq!(field.len(), cells, "the length of a traction");
                transform.to_waves(field, to, stride, &mut buffers);
            }
        }
    }
}

/// The polarisation stress of an eigenstrain e: tau = C : e = 2 mu e + lambda tr e.
fn polarise([lambda, mu]: [f64; 2], strain: &[f64], tau: &mut [f64]) {
    let cells = strain.len() / COMPONENTS;
    for (to, of) in tau.iter_mut().zip(strain) {
        *to = 2.0 * mu * of;
    }
    for n in 0..cells {
        let volume = lambda * (strain[n] + strain[cells + n] + strain[2 * cells + n]);
        for c in 0..3 {
            tau[c * cells + n] += volume;
        }
    }
}
