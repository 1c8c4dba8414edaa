//! The fields at the end of a block of cycles.

use contact_core::convolution::Convolutions;
use contact_core::plan::Parity;
use ndarray::Array2;

use super::WearRun;
use super::worn_start::WornStart;

/// Worn surfaces and the contact on them after a number of cycles, each field of shape (nx, ny).
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Cycles done.
    pub cycles: f64,
    /// Depth worn off body 1 \[m\], in its own coordinates: the coordinates of the grid at no
    /// shift.
    pub worn1: Array2<f64>,
    /// Depth worn off body 2 \[m\].
    pub worn2: Array2<f64>,
    /// Energy per area dissipated at body 1 so far, in its own coordinates \[J/m^2\].
    pub energy1: Array2<f64>,
    /// Energy per area dissipated at body 2 so far, in its own coordinates \[J/m^2\].
    pub energy2: Array2<f64>,
    /// Distance slipped in contact so far \[m\].
    pub slid: Array2<f64>,
    /// Debris per area in the contact, in the cells of the grid \[m\]; zero without a bed.
    pub bed: Array2<f64>,
    /// Debris that has left \[m^3\].
    pub ejected: f64,
    /// Share of each cell that oxygen reaches; 1 without a model of the air.
    pub aerated: Array2<f64>,
    /// Pressure \[Pa\]: in a march the mean of the cycle, weighted with the energy dissipated in
    /// each increment; in gross slip the pressure in the middle of the stroke.
    pub p: Array2<f64>,
    /// Shift of body 1 against body 2 along x at which p acts and the two worn surfaces lie \[m\];
    /// zero in a march.
    pub shift: f64,
    /// Way over which p is the mean, an increment of the stroke \[m\]; zero in a march.
    pub shift_length: f64,
    /// Contact cells that slip nowhere in the cycle; none in gross slip.
    pub stick: Array2<bool>,
    /// Friction loop of one cycle: shift delta_x \[m\], force T_x \[N\], shift delta_y, force T_y,
    /// at the ends of its increments. The shifts belong to the rig.
    pub friction_loop: Vec<[f64; 4]>,
}

impl Block {
    /// Lets another run start on these surfaces; `dissipated` is the energy dissipated so far \[J\].
    pub fn start(&self, dissipated: f64) -> WornStart {
        WornStart {
            cycles: self.cycles,
            dissipated,
            worn: [self.worn1.clone(), self.worn2.clone()],
            energy: [self.energy1.clone(), self.energy2.clone()],
            slid: self.slid.clone(),
            bed: Some(self.bed.clone()),
            ejected: self.ejected,
        }
    }
}

impl WearRun {
    /// The fields after the last jump.
    pub fn block(&self) -> Block {
        let pressing = self.model.pressing();
        let grid = &pressing.grid;
        let whole = |field: &[f64]| {
            pressing
                .mirror
                .unfold(field, grid.nx, grid.ny, Parity::Even)
        };
        let seen = self.model.output();
        let stick = match seen.stick {
            Some(stick) => {
                let ones: Vec<f64> = stick.iter().map(|s| f64::from(u8::from(*s))).collect();
                whole(&ones).mapv(|s| s > 0.5)
            }
            None => Array2::from_elem((grid.nx, grid.ny), false),
        };
        let worn = &self.state().worn;
        let ([worn1, worn2], [energy1, energy2]) = (&worn.depth, &worn.energy);
        Block {
            cycles: self.state().cycles,
            worn1: whole(worn1),
            worn2: whole(worn2),
            energy1: whole(energy1),
            energy2: whole(energy2),
            slid: whole(&worn.slid),
            bed: whole(&worn.bed),
            ejected: worn.ejected * pressing.cell_area(),
            aerated: if seen.aerated.is_empty() {
                Array2::ones((grid.nx, grid.ny))
            } else {
                whole(seen.aerated)
            },
            p: whole(seen.p),
            shift: seen.shift,
            shift_length: seen.shift_length,
            stick,
            friction_loop: seen.corners,
        }
    }

    /// Work of the normal problems and cycles solved so far.
    pub fn work(&self) -> (Convolutions, usize) {
        self.model.work()
    }
}
