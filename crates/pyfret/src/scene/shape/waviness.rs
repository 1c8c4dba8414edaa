//! A wave on a surface.

use super::elementary::elementary;

elementary!(
    /// A wave along the direction `angle`, a crest at the origin for phase 0; add it to a shape.
    ///
    /// Parameters
    /// ----------
    /// amplitude : float
    ///     Height of a crest above the mean [m].
    /// wavelength : float
    ///     Distance of the crests [m].
    /// angle : float
    ///     Direction, from x towards y [rad].
    /// phase : float
    ///     Phase at the origin [rad].
    Waviness {
        /// Height of a crest above the mean [m].
        amplitude,
        /// Distance of the crests [m].
        wavelength,
        /// Direction, from x towards y [rad].
        angle,
        /// Phase at the origin [rad].
        phase
    },
    (*, amplitude: "Length", wavelength: "Length", angle: "Angle" = 0.0, phase: "Angle" = 0.0)
);
