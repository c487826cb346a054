"""Figures, which notebooks show and which are saved as SVG, PDF or PNG."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from . import _native
from ._documents import PathLike
from ._errors import InputError, RequestError


def _written(path: Path, content: bytes) -> Path:
    try:
        path.write_bytes(content)
    except OSError as error:
        raise InputError([(f"{path}: cannot be written: {error.strerror}", "give another file")]) from error
    return path


class Figure:
    """A figure. A notebook shows it; :meth:`save` writes it.

    Examples
    --------
    >>> import fovqa
    >>> view = {"fov_vertical_deg": 100}
    >>> reference = fovqa.gallery(view=view, resolution=(160, 160), samples=1)[0].encoded
    >>> coarse = fovqa.foveate(reference, "rmfr", view=view)
    >>> score = fovqa.score(reference, coarse.image, metrics="psnr", view=view)
    >>> figure = score.profile("psnr")
    >>> figure
    Figure(profile-psnr)
    >>> figure.svg.startswith("<svg")
    True
    """

    name: str
    """The name of its files, without the ending."""

    def _render(self, kind: str) -> bytes:
        raise NotImplementedError

    @property
    def svg(self) -> str:
        """The figure as SVG."""
        return self._render("svg").decode()

    @property
    def pdf(self) -> bytes:
        """The figure as PDF."""
        return self._render("pdf")

    @property
    def png(self) -> bytes:
        """The figure as PNG, of 300 pixels per inch."""
        return self._render("png")

    def save(self, path: PathLike) -> Path:
        """Write the figure to a file.

        Parameters
        ----------
        path
            A file that ends in ``.svg``, ``.pdf`` or ``.png``. It is replaced if it exists.

        Returns
        -------
        Path
            The file.
        """
        path = Path(os.fspath(path))
        kind = path.suffix.lower().lstrip(".")
        if kind not in ("svg", "pdf", "png"):
            raise RequestError([(f"{path}: figures are SVG, PDF or PNG", "end the name in .svg, .pdf or .png")])
        return _written(path, self._render(kind))

    def _repr_svg_(self) -> str | None:
        return self.svg

    def __repr__(self) -> str:
        return f"Figure({self.name})"


class ProfileFigure(Figure):
    """A metric against eccentricity."""

    def __init__(
        self,
        metric: str,
        lines: list[tuple[str, bool, list[tuple[float, float, float | None]]]],
        title: str | None,
        settings: dict[str, Any],
    ) -> None:
        self.name = f"profile-{metric.replace('_', '-')}"
        self._metric, self._lines, self._title, self._settings = metric, lines, title, settings
        # A mistake is said here, not where the figure is shown.
        self._svg = self._draw("svg")

    def _draw(self, kind: str) -> bytes:
        document = {
            "name": "figure",
            "scene": [{"name": "scene", "reference": "reference"}],
            "method": [{"name": "test", "test": "test"}],
            "figures": self._settings,
        }
        return _native.profile(document, self._metric, self._lines, self._title, kind)

    def _render(self, kind: str) -> bytes:
        return self._svg if kind == "svg" else self._draw(kind)


class DrawnFigure(Figure):
    """A figure that was drawn, in all its formats."""

    def __init__(self, name: str, files: dict[str, bytes]) -> None:
        self.name = name
        self._files = files

    def _render(self, kind: str) -> bytes:
        if kind not in self._files:
            there = ", ".join(sorted(self._files)) or "no format"
            raise RequestError(
                [(f"{self.name} was drawn as {there}, not as {kind}", "ask for it with formats in [figures]")]
            )
        return self._files[kind]

    def _repr_svg_(self) -> str | None:
        return self.svg if "svg" in self._files else None

    def _repr_png_(self) -> bytes | None:
        return self.png if "svg" not in self._files and "png" in self._files else None


class Figures(Mapping[str, Figure]):
    """Figures by name."""

    def __init__(self, figures: dict[str, Figure]) -> None:
        self._figures = figures

    @classmethod
    def of_folder(cls, folder: Path) -> Figures:
        """The figures in the folder ``plots``."""
        files: dict[str, dict[str, bytes]] = {}
        for path in sorted((folder / "plots").glob("*")):
            if path.suffix in (".svg", ".pdf", ".png"):
                files.setdefault(path.stem, {})[path.suffix[1:]] = path.read_bytes()
        return cls({name: DrawnFigure(name, of) for name, of in files.items()})

    def __getitem__(self, name: str) -> Figure:
        if name not in self._figures:
            raise KeyError(f"there is no figure {name}; there are {', '.join(self._figures) or 'none'}")
        return self._figures[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._figures)

    def __len__(self) -> int:
        return len(self._figures)

    def __repr__(self) -> str:
        return f"Figures({', '.join(self._figures)})"


class Picture:
    """A picture, such as a heat map. A notebook shows it; :meth:`save` writes it."""

    def __init__(self, png: bytes) -> None:
        self.png = png
        """The picture as PNG."""

    def save(self, path: PathLike) -> Path:
        """Write the picture to a file that ends in ``.png``.

        Parameters
        ----------
        path
            The file. It is replaced if it exists.

        Returns
        -------
        Path
            The file.
        """
        path = Path(os.fspath(path))
        if path.suffix.lower() != ".png":
            raise RequestError([(f"{path}: pictures are PNG", "end the name in .png")])
        return _written(path, self.png)

    def _repr_png_(self) -> bytes:
        return self.png

    def __repr__(self) -> str:
        return f"Picture({len(self.png)} bytes of PNG)"
