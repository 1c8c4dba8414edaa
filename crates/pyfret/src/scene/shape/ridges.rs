//! Ridges along circles and lines.

use super::elementary::elementary;

elementary!(
    /// A round ridge along a circle about the origin: a ring, an O-ring, the rim of a cup.
    ///
    /// Parameters
    /// ----------
    /// radius : float
    ///     Radius of the circle of its crest [m].
    /// R : float
    ///     Radius of its cross-section [m].
    Ring {
        /// Radius of the circle of its crest [m].
        radius,
        /// Radius of its cross-section [m].
        R
    },
    (*, radius: "Length", R: "Radius")
);

elementary!(
    /// Parallel round ridges along y, turned by `angle`, symmetric about the origin.
    ///
    /// Between two crests the surface follows the nearer one.
    ///
    /// Parameters
    /// ----------
    /// R : float
    ///     Radius of a ridge [m].
    /// spacing : float
    ///     Distance of neighbouring crests [m].
    /// count : float
    ///     Number of ridges, a whole number; infinite (default): a row without an end.
    /// angle : float
    ///     Turn of the ridges from y [rad].
    Ridges {
        /// Radius of a ridge [m].
        R,
        /// Distance of neighbouring crests [m].
        spacing,
        /// Number of ridges; infinite for a row without an end.
        count,
        /// Turn of the ridges from y [rad].
        angle
    },
    (*, R: "Radius", spacing: "Length", count: "float" = f64::INFINITY, angle: "Angle" = 0.0)
);
