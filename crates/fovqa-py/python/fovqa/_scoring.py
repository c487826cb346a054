"""Scores frames."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from . import _native
from ._documents import (
    Metrics,
    View,
    frames_text,
    gaze_of,
    guides_of,
    metrics_table,
    plain,
    view_table,
    warn,
    without_defaults,
)
from ._errors import RequestError
from ._progress import Progress, Reporter
from ._score import Score


def score(
    reference: Any,
    test: Any,
    *,
    metrics: Metrics | None = None,
    view: View | None = None,
    signal: Mapping[str, Any] | None = None,
    gaze: Any = None,
    right_reference: Any = None,
    right_test: Any = None,
    mask: Any = None,
    crop: Sequence[int] | None = None,
    motion: Any = None,
    depth: Any = None,
    fps: float | None = None,
    frames: str | range | None = None,
    allow_missing: bool = False,
    maps: bool = False,
    progress: Progress = True,
) -> Score:
    """Score test frames (foveated renders) against reference frames (ground truth).

    The numbers are exactly those of the command ``fovqa score``.

    Parameters
    ----------
    reference, test
        Frames: an array of height x width or height x width x 3; an array of frames x height x width x 3; a path
        (a file, a folder, a glob, a pattern such as ``gt.%04d.exr``, a y4m video); or a sequence of arrays or paths,
        of which only the frames that are needed are fetched. uint8 and uint16 are codes of a display, float16 and
        float32 are linear light, unless ``signal={"transfer": "srgb"}`` says that they are encoded. A C-contiguous
        array is not copied; it must not be written to meanwhile.
    metrics
        Names, such as ``["psnr", "ssim"]``, or parameters by name, such as ``{"ssim": {"sigma": 1.5}}``. By default
        mse, psnr, ssim, fpsnr, rms_contrast, haar and, for sequences, atd; those that need a view are left out
        without one. :func:`metrics` lists all.
    view
        How large the frame appears: the name of a display (:func:`displays`), or a dict with the keys of ``[view]`` in
        an experiment file, such as ``{"fov_vertical_deg": 100, "bands_deg": [0, 10, 30]}``.
    signal
        How values become the signal: the keys of ``[signal]``, such as ``{"tonemap": "reinhard"}``.
    gaze
        Where the eye looks: (x, y) in pixels, an array of frames x 2, or the path of a CSV trace. By default the
        principal point. Of two eyes, ``{"left": (x, y), "right": (x, y)}``.
    right_reference, right_test
        The frames of the right eye, if there are two; ``reference`` and ``test`` are then those of the left eye.
    mask
        A path, or an array of height x width: pixels count where it is True, or brighter than half.
    crop
        The rectangle to score: (x, y, width, height) in pixels. The view describes it.
    motion, depth
        For ATD: arrays of each frame (height x width x 2: where the pixel was in the frame before, in pixels to the
        right and down from where it is; height x width), or what an experiment file says of files, such as
        ``"blender"``.
    fps
        Frames per second, for FovVideoVDP of a sequence.
    frames
        Only these frame numbers: ``"A..B"`` or ``"A..B:STEP"``, without B, or a range.
    allow_missing
        Whether frames without a partner are skipped.
    maps
        Whether to keep the maps of each frame (:attr:`Score.maps`).
    progress
        A function that is called with the number of frames that are done, their number, and what is done; or whether to
        show a bar, if tqdm is installed.

    Returns
    -------
    Score
        The scores. Frames that could not be scored are in :attr:`Score.failures`.

    Raises
    ------
    RequestError
        If an argument is wrong.
    InputError
        If frames are missing, cannot be read or do not fit, or nothing could be scored.

    Examples
    --------
    >>> import fovqa
    >>> import numpy as np
    >>> reference = np.arange(64 * 96 * 3, dtype=np.uint8).reshape(64, 96, 3)
    >>> test = reference // 16 * 16
    >>> fovqa.score(reference, test, metrics=["psnr", "ssim"], view={"fov_vertical_deg": 60})
    Score(psnr=29.24, ssim=0.9950)
    """
    if not isinstance(maps, bool):
        raise TypeError("maps is True or False; the maps are those of the metrics")
    scene: dict[str, Any] = {"name": "scene", "fps": fps, "frames": frames_text(frames)}
    if allow_missing:
        scene["allow_missing"] = True
    has_two_eyes = right_reference is not None or right_test is not None
    if has_two_eyes and (right_reference is None or right_test is None):
        given, lacks = ("right_reference", "right_test") if right_test is None else ("right_test", "right_reference")
        raise RequestError([(f"there is {given}, but no {lacks}", "give both, or none")])
    sides = {"left": "left", "right": "right"}
    scene["reference"] = sides if has_two_eyes else "reference"
    test_key: Any = sides if has_two_eyes else "test"
    scene["gaze"], points = gaze_of(gaze)
    mask_array = None
    if isinstance(mask, str) or hasattr(mask, "__fspath__"):
        scene["mask"] = mask
    else:
        mask_array = mask
    scene["crop"] = crop
    scene["motion"], motion_arrays = guides_of(motion)
    scene["depth"], depth_arrays = guides_of(depth)
    document = {
        "name": "score",
        "view": view_table(view),
        "signal": plain(signal, "signal"),
        "scene": [scene],
        "method": [{"name": "test", "test": test_key}],
        "metrics": metrics_table(metrics),
    }
    with Reporter(progress) as callback:
        found = _native.score(
            document,
            (reference, right_reference) if has_two_eyes else reference,
            (test, right_test) if has_two_eyes else test,
            motion=motion_arrays,
            depth=depth_arrays,
            mask=mask_array,
            gaze=points,
            maps=maps,
            progress=callback,
        )
    result = Score(found)
    unasked = metrics is None and view is None
    warn(without_defaults(result.warnings) if unasked else result.warnings)
    warn(f"frame {of.frame} could not be scored: {of.message}" for of in result.failures)
    return result
