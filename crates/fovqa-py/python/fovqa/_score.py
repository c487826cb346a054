"""Scores of a comparison."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _native
from ._documents import plain
from ._errors import RequestError
from ._figures import Picture, ProfileFigure
from ._tables import html_table, numbers, shown, to_pandas, to_polars

if TYPE_CHECKING:
    import numpy as np
    import pandas
    import polars
    from numpy.typing import NDArray


class Band(NamedTuple):
    """The value of a metric in an eccentricity band."""

    from_deg: float
    """The inner edge, in degrees."""
    to_deg: float
    """The outer edge, in degrees."""
    value: float | None
    """The mean over the frames; None if there is none."""


class Failure(NamedTuple):
    """A frame that could not be scored or emulated."""

    frame: int | None
    """The number of the frame; None if it is about all frames."""
    message: str
    """What is wrong, and where."""
    help: str
    """How to mend it."""


class Score:
    """The scores of test frames against reference frames.

    Each metric that was scored is an attribute, such as ``score.psnr``: the mean over the frames, the JOD of the
    whole sequence (FovVideoVDP), or test / reference (ATD and flicker). Of two eyes, it is the value of both together.
    Measures of each image, such as RMS contrast or spectra, are in :meth:`bands` and in the tables.
    """

    mse: float | None
    psnr: float | None
    ssim: float | None
    ms_ssim: float | None
    fpsnr: float | None
    fssim: float | None
    gmsd: float | None
    flip: float | None
    hdr_flip: float | None
    fwqi: float | None
    fvvdp: float | None
    pu_psnr: float | None
    atd: float | None
    flicker: float | None

    def __init__(self, found: dict[str, Any]) -> None:
        self._json: str = found["json"]
        self._csv: str = found["csv"]
        self._table: str = found["table"]
        self._values: dict[str, dict[str, float | None]] = found["values"]
        self._maps: list[tuple[str, int, str, NDArray[np.float32], bytes]] = found["maps"]
        self._metrics: list[str] = found["metrics"]
        self._failures: dict[str, list[tuple[int | None, str, str]]] = found["failures"]
        self._parsed: dict[str, Any] | None = None
        self.warnings: list[str] = found["warnings"]
        """What the user should know, such as likely mistakes. Each is one sentence."""

    @property
    def values(self) -> dict[str, float | None]:
        """The value of each metric, as its attribute; of two eyes, of both together."""
        return dict(self._values["both" if self.has_two_eyes else ""])

    @property
    def metrics(self) -> list[str]:
        """The names of all metrics that were scored."""
        return list(self._metrics)

    @property
    def has_two_eyes(self) -> bool:
        """Whether there is a left and a right image of each frame."""
        return "both" in self._values

    @property
    def eyes(self) -> dict[str, dict[str, float | None]]:
        """Of two eyes, the values of ``left``, ``right`` and ``both``; otherwise empty."""
        return {eye: dict(values) for eye, values in self._values.items() if eye}

    @property
    def frames(self) -> list[dict[str, Any]]:
        """The values of each frame, as in :meth:`to_dict`."""
        frames: list[dict[str, Any]] = self.to_dict()["frames"]
        return frames

    @property
    def failures(self) -> list[Failure]:
        """The frames that could not be scored."""
        return [Failure(*failure) for of_eye in self._failures.values() for failure in of_eye]

    @property
    def maps(self) -> dict[str, NDArray[np.float32]]:
        """The maps of the first frame by name, such as ``ssim`` and ``mse``: float32, height x width.

        They exist if ``maps=True`` was asked for. :meth:`map` has those of the other frames.
        """
        if not self._maps:
            return {}
        eye, frame = self._maps[0][:2]
        return {name: values for e, f, name, values, _ in self._maps if (e, f) == (eye, frame)}

    def map(self, name: str, frame: int | None = None, eye: str | None = None) -> NDArray[np.float32]:
        """A map of a frame.

        Parameters
        ----------
        name
            Its name, such as ``ssim``.
        frame
            The number of the frame; by default the first.
        eye
            ``left`` or ``right``; by default the first.

        Returns
        -------
        ndarray
            float32, height x width; NaN where there is no value.
        """
        return self._map(name, frame, eye)[3]

    def heat_map(self, name: str, frame: int | None = None, eye: str | None = None) -> Picture:
        """A map as a picture, with a colour bar and, if there is a view, the bands and the gaze.

        Parameters
        ----------
        name
            Its name, such as ``ssim``.
        frame
            The number of the frame; by default the first.
        eye
            ``left`` or ``right``; by default the first.

        Returns
        -------
        Picture
            The picture.
        """
        return Picture(self._map(name, frame, eye)[4])

    def _map(self, name: str, frame: int | None, eye: str | None) -> tuple[str, int, str, NDArray[np.float32], bytes]:
        if not self._maps:
            raise RequestError([("there are no maps", "score with maps=True, and with a metric that has a map")])
        of_eye = [of for of in self._maps if eye in (None, of[0])]
        of_frame = [of for of in of_eye if frame in (None, of[1])]
        for of in of_frame:
            if of[2] == name:
                return of
        names = sorted({of[2] for of in self._maps})
        numbers_of = sorted({of[1] for of in self._maps})
        raise RequestError(
            [
                (
                    f"there is no map {name!r}"
                    + (f" of frame {frame}" if frame is not None else "")
                    + (f" of the {eye} eye" if eye is not None else ""),
                    f"there are {', '.join(names)}, of frames {numbers_of[0]} to {numbers_of[-1]}",
                )
            ]
        )

    def bands(self, metric: str, image: str | None = None, level: int = 1, statistic: str = "energy") -> list[Band]:
        """A metric by eccentricity.

        Parameters
        ----------
        metric
            Its name, such as ``psnr`` or ``rms_contrast``.
        image
            ``"reference"``, ``"test"`` or ``"ratio"`` for measures of each image; by default the ratio.
        level
            The level of the wavelet; of power and density of the spectrum, k for the half octave around 2^(k/2) cpd.
        statistic
            The statistic of the wavelet: ``"energy"``, ``"mean_abs"`` or ``"max_abs"``; of the spectrum, ``"power"`` or
            ``"density"``, and otherwise its cut-off frequency in cpd.

        Returns
        -------
        list of Band
            One for each band, from the gaze outwards; empty if the metric has none.
        """
        document = self.to_dict()
        if metric not in self.metrics:
            raise RequestError([(f"{metric} was not scored", f"scored are: {', '.join(self.metrics)}")])
        if metric == "fvvdp":
            shares = document["sequence"].get("fvvdp", {}).get("shares", [])
            return [Band(of["from_deg"], of["to_deg"], of.get("share")) for of in shares]
        if metric == "haar":
            rows = [of for of in document.get("summary_haar", []) if of["level"] == level]
            found = [(of, _value(of[image or "ratio"].get(statistic), metric)) for of in rows]
        elif metric == "spectrum":
            found = [
                (of, _of_spectrum(of, image or "ratio", level, statistic))
                for of in document.get("summary_spectrum", [])
            ]
        else:
            rows = [of for of in document["summary_bands"] if metric in of]
            found = [(of, _value(_side(of[metric], image or "ratio"), metric)) for of in rows]
        return [Band(of["from_deg"], of["to_deg"], value) for of, value in found]

    def profile(self, metric: str = "psnr", *, title: str | None = None, **figures: Any) -> ProfileFigure:
        """A figure of a metric against eccentricity.

        Parameters
        ----------
        metric
            Its name.
        title
            A title above the figure.
        **figures
            Keys of ``[figures]`` in an experiment file, such as ``width_in=3.3`` or ``font_pt=8``.

        Returns
        -------
        ProfileFigure
            The figure. For measures of each image, the reference is dashed.
        """
        return profile({"test": self}, metric, title=title, **figures)

    def to_dict(self) -> dict[str, Any]:
        """All values, with the keys of ``fovqa score --format json``.

        Returns
        -------
        dict
            As docs/files.md describes it; infinite numbers are floats.
        """
        if self._parsed is None:
            self._parsed = numbers(json.loads(self._json))
        return self._parsed

    def to_json(self) -> str:
        """All values, to the byte as ``fovqa score --format json`` prints them.

        Returns
        -------
        str
            JSON.
        """
        return self._json

    def to_csv(self) -> str:
        """All values, one per row, to the byte as ``fovqa score --format csv`` prints them.

        Returns
        -------
        str
            CSV.
        """
        return self._csv

    def to_pandas(self) -> pandas.DataFrame:
        """All values, one per row. Needs pandas.

        Returns
        -------
        DataFrame
            With the columns of results.csv.
        """
        return to_pandas(self._csv)

    def to_polars(self) -> polars.DataFrame:
        """All values, one per row. Needs polars.

        Returns
        -------
        DataFrame
            With the columns of results.csv.
        """
        return to_polars(self._csv)

    def __getattr__(self, name: str) -> float | None:
        if not name.startswith("_"):
            values = self.values
            if name in values:
                return values[name]
            scored = ", ".join(values) or "none has a value of the whole frame"
            raise AttributeError(f"{name} was not scored; scored are: {scored}")
        raise AttributeError(name)

    def __dir__(self) -> list[str]:
        return sorted({*super().__dir__(), *self.values})

    def __repr__(self) -> str:
        values = ", ".join(f"{name}={shown(value)}" for name, value in self.values.items())
        return f"Score({values})"

    def __str__(self) -> str:
        return self._table

    def _repr_html_(self) -> str:
        metrics = metrics_by_name()
        labels = {name: of["label"] + (f" ({of['unit']})" if of["unit"] else "") for name, of in metrics.items()}
        for name, of in metrics.items():
            if of["kind"] != "fidelity":
                labels[name] = f"{of['label']}, test / reference"
        labels["spectrum"] = f"{metrics['spectrum']['label']}, cut-off (cpd)"
        if self.has_two_eyes:
            head = ["", *self.eyes]
            rows = [
                [labels.get(name, name), *(shown(of.get(name)) for of in self.eyes.values())] for name in self.values
            ]
        else:
            head = ["", "test"]
            rows = [[labels.get(name, name), shown(value)] for name, value in self.values.items()]
        tables = [html_table(head, rows)]
        in_bands = [
            name for name in metrics if name in self.metrics and name not in ("fvvdp", "haar") and self.bands(name)
        ]
        if in_bands:
            bands = {name: self.bands(name) for name in in_bands}
            edges = bands[in_bands[0]]
            head = ["eccentricity", *(labels.get(name, name) for name in in_bands)]
            rows = [
                [f"{band.from_deg:g}°–{band.to_deg:g}°", *(shown(bands[name][nth].value) for name in in_bands)]
                for nth, band in enumerate(edges)
            ]
            tables.append(html_table(head, rows))
        return "\n".join(tables)


def _side(value: Any, image: str) -> Any:
    """The value of an image, of measures that are of each image."""
    return value.get(image) if isinstance(value, dict) and "reference" in value else value


def _value(value: Any, metric: str) -> Any:
    """The value over the frames: the mean or, of temporal metrics that pool their frames, the pooled value."""
    if not isinstance(value, dict):
        return value
    is_pooled = metrics_by_name()[metric]["kind"] == "temporal"
    return value.get("pooled", value["mean"]) if is_pooled else value["mean"]


def _of_spectrum(band: dict[str, Any], image: str, level: int, statistic: str) -> Any:
    """Power or density of a half octave, or the cut-off frequency."""
    if statistic not in ("power", "density"):
        return band["cutoff_cpd"]
    for of in band["bins"]:
        if round(2 * math.log2(of["cpd"])) == level:
            return of["ratio"] if image == "ratio" else _value(of[image][statistic], "spectrum")
    return None


def metrics_by_name() -> dict[str, dict[str, Any]]:
    """All metrics by name."""
    metrics: list[tuple[str, dict[str, Any]]] = json.loads(_native.metrics())
    return dict(metrics)


def profile(
    scores: Mapping[str, Score], metric: str = "psnr", *, title: str | None = None, **figures: Any
) -> ProfileFigure:
    """A figure of a metric against eccentricity, with a line for each score.

    Parameters
    ----------
    scores
        Scores by the names that the legend has.
    metric
        The metric.
    title
        A title above the figure.
    **figures
        Keys of ``[figures]`` in an experiment file, such as ``width_in=3.3`` or ``font_pt=8``.

    Returns
    -------
    ProfileFigure
        The figure. For measures of each image, the reference of the first score is dashed.

    Examples
    --------
    >>> import fovqa
    >>> view = {"fov_vertical_deg": 100}
    >>> reference = fovqa.gallery(view=view, resolution=(160, 160), samples=1)[0].encoded
    >>> def of(method):
    ...     image = fovqa.foveate(reference, method, view=view, budget=0.15).image
    ...     return fovqa.score(reference, image, metrics="psnr", view=view)
    >>> fovqa.profile({method: of(method) for method in ("rmfr", "vafr")})
    Figure(profile-psnr)
    """
    if not isinstance(scores, Mapping) or not all(isinstance(of, Score) for of in scores.values()):
        raise TypeError("give scores by the names that the legend has: {'RMFR': score, 'VaFR': other}")
    lines: list[tuple[str, bool, list[tuple[float, float, float | None]]]] = []

    def of_image(score: Score, image: str | None) -> list[tuple[float, float, float | None]]:
        return [(band.from_deg, band.to_deg, band.value) for band in score.bands(metric, image)]

    has_sides = metric != "spectrum" and metrics_by_name().get(metric, {}).get("kind", "fidelity") != "fidelity"
    for name, of in scores.items():
        if has_sides and not lines:
            lines.append(("reference", True, of_image(of, "reference")))
        lines.append((str(name), False, of_image(of, "test" if has_sides else None)))
    return ProfileFigure(metric, lines, title, plain(figures))
