"""Runs scenes of the campaign: ``python tests/campaign/run.py FIRST COUNT [SECONDS]``.

Each line is a scene: its seed, what became of it, the seconds it took. Scenes run in processes of
their own, so that one that does not end can be ended.
"""

from __future__ import annotations

import json
import os
import select
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

#: Seconds that a scene may take.
LIMIT = 60.0


def fate(seed: int) -> dict[str, object]:
    """What becomes of the scene of a seed."""
    from audit import Audit
    from draw import draw

    import pyfret as fret

    text = draw(seed)
    worst: dict[str, tuple[float, int]] = {}
    number = 0
    try:
        audit = Audit(text)
        for increment in fret.march(audit.scene):
            number += 1
            for name, off in audit.look(increment).items():
                if off > worst.get(name, (0.0, 0))[0]:
                    worst[name] = (off, number)
    except fret.InvalidSceneError as error:
        kind = "off grid" if isinstance(error, fret.OffGridError) else "refused"
        return {"fate": kind, "why": str(error), "worst": worst, "increment": number}
    except fret.SlidingError as error:
        return {"fate": "beyond friction", "why": str(error), "worst": worst, "increment": number}
    except fret.NoConvergenceError as error:
        return {"fate": "not converged", "why": str(error), "worst": worst, "increment": number}
    except BaseException as error:
        kind = type(error).__name__
        return {"fate": f"raised {kind}", "why": str(error), "worst": worst, "increment": number}
    return {"fate": "solved", "why": "", "worst": worst, "increment": number}


def work(first: int, last: int, stride: int) -> None:
    """Tells of each scene before and after it."""
    for seed in range(first, last, stride):
        print(json.dumps({"seed": seed}), flush=True)
        begun = time.monotonic()
        of = fate(seed)
        print(json.dumps({"seed": seed, **of, "seconds": time.monotonic() - begun}), flush=True)


def campaign(first: int, count: int, limit: float = LIMIT) -> list[dict[str, object]]:
    """What became of `count` scenes; two processes at a time."""
    outcomes: list[dict[str, object]] = []
    stride, last = 2, first + count
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    starts = {k: first + k for k in range(stride)}
    running: dict[int, tuple[subprocess.Popen[bytes], bytes, int, float]] = {}
    while starts or running:
        for k, start in list(starts.items()):
            del starts[k]
            if start < last:
                command = [sys.executable, __file__, "work", str(start), str(last), str(stride)]
                process = subprocess.Popen(command, stdout=subprocess.PIPE, env=environment)
                running[k] = (process, b"", start, time.monotonic() + 30)
        pipes = {p.stdout.fileno(): k for k, (p, *_) in running.items() if p.stdout}
        ready, _, _ = select.select(list(pipes), [], [], 1.0)
        for k, (process, rest, seed, since) in list(running.items()):
            pipe = process.stdout.fileno() if process.stdout else -1
            if pipe in ready:
                data = os.read(pipe, 1 << 16)
                *lines, rest = (rest + data).split(b"\n")
                for line in lines:
                    told = json.loads(line)
                    seed, since = int(told["seed"]), time.monotonic()
                    if "fate" in told:
                        outcomes.append(told)
                        seed += stride
                running[k] = (process, rest, seed, since)
                if data:
                    continue
                process.wait()
                del running[k]
                if seed < last:
                    outcomes.append({"seed": seed, "fate": "ended the process", "worst": {}})
                    starts[k] = seed + stride
            elif time.monotonic() - since > limit:
                process.kill()
                process.wait()
                del running[k]
                outcomes.append({"seed": seed, "fate": f"over {limit:g} s", "worst": {}})
                starts[k] = seed + stride
    return sorted(outcomes, key=lambda o: int(str(o["seed"])))


if __name__ == "__main__":
    if sys.argv[1] == "work":
        work(*(int(n) for n in sys.argv[2:5]))
    else:
        for outcome in campaign(int(sys.argv[1]), int(sys.argv[2])):
            print(json.dumps(outcome))
