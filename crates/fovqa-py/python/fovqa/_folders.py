"""Folders for results."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ._documents import PathLike


@contextmanager
def results_folder(output: PathLike | None) -> Iterator[Path]:
    """A folder for results: the given one, or one that is removed again."""
    if output is not None:
        yield Path(os.fspath(output))
        return
    folder = Path(tempfile.mkdtemp(prefix="fovqa-"))
    try:
        yield folder / "results"
    finally:
        shutil.rmtree(folder, ignore_errors=True)
