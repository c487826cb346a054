"""What a foveation method would have shown of finished frames."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import _native
from ._documents import View, frames_text, gaze_of, guides_of, plain, view_table, warn
from ._errors import RequestError
from ._progress import Progress, Reporter
from ._score import Failure
from ._tables import numbers

if TYPE_CHECKING:
    from numpy.typing import NDArray


class Foveated:
    """Frames as a foveation method would have shown them. A notebook shows the first."""

    def __init__(self, found: dict[str, Any]) -> None:
        self._json: str = found["json"]
        self._text: str = found["text"]
        self._frames: list[tuple[int, NDArray[Any], list[NDArray[Any]]]] = found["frames"]
        self._parsed: dict[str, Any] | None = None
        self.warnings: list[str] = found["warnings"]
        """What the user should know. Each is one sentence."""
        self.failures: list[Failure] = [Failure(*failure) for failure in found["failures"]]
        """The frames that could not be emulated."""

    @property
    def image(self) -> NDArray[Any]:
        """The first frame: the type of the input (of floats: float32), height x width or height x width x 3."""
        return self._frames[0][1]

    @property
    def images(self) -> list[NDArray[Any]]:
        """All frames."""
        return [image for _, image, _ in self._frames]

    @property
    def buffers(self) -> list[NDArray[Any]]:
        """The reduced buffers of the first frame, the innermost layer first, if ``buffers=True`` was asked for."""
        return self._frames[0][2]

    @property
    def numbers(self) -> list[int]:
        """The numbers of the frames."""
        return [number for number, _, _ in self._frames]

    @property
    def samples(self) -> float:
        """The samples of the first frame."""
        samples: float = self.to_dict()["frames"][0]["samples"]
        return samples

    @property
    def samples_share(self) -> float:
        """The samples of the first frame over its pixels."""
        share: float = self.to_dict()["frames"][0]["samples_share"]
        return share

    @property
    def parameters(self) -> dict[str, Any]:
        """All parameters that applied, by name."""
        parameters: dict[str, Any] = self.to_dict()["parameters"]
        return parameters

    def to_dict(self) -> dict[str, Any]:
        """The method, its parameters and samples, with the keys of ``fovqa foveate --format json``.

        Returns
        -------
        dict
            As docs/files.md describes it.
        """
        if self._parsed is None:
            self._parsed = numbers(json.loads(self._json))
        return self._parsed

    def __len__(self) -> int:
        return len(self._frames)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        import numpy as np

        return np.asarray(self.image if len(self) == 1 else np.stack(self.images), dtype=dtype)

    def __repr__(self) -> str:
        of = self.to_dict()
        frames = "" if len(self) == 1 else f", {len(self)} frames"
        return f"Foveated({of['method']}, {self.samples_share:.1%} of the pixels{frames})"

    def __str__(self) -> str:
        return self._text

    def _repr_png_(self) -> bytes:
        return _native.png(self.image)


def foveate(
    images: Any,
    method: str | Mapping[str, Any],
    *,
    view: View | None = None,
    gaze: Any = None,
    budget: float | None = None,
    budget_of: str | None = None,
    sampling: str | None = None,
    jitter: str | None = None,
    filter: str | None = None,
    space: str | None = None,
    temporal: bool | None = None,
    enhance: float | None = None,
    signal: Mapping[str, Any] | None = None,
    crop: Sequence[int] | None = None,
    motion: Any = None,
    fps: float | None = None,
    frames: str | range | None = None,
    buffers: bool = False,
    progress: Progress = True,
    **parameters: Any,
) -> Foveated:
    """Show what a foveation method would have shown of finished frames, and what it would have shaded.

    Parameters
    ----------
    images
        Frames, as in :func:`score`.
    method
        The name of a method (:func:`methods`), or a dict with its keys: ``{"model": "rmfr", "sigma": 2.6}``.
    view, gaze, signal, crop, motion, fps
        As in :func:`score`.
    budget
        Samples as a share of the frame's pixels, such as 0.15: it sets the method's free parameter.
    budget_of
        The samples that the budget counts: ``"all"``, or ``"screen"`` for those in the frame.
    sampling
        How a sample reads the frame: ``"point"`` (the default) or ``"area"``.
    jitter
        How samples move from frame to frame: ``"none"`` (the default) or ``"halton"``.
    filter
        The method's own filters: ``"none"`` (the default), ``"own"``, ``"buffer"`` or ``"screen"``.
    space
        The values that the method works on: ``"encoded"`` (the default) or ``"linear"``.
    temporal
        Whether a temporal filter follows the method, along the motion vectors.
    enhance
        The strength of contrast enhancement in the periphery.
    frames
        Only these frame numbers: ``"A..B"`` or ``"A..B:STEP"``, without B, or a range.
    buffers
        Whether to keep the reduced buffers.
    progress
        As in :func:`score`.
    **parameters
        Parameters of the method, such as ``sigma=2.6``.

    Returns
    -------
    Foveated
        The frames and their samples.

    Raises
    ------
    RequestError
        If an argument is wrong.
    InputError
        If frames are missing or cannot be read, or nothing could be emulated.

    Examples
    --------
    >>> import fovqa
    >>> hall = fovqa.gallery(view={"fov_vertical_deg": 100}, resolution=(160, 140), samples=1)
    >>> coarse = fovqa.foveate(hall[0].encoded, "rmfr", gaze=hall[0].gaze, budget=0.15)
    >>> coarse.image.shape, coarse.image.dtype.name
    ((140, 160, 3), 'uint8')
    >>> round(coarse.samples_share, 2)
    0.15
    """
    scene: dict[str, Any] = {
        "name": "scene",
        "reference": "input",
        "fps": fps,
        "frames": frames_text(frames),
        "crop": crop,
    }
    scene["gaze"], points = gaze_of(gaze)
    if isinstance(scene["gaze"], list):
        # Many methods need no view, only the place.
        points = [scene.pop("gaze")]
    scene["motion"], motion_arrays = guides_of(motion)
    if isinstance(method, Mapping):
        keys = plain(method)
        if "model" not in keys:
            raise RequestError([("the method has no model", "name it: {'model': 'rmfr', 'sigma': 2.6}")])
    else:
        keys = {"model": method}
    around = {
        "budget": budget,
        "budget_of": budget_of,
        "sampling": sampling,
        "jitter": jitter,
        "filter": filter,
        "space": space,
        "temporal": temporal,
        "enhance": enhance,
    }
    given = {key: value for key, value in {**around, **parameters}.items() if value is not None}
    twice = [key for key in given if key in keys]
    if twice:
        raise RequestError([(f"{', '.join(twice)} in the method and as an argument", "give it once")])
    keys.update(given)
    document = {
        "name": "foveate",
        "view": view_table(view),
        "signal": plain(signal, "signal"),
        "scene": [scene],
        "method": [{"name": "test", "emulate": keys}],
    }
    with Reporter(progress) as callback:
        found = _native.foveate(document, images, motion=motion_arrays, gaze=points, buffers=buffers, progress=callback)
    result = Foveated(found)
    warn(result.warnings)
    warn(f"frame {of.frame} could not be emulated: {of.message}" for of in result.failures)
    return result
