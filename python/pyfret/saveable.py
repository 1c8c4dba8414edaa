"""Results that are saved: as a file, a table, a page, a view in a notebook."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from pyfret._util import files
from pyfret._util.csv_table import Tabular
from pyfret._util.page import svg_image, write_page
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
        title, summary = self._title(), html(self.summary())
        shown = svg_image(drawn.getvalue(), f"figure of {title}; its numbers stand on this page")
        view = self._repr_html_()
        text = "" if view == f"<pre>{summary}</pre>" else f'<pre tabindex="0">{summary}</pre>'
        write_page(Path(path), title, f"{view}\n{shown}\n{text}")

    def _title(self: HasDataset) -> str:
        return str(self.dataset.attrs.get("title") or type(self).__name__)

    def _repr_html_(self: HasDataset) -> str:
        """The summary, for notebooks."""
        return f"<pre>{html(self.summary())}</pre>"
