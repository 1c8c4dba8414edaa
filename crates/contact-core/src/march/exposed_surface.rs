//! The surfaces that a march finds after wear.

/// The surfaces that wear has left, on the kept cells; empty fields for fresh surfaces.
#[derive(Clone, Debug, Default)]
pub struct ExposedSurface {
    /// Factor of the friction coefficient.
    pub friction: Vec<f64>,
    /// Depth worn off body 1 and body 2 \[m\].
    pub worn: [Vec<f64>; 2],
    /// Layer of body 1 and body 2 that is exposed, from 0 for the outermost.
    pub layer: [Vec<f64>; 2],
    /// Debris per area \[m\].
    pub bed: Vec<f64>,
    /// Share of the cell that oxygen reaches.
    pub aerated: Vec<f64>,
}
