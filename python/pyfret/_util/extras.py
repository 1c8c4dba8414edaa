"""Libraries that only some functions need, and applications in a distribution of their own."""

from __future__ import annotations

from importlib import import_module
from typing import Any

__all__ = ["application", "needed"]


def needed(module: str, extra: str) -> Any:
    """Import a library, or name the extra of the package that brings it."""
    try:
        return import_module(module)
    except ModuleNotFoundError as absent:
        library = module.partition(".")[0]
        message = f'{extra} needs {library}: pip install "fretting[{extra}]"'
        raise ModuleNotFoundError(message, name=library) from absent


def application(module: str) -> Any:
    """Import a module of the distribution ``fretting-apps``, or name that distribution."""
    try:
        return import_module(module)
    except ModuleNotFoundError as absent:
        if not f"{module}.".startswith(f"{absent.name}."):
            raise
        message = f"{module} is an application: pip install fretting-apps"
        raise ModuleNotFoundError(message, name=module) from absent
