"""Frames of files, and frames as pictures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _native
from ._documents import PathLike, plain, warn
from ._errors import RequestError
from ._figures import Picture

if TYPE_CHECKING:
    from numpy.typing import NDArray


#: The keys of ``[signal]`` that say how files are read.
_READ = ("layer", "alpha", "max_megapixels", "range", "matrix", "motion", "depth")


class Frame:
    """A frame that was read from a file."""

    def __init__(self, found: dict[str, Any]) -> None:
        self.image: NDArray[Any] = found["image"]
        """Height x width (gray) or height x width x 3, in the type of the file: uint8, uint16, float16 or float32."""
        self.motion: NDArray[Any] | None = found["motion"]
        """Motion vectors, height x width x 2, if they were asked for and exist: where each pixel was in the frame
        before, in pixels to the right and down from where it is."""
        self.depth: NDArray[Any] | None = found["depth"]
        """Depth, height x width, if it was asked for and exists."""

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        import numpy as np

        return np.asarray(self.image, dtype=dtype)

    def _repr_png_(self) -> bytes:
        return _native.png(self.image)

    def __repr__(self) -> str:
        size = " x ".join(map(str, self.image.shape))
        guides = [name for name in ("motion", "depth") if getattr(self, name) is not None]
        return f"Frame({', '.join([f'{size} of {self.image.dtype.name}', *guides])})"


def read(
    path: PathLike,
    *,
    frame: int | None = None,
    guides: bool = False,
    crop: Sequence[int] | None = None,
    **signal: Any,
) -> Frame:
    """Read a frame as the metrics do: PNG, JPEG, OpenEXR (with motion and depth) or y4m video.

    Parameters
    ----------
    path
        A file, a folder, a glob, a pattern or a video.
    frame
        Which one of several frames, counted from 0.
    guides
        Whether to read motion and depth.
    crop
        The rectangle to return: (x, y, width, height) in pixels.
    **signal
        Keys of ``[signal]`` that say how files are read, such as ``layer="Combined"``, ``alpha="ignore"`` or
        ``motion="blender"``.

    Returns
    -------
    Frame
        The frame as an array, and its motion and depth.

    Raises
    ------
    InputError
        If it cannot be read.
    """
    unknown = [key for key in signal if key not in _READ]
    if unknown:
        raise RequestError([(f"read has no {', '.join(unknown)}", f"what says how files are read: {', '.join(_READ)}")])
    document = document_of_signal(signal, crop=crop)
    found = _native.read(document, path, frame=frame, guides=guides)
    warn(found["notes"])
    return Frame(found)


def show(image: Any, *, signal: Mapping[str, Any] | None = None) -> Picture:
    """A frame as a picture, which a notebook shows and which can be saved.

    Parameters
    ----------
    image
        An array of height x width or height x width x 3. Floats are linear light.
    signal
        How values become the signal: the keys of ``[signal]`` in an experiment file, such as
        ``{"tonemap": "reinhard"}``.

    Returns
    -------
    Picture
        8-bit codes as PNG.
    """
    return Picture(_native.png(image, document_of_signal(signal)))


def document_of_signal(signal: Mapping[str, Any] | None, **scene: Any) -> dict[str, Any]:
    """An experiment of which only the signal matters."""
    return {
        "name": "frame",
        "signal": plain(signal),
        "scene": [{"name": "scene", "reference": "reference", **scene}],
        "method": [{"name": "test", "test": "test"}],
    }
