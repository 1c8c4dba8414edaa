//! Curved surfaces: parabolas, as in Hertz's theory.

use super::elementary::elementary;

elementary!(
    /// A sphere, taken as the paraboloid r^2/(2 R) as in Hertz's theory.
    ///
    /// Parameters
    /// ----------
    /// R : float
    ///     Radius [m]; negative for a hollow.
    Sphere {
        /// Radius [m].
        R
    },
    (R: "Radius")
);
elementary!(
    /// Two principal radii, each a parabola as in Hertz's theory.
    ///
    /// Parameters
    /// ----------
    /// R_x : float
    ///     Principal radius in the direction `angle` [m]; negative for a hollow.
    /// R_y : float
    ///     Principal radius across it [m].
    /// angle : float
    ///     Direction of the first one, from x towards y [rad].
    Ellipsoid {
        /// Principal radius in the direction `angle` [m]; negative for a hollow.
        R_x,
        /// Principal radius across it [m].
        R_y,
        /// Direction of the first one, from x towards y [rad].
        angle
    },
    (*, R_x: "Radius", R_y: "Radius", angle: "Angle" = 0.0)
);
elementary!(
    /// A cylinder with sharp ends; its axis is y turned by `angle`.
    ///
    /// Parameters
    /// ----------
    /// R : float
    ///     Radius [m]; negative for a hollow.
    /// length : float
    ///     Length along the axis [m]; infinite for one that leaves the grid.
    /// angle : float
    ///     Turn of the axis from y [rad].
    Cylinder {
        /// Radius [m]; negative for a hollow.
        R,
        /// Length along the axis [m]; infinite for one that leaves the grid.
        length,
        /// Turn of the axis from y [rad].
        angle
    },
    (R: "Radius", *, length: "Length" = f64::INFINITY, angle: "Angle" = 0.0)
);
elementary!(
    /// A cylinder with rounded ends; its axis is y turned by `angle`.
    ///
    /// Parameters
    /// ----------
    /// R : float
    ///     Radius [m].
    /// length : float
    ///     Length of the straight part [m], 0 for a crown all along.
    /// crown : float
    ///     Radius along the axis beyond the straight part [m].
    /// angle : float
    ///     Turn of the axis from y [rad].
    CrownedRoller {
        /// Radius [m].
        R,
        /// Length of the straight part [m], 0 for a crown all along.
        length,
        /// Radius along the axis beyond the straight part [m].
        crown,
        /// Turn of the axis from y [rad].
        angle
    },
    (*, R: "Radius", length: "Length", crown: "Length", angle: "Angle" = 0.0)
);
