//! Rolling: the state at the start of an increment, carried along with the material.

use contact_core::march::Fields;
use ndarray::Array2;

use super::{Audit, End};

impl Audit {
    /// Cells that the contact rolls on along x in the increment.
    pub(super) fn rolls(&self, now: &End) -> isize {
        let at = |rolled: f64| (rolled / self.scene.grid.dx).round() as isize;
        at(now.loads.rolled) - at(self.start.loads.rolled)
    }

    /// Carries the start of the increment, and where cells have come to rest, along with the
    /// material; material from beyond the cells was moved by the tractions there alone.
    pub(super) fn roll(&mut self, cells: isize) {
        if cells == 0 {
            return;
        }
        let f = &self.start.fields;
        let carried = |f: &Array2<f64>| carried(f, cells, 0.0);
        let marked = |f: &Array2<bool>| self::carried(f, cells, false);
        let mut fields = Fields {
            p: carried(&f.p),
            q_x: carried(&f.q_x),
            q_y: carried(&f.q_y),
            u_x: carried(&f.u_x),
            u_y: carried(&f.u_y),
            u_z: carried(&f.u_z),
            indentation: carried(&f.indentation),
            gap: carried(&f.gap),
            slip_x: carried(&f.slip_x),
            slip_y: carried(&f.slip_y),
            dissipated: carried(&f.dissipated),
            contact: marked(&f.contact),
            stick: marked(&f.stick),
            at_limit: marked(&f.at_limit),
            yielded: f.yielded.clone(),
        };
        let of_tractions = self.response.of(&fields);
        let ny = self.scene.grid.ny;
        let u = [&mut fields.u_x, &mut fields.u_y, &mut fields.u_z];
        for (u, of_tractions) in u.into_iter().zip(of_tractions) {
            for ((i, j), u) in u.indexed_iter_mut() {
                if source(i, cells, self.scene.grid.nx).is_none() {
                    *u = of_tractions[i * ny + j];
                }
            }
        }
        self.start.fields = fields;
        self.rest.roll(cells);
    }

    /// Growth of the undeformed gap of the material in a cell \[m\]; none of material from beyond
    /// the cells.
    pub(super) fn wider(&self, (i, j): (usize, usize), cells: isize) -> f64 {
        let from = source(i, cells, self.scene.grid.nx);
        from.map_or(0.0, |from| self.h_init[(i, j)] - self.h_init[(from, j)])
    }
}

/// The column in which the material of column i was before.
fn source(i: usize, cells: isize, nx: usize) -> Option<usize> {
    i.checked_add_signed(cells).filter(|from| *from < nx)
}

/// A field carried along with the material.
pub(super) fn carried<T: Copy>(field: &Array2<T>, cells: isize, beyond: T) -> Array2<T> {
    let nx = field.nrows();
    Array2::from_shape_fn(field.dim(), |(i, j)| {
        source(i, cells, nx).map_or(beyond, |from| field[(from, j)])
    })
}
