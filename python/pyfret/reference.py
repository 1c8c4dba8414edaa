"""Closed forms: the truths that the numerical solution is measured against."""

from pyfret._core import Hertz, hertz

__all__ = ["Hertz", "hertz"]
