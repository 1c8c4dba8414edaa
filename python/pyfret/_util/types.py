"""Types that the compiled module and Python share."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["FrictionFunction", "Variable"]

_Cells: TypeAlias = NDArray[np.float64]
#: A friction law of x, y, p, slip and dissipated energy: arrays with a number for each cell.
#: It may take fields of the exposed surfaces by keyword.
FrictionFunction: TypeAlias = Callable[..., ArrayLike]
#: A variable of a result: its dimensions, values and attributes.
Variable: TypeAlias = tuple[tuple[str, ...], NDArray[Any], dict[str, Any]]
