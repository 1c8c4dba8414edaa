//! The variables on which a wear coefficient may depend.

/// The variable of the factor of a wear coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FactorVariable {
    /// Cycles done so far, the same for all cells.
    Cycles,
    /// Mean pressure of a cell over its slip \[Pa\].
    Pressure,
    /// Energy dissipated per area and time: the energy of a cycle times the frequency \[W/m^2\].
    PowerDensity,
    /// Energy dissipated per area so far \[J/m^2\].
    Energy,
}

impl FactorVariable {
    /// All variables, with their names in scene files.
    pub const ALL: [(&'static str, Self); 4] = [
        ("cycles", Self::Cycles),
        ("pressure", Self::Pressure),
        ("power_density", Self::PowerDensity),
        ("energy", Self::Energy),
    ];

    /// Its name in scene files.
    pub fn name(self) -> &'static str {
        Self::ALL
            .iter()
            .find(|(_, of)| *of == self)
            .map_or("", |(name, _)| name)
    }
}
