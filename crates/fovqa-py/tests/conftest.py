"""Frames and paths that the tests share."""

from __future__ import annotations

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

ROOT = Path(__file__).resolve().parents[3]
"""The root of the repository."""
ROOM = ROOT / "tests" / "data" / "small" / "living-room"
"""Real renders of a scene."""


@pytest.fixture
def room() -> tuple[np.ndarray, np.ndarray]:
    """A real ground truth and a foveated render of it."""
    return tuple(np.asarray(Image.open(ROOM / name)) for name in ("gt.png", "rmfr.png"))


@pytest.fixture
def random() -> np.random.Generator:
    """Random numbers that are the same in each run."""
    return np.random.default_rng(7)


def command(*arguments: object, code: int = 0) -> str:
    """What the command prints that the wheel installs."""
    program = shutil.which("fovqa", path=str(Path(sys.executable).parent))
    assert program is not None, "the wheel installs the command"
    done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=300)
    assert done.returncode == code, done.stderr
    return done.stdout
