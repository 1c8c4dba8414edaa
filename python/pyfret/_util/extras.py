"""Libraries that only some functions need."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ["needed"]


def needed(module: str, extra: str) -> Any:
    """Import a library, or name the extra of the package that brings it."""
    try:
        return import_module(module)
    except ModuleNotFoundError as absent:
        library = module.partition(".")[0]
        message = f'{extra} needs {library}: pip install "fretting[{extra}]"'
        raise ModuleNotFoundError(message, name=library) from absent
