"""Tables of pandas whose columns are found by their names, with or without their units."""

from __future__ import annotations

from typing import Any

import pandas as pd

from pyfret._util.keywords import nearest_names
from pyfret._util.window import window_width, wrap

__all__ = ["Frame"]

#: Most rows that are printed, characters of a column, and names of columns that do not fit.
MOST_ROWS, MOST_CHARACTERS, MOST_NAMES = 60, 40, 30


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

    def __repr__(self) -> str:
        """Give the first columns that fit into the window, and the names of the others."""
        count, text = len(self.columns), str(super().__repr__())
        if count < 2 or (max(map(len, text.splitlines())) <= window_width() and "..." not in text):
            return text
        shown, fits = 0, ""
        for n in range(1, count + 1):
            part = pd.DataFrame(self.iloc[:, :n])
            part = part.to_string(
                max_rows=MOST_ROWS,
                max_colwidth=MOST_CHARACTERS,
                float_format="{:.6g}".format,
                na_rep="-",
            )
            if n > 1 and max(map(len, part.splitlines())) > window_width():
                break
            shown, fits = n, part
        names = ", ".join(map(str, self.columns[shown : shown + MOST_NAMES]))
        names += ", ..." if count > shown + MOST_NAMES else ""
        return f"{fits}\n{wrap(f'{count - shown} more columns: {names}')}" if names else fits

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
