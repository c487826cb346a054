"""Analyses of user studies."""

from __future__ import annotations

import csv
import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _native
from ._documents import PathLike, document_of, warn
from ._errors import InputError, RequestError
from ._figures import Figures
from ._folders import results_folder
from ._progress import Progress, Reporter
from ._tables import numbers


class Study:
    """The analyses of a user study: results, tables and figures."""

    def __init__(self, folder: Path, found: Mapping[str, Any]) -> None:
        self._json = (folder / "study.json").read_text(encoding="utf-8")
        self.tables: dict[str, str] = {
            path.stem: path.read_text(encoding="utf-8") for path in sorted(folder.glob("*.md"))
        }
        """The tables by name, as Markdown."""
        self.figures: Figures = Figures.of_folder(folder)
        """The figures by name."""
        self.warnings: list[str] = list(found["warnings"])
        """What the user should know."""

    def to_dict(self) -> dict[str, Any]:
        """All results.

        Returns
        -------
        dict
            The content of study.json.
        """
        document: dict[str, Any] = numbers(json.loads(self._json))
        return document

    @property
    def results(self) -> list[dict[str, Any]]:
        """The result of each analysis, as ``fovqa study … --format json`` prints it."""
        return [of["result"] for of in self.to_dict()["analyses"]]

    def __repr__(self) -> str:
        return f"Study({', '.join(of['name'] for of in self.to_dict()['analyses'])})"

    def __str__(self) -> str:
        return "\n".join(self.tables.values())

    def _repr_markdown_(self) -> str:
        return "\n\n".join(self.tables.values())

    def _repr_svg_(self) -> str | None:
        figures = list(self.figures.values())
        return figures[0]._repr_svg_() if figures else None


def study(
    source: Any,
    kind: str | None = None,
    *,
    output: PathLike | None = None,
    progress: Progress = True,
    **keys: Any,
) -> Study:
    """Analyse the answers of viewers, as ``fovqa study`` does.

    Parameters
    ----------
    source
        The path of a study file, or a dict with its keys. With ``kind``: the table of answers, as the path of a CSV
        file, a data frame (pandas or polars), or a dict of columns.
    kind
        The analysis of the table: ``"pairs"``, ``"ranks"``, ``"anova"``, ``"psychometric"``, ``"staircase"``,
        ``"ratings"`` or ``"metrics"``. docs/studies.md says which columns each needs.
    output
        A folder for all files; by default nothing is kept on the disk.
    progress
        As in :func:`score`.
    **keys
        Keys of the analysis, such as ``by="scene"`` or ``reference="full"``.

    Returns
    -------
    Study
        The results, tables and figures.

    Raises
    ------
    ExperimentError
        If the file has mistakes.
    RequestError
        If an argument is wrong.
    InputError
        If a table is missing or does not fit.

    Examples
    --------
    >>> import fovqa
    >>> votes = {
    ...     "participant": ["p1", "p2", "p3", "p4", "p5", "p6"],
    ...     "method_a": ["A"] * 6,
    ...     "method_b": ["B"] * 6,
    ...     "answer": ["A", "A", "A", "B", "A", "A"],
    ... }
    >>> pair = fovqa.study(votes, "pairs").results[0]["groups"][0]["pairs"][0]
    >>> round(pair["p_two_sided"], 3)
    0.219
    """
    with results_folder(output) as folder, results_folder(None) as beside, Reporter(progress) as callback:
        if kind is None:
            if keys:
                raise RequestError([(f"{', '.join(keys)} without a kind", 'name the analysis, such as "pairs"')])
            document = document_of(source)
        else:
            table = _table_file(source, beside.parent)
            document = {"name": "study", "analysis": [{"kind": kind, "file": os.fspath(table), **keys}]}
        try:
            found = _native.study(document, folder, progress=callback)
        except (InputError, RequestError) as error:
            # The user does not know the file of a table that was given in memory.
            shown = [(text[0].replace(f"{beside.parent}{os.sep}", ""), text[1]) for text in error.complaints]
            error.complaints = shown
            raise
        result = Study(folder, found)
    warn(result.warnings)
    return result


def _table_file(table: Any, folder: Path) -> Path:
    """The CSV file of a table."""
    if isinstance(table, str) or hasattr(table, "__fspath__"):
        return Path(os.fspath(table))
    path = folder / "table.csv"
    # Data frames of polars, then those of pandas.
    if hasattr(table, "write_csv"):
        table.write_csv(path)
    elif hasattr(table, "to_csv"):
        table.to_csv(path, index=False)
    elif isinstance(table, Mapping):
        columns = {str(name): list(values) for name, values in table.items()}
        lengths = {name: len(values) for name, values in columns.items()}
        if len(set(lengths.values())) > 1:
            text = ", ".join(f"{name} has {length}" for name, length in lengths.items())
            raise InputError([(f"the columns have different lengths: {text}", "give one value for each trial")])
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file)
            writer.writerow(columns)
            writer.writerows(zip(*columns.values(), strict=True))
    else:
        raise TypeError(
            f"the table is a value of type {type(table).__name__}; give a path, a data frame or a dict of columns"
        )
    return path
