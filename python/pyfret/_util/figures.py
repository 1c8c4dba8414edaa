"""The figures of one thing as methods: ``worn.plot.wear_history()``.

Which figures a thing has follows from the figures: their first argument names its type. They are
loaded when they are drawn, by a function that the package enters here. So figures depend on
results, and results do not depend on figures.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from pyfret._util.attributes import attribute_error

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    class Owner(Protocol):
        """What has figures; its class names the one that shows the whole."""

        figure: ClassVar[str]

        def _draw(self, *args: Any, **options: Any) -> Any:
            """Draw the figure of this object with the options of its plot function."""
            ...


__all__ = ["Figured", "Figures", "figures_of", "register_figures"]

#: Functions that load the module of the figures: one, once the package is imported.
LOADERS: list[Callable[[], ModuleType]] = []


def register_figures(load: Callable[[], ModuleType]) -> None:
    """Enter the function that loads the module of the figures."""
    LOADERS[:] = [load]


def load_figures() -> ModuleType:
    """Load the module of the figures."""
    return LOADERS[0]()


def first_types(function: Callable[..., Any]) -> set[str]:
    """The types of the first argument of a function, as they are written."""
    written = next(iter(getattr(function, "__annotations__", {}).values()), "")
    return {part.strip() for part in str(written).split("|")}


def figures_of(kind: type) -> list[str]:
    """Return the names of the figures that draw an object of a class with the attribute ``figure``.

    A figure draws a class if its first argument is annotated with that class or with one of its
    bases. For a class that only fits a protocol, the annotation of the figure named by the
    attribute counts too.
    """
    plot = load_figures()
    whole = next(iter(getattr(plot, kind.figure).__annotations__.values()))  # type: ignore[attr-defined]
    names = {of.__name__ for of in kind.__mro__} | {str(whole).split("|")[0].strip()}
    # A figure of an application is imported at its first use, and is of no class.
    loaded = {name: vars(plot)[name] for name in plot.__all__ if name in vars(plot)}
    return [name for name, figure in loaded.items() if names & first_types(figure)]


class Figures:
    """The figures of :mod:`pyfret.plot` of one thing, such as ``result.plot.fretting_loop()``.

    Called itself, the one that shows the whole: ``result.plot()``.
    """

    def __init__(self, shown: Owner) -> None:
        self._shown = shown

    def __call__(self, *args: Any, **options: Any) -> Any:
        """Draw the figure that shows the whole; `options` are passed to it."""
        return self._shown._draw(*args, **options)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        """Give the figure of that name, drawn of the thing."""
        if name.startswith("_"):
            raise AttributeError(name)
        plot = load_figures()
        if name not in plot.__all__:
            raise attribute_error("plot", name, dir(self), {})
        return partial(getattr(plot, name), self._shown)

    def __dir__(self) -> list[str]:
        """The figures of such a thing."""
        return figures_of(type(self._shown))

    def __repr__(self) -> str:
        """Give the names of the figures."""
        return f"figures of {self._shown!r}: {', '.join(dir(self))}"


class Figured:
    """What has figures, of which its class names the one that shows the whole."""

    figure: ClassVar[str]

    @property
    def plot(self) -> Figures:
        """Its figures: ``plot()`` shows the whole, ``plot.NAME()`` is another of `pyfret.plot`."""
        return Figures(self)

    def _draw(self, *args: Any, **options: Any) -> Any:
        """Draw the figure that shows the whole."""
        return getattr(load_figures(), type(self).figure)(self, *args, **options)
