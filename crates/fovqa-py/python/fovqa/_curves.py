"""Shading rates against acuity."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _native
from ._documents import Document, PathLike, View, document_of, plain, resolution_text, view_table, warn
from ._errors import RequestError
from ._figures import Figures
from ._folders import results_folder
from ._progress import Progress, Reporter
from ._tables import numbers, to_pandas, to_polars

if TYPE_CHECKING:
    import pandas
    import polars


class Curves:
    """Shading rates against acuity: values, tables and figures."""

    def __init__(self, folder: Path, found: Mapping[str, Any]) -> None:
        self._csv = (folder / "curves.csv").read_text(encoding="utf-8")
        self._json = (folder / "curves.json").read_text(encoding="utf-8")
        self.tables: list[str] = list(found["tables"])
        """The tables, as text."""
        self.figures: Figures = Figures.of_folder(folder)
        """The figures by name."""
        self.warnings: list[str] = list(found["warnings"])
        """What the user should know."""
        self.notes: list[str] = list(found["notes"])
        """What may interest the user, such as values that were left out."""

    def to_dict(self) -> dict[str, Any]:
        """The curves with their settings, samples and shares.

        Returns
        -------
        dict
            The content of curves.json.
        """
        document: dict[str, Any] = numbers(json.loads(self._json))
        return document

    def to_csv(self) -> str:
        """The points of all curves.

        Returns
        -------
        str
            The table curves.csv.
        """
        return self._csv

    def to_pandas(self) -> pandas.DataFrame:
        """The points of all curves. Needs pandas.

        Returns
        -------
        DataFrame
            The table curves.csv.
        """
        return to_pandas(self._csv)

    def to_polars(self) -> polars.DataFrame:
        """The points of all curves. Needs polars.

        Returns
        -------
        DataFrame
            The table curves.csv.
        """
        return to_polars(self._csv)

    def __repr__(self) -> str:
        return f"Curves({', '.join(self.figures)})"

    def __str__(self) -> str:
        return "\n".join(self.tables)

    def _repr_html_(self) -> str:
        return "\n".join(figure.svg for figure in self.figures.values())


def curves(
    source: Document | None = None,
    *,
    method: str | Mapping[str, Any] | Sequence[str | Mapping[str, Any]] | None = None,
    acuity: str | Mapping[str, Any] | None = None,
    view: View | None = None,
    gaze: Sequence[float] | None = None,
    resolution: Sequence[int] | str | None = None,
    direction_deg: float | None = None,
    budget: float | None = None,
    output: PathLike | None = None,
    progress: Progress = True,
    **parameters: Any,
) -> Curves:
    """Shading rates of foveation methods against acuity, as ``fovqa curves`` computes them.

    Parameters
    ----------
    source
        The path of a curves file, or a dict with its keys. All other arguments but ``output`` are in the file then.
    method
        Instead of a file: the name of a method or a dict with its keys, or a list of these.
    acuity
        The name of an acuity model or a dict with its keys, to draw beside the methods.
    view
        As in :func:`score`.
    gaze
        (x, y) in pixels; by default the principal point.
    resolution
        Width and height in pixels; by default those of the display.
    direction_deg
        The direction from the gaze, from +x towards +y.
    budget
        Samples as a share of the frame's pixels: it sets each method's free parameter.
    output
        A folder for all files; by default nothing is kept on the disk.
    progress
        As in :func:`score`.
    **parameters
        Parameters of a single method, such as ``sigma=2.6``.

    Returns
    -------
    Curves
        The values, tables and figures.

    Raises
    ------
    ExperimentError
        If the file has mistakes.
    RequestError
        If an argument is wrong, or a curve is not possible.

    Examples
    --------
    >>> import fovqa
    >>> curves = fovqa.curves(method=["rmfr", "vafr"], view="vive-pro-eye", budget=0.15)
    >>> sorted(curves.figures)
    ['density', 'rates']
    >>> curves.to_csv().splitlines()[0].split(",")[:2]
    ['curve', 'model']
    """
    own = {
        "method": method,
        "acuity": acuity,
        "view": view,
        "gaze": gaze,
        "resolution": resolution,
        "direction_deg": direction_deg,
        "budget": budget,
        **parameters,
    }
    own = {name: value for name, value in own.items() if value is not None}
    if source is not None:
        if own:
            raise RequestError([(f"{', '.join(own)} and a file", "write them into the file")])
        document = document_of(source)
    else:
        document = _curves_document(own, parameters)
    with results_folder(output) as folder, Reporter(progress) as callback:
        found = _native.curves(document, folder, progress=callback)
        result = Curves(folder, found)
    warn(result.warnings)
    return result


def _curves_document(own: Mapping[str, Any], parameters: Mapping[str, Any]) -> dict[str, Any]:
    """The curves file of arguments."""
    methods: list[Any] = []
    given = own.get("method")
    if isinstance(given, (str, Mapping)):
        methods = [given]
    elif given is not None:
        methods = list(given)
    if not methods and "acuity" not in own:
        raise RequestError([("there is nothing to draw", "give a file, a method or an acuity model")])
    if parameters and len(methods) != 1:
        names = ", ".join(parameters)
        raise RequestError(
            [(f"{names} of {len(methods)} methods", "give each method as a dict: {'model': 'rmfr', 'sigma': 2.6}")]
        )
    listed: list[dict[str, Any]] = []
    models: list[str] = []
    for of in methods:
        keys = plain(of) if isinstance(of, Mapping) else {"model": of, **parameters}
        name = str(keys.get("model", "method"))
        models.append(name)
        nth = models.count(name)
        name = name if nth == 1 else f"{name} ({nth})"
        listed.append({"name": name, "method": keys, "budget": own.get("budget")})
    if "acuity" in own:
        acuity = own["acuity"]
        keys = plain(acuity) if isinstance(acuity, Mapping) else {"model": acuity}
        listed.append({"name": str(keys.get("model", "acuity")), "acuity": keys})
    gaze = own.get("gaze")
    view = {
        **view_table(own.get("view")),
        "resolutions": [resolution_text(own["resolution"])] if "resolution" in own else None,
        "gazes": None if gaze is None else [[float(at) for at in gaze]],
        "directions_deg": [own["direction_deg"]] if "direction_deg" in own else None,
    }
    return {"name": "curves", "view": view, "curve": listed}
