"""Scores foveated renders against ground truth, by eccentricity.

>>> import fovqa
>>> view = {"fov_vertical_deg": 100}
>>> reference = fovqa.gallery(view=view, resolution=(160, 160), samples=1)[0].encoded
>>> coarse = fovqa.foveate(reference, "rmfr", view=view, budget=0.15)
>>> score = fovqa.score(reference, coarse.image, view=view)
>>> score.psnr > 15
True
>>> score.profile("psnr")
Figure(profile-psnr)
"""

from __future__ import annotations

import atexit as _atexit
import os as _os

from . import _native
from ._curves import Curves, curves
from ._errors import ExperimentError, FovqaError, FovqaWarning, InputError, RequestError
from ._figures import Figure, Figures, Picture
from ._foveate import Foveated, foveate
from ._frames import Frame, read, show
from ._gallery import Gallery, GalleryFrame, gallery
from ._lists import displays, methods, metrics
from ._run import Run, load, run
from ._score import Band, Failure, Score, profile
from ._scoring import score
from ._study import Study, study

__version__: str = _native.__version__


def set_threads(threads: int) -> None:
    """Choose the number of threads of all calls. By default, it is the number of cores.

    Parameters
    ----------
    threads
        From 1 to 256. It can be chosen once, before the first call that works.

    Raises
    ------
    RequestError
        If the threads were started already.
    """
    _native.set_threads(threads)


# The threads of a process do not exist in a child that was forked from it.
if hasattr(_os, "register_at_fork"):
    _os.register_at_fork(after_in_child=_native.after_fork)

# No thread may use the interpreter after its end.
_atexit.register(_native.shutdown)

__all__ = [
    "Band",
    "Curves",
    "ExperimentError",
    "Failure",
    "Figure",
    "Figures",
    "Foveated",
    "FovqaError",
    "FovqaWarning",
    "Frame",
    "Gallery",
    "GalleryFrame",
    "InputError",
    "Picture",
    "RequestError",
    "Run",
    "Score",
    "Study",
    "__version__",
    "curves",
    "displays",
    "foveate",
    "gallery",
    "load",
    "methods",
    "metrics",
    "profile",
    "read",
    "run",
    "score",
    "set_threads",
    "show",
    "study",
]
