"""Keywords that are no arguments of a call, and the call or key to write instead."""

from __future__ import annotations

__all__ = ["PARTIAL_SLIP", "WRITTEN_ELSEWHERE"]

#: How the closed form of partial slip is made and asked.
PARTIAL_SLIP = (
    "CattaneoMindlin(fret.reference.hertz(R=5e-3, bodies=bodies, W=50.0), bodies=bodies, mu=0.5)"
    ".stick_radius(12.0)"
)

#: Words for what is elastic between a contact and the gauge of its rig.
RIG = (
    *("compliance", "frame", "rig", "spring", "stiffness", "k_rig"),
    *(
        f"{part}_{elasticity}"
        for part in ("frame", "machine", "rig", "spring", "system", "tangential")
        for elasticity in ("compliance", "stiffness")
    ),
)
UNKNOWN = 'unknown={"rig.stiffness": (1e6, 1e8)}'
KNOWN = 'in N/m; a known one belongs to the scene, scene.replace({"rig.stiffness": 9e6})'
IN_SCENE = 'the rig is path.rig("9 N/um"), or scene.replace({"rig.stiffness": 9e6})'
#: Calls that take a scene or its parts, and leave the rig to the path.
WITH_SCENE = (
    *("Scene", "Scene.replace", "march", "resume", "compare", "threshold", "LoadPath.start"),
    *("ball_on_flat", "cylinder_on_flat", "crossed_cylinders", "flat_pad", "rough_on_flat"),
    *("LoadPath.force", "LoadPath.normal", "LoadPath.tangential", "LoadPath.cycles"),
)

#: What to write instead of a keyword that a call does not take, by call and keyword.
WRITTEN_ELSEWHERE: dict[str, dict[str, str]] = {
    "fit": dict.fromkeys(RIG, f"the stiffness of the rig is {UNKNOWN}, {KNOWN}"),
    **dict.fromkeys(
        ("read_loops", "Loops.from_arrays"),
        dict.fromkeys(RIG, f"it is found by fret.fit(scene, loops, {UNKNOWN}), {KNOWN}"),
    ),
    **dict.fromkeys(
        ("read_indentation", "Indentation.from_arrays"),
        dict.fromkeys(RIG, "frame=True makes the compliance of the frame an unknown"),
    ),
    **dict.fromkeys(
        ("read_scar", "Scar.from_arrays", "read_lives"),
        dict.fromkeys(RIG, 'it belongs to the run of wear, wear={"rig_stiffness": 9e6, ...}'),
    ),
    **dict.fromkeys(WITH_SCENE, dict.fromkeys(RIG, IN_SCENE)),
    "run": dict.fromkeys(RIG, 'it is a parameter of the study, {"rig.stiffness": [1e6, 1e8]}'),
    "CattaneoMindlin": dict.fromkeys(
        ("R", "radius", "W", "P", "force", "T", "T_x", "Q", "a", "p_0"),
        f"it takes the normal contact, and its methods the force along x: {PARTIAL_SLIP}",
    ),
    "wear.Wear": dict.fromkeys(
        ("error", "error_bars", "errors"),
        'every run of wear has its errors, worn.error_of("depth") and worn.error_of("volume")',
    ),
    "Result.at": {
        **dict.fromkeys(
            ("branch", "cycle", "loop"),
            "branch n ends at result.at(t=float(result.branches().t[n])); result.loops() has the "
            "last_branch of each cycle",
        ),
        **dict.fromkeys(
            ("frame", "i", "increment", "index", "k", "n", "number", "step"),
            "result.at(3) is the third increment, result.at(-1) the last that kept its fields",
        ),
        **dict.fromkeys(("time", "instant"), "result.at(t=1.5) is a time of the path"),
    },
}
