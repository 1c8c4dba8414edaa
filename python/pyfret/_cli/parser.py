"""The command line of the commands in Python: help and errors as the compiled ones have them."""

from __future__ import annotations

import argparse
import sys
import textwrap
from typing import TYPE_CHECKING, Any, NoReturn

from pyfret._cli.printing import print_message
from pyfret._util.window import window_width, wrap

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["Parser", "added"]

#: Columns of a line of help at most.
WIDEST = 100
#: Columns of the names of options, of which longer ones stand on a line of their own.
NAMES = 26


class Parser(argparse.ArgumentParser):
    """A parser whose help is a sentence, the usage, the arguments and the options."""

    def __init__(self, **keywords: Any) -> None:
        super().__init__(**{**keywords, "add_help": False, "allow_abbrev": False})
        self.add_argument("-h", "--help", action="help", help="print help")

    def parse_known_args(  # type: ignore[override]
        self, args: Any = None, namespace: Any = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse the arguments; a command names those that it does not know, with its own usage."""
        parsed, unknown = super().parse_known_args(args, namespace)
        if unknown and self._commands() is None:
            self.error(f"unexpected argument '{unknown[0]}' found")
        return parsed, unknown

    def format_usage(self) -> str:
        """The usage in a line."""
        needed = [a for a in self._actions if a.option_strings and a.required]
        needed_options = [f"{a.option_strings[-1]} {value(a)}" for a in needed]
        places = [value(a) for a in self._positionals_alone()]
        options = [] if self._commands() is not None else ["[OPTIONS]"]
        command = [] if options else ["<COMMAND>"]
        words = ["Usage:", self.prog, *options, *needed_options, *places, *command]
        return wrap(" ".join(words), width_of_help()) + "\n"

    def format_help(self) -> str:
        """Format the help of the command: purpose, usage, arguments."""
        purpose = textwrap.wrap(sentence(self.description or ""), width_of_help())
        parts = [*purpose, "", self.format_usage()]
        commands = self._commands()
        if commands is not None:
            rows = [(f"  {a.dest}", sentence(a.help or "")) for a in commands]
            parts += ["Commands:", *table(rows), ""]
        elif self._positionals_alone():
            rows = [(f"  {value(a)}", meaning(a)) for a in self._positionals_alone()]
            parts += ["Arguments:", *table(rows), ""]
        options = [a for a in self._actions if a.option_strings]
        # As the others have it, help is the last.
        options.sort(key=lambda a: "--help" in a.option_strings)
        parts += ["Options:", *table([(names(a), meaning(a)) for a in options])]
        if self.epilog:
            parts += ["", *textwrap.wrap(self.epilog, width_of_help())]
        return "\n".join(parts) + "\n"

    def error(self, message: str) -> NoReturn:
        """Say what is wrong, how the command is called and where more stands."""
        text = f"error: {message}\n\n{self.format_usage()}\nFor more information, try '--help'."
        print_message(text)
        self.exit(2)

    def _print_message(self, message: str, file: Any = None) -> None:
        """Write a message to a stream, by default to the standard error if there is one."""
        # Without a standard error, as under pythonw, nothing is printed.
        stream = file or sys.stderr
        if message and stream is not None:
            stream.write(message)

    def _positionals_alone(self) -> list[argparse.Action]:
        """Return the positional arguments, without commands."""
        return [
            a
            for a in self._actions
            if not a.option_strings and not isinstance(a, argparse._SubParsersAction)
        ]

    def _commands(self) -> Iterable[argparse.Action] | None:
        """Return the commands of this parser; None if it has none."""
        subparsers = (a for a in self._actions if isinstance(a, argparse._SubParsersAction))
        return next((a._choices_actions for a in subparsers), None)


def added(
    commands: argparse._SubParsersAction[Any], name: str, does: str
) -> argparse.ArgumentParser:
    """Add a command that does something."""
    command: argparse.ArgumentParser = commands.add_parser(name, help=does, description=does)
    return command


def width_of_help() -> int:
    """Columns of a line of help."""
    return min(window_width(), WIDEST)


def sentence(text: str) -> str:
    """A help text with a capital at its beginning; argparse writes a per cent sign twice."""
    return (text[:1].upper() + text[1:]).replace("%%", "%")


def value(action: argparse.Action) -> str:
    """Return the placeholder of an argument or an option."""
    name = action.metavar if isinstance(action.metavar, str) else action.dest
    name = f"<{name.upper() if action.metavar is None else name}>".replace("_", "-")
    return name if action.option_strings or action.nargs != "?" else f"[{name[1:-1]}]"


def names(action: argparse.Action) -> str:
    """Return the names of an option with its value, ``--set KEY=VALUE``."""
    short = [name for name in action.option_strings if not name.startswith("--")]
    long = [name for name in action.option_strings if name.startswith("--")]
    text = f"  {short[0]}, " if short else "      "
    text += long[0] if long else ""
    return text if action.nargs == 0 else f"{text} {value(action)}"


def meaning(action: argparse.Action) -> str:
    """Describe an argument: its meaning, default and choices."""
    text = sentence(action.help or "")
    default = action.default
    if default not in (None, False, argparse.SUPPRESS, []) and "default" not in text.lower():
        text += f" [default: {default}]"
    if action.choices is not None:
        text += f" [possible values: {', '.join(str(choice) for choice in action.choices)}]"
    return text.strip()


def table(rows: list[tuple[str, str]]) -> list[str]:
    """Return lines of names with their meanings beside them, or below where a name is long."""
    width = min(max((len(name) for name, _ in rows), default=0) + 2, NAMES)
    lines = []
    for name, text in rows:
        wrapped = textwrap.wrap(text, width_of_help() - width) or [""]
        if len(name) + 2 > width:
            lines.append(name)
            lines += [" " * width + line for line in wrapped]
        else:
            lines.append(name.ljust(width) + wrapped[0])
            lines += [" " * width + line for line in wrapped[1:]]
    return [line.rstrip() for line in lines]
