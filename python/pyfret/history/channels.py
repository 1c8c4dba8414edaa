"""Channels of a load history: names, what they measure, and which of them is counted."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from pyfret import _core
from pyfret._util.arrays import plain

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "CHANNELS",
    "Channel",
    "channel_unit",
    "check_channel",
    "counted_channel",
    "load_of",
    "read_channels",
]

#: Loads and motions that vary over a history, by the names of a load path.
Channel: TypeAlias = Literal[
    "T_x", "delta_x", "T_y", "delta_y", "M_z", "phi_z", "sigma_B", "sigma_B1", "W"
]
CHANNELS: tuple[Channel, ...] = get_args(Channel)
#: Pairs of a load and its motion, of which one alone is given.
PAIRS = (("T_x", "delta_x"), ("T_y", "delta_y"), ("M_z", "phi_z"))


def load_of(name: str) -> str:
    """Return the load of a channel: the force of a shift, the moment of a twist."""
    return {motion: load for load, motion in PAIRS}.get(name, name)


def check_channel(name: str) -> None:
    """Refuse a name that is no channel."""
    if name not in CHANNELS:
        raise ValueError(f"channel = {name!r}: must be one of {', '.join(CHANNELS)}")


def channel_unit(name: str) -> str:
    """Return the SI unit of a channel."""
    measure = _core.measured_by(name)
    return measure[1] if measure else ""


def counted_channel(channels: Mapping[str, NDArray[np.float64]]) -> str:
    """Return the channel whose loops are counted: the first of the list that varies."""
    for name in CHANNELS:
        if name in channels and np.ptp(channels[name]) > 0.0:
            return name
    raise ValueError(
        f"the history ({', '.join(channels)}) is constant: must vary, as it has no loop to count"
    )


def read_channels(
    arrays: Mapping[str, ArrayLike], t: ArrayLike | None, place: str = ""
) -> tuple[dict[str, NDArray[np.float64]], NDArray[np.float64] | None]:
    """Check channels of one clock, and return them as floating point numbers.

    Raises
    ------
    ValueError
        Channels have unequal lengths, a missing value, or a gap in their clock; the message has the
        row.
    """
    if not arrays:
        raise ValueError(f"{place}no channel: must have one or more of {', '.join(CHANNELS)}")
    channels: dict[str, NDArray[np.float64]] = {}
    for name, values in arrays.items():
        check_channel(name)
        channels[name] = plain(values, f"{place}{name}")
        if channels[name].ndim != 1:
            raise ValueError(
                f"{place}{name} has the shape {channels[name].shape}: must have one dimension, time"
            )
    first, *others = channels
    size = channels[first].size
    if size < 2:
        raise ValueError(f"{place}{first} has {size} values: must have 2 or more")
    for name in others:
        if channels[name].size != size:
            raise ValueError(
                f"{place}{name} has {channels[name].size} values and {first} has {size}: must be "
                "as many, of one clock"
            )
    for load, motion in PAIRS:
        if load in channels and motion in channels:
            raise ValueError(
                f"{place}{load} and {motion}: must be one of them, the one that drives; leave the "
                "other out"
            )
    return channels, None if t is None else read_clock(t, size, place)


def read_clock(t: ArrayLike, size: int, place: str) -> NDArray[np.float64]:
    """Check instants [s]: as many as the values, evenly spaced, without a gap."""
    clock = plain(t, f"{place}t")
    if clock.shape != (size,):
        raise ValueError(f"{place}t has {clock.size} values: must have {size}, as the channels")
    steps = np.diff(clock)
    if (steps <= 0.0).any():
        row = int(np.argmax(steps <= 0.0)) + 1
        raise ValueError(f"{place}t[{row}] = {clock[row]:.9g} s: must be later than the one before")
    usual = float(np.median(steps))
    if (steps > 1.5 * usual).any():
        row = int(np.argmax(steps > 1.5 * usual)) + 1
        raise ValueError(
            f"{place}t[{row}] = {clock[row]:.9g} s: comes {steps[row - 1]:.4g} s after the one "
            f"before, in steps of {usual:.4g} s. A history must have no gap: give its parts as "
            "histories"
        )
    return clock
