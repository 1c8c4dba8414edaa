//! Surfaces with a tip, an edge or a face.

use super::elementary::elementary;

elementary!(
    /// The contact plane itself.
    Flat {},
    ()
);
elementary!(
    /// A cone with its tip at the origin.
    ///
    /// Parameters
    /// ----------
    /// slope : float
    ///     Tangent of the angle between flank and contact plane.
    Cone {
        /// Tangent of the angle between flank and contact plane.
        slope
    },
    (*, slope: "float")
);
elementary!(
    /// Two flanks that meet in an edge; it is y turned by `angle`.
    ///
    /// Parameters
    /// ----------
    /// slope : float
    ///     Tangent of the angle between flank and contact plane.
    /// angle : float
    ///     Turn of the edge from y [rad].
    Wedge {
        /// Tangent of the angle between flank and contact plane.
        slope,
        /// Turn of the edge from y [rad].
        angle
    },
    (*, slope: "float", angle: "Angle" = 0.0)
);
elementary!(
    /// A round flat punch with a rounded edge.
    ///
    /// Parameters
    /// ----------
    /// radius : float
    ///     Radius of the flat [m].
    /// edge : float
    ///     Radius of the rounding beyond it [m].
    FlatPunch {
        /// Radius of the flat [m].
        radius,
        /// Radius of the rounding beyond it [m].
        edge
    },
    (*, radius: "Length", edge: "Length")
);
