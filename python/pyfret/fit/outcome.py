"""The unknowns that a fit has found, their confidence, and what the data cannot determine."""

from __future__ import annotations

import json
from dataclasses import dataclass
from itertools import combinations
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import with_error
from pyfret._util.attributes import missing_attribute
from pyfret._util.holds_arrays import HoldsArrays
from pyfret._util.keywords import nearest_names, refuse_unknown
from pyfret._util.lazy import xr
from pyfret._util.packed import packed
from pyfret._util.window import format_table, wrap
from pyfret.fit.data import Loops
from pyfret.saveable import Saveable

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pyfret._core import Scene
    from pyfret.fit.data import Measured
    from pyfret.plot.style import Drawn

__all__ = ["FitResult", "Known", "Posterior"]

#: Correlation from which two unknowns count as indistinguishable.
ALIKE = 0.97
#: Factor between the ends of an interval from which an unknown counts as not resolved.
UNRESOLVED = 4.0
#: Share of the error of the solver from which its cause is named.
MOST_OF_ERROR = 0.5
#: Error of the model of the posterior over the noise from which it is reported.
ROUGH = 0.3
#: Residual over the given noise from which the model is doubted.
EXCESS = 1.5
#: Residual of loops over the range of their force from which a rig in series is suggested.
UNEXPLAINED = 0.03
#: Correlation of neighbouring residuals from which they count as a pattern.
PATTERN = 0.5


@dataclass(frozen=True, eq=False)
class Posterior(HoldsArrays):
    """Samples of the unknowns, given the data.

    Attributes
    ----------
    samples : dict of str to array
        Values by the keys of the unknowns; the n-th of all belong together.
    error : float
        What the quadratic model of the contact errs by (root mean square, at three solves), over
        the noise.
    solves : int
        Contacts solved for it.
    """

    samples: dict[str, NDArray[np.float64]]
    error: float
    solves: int

    def interval(self, key: str, part: float = 0.95) -> tuple[float, float]:
        """The values between which that part of the samples lies, as many below as above."""
        low, high = np.quantile(self.samples[key], [0.5 * (1 - part), 0.5 * (1 + part)])
        return float(low), float(high)

    def __repr__(self) -> str:
        """Tell the medians and the 95 % intervals."""
        intervals = []
        for key, values in self.samples.items():
            low, high = self.interval(key)
            intervals.append(f"{key} = {np.median(values):.4g} [{low:.4g}, {high:.4g}]")
        return f"Posterior({', '.join(intervals)}; model errs by {self.error:.2g} of the noise)"


def neighbour_correlation(residual: NDArray[np.float64]) -> float:
    """Return the correlation of neighbouring residuals; 0 of fewer than ten."""
    centred = residual - residual.mean()
    square = float(centred @ centred)
    if residual.size < 10 or square == 0:
        return 0.0
    return float(centred[1:] @ centred[:-1]) / square


@dataclass(frozen=True)
class Known:
    """An unknown that is known now.

    Attributes
    ----------
    value, low, high : float
        Best value, and the ends of its 95 % confidence interval.
    noise, solver : float
        Parts of the half-width: scatter of the data, and the error of cells and increments.
    at_bound : bool
        Whether the best value lies at the end of what was allowed.
    """

    value: float
    low: float
    high: float
    noise: float
    solver: float
    at_bound: bool

    @property
    def is_resolved(self) -> bool:
        """Whether its ends lie within a factor of 4 and on one side of zero."""
        if self.at_bound:
            return True
        across_zero = self.low <= 0 < self.value
        return not (across_zero or self.high > UNRESOLVED * max(self.low, 1e-300) > 0)


#: Where others look for the interval of an unknown.
INTERVAL = dict.fromkeys(
    ("error", "uncertainty", "stderr", "std", "sigma", "interval", "confidence", "ci"),
    "its 95 % confidence is from .low to .high; .noise and .solver are parts of half its width",
)


def refuse_attribute(self: Any, name: str) -> Any:
    """Refuse a name that an unknown does not have, with the nearest one."""
    missing_attribute(self, name, INTERVAL)


if not TYPE_CHECKING:
    # A method within the class would let type checkers take any name.
    Known.__getattr__ = refuse_attribute


@dataclass(frozen=True, eq=False)
class FitResult(Saveable, HoldsArrays):
    """The unknowns of a scene, determined from data.

    Attributes
    ----------
    known : dict of str to Known
        Values with 95 % confidence by the keys of the unknowns.
    offsets : dict of str to float
        Zeros and drifts of the gauges, springs beside the contact. The offset of the shift is what
        the gauge shows in the middle of the contact's own motion.
    offset_errors : dict of str to float
        Half-widths of their 95 % confidence.
    correlation : array
        Correlation of the unknowns, in their order.
    residual, computed : list of array
        Measured less computed, and what is computed, of each set of data.
    sets : list
        What was measured, as it is drawn.
    noise : list of float
        Root mean square of the residuals.
    solves : int
        Contacts solved.
    solver_known : bool
        Whether a solve on cells twice as wide and one with half of the increments gave the error of
        the solver. Else the confidence does not contain it.
    converged : bool
        Whether the search ended by itself.
    scene : Scene
        The scene with the values found.
    posterior : Posterior, optional
        Samples of the unknowns, where they were asked for.
    left_out : tuple of str
        Offsets of loops, "tilt" or "drift", that are fitted by default and were left out here.
    turns_share : float
        Largest part that uncertain turns of loops have in the solver's error of an unknown, 0 to 1.
    """

    known: dict[str, Known]
    offsets: dict[str, float]
    offset_errors: dict[str, float]
    correlation: NDArray[np.float64]
    residual: list[NDArray[np.float64]]
    computed: list[NDArray[np.float64]]
    sets: list[Measured]
    noise: list[float]
    solves: int
    solver_known: bool
    converged: bool
    scene: Scene
    posterior: Posterior | None = None
    left_out: tuple[str, ...] = ()
    turns_share: float = 0.0

    def __getitem__(self, key: str) -> float:
        """The value of an unknown."""
        if key not in self.known:
            near = nearest_names(str(key), self.known, 1)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise KeyError(f"no unknown {key!r:.60}: there is {', '.join(self.known)}{hint}")
        return self.known[key].value

    @property
    def is_resolved(self) -> bool:
        """Whether the data distinguish all unknowns and bound them."""
        if len(self.known) > 1:
            beside = np.abs(self.correlation - np.eye(len(self.known)))
            if float(beside.max()) > ALIKE:
                return False
        return all(unknown.is_resolved for unknown in self.known.values())

    @property
    def dataset(self) -> xr.Dataset:
        """Return best values and 95 % confidence over ``unknown``, and what is saved."""
        arrays: dict[str, NDArray[Any]] = {}
        tree = json.dumps(packed(self, arrays))
        unknown_columns = {
            name: ("unknown", [float(getattr(item, name)) for item in self.known.values()])
            for name in ("value", "low", "high")
        }
        parts = {
            name: (tuple(f"{name}_{n}" for n in range(array.ndim)), array)
            for name, array in arrays.items()
        }
        return xr.Dataset(
            {**unknown_columns, **parts},
            coords={"unknown": np.array(list(self.known), dtype=str)},
            attrs={"title": "fit", "found": tree},
        )

    def __dir__(self) -> list[str]:
        """The names of the class; the values are `found[key]`."""
        return sorted(object.__dir__(self))

    @property
    def values(self) -> dict[str, float]:
        """Return the best values by the names of the unknowns."""
        return {key: unknown.value for key, unknown in self.known.items()}

    def plot(self, *, ax: Axes | None = None, data: int = 0, **options: Any) -> Drawn:
        """Draw what was measured, and what the values found make of it."""
        refuse_unknown("FitResult.plot", options, ["ax", "data"])
        from pyfret.fit.figures import curves

        return curves(self.sets[data], self.computed[data], self.values, ax)

    def plot_residuals(self, *, data: int = 0, ax: Axes | None = None) -> Drawn:
        """Draw measured less computed; it should scatter about zero without a pattern."""
        from pyfret.fit.figures import residuals

        return residuals(self.sets[data], self.residual[data], ax)

    @property
    def doubts(self) -> list[str]:
        """List what these data cannot determine, a sentence each."""
        sentences = []
        keys = list(self.known)
        for (i, key_i), (j, key_j) in combinations(enumerate(keys), 2):
            r = float(self.correlation[i, j])
            if abs(r) > ALIKE:
                sentences.append(
                    f"{key_i} and {key_j} cannot be distinguished by these data "
                    f"(correlation {r:+.3f}): "
                    "fix one of them, or measure what changes only one"
                )
        for key, unknown in self.known.items():
            if unknown.at_bound:
                sentences.append(f"{key} ended at a bound of its range: widen it, or fix {key}")
            elif not unknown.is_resolved:
                sentences.append(
                    f"{key} is not resolved by these data: {unknown.low:.3g} to {unknown.high:.3g}"
                )
        if not self.is_resolved and (offsets := self._default_offsets()):
            sentences.append(
                f"{' and '.join(offsets)} of the loops are unknown as well; with "
                f"read_loops(..., {', '.join(f'{name}=False' for name in offsets)}) they are not"
            )
        for name in self.left_out:
            meaning = {"tilt": "a spring beside the contact", "drift": "a drift of the gauges"}[
                name
            ]
            sentences.append(
                f"{meaning} was left out, since these data cannot distinguish it from the "
                f"unknowns; {name}=True fits it"
            )
        if not self.solver_known:
            sentences.append(
                "cells twice as wide, or half of the increments, could not be solved: what they "
                "leave is not in the confidence; give more cells"
            )
        if self.turns_share > MOST_OF_ERROR and any(
            unknown.solver > unknown.noise for unknown in self.known.values()
        ):
            sentences.append(
                f"{self.turns_share:.0%} of the error of the solver is the place of the turns, "
                "which the points beside them leave open. Sample the ends of the stroke more often"
            )
        if self.posterior is not None and self.posterior.error > ROUGH:
            sentences.append(
                "the posterior uses a quadratic model of the contact with an error of "
                f"{self.posterior.error:.2g} of the noise: the confidence by profiles is better"
            )
        if not self.converged:
            sentences.append(f"the search did not settle in {self.solves} solves")
        for n, measured in enumerate(self.sets):
            noise = measured.data.noise
            if noise is not None and self.noise[n] > EXCESS * noise:
                sentences.append(
                    f"the residual of {measured.labels[1]}, {self.noise[n]:.3g}, is "
                    f"{self.noise[n] / noise:.1f} times the given noise: the model has another "
                    "shape, and its error may exceed the confidence"
                )
            alike = neighbour_correlation(self.residual[n])
            if isinstance(measured.data, Loops) and alike > PATTERN:
                sentences.append(
                    f"the residual of {measured.labels[1]} is no scatter: neighbours have a "
                    f"correlation of {alike:.2f}. The loop has another shape than the model, which "
                    "the confidence does not contain"
                )
            if isinstance(measured.data, Loops):
                sentences += self._doubts_of_loops(measured.data, self.noise[n])
        return sentences

    def _default_offsets(self) -> list[str]:
        """Return the offsets of the loops, tilt and drift, that are fitted by default."""
        loops = [measured.data for measured in self.sets if isinstance(measured.data, Loops)]
        fitted = " ".join(self.offsets)
        tilts = "spring" in fitted and any(data.tilt is None for data in loops)
        drifts = "drift" in fitted and any(data.drifts is None for data in loops)
        return [name for name, is_so in (("tilt", tilts), ("drift", drifts)) if is_so]

    def _doubts_of_loops(self, data: Loops, noise: float) -> list[str]:
        """Describe features of loops that the contact does not explain."""
        sentences = []
        part = noise / max(float(np.ptp(data.T)), 1e-300)
        has_rig = "rig.stiffness" in self.known or self.scene.path.rig_stiffness is not None
        if not has_rig and part > UNEXPLAINED:
            sentences.append(
                f"the residual is {part:.0%} of the force, and the loop has no rig in series: add "
                'its stiffness to the unknowns, "rig.stiffness": (1e6, 1e9) in N/m'
            )
        drift = data.drift
        if data.drifts is False and abs(drift[1]) > 2 * noise:
            sentences.append(
                f"the middle of the loops drifts by {drift[0]:.2g} m and {drift[1]:.2g} N from the "
                "first to the last: fit it by drift=True"
            )
        slope = data.sliding_slope
        if slope is not None and abs(slope) * float(np.ptp(data.delta)) > 2 * noise:
            cause = (
                "an unknown spring beside the contact would explain it, tilt=True"
                if data.tilt is False
                else "it is taken for a spring beside the contact; friction that grows with the "
                "shift looks alike"
            )
            sentences.append(f"the sliding branches rise by {slope:.2g} N/m: {cause}")
        return sentences

    def summary(self) -> str:
        """Return values, confidence, offsets and doubts as text."""
        rows = [
            (
                key,
                f"{k.value:.5g}",
                f"{k.low:.4g} to {k.high:.4g}",
                f"{k.noise:.2g}",
                f"{k.solver:.2g}",
            )
            for key, k in self.known.items()
        ]
        titles = ["unknown", "value", "95 % confidence", "error\nof noise", "error\nof solver"]
        lines = [format_table(titles, rows)]
        if self.posterior is not None:
            for key in self.known:
                low, high = self.posterior.interval(key)
                lines.append(f"{key}: 95 % of the posterior from {low:.4g} to {high:.4g}")
        lines += [
            f"{name}: {with_error(value, self.offset_errors[name])}"
            for name, value in self.offsets.items()
        ]
        for measured_set, noise in zip(self.sets, self.noise, strict=True):
            part = (
                noise / float(np.ptp(measured_set.measured))
                if np.ptp(measured_set.measured)
                else 0.0
            )
            lines.append(
                f"residual of {measured_set.labels[1]}: {noise:.3g}, {part:.1%} of its range"
            )
        lines.append(f"{self.solves} solves")
        return wrap("\n".join(lines + self.doubts))

    def __repr__(self) -> str:
        """Tell the values."""
        values = ", ".join(
            f"{key} = {k.value:.4g} [{k.low:.4g}, {k.high:.4g}]" for key, k in self.known.items()
        )
        return f"FitResult({values}; {self.solves} solves)"
