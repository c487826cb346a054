"""The native part. The classes and functions for people are in the package."""

import os
from collections.abc import Callable, Sequence
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Gallery",
    "Lock",
    "Sharded",
    "__version__",
    "after_fork",
    "command",
    "curves",
    "displays",
    "foveate",
    "merge",
    "methods",
    "metrics",
    "png",
    "profile",
    "read",
    "run",
    "score",
    "set_threads",
    "shutdown",
    "study",
]
__version__: str

_Path = str | os.PathLike[str]
_Progress = Callable[[str, int, int], object] | None

def score(
    document: dict[str, Any],
    reference: Any,
    test: Any,
    *,
    motion: Any | None = None,
    depth: Any | None = None,
    mask: Any | None = None,
    gaze: list[list[float]] | None = None,
    maps: bool = False,
    progress: _Progress = None,
) -> dict[str, Any]: ...
def foveate(
    document: dict[str, Any],
    images: Any,
    *,
    motion: Any | None = None,
    gaze: list[list[float]] | None = None,
    buffers: bool = False,
    progress: _Progress = None,
) -> dict[str, Any]: ...
def run(
    experiment: Any,
    *,
    output: _Path | None = None,
    resume: bool = False,
    shard: str | None = None,
    frames: str | None = None,
    maps: _Path | None = None,
    lock: bool = True,
    progress: _Progress = None,
) -> dict[str, Any]: ...
def merge(
    path: Any,
    text: str,
    shards: Sequence[_Path],
    output: _Path,
    *,
    lock: bool = True,
    progress: _Progress = None,
) -> dict[str, Any]: ...
def curves(curves: Any, output: _Path, *, progress: _Progress = None) -> dict[str, Any]: ...
def study(study: Any, output: _Path, *, progress: _Progress = None) -> dict[str, Any]: ...
def read(
    document: dict[str, Any], path: _Path, *, frame: int | None = None, guides: bool = False
) -> dict[str, Any]: ...
def profile(
    document: dict[str, Any],
    metric: str,
    lines: list[tuple[str, bool, list[tuple[float, float, float | None]]]],
    title: str | None,
    format: str,
) -> bytes: ...
def png(image: Any, document: dict[str, Any] | None = None) -> bytes: ...
def metrics() -> str: ...
def methods() -> str: ...
def displays() -> str: ...
def set_threads(threads: int) -> None: ...
def after_fork() -> None: ...
def shutdown() -> None: ...
def command(arguments: list[str]) -> int: ...

@final
class Gallery:
    def __new__(cls, document: dict[str, Any], eye: str | None = None) -> Gallery: ...
    def __len__(self) -> int: ...
    def about(self) -> tuple[str, int, int, float]: ...
    def image(self, frame: int) -> NDArray[np.float32]: ...
    def encoded(self, frame: int) -> NDArray[np.uint8]: ...
    def guides(self, frame: int) -> tuple[NDArray[np.float32], NDArray[np.float32]]: ...
    def gaze(self, frame: int) -> list[float]: ...
    def write(self, folder: _Path, progress: _Progress = None) -> int: ...

@final
class Sharded:
    def __new__(
        cls,
        experiment: Any,
        text: str | None = None,
        *,
        frames: str | None = None,
        maps: _Path | None = None,
        lock: bool = True,
    ) -> Sharded: ...
    def foresee(self) -> list[str]: ...
    @property
    def path(self) -> os.PathLike[str]: ...
    @property
    def text(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def frames(self) -> int: ...
    @property
    def pairs(self) -> int: ...
    @property
    def reads_frames_before(self) -> bool: ...
    @property
    def fingerprint(self) -> str: ...
    def score(self, shard: str, folder: _Path, *, resume: bool = True) -> dict[str, Any]: ...

@final
class Lock:
    def __new__(cls, folder: _Path) -> Lock: ...
    def release(self) -> None: ...
