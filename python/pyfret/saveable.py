"""Results that are saved: as a file, a table, a page, a view in a notebook."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from pyfret._util import files
from pyfret._util.csv_table import Tabular
from pyfret._util.text import html
from pyfret.quantities import quantities

if TYPE_CHECKING:
    import os
    from collections.abc import Callable

    import xarray as xr

    class HasDataset(Protocol):
        """A result with a dataset, a summary and a figure."""

        @property
        def dataset(self) -> xr.Dataset:
            """Variables with units and meaning."""

        def summary(self) -> str:
            """Describe the result."""

        @property
        def plot(self) -> Callable[..., Any]:
            """Draw the result."""

        def _as_saved(self) -> xr.Dataset: ...

        def _title(self) -> str: ...

        def _repr_html_(self) -> str: ...
else:
    HasDataset = object

__all__ = ["Saveable"]

#: The page, with its title, the view for notebooks, the figure and the summary.
PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>{title}</title>
<style>body{{font-family:sans-serif;margin:2em}}td,th{{padding:.3em .8em;text-align:left;
border-bottom:1px solid #ddd}}img{{max-width:100%}}pre{{overflow:auto}}</style>
<h1>{title}</h1>{view}<p><img alt="the figure of what was found"
src="data:image/svg+xml;base64,{figure}"></p>
<pre>{summary}</pre></html>
"""


class Saveable(Tabular):
    """A result with a dataset, a summary and a figure, which can be saved."""

    #: Axes of the rows of :meth:`to_dataframe` (default: the axes of the first variable).
    table_axes: ClassVar[tuple[str, ...] | None] = None

    def _as_saved(self: HasDataset) -> xr.Dataset:
        """Return the dataset of the file."""
        return self.dataset.load().drop_encoding()

    @quantities
    def save(self: HasDataset, path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
        """Write it to a Zarr folder (``.zarr``) or a NetCDF file (``.nc``); `pyfret.open` opens it.

        Parameters
        ----------
        path : path
            Where to write; its ending gives the format.
        overwrite : bool
            Whether what pyfret saved there is replaced (default: the place must be free).

        Raises
        ------
        FileExistsError
            There is something at the place.
        ValueError
            The ending is another.
        """
        dataset = self._as_saved()
        # Wear and the stores of studies have other attributes for their kind.
        if not {"wear", "kind"} & set(dataset.attrs):
            dataset = dataset.assign_attrs(kind=type(self).__name__)
        files.write(dataset, path, overwrite=overwrite)

    @quantities
    def report(self: HasDataset, path: str | os.PathLike[str], **options: Any) -> None:
        """Write one page for a browser: the numbers, the figure and the summary in one file.

        A page that is there is replaced. `options` are the options of the figure, as of ``plot``.
        """
        drawn = io.BytesIO()
        figure = self.plot(**options)
        getattr(figure, "figure", figure).savefig(drawn, format="svg", bbox_inches="tight")
        page = PAGE.format(
            title=html(self._title()),
            view=self._repr_html_(),
            figure=base64.b64encode(drawn.getvalue()).decode(),
            summary=html(self.summary()),
        )
        Path(path).write_text(page, encoding="utf-8")

    def _title(self: HasDataset) -> str:
        return str(self.dataset.attrs.get("title") or type(self).__name__)

    def _repr_html_(self: HasDataset) -> str:
        """The summary, for notebooks."""
        return f"<pre>{html(self.summary())}</pre>"
