//! The fields at the end of a block of cycles.

use ndarray::Array2;

use super::WearRun;
use crate::plan::Half;

/// Worn surfaces and the contact on them after so many cycles, each field of shape (nx, ny).
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Cycles done.
    pub cycles: f64,
    /// Depth worn off body 1 \[m\], in its own coordinates: those of the grid at no shift.
    pub worn1: Array2<f64>,
    /// Depth worn off body 2 \[m\].
    pub worn2: Array2<f64>,
    /// Pressure \[Pa\]: of a march the mean of the cycle, each increment weighted with what it
    /// dissipates; in gross slip that in the middle of the stroke.
    pub p: Array2<f64>,
    /// Shift of body 1 against body 2 along x at which p acts and the two worn surfaces lie \[m\]; zero in
    /// a march.
    pub shift: f64,
    /// Contact cells that slip nowhere in the cycle; none in gross slip.
    pub stick: Array2<bool>,
    /// Friction loop of one cycle: shift delta_x \[m\], force T_x \[N\], shift delta_y, force T_y, at the
    /// ends of its increments. The shifts are those of the rig.
    pub friction_loop: Vec<[f64; 4]>,
}

impl WearRun {
    /// The fields after the last jump.
    pub fn block(&self) -> Block {
        let pressing = self.model.pressing();
        let grid = &pressing.grid;
        let whole = |field: &[f64]| pressing.mirror.unfold(field, grid.nx, grid.ny, Half::Even);
        let seen = self.model.seen();
        let stick = match seen.stick {
            Some(stick) => {
                let ones: Vec<f64> = stick.iter().map(|s| f64::from(u8::from(*s))).collect();
                whole(&ones).mapv(|s| s > 0.5)
            }
            None => Array2::from_elem((grid.nx, grid.ny), false),
        };
        let [worn1, worn2] = &self.state().worn.depth;
        Block {
            cycles: self.state().cycles,
            worn1: whole(worn1),
            worn2: whole(worn2),
            p: whole(seen.p),
            shift: seen.shift,
            stick,
            friction_loop: seen.corners,
        }
    }

    /// Two-dimensional transforms and cycles solved so far: work that does not jitter as times do.
    pub fn work(&self) -> (usize, usize) {
        self.model.work()
    }
}
