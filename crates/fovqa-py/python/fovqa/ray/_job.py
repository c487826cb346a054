"""What driver and workers know of the units of a run, and the files that they share."""

from __future__ import annotations

import json
import os
import platform
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

#: How often a unit is tried before it is given up.
TRIES = 3
#: The folder of the units in that of the results.
UNITS = "units"
#: What the units of a run have in common.
_MANIFEST = "units.json"
_SCHEMA = "fovqa.units/1"
#: How often a unit was tried, and what came of it.
_RECORD = "unit.json"
_FOLDER = re.compile(r"\d{5,}-of-\d{5,}")


@dataclass(frozen=True)
class Job:
    """What all workers need to know."""

    call: str
    """A name for this call, by which the tries of earlier calls are told from its own."""
    path: str
    """The absolute path of the experiment file."""
    text: str
    """Its text."""
    frames: str | None
    maps: str | None
    lock: bool
    threads: int
    """Threads of a worker."""
    fingerprint: str
    """Of the experiment and the frames that were found."""
    resume: bool
    """Whether the results of earlier calls are of this experiment."""


def rows(folder: Path, units: int) -> Iterator[dict[str, Any]]:
    """The units as rows of a data set, which have paths and parameters, never pixels."""
    for unit in range(1, units + 1):
        yield {"unit": unit, "shard": f"{unit}/{units}", "folder": str(folder / _name(unit, units))}


def _name(unit: int, units: int) -> str:
    return f"{unit:05}-of-{units:05}"


def _write_json(path: Path, value: Any) -> None:
    """Writes a file so that readers see the old one or the new one."""
    temporary = path.with_suffix(f".{os.getpid()}.tmp")
    temporary.write_text(json.dumps(value) + "\n", encoding="utf-8")
    temporary.replace(path)


def _read_json(path: Path) -> dict[str, Any]:
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def known_units(folder: Path, fingerprint: str) -> int | None:
    """The number of units of an earlier call for the same experiment and frames.

    Parameters
    ----------
    folder
        The folder of the units.
    fingerprint
        Of the experiment and the frames that were found.

    Returns
    -------
    int or None
        None if there was no such call.
    """
    manifest = _read_json(folder / _MANIFEST)
    units = manifest.get("units")
    is_same = manifest.get("schema") == _SCHEMA and manifest.get("fingerprint") == fingerprint
    return units if is_same and isinstance(units, int) and units > 0 else None


def begin_units(folder: Path, units: int, fingerprint: str) -> None:
    """Writes the number of units, and removes units of another division.

    Parameters
    ----------
    folder
        The folder of the units.
    units
        Their number.
    fingerprint
        Of the experiment and the frames that were found.
    """
    _write_json(folder / _MANIFEST, {"schema": _SCHEMA, "units": units, "fingerprint": fingerprint})
    own = {_name(unit, units) for unit in range(1, units + 1)}
    with os.scandir(folder) as entries:
        for entry in entries:
            if _FOLDER.fullmatch(entry.name) and entry.name not in own and entry.is_dir(follow_symlinks=False):
                shutil.rmtree(entry.path, ignore_errors=True)


class UnitRecord:
    """How often this call has tried a unit. It is a file, so that the death of a worker is counted as well."""

    def __init__(self, folder: str, call: str) -> None:
        self._path = Path(folder) / _RECORD
        self._call = call
        found = _read_json(self._path)
        is_own = found.get("call") == call
        self.tries: int = found.get("tries", 0) if is_own else 0
        self.outcome: dict[str, Any] | None = found.get("outcome") if is_own else None
        """What came of it, if it is finished."""

    def begin(self) -> None:
        """Counts a try."""
        self.tries += 1
        self._path.parent.mkdir(parents=True, exist_ok=True)
        # Who looks for what hangs finds the process here.
        place = {"host": platform.node(), "pid": os.getpid()}
        _write_json(self._path, {"call": self._call, "tries": self.tries, **place})

    def finish(self, outcome: dict[str, Any]) -> None:
        """Keeps what came of the unit."""
        self.outcome = outcome
        _write_json(self._path, {"call": self._call, "tries": self.tries, "outcome": outcome})
