"""``python -m pyfret``: every command of ``fret``."""

import sys

from pyfret._cli import NEEDS_PYTHON, main

if __name__ == "__main__":
    # The compiled command hands these to ``python -m pyfret``: they must not go back to it.
    if set(sys.argv[1:2]) & NEEDS_PYTHON:
        from pyfret._cli import commands

        sys.exit(commands.main())
    main()
