"""Result of a run of wear: its jumps, its worn surfaces, its events."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from pyfret import _core
from pyfret._core import Body, Scene, SurfaceMap, with_error
from pyfret._util.figures import Figured
from pyfret._util.labelled import Labelled
from pyfret._util.numbers import length, um
from pyfret._util.tables import as_table
from pyfret._util.text import shown
from pyfret._util.toml import parse_toml
from pyfret._util.window import wrap
from pyfret.quantities import FrictionCoefficient, Length, as_number, quantities
from pyfret.run.loops import NO_FRICTION, frictionless, loops_of_corners
from pyfret.saveable import Saveable
from pyfret.scene.tables import table
from pyfret.subsurface.line import Line, cut
from pyfret.wear.cycles import Cycles, RangeOfCycles, changed, reached, spent

if TYPE_CHECKING:
    from typing import Literal

    import xarray as xr

    from pyfret._util.csv_table import Tables
    from pyfret._util.labelled_table import Table


__all__ = ["WearResult"]

#: Highest over lowest coefficient of wear, 10 to 90 % of the tests: a stated default.
SCATTER = 3.0
#: Cells across the slip zone below which depth and volume are doubted: 5 and 10 % of error.
FEWEST_SLIP_CELLS = 4


class WearResult(Saveable, Labelled, Figured):
    """Worn surfaces over blocks of cycles, and the numbers of every jump.

    ``dataset`` has three groups of variables. The scalars lie over ``jump`` (coordinate
    ``cycles``): ``volume1``, ``volume2``, ``depth1``, ``depth2``, ``debris``, ``dissipated``,
    ``p_max``, ``stick_ratio``, ``depth_error``, ``volume_error``, ... The fields lie over
    ``block``, ``x``, ``y`` (coordinate ``block_cycles``): ``worn1``, ``worn2``, ``energy1``,
    ``energy2``, ``slid``, ``p``, ``stick``. The friction loops
    ``loop_delta_x``, ``loop_T_x``, ... lie over ``block``, ``corner``.
    """

    table_axes = ("jump",)
    figure = "wear_profiles"

    def _tables(self) -> Tables:
        """Return what makes the tables: the jumps, and the friction loops of the blocks."""
        return {
            "jumps": lambda: (self.dataset, ("jump",)),
            "loops": lambda: (self.loops(), ("block",)),
        }

    def _elsewhere(self, name: str) -> dict[str, str]:
        """Return where a name is found that this object does not have."""
        error = (
            'wear.error_of("depth") has the relative error of the deepest depth at the end, '
            'wear.error_of("volume") the one of the volume; wear.depth_error and '
            "wear.volume_error have it for every jump"
        )
        words = ("depth", "volume", "worn")
        of_bodies = {f"{word}{body}_error" for word in words for body in (1, 2)}
        return dict.fromkeys((*of_bodies, "error", "errors", "error_bars", "uncertainty"), error)

    @property
    def worn(self) -> xr.DataArray:
        """Depth worn off both bodies together, read with no shift between them, m."""
        total: xr.DataArray = self.dataset.worn1 + self.dataset.worn2
        return total

    @property
    def direction(self) -> Literal["x", "y"]:
        """The axis along which the force of the last friction loop is largest."""
        T = [float(abs(self.dataset[f"loop_T_{axis}"][-1]).max()) for axis in ("x", "y")]
        return "y" if T[1] > T[0] else "x"

    @quantities
    def loops(self, *, direction: Literal["x", "y"] | None = None) -> Table:
        """Energy and stiffness of the friction loop of every block, as :meth:`Result.loops`.

        Parameters
        ----------
        direction : "x" or "y", optional
            The axis of the loop (default: :attr:`direction`).

        Returns
        -------
        xarray.Dataset
            Over ``block`` with ``block_cycles``: ``dissipated`` in a cycle [J], half ranges ``T``
            [N] and ``delta`` [m], ``secant_stiffness`` [N/m]. Half the ``opening`` of the loop [m]
            and ``energy_ratio``. Of a line contact per metre.
        """
        axis = self.direction if direction is None else direction
        if axis not in ("x", "y"):
            raise ValueError(f'direction = {direction!r}: must be "x" or "y"')
        d = self.dataset
        shift, force = (
            np.asarray(d[f"loop_{quantity}_{axis}"], float) for quantity in ("delta", "T")
        )
        at = [
            int(abs(d.cycles.values - block_cycles).argmin())
            for block_cycles in d.block_cycles.values
        ]
        energy = np.asarray(d.dissipated_per_cycle, float)[at]
        loops = loops_of_corners(shift, force, energy, self.scene.grid)
        return as_table(loops.assign_coords(block_cycles=d.block_cycles))

    def along(self) -> xr.Dataset:
        """Return the fields of the blocks on the line along the shear.

        The line passes through the centre of the last contact, and has the direction of the largest
        force in the last friction loop.

        Returns
        -------
        xarray.Dataset
            Over block and x, y or, on an oblique line, s [m].
        """
        d, grid = self.dataset, self.scene.grid
        p = np.asarray(d.p[-1], dtype=float)
        line = Line(None, 0.0)
        if p.any():
            T = np.array([d[f"loop_T_{axis}"][-1].values for axis in ("x", "y")])
            T = T[:, np.hypot(*T).argmax()]
            # Shear in proportion to the pressure has the direction of the force.
            q_x, q_y = (p * T_axis / max(np.hypot(*T), 1e-300) for T_axis in T)
            line = Line(*_core.main_sections(_core.Outline(grid, p=p, q_x=q_x, q_y=q_y))[0])
        return cut(d, grid, line)

    @quantities
    def cycles_to(
        self,
        *,
        depth: Length | None = None,
        part_of_coating: float | None = None,
        volume: float | None = None,
        energy: float | None = None,
        mu: FrictionCoefficient | None = None,
        body_number: int = 2,
        coating: int = 0,
    ) -> Cycles:
        """Cycles after which a body has worn so far.

        NaN if the run ended before, printed as "more than N cycles (the run ended there)". N is
        ``beyond``. Infinite where nothing wears, or where wear has come to rest before.

        Within a jump the depth and the volume follow the parabola through its ends and its middle.
        The error is ``depth_error``, or ``volume_error`` for a volume.

        Parameters
        ----------
        depth : float
            Deepest worn depth [m].
        part_of_coating : float
            The deepest depth, as a part of a coating's thickness: 1 is worn through.
        volume : float
            Volume lost [m^3].
        energy : float
            Energy dissipated in the contact, of both bodies [J]. A solid lubricant such as MoS2
            fails at an energy per area of the contact.
        mu : float
            Mean coefficient of friction of the contact, variable ``mu``, reached from either side:
            a solid lubricant fails as its friction rises.
        body_number : 1 or 2
            The body.
        coating : int
            The coating, 0 the outermost; those above it are worn through before.

        Raises
        ------
        ValueError
            Not one of the five is given, or the body has no such coating.
        """
        criteria = {
            "depth": as_number(depth),
            "part_of_coating": part_of_coating,
            "volume": volume,
            "energy": energy,
            "mu": mu,
        }
        if sum(value is not None for value in criteria.values()) != 1:
            raise ValueError(f"{', '.join(criteria)}: give one of them")
        if body_number not in (1, 2):
            raise ValueError(f"body_number = {body_number}: must be 1 or 2")
        if part_of_coating is not None:
            coatings = (self.scene.body1 if body_number == 1 else self.scene.body2).coatings
            if not 0 <= coating < len(coatings):
                raise ValueError(
                    f"coating = {coating}: body {body_number} has {len(coatings)} coatings"
                )
            above = sum(layer.thickness for layer in coatings[:coating])
            depth = above + part_of_coating * coatings[coating].thickness
        if mu is not None:
            return changed(self.dataset, float(mu), self.scene.friction.mu)
        if energy is not None:
            return spent(self.dataset, energy)
        name, target = ("volume", volume) if depth is None else ("depth", as_number(depth))
        return reached(self.dataset, f"{name}{body_number}", float(target or 0.0))

    @quantities
    def range_of_cycles(self, *, scatter: float = SCATTER, **to: Any) -> RangeOfCycles:
        """Cycles after which a body has worn so far as a range of 10 to 90 %: low, best, high.

        The error of the depths and the scatter of the wear coefficient make the range; their
        logarithms are independent and add as squares. Where the run ended before, ``best`` and
        ``high`` are NaN, and ``low`` is the last cycle.

        Parameters
        ----------
        scatter : float
            Coefficient that 90 % of the tests stay below over that which 10 % do (default: 3, a
            stated default where no scatter was measured).
        **to
            As in :meth:`cycles_to`.
        """
        if not scatter >= 1.0:
            raise ValueError(f"scatter = {scatter}: must be 1 or more, the highest over the lowest")
        best = self.cycles_to(**to)
        error = self.error_of("volume" if to.get("volume") is not None else "depth")
        part = math.exp(math.hypot(0.5 * math.log(scatter), math.log1p(error)))
        cycles = best if best.beyond is None else best.beyond
        return RangeOfCycles(cycles / part, best, best * part)

    @quantities
    def error_of(self, quantity: Literal["depth", "volume"]) -> float:
        """Give the relative error of the deepest depth or of the volume at the end.

        Raises
        ------
        ValueError
            The quantity is neither of the two.
        """
        if quantity not in ("depth", "volume"):
            raise ValueError(f"quantity = {quantity!r:.60}: must be 'depth' or 'volume'")
        name = f"{quantity}_error"
        # Stores without an error of the volume have the error of the depth.
        return float(self.dataset[name if name in self.dataset else "depth_error"][-1])

    @property
    def gap(self) -> xr.DataArray:
        """Growth of the gap [m]: the worn depth of both bodies minus the debris that stays."""
        opened: xr.DataArray = (1.0 - self.debris_kept) * self.worn
        if "bed" in self.table:
            opened = opened - self.dataset.bed
        return opened

    @property
    def scene(self) -> Scene:
        """The scene before wear. Its path includes the stiffness of the rig."""
        scene = Scene.from_toml(self.dataset.attrs["scene"])
        # Older stores keep the rig in the table of wear.
        stiffness = self.table.get("rig_stiffness", scene.path.rig_stiffness)
        return scene.replace(path=scene.path.rig(stiffness))

    @property
    def worn_scene(self) -> Scene:
        """Return the scene with the worn surfaces of the last block as its shapes."""
        scene, kept = self.scene, 1.0 - self.debris_kept
        grid = scene.grid

        def worn(body: Body, depth: xr.DataArray) -> Body:
            """Return a body with its worn surface as a shape."""
            heights = -kept * np.asarray(depth.values, dtype=float)
            if not heights.any():
                return body
            # A map has two lines at least.
            wide = np.repeat(heights, 2, axis=1) if heights.shape[1] == 1 else heights
            return body.replace(shape=body.shape + SurfaceMap(wide, spacing=(grid.dx, grid.dy)))

        d = self.dataset
        bodies = worn(scene.body1, d.worn1[-1]), worn(scene.body2, d.worn2[-1])
        return scene.replace(body1=bodies[0], body2=bodies[1])

    @property
    def table(self) -> dict[str, Any]:
        """The table ``[wear]`` of a scene file."""
        return dict(parse_toml(self.dataset.attrs["wear"])["wear"])

    @property
    def debris_kept(self) -> float:
        """Part of what both bodies lose that stays in the contact."""
        return float(self.table.get("debris_kept", 0.0))

    def summary(self) -> str:
        """Return depths, volumes, energy, jumps, laws and events of the coatings as text."""
        d = self.dataset
        last = {name: float(d[name][-1]) for name in d.data_vars if d[name].dims == ("jump",)}
        volume, energy = (d[name].attrs["units"] for name in ("volume1", "dissipated"))
        jumps = d.sizes["jump"]
        lines = [
            str(d.attrs.get("title") or "wear"),
            f"{float(d.cycles[-1]):.6g} cycles in {jumps} jump{'s' * (jumps != 1)}, status: "
            f"{d.attrs['status']}",
        ]
        for body in (1, 2):
            if last[f"volume{body}"] > 0:
                depth, lost = 1e6 * last[f"depth{body}"], last[f"volume{body}"]
                lines.append(
                    f"body {body}: {with_error(depth, last['depth_error'] * depth)} um deep, "
                    f"{with_error(lost, self.error_of('volume') * lost)} {volume}"
                )
        if any(last[f"volume{body}"] > 0 for body in (1, 2)):
            lines.append(
                "depth and volume: error of the computation alone, for the law and mu as given"
            )
        if self.debris_kept:
            lines.append(
                f"debris: {self.debris_kept:g} of it stays in the contact, "
                f"{with_error(last['debris'], self.error_of('volume') * last['debris'])} {volume}"
            )
        if "bed" in self.table:
            lines.append(
                f"debris: {with_error(last['debris'])} {volume} in the bed, "
                f"{with_error(last['ejected'])} {volume} has left"
            )
        if "air" in self.table:
            lines.append(f"aerated: {with_error(last['aerated_share'])} of the contact")
        lines.append(
            f"energy: {with_error(last['dissipated'])} {energy}, "
            f"{with_error(last['dissipated_per_cycle'])} {energy} in the last cycle, "
            f"{self.loops_note}"
        )
        if not self.scene.friction.is_constant:
            mu = with_error(last["mu"], last.get("mu_error", 0.0) * last["mu"])
            lines.append(f"mean coefficient of friction: {mu} at the end")
        sticks = (
            NO_FRICTION
            if frictionless(self.scene)
            else f"stick ratio {with_error(last['stick_ratio'])}"
        )
        lines.append(f"largest pressure: {self._format_largest_pressure(-1)}, {sticks}")
        for event in self.events:
            cycles = with_error(event["cycles"], event.get("cycles_error"))
            lines.append(
                f"{event['kind']} after {cycles} cycles: body {event['body']}, coating "
                f"{event['coating'] + 1}, at x = {um(event['x'])}, y = {um(event['y'])}"
            )
        document = self.table
        for body in (1, 2):
            laws = document.get(f"body{body}", {}).get("laws", [])
            lines += [f"law of body {body}: {written(law)}" for law in laws]
        method = str(d.attrs.get("method", ""))
        lines += [f"method: {method}"] if method else []
        lines += [f"warning: {doubt}" for doubt in self.doubts]
        return wrap(shown("\n".join(lines)))

    def _format_largest_pressure(self, jump: int) -> str:
        """Format the largest pressure after a jump and its error, or why it has none."""
        d = self.dataset
        value = 1e-6 * float(d.p_max[jump])
        error = float(d.p_max_error[jump]) if "p_max_error" in d else 0.0
        if math.isinf(error):
            return "singular at the border of the stick zone: it grows with the grid"
        return f"{with_error(value, error * value)} MPa"

    @property
    def loops_note(self) -> str:
        """Describe the path of the friction loops, which is not the loop of the scene."""
        text = "on the worn surfaces"
        if self.table.get("cycling") == "sliding":
            text += (
                ": every cell slips by the whole shift, without the elastic shift of the contact"
            )
        return text

    @property
    def doubts(self) -> list[str]:
        """List warnings on the scene, the wear and the grid, one sentence each."""
        doubts = str(self.dataset.attrs.get("doubts", "")).splitlines()
        cells = float(self.dataset["slip_cells"][-1]) if "slip_cells" in self.dataset else math.inf
        if float(self.dataset["stick_ratio"][-1]) > 0.0 and cells < FEWEST_SLIP_CELLS:
            finer = math.ceil(FEWEST_SLIP_CELLS / max(cells, 0.5) * self.scene.grid.nx)
            doubts.append(
                f"the slip zone is {cells:.1f} cells wide: the deepest depth is known to "
                f"{self.error_of('depth'):.0%}, the volume to {self.error_of('volume'):.0%}; "
                f"grid.n = {finer} has {FEWEST_SLIP_CELLS} cells across it"
            )
        return doubts

    @property
    def events(self) -> list[dict[str, Any]]:
        """List the events of the coatings: kind, cycles, body, coating, x, y, ``cycles_error``.

        The error of the cycles is the relative error of the deepest depth at the event (variable
        ``depth_error``), times the cycles.
        """
        return list(self.dataset.attrs["events"])

    def _repr_html_(self) -> str:
        """Return cycles and depths of the blocks, for notebooks."""
        d = self.dataset
        at = [
            int(abs(d.cycles.values - block_cycles).argmin())
            for block_cycles in d.block_cycles.values
        ]
        rows = [
            [f"{float(d.cycles[n]):.4g}"]
            + [f"{1e6 * float(d[name][n]):.4g}" for name in ("depth1", "depth2")]
            + [self._format_largest_pressure(n)]
            for n in at
        ]
        heading = ["cycles", "depth, body 1 [µm]", "depth, body 2 [µm]", "p_max"]
        return table(heading, rows)

    def __repr__(self) -> str:
        """Tell the cycles and the depths."""
        d = self.dataset
        depths = [
            length(float(depths_of_body[-1])).replace("µ", "u")
            for depths_of_body in (d.depth1, d.depth2)
        ]
        return (
            f"WearResult({float(d.cycles[-1]):.0f} cycles in {d.sizes['jump']} jumps, depths "
            f"{depths[0]} and {depths[1]})"
        )


def written(law: dict[str, Any]) -> str:
    """Describe a law in words."""
    if law.get("own"):
        return "a function"
    name, unit = ("k", "m^2/N") if "k" in law else ("alpha", "m^3/J")
    if not law[name]:
        return "does not wear"
    text = f"{name} = {law[name]:.4g} {unit}"
    if law.get("threshold"):
        text += f", threshold {law['threshold']:.4g}"
    return text + (f", times a function of {law['factor']['of']}" if "factor" in law else "")
