import os
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Final, Literal, SupportsFloat, SupportsIndex, final

import numpy as np
import xarray as xr
from _typeshed import Incomplete, SupportsGetItem
from matplotlib.axes import Axes
from numpy import bool_, float64
from numpy.typing import ArrayLike, NDArray
from typing_extensions import Self

from pyfret._util.types import FrictionFunction, Variable
from pyfret.quantities import (
    Angle,
    BulkStress,
    ContactModulus,
    Force,
    Frequency,
    FrictionCoefficient,
    Length,
    LineForce,
    Modulus,
    Moment,
    NormalCompliance,
    PeakPressure,
    PointForce,
    Quantities,
    Quantity,
    Radius,
    ShearCompliance,
    Stiffness,
    Thickness,
    Time,
    YieldStress,
)
from pyfret.scene.maps import Form, Statistics
from pyfret.settings import Settings

CELLS_PER_FILM: Final[float]
"""
Cells in the thickness of a layer from which its own stress is known.
"""

DEPTH_ROUNDING: Final[float]
"""
Part of a worn depth that a jump which ends there may miss.
"""

LONGEST_LIFE: Final[float]
"""
Longest finite life [cycles]; a longer one is infinite.
"""

RATCHETS: Final[float]
"""
Net strain of a cycle over the strain that it adds up, from which a body ratchets.
"""

RIGID: Final[Elastic]
"""
A material that does not deform.
"""

SHAKEN: Final[float]
"""
Plastic work of a cycle over its friction work, or without friction over the plastic work of the
path, below which bodies have shaken down.
"""

STRAIN_AT_A_RIM: Final[str]
"""
Note on a largest plastic strain at a rim.
"""

TOO_FEW_INCREMENTS: Final[str]
"""
Why a cycle has no stiffness, and what to do.
"""

__version__: Final[str]

@final
class Assessment:
    """
    A criterion with its limit or its curve of lives.

    Parameters
    ----------
    criterion : Criterion
        Whose value is judged.
    limit : float, optional
        Limit for endless life, in the unit of the criterion.
    curve : five floats, optional
        Instead of it E [Pa], s_f' [Pa], b, e_f' and c of a strain-life curve.
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[Criterion], dict[str, Any]]: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        criterion: Criterion,
        *,
        limit: float | None = None,
        curve: Sequence[float] | None = None,
    ) -> Assessment: ...
    def __repr__(self, /) -> str: ...
    @property
    def criterion(self, /) -> Criterion:
        """The criterion whose value is judged."""
    @property
    def curve(self, /) -> list[float] | None:
        """E [Pa], s_f' [Pa], b, e_f' and c of the strain-life curve, or nothing with a limit."""
    def life(self, /, value: float) -> float:
        """Cycles to failure for values of the criterion."""
    @property
    def limit(self, /) -> float | None:
        """The limit, or nothing where the criterion gives lives."""
    def mean_stress_note(self, /, material: Material | None = None) -> str | None:
        """Note on a weight of the mean stress that is 0; None where mean stress counts."""
    def range_at(
        self,
        /,
        value: float,
        error: float,
        material: Material | None = None,
        *,
        scatter: float | None = None,
    ) -> tuple[tuple[float, float, float], tuple[float, float, float], float, list[str]]:
        """
        Return the margins of a value with its error (low, best, high), and their 10 to 90 % range.

        The range has the scatter of the material; `scatter` replaces its default. The other parts
        are the ratio of this scatter, and notes.
        """
    def safety_factor(self, /, value: float) -> float:
        """Factor by which the history may grow until the limit, for values of the criterion."""

@final
class Body:
    """
    An elastic half-space under its coatings and a gently curved surface.

    Parameters
    ----------
    substrate : Elastic, Material or str
        Material below the coatings.
    coatings : sequence of Coating
        Layers from the surface down: ``coatings[0]`` is the outermost (default: none).
    residual : float or array_like, optional
        Residual stress of the substrate [Pa], tension positive (default: none). A stress means s_xx
        = s_yy. A table has the rows ``[depth, s]`` or ``[depth, s_xx, s_yy]``, the depth [m] below
        the top of the layer. Linear between the depths, constant beyond them.
    shape : Flat, Sphere, Ellipsoid, Cylinder, ... or a sum of them
        Undeformed surface (default: flat).
    bulk_azimuth : float, optional
        Direction of its bulk stress, from x towards y [rad] (default: along the axis of a cylinder
        or roller, else along x; in line contacts along x).
    bulk_neutral_depth : float, optional
        Depth of the neutral plane of a bent body [m]: its bulk stress falls linearly from
        the surface to zero there (default: the same at all depths).
    hardness : float, Material or str, optional
        Largest pressure that the surface bears [Pa]: beyond it the surface is indented for
        good. Of a material of the table, or its name, 2.8 times its yield stress (default: none).
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        substrate: Elastic | Material | str,
        *,
        coatings: Coating | Sequence[Coating] = ...,
        residual: ArrayLike | None = None,
        shape: Flat
        | Sphere
        | Ellipsoid
        | Cylinder
        | CrownedRoller
        | Cone
        | Wedge
        | FlatPunch
        | Ring
        | Ridges
        | Waviness
        | Rough
        | SurfaceMap
        | Sum = ...,
        bulk_azimuth: Angle | None = None,
        bulk_neutral_depth: Length | None = None,
        hardness: YieldStress | Material | str | None = None,
    ) -> Body: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def _curvature(self, /) -> list[float]:
        """Second derivatives xx, xy, yy of the parabola of the surface [1/m]."""
    @property
    def bulk_azimuth(self, /) -> float | None:
        """Given direction of its bulk stress [rad]; None: along its axis, else x."""
    @property
    def bulk_neutral_depth(self, /) -> float | None:
        """Depth of the neutral plane of a bent body [m]; None: the same stress at all depths."""
    @property
    def coatings(self, /) -> list[Coating]:
        """Layers from the surface down."""
    @property
    def hardness(self, /) -> float | None:
        """Largest pressure that the surface bears [Pa]; None without a limit."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def residual(self, /) -> float | list[list[float]] | None:
        """Residual stress of the substrate [Pa], or its table; None where it has none."""
    @property
    def shape(
        self, /
    ) -> (
        Flat
        | Sphere
        | Ellipsoid
        | Cylinder
        | CrownedRoller
        | Cone
        | Wedge
        | FlatPunch
        | Ring
        | Ridges
        | Waviness
        | SurfaceMap
        | Rough
        | Sum
    ):
        """Undeformed surface."""
    @property
    def substrate(self, /) -> Elastic:
        """Material below the coatings."""
    @property
    def yields(self, /) -> bool:
        """Whether a layer of it may yield."""

@final
class Bond:
    """
    How a layer is bonded to what lies below it: springs that give way under the traction there.

    The upper side moves against the lower one by compliance times traction, in tension as in
    pressure.

    Parameters
    ----------
    normal, shear : float
        Approach per pressure and slip per shear traction [m/Pa], 0 (default) or more; a large shear
        compliance is a frictionless interface.

    Examples
    --------
    >>> glue = Elastic(E=3e9, nu=0.4)
    >>> Bond.of_layer(glue, thickness=0.0).normal
    0.0
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls, /, *, normal: NormalCompliance = 0.0, shear: ShearCompliance = 0.0
    ) -> Bond: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def normal(self, /) -> float:
        """Approach per pressure [m/Pa]."""
    @staticmethod
    def of_layer(material: Elastic, *, thickness: Thickness) -> Bond:
        """The bond that a thin layer of a material makes: h (1 - 2 nu)/(2 G (1 - nu)) and h/G."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def shear(self, /) -> float:
        """Slip per shear traction [m/Pa]."""

@final
class Branch:
    """
    One straight piece of a load history; most are made by the methods of :class:`LoadPath`.

    Parameters
    ----------
    W, M_x, M_y, T_x, T_y, M_z : float, optional
        Loads at its end [N, N m].
    delta_z, phi_x, phi_y, delta_x, delta_y, phi_z : float, optional
        Motions at its end [m, rad], in place of their loads. Without both the forces are 0 and
        the bodies do not rotate.
    sigma_B, sigma_B1, rolled : float
        Bulk stresses [Pa] and the way rolled [m] at its end (default 0).
    increments : int, optional
        Their number (default: chosen).
    spacing : Spacing
        How they are spaced (default uniform).
    t : float
        Path time at its end.
    path_error : float, optional
        Estimated error that the increments leave in the shear, as known before a run; the error of
        :meth:`Result.branches` contains what the run shows of it.
    """

    @property
    def M_x(self, /) -> float | None:
        """Tilting moment about x at its end [N m]; None where the tilt is given."""
    @property
    def M_y(self, /) -> float | None:
        """Tilting moment about y at its end [N m]; None where the tilt is given."""
    @property
    def M_z(self, /) -> float | None:
        """Torsional moment on body 2 at its end [N m]; None where the rotation is given."""
    @property
    def T_x(self, /) -> float | None:
        """Tangential force along x on body 2 at its end [N]; None where the shift is given."""
    @property
    def T_y(self, /) -> float | None:
        """Tangential force along y on body 2 at its end [N]; None where the shift is given."""
    @property
    def W(self, /) -> float | None:
        """Normal force at its end [N]; None where the approach is given."""
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        *,
        W: Force | None = None,
        M_x: Moment | None = None,
        M_y: Moment | None = None,
        T_x: Force | None = None,
        T_y: Force | None = None,
        M_z: Moment | None = None,
        delta_z: Length | None = None,
        phi_x: Angle | None = None,
        phi_y: Angle | None = None,
        delta_x: Length | None = None,
        delta_y: Length | None = None,
        phi_z: Angle | None = None,
        sigma_B: BulkStress = 0.0,
        sigma_B1: BulkStress = 0.0,
        rolled: Length = 0.0,
        increments: int | Literal["auto"] | None = None,
        spacing: Spacing | str = ...,
        t: Time,
        path_error: float | None = None,
    ) -> Branch: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def delta_x(self, /) -> float | None:
        """Shift along x at its end [m]; None where T_x is given."""
    @property
    def delta_y(self, /) -> float | None:
        """Shift along y at its end [m]; None where T_y is given."""
    @property
    def delta_z(self, /) -> float | None:
        """Approach at its end [m]; None where W is given."""
    @property
    def increments(self, /) -> int | None:
        """Number of increments; None: as many as the path tolerance asks for."""
    @property
    def path_error(self, /) -> float | None:
        """Estimated error that the increments leave in the shear, over the largest shear."""
    @property
    def phi_x(self, /) -> float | None:
        """Tilt about x at its end [rad]; None where M_x is given."""
    @property
    def phi_y(self, /) -> float | None:
        """Tilt about y at its end [rad]; None where M_y is given."""
    @property
    def phi_z(self, /) -> float | None:
        """Rotation about z at its end [rad]; None where M_z is given."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def rolled(self, /) -> float:
        """Way that the contact has rolled along x at its end [m]."""
    @property
    def sigma_B(self, /) -> float:
        """Bulk stress along x in body 2 at its end [Pa]."""
    @property
    def sigma_B1(self, /) -> float:
        """Bulk stress along x in body 1 at its end [Pa]."""
    @property
    def spacing(self, /) -> Spacing:
        """How the increments are spaced."""
    @property
    def t(self, /) -> float:
        """Path time at its end."""

@final
class CattaneoMindlin:
    """
    Partial slip of a sphere under constant normal force and a force T along x.

    C. Cattaneo (1938); R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; reversals after R. D. Mindlin
    and H. Deresiewicz, J. Appl. Mech. 20 (1953) 327. Exact for similar bodies of nu = 0. For other
    nu the slip is not quite along x, and the shift over the force is a good approximation. All
    forces obey abs(T) <= mu W.

    Parameters
    ----------
    hertz : Hertz
        The normal contact.
    bodies : tuple[Any, ...] of Elastic
        Materials of body 1 and body 2.
    mu : float
        Friction coefficient.
    """

    @property
    def G_star(self, /) -> float:
        """Tangential modulus [Pa], 1/G* = (2 - nu1)/G1 + (2 - nu2)/G2."""
    @property
    def T_limit(self, /) -> float:
        """Largest tangential force [N], mu W."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __new__(
        cls, /, hertz: Hertz, *, bodies: tuple[Elastic | Body, Elastic | Body], mu: float
    ) -> CattaneoMindlin: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def bodies(self, /) -> tuple[Elastic, Elastic]:
        """Materials of body 1 and body 2."""
    def energy_ratio(self, /, T_m: PointForce) -> float:
        """Loop energy over 4 T_m delta_x(T_m); 0.2 where partial slip ends."""
    @property
    def hertz(self, /) -> Hertz:
        """The normal contact."""
    def loop_energy(self, /, T_m: PointForce) -> float:
        """Energy dissipated in one closed loop between -`T_m` and `T_m` [J]."""
    @property
    def mu(self, /) -> float:
        """Friction coefficient."""
    def q_loading(self, /, r: ArrayLike, *, T: PointForce) -> NDArray[float64]:
        """Shear traction at distance `r` [m] in the first loading to `T` [N] [Pa]."""
    def q_reloading(self, /, r: ArrayLike, *, T: PointForce, T_m: PointForce) -> NDArray[float64]:
        """Shear traction at `T` on the way from -`T_m` back to `T_m` [N] [Pa]."""
    def q_unloading(self, /, r: ArrayLike, *, T: PointForce, T_m: PointForce) -> NDArray[float64]:
        """Shear traction at `T` on the way back from the first loading to `T_m` [N] [Pa]."""
    @property
    def shift_limit(self, /) -> float:
        """Shift at which gross sliding starts [m], 3 mu W / (16 a G*)."""
    def shift_loading(self, /, T: ArrayLike) -> NDArray[float64]:
        """Shift delta_x of the first loading to `T` [N] [m]."""
    def shift_reloading(self, /, T: ArrayLike, *, T_m: PointForce) -> NDArray[float64]:
        """Shift delta_x at `T` on the way from -`T_m` back to `T_m` [N] [m]."""
    def shift_unloading(self, /, T: ArrayLike, *, T_m: PointForce) -> NDArray[float64]:
        """Shift delta_x at `T` on the way back from `T_m` [N] [m]."""
    def stick_radius(self, /, T: PointForce) -> float:
        """Stick radius of the first loading to `T` [N], a (1 - T/(mu W))^(1/3) [m]."""
    def stick_radius_reversed(self, /, T: PointForce, *, T_m: PointForce) -> float:
        """
        Stick radius after the force changed from the reversal at `T_m` to `T` [N] [m].

        a [1 - abs(T_m - T)/(2 mu W)]^(1/3)
        """

@final
class CheckedStore:
    """A result store whose values are checked when they are read; use :func:`pyfret.open`."""

    def __new__(cls, /, store: str | PathLike[str]) -> CheckedStore:
        """Opens a store and checks its metadata."""
    def attributes(self, /) -> str:
        """Return the attributes of the group as JSON."""
    def check(self, /) -> None:
        """Fail if a file of the store is missing or is not as it was written."""
    def check_part(self, /, name: str, first: SupportsIndex, end: SupportsIndex) -> None:
        """Fail if a chunk with entries from `first` to before `end` is missing or damaged."""

@final
class CoatedIndentation:
    """Frictionless contact of a sphere with a body that has one coating."""

    @property
    def R(self, /) -> float:
        """Radius of the sphere [m]."""
    @property
    def W(self, /) -> float:
        """Normal force [N]."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def a(self, /) -> float:
        """Contact radius [m]."""
    @property
    def coating(self, /) -> Coating:
        """The coating."""
    @property
    def delta_z(self, /) -> float:
        """Approach [m]."""
    @property
    def indenter(self, /) -> Elastic:
        """Material of the sphere."""
    def p(self, /, r: ArrayLike) -> NDArray[float64]:
        """Pressure at distance `r` [m] from the middle [Pa]."""
    @property
    def substrate(self, /) -> Elastic:
        """Material below the coating."""

@final
class Coating:
    """
    A layer of constant thickness on what is below it.

    Parameters
    ----------
    material : Elastic, Material or str
        Material of the layer: also a row of the table, or its name, such as ``"TiN"``.
    thickness : float
        Thickness [m], positive.
    bond : Bond
        Bond to what is below it (default: perfect).
    residual : float or array_like, optional
        Residual stress of the layer [Pa], as :class:`Body` takes the stress of its substrate.
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        material: Elastic | Material | str,
        *,
        thickness: Thickness,
        bond: Bond = ...,
        residual: ArrayLike | None = None,
    ) -> Coating: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def bond(self, /) -> Bond:
        """Bond to what is below it."""
    @property
    def material(self, /) -> Elastic:
        """Material of the layer."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def residual(self, /) -> float | list[list[float]] | None:
        """Residual stress [Pa], or its table; None where it has none."""
    @property
    def thickness(self, /) -> float:
        """Thickness [m]."""

@final
class Cone:
    """
    A cone with its tip at the origin.

    Parameters
    ----------
    slope : float
        Tangent of the angle between flank and contact plane.
    """

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, *, slope: float) -> Cone: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def slope(self, /) -> float:
        """Tangent of the angle between flank and contact plane."""

@final
class ContactForCracks:
    """
    A contact in several of its states, prepared for cracks; use :meth:`pyfret.Result.crack`.

    Cracks at several places share the stress that the first one needs.
    """

    def __new__(
        cls,
        /,
        body: Body,
        states: States,
        *,
        residual: Sequence[ArrayLike] | None = None,
        body_number: int = 2,
    ) -> ContactForCracks: ...
    def growth(
        self,
        /,
        *,
        x: float,
        start: float,
        end: float,
        direction: str,
        tolerance: float,
        angle: Angle = 0.0,
        azimuth: Angle = 0.0,
        offset: float = 0.0,
        friction: float = 0.0,
    ) -> dict[str, Any]:
        """Return K of a crack that grows."""
    def intensity(
        self,
        /,
        *,
        x: float,
        lengths: Sequence[float],
        angle: Angle = 0.0,
        kink: tuple[float, float] | None = None,
        azimuth: Angle = 0.0,
        offset: float = 0.0,
        friction: float = 0.0,
        mouth_error: float | None = None,
    ) -> dict[str, NDArray[np.float64]]:
        """
        Return K of cracks.

        The mouth may be off by `mouth_error` [m]: the change of K by it is part of the error of K.
        """
    def widest_range(
        self,
        /,
        places: Sequence[tuple[float, float, float]],
        *,
        lengths: Sequence[float],
        angle: Angle = 0.0,
        friction: float = 0.0,
    ) -> int:
        """
        Return the number of the place with the largest range of K_I of straight cracks.

        Places are x, azimuth and offset of the plane.
        """

@final
class Conversion:
    """The paper's conversion, planned; see :func:`pyfret.kernels.convert`."""

    def __new__(cls, /, grid: Grid, *, enlargement: int = 8, aliases: int = 0) -> Conversion: ...
    def convert(self, /, frf: NDArray[np.complex128]) -> NDArray[np.float64]:
        """Influence coefficients from the response at the wave vectors, shape (n, 3, 3)."""
    def wave_vectors(self, /) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Wave numbers k_x, k_y [1/m] at which the response is needed, never both zero."""

@final
class CoupledIndentation:
    """Indentation with friction of dissimilar bodies, fully coupled, in numbers without load."""

    @property
    def W(self, /) -> float:
        """Normal force over 4 E* a^3 / (3 R)."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def beta(self, /) -> float:
        """Dundurs' parameter."""
    @property
    def delta_z(self, /) -> float:
        """Approach over a^2/R."""
    @property
    def mu(self, /) -> float:
        """Friction coefficient."""
    @property
    def p0(self, /) -> float:
        """Central pressure over 3 W / (2 pi a^2)."""
    @property
    def stick_ratio(self, /) -> float:
        """Stick radius over contact radius."""

@final
class Crack:
    """
    A crack from the surface of a half-plane: where stress is wanted, what it does at the tip.

    Plane strain; nothing here knows of contacts. K_I + i K_II = lim sqrt(2 pi r) (s_nn + i s_tn)
    ahead of the tip, t along the crack, n = +x for a crack along the depth.

    Parameters
    ----------
    x : float
        Place of the mouth [m].
    legs : list of (float, float)
        Length [m] and angle [rad] of each straight leg from the mouth on; angles are from the
        inward normal, positive towards +x.
    interfaces : list of float
        Depths at which the stress jumps or has a kink [m]. The points beside them are added to
        :attr:`points`, and the quadrature is split there.

    Examples
    --------
    >>> crack = Crack(legs=[(1e-4, 0.0)])
    >>> tension = np.zeros((1, len(crack.points), 6))
    >>> tension[..., 0] = 100e6
    >>> K = crack.intensity(tension).get("K_I").item(0)
    >>> round(K / (100e6 * np.sqrt(np.pi * 1e-4)), 4)
    1.1215
    """

    def __eq__(self, other: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __new__(
        cls,
        /,
        *,
        legs: Sequence[tuple[float, float]],
        x: float = 0.0,
        interfaces: Sequence[float] = ...,
    ) -> Crack: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    def grow(
        self,
        /,
        stress: Callable[[NDArray[np.float64]], ArrayLike],
        *,
        end: float,
        direction: Literal["tangential_stress", "opening_intensity"] = "tangential_stress",
        friction: float = 0.0,
        tolerance: float = 1e-2,
    ) -> dict[str, Any]:
        """
        Grow the crack in the direction of the largest range over a cycle of stress.

        Pieces are curved so that at the end of each the crack has no reason to turn. Their number
        doubles until the tip moves less than the tolerance.

        Parameters
        ----------
        stress : callable
            Takes points, x and depth [m], in an array of shape (points, 2). Gives the stress there
            of the body without the crack over the instants of the cycle [Pa], shape (time, points,
            6).
        end : float
            Length to grow to [m].
        direction : {"tangential_stress", "opening_intensity"}
            Largest range of the tangential stress ahead of the tip, or of K_I of a small kink.
        friction : float
            Coefficient of friction between faces in contact.
        tolerance : float
            Distance by which the last tip may be off over the length grown.

        Returns
        -------
        dict[str, Any]
            Of the tips on the way ``length``, ``x``, ``z`` [m] and ``angle`` [rad]. Over (time,
            tips) ``K_I``, ``K_II`` and their ``error`` [Pa m^0.5]. ``path_error`` is how far the
            last tip may be off [m]. ``end`` is the reason for the end. "reached": the crack has its
            length. "closed": nothing opens it. "surface": it came back to the surface. "kinks": its
            direction jumps.
        """
    def intensity(
        self, /, stress: ArrayLike, *, friction: float | None = None
    ) -> dict[str, NDArray[np.float64]]:
        """
        K over the instants of a history of stress at :attr:`points`.

        Parameters
        ----------
        stress : array of shape (time, points, 6)
            Stress of the body without the crack [Pa]: xx, yy, zz, xy, xz, yz, z the depth.
        friction : float, optional
            Coefficient of friction between faces in contact; by default faces may pass through
            each other, and K is linear in the stress.

        Returns
        -------
        dict[str, Any]
            ``K_I``, ``K_II`` and their ``error`` [Pa m^0.5], ``open``, the share of the crack that
            is open, each over time.
        """
    @property
    def interfaces(self, /) -> list[float]:
        """Depths at which the stress jumps [m]."""
    @property
    def legs(self, /) -> list[tuple[float, float]]:
        """Length [m] and angle [rad] of each leg."""
    @property
    def length(self, /) -> float:
        """Length along the crack [m]."""
    @property
    def points(self, /) -> NDArray[float64]:
        """Points at which the stress is wanted, tip to mouth: x and depth [m], (points, 2)."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def x(self, /) -> float:
        """Place of the mouth [m]."""

@final
class Criterion:
    """
    A criterion by its name, one of :data:`pyfret.fatigue.CRITERIA`, and its numbers by theirs.

    Examples
    --------
    >>> Criterion.findley(k=0.3) == Criterion("findley", k=0.3)
    True
    >>> Criterion.fatemi_socie(material="7075").name
    'fatemi_socie'
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[str], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, name: str, /, **numbers: float | Material | str) -> Criterion: ...
    def __repr__(self, /) -> str: ...
    @property
    def has_plane(self, /) -> bool:
        """Whether it has a critical plane."""
    @property
    def name(self, /) -> str:
        """Name of the criterion."""
    @property
    def numbers(self, /) -> dict[str, Any]:
        """Its numbers by their names."""
    @staticmethod
    def of(name: str, material: Material | str) -> Criterion:
        """
        The criterion of a name with the numbers of a material.

        Parameters
        ----------
        name : str
            One of :data:`pyfret.fatigue.CRITERIA`.
        material : Material or str
            The material, or its name in the table that comes with the package. A ValueError names a
            number that it lacks.

        Examples
        --------
        >>> Criterion.of("fatemi_socie", "7075") == Criterion.fatemi_socie(material="7075")
        True
        """
    @property
    def takes_strain(self, /) -> bool:
        """Whether it takes strains, and not the stress alone."""
    @property
    def unit(self, /) -> str:
        """Unit of its value: Pa, or 1 for strains."""
    @staticmethod
    def crossland(**numbers: float | Material | str) -> Criterion:
        """Give sqrt(J2,a) + alpha p_h,max [Pa].

        B. Crossland, Proc. Int. Conf. on Fatigue of Metals, IMechE, London (1956) 138-149.
        Its numbers: alpha. ``material``, a Material or its name, gives
        those that are left out.
        """
    @staticmethod
    def dang_van(**numbers: float | Material | str) -> Criterion:
        """Give the largest tau(t) + alpha p_h(t) of the mesoscopic shear [Pa].

        K. Dang Van, ASTM STP 1191 (1993) 120-130.
        Its numbers: alpha. ``material``, a Material or its name, gives
        those that are left out.
        """
    @staticmethod
    def findley(**numbers: float | Material | str) -> Criterion:
        """Give the largest tau_a + k s_n,max of all planes [Pa].

        W. N. Findley, J. Eng. Ind. 81 (1959) 301-305.
        Its numbers: k. ``material``, a Material or its name, gives
        those that are left out.
        """
    @staticmethod
    def matake(**numbers: float | Material | str) -> Criterion:
        """Give tau_a + k s_n,max on the plane of the largest tau_a [Pa].

        T. Matake, Bull. JSME 20 (1977) 257-263.
        Its numbers: k. ``material``, a Material or its name, gives
        those that are left out.
        """
    @staticmethod
    def mcdiarmid(**numbers: float | Material | str) -> Criterion:
        """Give tau_a + k s_n,max on the plane of the largest tau_a, k = t_D/(2 s_u) [Pa].

        D. L. McDiarmid, Fatigue Fract. Eng. Mater. Struct. 14 (1991) 429-453.
        Its numbers: k. ``material``, a Material or its name, gives
        those that are left out.
        """
    @staticmethod
    def smith_watson_topper(**numbers: float | Material | str) -> Criterion:
        """Give the largest s_n,max times half the range of the normal strain [Pa].

        K. N. Smith, P. Watson, T. H. Topper, J. Mater. 5 (1970) 767-778;
        D. F. Socie, J. Eng. Mater. Technol. 109 (1987) 293-298.
        Its numbers: E, nu. ``material``, a Material or its name, gives
        those that are left out.
        """
    @staticmethod
    def fatemi_socie(**numbers: float | Material | str) -> Criterion:
        """Give the largest gamma_a (1 + k s_n,max/s_y) of all planes.

        A. Fatemi, D. F. Socie, Fatigue Fract. Eng. Mater. Struct. 11 (1988) 149-165.
        Its numbers: E, nu, k, s_y. ``material``, a Material or its name, gives
        those that are left out.
        """
    @staticmethod
    def brown_miller(**numbers: float | Material | str) -> Criterion:
        """Give gamma_a + S times the range of the normal strain, where gamma_a is largest.

        F. A. Kandil, M. W. Brown, K. J. Miller, The Metals Society Book 280 (1982) 203-210.
        Its numbers: E, nu, S. ``material``, a Material or its name, gives
        those that are left out.
        """

@final
class CriterionBelow:
    """Values of a criterion on a section."""

    @property
    def assessments(self, /) -> list[Assessment | None]:
        """The assessment of every layer, None where it is not judged."""
    @property
    def depths(self, /) -> tuple[list[float], list[int]]:
        """Depths [m] and their layers."""
    def fields(self, /) -> dict[str, NDArray[np.float64]]:
        """Arrays over (depth, place), NaN where not judged."""
    @property
    def notes(self, /) -> list[str]:
        """Notes on the materials."""
    def worst(self, /, layer: int, material: Material | None = None) -> dict[str, Any] | None:
        """
        The worst point of a layer, None where it is not judged.

        `range` is the margin of the value with its error, `whole` the range of 10 to 90 % with the
        scatter of the material. `order` is the margin without its upper bound, by which layers are
        sorted. Criteria with a plane give its `normal` and its `inclination` to the line [degrees].
        """

@final
class CrownedRoller:
    """
    A cylinder with rounded ends; its axis is y turned by `angle`.

    Parameters
    ----------
    R : float
        Radius [m].
    length : float
        Length of the straight part [m], 0 for a crown all along.
    crown : float
        Radius along the axis beyond the straight part [m].
    angle : float
        Turn of the axis from y [rad].
    """

    @property
    def R(self, /) -> float:
        """Radius [m]."""
    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls, /, *, R: Radius, length: Length, crown: Length, angle: Angle = 0.0
    ) -> CrownedRoller: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def angle(self, /) -> float:
        """Turn of the axis from y [rad]."""
    @property
    def crown(self, /) -> float:
        """Radius along the axis beyond the straight part [m]."""
    @property
    def length(self, /) -> float:
        """Length of the straight part [m], 0 for a crown all along."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class CycleSection:
    """
    A section of a body below a contact over a cycle.

    `moments` is called with a list of numbers from 0 to `count` - 1, or with None for the moment
    before the cycle. It gives :class:`States` on the grid, or None. `yielding` is the plastic work
    of the cycle and the work beside which it is small [J]. `path_error` is the error of the shear
    by the increments, over the largest shear. `cache` shares the stress with other sections.
    """

    def __new__(
        cls,
        /,
        body: Body,
        grid: Grid,
        moments: Callable[[list[int] | None], States | None],
        count: int,
        *,
        x: float | None = None,
        y: float | None = None,
        azimuth: Angle | None = None,
        body_number: int = 2,
        residual: Sequence[ArrayLike] | None = None,
        yielding: tuple[float, float] | None = None,
        path_error: float | None = None,
        cache: StressCache | None = None,
    ) -> CycleSection: ...
    def by_criteria(
        self,
        /,
        z: Sequence[float],
        layer: Sequence[int],
        materials: Sequence[Material | None],
        criteria: Sequence[str],
        *,
        tolerance: float,
    ) -> list[CriterionBelow]:
        """Judge the section by criteria for the materials of the layers, all by the same stress."""
    def by_yield(
        self, /, z: Sequence[float], layer: Sequence[int], s_y: Sequence[float | None]
    ) -> YieldBelow:
        """Judge the section by yield stresses of the layers from the surface down [Pa]."""
    def mean(
        self,
        /,
        L: float,
        method: str,
        layer: int,
        materials: Sequence[Material | None],
        criterion: str,
        *,
        tolerance: float,
    ) -> dict[str, NDArray[np.float64]]:
        """Judge the mean over a critical distance L [m] in a layer: arrays over the places."""
    def note_on_cycle(self, /) -> str | None:
        """A note on a cycle that does not end as it began, if its start was kept."""

@final
class Cylinder:
    """
    A cylinder with sharp ends; its axis is y turned by `angle`.

    Parameters
    ----------
    R : float
        Radius [m]; negative for a hollow.
    length : float
        Length along the axis [m]; infinite for one that leaves the grid.
    angle : float
        Turn of the axis from y [rad].
    """

    @property
    def R(self, /) -> float:
        """Radius [m]; negative for a hollow."""
    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, R: Radius, *, length: Length = ..., angle: Angle = 0.0) -> Cylinder: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def angle(self, /) -> float:
        """Turn of the axis from y [rad]."""
    @property
    def length(self, /) -> float:
        """Length along the axis [m]; infinite for one that leaves the grid."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class EigenstrainOperator:
    """
    Stress and surface displacement that eigenstrains and tractions cause in a body.

    An eigenstrain e is a strain without stress: plastic strain, thermal strain, a misfit::

        sigma = C : (eps(u) - e),   div sigma = 0,   sigma_iz = -t_i at z = 0,   u -> 0 below

    with z into the body, tension positive, bonded layers, and t = q_x, q_y, p on the surface.
    Fields are trigonometric polynomials on the cells; in depth they are quadratic elements with two
    Gauss points each. There are no periodic images, and t . u[e] = sigma[t] : e to rounding.

    Parameters
    ----------
    body : Body
        Homogeneous or coated; its shape does not matter.
    grid : Grid
        Cells on which eigenstrain and tractions are given.
    depth : float
        Depth down to which the elements are of equal height [m]. Growing ones follow down to twice
        that depth, and through the coatings.
    height : float
        Height of an element [m]; a layer has two at least.

    Examples
    --------
    >>> from pyfret import Body, Elastic, Grid
    >>> from pyfret.kernels import EigenstrainOperator
    >>> steel = Body(Elastic(E=210e9, nu=0.3))
    >>> grid = Grid.centred(width=4e-4, n=16)
    >>> operator = EigenstrainOperator(steel, grid, depth=1e-4, height=2e-5)
    >>> stress, displacement = operator.apply(p=[[0.0] * 16] * 16)
    >>> stress.shape == (operator.z.size, 6, 16, 16), displacement.shape
    (True, (3, 16, 16))
    """

    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __new__(
        cls, /, body: Body, grid: Grid, *, depth: Length, height: float
    ) -> EigenstrainOperator: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    def apply(
        self,
        /,
        eigenstrain: ArrayLike | None = None,
        *,
        p: ArrayLike | None = None,
        q_x: ArrayLike | None = None,
        q_y: ArrayLike | None = None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """
        Stress on the planes [Pa] and displacement of the surface [m].

        Parameters
        ----------
        eigenstrain : array of shape (planes, 6, nx, ny), optional
            xx, yy, zz, xy, xz, yz on each plane, tensor components (default: none).
        p, q_x, q_y : array of shape (nx, ny), optional
            Tractions on the body [Pa] (default: none).

        Returns
        -------
        stress : array of shape (planes, 6, nx, ny)
            [Pa]
        displacement : array of shape (3, nx, ny)
            u_x, u_y, u_z, with z into the body [m]. In plane strain displacements by
            tractions are relative to a point far away.
        """
    @property
    def body(self, /) -> Body:
        """The body."""
    @property
    def depth(self, /) -> float:
        """Depth down to which the elements are of equal height [m]."""
    @property
    def grid(self, /) -> Grid:
        """Its cells."""
    @property
    def height(self, /) -> float:
        """Height of an element [m]."""
    @property
    def layer(self, /) -> Incomplete:
        """Layer of each plane, from the surface down."""
    @property
    def weights(self, /) -> Incomplete:
        """Height that each plane stands for [m]: an integral over depth is the sum with these."""
    @property
    def z(self, /) -> Incomplete:
        """Depth of each plane of Gauss points [m]."""

@final
class Eigenstress:
    """Plastic strain, and the residual stress that it leaves."""

    def plastic_strain(
        self, /, x: Sequence[float], y: Sequence[float], z: Sequence[float], layer: Sequence[int]
    ) -> NDArray[np.float64]:
        """
        Plastic strain at points x, y, z [m] in their layers, of shape (points, 6).

        Components are xx, yy, zz, xy, xz, yz.
        """

@final
class Elastic:
    """
    A homogeneous isotropic elastic material.

    Parameters
    ----------
    E : float
        Young's modulus [Pa], positive; infinite, with nu = 0, for :data:`RIGID`.
    nu : float
        Poisson's ratio, -1 < nu <= 0.5.
    plastic : Plastic, optional
        How it yields (default: it stays elastic).

    Examples
    --------
    >>> steel = Elastic(E=210e9, nu=0.3)
    >>> round(steel.G / 1e9, 2)
    80.77
    """

    @property
    def E(self, /) -> float:
        """Young's modulus [Pa]; infinite for :data:`RIGID`."""
    @property
    def G(self, /) -> float:
        """Shear modulus E / (2 (1 + nu)) [Pa]."""
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, *, E: Modulus, nu: float, plastic: Plastic | None = None) -> Elastic: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def nu(self, /) -> float:
        """Poisson's ratio."""
    @property
    def plastic(self, /) -> Plastic | None:
        """How it yields; None where it stays elastic."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class Ellipsoid:
    """
    Two principal radii, each a parabola as in Hertz's theory.

    Parameters
    ----------
    R_x : float
        Principal radius in the direction `angle` [m]; negative for a hollow.
    R_y : float
        Principal radius across it [m].
    angle : float
        Direction of the first one, from x towards y [rad].
    """

    @property
    def R_x(self, /) -> float:
        """Principal radius in the direction `angle` [m]; negative for a hollow."""
    @property
    def R_y(self, /) -> float:
        """Principal radius across it [m]."""
    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, *, R_x: Radius, R_y: Radius, angle: Angle = 0.0) -> Ellipsoid: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def angle(self, /) -> float:
        """Direction of the first one, from x towards y [rad]."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class Envelope:
    """Extremes of stress below a line; use :func:`pyfret.subsurface.envelope`."""

    def __new__(
        cls,
        /,
        body: Body,
        grid: Grid,
        path: LoadPath,
        z: Sequence[float],
        layer: Sequence[int],
        *,
        of: Sequence[str],
        x: float | None = None,
        y: float | None = None,
        azimuth: Angle | None = None,
        body_number: int = 2,
        residual: Sequence[ArrayLike] | None = None,
    ) -> Envelope: ...
    @property
    def cycles(self, /) -> list[tuple[int, int]]:
        """First and last branch of every cycle."""
    def finish(self, /) -> dict[str, dict[str, NDArray[np.float64]]]:
        """Give the extremes of every measure."""
    def push(
        self,
        /,
        increment: int,
        branch: int,
        *,
        p: ArrayLike,
        q_x: ArrayLike,
        q_y: ArrayLike,
        stick: NDArray[bool_],
        sigma_B: BulkStress = 0.0,
        eigenstress: Eigenstress | None = None,
    ) -> None:
        """Take an increment: tractions [Pa], cells that stick, bulk stress of the body [Pa]."""

@final
class Flat:
    """The contact plane itself."""

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /) -> Flat: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class FlatPunch:
    """
    A round flat punch with a rounded edge.

    Parameters
    ----------
    radius : float
        Radius of the flat [m].
    edge : float
        Radius of the rounding beyond it [m].
    """

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, *, radius: Length, edge: Length) -> FlatPunch: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def edge(self, /) -> float:
        """Radius of the rounding beyond it [m]."""
    @property
    def radius(self, /) -> float:
        """Radius of the flat [m]."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class Friction:
    """
    Coulomb's law with a coefficient that depends on direction, place and history.

    The coefficient of an increment follows from the history at its end, extrapolated from the last
    increment.

    Parameters
    ----------
    mu : float
        Coefficient, >= 0; ``float("inf")`` for a contact that never slips.
    mu_y : float, optional
        Coefficient along y, mu being that along x: the bound is an ellipse.
    kinetic : float, optional
        Coefficient, along x, of cells that slipped in the increment before.
    map : SurfaceMap, optional
        Factor of the coefficient over the surface.
    history : (History, list of pairs), optional
        Factor of the coefficient, linear between the pairs (history, factor).
    layers : sequence of float, optional
        Coefficient of each layer that wear exposes, in place of `mu`: the coatings of the coated
        body from the outermost on, then its substrate. Before wear the first one holds.
    starved : float, optional
        Coefficient where no oxygen arrives; see :class:`pyfret.wear.Air`. The aerated share s of a
        cell gives starved + (mu - starved) s.
    bed : (float, float), optional
        Coefficient mu_bed of a thick bed of debris, and the thickness h_ref [m] of the bed; see
        :class:`pyfret.wear.DebrisBed`. The bed h gives mu_bed + (mu - mu_bed) exp(-h/h_ref).
    law : callable, optional
        A function of five arrays with a number for each cell. These are places `x`, `y` [m],
        pressure `p` [Pa], length of the way slipped `slip` [m] and energy per area `dissipated`
        [J/m^2]. It gives the coefficient along x of each cell, finite and >= 0, as an array of the
        same shape or one number. `mu` is about the size of it: the measure of tolerances, and the
        coefficient of cells without pressure so far. An increment is solved again until the
        coefficient follows from pressure and history at its end. What the function raises is raised
        as it is. It also gets arrays of `worn1`, `worn2` (worn depths [m]), `layer1`, `layer2` (the
        exposed layer, from 0), `bed` (debris per area [m]) and `aerated` (share with oxygen) that
        its signature names. No other law beside it; over cycles of wear slip and
        energy are sums over all cycles so far. A store keeps that there is a law, not which:
        ``pyfret.resume(store, friction_law=...)``.
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        mu: float | None = None,
        *,
        mu_y: float | None = None,
        kinetic: float | None = None,
        map: SurfaceMap | None = None,
        history: tuple[History, Sequence[tuple[float, float]]] | None = None,
        layers: Sequence[float] | None = None,
        starved: float | None = None,
        bed: tuple[float, float] | None = None,
        law: FrictionFunction | Literal["own"] | None = None,
    ) -> Friction: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def bed(self, /) -> tuple[float, float] | None:
        """Coefficient of a thick bed of debris, and the thickness of the bed [m]."""
    @property
    def history(self, /) -> tuple[History, list[tuple[float, float]]] | None:
        """Factor as a function of the history."""
    @property
    def is_constant(self, /) -> bool:
        """Whether it is the same everywhere and at all times, if not in all directions."""
    @property
    def kinetic(self, /) -> float | None:
        """Coefficient of cells that slipped in the increment before."""
    @property
    def law(self, /) -> Any | None:
        """The function that gives the coefficient; ``"own"`` if only that there is one is known."""
    @property
    def layers(self, /) -> list[float] | None:
        """Coefficient of each layer that wear exposes."""
    @property
    def map(self, /) -> SurfaceMap | None:
        """Factor over the surface."""
    @property
    def mu(self, /) -> float:
        """Coefficient."""
    @property
    def mu_y(self, /) -> float | None:
        """Coefficient along y, if it is another."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def starved(self, /) -> float | None:
        """Coefficient where no oxygen arrives."""
    def words(self, /) -> list[tuple[str, float | None]]:
        """The law in words: names with their values, and facts without a value."""

@final
class Grid:
    """
    Rectangular cells around the initial point of contact; tractions are constant on each.

    Arrays over the grid have the shape (nx, ny), x first.

    Parameters
    ----------
    nx, ny : int
        Number of cells along x and along y.
    dx, dy : float
        Cell length along x and along y [m].
    plane_strain : bool
        Whether the cells are without end along y (default False): `ny` is 1 and `dy` the width that
        forces are those on.
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls, /, *, nx: int, ny: int, dx: Length, dy: Length, plane_strain: bool = False
    ) -> Grid: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def cell_area(self, /) -> float:
        """Area of a cell [m^2]."""
    @staticmethod
    def centred(*, width: Quantity | tuple[Quantity, Quantity], n: int | tuple[int, int]) -> Grid:
        """Place `n` by `n` cells on a square of side `width` [m]; a rectangle by pairs (x, y)."""
    @property
    def dx(self, /) -> float:
        """Cell length along x [m]."""
    @property
    def dy(self, /) -> float:
        """Cell length along y [m]."""
    @staticmethod
    def from_spacing(
        n: int | tuple[int, int], spacing: Quantity | tuple[Quantity, Quantity]
    ) -> Grid:
        """`n` = (nx, ny) cells of size `spacing` = (dx, dy) [m]."""
    @property
    def nx(self, /) -> int:
        """Number of cells along x."""
    @property
    def ny(self, /) -> int:
        """Number of cells along y."""
    @property
    def plane_strain(self, /) -> bool:
        """Whether the cells are without end along y."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @staticmethod
    def strip(*, extent: Length, n: int, width: Length = 1.0) -> Grid:
        """
        Plane strain: `n` cells over the length `extent` [m] along x, without end along y.

        Forces, moments and energies are those on the width `width` [m]; displacements are
        relative to the points at the distance `extent` from a load.
        """
    def unit_of(self, /, unit: str) -> str:
        """
        Unit of a number of a run on this grid, by its unit in three dimensions.

        On a strip one metre wide forces are in N/m, energies in J/m, areas in m^2/m.
        """
    @property
    def x(self, /) -> NDArray[float64]:
        """Centres of the cells along x [m], shape (nx,)."""
    @property
    def y(self, /) -> NDArray[float64]:
        """Centres of the cells along y [m], shape (ny,)."""
    @staticmethod
    def for_contact(
        body1: Body,
        body2: Body,
        path: LoadPath,
        *,
        error: float = 0.005,
        room: float = 1.2,
        start: Length | None = None,
        plane_strain: bool = False,
        wear: Mapping[str, Any] | None = None,
        mu: FrictionCoefficient | Friction | None = None,
        of: Literal["p", "p_max", "s_xx", "loop"] = "p",
        n: int | None = None,
    ) -> Grid:
        """Choose a grid for the contact that comes out of two bodies and a load path.

        The contact under the largest normal load of the path is solved without friction and
        roughness on 32 cells a side. The grid is `room` times as long, on rough surfaces 15 %
        longer. It has as many cells as a smooth contact takes for `error`. The cells are square;
        along a contact that would take more than 4096 of them they are oblong, 128 at least. It
        has eight cells in the shortest wave of a rough, wavy or measured surface. On measured
        surfaces, on waves and where a body has edges, the number of cells is doubled. The last
        changes of area and
        largest pressure foretell the next ones: the doubling ends where these are below
        `error`.

        Parameters
        ----------
        body1, body2 : Body
            The upper and the lower body.
        path : LoadPath
            The loads.
        error : float
            Error that is wanted of the number that `of` names. Of the pressure it is the root mean
            square over the error of the pressure; radius and approach have a tenth of it.
        room : float
            Side of the grid over the length of the contact: 1.2 (default), 2 or more where wear or
            rolling makes the contact longer.
        start : float, optional
            Side to begin with [m] (default: from the Hertz contact, else a millimetre).
        plane_strain : bool
            Whether it is a line contact: a strip one metre wide.
        wear : dict, optional
            What wears, as keywords of :func:`pyfret.wear.solve`: cycles and laws at least. The
            run is done on few cells, and the grid holds the scar at its end, strokes included.
            `error` then belongs to the contact at the end, and the first contact has eight cells
            in its radius.
        mu : float or Friction, optional
            Coefficient of friction, which decides where wear slips: to be given with `wear`, and
            with ``of="s_xx"`` or ``of="loop"``.
        of : "p", "p_max", "s_xx" or "loop"
            What `error` is of. ``"p"``: the pressure as a field. The others are solved on grids
            of twice as many cells each until they agree to `error`. ``"p_max"``: the largest
            pressure and the area. ``"s_xx"``: the largest tension along x in the lower body at
            the end of the path. ``"loop"``: the dissipated energy and the ranges of forces and
            shifts.
        n : int, optional
            Cells along the shorter side, in place of those that `error` takes; they are square.

        Raises
        ------
        ValueError
            Nothing is pressed together, no size was found that fits, as of two flats, or `wear`,
            ``"s_xx"`` or ``"loop"`` comes without `mu`.

        Warns
        -----
        SceneWarning
            The numbers still change by more than `error` on 512 x 512 cells, or an outermost
            coating is thinner than a cell.

        Examples
        --------
        >>> steel = Elastic(E=210e9, nu=0.3)  # doctest: +SKIP
        >>> ball, flat = Body(steel, shape=Sphere(R=5e-3)), Body(steel)  # doctest: +SKIP
        >>> path = LoadPath.start().normal(10.0).cycles(1, T_x=1.0)  # doctest: +SKIP
        >>> grid = Grid.for_contact(ball, flat, path)  # doctest: +SKIP
        >>> law = Archard(k=1e-15)  # doctest: +SKIP
        >>> wear = {"cycles": 1e5, "body2": law}  # doctest: +SKIP
        >>> worn = Grid.for_contact(ball, flat, path, wear=wear, mu=0.3)  # doctest: +SKIP
        """

@final
class Hertz:
    """
    Frictionless contact of two paraboloids of revolution.

    K. L. Johnson, Contact Mechanics (1985), eq. (4.22)-(4.24). :func:`hertz` makes it.

    Parameters
    ----------
    W : float
        Normal force [N].
    E_star : float
        Contact modulus [Pa].
    a : float
        Contact radius [m].
    p0 : float
        Peak pressure [Pa].
    delta_z : float
        Approach [m].
    """

    @property
    def E_star(self, /) -> float:
        """Contact modulus [Pa], 1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2."""
    @property
    def W(self, /) -> float:
        """Normal force [N]."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __new__(
        cls,
        /,
        *,
        W: PointForce,
        E_star: ContactModulus,
        a: Length,
        p0: PeakPressure,
        delta_z: Length,
    ) -> Hertz: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def a(self, /) -> float:
        """Contact radius [m], a^3 = 3 W R / (4 E*)."""
    @property
    def delta_z(self, /) -> float:
        """Approach [m], a^2 / R."""
    def p(self, /, r: ArrayLike) -> NDArray[float64]:
        """Pressure at distance `r` [m] from the middle [Pa], p0 sqrt(1 - r^2/a^2)."""
    @property
    def p0(self, /) -> float:
        """Peak pressure [Pa], 3 W / (2 pi a^2)."""
    @property
    def p_H(self, /) -> float:
        """Peak pressure [Pa], by the name that it has in results."""

@final
class HertzEllipse:
    """Elliptical Hertz contact, K. L. Johnson, Contact Mechanics (1985), sec. 4.2."""

    @property
    def E_star(self, /) -> float:
        """Contact modulus [Pa]."""
    @property
    def R_x(self, /) -> float:
        """Relative principal radius along x [m]."""
    @property
    def R_y(self, /) -> float:
        """Relative principal radius along y [m]."""
    @property
    def W(self, /) -> float:
        """Normal force [N]."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def a_x(self, /) -> float:
        """Semi-axis of the contact along x [m]."""
    @property
    def a_y(self, /) -> float:
        """Semi-axis of the contact along y [m]."""
    @property
    def delta_z(self, /) -> float:
        """Approach [m]."""
    @property
    def p0(self, /) -> float:
        """Peak pressure [Pa], 3 W / (2 pi a_x a_y)."""
    @property
    def p_H(self, /) -> float:
        """Peak pressure [Pa], by the name that it has in results."""

@final
class HertzStress:
    """
    A half-space under sqrt(1 - r^2/a^2) of unit peak on r < a: Hamilton's stresses.

    Parameters
    ----------
    a : float
        Radius of the loaded circle [m].
    nu : float
        Poisson's ratio.
    """

    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __new__(cls, /, *, a: Length, nu: float) -> HertzStress: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def a(self, /) -> float:
        """Radius of the loaded circle [m]."""
    @property
    def nu(self, /) -> float:
        """Poisson's ratio."""
    def pressure(self, /, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> list[NDArray[np.float64]]:
        """
        Stress s_xx, s_yy, s_zz, s_xy, s_xz, s_yz at (`x`, `y`, `z`) [m] under a pressure.

        Numbers, or arrays that are put together as numpy does.
        """
    def shear(self, /, x: ArrayLike, y: ArrayLike, z: ArrayLike) -> list[NDArray[np.float64]]:
        """Stress under a shear traction that acts on the body along +x."""

@final
class History:
    """
    History of a cell.

    ``INCREMENT``: increments done, the same for all cells. ``SLIP``: length of the way that the
    cell has slipped [m]. ``DISSIPATED``: energy dissipated per area [J/m^2]. ``CYCLES``: cycles of
    wear done; a path that is run through once has done none. Over jumps of wear each is summed over
    all cycles so far.
    """

    CYCLES: Final[History]
    DISSIPATED: Final[History]
    INCREMENT: Final[History]
    SLIP: Final[History]
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __int__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...

@final
class LineContact:
    """Cylinders in plane strain: Hertz, Cattaneo, Carter, McEwen; from `line_contact`."""

    @property
    def E_star(self, /) -> float:
        """Contact modulus [Pa]."""
    @property
    def R(self, /) -> float:
        """Relative radius [m]."""
    @property
    def W(self, /) -> float:
        """Normal force per length [N/m]."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def a(self, /) -> float:
        """Half-width [m], a^2 = 4 W R/(pi E*)."""
    @property
    def bodies(self, /) -> tuple[Elastic, Elastic]:
        """Materials of body 1 and body 2."""
    def p(self, /, x: ArrayLike) -> NDArray[float64]:
        """Pressure at `x` [m] [Pa]."""
    @property
    def p0(self, /) -> float:
        """Peak pressure [Pa]."""
    @property
    def p_H(self, /) -> float:
        """Peak pressure [Pa], by the name that it has in results."""
    def q(
        self, /, x: ArrayLike, *, T: LineForce, mu: float, middle: Length = 0.0
    ) -> NDArray[float64]:
        """
        Shear at `x` [m] under `T` [N/m] with the stick zone around `middle` [m] [Pa].

        Cattaneo's with the middle at 0, Carter's with it at a - c towards the leading edge.
        """
    def stick_half_width(self, /, *, T: LineForce, mu: float) -> float:
        """Half-width of the stick zone under `T` [N/m] [m]."""
    def stick_middle(self, /, *, eps_x: float, mu: float) -> float:
        """
        Middle of the stick zone [m] under the bulk strain `eps_x` of body 2.

        The strain is brought up together with T > 0.
        """
    def stress(
        self, /, x: ArrayLike, z: ArrayLike, *, T: LineForce, mu: float, middle: Length = 0.0
    ) -> list[NDArray[np.float64]]:
        """
        Stress s_xx, s_zz, s_xz at (`x`, `z`) [m] in partial slip [Pa]; arrays are put together.

        The shear is :meth:`q`, with the stick zone around `middle`. A bulk stress adds to s_xx.
        """

@final
class LoadPath:
    """
    The load history, from two bodies just touching.

    Built by chaining; every call gives a new path with more branches.

    Parameters
    ----------
    branches : list of Branch
        Its branches, where they are at hand.

    Examples
    --------
    >>> path = LoadPath.start().normal(1e3, increments=100)
    >>> path.tangential([270.0, -270.0, 270.0], increments=500)
    LoadPath(4 branches, 600 increments)
    """

    @property
    def M_z(self, /) -> NDArray[float64]:
        """Torsional moment at the end of every increment [N m]."""
    @property
    def T_x(self, /) -> NDArray[float64]:
        """Tangential force along x at the end of every increment [N]."""
    @property
    def T_y(self, /) -> NDArray[float64]:
        """Tangential force along y at the end of every increment [N]."""
    @property
    def W(self, /) -> NDArray[float64]:
        """Normal force at the end of every increment [N]; NaN where the solution gives it."""
    def __bool__(self, /) -> bool: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __len__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        branches: Sequence[Branch] = ...,
        *,
        rig_stiffness: Stiffness | None = None,
        period: float | None = None,
    ) -> LoadPath: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    def _repr_html_(self, /) -> Any: ...
    @property
    def branches(self, /) -> list[Branch]:
        """The branches in their order."""
    def cycles(
        self,
        /,
        n: int,
        *,
        T_x: Force | None = None,
        T_y: Force | None = None,
        M_z: Moment | None = None,
        delta_x: Length | None = None,
        delta_y: Length | None = None,
        phi_z: Angle | None = None,
        increments: int | Literal["auto"] = ...,
    ) -> LoadPath:
        """
        Go through `n` cycles of one load or motion about zero.

        The path goes to the amplitude, then `n` times to its opposite and back; what is not named
        stays as it was.

        Parameters
        ----------
        n : int
            Number of cycles.
        T_x, T_y : float, optional
            Amplitude of a tangential force [N].
        M_z : float, optional
            Amplitude of the torsional moment [N m].
        delta_x, delta_y : float, optional
            Amplitude of a shift [m].
        phi_z : float, optional
            Amplitude of the rotation [rad].
        increments : int or "auto"
            Number of increments of all branches together, shared out in proportion to the change
            (default: as many as the path tolerance of the settings asks for).

        Examples
        --------
        >>> LoadPath.start().normal(10.0).cycles(2, delta_x=2e-6)
        LoadPath(6 branches, increments to be chosen)
        """
    def displace(
        self,
        /,
        *,
        delta_z: Quantities | None = None,
        delta_x: Quantities | None = None,
        delta_y: Quantities | None = None,
        phi_x: Quantities | None = None,
        phi_y: Quantities | None = None,
        phi_z: Quantities | None = None,
        increments: int | Literal["auto"] = ...,
        spacing: Spacing | str = ...,
        t: Time | None = None,
    ) -> LoadPath:
        """
        Go to the given rigid motions of body 1 on a straight line, or visit several in turn.

        A motion that is named is given from here on, and its load follows from the solution. What
        is not named stays as it was; without a word, rotations are given as zero.

        Parameters
        ----------
        delta_z, delta_x, delta_y : float or sequence of float, optional
            Approach and shifts [m]. One of all the motions may be a sequence: its values are
            visited in turn. The increments are then shared out in proportion to the change, as in
            `tangential`.
        phi_x, phi_y, phi_z : float or sequence of float, optional
            Tilts and rotation about z [rad].
        increments : int or "auto"
            Number of increments (default: as many as the path tolerance of the settings asks for).
        spacing : Spacing
            How they are spaced (default: equal increments).
        t : float, optional
            Path time at the end (default: one unit later); not with a sequence.

        Examples
        --------
        >>> pressed = LoadPath.start().normal(10.0)
        >>> pressed.displace(delta_x=[2e-6, -2e-6, 2e-6])
        LoadPath(4 branches, increments to be chosen)
        """
    def ellipse(
        self, /, *, T_x: Force, T_y: Force, turns: int = 1, increments: int | Literal["auto"] = ...
    ) -> LoadPath:
        """
        Turn the tangential force around an ellipse of semi-axes `T_x`, `T_y` [N].

        Its middle is where the path stands. It goes to (T_x, 0) in `increments` and takes as many
        for each turn towards (0, T_y), each a branch by itself. With "auto" a turn has 64 branches,
        and as many increments as the path tolerance of the settings asks for.
        """
    def force(
        self,
        /,
        *,
        W: Force | None = None,
        T_x: Force | None = None,
        T_y: Force | None = None,
        M_x: Moment | None = None,
        M_y: Moment | None = None,
        M_z: Moment | None = None,
        sigma_B: BulkStress | None = None,
        sigma_B1: BulkStress | None = None,
        rolled: Length | None = None,
        increments: int | Literal["auto"] = ...,
        spacing: Spacing | str = ...,
        t: Time | None = None,
    ) -> LoadPath:
        """
        Go to the given loads on a straight line; what is not named stays as it was.

        A load that is named is given from here on, and the motion that goes with it is free.

        Parameters
        ----------
        W, T_x, T_y : float, optional
            Normal force and tangential forces on body 2 [N].
        M_x, M_y, M_z : float, optional
            Tilting moments and torsional moment on body 2 [N m].
        sigma_B : float, optional
            Bulk stress along x in body 2, tension positive: a fatigue load [Pa].
        sigma_B1 : float, optional
            The same in body 1.
        rolled : float, optional
            Way that the contact has rolled along x over both bodies [m], whole cells per increment.
        increments : int or "auto"
            Number of increments (default: as many as the path tolerance of the settings asks for).
        spacing : Spacing
            How they are spaced (default: equal increments of force).
        t : float, optional
            Path time at the end (default: one unit later).
        """
    @staticmethod
    def from_csv(
        path: str | PathLike[str],
        *,
        increments: PerRange | int | Literal["auto"] = ...,
        drive: str | Sequence[str] = ...,
    ) -> LoadPath:
        """
        Read a measured history: a table of text whose titles name the columns of `waypoints`.

        Semicolons, tabs, commas or blanks part its numbers, with decimal points or commas. Units
        stand in the titles, ``T_x [kN]``, or in a row between titles and numbers.

        Parameters
        ----------
        path : path
            The file.
        increments : int, PerRange or "auto"
            Increments per branch, as in `waypoints` (default: 1, since a recording is dense).
        drive : str or list of str, optional
            The one that drives, where the file has both a load and its motion, as every measured
            loop has. The other is left out.

        Raises
        ------
        StoreError
            If the file cannot be read. The message has the line, the column and the argument to
            give.
        """
    def from_function(
        self,
        /,
        function: Callable[[float], Mapping[str, float]],
        *,
        period: float,
        periods: int = 2,
        points: int = 64,
        increments: PerRange | int | Literal["auto"] = ...,
    ) -> LoadPath:
        """
        Follow a periodic function of path time, straight between `points` points of a period.

        Parameters
        ----------
        function : callable
            Takes the time from 0 to `period`, and gives the loads or motions by name, as
            ``lambda t: {"T_x": 100.0 * np.sin(t), "sigma_B": 2e8 * np.cos(t)}``.
        period : float
            Its period. A function that does not return to its start is refused.
        periods : int
            How many are followed (default: 2, the second of which repeats itself).
        points : int
            Points of a period (default: 64). The turning points of every load are added.
        increments : int, PerRange or "auto"
            Increments from point to point, as in `waypoints`.

        Examples
        --------
        >>> path = LoadPath.start().normal(10.0)
        >>> path.from_function(lambda t: {"T_x": abs(t - 0.5)}, period=1.0)
        LoadPath(130 branches, increments to be chosen)
        """
    def hold(self, /, *, increments: int = 1) -> LoadPath:
        """
        Stay at the loads and motions reached for some increments, one unit of path time.

        What friction makes of the history of a cell goes on meanwhile.
        """
    def no_cycle(self, /) -> str:
        """Why the path has no closed cycle, in words."""
    def normal(self, /, W: Quantities, *, increments: int | Literal["auto"] = ...) -> LoadPath:
        """
        Go to the normal force `W` [N], the tangential forces kept, in one unit of path time.

        Of several forces each is a branch of its own, with as many increments.
        """
    @property
    def period(self, /) -> float | None:
        """Path time of a cycle; None: cycles are found where the loads return."""
    def radial(self, /, W: Quantities, *, increments: int | Literal["auto"] = ...) -> LoadPath:
        """Visit the normal forces `W` [N] in turn, as `tangential` does: fretting mode II."""
    def repeats(self, /, *, period: float | None) -> LoadPath:
        """
        Return the path with a given period of its cycles, in path time.

        Without it cycles are found where the loads return exactly. With it they are counted back
        from the end of the path. Their ends may differ by 2 % of the largest load, the noise of a
        measured history. None takes the period out.
        """
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    def rig(self, /, stiffness: Stiffness | None) -> LoadPath:
        """
        Return the path through a rig of a stiffness K [N/m], a spring along x.

        The spring is in series with the contact. ``delta_x`` is the shift of its far end, given or
        read. The contact's own shift is ``delta_x - T_x/K``. None takes the spring out. A text may
        have its unit, ``"20 N/um"``.
        """
    @property
    def rig_stiffness(self, /) -> float | None:
        """Stiffness of the rig along x [N/m]; None: the bodies themselves are moved."""
    @property
    def rolled(self, /) -> NDArray[float64]:
        """Way rolled at the end of every increment [m]."""
    @property
    def sigma_B(self, /) -> NDArray[float64]:
        """Bulk stress of body 2 at the end of every increment [Pa]."""
    @property
    def sigma_B1(self, /) -> NDArray[float64]:
        """Bulk stress of body 1 at the end of every increment [Pa]."""
    def sine(
        self,
        /,
        periods: int,
        *,
        W: Force | None = None,
        T_x: Force | None = None,
        T_y: Force | None = None,
        M_z: Moment | None = None,
        delta_x: Length | None = None,
        delta_y: Length | None = None,
        phi_z: Angle | None = None,
        sigma_B: BulkStress | None = None,
        sigma_B1: BulkStress | None = None,
        phase: float | dict[str, float] = ...,
        points: int = 16,
        increments: PerRange | int | Literal["auto"] = ...,
    ) -> LoadPath:
        """
        Swing as a sine about where the path stands.

        It goes straight between `points` points of a period, `periods` times. Several loads swing
        together, each with its phase. The first period begins where the path stands, so that the
        second one is the cycle that repeats itself.

        Parameters
        ----------
        periods : int
            Number of periods.
        W, T_x, T_y : float, optional
            Amplitudes of forces [N].
        M_z : float, optional
            Amplitude of the torsional moment [N m].
        delta_x, delta_y : float, optional
            Amplitudes of shifts [m].
        phi_z : float, optional
            Amplitude of the rotation [rad].
        sigma_B, sigma_B1 : float, optional
            Amplitudes of the bulk stresses of body 2 and body 1 [Pa].
        phase : float or dict[str, Any], optional
            Phase [rad] of all, or by name: ``{"sigma_B": np.pi / 2}``.
        points : int
            Points of a period (default: 16), with the turning points of every load added. Loads out
            of phase get 64 points or more, a multiple of it.
        increments : int, PerRange or "auto"
            Increments from point to point, as in `waypoints`.

        Examples
        --------
        >>> LoadPath.start().normal(10.0).sine(2, T_x=2.0)
        LoadPath(33 branches, increments to be chosen)
        """
    @staticmethod
    def start() -> LoadPath:
        """The path before its first branch."""
    @property
    def t(self, /) -> NDArray[float64]:
        """Path time at the end of every increment."""
    def tangential(
        self, /, T_x: Quantities, *, increments: int | Literal["auto"] = ...
    ) -> LoadPath:
        """
        Visit the tangential forces `T_x` [N] in turn.

        The increments are shared out in proportion to the change of force. Path time runs as in
        the first branch: one unit for as many increments as that one has.
        """
    def torsion(self, /, M_z: Quantities, *, increments: int | Literal["auto"] = ...) -> LoadPath:
        """Visit the torsional moments `M_z` [N m] in turn, as `tangential` does the forces."""
    def waypoints(
        self,
        /,
        *,
        increments: PerRange | int | Literal["auto"] = ...,
        **columns: Sequence[float] | NDArray[np.float64],
    ) -> LoadPath:
        """
        Go straight from waypoint to waypoint, a branch for each.

        Parameters
        ----------
        increments : int, PerRange or "auto"
            Increments per branch; or as many as the change needs; or (default) as many as the path
            tolerance of the settings takes. A dense recording takes 1.
        **columns : array
            Loads (``W``, ``T_x``, ...), motions (``delta_x``, ...), ``sigma_B``, ``sigma_B1``,
            ``rolled`` and the path time ``t`` at the waypoints. What has no column stays as it is.
        """
    def whole_cycles(self, /, *, increments: int | None = None) -> list[tuple[int, int]]:
        """
        First and last branch of every whole cycle, from 0.

        A cycle ends where the loads return and the path goes on in the same direction, or where it
        turns. A sine may begin anywhere in its period. With `increments` only cycles that end
        within so many increments, as of a run that ended early.
        """

@final
class Lubkin:
    """
    Partial slip of a sphere under constant normal force and a torsional moment.

    J. L. Lubkin, J. Appl. Mech. 18 (1951) 183; exact for every nu.

    Parameters
    ----------
    hertz : Hertz
        The normal contact.
    bodies : tuple[Any, ...] of Elastic
        Materials of body 1 and body 2.
    mu : float
        Friction coefficient.
    """

    @property
    def M_limit(self, /) -> float:
        """Moment of full slip [N m], (3 pi/16) mu W a."""
    def M_z(self, /, c: ArrayLike) -> NDArray[float64]:
        """Moment M_z at the stick radius `c` [m] [N m]."""
    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __new__(
        cls, /, hertz: Hertz, *, bodies: tuple[Elastic | Body, Elastic | Body], mu: float
    ) -> Lubkin: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def bodies(self, /) -> tuple[Elastic, Elastic]:
        """Materials of body 1 and body 2."""
    @property
    def hertz(self, /) -> Hertz:
        """The normal contact."""
    @property
    def mu(self, /) -> float:
        """Friction coefficient."""
    def phi(self, /, c: ArrayLike) -> NDArray[float64]:
        """Rotation phi_z at the stick radius `c` [m] [rad]."""
    def q(self, /, r: ArrayLike, *, c: Length) -> NDArray[float64]:
        """Circumferential traction at `r` for the stick radius `c` [m] [Pa]."""
    def stick_radius(self, /, *, M_z: Moment) -> float:
        """Stick radius under the moment `M_z` [N m] [m]."""
    @property
    def stiffness(self, /) -> float:
        """Torsional stiffness without slip [N m/rad], 16 G a^3/3."""

@final
class March:
    """
    A load path being run through; iterating solves one increment after the other.

    Use :func:`pyfret.march`, which labels what this one gives.
    """

    def __iter__(self, /) -> March: ...
    def __new__(cls, /, scene: Scene) -> March: ...
    def __next__(self, /) -> dict[str, Any]:
        """Solve the next increment and give its scalars."""
    @property
    def attributes(self, /) -> str:
        """The attributes of the result, as JSON."""
    @property
    def done(self, /) -> int:
        """Increments solved so far."""
    def doubts(self, /) -> list[str]:
        """Doubts of the increments so far, one sentence each."""
    @property
    def scene(self, /) -> Scene:
        """The scene that is being solved."""
    def variables(self, /) -> dict[str, Variable]:
        """The last increment as variables: dimensions, values, attributes as xarray takes them."""

@final
class Material:
    """
    A material and its numbers.

    Parameters
    ----------
    name : str
        Its key in tables.
    numbers : list of (str, float, str)
        Name, as in a file of materials, value in its SI unit, and where that is from.
    title : str
        What the material is (default: its name).
    also : list of str
        Other names that it is found by.
    kind : str
        What it is: steel, metal, ceramic, coating or polymer (default: nothing).

    Examples
    --------
    >>> tests = "bending and torsion tests, report 2024-17"
    >>> steel = Material("our_steel", [("s_D", 412e6, tests), ("t_D", 268e6, tests)])
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs__(
        self, /
    ) -> tuple[str, list[tuple[str, float, str]], str, list[str], str]: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        name: str,
        numbers: Sequence[tuple[str, float, str]],
        title: str | None = None,
        also: Sequence[str] = ...,
        kind: str = "",
    ) -> Material: ...
    def __repr__(self, /) -> str: ...
    @property
    def also(self, /) -> list[str]:
        """Other names that it is found by."""
    def assessment(self, /, criterion: str) -> Assessment:
        """The criterion of that name with the limit or life curve of the material."""
    def critical_distance(self, /) -> float:
        """
        Critical distance L = (dK_th/(2 s_D))^2/pi [m].

        ``dK_th`` is the threshold range of the stress intensity, and 2 ``s_D`` the range of the
        fatigue limit. Both are fully reversed. Source: D. Taylor, The Theory of Critical Distances,
        Elsevier (2007). A ValueError names the number that is missing.
        """
    def doubts(self, /) -> list[str]:
        """Numbers that look like numbers in another unit, in words."""
    def estimate_of(self, /, names: Sequence[str]) -> str | None:
        """Numbers that are estimates or from memory, in words; None where each has a source."""
    def estimated(self, /, family: str) -> Material:
        """The material with the missing numbers that published rules can estimate."""
    @property
    def kind(self, /) -> str:
        """Kind: steel, metal, ceramic, coating or polymer; empty where nothing is given."""
    @property
    def name(self, /) -> str:
        """Key of the material in its table."""
    def number(self, /, name: str) -> float:
        """A number of the material by its key."""
    def numbers(self, /) -> list[tuple[str, float, str]]:
        """Name, value and source of every number."""
    @property
    def title(self, /) -> str:
        """Description of the material."""

@final
class Outline:
    """
    The outline of a contact: its border in any direction, its spots, the direction of its shear.

    Made of the tractions on a grid, each of shape (nx, ny) [Pa]; of :attr:`Snapshot.outline`.
    """

    def __new__(
        cls,
        /,
        grid: Grid,
        *,
        p: NDArray[np.float64],
        q_x: NDArray[np.float64],
        q_y: NDArray[np.float64],
    ) -> Outline: ...
    def __repr__(self, /) -> str: ...
    def border(self, /, azimuth: Angle = 0.0) -> tuple[float, float]:
        """Ends of a line through the centre within the contact, backwards and forwards [m]."""
    @property
    def centre(self, /) -> tuple[float, float]:
        """Centre of the area, x and y [m]; 0 where it lies in the middle of the grid."""
    def half_width(self, /, azimuth: Angle = 0.0) -> float:
        """Half of the width of the contact in a direction [m]."""
    @property
    def half_widths(self, /) -> tuple[float, float, float]:
        """Half of the largest and smallest width [m], and the direction of the largest [rad]."""
    @property
    def rim_cells(self, /) -> list[tuple[float, float]]:
        """Centres x, y of the cells at the rim [m]."""
    @property
    def shear_azimuth(self, /) -> float | None:
        """Direction of the shear to the x axis [rad]; None without shear, or where it has none."""
    @property
    def spots(self, /) -> list[tuple[float, float, float, float, float, float]]:
        """
        The spots, the largest first: x, y [m], area [m^2], semi-axes [m] and azimuth [rad].

        The semi-axes belong to the ellipse with the second moments of the spot, the larger one
        first, in the direction of the azimuth.
        """

@final
class PerRange:
    """Increments in proportion to a change, where the whole range takes this many."""

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, increments: int) -> PerRange: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def increments(self, /) -> int:
        """Increments over the whole range of the load or motion that needs most."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class Plastic:
    """
    Yielding after von Mises, with isotropic and kinematic hardening.

    The yield stress is the sum of what is given, with p the equivalent plastic strain::

        R(p) = s_y + hardening p + voce_Q (1 - exp(-voce_b p)) + s_y ((1 + p/swift_e_0)^swift_n - 1)

    The back stress is 2/3 kinematic e_p (Prager) and the sum of up to three terms with recall
    (Chaboche)::

        dX_i = 2/3 C_i de_p - gamma_i X_i dp

    Parameters
    ----------
    s_y : float
        Yield stress [Pa], positive.
    hardening : float
        Growth of the yield stress per equivalent plastic strain [Pa], 0 or more (default 0).
    voce_Q, voce_b : float
        Growth of the yield stress at which it saturates [Pa], and rate (default 0, none).
    swift_e_0, swift_n : float
        Strain and exponent of a power law (default 0, none).
    kinematic : float
        Linear kinematic hardening [Pa], 0 or more (default 0).
    chaboche_C, chaboche_gamma : float or sequence of float
        Moduli [Pa] and rates of recall of up to three back stresses (default none).

    Examples
    --------
    >>> Elastic(E=210e9, nu=0.3, plastic=Plastic(s_y=900e6, hardening=5e9)).plastic.s_y
    900000000.0
    >>> Plastic(s_y="250 MPa", chaboche_C=[60e9, 5e9], chaboche_gamma=[400, 20]).chaboche_C
    [60000000000.0, 5000000000.0]
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        *,
        s_y: YieldStress,
        hardening: YieldStress = 0.0,
        voce_Q: YieldStress = 0.0,
        voce_b: float = 0.0,
        swift_e_0: float = 0.0,
        swift_n: float = 0.0,
        kinematic: YieldStress = 0.0,
        chaboche_C: Quantities | None = None,
        chaboche_gamma: Quantities | None = None,
    ) -> Plastic: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def chaboche_C(self, /) -> list[float]:
        """Moduli of the back stresses with recall [Pa]."""
    @property
    def chaboche_gamma(self, /) -> list[float]:
        """Their rates of recall."""
    @property
    def hardening(self, /) -> float:
        """Linear isotropic hardening [Pa]."""
    @property
    def kinematic(self, /) -> float:
        """Linear kinematic hardening [Pa]."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def s_y(self, /) -> float:
        """Yield stress [Pa]."""
    @property
    def swift_e_0(self, /) -> float:
        """Strain of Swift's hardening."""
    @property
    def swift_n(self, /) -> float:
        """Exponent of Swift's hardening."""
    @property
    def voce_Q(self, /) -> float:
        """Growth of the yield stress at which Voce's hardening saturates [Pa]."""
    @property
    def voce_b(self, /) -> float:
        """Rate of Voce's hardening."""

@final
class PlasticBody:
    """
    A body of a scene that may yield, with its volume grid; use :meth:`Snapshot.plastic`.

    The points that have yielded are given as columns, in the order of :func:`yielded_columns`.
    """

    def __new__(cls, /, scene: Scene, body_number: int) -> PlasticBody: ...
    def eigenstress(self, /, rows: Sequence[NDArray[np.float64]]) -> Eigenstress | None:
        """The residual stress, for :class:`Subsurface`; None where nothing has yielded."""
    def fields(
        self,
        /,
        rows: Sequence[NDArray[np.float64]],
        p: ArrayLike,
        q_x: ArrayLike,
        q_y: ArrayLike,
        *,
        sigma_B: float = 0.0,
    ) -> dict[str, NDArray[np.float64]]:
        """
        Equivalent plastic strain, plastic strain and stress over planes, components and cells.

        The stress with the tractions and the bulk stress `sigma_B` of the body, and the residual
        stress without [Pa].
        """
    def grid(self, /, rows: Sequence[NDArray[np.float64]]) -> dict[str, Any]:
        """
        Depth and height of each plane of the volume grid [m], its layer, x, y of its cells.

        Of the grid that holds the points; `place` is the cell of each of them, x first.
        """
    def imprint(self, /, rows: Sequence[NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
        """
        Displacements that the surfaces have without tractions, on the grid of the contact [m].

        Growth of the gap by both bodies, u(2) - u(1) along x and y; the depth of this body.
        """
    def unloads_elastically(self, /, rows: Sequence[NDArray[np.float64]]) -> bool:
        """Whether the stress without tractions yields nowhere."""

@final
class Profile:
    """How a property changes from the surface of a graded coating to its bottom, s = z/h."""

    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @staticmethod
    def constant(value: float) -> Profile:
        """Return the same value everywhere."""
    @staticmethod
    def exponential(*, top: float, bottom: float) -> Profile:
        """Return top (bottom/top)^s over the depth s from 0 to 1, both of one sign."""
    @staticmethod
    def linear(*, top: float, bottom: float) -> Profile:
        """Return top + (bottom - top) s."""
    @staticmethod
    def power(*, top: float, bottom: float, exponent: float) -> Profile:
        """Return top + (bottom - top) s^exponent, with a positive exponent."""
    @staticmethod
    def table(points: Sequence[tuple[float, float]]) -> Profile:
        """Interpolate linearly between the points (s, value), s rising from 0 to 1."""

@final
class Ridges:
    """
    Parallel round ridges along y, turned by `angle`, symmetric about the origin.

    Between two crests the surface follows the nearer one.

    Parameters
    ----------
    R : float
        Radius of a ridge [m].
    spacing : float
        Distance of neighbouring crests [m].
    count : float
        Number of ridges, a whole number; infinite (default): a row without an end.
    angle : float
        Turn of the ridges from y [rad].
    """

    @property
    def R(self, /) -> float:
        """Radius of a ridge [m]."""
    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls, /, *, R: Radius, spacing: Length, count: float = ..., angle: Angle = 0.0
    ) -> Ridges: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def angle(self, /) -> float:
        """Turn of the ridges from y [rad]."""
    @property
    def count(self, /) -> float:
        """Number of ridges; infinite for a row without an end."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def spacing(self, /) -> float:
        """Distance of neighbouring crests [m]."""

@final
class Ring:
    """
    A round ridge along a circle about the origin: a ring, an O-ring, the rim of a cup.

    Parameters
    ----------
    radius : float
        Radius of the circle of its crest [m].
    R : float
        Radius of its cross-section [m].
    """

    @property
    def R(self, /) -> float:
        """Radius of its cross-section [m]."""
    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, *, radius: Length, R: Radius) -> Ring: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def radius(self, /) -> float:
        """Radius of the circle of its crest [m]."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class Rough:
    """
    A random self-affine surface; add it to a shape.

    Its power falls like k^-(2 + 2 `hurst`) between two wavelengths and is level above the longer
    one. The same seed gives the same surface on every grid of the same size, however fine.

    Parameters
    ----------
    rms : float
        Root-mean-square height [m].
    hurst : float
        Hurst exponent, above 0 and up to 1.
    longest, shortest : float
        Wavelengths between which it is self-affine [m]; the shortest is at least two cells.
    seed : int
        Seed of the phases (default 0).
    """

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls, /, *, rms: Length, hurst: float, longest: Length, shortest: Length, seed: int = 0
    ) -> Rough: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def hurst(self, /) -> float:
        """Hurst exponent."""
    @property
    def longest(self, /) -> float:
        """Longest wavelength of the self-affine range [m]."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def rms(self, /) -> float:
        """Root-mean-square height [m]."""
    @property
    def seed(self, /) -> int:
        """Seed of the phases."""
    @property
    def shortest(self, /) -> float:
        """Shortest wavelength [m]."""

@final
class Scene:
    """
    A fretting contact problem.

    Parameters
    ----------
    body1, body2 : Body
        The upper body (the indenter) and the lower one.
    friction : float, Friction or "stick"
        Friction coefficient, >= 0, a friction law, or no slip.
    grid : Grid
        Mesh of the contact plane; it has to hold the contact.
    path : LoadPath, optional
        Load history; it can be given when the scene is solved instead.
    settings : Settings, optional
        How the scene is solved.
    title : str
        One line that names the scene in results and figures.
    """

    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        *,
        body1: Body,
        body2: Body,
        friction: Friction | float | Literal["stick"],
        grid: Grid,
        path: LoadPath | None = None,
        settings: Settings | None = None,
        title: str = ...,
    ) -> Scene: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    def _repr_html_(self, /) -> Any: ...
    @property
    def body1(self, /) -> Body:
        """The upper body."""
    @property
    def body2(self, /) -> Body:
        """The lower body."""
    def check(self, /, path: LoadPath | None = None) -> None:
        """
        Refuse a scene that has no meaning, warn of what is hardly meant.

        Parameters
        ----------
        path : LoadPath, optional
            Load history (default: the path of the scene).

        Raises
        ------
        InvalidSceneError
            With the key, the value and what is allowed.

        Warns
        -----
        SceneWarning
            One for each sentence of :meth:`doubts`.
        """
    def doubts(self, /, path: LoadPath | None = None) -> list[str]:
        """
        Doubts: numbers that look like numbers in another unit, few cells.

        One sentence for each, with what was understood; :func:`pyfret.solve` and :meth:`check` warn
        of them.

        Parameters
        ----------
        path : LoadPath, optional
            Load history (default: the path of the scene).
        """
    @property
    def friction(self, /) -> Friction:
        """Friction law."""
    @staticmethod
    def from_file(
        path: str | PathLike[str], *, set: Sequence[str] = ..., allow_outside: bool = False
    ) -> Scene:
        """
        Read a scene file.

        Parameters
        ----------
        path : path
            The file: TOML, ``schema = 1``, SI units.
        set : sequence of str, optional
            Values to exchange, each ``"key=value"`` as after ``fret run --set``, e.g.
            ``"friction.mu=0.5"`` or ``"body2.coatings.0.E.E_substrate=4"``.
        allow_outside : bool, optional
            Let the scene name files outside its own folder.

        Raises
        ------
        InvalidSceneError
            With the line, the key and what is allowed; an unknown key names the nearest valid one.
        """
    @staticmethod
    def from_toml(text: str, *, set: Sequence[str] = ...) -> Scene:
        """Read a scene from the text of a scene file; see :meth:`from_file`."""
    @property
    def grid(self, /) -> Grid:
        """Mesh of the contact plane."""
    @property
    def hertz(self, /) -> Hertz | None:
        """The yardstick a_H, p_H: the uncoated pair at the largest normal force of the path."""
    def interfaces(self, /, body_number: int = 2) -> list[float]:
        """
        Depths of the interfaces of a body [m], from the surface down; none of a homogeneous one.

        Parameters
        ----------
        body_number : 1 or 2
            The upper body or the lower one (default 2).

        Examples
        --------
        >>> scene.interfaces()  # doctest: +SKIP
        [3e-06, 3.5e-06]
        """
    def length(self, /, p: ArrayLike) -> float:
        """
        Length that results of an increment are measured in [m].

        That is a_H. Without a Hertz contact it is half the longer side of the box around the cells
        under the pressure `p` [Pa], shape (nx, ny).
        """
    @property
    def mu(self, /) -> float:
        """Friction coefficient."""
    @property
    def path(self, /) -> LoadPath:
        """Load history."""
    def replace(
        self,
        /,
        values: Mapping[str, Any] | None = None,
        *,
        body1: Body | None = None,
        body2: Body | None = None,
        grid: Grid | None = None,
        path: LoadPath | None = None,
        settings: Settings | None = None,
        save: Literal["branches", "all"] | Sequence[int] | None = None,
        friction: Friction | float | Literal["stick"] | None = None,
        title: str | None = None,
    ) -> Scene:
        """
        Return the scene with other values, or with other parts.

        Parameters
        ----------
        values : mapping of str to value, optional
            By the keys of a scene file: ``"body2.coatings.0.thickness"`` or ``"path.1.T_x.mu_W"``.
            ``"mu"`` is short for ``"friction.mu"``. ``"path.*.W"`` stands for every branch.
            Several keys with commas between get the same value, and a key after a ``-`` gets the
            opposite value. So ``"path.1.T_x,-path.2.T_x,path.3.T_x"`` is an amplitude.
        body1, body2, grid, path, settings, friction, title : optional
            Parts as in the constructor. They replace the parts of the scene with new values.
        save : "branches", "all" or sequence of int, optional
            Increments whose fields are kept.

        Raises
        ------
        InvalidSceneError
            A key does not exist, or a value has no meaning; the message names both.

        Examples
        --------
        >>> harder = scene.replace({"body2.coatings.0.E": 3e11})  # doctest: +SKIP
        """
    @property
    def settings(self, /) -> Settings:
        """How the scene is solved."""
    def summary(self, /) -> str:
        """Describe bodies, friction, grid, Hertz contact and load path, a line for each."""
    @property
    def title(self, /) -> str:
        """One line that names the scene."""
    def to_toml(self, /) -> str:
        """Write the text of a scene file, all numbers in SI units."""
    @staticmethod
    def ball_on_flat(
        ball: Body | Elastic | str,
        flat: Body | Elastic | str,
        *,
        R: Radius,
        W: Quantity,
        mu: FrictionCoefficient,
        T: Quantity | None = None,
        shift: Length | None = None,
        sigma_B: BulkStress | None = None,
        cycles: int = 2,
        wear: Mapping[str, Any] | None = None,
        error: float = 0.02,
        n: int | None = None,
        grid: Grid | None = None,
        quiet: bool = False,
    ) -> Scene:
        """Make the scene of a ball on a flat: bodies, path and a grid that fits them.

        Parameters
        ----------
        ball, flat : Body, Elastic or str
            The bodies: the name of a material of the table, a material, or a body with coatings.
        R : float
            Radius of the ball [m].
        W : float
            Normal force [N].
        mu : float
            Friction coefficient.
        T, shift : float, optional
            Amplitude of the tangential force [N], or of the shift of the bodies [m], along x
            (default: the ball is pressed alone).
        sigma_B : float, optional
            Amplitude of the bulk stress of the lower body along x [Pa], in phase with the
            force or the shift (default: none).
        cycles : int
            Cycles of the force or of the shift (default 2).
        wear : dict, optional
            What wears, as keywords of :func:`pyfret.wear.solve`: the grid holds the scar of all
            cycles.
        error : float
            Error that is wanted of the pressure (default 2 %).
        n : int, optional
            Cells along the shorter side, in place of those that `error` and a film take.
        grid : Grid, optional
            Grid in place of the one that is chosen.
        quiet : bool
            Whether the line about the grid is not printed (default False).

        Returns
        -------
        Scene
            For ``fret.solve(scene)``. An outermost coating has two cells in its thickness where
            that takes at most 512 cells along a side, 4096 of a line contact. The printed line has
            the cells of the grid, what they resolve and what they do not.

        Examples
        --------
        >>> scene = Scene.ball_on_flat(
        ...     "100Cr6", "Ti6Al4V", R=5e-3, W=10.0, mu=0.6, T=3.0
        ... )  # doctest: +SKIP
        >>> fret.solve(scene).summary()  # doctest: +SKIP
        """
    @staticmethod
    def crossed_cylinders(
        first: Body | Elastic | str,
        second: Body | Elastic | str,
        *,
        R: Radius,
        R2: Radius | None = None,
        angle: Angle = 1.5707963267948966,
        W: Quantity,
        mu: FrictionCoefficient,
        T: Quantity | None = None,
        shift: Length | None = None,
        sigma_B: BulkStress | None = None,
        cycles: int = 2,
        wear: Mapping[str, Any] | None = None,
        error: float = 0.02,
        n: int | None = None,
        grid: Grid | None = None,
        quiet: bool = False,
    ) -> Scene:
        """Make the scene of two crossed cylinders, as of wires and of many rigs.

        Parameters
        ----------
        first, second : Body, Elastic or str
            The upper cylinder, whose axis is y, and the lower one.
        R, R2 : float
            Their radii [m] (default of the second: the first radius).
        angle : float
            Angle between the axes [rad], such as ``"90 deg"`` (default: a right angle).
        W, mu, T, shift, sigma_B, cycles, wear, error, n, grid, quiet
            As in :func:`ball_on_flat`.
        """
    @staticmethod
    def cylinder_on_flat(
        cylinder: Body | Elastic | str,
        flat: Body | Elastic | str,
        *,
        R: Radius,
        W: Quantity,
        mu: FrictionCoefficient,
        T: Quantity | None = None,
        shift: Length | None = None,
        sigma_B: BulkStress | None = None,
        cycles: int = 2,
        wear: Mapping[str, Any] | None = None,
        error: float = 0.02,
        n: int | None = None,
        grid: Grid | None = None,
        quiet: bool = False,
    ) -> Scene:
        """Make the scene of a long cylinder on a flat, a line contact in plane strain.

        The axis of the cylinder is y. Forces are per metre of its length [N/m]: `W` and `T`.
        For the other parameters see :func:`ball_on_flat`.
        """
    @staticmethod
    def flat_pad(
        pad: Body | Elastic | str,
        flat: Body | Elastic | str,
        *,
        width: Length,
        edge: Radius,
        W: Quantity,
        mu: FrictionCoefficient,
        T: Quantity | None = None,
        shift: Length | None = None,
        sigma_B: BulkStress | None = None,
        cycles: int = 2,
        wear: Mapping[str, Any] | None = None,
        error: float = 0.02,
        n: int | None = None,
        grid: Grid | None = None,
        quiet: bool = False,
    ) -> Scene:
        """Make the scene of a flat pad with rounded edges on a flat: a line contact.

        Parameters
        ----------
        pad, flat : Body, Elastic or str
            As in :func:`ball_on_flat`.
        width : float
            Width of the flat of the pad [m], without its rounded edges.
        edge : float
            Radius of the edges [m].
        W, T : float
            Forces per metre [N/m].
        mu, shift, sigma_B, cycles, wear, error, n, grid, quiet
            As in :func:`ball_on_flat`.
        """
    @staticmethod
    def rough_on_flat(
        rough: Body | Elastic | str,
        flat: Body | Elastic | str,
        *,
        surface: SurfaceMap | Rough | str | os.PathLike[str],
        R: Radius,
        W: Quantity,
        mu: FrictionCoefficient,
        T: Quantity | None = None,
        shift: Length | None = None,
        sigma_B: BulkStress | None = None,
        cycles: int = 2,
        wear: Mapping[str, Any] | None = None,
        error: float = 0.05,
        n: int | None = None,
        grid: Grid | None = None,
        quiet: bool = False,
    ) -> Scene:
        """Make the scene of a rough ball on a flat.

        Parameters
        ----------
        rough, flat : Body, Elastic or str
            The ball with the rough surface, and the flat.
        surface : SurfaceMap, Rough or path
            Measured heights, a random surface, or the file of an instrument.
        R : float
            Radius of the ball [m]: flats would touch over the whole grid.
        W, mu, T, shift, sigma_B, cycles, wear, error, n, grid, quiet
            As in :func:`ball_on_flat`; `error` is 5 % by default.
        """

@final
class Spacing:
    """
    How the increments of a branch are spaced.

    ``UNIFORM``: equal increments of force. ``EQUAL_RADIUS``: increments of equal contact radius
    of a paraboloid; natural for an indentation. ``SHORT_FIRST``: a short first increment, then
    equal ones; shows the stiffness and the stick zone right after a reversal.
    """

    EQUAL_RADIUS: Final[Spacing]
    SHORT_FIRST: Final[Spacing]
    UNIFORM: Final[Spacing]
    def __eq__(self, value: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __int__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...

@final
class Sphere:
    """
    A sphere, taken as the paraboloid r^2/(2 R) as in Hertz's theory.

    Parameters
    ----------
    R : float
        Radius [m]; negative for a hollow.
    """

    @property
    def R(self, /) -> float:
        """Radius [m]."""
    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, R: Radius) -> Sphere: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class Springs:
    """
    One-dimensional springs with friction: the shift for every path of W and T.

    Exact for a sphere on a flat of like bodies with nu = 0 (method of dimensionality reduction).

    Parameters
    ----------
    largest : Hertz
        The contact under the largest force of the path.
    R : float
        Radius [m].
    bodies : tuple[Any, ...] of Elastic
        Materials of body 1 and body 2.
    mu : float
        Friction coefficient.
    n : int
        Springs on either side.
    loads : list of (float, float, int)
        Loads to go through at once: W and T [N], and the steps of :meth:`load`.
    """

    @property
    def R(self, /) -> float:
        """Radius [m]."""
    def __eq__(self, other: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        largest: Hertz,
        *,
        R: Radius,
        bodies: tuple[Elastic | Body, Elastic | Body],
        mu: float,
        n: int = 1500,
        loads: Sequence[tuple[float, float, int]] = ...,
    ) -> Springs: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def bodies(self, /) -> tuple[Elastic, Elastic]:
        """Materials of body 1 and body 2."""
    @property
    def largest(self, /) -> Hertz:
        """The contact under the largest force that there are springs for."""
    def load(self, /, *, W: PointForce, T: PointForce, steps: int = 10) -> float:
        """Go straight to the forces `W`, `T` [N] in `steps` steps; the shift delta_x [m]."""
    @property
    def loads(self, /) -> list[tuple[float, float, int]]:
        """The loads gone through: W and T [N] at the end of each, and its steps."""
    @property
    def mu(self, /) -> float:
        """Friction coefficient."""
    @property
    def n(self, /) -> int:
        """Springs on either side."""

@final
class States:
    """
    States of a contact: tractions [Pa], where it sticks, bulk stress [Pa], what has yielded.

    Fields are of shape (nx, ny), one for each state. A body that may yield has an `eigenstress` for
    each state, another body has none.
    """

    def __new__(
        cls,
        /,
        grid: Grid,
        *,
        p: Sequence[NDArray[np.float64]],
        q_x: Sequence[NDArray[np.float64]],
        q_y: Sequence[NDArray[np.float64]],
        stick: Sequence[NDArray[np.bool_]],
        sigma_B: Sequence[float],
        eigenstress: Sequence[Eigenstress | None],
    ) -> States: ...

@final
class StressCache:
    """
    Stress below a body over a cycle, which the sections of several questions share.

    It belongs to one run, one body and one of its cycles. Its memory is at most 192 MB.
    """

    def __new__(cls, /) -> StressCache: ...

@final
class Subsurface:
    """
    Tractions on a body, and what they cause below its surface.

    Use :func:`pyfret.subsurface.stress`, which labels what this one gives.
    """

    def __new__(
        cls,
        /,
        body: Body,
        grid: Grid,
        *,
        p: ArrayLike | None = None,
        q_x: ArrayLike | None = None,
        q_y: ArrayLike | None = None,
        body_number: int = 2,
        sigma_B: BulkStress = 0.0,
        residual: Sequence[ArrayLike] | None = None,
        eigenstress: Sequence[Eigenstress | None] | None = None,
        rim: bool = False,
        stick: NDArray[bool_] | None = None,
    ) -> Subsurface: ...
    def border_stress(
        self, /, *, x: float | None = None, y: float | None = None, azimuth: Angle | None = None
    ) -> NDArray[np.float64]:
        """Stress [Pa] on the surface where a line crosses rims and stick borders; shape (n, 6)."""
    def borders(
        self, /, *, x: float | None = None, y: float | None = None, azimuth: Angle | None = None
    ) -> list[tuple[float, float, str, bool]]:
        """
        Crossings of a line, or of the lines of all cells, with rims of contact and stick zone.

        x, y, which of them, and whether the place is known within a cell.
        """
    def maximum(
        self,
        /,
        of: str,
        samples: ArrayLike,
        z: Sequence[float],
        layer: Sequence[int],
        *,
        x: float | None = None,
        y: float | None = None,
        azimuth: Angle | None = None,
        only: int | None = None,
        anywhere: bool = False,
        error_bar: float | None = None,
    ) -> tuple[
        tuple[
            float,
            float,
            float,
            float,
            int,
            str | None,
            float,
            tuple[float, float, float, float, float | None],
        ]
        | None,
        list[int],
    ]:
        """
        Largest value of a measure on a section, between its samples; in the layer `only`.

        Gives the value, x, y, z, the layer, the border on which it lies, its error and the parts of
        this error. The parts are those along x, y and z, of the tractions and of the solution. The
        last follows from the `error_bar` of the stress over the stress. Then come the layers whose
        stress still rises at the end of the longest section. `anywhere`: also beside the section.
        """
    def points(
        self, /, places: Sequence[tuple[float, float, float, int]], *, displacement: bool = False
    ) -> NDArray[np.float64]:
        """Stress [Pa] or displacement [m] at points x, y, z, layer; shape (n, 6 or 3)."""
    @property
    def rim(self, /) -> bool:
        """Whether the tractions are tractions of a contact."""
    def section(
        self,
        /,
        z: Sequence[float],
        layer: Sequence[int],
        *,
        x: float | None = None,
        y: float | None = None,
        azimuth: Angle | None = None,
        displacement: bool = False,
    ) -> NDArray[np.float64]:
        """Stress [Pa] or displacement [m] on a section, shape (6 or 3, depths, places)."""
    def slice(
        self, /, z: float, layer: int, *, displacement: bool = False
    ) -> list[NDArray[np.float64]]:
        """Stress [Pa] or displacement [m] on a plane, six or three arrays of shape (nx, ny)."""
    def volume(
        self,
        /,
        out: str | PathLike[str],
        z: Sequence[float],
        layer: Sequence[int],
        *,
        of: Sequence[str],
        title: str = "",
    ) -> None:
        """Write measures of stress, and displacements, to a .vti file or a Zarr folder."""

@final
class Sum:
    """Several shapes on top of one another, made by adding them."""

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        parts: Sequence[
            Flat
            | Sphere
            | Ellipsoid
            | Cylinder
            | CrownedRoller
            | Cone
            | Wedge
            | FlatPunch
            | Ring
            | Ridges
            | Waviness
            | Rough
            | SurfaceMap
            | Sum
        ],
    ) -> Sum: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def parts(
        self, /
    ) -> list[
        Flat
        | Sphere
        | Ellipsoid
        | Cylinder
        | CrownedRoller
        | Cone
        | Wedge
        | FlatPunch
        | Ring
        | Ridges
        | Waviness
        | SurfaceMap
        | Rough
        | Sum
    ]:
        """The shapes."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""

@final
class SurfaceMap:
    """
    Numbers over the contact plane, the middle of the map over the origin.

    As the shape of a body they are heights out of it, towards the other one [m]. In a friction law
    they are factors of mu.

    Parameters
    ----------
    values : array of shape (points along x, points along y)
        The numbers.
    spacing : float or (float, float)
        Distance of the points along x and y [m]. In between they are interpolated linearly.
    missing : "refuse", "crop" or "fill"
        What becomes of points that are NaN or masked. "refuse": an error with their place. "crop":
        lines are taken off the edges. "fill": the mean of the neighbours, where at most a tenth of
        the points is missing and no hole is wider than ten.
    """

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls,
        /,
        values: ArrayLike,
        *,
        spacing: Quantity | tuple[Quantity, Quantity],
        missing: Literal["refuse", "crop", "fill"] = "refuse",
    ) -> SurfaceMap: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def filled(self, /) -> int:
        """How many of the numbers were not measured: each is the mean of its neighbours."""
    def filter(self, /, *, short: Length | None = None, long: Length | None = None) -> SurfaceMap:
        """
        Return the map without waves that are shorter or longer than cut-offs.

        The filters are Gaussian (ISO 16610-61): half of a wave as long as the cut-off passes. At
        the border the weights are normalised.

        Parameters
        ----------
        short, long : float, optional
            Cut-off wavelengths [m]: shorter than `short` is removed, and longer than `long`.
        """
    def fit_form(self, /, form: Literal["plane", "sphere", "paraboloid", "cubic"]) -> Form:
        """
        Fit a form by least squares: its slopes, radii and heights.

        Parameters
        ----------
        form : "plane", "sphere", "paraboloid" or "cubic"
            A sphere is replaced by its paraboloid, as every curved shape.
        """
    @staticmethod
    def from_file(
        path: str | PathLike[str],
        *,
        spacing: Quantity | tuple[Quantity, Quantity] | None = None,
        unit: str | None = None,
        channel: str | None = None,
        missing: Literal["refuse", "crop", "fill"] = "refuse",
    ) -> SurfaceMap:
        """
        Read numbers from a file: a ``.npy`` array, or text of instruments and spreadsheets.

        Text is UTF-8, UTF-16 or Latin-1; its numbers are parted by semicolons, tabs, commas or
        blanks, with decimal points or commas. The text is a table, one line per x, with or without
        titles. Or it has points x, y and height in any order, Gwyddion's export, or an ESRI grid. A
        profile is refused.

        Parameters
        ----------
        path : path
            The file.
        spacing : float or (float, float), optional
            Distance of the points along x and y [m], where the file does not have it.
        unit : str, optional
            Unit of the numbers, such as "um"; by default the unit of the file, or metres. It
            holds for x and y of a list of points, too.
        channel : str, optional
            Of a list of points with several columns beside x and y, the title or the number
            (from 1) of the one that is meant.
        missing : "refuse", "crop" or "fill"
            What becomes of points without a number (blank, NaN or the mark of the header).
            "refuse": an error with their place. "crop": lines are taken off the edges. "fill": the
            mean of the neighbours, where at most a tenth of the points is missing and no hole is
            wider than ten.

        Raises
        ------
        StoreError
            If the file cannot be read, contradicts the arguments, or leaves something open. The
            message has the line, the column and the argument to give.
        """
    def level(
        self, /, form: Literal["plane", "sphere", "paraboloid", "cubic"] = "plane"
    ) -> SurfaceMap:
        """
        Return the map without a form; :meth:`fit_form` gives the radius of what is subtracted.

        Parameters
        ----------
        form : "plane", "sphere", "paraboloid" or "cubic"
            The form that is fitted by least squares and subtracted (default "plane").
        """
    @property
    def peak_to_valley(self, /) -> float:
        """Largest less smallest number: S_z of heights [m]."""
    def plot(self, /, ax: Axes | None = None) -> Axes:
        """Draw the heights; return the axes."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    def resample(
        self,
        /,
        *,
        spacing: Quantity | tuple[Quantity, Quantity] | None = None,
        n: int | tuple[int, int] | None = None,
    ) -> SurfaceMap:
        """
        Return the map on other points, by a cosine series through all of its points.

        Finer points show the waves of the map between them. Coarser points leave out the waves that
        they cannot carry. The size of the map stays.

        Parameters
        ----------
        spacing : float or (float, float), optional
            Distance of the new points [m], rounded to a whole number of them.
        n : int or (int, int), optional
            Number of the new points along x and y.
        """
    @property
    def rms(self, /) -> float:
        """Root of the mean square about the mean: S_q of heights [m]."""
    @property
    def spacing(self, /) -> tuple[float, float]:
        """Distance of the points along x and y [m]."""
    def spectrum(self, /) -> xr.DataArray:
        """Return the power spectral density of the heights, mean over directions [m^4]."""
    def statistics(self, /) -> Statistics:
        """
        Return the parameters of the heights after ISO 25178-2 about their mean.

        S_q, S_a, S_z, S_sk, S_ku and S_dq, with the pitch of the slope. The heights are
        taken as they are: subtract the form and filter first.
        """
    def summary(self, /) -> str:
        """
        Describe the map: points, pitch, size, form, and the parameters without the form.

        A ball that was measured with its curvature is named as such, with its radius.
        """
    def to_csv(self, /, path: str | PathLike[str]) -> None:
        """
        Write the heights as a table of text: x, y and z of a point in m on each line.

        :func:`pyfret.read_surface` reads it. A file that is there is replaced.

        Parameters
        ----------
        path : path
            The file.
        """
    @property
    def values(self, /) -> NDArray[float64]:
        """The numbers."""

@final
class SurfaceOperator:
    """
    The displacements that tractions cause on a pair of bodies, u = C * q.

    Parameters
    ----------
    body1, body2 : Body
        The upper body and the lower one; their shapes do not matter.
    grid : Grid
        Cells on which tractions are constant.
    settings : Settings, optional
        Its kernel settings are used.
    """

    def __eq__(self, other: object, /) -> bool: ...
    def __hash__(self, /) -> int: ...
    def __new__(
        cls, /, body1: Body, body2: Body, grid: Grid, *, settings: Settings | None = None
    ) -> SurfaceOperator: ...
    def __reduce__(self, /) -> tuple[Any, tuple[Any, str | None, dict[str, Any] | None]]: ...
    def __repr__(self, /) -> str: ...
    @property
    def body1(self, /) -> Body:
        """The upper body."""
    @property
    def body2(self, /) -> Body:
        """The lower body."""
    def displacement(
        self,
        /,
        p: ArrayLike | None = None,
        q_x: ArrayLike | None = None,
        q_y: ArrayLike | None = None,
    ) -> NDArray[np.float64]:
        """
        Relative displacement u(2) - u(1) [m], shape (3, nx, ny): along x, y and z.

        Parameters
        ----------
        p : array of shape (nx, ny), optional
            Pressure [Pa] (default: none).
        q_x, q_y : array of shape (nx, ny), optional
            Shear tractions on body 2 [Pa] (default: none).
        """
    @property
    def grid(self, /) -> Grid:
        """Cells on which tractions are constant."""
    @property
    def settings(self, /) -> Settings:
        """Only the settings of the kernels are used."""

@final
class Waviness:
    """
    A wave along the direction `angle`, a crest at the origin for phase 0; add it to a shape.

    Parameters
    ----------
    amplitude : float
        Height of a crest above the mean [m].
    wavelength : float
        Distance of the crests [m].
    angle : float
        Direction, from x towards y [rad].
    phase : float
        Phase at the origin [rad].
    """

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(
        cls, /, *, amplitude: Length, wavelength: Length, angle: Angle = 0.0, phase: Angle = 0.0
    ) -> Waviness: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def amplitude(self, /) -> float:
        """Height of a crest above the mean [m]."""
    @property
    def angle(self, /) -> float:
        """Direction, from x towards y [rad]."""
    @property
    def phase(self, /) -> float:
        """Phase at the origin [rad]."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def wavelength(self, /) -> float:
        """Distance of the crests [m]."""

@final
class Wedge:
    """
    Two flanks that meet in an edge; it is y turned by `angle`.

    Parameters
    ----------
    slope : float
        Tangent of the angle between flank and contact plane.
    angle : float
        Turn of the edge from y [rad].
    """

    def __add__(self, other: object, /) -> Sum: ...
    def __radd__(self, other: object, /) -> Sum: ...
    def __eq__(self, value: object, /) -> bool: ...
    def __getnewargs_ex__(self, /) -> tuple[tuple[()], dict[str, Any]]: ...
    def __hash__(self, /) -> int: ...
    def __ne__(self, value: object, /) -> bool: ...
    def __new__(cls, /, *, slope: float, angle: Angle = 0.0) -> Wedge: ...
    def __replace__(self, /, **changes: Any) -> Self: ...
    def __repr__(self, /) -> str: ...
    @property
    def angle(self, /) -> float:
        """Turn of the edge from y [rad]."""
    def replace(self, /, **changes: Any) -> Self:
        """Return a copy with some of its parts exchanged, named as in the constructor."""
    @property
    def slope(self, /) -> float:
        """Tangent of the angle between flank and contact plane."""

@final
class YieldBelow:
    """Load factors on a section."""

    @property
    def depths(self, /) -> tuple[list[float], list[int]]:
        """Depths [m] and their layers."""
    def fields(self, /) -> dict[str, NDArray[np.float64]]:
        """Load factors over (depth, place), NaN where not judged."""
    def least(self, /, layer: int, factor: str) -> dict[str, Any] | None:
        """Place of the least load factor of a layer; `score` is its inverse."""

def arrest(
    lengths: Sequence[float],
    K_max: Sequence[float],
    K_min: Sequence[float],
    threshold_: tuple[float, float | None, float, float | None, list[tuple[float, float]] | None],
    start: float,
) -> tuple[Literal["dormant", "stops", "grows"], float | None, list[float], float, float, float]:
    """
    Arrest or growth of a crack.

    Verdict, length where it stops, crossings, range of K over its threshold at the start, margin
    and its length.
    """

def channel_crack(film_: Elastic, below: Elastic) -> float:
    """Factor g of a channel crack in a film; use :func:`pyfret.fracture.channel_release`."""

def check_settings(settings: Settings) -> None:
    """Fails if a setting has no meaning."""

def check_sides(
    shape: tuple[SupportsIndex, SupportsIndex],
    spacing: tuple[SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex],
) -> None:
    """Refuse a map of a file that is larger or smaller than any instrument measures."""

def chosen_depths(
    body: Body, *, a: float, deepest: float, finer: float = 1.0
) -> tuple[list[float], list[int]]:
    """
    Depths [m] that the layers of a body ask for, with their layers.

    They go to the depth `deepest` [m] under a contact of the radius `a` [m]; `finer` times as
    many as the default.
    """

def coated_indentation(
    *,
    R: Radius,
    indenter: Elastic | Body,
    coating: Coating,
    substrate: Elastic | Body,
    W: PointForce,
) -> CoatedIndentation:
    """Contact of a sphere of radius `R` [m] with a coated body under `W` [N], without friction."""

def continued_pressure(p: ArrayLike, grid: Grid) -> NDArray[np.float64]:
    """Pressure [Pa], that at the rim continued from inside; use :meth:`Snapshot.p_continued`."""

def count_work() -> dict[str, int]:
    """
    Return what this process has computed below surfaces.

    Kernel tables below layers, stresses on lines and planes and at single points (each point once
    for each state), and planes judged by criteria.
    """

def coupled_indentation(*, beta: float, mu: float) -> CoupledIndentation:
    """
    Indentation by a sphere for Dundurs' `beta` and friction `mu` > 0.

    The problem is D. A. Spence's, J. Elasticity 5 (1975) 297: the contact grows without changing
    its shape.
    """

def crack_life(
    lengths: Sequence[float],
    K_max: Sequence[float],
    K_min: Sequence[float],
    threshold_: tuple[float, float | None, float, float | None, list[tuple[float, float]] | None],
    *,
    C: float,
    m: float,
    growth: str,
    short: bool,
    start: float,
    end: float,
) -> tuple[float, float, bool]:
    """Cycles of growth by Paris' law, where it ends [m] and whether it stops there."""

def criteria() -> list[tuple[str, str]]:
    """Names of the criteria, and how they are written in figures."""

def criterion_on(
    criterion: Criterion,
    stress: ArrayLike,
    plastic_strain: ArrayLike | None = None,
    *,
    tolerance: float,
) -> dict[str, NDArray[np.float64]]:
    """
    A criterion on stresses of shape (time, points, 6): arrays over the points.

    `plastic_strain` has that shape; without it the points stay elastic.
    """

def cycle_sections(
    body: Body,
    grid: Grid,
    moments: Callable[[list[int] | None], States | None],
    count: int,
    *,
    residual: Sequence[ArrayLike] | None = None,
) -> list[tuple[float | None, float | None, float | None]]:
    """
    x, y and azimuth of the sections in which a cycle of a contact is looked at by default.

    The first stands along the shear. Others follow where the contact or its shear has no axis
    there, or where bulk and residual stress have another direction. `moments` and `count` as in
    :class:`CycleSection`.
    """

def cycle_temperature(
    conductor1: Sequence[tuple[float, float]],
    conductor2: Sequence[tuple[float, float]],
    *,
    body1: Body,
    body2: Body,
    grid: Grid,
    bulk: tuple[float, float],
    frequency: Frequency,
    ends: Sequence[float],
    heat: ArrayLike,
    contact: NDArray[bool_],
    harmonics: int,
    jumps: bool,
) -> dict[str, Any]:
    """Temperature over a cycle; use :meth:`pyfret.Result.temperature`."""

def damage_of_values(
    assessment: Assessment, values: ArrayLike, *, below: str, knee: float, exponent: float | None
) -> NDArray[np.float64]:
    """
    Damage of one loop for each value of a criterion.

    `knee` are the cycles at the knee, `exponent` is the exponent of the lives above a limit.
    """

def damage_on(
    assessment: Assessment,
    stress: ArrayLike,
    counts: ArrayLike,
    *,
    below: str,
    knee: float,
    exponent: float | None,
    bounded: bool,
) -> dict[str, NDArray[np.float64]]:
    """
    Miner's damage of loops on the worst planes of points.

    `stress` has the shape (loops, instants, points, 6). Arrays over the points: `damage`, `missed`
    and `normal`; `parts` and `values` over (points, loops).
    """

def dang_van_path(stress: ArrayLike) -> NDArray[np.float64]:
    """
    The path of one point in Dang Van's plane.

    From its stress of shape (time, 6): tau and hydrostatic stress at every instant.
    """

def degrees(angle: float) -> str:
    """An angle [degrees] to a tenth, with its unit."""

def depths(body: Body, z: Sequence[float]) -> tuple[list[float], list[int]]:
    """Depths [m] with their layers; on an interface both, the upper one first."""

def doubt(key: str, shown: str, value: float) -> str | None:
    """The doubt of a number, if it is hardly meant, by its key and the name that it is shown by."""

def doubt_quantity(quantity: str, shown: str, value: float) -> str | None:
    """Doubt of a number that lies outside the range of its row."""

def dundurs_beta(body1: Elastic | Body, body2: Elastic | Body) -> float:
    """
    Dundurs' parameter beta of the pair: the coupling of normal and tangential directions.

    beta = [(1 - 2 nu1)/G1 - (1 - 2 nu2)/G2] / (2 [(1 - nu1)/G1 + (1 - nu2)/G2])
    """

def ellipse_factor(aspect: float) -> float:
    """
    Factor from the plane K to the deepest point of a semi-elliptic crack of the aspect a/c <= 1.

    Newman and Raju's K under uniform tension over the K of a straight front: an estimate, which
    takes the stress as constant along the front. J. C. Newman, I. S. Raju, NASA TM 85793 (1984).
    """

def equivalent_range(
    threshold_: tuple[float, float | None, float, float | None, list[tuple[float, float]] | None],
    K_max: Sequence[float],
    K_min: Sequence[float],
) -> list[float]:
    """Equivalent range of K at R = 0 [Pa m^0.5] of extremes of K."""

def find_material(name: str, materials: Sequence[Material]) -> Material | None:
    """
    The material of a name among some: of its key, or of another name, whatever the case.

    The case counts in a formula, and in a name that differs from one in its case alone.
    """

def find_turns(
    record: Incomplete, part: SupportsFloat | SupportsIndex, outer: SupportsFloat | SupportsIndex
) -> Incomplete:
    """
    Indices of the points where a record goes back by more than a part of its range.

    The first and the last one count if they are farther from the middle of the range than `outer`
    of its half.
    """

def goodman_stick_ratio(*, beta: float, mu: float) -> float:
    """
    Stick over contact radius of an indentation with friction, after Goodman and Spence.

    (1/(2 c)) ln[(1 + c)/(1 - c)] = (mu/abs(beta)) K(sqrt(1 - c^2)); the effect of the shear on the
    pressure is neglected.
    """

def graded(*, E: Profile, nu: Profile, thickness: Thickness, layers: int) -> list[Coating]:
    """
    Stack of equally thick layers that stands for a graded coating, outermost first.

    Each layer has the properties of its middle; the error falls with the square of their number.

    Parameters
    ----------
    E, nu : Profile
        Young's modulus [Pa] and Poisson's ratio over the depth.
    thickness : float
        Thickness of the whole coating [m], positive.
    layers : int
        Number of layers, at least 1.

    Raises
    ------
    InvalidSceneError
        If a profile, the thickness or the number of layers is out of its range.
    """

def hertz(*, R: Radius, bodies: tuple[Elastic | Body, Elastic | Body], W: PointForce) -> Hertz:
    """Hertz contact of a sphere of relative radius `R` [m] under the force `W` [N]."""

def hertz_ellipse(
    *, R_x: Radius, R_y: Radius, E_star: ContactModulus, W: PointForce
) -> HertzEllipse:
    """
    Hertz contact of relative principal radii `R_x`, `R_y` [m] along the axes.

    1/R_x is the sum of both bodies' curvatures along x; `E_star` [Pa], `W` [N].
    """

def influence_coefficients(
    body: Body, grid: Grid, *, settings: Settings | None = None
) -> NDArray[np.float64]:
    """
    Surface displacement under unit traction on one cell, C_ij [m/Pa].

    Parameters
    ----------
    body : Body
        Homogeneous or coated, taken as the lower body.
    grid : Grid
        The cells; only their number and size matter.
    settings : Settings, optional
        Its kernel settings are used.

    Returns
    -------
    array of shape (3, 3, 2 nx - 1, 2 ny - 1)
        u_x, u_y, u_z under q_x, q_y, p at all offsets of the observed cell from the loaded one. The
        offset (0, 0) is in the middle.
    """

def known_as(source: str) -> Literal["known", "estimate", "recalled"]:
    """How a number of a material is known, by its source: "known", "estimate" or "recalled"."""

def labels() -> dict[str, tuple[str, str]]:
    """Units and meaning of every variable of a result, scalars and fields."""

def largest_of_samples(
    samples: ArrayLike, z: Sequence[float], layer: Sequence[int], along: Sequence[float]
) -> tuple[float, float, float, int, float] | None:
    """
    Largest value of a field known at samples alone, shape (depths, places) along x or y.

    The value, its place along the line, depth, layer and error.
    """

def limit_threads(count: SupportsIndex) -> None:
    """
    Limit the work that the calling thread asks for to a number of threads of its own.

    Other threads of Python keep the threads of the process.
    """

def line_contact(
    *, R: Radius, bodies: tuple[Elastic | Body, Elastic | Body], W: LineForce
) -> LineContact:
    """Line contact of cylinders of relative radius `R` [m] under `W` [N/m]."""

def line_places(
    grid: Grid, *, x: float | None = None, y: float | None = None, azimuth: Angle | None = None
) -> tuple[list[float], list[tuple[float, float]]]:
    """Places along a line on a grid, and their x, y [m]."""

def line_through(
    x: float, y: float, azimuth: Angle
) -> tuple[float | None, float | None, float | None]:
    """x, y and azimuth of the line through a point at an angle; along an axis x or y alone."""

def loops(
    path: LoadPath,
    *,
    torsion: bool,
    branch: Sequence[int],
    T: Sequence[float],
    delta: Sequence[float],
    dissipated: Sequence[float],
    status: Sequence[int],
    grid: Grid,
    contact_area: Sequence[float],
    stick_ratio: Sequence[float],
    errors: Sequence[Sequence[float]],
) -> list[dict[str, float]]:
    """Energy and stiffness of every cycle of a history; use :meth:`pyfret.Result.loops`."""

def main_sections(outline: Outline) -> list[tuple[float | None, float | None, float | None]]:
    """
    x, y and azimuth of the sections in which a contact is looked at by default.

    The first along the shear; a second across it, where the contact or its shear has no axis of its
    own there.
    """

def map_from_heights(
    heights: Any,
    *,
    spacing: tuple[SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex],
    missing: Literal["refuse", "crop", "fill"],
) -> tuple[SurfaceMap, float]:
    """Build the map of measured heights less their mean; return it and its S_q [m]."""

def material_quantities() -> list[tuple[str, str, str]]:
    """Names, units and meanings of the numbers of materials."""

def materials(file: str | PathLike[str] | None = None) -> list[Material]:
    """The materials that come with the package, or the materials of a file."""

def measure(name: str, stress: ArrayLike) -> NDArray[np.float64]:
    """Give what follows from stresses of shape (6, n), by its name."""

def measured_by(key: str) -> tuple[str, str] | None:
    """Kind of the number of a key, and its unit in SI; none of a key that is unknown."""

def measures(unit: str, kind: str) -> bool:
    """Whether a unit measures a kind; a force per length is a force and a stiffness, too."""

def nearest_materials(name: str, materials: Sequence[Material], most: int = 3) -> list[str]:
    """Names of the materials nearest to an unknown name and of its kind, the nearest first."""

def notes_on_materials(
    criterion: str, body: Body, materials: Sequence[Material | None]
) -> list[str]:
    """
    Notes on the materials of a body for a criterion, before a contact is solved.

    Parameters
    ----------
    materials : list of Material or None
        Of every layer from the surface down, the substrate's last.
    """

def partial_crack(film_: Elastic, below: Elastic, depth: Length) -> float:
    """Factor F of a crack with its tip in a film; use :func:`pyfret.fracture.film_intensity`."""

def principal(stress: ArrayLike) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Principal values (n, 3), the largest first, and directions (n, 3, 3) of stresses (6, n)."""

def probe_labels() -> dict[str, tuple[str, str]]:
    """Units and meaning of everything that follows from the stress."""

def quantities() -> list[tuple[str, str, bool]]:
    """Rows of the table of quantities: name, SI unit, and whether there is a plausible range."""

def quantity_in_si(quantity: str, value: Any) -> float:
    """Number in SI of a text with a unit, or of a quantity of pint, by the row of the table."""

def range_of_life(
    sections: Sequence[CriterionBelow],
    layer: int,
    material: Material | None,
    worst: tuple[float, float],
    *,
    method: str,
    scatter: float | None = None,
    L: float | None = None,
) -> tuple[
    tuple[float, float, float],
    tuple[float, float, float],
    float,
    tuple[float, float, float] | None,
    float | None,
    list[str],
]:
    """
    The range of the margin of a layer.

    Parameters
    ----------
    sections : list of CriterionBelow
        The sections that the layer was judged in.
    worst : (float, float)
        Value of the criterion at the worst point, and its error.
    scatter, L : float, optional
        In place of the scatter of the material and of its critical distance [m].

    Returns
    -------
    tuple[Any, ...]
        Low, best, high; the same of the stress alone. Highest over lowest by the scatter of the
        material. The range of the distance, None at a point; L [m]; notes.
    """

def read_bytes(path: str | PathLike[str]) -> bytes:
    """
    The bytes of a file that somebody names.

    A pipe, a device or a file that would not fit into memory is refused before it is read.
    """

def read_text(path: str | PathLike[str]) -> str:
    """The text of a file of numbers, in UTF-8, UTF-16 or Latin-1."""

def remake(maker: Any, method: str | None = None, keywords: dict[str, Any] | None = None) -> Any:
    """
    Make a pickled object again: call its maker, or a method of it, with keywords.

    Without keywords return an attribute of the maker.
    """

def resume(
    store: str | PathLike[str],
    *,
    checkpoint: float = 5.0,
    friction_law: FrictionFunction | Literal["own"] | None = None,
    on_increment: Callable[[int, int], object] | None = None,
) -> None:
    """Go on with the run of a store that ended early; use :func:`pyfret.resume`, which opens it."""

def resume_wear(
    store: str | PathLike[str],
    own: Sequence[Sequence[Callable[..., ArrayLike]]],
    *,
    friction_law: FrictionFunction | Literal["own"] | None = None,
    on_jump: Callable[[float], None] | None = None,
) -> None:
    """Goes on with a run of wear that ended early; `own` has the functions among the laws."""

def rough(value: float) -> str:
    """A number in two digits, which is known to no more."""

def rounded_place(at: float, size: float) -> float:
    """The coordinate `at` [m], or 0 where it is rounding of `size` [m], its grid's length."""

def run_command(arguments: Sequence[str]) -> int:
    """
    Run the command ``fret`` in this process: what its console script does.

    Ctrl-C belongs to the command from here on, so that the process should end with it.

    Parameters
    ----------
    arguments : sequence of str
        The program's name and its arguments.

    Returns
    -------
    int
        Exit code: 0 done, 1 the run ended early, 2 bad scene or bad command line.
    """

def section_of_states(
    body: Body,
    states: States,
    z: Sequence[float],
    layer: Sequence[int],
    *,
    residual: Sequence[ArrayLike] | None = None,
    x: float | None = None,
    y: float | None = None,
    azimuth: Angle | None = None,
    body_number: int = 2,
) -> NDArray[np.float64]:
    """
    Stress [Pa] on a section in several states of a contact, shape (states, 6, depths, places).

    Near the surface tractions vary within the cells. States share the kernels, which cost as much
    as about ten of them.
    """

def shown(text: str) -> str:
    """A text whose control codes and marks that turn the direction of reading stand as escapes."""

def si_of(key: str, value: Any) -> float:
    """
    The number in SI of a text with a unit, or of a quantity of pint, by the key of the quantity.

    A key that is unknown is refused with the number to write.
    """

def solve(
    scene: Scene,
    *,
    store: str | PathLike[str],
    checkpoint: float = 5.0,
    overwrite: bool = False,
    error: bool | Literal["coarser"] | None = None,
    like: Scene | None = None,
    on_increment: Callable[[int, int], object] | None = None,
) -> None:
    """
    Run a scene into a new result store; use :func:`pyfret.solve`, which opens it.

    Increments are chosen like the increments of the scene `like`.

    `on_increment` is called with the number of each increment solved and their number in all,
    which is known once they are chosen.
    """

def solve_in_memory(
    scene: Scene,
    *,
    error: bool | Literal["coarser"] | None = None,
    like: Scene | None = None,
    on_increment: Callable[[int, int], object] | None = None,
) -> tuple[dict[str, Variable], str]:
    """
    Run a scene in memory; use :func:`pyfret.solve`, which labels what this one gives.

    These are the variables, each with dimensions, values and attributes as xarray takes them, and
    the attributes of the run, as JSON.
    """

def spectral_cycles(
    frequencies: ArrayLike,
    density: ArrayLike,
    distribution: str,
    amplitudes: ArrayLike,
    powers: ArrayLike,
) -> dict[str, NDArray[np.float64]]:
    """
    Cycles of a Gaussian process with a one-sided density per Hz, by "rayleigh" or "dirlik".

    `moments` are m_0, m_1, m_2 and m_4. `rates` are up-crossings, peaks and cycles per second.
    `exceedance` is the part of the cycles that exceeds each of `amplitudes`. `mean_power` is the
    mean of amplitude^k over the cycles for every k of `powers`.
    """

def stress_at(
    body: Body,
    cell: tuple[float, float],
    point: tuple[float, float, float],
    *,
    layer: int | None = None,
) -> NDArray[np.float64]:
    """
    Stress at a point under unit traction on the cell of sides `cell` [m] around the origin.

    Returns
    -------
    array of shape (6, 3)
        s_xx, s_yy, s_zz, s_xy, s_xz, s_yz under q_x, q_y, p; tension is positive.
    """

def stress_coefficients(
    body: Body, grid: Grid, z: float, *, layer: int | None = None
) -> NDArray[np.float64]:
    """
    Stress at the depth `z` [m] under unit traction on one cell, tension positive.

    Parameters
    ----------
    body : Body
        Homogeneous or coated, taken as the lower body.
    grid : Grid
        The cells; only their number and size matter.
    z : float
        Depth [m].
    layer : int, optional
        Layer from the surface down (their number for the substrate); it decides at an interface,
        where stresses jump (default: the upper one).

    Returns
    -------
    array of shape (6, 3, 2 nx - 1, 2 ny - 1)
        s_xx, s_yy, s_zz, s_xy, s_xz, s_yz under q_x, q_y, p at all offsets; the offset (0, 0) is in
        the middle.
    """

def surface_frf(body: Body, k_x: ArrayLike, k_y: ArrayLike) -> NDArray[np.complex128]:
    """Surface response at one-dimensional arrays of wave numbers; see :mod:`pyfret.kernels`."""

def table_text(
    titles: SupportsGetItem[int, str],
    rows: SupportsGetItem[int, SupportsGetItem[int, str]],
    keys: SupportsIndex,
    width: SupportsIndex,
) -> str:
    """
    A table as text, of lines of at most `width` characters.

    Columns that do not fit stand below, beside the first `keys` columns again.
    """

def threshold_at(
    threshold_: tuple[float, float | None, float, float | None, list[tuple[float, float]] | None],
    lengths: Sequence[float],
) -> tuple[list[float], float]:
    """Threshold range of K at R = 0 [Pa m^0.5] at lengths [m], and El Haddad's a_0 [m]."""

def unit_of(name: str) -> tuple[str, float] | None:
    """Kind of a unit, and its size in SI; none of a name that is no unit."""

def units(kinds: str) -> str:
    """The names of the units that measure one of some kinds, such as ``"length, force"``."""

def verify(store: str | PathLike[str]) -> str:
    """Checks a store and gives the attributes of its group as JSON."""

def verify_wear(store: str | PathLike[str]) -> None:
    """Fails if a file of the store of a run of wear is missing, or is not as it was written."""

def wear(
    scene: Scene,
    wear: dict[str, Any],
    own: Sequence[Sequence[Callable[..., ArrayLike]]],
    *,
    store: str | PathLike[str] | None = None,
    overwrite: bool = False,
    start: tuple[float, float, Sequence[NDArray[np.float64]], float] | None = None,
    on_jump: Callable[[float], None] | None = None,
) -> tuple[dict[str, Variable], str] | None:
    """
    Runs a scene over many cycles, by the table `[wear]` of a scene file.

    It writes a store, or without one gives all in memory. Laws that are functions, `{ own = true }`
    in the table, stand in `own` for each body.
    """

def wear_of_file(path: str | PathLike[str], set: Sequence[str] = ...) -> tuple[Scene, str]:
    """The scene of a file and its table `[wear]`, as the text of a scene file each."""

def with_error(value: float, error: float | None = None) -> str:
    """A number and its error, with the digits that the error leaves; an estimate without one."""

def with_range(value: float, low: float, high: float) -> str:
    """A number and the range that it lies in, with the digits that the range leaves."""

def wrap_text(text: str, width: SupportsIndex) -> str:
    """A text whose lines that are wider than `width` are wrapped."""

def yielded_columns() -> list[str]:
    """Names of the columns of the points that have yielded, in their order."""

def yielding_on(
    stress: ArrayLike,
    *,
    s_y: YieldStress,
    constant: tuple[float, float, float, float, float, float],
) -> dict[str, NDArray[np.float64]]:
    """Load factors of first yield and shakedown of stresses of shape (time, points, 6)."""

class ArgumentError(ValueError):
    """An argument of a function has no meaning. The message names it and what is allowed."""

class InvalidSceneError(ValueError):
    """A scene, or a scene file, has no meaning. The message has the place and what is allowed."""

class SolveError(RuntimeError):
    """A scene that has a meaning could not be solved; the classes below it are the reasons."""

class StoreError(OSError):
    """A file or a result store could not be read or written."""

class KernelInaccurateError(SolveError):
    """Influence or stress coefficients missed the tolerance asked for."""

class NoConvergenceError(SolveError):
    """A solver stopped before its tolerance. The message has the residual that it reached."""

class OffGridError(InvalidSceneError):
    """The contact reaches the border of the grid. The message has the width that the grid needs."""

class SlidingError(SolveError):
    """Loads that friction cannot carry, that nothing carries, or that lift a stuck contact."""

__all__ = [
    "CELLS_PER_FILM",
    "DEPTH_ROUNDING",
    "LONGEST_LIFE",
    "RATCHETS",
    "RIGID",
    "SHAKEN",
    "STRAIN_AT_A_RIM",
    "TOO_FEW_INCREMENTS",
    "ArgumentError",
    "Assessment",
    "Body",
    "Bond",
    "Branch",
    "CattaneoMindlin",
    "CheckedStore",
    "CoatedIndentation",
    "Coating",
    "Cone",
    "ContactForCracks",
    "Conversion",
    "CoupledIndentation",
    "Crack",
    "Criterion",
    "CriterionBelow",
    "CrownedRoller",
    "CycleSection",
    "Cylinder",
    "EigenstrainOperator",
    "Eigenstress",
    "Elastic",
    "Ellipsoid",
    "Envelope",
    "Flat",
    "FlatPunch",
    "Friction",
    "Grid",
    "Hertz",
    "HertzEllipse",
    "HertzStress",
    "History",
    "InvalidSceneError",
    "KernelInaccurateError",
    "LineContact",
    "LoadPath",
    "Lubkin",
    "March",
    "Material",
    "NoConvergenceError",
    "OffGridError",
    "Outline",
    "PerRange",
    "Plastic",
    "PlasticBody",
    "Profile",
    "Ridges",
    "Ring",
    "Rough",
    "Scene",
    "SlidingError",
    "SolveError",
    "Spacing",
    "Sphere",
    "Springs",
    "States",
    "StoreError",
    "StressCache",
    "Subsurface",
    "Sum",
    "SurfaceMap",
    "SurfaceOperator",
    "Waviness",
    "Wedge",
    "YieldBelow",
    "__version__",
    "arrest",
    "channel_crack",
    "check_settings",
    "check_sides",
    "chosen_depths",
    "coated_indentation",
    "continued_pressure",
    "count_work",
    "coupled_indentation",
    "crack_life",
    "criteria",
    "criterion_on",
    "cycle_sections",
    "cycle_temperature",
    "damage_of_values",
    "damage_on",
    "dang_van_path",
    "degrees",
    "depths",
    "doubt",
    "doubt_quantity",
    "dundurs_beta",
    "ellipse_factor",
    "equivalent_range",
    "find_material",
    "find_turns",
    "goodman_stick_ratio",
    "graded",
    "hertz",
    "hertz_ellipse",
    "influence_coefficients",
    "known_as",
    "labels",
    "largest_of_samples",
    "limit_threads",
    "line_contact",
    "line_places",
    "line_through",
    "loops",
    "main_sections",
    "map_from_heights",
    "material_quantities",
    "materials",
    "measure",
    "measured_by",
    "measures",
    "nearest_materials",
    "notes_on_materials",
    "partial_crack",
    "principal",
    "probe_labels",
    "quantities",
    "quantity_in_si",
    "range_of_life",
    "read_bytes",
    "read_text",
    "remake",
    "resume",
    "resume_wear",
    "rough",
    "rounded_place",
    "run_command",
    "section_of_states",
    "shown",
    "si_of",
    "solve",
    "solve_in_memory",
    "spectral_cycles",
    "stress_at",
    "stress_coefficients",
    "surface_frf",
    "table_text",
    "threshold_at",
    "unit_of",
    "units",
    "verify",
    "verify_wear",
    "wear",
    "wear_of_file",
    "with_error",
    "with_range",
    "wrap_text",
    "yielded_columns",
    "yielding_on",
]
