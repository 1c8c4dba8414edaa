"""Every load against its closed form: torsion, any path, ellipse, bulk stress, rolling and others.

    python examples/loads.py --out out

Each figure shows the computed values as dots or steps and the closed form as a line, and says the
largest difference.
"""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from shared import MU, STEEL, Array, Figures, R, W, draw, solved

import pyfret as fret

LINE_W = 1e5
CORK = fret.Elastic(E=210e9, nu=0.0)


def sphere(
    material: fret.Elastic, path: fret.LoadPath, *, n: int, mu: float | fret.Friction = MU
) -> fret.Scene:
    """A sphere on a flat of the same material."""
    a = fret.reference.hertz(R=R, bodies=(material, material), W=W).a
    return fret.Scene(
        body1=fret.Body(material, shape=fret.Sphere(R=R)),
        body2=fret.Body(material),
        friction=mu,
        grid=fret.Grid.centred(width=2.3 * a, n=n),
        path=path,
    )


def cylinder(path: fret.LoadPath, *, n: int) -> tuple[fret.Scene, fret.reference.LineContact]:
    """A steel cylinder on a steel flat, plane strain."""
    line = fret.reference.line_contact(R=R, bodies=(STEEL, STEEL), W=LINE_W)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Cylinder(R=R)),
        body2=fret.Body(STEEL),
        friction=MU,
        grid=fret.Grid.strip(extent=2.4 * line.a, n=n),
        path=path,
    )
    return scene, line


def largest(computed: Array, truth: Array, scale: float) -> float:
    """Largest difference over a scale."""
    return float(np.abs(np.asarray(computed) - np.asarray(truth)).max() / scale)


def torsion(file: Path, n: int) -> str:
    """Lubkin: moment against rotation, and the rows of stick radius 0.9, 0.5, 0.1."""
    hertz = fret.reference.hertz(R=R, bodies=(STEEL, STEEL), W=W)
    lubkin = fret.reference.Lubkin(hertz, bodies=(STEEL, STEEL), mu=MU)
    rows = np.array([0.99, 0.97, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1]) * hertz.a
    path = fret.LoadPath.start().normal(W, increments=1)
    for c in rows:
        path = path.torsion(float(lubkin.M_z(c)), increments=1)
    result = solved(sphere(STEEL, path, n=n))
    phi = result.dataset.phi_z.to_numpy()[1:]
    M_z = result.dataset.M_z.to_numpy()[1:]
    scale = MU * W * hertz.a
    worst = largest(phi / lubkin.phi(rows), np.ones_like(rows), 1.0)
    with fret.plot.style():
        figure, (curve, profile) = plt.subplots(1, 2, figsize=(8.4, 3.5))
        c = np.linspace(0.02, 0.999, 300) * hertz.a
        curve.plot(lubkin.phi(c) * 1e3, lubkin.M_z(c) / scale, label="Lubkin")
        curve.plot(phi * 1e3, M_z / scale, "o", ms=4, label=f"{n} x {n} cells")
        curve.axhline(lubkin.M_limit / scale, color="0.6", lw=0.8)
        curve.set(xlabel=r"$\varphi_z$ [mrad]", ylabel=r"$M_z/(\mu W a)$")
        curve.legend()
        for part in (0.9, 0.5, 0.1):
            k = 2 + int(np.argmin(np.abs(rows / hertz.a - part)))
            at = result.at(k)
            x = at.p.x.to_numpy()
            middle = np.abs(at.p.y.to_numpy()).argmin()
            q = at.q_y.to_numpy()[:, middle]
            r = np.abs(x)
            (line,) = profile.plot(
                x / hertz.a, np.sign(x) * lubkin.q(r, c=part * hertz.a) / (MU * hertz.p0)
            )
            profile.plot(x / hertz.a, q / (MU * hertz.p0), ".", ms=3, color=line.get_color())
        profile.set(xlabel="$x/a$", ylabel=r"$q_\theta/(\mu p_0)$", xlim=(-1.1, 1.1))
        curve.set_title(f"largest difference of the rotation {100 * worst:.2f} %")
        profile.set_title("stick radius 0.9, 0.5, 0.1 a")
        figure.savefig(file)
        plt.close(figure)
    return f"rotation of {len(rows)} rows within {100 * worst:.3f} %"


def any_path(file: Path, n: int) -> str:
    """Ten random paths of 20 waypoints against the springs."""
    rng = np.random.default_rng(7)
    hertz = fret.reference.hertz(R=R, bodies=(CORK, CORK), W=W)
    worst = []
    with fret.plot.style():
        figure, axes = plt.subplots(2, 5, figsize=(11, 4.6), sharex=True, sharey=True)
        for ax in axes.flat:
            load = rng.uniform(0.2, 1.0, 20) * W
            force = rng.uniform(-0.95, 0.95, 20) * MU * load
            path = fret.LoadPath.start().force(
                W=load[0], T_x=force[0], increments=60, spacing=fret.Spacing.EQUAL_RADIUS
            )
            path = path.waypoints(W=load[1:], T_x=force[1:], increments=60)
            result = solved(sphere(CORK, path, n=n))
            springs = fret.reference.Springs(hertz, R=R, bodies=(CORK, CORK), mu=MU)
            truth = np.array(
                [springs.load(W=w, T=t, steps=2) for w, t in zip(path.W, path.T_x, strict=True)]
            )
            shift = result.delta_x.to_numpy()
            worst.append(largest(shift, truth, float(np.ptp(truth))))
            ax.plot(truth * 1e6, path.T_x / (MU * W), lw=2.5, color="0.75")
            ax.plot(shift * 1e6, path.T_x / (MU * W), lw=0.8)
            ax.set_title(f"{100 * worst[-1]:.2f} %", fontsize=9)
        figure.supxlabel(r"$\delta_x$ [µm]")
        figure.supylabel(r"$T_x/(\mu W_{max})$")
        figure.savefig(file)
        plt.close(figure)
    return f"shift within {100 * max(worst):.2f} % of its range"


def ellipse(file: Path, n: int) -> str:
    """Ellipses of Hertz and their stick zones, nu = 0."""
    part = 0.4 ** (1 / 3)
    with fret.plot.style():
        figure, axes = plt.subplots(1, 4, figsize=(11, 3.1))
        for ax, ratio in zip(axes, (1.0, 2.8, 11.8, 116.0), strict=True):
            hertz = fret.reference.hertz_ellipse(R_x=ratio * R, R_y=R, E_star=CORK.E / 2, W=W)
            d = (2.3 * hertz.a_x / n, 2.3 * hertz.a_y / n)
            scene = fret.Scene(
                body1=fret.Body(CORK, shape=fret.shapes.Ellipsoid(R_x=ratio * R, R_y=R)),
                body2=fret.Body(CORK),
                friction=MU,
                grid=fret.Grid.from_spacing((n, n), d),
                path=fret.LoadPath.start()
                .normal(W, increments=1)
                .tangential(0.6 * MU * W, increments=1),
            )
            end = solved(scene).at(2)
            x, y = end.p.x.to_numpy() / hertz.a_x, end.p.y.to_numpy() / hertz.a_y
            zones = end.contact.to_numpy().astype(int) + end.stick.to_numpy().astype(int)
            ax.pcolormesh(x, y, zones.T, cmap="Greys", vmax=3, shading="nearest")
            angle = np.linspace(0, 2 * math.pi, 200)
            ax.plot(np.cos(angle), np.sin(angle))
            ax.plot(part * np.cos(angle), part * np.sin(angle))
            ax.set(
                aspect="equal", xlabel="$x/a_x$", title=f"$a_x/a_y$ = {hertz.a_x / hertz.a_y:.1f}"
            )
        axes[0].set_ylabel("$y/a_y$")
        figure.savefig(file)
        plt.close(figure)
    return "contact and stick ellipses drawn over their closed forms"


def bulk(file: Path, n: int) -> str:
    """Cattaneo with a bulk stress in phase, and the stress below."""
    T = 0.6 * MU * LINE_W
    worst = far = 0.0
    with fret.plot.style():
        figure, (shear, stress, error) = plt.subplots(1, 3, figsize=(11.8, 3.5))
        for part in (-0.3, 0.0, 0.3):
            _, line = cylinder(fret.LoadPath.start(), n=4)
            sigma_B = part * 4 * MU * line.p0
            path = fret.LoadPath.start().normal(LINE_W, increments=1)
            path = path.force(T_x=T, sigma_B=sigma_B, increments=10)
            end = solved(cylinder(path, n=n)[0]).at(11)
            x = end.p.x.to_numpy()
            middle = line.stick_middle(eps_x=sigma_B * (1 - STEEL.nu**2) / STEEL.E, mu=MU)
            truth = line.q(x, T=T, mu=MU, middle=middle)
            q = end.q_x.to_numpy()[:, 0]
            worst = max(worst, float(np.linalg.norm(q - truth) / np.linalg.norm(MU * line.p(x))))
            (drawn,) = shear.plot(
                x / line.a,
                truth / (MU * line.p0),
                label=rf"$\sigma_B = {sigma_B / (MU * line.p0):.1f}\,\mu p_0$",
            )
            shear.plot(x / line.a, q / (MU * line.p0), ".", ms=3, color=drawn.get_color())
        shear.set(xlabel="$x/a$", ylabel=r"$q_x/(\mu p_0)$")
        shear.legend(fontsize=8)
        path = fret.LoadPath.start().normal(LINE_W, increments=1).tangential(T, increments=1)
        scene, line = cylinder(path, n=n)
        end = solved(scene).at(2)
        for z in (0.1, 0.5, 1.0):
            below = end.stress(z=[z * line.a], y=0.0)
            x = below.s_xx.x.to_numpy()
            s_xx = np.asarray(below.s_xx).ravel()
            truth = np.asarray(line.stress(x, z * line.a, T=T, mu=MU)[0])
            (drawn,) = stress.plot(x / line.a, truth / line.p0, lw=0.8, label=f"z = {z} a")
            # Every eighth sample, beside the line that all of them would hide.
            some = slice(None, None, 8)
            color = drawn.get_color()
            stress.plot(x[some] / line.a, s_xx[some] / line.p0, "o", ms=4, mfc="none", color=color)
            off = np.abs(s_xx - truth) / line.p0
            error.semilogy(x / line.a, np.maximum(off, 1e-8), lw=0.8, color=color)
            far = max(far, float(off.max()) if z >= 0.5 else 0.0)
        stress.set(xlabel="$x/a$", ylabel=r"$\sigma_{xx}/p_0$")
        stress.legend(fontsize=8)
        shear.set_title("Cattaneo with a bulk stress")
        stress.set_title("McEwen, partial slip")
        error.set(xlabel="$x/a$", ylabel=r"difference of $\sigma_{xx}$ over $p_0$")
        error.set_title(f"difference, {n} cells")
        figure.savefig(file)
        plt.close(figure)
    return (
        f"shear within {100 * worst:.2f} % of mu p in the L2 norm, stress from a/2 down within "
        f"{far:.1e} p_0"
    )


def rolling(file: Path, n: int) -> str:
    """From Cattaneo's stick zone to Carter's."""
    T = 0.6 * MU * LINE_W
    scene, line = cylinder(fret.LoadPath.start(), n=n)
    way = 5 * n // 3
    dx = scene.grid.dx
    path = fret.LoadPath.start().normal(LINE_W, increments=1).tangential(T, increments=1)
    path = path.force(rolled=way * dx, increments=way)
    moments = [2, 2 + way // 16, 2 + way // 6, 2 + way]
    result = fret.solve(scene.replace(path=path), save=moments, progress=False)
    c = line.stick_half_width(T=T, mu=MU)
    truth = MU * (line.a - c) / R
    rolled = result.dataset.rolled.to_numpy()
    creep = np.diff(result.delta_x.to_numpy()) / dx
    with fret.plot.style():
        figure, (shear, slope) = plt.subplots(1, 2, figsize=(9.6, 3.5))
        for moment in moments:
            at = result.at(moment)
            x = at.p.x.to_numpy()
            shear.plot(
                x / line.a,
                at.q_x.to_numpy()[:, 0] / (MU * line.p0),
                label=f"rolled {rolled[moment - 1] / line.a:.1f} a",
            )
        for middle, name in ((0.0, "Cattaneo"), (line.a - c, "Carter")):
            q = line.q(x, T=T, mu=MU, middle=middle)
            shear.plot(x / line.a, q / (MU * line.p0), "k--", lw=0.8, label=name)
        shear.set(xlabel="$x/a$", ylabel=r"$q_x/(\mu p_0)$", title="rolling to the right")
        shear.legend(fontsize=8, loc="center left", bbox_to_anchor=(1.0, 0.5))
        slope.plot(rolled[2:] / line.a, creep[1:] / truth)
        slope.axhline(1.0, color="k", ls="--", lw=0.8)
        slope.set(xlabel="way rolled over $a$", ylabel="creepage over Carter's")
        slope.set_ylim(bottom=0.0)
        figure.savefig(file)
        plt.close(figure)
    return f"creepage at the end {creep[-1] / truth:.4f} of Carter's"


def friction(file: Path, n: int) -> str:
    """Force against shift under several friction laws, full gross-slip loops."""
    hertz = fret.reference.hertz(R=R, bodies=(CORK, CORK), W=W)
    far = 7e-6
    path = fret.LoadPath.start().normal(W, increments=1)
    for delta in (far, -far, far):
        path = path.displace(delta_x=delta, increments=40)
    laws: dict[str, float | fret.Friction] = {
        "constant": MU,
        "static 0.3, kinetic 0.2": fret.Friction(MU, kinetic=0.2),
        "grows with the slip": fret.Friction(
            MU, history=(fret.History.SLIP, [(0.0, 1.0), (4 * far, 1.6)])
        ),
        "falls with the energy": fret.Friction(
            MU,
            history=(fret.History.DISSIPATED, [(0.0, 1.0), (4 * far * MU * hertz.p0, 0.6)]),
        ),
    }
    ends = []
    with fret.plot.style():
        figure, axes = plt.subplots(1, 4, figsize=(11.4, 3.1), sharey=True)
        for ax, (name, law) in zip(axes, laws.items(), strict=True):
            result = solved(sphere(CORK, path, n=n, mu=law))
            ax.plot(result.delta_x * 1e6, result.dataset.T_x / W)
            ax.set(title=name, xlabel=r"$\delta_x$ [µm]")
            ends.append(float(result.dataset.T_x[-1] / W))
        axes[0].set_ylabel("$T_x/W$")
        figure.savefig(file)
        plt.close(figure)
    return "T_x/W at the end: " + ", ".join(f"{end:.3f}" for end in ends)


def oblique(file: Path, n: int) -> str:
    """W and T_x = W/5 growing together from nothing: no slip, q = p/5 in every cell."""
    k, worst = 0.2, 0.0
    with fret.plot.style():
        figure, axes = plt.subplots(1, 2, figsize=(8.8, 3.5), sharey=True)
        for ax, entering in zip(axes, (True, False), strict=True):
            for increments in (1, 5, 20):
                path = fret.LoadPath.start().force(W=W, T_x=k * W, increments=increments)
                settings = fret.Settings(tolerance=1e-9, cell_entry_correction=entering)
                scene = sphere(CORK, path, n=n).replace(settings=settings)
                at = solved(scene).at(-1)
                hertz = at.scene.hertz
                assert hertz is not None
                middle = n // 2
                x, q = at.p.x.to_numpy() / hertz.a, at.q_x.to_numpy()
                label = f"{increments} increment" + ("s" if increments > 1 else "")
                ax.plot(x, q[:, middle] / (k * hertz.p0), ".-", ms=3, lw=0.8, label=label)
                if entering:
                    worst = max(worst, largest(q, k * at.p.to_numpy(), k * hertz.p0))
            fine = np.linspace(-1, 1, 301)
            ax.plot(fine, np.sqrt(1 - fine**2), "k--", lw=0.8, label="$k\\,p$ of Hertz")
            ax.set(xlabel="$x/a$", title="entering cells " + ("on" if entering else "off"))
            ax.legend(fontsize=8)
        axes[0].set_ylabel("$q_x/(k\\,p_0)$")
        figure.savefig(file)
        plt.close(figure)
    return f"q within {worst:.1e} of k p, over k p_0"


def radial(file: Path, n: int) -> str:
    """Fretting mode II: a sphere on a rigid plane, W up, down and up again; all is round."""
    a = fret.reference.hertz(R=R, bodies=(STEEL, fret.RIGID), W=W).a
    path = fret.LoadPath.start().force(W=W, increments=40, spacing=fret.Spacing.EQUAL_RADIUS)
    path = path.radial([0.5 * W, W], increments=60)
    scene = fret.Scene(
        body1=fret.Body(STEEL, shape=fret.Sphere(R=R)),
        body2=fret.Body(fret.RIGID),
        friction=MU,
        grid=fret.Grid.centred(width=2.3 * a, n=n),
        path=path,
    )
    result = solved(scene)
    hertz = scene.hertz
    assert hertz is not None
    saved = [int(m) for m in result.dataset.saved_increment.values]
    worst = 0.0
    with fret.plot.style():
        figure, ax = plt.subplots(figsize=(5.4, 3.5))
        for moment, name in zip(saved, ("pressed", "half unloaded", "pressed again"), strict=True):
            at = result.at(moment)
            x, y = at.p.x.to_numpy()[:, None], at.p.y.to_numpy()[None, :]
            r = np.hypot(x, y)
            inwards = -(at.q_x.to_numpy() * x + at.q_y.to_numpy() * y) / r
            round_about = (at.q_y.to_numpy() * x - at.q_x.to_numpy() * y) / r
            worst = max(worst, float(np.abs(round_about).max()))
            inside = at.p.to_numpy() > 0
            radius, traction = r[inside] / hertz.a, inwards[inside] / (MU * hertz.p0)
            ax.plot(radius, traction, ".", ms=2, label=name)
        ax.set(xlabel="$r/a$", ylabel=r"$q_r/(\mu p_0)$, inwards on the plane")
        ax.legend()
        figure.savefig(file)
        plt.close(figure)
    return f"shear round about at most {worst / (MU * hertz.p0):.1e} mu p_0"


FIGURES: Figures = {
    "torsion": (torsion, 256),
    "any_path": (any_path, 40),
    "ellipse": (ellipse, 96),
    "bulk_stress": (bulk, 256),
    "rolling": (rolling, 240),
    "friction": (friction, 48),
    "oblique": (oblique, 64),
    "radial": (radial, 96),
}


if __name__ == "__main__":
    draw(FIGURES, prefix="loads", description="Loads against closed forms.")
