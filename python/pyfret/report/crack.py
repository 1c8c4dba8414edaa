"""A crack on the page of a result: its way in the section, K over the cycle, the diagram."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._util.numbers import in_letters, in_words, um
from pyfret.report.digits import short

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from pyfret.fracture.arrest import CrackArrest
    from pyfret.fracture.growth import Cracks, Threshold
    from pyfret.subsurface.line import Line

__all__ = ["CrackSection"]

MICRO, MEGA = 1e6, 1e-6


@dataclass(frozen=True)
class CrackSection:
    """Cracks of several lengths, and the threshold below which they stop, if it is known."""

    cracks: Cracks
    threshold: Threshold | None

    @property
    def about(self) -> dict[str, Any]:
        """Describe the position of the crack."""
        return self.cracks.dataset.attrs

    def found(self) -> CrackArrest | None:
        """Whether it stops."""
        return None if self.threshold is None else self.cracks.arrest(self.threshold)

    @property
    def line(self) -> Line:
        """The line on the surface in whose plane it lies."""
        return self.cracks.line

    def verdict(self) -> str:
        """Describe the arrest of the crack in a sentence."""
        about, arrest = self.about, self.found()
        body = "upper" if about["body_number"] == 1 else "lower"
        begun = f"The crack from x = {um(about['x'])} of the {body} body"
        if arrest is None:
            first, last = (um(float(self.cracks.lengths[n])) for n in (0, -1))
            return in_letters(f"{begun}, {first} to {last} long.")
        return in_letters(f"{begun} {arrest.describe()}.")

    def drawn(
        self, deepest: float, place: Callable[[NDArray[np.float64]], list[float]]
    ) -> dict[str, Any]:
        """Return the path of the crack [um] up to arrest, and beyond, for a figure of depths."""
        d, arrest = self.cracks.dataset, self.found()
        s = np.concatenate([[0.0], self.cracks.lengths])
        x = MICRO * self.cracks.places(np.concatenate([[self.about["x"]], d.x.values]))
        z = MICRO * np.concatenate([[0.0], d.z.values])
        stop = s[-1] if arrest is None else arrest.tip

        def way(of: NDArray[np.float64]) -> dict[str, Any]:
            """Return the coordinates of a part of the path."""
            depth = np.interp(of, s, z)
            inside = depth <= deepest
            return {"x": short(np.interp(of, s, x)[inside]), "z": short(place(depth[inside]))}

        return {
            "grown": way(np.append(s[s < stop], stop)),
            "rest": way(np.insert(s[s > stop], 0, stop)),
            "end": None if arrest is None or arrest.verdict == "grows" else way(np.array([stop])),
            "briefly": None if arrest is None else in_letters(arrest.briefly()),
        }

    def numbers(self) -> dict[str, Any]:
        """Return verdict, K over the cycle at the arrest (or longest) length, and diagram."""
        arrest = self.found()
        length = arrest.tip if arrest else float(self.cracks.lengths[-1])
        at_length = self.cracks.at_length(length)
        names = ("K_I", "K_II", "K_I_error", "K_II_error")
        K = {name: short(MEGA * at_length[name].values) for name in names}
        return {
            "says": self.verdict(),
            "length": in_words(MICRO * float(at_length.length), 3),
            "increment": at_length.increment.values.astype(int).tolist(),
            **K,
            "kitagawa": None if self.threshold is None else self._diagram(self.threshold),
        }

    def _diagram(self, threshold: Threshold) -> dict[str, Any]:
        """Return the Kitagawa diagram [um, MPa]; loads that open nothing are left out."""
        d = self.cracks.kitagawa(threshold)
        load = np.where(d["load"].values > 0.0, d["load"].values, np.nan)
        smooth = None if threshold.dS_0 is None else MEGA * threshold.dS_0
        return {
            "length": short(MICRO * self.cracks.lengths),
            "load": short(MEGA * load),
            "limit": short(MEGA * d["limit"].values),
            "smooth": smooth,
        }
