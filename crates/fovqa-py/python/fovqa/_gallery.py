"""Built-in scenes, which need no files."""

from __future__ import annotations

import operator
import os
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

from . import _native
from ._documents import PathLike, View, resolution_text, view_table
from ._progress import Progress, Reporter

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

T = TypeVar("T")


class Drawn(Sequence[T], Generic[T]):
    """A sequence whose items are drawn each time they are asked for."""

    def __init__(self, indices: range, draw: Callable[[int], T]) -> None:
        self._indices, self._draw = indices, draw

    @overload
    def __getitem__(self, index: int) -> T: ...
    @overload
    def __getitem__(self, index: slice) -> Drawn[T]: ...
    def __getitem__(self, index: int | slice) -> T | Drawn[T]:
        if isinstance(index, slice):
            return Drawn(self._indices[index], self._draw)
        nth = operator.index(index)
        if not -len(self) <= nth < len(self):
            raise IndexError(f"there is no frame {nth}; there are {len(self)}")
        return self._draw(self._indices[nth])

    def __repr__(self) -> str:
        return f"Drawn({len(self)} frame{'s' * (len(self) != 1)})"

    def __len__(self) -> int:
        return len(self._indices)

    def __iter__(self) -> Iterator[T]:
        return (self._draw(index) for index in self._indices)


class GalleryFrame:
    """A frame of a built-in scene. Each property is drawn when it is first asked for."""

    def __init__(self, native: _native.Gallery, index: int) -> None:
        self._native, self._index = native, index
        self._kept: dict[str, Any] = {}

    def _once(self, name: str, draw: Callable[[int], Any]) -> Any:
        if name not in self._kept:
            self._kept[name] = draw(self._index)
        return self._kept[name]

    @property
    def image(self) -> NDArray[np.float32]:
        """The ground truth in linear light: float32, height x width x 3."""
        image: NDArray[np.float32] = self._once("image", self._native.image)
        return image

    @property
    def encoded(self) -> NDArray[np.uint8]:
        """The ground truth as codes of a display: uint8, height x width x 3."""
        image: NDArray[np.uint8] = self._once("encoded", self._native.encoded)
        return image

    @property
    def motion(self) -> NDArray[np.float32]:
        """Where each pixel was in the frame before, in pixels to the right and down from where it is: float32,
        height x width x 2; NaN where it cannot have been seen."""
        motion: NDArray[np.float32] = self._once("guides", self._native.guides)[0]
        return motion

    @property
    def depth(self) -> NDArray[np.float32]:
        """The distance in metres: float32, height x width."""
        depth: NDArray[np.float32] = self._once("guides", self._native.guides)[1]
        return depth

    @property
    def gaze(self) -> tuple[float, float]:
        """Where the viewer looks, in pixels."""
        x, y = self._native.gaze(self._index)
        return (x, y)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        import numpy as np

        return np.asarray(self.image, dtype=dtype)

    def __repr__(self) -> str:
        name, width, height, _ = self._native.about()
        return f"GalleryFrame({name}, frame {self._index}, {width}x{height})"

    def _repr_png_(self) -> bytes:
        return _native.png(self.encoded)


class Gallery(Sequence[GalleryFrame]):
    """A built-in scene: a sequence of frames."""

    def __init__(self, native: _native.Gallery) -> None:
        self._native = native

    @overload
    def __getitem__(self, index: int) -> GalleryFrame: ...
    @overload
    def __getitem__(self, index: slice) -> Drawn[GalleryFrame]: ...
    def __getitem__(self, index: int | slice) -> GalleryFrame | Drawn[GalleryFrame]:
        return Drawn(range(len(self)), lambda nth: GalleryFrame(self._native, nth))[index]

    def __len__(self) -> int:
        return len(self._native)

    @property
    def images(self) -> Drawn[NDArray[np.float32]]:
        """The images of all frames in linear light, drawn when they are asked for. :func:`score` and :func:`foveate`
        take them as frames."""
        return Drawn(range(len(self)), self._native.image)

    @property
    def encoded(self) -> Drawn[NDArray[np.uint8]]:
        """The images of all frames as codes of a display."""
        return Drawn(range(len(self)), self._native.encoded)

    @property
    def motion(self) -> Drawn[NDArray[np.float32]]:
        """The motion of all frames."""
        return Drawn(range(len(self)), lambda nth: self[nth].motion)

    @property
    def depth(self) -> Drawn[NDArray[np.float32]]:
        """The depth of all frames."""
        return Drawn(range(len(self)), lambda nth: self[nth].depth)

    @property
    def gaze(self) -> NDArray[np.float64]:
        """Where the viewer looks in each frame: frames x 2, in pixels."""
        import numpy as np

        return np.array([self._native.gaze(nth) for nth in range(len(self))])

    @property
    def fps(self) -> float:
        """Frames per second."""
        return self._native.about()[3]

    def _repr_png_(self) -> bytes:
        return self[0]._repr_png_()

    def write(self, folder: PathLike, *, progress: Progress = True) -> int:
        """Write all frames as files, as ``fovqa gallery`` does: OpenEXR with motion and depth, PNG, and the gaze.

        Parameters
        ----------
        folder
            The folder. It is made if it does not exist.
        progress
            As in :func:`score`.

        Returns
        -------
        int
            The number of frames.
        """
        with Reporter(progress) as callback:
            return self._native.write(os.fspath(folder), callback)

    def __repr__(self) -> str:
        name, width, height, fps = self._native.about()
        return f"Gallery({name}, {len(self)} frame{'s' * (len(self) != 1)} of {width}x{height}, {fps:g} per second)"


def gallery(
    scene: str = "gallery",
    *,
    view: View | None = None,
    resolution: Sequence[int] | str | None = None,
    frames: int = 1,
    fps: float = 90,
    samples: int = 16,
    seed: int = 1,
    eye: str | None = None,
    ipd_mm: float = 63,
) -> Gallery:
    """A scene that needs no files: a walk through a hall, patterns, or a chart of contrast sensitivity.

    Parameters
    ----------
    scene
        ``"gallery"``, ``"pattern-a"``, ``"pattern-b"``, ``"pattern-c"``, ``"stripes"`` or ``"csf-chart"``.
    view
        As in :func:`score`. The gallery needs one.
    resolution
        Width and height in pixels; by default those of the display.
    frames
        The number of frames.
    fps
        Frames per second.
    samples
        Samples for each pixel.
    seed
        Seed of everything that looks random.
    eye
        ``"left"`` or ``"right"``; by default an eye in the middle between both.
    ipd_mm
        Distance between the pupils in millimetres.

    Returns
    -------
    Gallery
        Its frames, which are drawn when they are asked for.

    Examples
    --------
    >>> import fovqa
    >>> hall = fovqa.gallery(view={"fov_vertical_deg": 100}, resolution=(120, 100), frames=3, samples=1)
    >>> hall
    Gallery(gallery, 3 frames of 120x100, 90 per second)
    >>> hall[0].image.shape, hall[0].motion.shape, hall.gaze.shape
    ((100, 120, 3), (100, 120, 2), (3, 2))
    """
    of_scene: dict[str, Any] = {
        "name": "scene",
        "builtin": scene,
        "resolution": resolution_text(resolution),
        "samples": samples,
        "seed": seed,
        "fps": fps,
        "frames": frames,
        "ipd_mm": None if eye is None else ipd_mm,
    }
    document = {
        "name": "gallery",
        "view": view_table(view),
        "scene": [of_scene],
        "method": [{"name": "test", "test": "test" if eye is None else {"left": "left", "right": "right"}}],
    }
    return Gallery(_native.Gallery(document, eye))
