"""Attributes of a result and of each of its snapshots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret._core import Scene
from pyfret._util.labelled import Labelled

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["OfRun"]


class OfRun(Labelled):
    """A dataset whose attributes identify its run."""

    _item_hint = "; result.at(-1) is the last increment that kept its fields"

    def __init__(
        self,
        dataset: xr.Dataset,
        scene: Scene | None = None,
        shared: dict[str, Any] | None = None,
    ) -> None:
        super().__init__(dataset)
        self._scene = scene
        self._shared: dict[str, Any] = {} if shared is None else shared

    def __getstate__(self) -> dict[str, Any]:
        """Return the state to pickle or copy, without what was computed from the dataset."""
        return {**self.__dict__, "_shared": {}}

    @property
    def shared(self) -> dict[str, Any]:
        """Numbers that several questions share, by their kind; copies and files leave them out.

        A run and its states have the same ones.
        """
        return self._shared

    @property
    def dataset(self) -> xr.Dataset:
        """Variables with units and meaning, and the attributes of the run."""
        return super().dataset

    @property
    def scene(self) -> Scene:
        """Return the scene that was solved."""
        if self._scene is None:
            self._scene = Scene.from_toml(self.dataset.attrs["scene"])
        return self._scene

    @property
    def a_H(self) -> float:
        """Hertz radius of the uncoated pair at the largest load [m]."""
        return self._yardstick("a_H")

    @property
    def p_H(self) -> float:
        """Hertz peak pressure of the uncoated pair at the largest load [Pa]."""
        return self._yardstick("p_H")

    @property
    def mu(self) -> float:
        """Friction coefficient; infinite for a contact that never slips."""
        mu = self.dataset.attrs["mu"]
        return np.inf if mu is None or mu == "stick" else float(mu)

    @property
    def doubts(self) -> list[str]:
        """Numbers of the scene and of the run that are hardly meant or known, one sentence each.

        Doubts of the scene (:meth:`Scene.doubts`) come first, then doubts of the solution.
        Examples are few cells across the contact, a contact that is wide for a body, a pressure
        above the yield stress of metals.
        """
        return str(self.dataset.attrs.get("doubts", "")).splitlines()

    def _yardstick(self, name: str) -> float:
        """Return a number of the Hertz contact; a ValueError if there is none."""
        if name not in self.dataset.attrs:
            raise ValueError(
                f"no {name}: these bodies have no Hertz contact (a flat, a punch, a rough surface, "
                "or nothing presses); lengths are measured by .length, stresses in Pa"
            )
        return float(self.dataset.attrs[name])
