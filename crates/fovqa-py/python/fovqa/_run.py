"""Runs of experiments."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._documents import Document, PathLike, document_of, frames_text, warn
from ._errors import InputError
from ._figures import Figures
from ._progress import Progress, Reporter
from ._score import Failure
from ._tables import numbers, to_pandas, to_polars

if TYPE_CHECKING:
    import pandas
    import polars


class Run:
    """The results of an experiment, in a folder."""

    def __init__(self, folder: PathLike, found: Mapping[str, Any] | None = None) -> None:
        found = found or {}
        self.folder: Path = Path(os.fspath(folder)).absolute()
        """The folder with all files."""
        self.warnings: list[str] = list(found.get("warnings", []))
        """What the user should know, such as likely mistakes."""
        self.failures: list[Failure] = [Failure(None, *failure) for failure in found.get("failures", [])]
        """What could not be scored. :attr:`summary` has everything."""
        self.scored: int | None = found.get("scored")
        """The number of frames that were scored; None for results that were opened."""

    @property
    def summary(self) -> dict[str, Any]:
        """The content of summary.json: means, extremes and pooled values over frames; errors."""
        summary: dict[str, Any] = numbers(json.loads(self._read("summary.json")))
        return summary

    @property
    def table(self) -> str:
        """The first comparison table, as Markdown."""
        tables = self.tables
        return next(iter(tables.values())) if tables else ""

    @property
    def tables(self) -> dict[str, str]:
        """All tables by name, as Markdown."""
        paths = sorted(self.folder.glob("*.md"), key=lambda path: (path.stem != "table", path.stem))
        return {path.stem: path.read_text(encoding="utf-8") for path in paths}

    @property
    def figures(self) -> Figures:
        """All figures by name."""
        return Figures.of_folder(self.folder)

    @property
    def report(self) -> Path:
        """The page about the run, one file for a browser."""
        return self.folder / "report.html"

    def to_dict(self) -> dict[str, Any]:
        """The content of summary.json.

        Returns
        -------
        dict
            As docs/files.md describes it.
        """
        return self.summary

    def to_pandas(self) -> pandas.DataFrame:
        """All values, one per row. Needs pandas.

        Returns
        -------
        DataFrame
            The table results.csv.
        """
        return to_pandas(self._values())

    def to_polars(self) -> polars.DataFrame:
        """All values, one per row. Needs polars.

        Returns
        -------
        DataFrame
            The table results.csv.
        """
        return to_polars(self._values())

    def _values(self) -> str:
        if not (self.folder / "results.csv").exists() and (self.folder / "results.parquet").exists():
            raise InputError(
                [
                    (
                        f"{self.folder}: the values are in results.parquet alone",
                        'read it with pandas.read_parquet or polars.read_parquet, or add "csv" to tables in [output]',
                    )
                ]
            )
        return self._read("results.csv")

    def _read(self, name: str) -> str:
        try:
            return (self.folder / name).read_text(encoding="utf-8")
        except (FileNotFoundError, NotADirectoryError) as error:
            raise InputError([(f"{self.folder}: there is no {name}", "give the folder of a finished run")]) from error

    def __repr__(self) -> str:
        scored = "" if self.scored is None else f", {self.scored} frames"
        failed = f", {len(self.failures)} errors" if self.failures else ""
        return f"Run({str(self.folder)!r}{scored}{failed})"

    def __str__(self) -> str:
        return self.table

    def _repr_markdown_(self) -> str:
        return f"{self.table}\n\n{self.report}\n"


def run(
    experiment: Document,
    *,
    output: PathLike | None = None,
    resume: bool = False,
    shard: str | None = None,
    frames: str | range | None = None,
    maps: PathLike | None = None,
    lock: bool = True,
    progress: Progress = True,
) -> Run:
    """Run an experiment: score its frames, and write values, tables, figures and a page, as ``fovqa run`` does.

    Parameters
    ----------
    experiment
        The path of an experiment file, or a dict with its keys, whose paths start in the working directory.
    output
        The folder for the results; by default ``reports/NAME``.
    resume
        Whether to continue a run that was interrupted.
    shard
        Score only a share: ``"2/7"`` is the second of seven. ``fovqa merge`` joins them.
    frames
        Only these frames of each scene: ``"A..B"`` or ``"A..B:STEP"``, without B, or a range.
    maps
        A folder for the maps of each frame.
    lock
        Whether to lock the folder, so that only one process writes to it.
    progress
        As in :func:`score`.

    Returns
    -------
    Run
        The results. What could not be scored is in :attr:`Run.failures`, and warned of.

    Raises
    ------
    ExperimentError
        If the file has mistakes.
    RequestError
        If an argument is wrong, or a key of the dict.
    InputError
        If the results cannot be written.

    Examples
    --------
    >>> import fovqa, tempfile
    >>> experiment = {
    ...     "name": "hall",
    ...     "view": {"fov_vertical_deg": 100},
    ...     "scene": [{"name": "hall", "builtin": "gallery", "resolution": "80x80", "samples": 1, "frames": 2}],
    ...     "method": [{"name": "RMFR", "emulate": {"model": "rmfr", "budget": 0.15}}],
    ...     "metrics": {"psnr": {}},
    ... }
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     hall = fovqa.run(experiment, output=folder, progress=False)
    ...     hall.scored, sorted(hall.figures)
    (2, ['frames-psnr', 'profile-psnr'])
    """
    with Reporter(progress) as callback:
        found = _native.run(
            document_of(experiment),
            output=output,
            resume=resume,
            shard=shard,
            frames=frames_text(frames),
            maps=maps,
            lock=lock,
            progress=callback,
        )
    result = Run(found["folder"], found)
    warn(result.warnings)
    warn(failure.message for failure in result.failures)
    return result


def load(folder: PathLike) -> Run:
    """Open the results of an earlier run.

    Parameters
    ----------
    folder
        The folder that ``fovqa run`` or :func:`run` wrote to.

    Returns
    -------
    Run
        The results.

    Raises
    ------
    InputError
        If the folder has no finished run.
    """
    found = Run(folder)
    found._read("run.json")
    return found
