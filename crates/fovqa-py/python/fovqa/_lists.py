"""The metrics, methods and displays that there are."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

from . import _native
from ._tables import html_table

_METRIC = ["label", "unit", "kind", "better", "default", "per_band", "needs_view", "needs_luminance", "map"]
_METRIC += ["about", "source", "parameters"]
_METHOD = ["label", "curves", "emulated", "about", "source", "parameters"]
_DISPLAY = ["resolution", "geometry", "pixels_per_degree", "peak_cd_m2", "source"]


class Listing(Mapping[str, "dict[str, Any]"]):
    """Descriptions by name. A notebook shows them as a table."""

    def __init__(self, text: str, columns: list[str]) -> None:
        entries: list[tuple[str, dict[str, Any]]] = json.loads(text)
        self._entries = {name: {key: of[key] for key in columns} for name, of in entries}

    def __getitem__(self, name: str) -> dict[str, Any]:
        return self._entries[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def __len__(self) -> int:
        return len(self._entries)

    def __repr__(self) -> str:
        return f"[{', '.join(self._entries)}]"

    def _repr_html_(self) -> str:
        columns = [key for key in next(iter(self._entries.values()), {}) if key != "parameters"]
        rows = [
            [name, *("" if of[key] is None else str(of[key]) for key in columns)] for name, of in self._entries.items()
        ]
        return html_table(["", *columns], rows)


def metrics() -> Listing:
    """All metrics, with their units, needs, sources and parameters.

    Returns
    -------
    Listing
        Descriptions by name.

    Examples
    --------
    >>> import fovqa
    >>> fovqa.metrics()["ssim"]["parameters"]["sigma"]["default"]
    '1.5'
    """
    return Listing(_native.metrics(), _METRIC)


def methods() -> Listing:
    """All foveation methods, with their sources and parameters.

    Returns
    -------
    Listing
        Descriptions by name.

    Examples
    --------
    >>> import fovqa
    >>> "rmfr" in fovqa.methods()
    True
    """
    return Listing(_native.methods(), _METHOD)


def displays() -> Listing:
    """All display presets, with their resolutions and fields.

    Returns
    -------
    Listing
        Descriptions by name.

    Examples
    --------
    >>> import fovqa
    >>> fovqa.displays()["vive-pro-eye"]["resolution"]
    [1440, 1600]
    """
    return Listing(_native.displays(), _DISPLAY)
