"""Tables of pandas whose columns are found by their names, with or without their units."""

from __future__ import annotations

from typing import Any

import pandas as pd

from pyfret._util.keywords import nearest_names

__all__ = ["Frame"]


class Frame(pd.DataFrame):  # type: ignore[misc]
    """A table with units in the heads: ``frame["T_x"]`` is the column ``T_x [N]``."""

    @property
    def _constructor(self) -> type[Frame]:
        """The class of parts of the table."""
        return Frame

    def __getitem__(self, key: Any) -> Any:
        """Return columns by their heads or by their names without units; rows by a mask."""
        if isinstance(key, str):
            return super().__getitem__(self._head(key))
        if isinstance(key, list):
            return super().__getitem__([self._head(k) if isinstance(k, str) else k for k in key])
        return super().__getitem__(key)

    def __getattr__(self, name: str) -> Any:
        """Return a column by its name without a unit."""
        if not name.startswith("_") and name in self._names():
            return self[name]
        return super().__getattr__(name)

    def _names(self) -> dict[str, str]:
        """Return the heads by their names without units."""
        heads = [head for head in self.columns if isinstance(head, str)]
        return {head.split(" [")[0]: head for head in reversed(heads)}

    def _head(self, name: str) -> str:
        """Return the head of a name.

        Raises
        ------
        KeyError
            There is no such column; the message has the nearest ones.
        """
        if name in self.columns:
            return name
        names = self._names()
        if name not in names:
            near = ", ".join(nearest_names(name, names, 3) or names)
            raise KeyError(f"no column {name!r:.60}; there is {near}")
        return names[name]
