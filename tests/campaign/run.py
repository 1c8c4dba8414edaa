"""Runs scenes of the campaign: ``python tests/campaign/run.py FIRST COUNT``.

Says what became of them, and names the scenes that failed or violate an equation; with ``--json``
each line is a scene: its seed, what became of it, the seconds it took. With ``--whole`` layers have
bonds that give way, and of every result heat, cracks and wear follow, some under laws of the user
(:mod:`follow`). Scenes run in processes of their own, so that one that does not end can be ended.
"""

from __future__ import annotations

import json
import os
import select
import subprocess
import sys
import time
import warnings
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

#: Seconds that a scene may take.
LIMIT = 60.0


def fate(seed: int, *, whole: bool = False) -> dict[str, object]:
    """Solve the scene of a seed and evaluate it; return the outcome."""
    from audit import Audit
    from draw import draw
    from follow import follows

    import pyfret as fret

    text = draw(seed, bonds=whole)
    after: dict[str, str] = {}
    worst: dict[str, tuple[float, int]] = {}
    number = 0
    try:
        audit = Audit(text)
        for increment in fret.march(audit.scene):
            number += 1
            for name, off in audit.look(increment).items():
                if off > worst.get(name, (0.0, 0))[0]:
                    worst[name] = (off, number)
        if whole:
            after = dict(follows(audit.scene, seed))
    except fret.errors.InvalidSceneError as error:
        kind = "off grid" if isinstance(error, fret.errors.OffGridError) else "refused"
        return {"fate": kind, "why": str(error), "worst": worst, "increment": number}
    except fret.errors.SlidingError as error:
        return {"fate": "beyond friction", "why": str(error), "worst": worst, "increment": number}
    except fret.errors.NoConvergenceError as error:
        return {"fate": "not converged", "why": str(error), "worst": worst, "increment": number}
    except BaseException as error:
        kind = type(error).__name__
        return {"fate": f"raised {kind}", "why": str(error), "worst": worst, "increment": number}
    return {"fate": "solved", "why": "", "worst": worst, "increment": number, "after": after}


def work(first: int, last: int, stride: int, *, whole: bool) -> None:
    """Tells of each scene before and after it."""
    warnings.simplefilter("ignore")
    for seed in range(first, last, stride):
        print(json.dumps({"seed": seed}), flush=True)
        begun = time.process_time()
        item = fate(seed, whole=whole)
        print(
            json.dumps({"seed": seed, **item, "seconds": time.process_time() - begun}), flush=True
        )


@dataclass
class Worker:
    """A process that works through its share of the scenes."""

    process: subprocess.Popen[bytes]
    #: The scene that it is at, or the next one.
    seed: int
    #: Its processor time when that began, and the time [s].
    begun: tuple[float, float]
    #: The part of a line that it has written so far.
    remainder: bytes = b""

    def spent(self) -> tuple[float, float]:
        """Processor time so far, and the time [s]."""
        stat = Path(f"/proc/{self.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        ticks = int(stat[11]) + int(stat[12])
        return ticks / os.sysconf("SC_CLK_TCK"), time.monotonic()

    def end(self) -> None:
        """Ends it, whatever it is at."""
        self.process.kill()
        with self.process:
            pass

    def is_over(self, limit: float) -> bool:
        """Whether its scene takes too long: processor time, or ten times as much of any time."""
        work, all_of_it = (now - then for now, then in zip(self.spent(), self.begun, strict=True))
        return work > limit or all_of_it > 10 * limit


def campaign(
    first: int, count: int, limit: float = LIMIT, *, whole: bool = False
) -> Iterator[dict[str, object]]:
    """Yield the outcomes of `count` scenes as they end, from two processes."""
    stride, last = 2, first + count
    environment = os.environ | {"RAYON_NUM_THREADS": "1"}
    starts = [first + k for k in range(stride)]
    running: list[Worker] = []
    while starts or running:
        for start in (seed for seed in starts if seed < last):
            command = [sys.executable, __file__, "work", str(start), str(last), str(stride)]
            command += ["--whole"] if whole else []
            process = subprocess.Popen(command, stdout=subprocess.PIPE, env=environment)
            running.append(Worker(process, start, (0.0, time.monotonic())))
        starts = []
        select.select([w.process.stdout for w in running], [], [], 1.0)
        for worker in list(running):
            pipe = worker.process.stdout
            assert pipe is not None
            how = ""
            if select.select([pipe], [], [], 0)[0]:
                data = os.read(pipe.fileno(), 1 << 16)
                *lines, worker.remainder = (worker.remainder + data).split(b"\n")
                for line in lines:
                    answer = json.loads(line)
                    worker.seed, worker.begun = int(answer["seed"]), worker.spent()
                    if "fate" in answer:
                        yield answer
                        worker.seed += stride
                if data:
                    continue
                how = "ended the process"
            elif worker.is_over(limit):
                how = f"over {limit:g} s"
            else:
                continue
            worker.end()
            running.remove(worker)
            if worker.seed < last:
                yield {"seed": worker.seed, "fate": how, "worst": {}}
                starts.append(worker.seed + stride)


#: Fates that are right wherever they come from what a scene asks for.
RIGHT = ("solved", "off grid", "refused", "beyond friction")


def summarise(outcomes: list[dict[str, object]]) -> tuple[list[str], bool]:
    """Summarise the outcomes in lines; return them and whether all are right."""
    fates = Counter(str(item["fate"]) for item in outcomes)
    lines = [f"{n:6d} {fate}" for fate, n in fates.most_common()]
    followed = Counter(
        f"{name} {'refused' if why else 'found'}"
        for item in outcomes
        for name, why in dict(item.get("after") or {}).items()  # type: ignore[call-overload]
    )
    lines += [f"{n:6d} {label}" for label, n in sorted(followed.items())]
    wrong = [item for item in outcomes if item["fate"] not in RIGHT]
    lines += [f"scene {item['seed']}: {item['fate']}: {item.get('why', '')}" for item in wrong]
    for item in outcomes:
        worst = item["worst"]
        assert isinstance(worst, dict)
        off = {name: at for name, at in worst.items() if at[0] > 1}
        lines += [
            f"scene {item['seed']}: {name} {by:.3g} times what is allowed, increment {number}"
            for name, (by, number) in off.items()
        ]
        wrong += [item] if off else []
    return lines, not wrong


if __name__ == "__main__":
    if sys.argv[1] == "work":
        work(*(int(n) for n in sys.argv[2:5]), whole="--whole" in sys.argv)
    else:
        outcomes = []
        whole = "--whole" in sys.argv
        for outcome in campaign(int(sys.argv[1]), int(sys.argv[2]), whole=whole):
            outcomes.append(outcome)
            if "--json" in sys.argv:
                print(json.dumps(outcome), flush=True)
        lines, right = summarise(outcomes)
        print("\n".join(lines))
        sys.exit(not right)
