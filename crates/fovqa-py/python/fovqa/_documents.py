"""Arguments as the tables of an experiment file, whose keys and checks they share."""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ._errors import FovqaWarning, InputError, RequestError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

#: The name of a display, or the keys of ``[view]``.
View = str | Mapping[str, Any]
#: Names of metrics, or their parameters by name.
Metrics = str | Iterable[str] | Mapping[str, Any]
#: A path.
PathLike = str | os.PathLike[str]
#: The path of a TOML file, or a dict with its keys.
Document = PathLike | Mapping[str, Any]


#: The depth at which a table refers to itself.
_DEEPEST = 32


def plain(table: Mapping[str, Any] | None, what: str = "the table", depth: int = 0) -> dict[str, Any]:
    """A table as a dict of dicts."""
    if table is None:
        return {}
    if not isinstance(table, Mapping):
        raise TypeError(f"{what} is a dict with the keys of an experiment file, not {type(table).__name__}")
    if depth > _DEEPEST:
        raise RequestError(f"{what} is nested too deeply")
    return {
        key: plain(value, f"{what}[{key!r}]", depth + 1) if isinstance(value, Mapping) else value
        for key, value in table.items()
    }


def document_of(given: Document) -> Any:
    """A path, or the keys of a file."""
    return plain(given) if isinstance(given, Mapping) else given


def view_table(view: View | None) -> dict[str, Any]:
    """The keys of ``[view]``."""
    if isinstance(view, str):
        return {"display": view}
    if view is None or isinstance(view, Mapping):
        return plain(view, "view")
    raise TypeError(
        "view is the name of a display, or a dict with the keys of [view], such as "
        f"{{'fov_vertical_deg': 60}}, not {type(view).__name__}"
    )


def metrics_table(metrics: Metrics | None) -> dict[str, Any] | None:
    """The keys of ``[metrics]``."""
    if metrics is None:
        return None
    if isinstance(metrics, str):
        metrics = metrics.split(",")
    if isinstance(metrics, Mapping):
        return {key: plain(value, f"metrics[{key!r}]") if value else {} for key, value in metrics.items()}
    # As on the command line, hyphens are like underscores.
    return {str(metric).strip().replace("-", "_"): {} for metric in metrics}


def resolution_text(resolution: Sequence[int] | str | None) -> str | None:
    """A size as ``1440x1600``."""
    if resolution is None or isinstance(resolution, str):
        return resolution
    width, height = resolution
    return f"{int(width)}x{int(height)}"


_GAZE = "give (x, y) in pixels, or an array of frames x 2"


def frames_text(frames: str | range | None) -> str | None:
    """Frame numbers as ``A..B:STEP``."""
    if isinstance(frames, range):
        return f"{frames.start}..{frames.stop}:{frames.step}"
    return frames


def gaze_of(gaze: Any) -> tuple[Any, list[list[float]] | None]:
    """The gaze as a key of a scene, or as a point for each frame."""
    if gaze is None or isinstance(gaze, str):
        is_file = gaze is not None and gaze.lower().endswith(".csv")
        return ({"trace": gaze} if is_file else gaze), None
    if isinstance(gaze, Mapping):
        return plain(gaze), None
    if hasattr(gaze, "__fspath__"):
        return {"trace": os.fspath(gaze)}, None
    import numpy as np

    try:
        points: NDArray[np.float64] = np.asarray(gaze, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError([(f"the gaze is no array of numbers: {error}", _GAZE)]) from error
    if points.shape == (2,):
        return [float(points[0]), float(points[1])], None
    if points.ndim != 2 or points.shape[1] != 2:
        raise InputError([(f"the gaze has the shape {' x '.join(map(str, points.shape)) or 'of a number'}", _GAZE)])
    if not np.isfinite(points).all():
        raise InputError([("the gaze has NaN or infinity", "give pixels")])
    return None, points.tolist()


def guides_of(guides: Any) -> tuple[Any, Any]:
    """Motion or depth as a key of a scene, or as arrays of each frame."""
    if guides is None or isinstance(guides, (str, Mapping)):
        return (plain(guides) if isinstance(guides, Mapping) else guides), None
    if hasattr(guides, "__fspath__"):
        return {"files": os.fspath(guides)}, None
    return None, guides


def warn(messages: Iterable[str], stacklevel: int = 3) -> None:
    """Warns of each message."""
    for message in messages:
        warnings.warn(message, FovqaWarning, stacklevel=stacklevel)


#: What the warning of a metric that is left out says after its name.
_NO_VIEW = " is left out: it needs "


def without_defaults(messages: Iterable[str]) -> list[str]:
    """The warnings without those of metrics that nobody asked for and that need a view."""
    return [message for message in messages if _NO_VIEW not in message]
