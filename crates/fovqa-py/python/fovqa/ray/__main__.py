"""``python -m fovqa.ray EXPERIMENT``: runs an experiment on Ray."""

from __future__ import annotations

import argparse
import os
import sys
import time
import warnings

from .._errors import FovqaError, FovqaWarning, InputError, RequestError
from ._driver import run_units

_EPILOG = """\
Without RAY_ADDRESS, Ray is started on this machine and stopped at the end; with it, its cluster is used. Interrupted
or failed, the same command goes on: units that are finished stay in DIR/units. docs/cluster.md has more.

Exit codes: 0 done; 2 the experiment file or the command line is wrong; 3 an input is missing, unreadable or does not
fit, a unit could not be scored in three tries, or the output cannot be written; 70 a bug in fovqa; 130 interrupted.
"""
#: How often progress is printed, in seconds, where it is not overwritten.
_BETWEEN_S = 10.0


def _arguments(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="python -m fovqa.ray",
        description="Run an experiment on Ray, with the results of `fovqa run`.",
        epilog=_EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("experiment", metavar="EXPERIMENT", help="the experiment file")
    parser.add_argument("--output", metavar="DIR", help="folder for the results [default: reports/NAME]")
    parser.add_argument("--workers", type=int, metavar="N", help="number of workers [default: for all cores]")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="threads of a worker [default: 1]")
    parser.add_argument(
        "--frames-per-unit",
        type=int,
        metavar="N",
        help="about how many frames a unit has [default: 16, or 64 with metrics over time]",
    )
    parser.add_argument("--frames", metavar="A..B:STEP", help="score only these frames of each scene")
    parser.add_argument("--maps", metavar="DIR", help="write maps of each frame")
    parser.add_argument("--no-lock", action="store_true", help="do not lock folders, for file systems without locks")
    return parser.parse_args(arguments)


def _say(kind: str, message: str, help: str = "") -> None:
    print(f"{kind}: {message}", file=sys.stderr)
    if help:
        print(f"  help: {help}", file=sys.stderr)


class _Told:
    """Progress on stderr: one line on a terminal, a line now and then in a log."""

    def __init__(self) -> None:
        self._is_terminal = sys.stderr.isatty()
        self._last = time.monotonic()

    def __call__(self, done: int, total: int, what: str) -> None:
        if self._is_terminal:
            end = "\n" if done == total else ""
            print(f"\r\x1b[K{what} {done}/{total}", end=end, file=sys.stderr, flush=True)
        elif what == "units" and (time.monotonic() - self._last > _BETWEEN_S or done in (0, total)):
            self._last = time.monotonic()
            _say("note", f"{done} of {total} units")


def main(arguments: list[str]) -> int:
    """Run the command.

    Parameters
    ----------
    arguments
        Those of the command line, without the name of the program.

    Returns
    -------
    int
        The exit code.
    """
    given = _arguments(arguments)
    with warnings.catch_warnings():
        warnings.simplefilter("always", FovqaWarning)
        warnings.showwarning = lambda message, *_, **__: _say("warning", str(message))
        try:
            done = run_units(
                given.experiment,
                output=given.output,
                workers=given.workers,
                threads=given.threads,
                frames_per_unit=given.frames_per_unit,
                frames=given.frames,
                maps=given.maps,
                lock=not given.no_lock,
                progress=_Told(),
            )
        except FovqaError as error:
            for message, help in error.complaints:
                _say("error", message, help)
            return 2 if isinstance(error, RequestError) else 3 if isinstance(error, InputError) else 70
        except KeyboardInterrupt:
            _say("note", "interrupted; the same command goes on")
            sys.stderr.flush()
            # Ray may crash when the interpreter ends while it was starting.
            os._exit(130)
    for failure in done.failures:
        _say("error", failure.message, failure.help)
    if done.terminal_table:
        print(done.terminal_table)
    units = "1 unit" if done.units == 1 else f"{done.units} units"
    known = f", {done.known} of them finished before" if done.known else ""
    retried = f", {done.retried} of them in more than one try" if done.retried else ""
    _say("note", f"{units}{known}{retried}, {done.scoring_s:.1f} s; merged in {done.merging_s:.1f} s")
    _say("note", f"{done.folder}: look at {done.report}")
    if done.failures:
        errors = "1 error" if len(done.failures) == 1 else f"{len(done.failures)} errors"
        scored = f"but {done.scored} frames were scored" if done.scored else "and nothing was scored"
        _say("error", f"{errors}, {scored}")
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
