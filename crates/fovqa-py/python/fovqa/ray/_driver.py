"""Divides an experiment into units, has them scored, and merges them."""

from __future__ import annotations

import importlib
import json
import logging
import os
import re
import socket
import time
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from .. import _native
from .._documents import Document, PathLike, document_of, frames_text, warn
from .._errors import InputError, RequestError
from .._progress import Progress, Reporter
from .._run import Run
from ._job import UNITS, Job, begin_units, known_units, rows
from ._scorer import Scorer

#: Frames of a unit, if nothing else is asked for: more where frames before a unit are read again.
_FRAMES_PER_UNIT = 16
_FRAMES_PER_TEMPORAL_UNIT = 64
#: The largest number of shards of a run.
_MOST_UNITS = 10_000
#: Units that a worker gets at a time: Ray's own cost is per block of rows, and each worker gets several blocks.
_MOST_UNITS_PER_BLOCK = 4
_BLOCKS_PER_WORKER = 16
#: The memory of a local Ray's object store. Rows are small.
_OBJECT_STORE_BYTES = 256 << 20
#: How long the head of a cluster may take to answer, in seconds.
_PATIENCE_S = 10.0
#: How many units or warnings are named.
_MOST_NAMED = 10


class UnitsError(InputError):
    """Some units could not be scored. All others are finished, and a second call goes on with them.

    Parameters
    ----------
    failed
        The units, each with the reason.
    """

    def __init__(self, failed: Mapping[str, str]) -> None:
        help = "mend it and call again: finished units are not scored again"
        named = [(f"unit {unit}: {why}", "") for unit, why in list(failed.items())[:_MOST_NAMED]]
        more = len(failed) - len(named)
        if more > 0:
            named.append((f"{more} more units could not be scored", ""))
        named[-1] = (named[-1][0], help)
        super().__init__(named)
        self.failed = dict(failed)
        """The units, each with the reason."""


class ClusterRun(Run):
    """The results of an experiment that was scored in units."""

    def __init__(self, found: Mapping[str, Any], tally: _Tally, merging_s: float) -> None:
        super().__init__(found["folder"], found)
        self.terminal_table: str = found["table"] or ""
        """The first comparison table, as a terminal shows it."""
        self.units: int = tally.units
        """The number of units."""
        self.known: int = tally.known
        """The number of units that an earlier call had finished."""
        self.retried: int = tally.retried
        """The number of units that were tried more than once, because a worker died or for another error."""
        self.scoring_s: float = max(0.0, tally.end - tally.begin)
        """Seconds from the beginning of the first unit to the end of the last one, by the clocks of the workers."""
        self.cpu_s: float = tally.cpu_s
        """CPU seconds of all units."""
        self.merging_s: float = merging_s
        """Seconds that merging and drawing took."""


class _Tally:
    """What came of all units. There may be very many, so nothing is kept of each."""

    def __init__(self) -> None:
        self.units = self.known = self.retried = 0
        self.begin, self.end, self.cpu_s = float("inf"), 0.0, 0.0
        self.warnings: dict[str, None] = {}

    def add(self, outcome: Mapping[str, Any]) -> None:
        self.units += 1
        self.known += 0 < outcome["known"] == outcome["scored"] + outcome["errors"]
        self.retried += outcome["tries"] > 1
        self.begin, self.end = min(self.begin, outcome["begin"]), max(self.end, outcome["end"])
        self.cpu_s += outcome["cpu_s"]
        self.warnings.update(dict.fromkeys(outcome["warnings"]))

    def warn(self) -> None:
        warn(list(self.warnings)[:_MOST_NAMED])
        if len(self.warnings) > _MOST_NAMED:
            warn([f"units have {len(self.warnings) - _MOST_NAMED} more warnings"])


def run(
    experiment: Document,
    *,
    output: PathLike | None = None,
    workers: int | None = None,
    threads: int = 1,
    frames_per_unit: int | None = None,
    frames: str | range | None = None,
    maps: PathLike | None = None,
    lock: bool = True,
    progress: Progress = True,
) -> ClusterRun:
    """Run an experiment on Ray. The results are those of :func:`fovqa.run`, to the byte.

    If Ray is running in this process, it is used. Otherwise this joins the cluster of the environment variable
    ``RAY_ADDRESS`` or, if there is none, starts Ray on this machine and stops it at the end. All nodes must see the
    frames and the results folder under the same paths, and have the same version of fovqa.

    Finished units stay in ``OUTPUT/units``: if a call is interrupted, the next one goes on. ``OUTPUT/values`` has all
    values as Parquet, one file per unit: ``polars.read_parquet("OUTPUT/values/*.parquet")``.

    Parameters
    ----------
    experiment
        The path of an experiment file, or a dict with its keys, whose paths start in the working directory.
    output
        The folder for the results; by default ``reports/NAME``.
    workers
        The number of workers; by default as many as there are cores for.
    threads
        Threads of a worker, which are also the CPUs that it asks Ray for.
    frames_per_unit
        About how many frames a unit has. By default 16, or 64 if a metric or a method needs earlier frames, which are
        read again for each unit; more if there would be more than 10,000 units. A later call for the same output
        keeps the units of the first one unless this is given.
    frames
        Only these frames of each scene, as in :func:`fovqa.run`.
    maps
        A folder for the maps of each frame.
    lock
        Whether to lock folders, so that only one process writes to each.
    progress
        As in :func:`fovqa.run`; it counts units.

    Returns
    -------
    ClusterRun
        The results, with the time that units took. What could not be scored is in ``failures``, and warned of.

    Raises
    ------
    ExperimentError
        If the file has mistakes.
    RequestError
        If an argument is wrong, or a key of the dict.
    UnitsError
        If units could not be scored in three tries, for example because their worker died each time.
    InputError
        If the results cannot be written, or a node does not see the same frames.

    Examples
    --------
    >>> import fovqa.ray
    >>> hall = fovqa.ray.run("hall.toml", output="reports/hall", workers=8)  # doctest: +SKIP
    """
    result = run_units(
        experiment,
        output=output,
        workers=workers,
        threads=threads,
        frames_per_unit=frames_per_unit,
        frames=frames,
        maps=maps,
        lock=lock,
        progress=progress,
    )
    warn(failure.message for failure in result.failures)
    return result


def run_units(
    experiment: Document,
    *,
    output: PathLike | None,
    workers: int | None,
    threads: int,
    frames_per_unit: int | None,
    frames: str | range | None,
    maps: PathLike | None,
    lock: bool,
    progress: Progress,
) -> ClusterRun:
    """As :func:`run`, without a warning for each failure."""
    for name, number in (("workers", workers), ("threads", threads), ("frames_per_unit", frames_per_unit)):
        if number is not None and (not isinstance(number, int) or number < 1):
            raise RequestError([(f"{name} is {number!r}", "give a whole number from 1")])
    document = document_of(experiment)
    if isinstance(document, (str, os.PathLike)):
        document = Path(os.fspath(document)).absolute()
    maps = None if maps is None else str(Path(os.fspath(maps)).absolute())
    found = _native.Sharded(document, frames=frames_text(frames), maps=maps, lock=lock)
    warn(found.foresee())
    folder = Path(os.fspath(output) if output is not None else Path("reports") / found.name).absolute()
    units_folder = folder / UNITS
    # Workers see the folder under its absolute path, and one call at a time writes to it.
    held = _native.Lock(units_folder) if lock else None
    if held is None:
        units_folder.mkdir(parents=True, exist_ok=True)
    try:
        fingerprint = found.fingerprint
        known = known_units(units_folder, fingerprint)
        units = _units(found, frames_per_unit) if frames_per_unit is not None or known is None else known
        job = Job(
            call=uuid.uuid4().hex,
            path=str(found.path),
            text=found.text,
            frames=frames_text(frames),
            maps=maps,
            lock=lock,
            threads=threads,
            fingerprint=fingerprint,
            resume=known == units,
        )
        begin_units(units_folder, units, fingerprint)
        if found.pairs > 0:
            # Nothing of the frames is needed here until they are merged.
            del found
            tally = _score(job, units_folder, units, workers, progress)
        else:
            # Nothing is there to be scored, which the results say.
            tally = _Tally()
            for row in rows(units_folder, units):
                found.score(row["shard"], row["folder"])
        begin = time.monotonic()
        shards = [row["folder"] for row in rows(units_folder, units)]
        with Reporter(progress) as callback:
            merged = _native.merge(job.path, job.text, shards, folder, lock=lock, progress=callback)
        result = ClusterRun(merged, tally, time.monotonic() - begin)
    finally:
        if held is not None:
            held.release()
    warn(result.warnings)
    return result


def _units(found: _native.Sharded, frames_per_unit: int | None) -> int:
    default = _FRAMES_PER_TEMPORAL_UNIT if found.reads_frames_before else _FRAMES_PER_UNIT
    units = -(-found.frames // (frames_per_unit or default))
    return max(1, min(units, found.pairs, _MOST_UNITS))


def _score(job: Job, folder: Path, units: int, workers: int | None, progress: Progress) -> _Tally:
    """Has all units scored, and returns what came of them."""
    tally = _Tally()
    failed: dict[int, str] = {}
    with _started(workers, job.threads) as (ray, workers), Reporter(progress) as callback:
        data: Any = importlib.import_module("ray.data")
        per_block = min(max(units // (_BLOCKS_PER_WORKER * workers), 1), _MOST_UNITS_PER_BLOCK)
        of_units = data.from_items(list(rows(folder, units)), override_num_blocks=-(-units // per_block))
        pool = data.ActorPoolStrategy(size=min(workers, units))
        scored = of_units.map(Scorer, fn_constructor_args=(job,), compute=pool, num_cpus=job.threads)
        if callback is not None:
            callback("units", 0, units)
        try:
            for row in scored.iter_rows():
                outcome = json.loads(row["outcome"])
                if outcome["fault"]:
                    help = "install the same version on all nodes, and let them see the frames under the same paths"
                    raise InputError([(f"{outcome['host']}: {outcome['fault']}", help)])
                if "failed" in outcome:
                    failed[outcome["unit"]] = outcome["failed"]
                else:
                    tally.add(outcome)
                if callback is not None:
                    callback("units", tally.units + len(failed), units)
        except ray.exceptions.RayError as error:
            raise InputError([(f"Ray could not go on: {error}", "call again: finished units are kept")]) from error
    tally.warn()
    if failed:
        raise UnitsError({f"{unit}/{units}": failed[unit] for unit in sorted(failed)})
    return tally


@contextmanager
def _started(workers: int | None, threads: int) -> Iterator[tuple[Any, int]]:
    """Ray, with a number of workers. What was started here is stopped at the end."""
    try:
        ray: Any = importlib.import_module("ray")
        data: Any = importlib.import_module("ray.data")
    except ImportError as error:
        raise RequestError([(f"Ray cannot be imported: {error}", "install it: pip install 'fovqa[ray]'")]) from error
    is_own = not ray.is_initialized()
    if is_own:
        address = os.environ.get("RAY_ADDRESS")
        where = f"the cluster at {address} (RAY_ADDRESS) cannot be joined" if address else "Ray cannot be started here"
        try:
            if address:
                _look_for(address)
                ray.init(log_to_driver=False, logging_level=logging.ERROR)
            else:
                workers = workers or max(1, _cores() // threads)
                ray.init(
                    address="local",
                    num_cpus=workers * threads,
                    object_store_memory=_OBJECT_STORE_BYTES,
                    include_dashboard=False,
                    log_to_driver=False,
                    logging_level=logging.ERROR,
                )
        except KeyboardInterrupt:
            ray.shutdown()
            raise
        except Exception as error:
            help = "start it, or leave RAY_ADDRESS out" if address else "is there enough memory in /dev/shm?"
            raise InputError([(f"{where}: {error}", help)]) from error
    log = logging.getLogger("ray.data")
    context = data.DataContext.get_current()
    before = log.level, context.enable_progress_bars
    try:
        log.setLevel(logging.ERROR)
        context.enable_progress_bars = False
        of_nodes = [node["Resources"].get("CPU", 0) for node in ray.nodes() if node["Alive"]]
        if max(of_nodes, default=0) < threads:
            # A node may still come: some clusters grow when they are asked.
            warn([f"no node of the cluster has {threads} CPUs for the threads of a worker: waiting for one"])
        workers = workers or sum(int(cpus // threads) for cpus in of_nodes)
        yield ray, max(1, workers)
    finally:
        context.enable_progress_bars = before[1]
        log.setLevel(before[0])
        if is_own:
            ray.shutdown()


def _look_for(address: str) -> None:
    """Looks whether anybody listens at an address: Ray itself would wait for minutes."""
    found = re.fullmatch(r"(?:ray://)?\[?([^/]+?)\]?:(\d+)", address)
    if found is not None:
        socket.create_connection((found[1], int(found[2])), timeout=_PATIENCE_S).close()


def _cores() -> int:
    """The cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
