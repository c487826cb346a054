"""The command ``fovqa``, also as ``python -m fovqa``."""

from __future__ import annotations

import sys

from ._native import command


def main() -> int:
    """Run the command with the arguments of this process.

    Returns
    -------
    int
        The exit code.
    """
    return command(["fovqa", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
