"""``python -m pyfret``: the commands that need Python."""

import sys

from pyfret._cli.commands import main

if __name__ == "__main__":
    sys.exit(main())
