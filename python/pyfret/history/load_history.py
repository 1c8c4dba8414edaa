"""A load history: measured channels, counted loops, or a spectrum."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret._util.arrays import number, plain
from pyfret._util.figures import Figured
from pyfret._util.holds_arrays import HoldsArrays
from pyfret._util.numbers import format_number
from pyfret._util.window import wrap
from pyfret.history.channels import (
    CHANNELS,
    Channel,
    channel_unit,
    check_channel,
    counted_channel,
    read_channels,
)
from pyfret.history.counting import Residue, rearranged, turning_points
from pyfret.history.loops import CountedLoops
from pyfret.history.spectrum import Distribution, Spectrum, SpectrumValues
from pyfret.quantities import Frequency, Numbers, Quantity, Time, as_number, quantities

if TYPE_CHECKING:
    import os

    from numpy.typing import NDArray

    from pyfret._core import LoadPath, Scene

__all__ = ["LoadHistory", "register_reader"]

#: Function that reads the columns of a file: entered by the package, since readers stand above.
READERS: list[Callable[..., Any]] = []


def register_reader(read: Callable[..., Any]) -> None:
    """Enter the function that reads the columns of a file."""
    READERS[:] = [read]


@dataclass(frozen=True, eq=False, repr=False)
class LoadHistory(HoldsArrays, Figured):
    """A load history of one or several channels.

    It is made by :meth:`from_csv`, :meth:`from_array`, :meth:`from_matrix` or
    :meth:`from_spectrum`. Channels have the names of a load path: ``T_x``, ``delta_x``, ``W``,
    ``sigma_B`` and so on, in SI units.

    Attributes
    ----------
    channels : dict of str to array
        Values over time; none of counted loops and of a spectrum.
    t : array, optional
        Instants [s]; None: an order without a clock.
    loops : CountedLoops, optional
        Counted loops, for a matrix.
    spectrum : Spectrum, optional
        Spectral density, for a spectrum.
    channel : str
        The channel of the loops: the one that is counted.
    mean : float
        Mean of a spectrum, in the unit of the channel.
    duration : float, optional
        Duration of one pass [s], where it has a clock.
    distribution : str
        Distribution of the amplitudes of a spectrum.
    residue : "half" or "repeat"
        What becomes of ranges that do not close: :func:`pyfret.fatigue.rainflow` counts half
        cycles; a block that repeats closes all.
    """

    figure = "load_history"

    channels: dict[str, NDArray[np.float64]] = field(default_factory=dict)
    t: NDArray[np.float64] | None = None
    loops: CountedLoops | None = None
    spectrum: Spectrum | None = None
    channel: str = "T_x"
    mean: float = 0.0
    duration: float | None = None
    distribution: Distribution = "dirlik"
    residue: Residue = "repeat"

    def __post_init__(self) -> None:
        """Refuse fields that are no numbers."""
        number(self.mean, "mean")
        if self.t is not None:
            plain(self.t, "t")
        if self.duration is not None:
            number(self.duration, "duration")

    @classmethod
    @quantities
    def from_array(
        cls,
        *,
        t: Numbers | None = None,
        frequency: Frequency | None = None,
        residue: Residue = "repeat",
        **channels: Any,
    ) -> LoadHistory:
        """Make a history of arrays over time, one for each channel.

        Parameters
        ----------
        t : array, optional
            Instants [s], evenly spaced.
        frequency : float, optional
            Samples per second [Hz], instead of instants. Without both the history has an order and
            no clock, which heat and coefficients over the power density need.
        residue : "half" or "repeat"
            Whether ranges that do not close are half cycles, or the history repeats (default).
        **channels : array
            ``T_x``, ``T_y``, ``W`` [N], ``M_z`` [N m], ``delta_x``, ``delta_y`` [m], ``phi_z``
            [rad], ``sigma_B``, ``sigma_B1`` [Pa]. Whole numbers of a logger are widened.

        Raises
        ------
        ValueError
            Unequal lengths, missing values, a gap of the clock: the message has the row.
        """
        arrays, clock = read_channels(channels, t)
        if clock is None and frequency is not None:
            rate = as_number(frequency)
            if not rate > 0.0:
                raise ValueError(f"frequency = {rate} Hz: must be above 0")
            clock = np.arange(next(iter(arrays.values())).size) / rate
        elif frequency is not None:
            raise ValueError("t and frequency: must be one of them")
        return cls._of_series(arrays, clock, residue)

    @classmethod
    def _of_series(
        cls,
        channels: dict[str, NDArray[np.float64]],
        t: NDArray[np.float64] | None,
        residue: Residue,
    ) -> LoadHistory:
        """Make a history of checked channels."""
        duration = None
        if t is not None:
            # A sample lasts until the next one.
            duration = float(t[-1] - t[0]) * t.size / (t.size - 1)
        name = counted_channel(channels)
        if residue not in ("half", "repeat"):
            raise ValueError(f"residue = {residue!r}: must be 'half' or 'repeat'")
        return cls(channels, t, channel=name, duration=duration, residue=residue)

    @classmethod
    @quantities
    def from_csv(
        cls,
        path: str | os.PathLike[str],
        *,
        columns: Mapping[str, str] | None = None,
        t: str | None = None,
        frequency: Frequency | None = None,
        units: dict[str, str] | None = None,
        skip: int = 0,
        group: str | None = None,
        residue: Residue = "repeat",
    ) -> LoadHistory:
        """Read a recording: a table of text, TDMS, MAT, HDF5, MDF or a workbook of Excel.

        The content decides on the format, as for :func:`pyfret.fit.read_loops`.

        Parameters
        ----------
        path : path
            The file. Its columns need units in their heads, as in ``T_x [kN]``, or in `units`.
        columns : mapping of str to str, optional
            Channel and name of its column, such as ``{"T_x": "Kraft", "W": "Normalkraft"}``
            (default: the columns that have the name of a channel).
        t : str, optional
            Name of the column of time (default: ``t`` or ``time``, if it is there).
        frequency : float, optional
            Samples per second [Hz], where no column has the time.
        units, skip, group
            As in :func:`pyfret.fit.read_loops`.
        residue : "half" or "repeat"
            As in :meth:`from_array`.
        """
        if t is not None and not isinstance(t, str):
            raise TypeError(f"t = {t!r:.60}: must be the name of the column of time")
        table = READERS[0](path, units, skip=skip, group=group)
        short = [table.short(n) for n in range(len(table.names))]
        if columns is None:
            columns = {name: name for name in CHANNELS if name in short}
        if not columns:
            raise ValueError(
                f"{table.place}: no column is named as a channel ({', '.join(CHANNELS)}), but "
                f"{', '.join(table.names)}: give columns={{'T_x': NAME}}"
            )
        indices = []
        for name, column in columns.items():
            check_channel(name)
            index = table.index(column)
            measure = _core.measured_by(name)
            assert measure is not None
            table.must_measure(index, measure[0])
            indices.append(index)
        clock_name = t or next((name for name in ("t", "time", "Time") if name in short), None)
        if clock_name is not None:
            index = table.index(clock_name)
            table.must_measure(index, "time")
            indices.append(index)
        own_clock = clock_of_channels(table, indices)
        *values, last = table.numbers(*indices)
        arrays = [*values] if clock_name is not None else [*values, last]
        clock: NDArray[np.float64] | None = last if clock_name is not None else None
        if clock is None and frequency is None:
            clock = own_clock
        read, clock = read_channels(
            dict(zip(columns, arrays, strict=True)), clock, f"{table.place}: "
        )
        if clock is None and frequency is not None:
            clock = np.arange(len(arrays[0])) / as_number(frequency)
        return cls._of_series(read, clock, residue)

    @classmethod
    @quantities
    def from_matrix(
        cls,
        range: Numbers,
        mean: Numbers,
        counts: Numbers,
        *,
        channel: Channel = "T_x",
        duration: Time | None = None,
    ) -> LoadHistory:
        """Make a history of counted loops: a range-mean matrix, or a list of loops.

        Parameters
        ----------
        range, mean : array
            Range (twice the amplitude) and mean of the loops [SI]. Either both have the shape of
            `counts`, or they are the axes of the matrix `counts` of the shape (range, mean).
        counts : array
            How often each loop occurs; fractions are allowed.
        channel : str
            The channel that they belong to.
        duration : float, optional
            Duration in which they occur [s].
        """
        check_channel(channel)
        sizes, middles = plain(range, "range"), plain(mean, "mean")
        occurs = plain(counts, "counts")
        if occurs.ndim == 2 and sizes.ndim == middles.ndim == 1:
            if occurs.shape != (sizes.size, middles.size):
                raise ValueError(
                    f"counts have the shape {occurs.shape}: must be "
                    f"({sizes.size}, {middles.size}), ranges by means"
                )
            sizes, middles = (a.ravel() for a in np.meshgrid(sizes, middles, indexing="ij"))
            occurs = occurs.ravel()
        if sizes.ndim != 1 or not sizes.shape == middles.shape == occurs.shape:
            raise ValueError(
                f"range, mean and counts have the shapes {sizes.shape}, {middles.shape} and "
                f"{occurs.shape}: must be as many numbers, or ranges by means"
            )
        for name, values, allowed in (
            ("range", sizes, sizes >= 0.0),
            ("counts", occurs, occurs >= 0.0),
        ):
            if not allowed.all():
                row = int(np.argmin(allowed))
                raise ValueError(f"{name}[{row}] = {values[row]}: must be 0 or more")
        kept = (occurs > 0.0) & (sizes > 0.0)
        if not kept.any():
            raise ValueError("counts: must be above 0 for one loop at least")
        loops = CountedLoops.from_rows(
            np.column_stack([sizes, middles, occurs])[kept], channel, "closed loops"
        )
        length = None if duration is None else as_number(duration)
        return cls(loops=loops, channel=channel, duration=length)

    @classmethod
    @quantities
    def from_spectrum(
        cls,
        psd: Spectrum | tuple[Any, Any],
        duration: Time,
        *,
        of: SpectrumValues = "density",
        channel: Channel = "T_x",
        mean: Quantity = 0.0,
        distribution: Distribution = "dirlik",
    ) -> LoadHistory:
        """Make a history of a stationary Gaussian load from its spectrum.

        Parameters
        ----------
        psd : Spectrum or pair of arrays
            Frequencies [Hz] and one-sided density per Hz, or lines.
        duration : float
            Duration [s].
        of : "density", "peak" or "rms"
            What the second array holds, as in :meth:`Spectrum.from_arrays`.
        channel : str
            The channel.
        mean : float
            Mean of the load, in the unit of the channel.
        distribution : "dirlik" or "rayleigh"
            Distribution of the amplitudes: of any band, or of a narrow one.
        """
        check_channel(channel)
        if not isinstance(psd, Spectrum):
            if not isinstance(psd, Sequence) or len(psd) != 2:
                raise TypeError(
                    "psd: must be a Spectrum, or a pair of arrays, frequencies and density"
                )
            psd = Spectrum.from_arrays(*psd, of=of)
        length = as_number(duration)
        if not length > 0.0:
            raise ValueError(f"duration = {length} s: must be above 0")
        if psd.rate(distribution) * length < 1.0:
            raise ValueError(f"duration = {length} s: must hold one cycle of the load at least")
        middle = in_unit_of(channel, mean)
        return cls(
            spectrum=psd,
            channel=channel,
            mean=middle,
            duration=length,
            distribution=distribution,
        )

    @property
    def is_series(self) -> bool:
        """Whether the history has an order: values over time."""
        return bool(self.channels)

    def count(self, *, residue: Residue | None = None) -> CountedLoops:
        """Count the loops of the channel :attr:`channel`.

        A series is counted by rainflow, :func:`pyfret.fatigue.rainflow`. A matrix is counted
        already. The loops of a spectrum follow from its distribution, in classes of the amplitude
        up to the one that is exceeded once.
        """
        if self.loops is not None:
            return self.loops
        if self.spectrum is not None:
            return CountedLoops.from_spectrum(
                self.spectrum, self.distribution, self.duration or 0.0, self.mean, self.channel
            )
        rule = self.residue if residue is None else residue
        return CountedLoops.from_series(self.channels[self.channel], rule, self.channel)

    def sample(self, *, seed: int, duration: Time | None = None) -> LoadHistory:
        """Return a time series of a spectrum, by a stated seed.

        Parameters
        ----------
        seed : int
            Seed of the random numbers; the same one gives the same series.
        duration : float, optional
            Duration [s] (default: the one of the history).
        """
        if self.spectrum is None:
            raise ValueError("sample: must be the history of a spectrum")
        length = self.duration if duration is None else as_number(duration)
        step, values = self.spectrum.sample(length, seed=seed)  # type: ignore[arg-type]
        channels: dict[str, Any] = {self.channel: values + self.mean}
        return LoadHistory.from_array(t=np.arange(values.size) * step, **channels)

    def equivalent_amplitude(self, exponent: float) -> float:
        """Return the amplitude of constant loops with the same sum of amplitude^exponent."""
        return self.count().equivalent_amplitude(exponent)

    def turns(self) -> NDArray[np.int64]:
        """Return the samples at which some channel turns, both ends included."""
        places = {0, next(iter(self.channels.values())).size - 1}
        for values in self.channels.values():
            places.update(turning_points(values).tolist())
        return np.array(sorted(places))

    def block(self) -> NDArray[np.int64]:
        """Return the turning samples of the history as a block that repeats.

        It begins and ends at the largest value of the counted channel.
        """
        first = int(rearranged(self.channels[self.channel])[0])
        turns = self.turns()
        return np.concatenate([turns[turns >= first], turns[turns <= first]])

    def path(self, scene: Scene, *, repeat: bool = False) -> LoadPath:
        """Return the load path through the history, after what presses the bodies in a scene.

        Parameters
        ----------
        scene : Scene
            The branches of its path up to the first tangential load or motion press the bodies. A
            history with ``W`` needs none.
        repeat : bool
            Whether the history runs as a block that repeats, :meth:`block`.
        """
        if not self.is_series:
            raise ValueError(
                "path: counted loops and spectra have no order: solve them by fret.wear.solve or "
                "fatigue.damage, or take history.sample(seed=...) of a spectrum"
            )
        places = self.block() if repeat else self.turns()
        path = press(scene, self.channels, places)
        columns = {name: values[places] for name, values in self.channels.items()}
        return path.waypoints(increments="auto", **columns)

    def replace(self, **changes: Any) -> LoadHistory:
        """Return the same history with some fields exchanged."""
        return replace(self, **changes)

    def summary(self) -> str:
        """Describe the history: channels, duration, counted loops."""
        return wrap(self._text())

    def __repr__(self) -> str:
        """The history in a line."""
        return f"LoadHistory({self._text()})"

    def _text(self) -> str:
        """Return the history as one line."""
        unit = channel_unit(self.channel)
        clock = "" if self.duration is None else f", {format_number(self.duration)} s"
        if self.spectrum is not None:
            s = self.spectrum
            return (
                f"{self.channel}: spectrum, rms {format_number(s.rms)} {unit}, mean "
                f"{format_number(self.mean)} {unit}, {format_number(s.up_crossings)} up-crossings "
                f"and {format_number(s.peaks)} peaks per s, {self.distribution}{clock}"
            )
        if self.loops is not None:
            return f"{self.loops!r}{clock}"
        values = self.channels[self.channel]
        ranges = f"{format_number(values.min())} to {format_number(values.max())} {unit}"
        others = [name for name in self.channels if name != self.channel]
        beside = f", with {', '.join(others)}" if others else ""
        return f"{self.channel}: {values.size} values, {ranges}{beside}{clock}"


def clock_of_channels(table: Any, indices: Sequence[int]) -> NDArray[np.float64] | None:
    """Return the instants of the channels of a recording; None where they have no clock.

    Channels of different clocks are refused: resampling them would lose turning points.
    """
    channels = getattr(table, "channels", None)
    if channels is None:
        return None
    chosen = [channels[index] for index in indices]
    if not table.is_one_clock(chosen):
        sizes = ", ".join(f"{channel.name} has {channel.size} samples" for channel in chosen)
        raise ValueError(
            f"{table.place}: {sizes}, and they have different clocks: must have one, since a "
            "history keeps every turning point; name the columns of one clock by columns={...}"
        )
    first = chosen[0]
    return None if first.clock is None else np.asarray(first.clock(), dtype=float)


def in_unit_of(channel: str, value: Quantity) -> float:
    """Return a value of a channel in SI."""
    if isinstance(value, (int, float)):
        return number(value, "mean")
    measure = _core.measured_by(channel)
    kind = measure[0] if measure else ""
    return float(_core.quantity_in_si("bulk stress" if kind == "stress" else kind, value))


def press(
    scene: Scene, channels: Mapping[str, NDArray[np.float64]], places: NDArray[np.int64]
) -> LoadPath:
    """Return the first branches of the path of a scene, which press the bodies."""
    path = _core.LoadPath.start()
    kept = []
    for branch in scene.path.branches:
        sheared = any(
            getattr(branch, name) not in (None, 0.0)
            for name in CHANNELS
            if name not in ("W", "sigma_B", "sigma_B1")
        )
        if sheared:
            break
        kept.append(branch)
    if kept:
        return _core.LoadPath(kept, rig_stiffness=scene.path.rig_stiffness)
    if "W" not in channels:
        raise ValueError(
            "W: nothing presses the bodies: give the scene the path LoadPath.start().normal(W), "
            "or the history a channel W"
        )
    first = float(channels["W"][places[0]])
    if not first > 0.0:
        raise ValueError(f"W[{int(places[0])}] = {first} N: must be above 0 where the path begins")
    return path.normal(first)
