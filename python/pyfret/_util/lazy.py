"""Xarray, imported when a dataset is first made: `import pyfret` is twice as fast without it."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

__all__ = ["xr"]

if TYPE_CHECKING:
    import xarray as xr
else:

    class Lazy:
        """A module that is imported when something of it is asked for."""

        def __init__(self, name: str) -> None:
            self._name = name

        def __getattr__(self, name: str) -> Any:
            """Give what the module has under that name."""
            return getattr(import_module(self._name), name)

    xr = Lazy("xarray")
