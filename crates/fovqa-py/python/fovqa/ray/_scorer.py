"""What a worker does."""

from __future__ import annotations

import json
import platform
import time
from typing import Any

from .. import _native, set_threads
from .._errors import FovqaError
from ._job import TRIES, Job, UnitRecord

#: How long a worker waits before it tries a unit again, in seconds: a disk may come back.
_PAUSES_S = (0.5, 5.0)


class Scorer:
    """Finds the frames of an experiment once, and scores one unit after another."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self._host = platform.node()
        self._fault = ""
        """Why no unit can be scored here."""
        try:
            set_threads(job.threads)
            self._sharded = _native.Sharded(job.path, job.text, frames=job.frames, maps=job.maps, lock=job.lock)
            if self._sharded.fingerprint != job.fingerprint:
                self._fault = "the frames that are found here, or the version of fovqa, differ from those of the driver"
        except FovqaError as error:
            self._fault = str(error)

    def __call__(self, row: dict[str, Any]) -> dict[str, str]:
        # Columns with lists that may be empty have no type of their own, but text has.
        return {"outcome": json.dumps(self._score(row))}

    def _score(self, row: dict[str, Any]) -> dict[str, Any]:
        outcome: dict[str, Any] = {"unit": row["unit"], "host": self._host, "fault": self._fault}
        if self._fault:
            return outcome
        try:
            record = UnitRecord(row["folder"], self._job.call)
            # The unit is finished, but the worker died before it had said so.
            if record.outcome is not None:
                return record.outcome
            failed = f"its worker died each of the {TRIES} times that it was tried"
            while record.tries < TRIES:
                record.begin()
                begin, cpu = time.time(), time.process_time()
                try:
                    resume = self._job.resume or record.tries > 1
                    found = self._sharded.score(row["shard"], row["folder"], resume=resume)
                except Exception as error:
                    failed = str(error)
                    if record.tries < TRIES:
                        time.sleep(_PAUSES_S[record.tries - 1])
                    continue
                outcome |= {"begin": begin, "end": time.time(), "cpu_s": time.process_time() - cpu}
                outcome |= {key: found[key] for key in ("scored", "known", "errors", "warnings")}
                outcome["tries"] = record.tries
                record.finish(outcome)
                return outcome
            # If the worker dies later, the unit is not tried again, and the reason stays.
            record.finish(outcome | {"failed": failed})
        except OSError as error:
            failed = str(error)
        return outcome | {"failed": failed}
