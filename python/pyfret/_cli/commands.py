"""The commands that need Python: ``fret study`` is ``python -m pyfret study``, and so on."""

from __future__ import annotations

import contextlib
import errno
import importlib
import os
import signal
import sys
import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from pyfret._cli import compare, crack, damage, explore, export, fit, info, table, threshold
from pyfret._cli.parser import Parser, added
from pyfret._cli.printing import print_json, print_message, print_text
from pyfret._cli.values import FIGURES, ending
from pyfret._core import __version__
from pyfret._util.extras import application
from pyfret._util.numbers import format_number
from pyfret.citation import cite as citation_text
from pyfret.citation import sources
from pyfret.fatigue import CRITERIA, Materials, lives
from pyfret.opening import open as open_any
from pyfret.result import Result, open_result
from pyfret.study.file import run_study_file
from pyfret.wear.runs import open_run

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from pyfret.fatigue.judged import Life

#: Exit codes, the same as ``fret``: done; ended early or with failures; bad input; output that
#: could not be written.
DONE, ENDED_EARLY, BAD_INPUT, UNWRITTEN = 0, 1, 2, 3
#: Error codes of the system when no more can be written.
FULL = frozenset((errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO))


def parser() -> argparse.ArgumentParser:
    """Build the parser of the command line with all commands."""
    top = Parser(
        prog="fret",
        description="The commands of fret that need Python: python -m pyfret ...",
        epilog="Exit codes: 0 done; 1 ended early, or a point of a study has no answer; 2 bad "
        "input or bad command line; 3 what was to be written could not be, such as to a full disk",
    )
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    study = added(commands, "study", "solve a scene for many values of its parameters")
    study.add_argument("file", help="study file (TOML)")
    study.add_argument("-o", "--out", help="store (default: the one in the file, or NAME.zarr)")
    study.add_argument("--workers", type=int, help="processes (default: one for each processor)")
    study.add_argument("--scheduler", help="address of a Dask cluster, such as tcp://host:8786")
    study.add_argument("--again", action="store_true", help="also points that failed before")
    study.add_argument(
        "--map",
        type=ending(*FIGURES),
        metavar="FILE",
        help="figure of the first measure, over one parameter or two (.png, .svg, .pdf)",
    )
    compare.add_options(commands)
    explore.add_options(commands)
    export.add_options(commands)
    crack.add_options(commands)
    damage.add_options(commands)
    fit.add_options(commands)
    threshold.add_options(commands)
    info.add_options(commands)
    table.add_options(commands)
    report = added(commands, "report", "write a result as one page for a browser")
    report.add_argument("store", help="result of a run, of wear, of a study, or what save() wrote")
    report.add_argument("-o", "--out", help="page to write (default: NAME.html)")
    report.add_argument("--wear", metavar="STORE", help="result of fret wear, shown as well")
    report.add_argument(
        "--crack", action="store_true", help="show a crack as well, with the options below"
    )
    crack.add_crack(report)
    report.add_argument(
        "--life",
        action="append",
        choices=CRITERIA,
        metavar="CRITERION",
        help="show the life by this criterion as well, of the substrate of --material; "
        "may be given several times",
    )
    verify = added(commands, "verify", "check this installation against closed forms, in minutes")
    cite = added(commands, "cite", "print what to cite for a result")
    cite.add_argument("store", nargs="?", help="result (default: all methods)")
    for command in (study, report, verify, cite):
        command.add_argument("--json", action="store_true", help="print one JSON object")
    for command in commands.choices.values():
        has_json = "--json" in command._option_string_actions
        help_text = "print nothing" + ("; with --json the JSON alone" if has_json else "")
        command.add_argument("-q", "--quiet", action="store_true", help=help_text)
    return top


def study(options: argparse.Namespace) -> int:
    """Run the study of a file and print its outcome."""
    client = None
    if options.scheduler:
        from distributed import Client

        client = Client(options.scheduler)
    try:
        study, store = run_study_file(
            options.file,
            out=options.out,
            executor=client or options.workers,
            again=options.again,
            mapped=options.map is not None,
        )
    except KeyboardInterrupt:
        print_message("fret: stopped; the same command goes on")
        return ENDED_EARLY
    finally:
        if client is not None:
            client.close()
    failed, unanswered = study.failed(), study.unanswered()
    if options.json:
        print_answer(
            store=str(store),
            points=study.count(),
            measures=study.measures,
            failed=[{**values, "reason": reason} for values, reason in failed],
            unanswered=[{**values, "reason": reason} for values, reason in unanswered],
            map=options.map,
            **({} if options.map else {"map_why": "not asked for"}),
        )
    else:
        print_text(f"{store}: {study!r}")
        for values, reason in [*failed, *unanswered]:
            print_text(
                f"{', '.join(f'{k} = {format_number(v)}' for k, v in values.items())}: {reason}"
            )
    if options.map:
        import matplotlib.pyplot as plt

        figure, ax = plt.subplots(layout="constrained")
        study.map(ax=ax)
        figure.savefig(options.map)
    return ENDED_EARLY if failed else DONE


def report(options: argparse.Namespace) -> int:
    """Write the page of a result."""
    page = Path(options.out or Path(options.store).with_suffix(".html").name)
    worn = open_run(options.wear) if options.wear else None
    result = open_any(options.store)
    if not isinstance(result, Result):
        if options.crack or worn is not None:
            raise ValueError(f"{options.store}: --crack and --wear belong to the result of a run")
        if options.life:
            raise ValueError(f"{options.store}: --life belongs to the result of a run")
        result.report(page)
    else:
        cracks = threshold = lives = None
        if options.life:
            lives = lives_of(result, options)
        if options.crack:
            cracks, threshold = crack.cracks_of(result, options), crack.threshold_of(options)
        result.report(page, wear=worn, crack=cracks, threshold=threshold, life=lives)
    size = page.stat().st_size
    if options.json:
        print_answer(page=str(page), bytes=size)
    else:
        print_text(f"{page}: {size / 1e6:.1f} MB")
    return DONE


def lives_of(result: Result, options: argparse.Namespace) -> list[Life]:
    """Return the lives by the criteria that the options name."""
    if options.material is None:
        raise ValueError("--life: needs --material")
    table = Materials(options.materials)
    if options.material not in table:
        raise ValueError(f"--material {options.material}: must be one of {', '.join(table)}")
    judged = lives(
        result,
        table[options.material],
        options.life,
        body_number=options.body,
        cycle=options.cycle,
        residual=options.residual,
    )
    return list(judged.values())


def verify(options: argparse.Namespace) -> int:
    """Compare solutions with closed forms, and print a line for every number."""
    checked = application("pyfret.verification").verify()
    if options.json:
        checks = [
            {
                "what": check.what,
                "source": check.source,
                "ours": check.ours,
                "truth": check.truth,
                "error": check.error,
                "passed": check.passed,
            }
            for check in checked.checks
        ]
        print_answer(passed=checked.passed, checks=checks)
    else:
        print_text(checked)
    return DONE if checked.passed else ENDED_EARLY


def cite(options: argparse.Namespace) -> int:
    """Print the sources to cite, the ones of a result or all."""
    result = open_result(options.store) if options.store else None
    if options.json:
        print_answer(version=__version__, sources=[source._asdict() for source in sources(result)])
    else:
        print_text(citation_text(result))
    return DONE


def print_answer(**answer: object) -> None:
    """Print what came out as one JSON object."""
    print_json(answer, indent=2)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code.

    A closed pipe is no failure; output that cannot be written is one.
    """
    signal.signal(signal.SIGTERM, stop)
    pass_over_matplotlibrc()
    try:
        code = run(arguments)
        sys.stdout.flush()
    except BrokenPipeError:
        leave_output()
        return DONE
    except OSError as error:
        leave_output()
        print_message(f"fret: standard output: {error.strerror}")
        return UNWRITTEN
    return code


def pass_over_matplotlibrc() -> None:
    """Load matplotlib without the settings in the current folder: they may name programs to run.

    Those of the user and of ``MATPLOTLIBRC`` hold.
    """
    if Path("matplotlibrc").exists():
        folder = Path.cwd()
        os.chdir(Path(__file__).parent)
        try:
            importlib.import_module("matplotlib")
        finally:
            os.chdir(folder)


def stop(*_: object) -> None:
    """End as Ctrl-C does: what is done is kept, processes of the study end."""
    raise KeyboardInterrupt


def leave_output() -> None:
    """Keep the interpreter from writing to the standard output once more at its end."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def run(arguments: Sequence[str] | None) -> int:
    """Run a command and return its exit code; errors for people are printed without a traceback."""
    try:
        options = parser().parse_args(arguments)
    except SystemExit as ended:
        return int(ended.code or 0)
    commands = {
        "study": study,
        "compare": compare.run,
        "explore": explore.run,
        "export": export.run,
        "crack": crack.run,
        "damage": damage.run,
        "report": report,
        "verify": verify,
        "cite": cite,
        "fit": fit.run,
        "threshold": threshold.run,
        "info": info.run,
        "workbench": explore.run,
        "table": table.run,
    }
    # What people read; JSON is for programs, and stays.
    quiet = options.quiet and not getattr(options, "json", False)
    warnings.showwarning = say_warning
    try:
        with contextlib.ExitStack() as silence:
            if quiet:
                nowhere = silence.enter_context(Path(os.devnull).open("w", encoding="utf-8"))
                silence.enter_context(contextlib.redirect_stdout(nowhere))
            return commands[options.command](options)
    except BrokenPipeError:
        raise
    except OSError as error:
        prefix = f"{error.filename}: " if error.filename else ""
        print_message(f"fret: {prefix}{error.strerror or error}")
        return UNWRITTEN if error.errno in FULL else BAD_INPUT
    except (ValueError, KeyError, ImportError) as error:
        print_message(f"fret: {' '.join(str(error).split())}")
        return BAD_INPUT
    except (RuntimeError, MemoryError) as error:
        print_message(f"fret: {' '.join(str(error).split()) or 'no memory'}")
        return ENDED_EARLY
    except KeyboardInterrupt:
        print_message("fret: stopped")
        return ENDED_EARLY


def say_warning(message: Warning | str, *_: object, **__: object) -> None:
    """Print a warning as the binary prints its own: without a line of Python."""
    print_message(f"fret: warning: {message}")
