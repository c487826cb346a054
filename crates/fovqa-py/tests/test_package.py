"""The package as a whole: its command, types, examples and documentation."""

from __future__ import annotations

import base64
import doctest
import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import fovqa
from conftest import ROOT, command

PACKAGE = Path(fovqa.__file__).parent
NOTEBOOK = ROOT / "docs" / "python.ipynb"


def modules():
    """All modules of the package that are written in Python."""
    names = [of.name for of in pkgutil.iter_modules([str(PACKAGE)]) if of.name not in ("_native", "__main__")]
    return [fovqa, *(importlib.import_module(f"fovqa.{name}") for name in names)]


def test_the_command_is_installed():
    version = command("--version")
    assert version == f"fovqa {fovqa.__version__}\n"
    module = subprocess.run(
        [sys.executable, "-m", "fovqa", "list", "metrics"], capture_output=True, text=True, check=True
    )
    assert module.stdout == command("list", "metrics") and module.stdout.startswith("mse (MSE)")
    # A long text without a newline at its end is written whole.
    assert command("completions", "bash").count("\n") > 100
    command("score", "nowhere.png", "nowhere.png", code=3)
    command("score", code=2)


@pytest.mark.filterwarnings("ignore::fovqa.FovqaWarning")
@pytest.mark.parametrize("module", modules(), ids=lambda module: module.__name__)
def test_examples_in_the_documentation_are_right(module, capsys):
    found = doctest.testmod(module)
    assert found.failed == 0, capsys.readouterr().out


def test_each_function_has_an_example():
    examples = {test.name for test in doctest.DocTestFinder(exclude_empty=True).find(fovqa) if test.examples}
    for name in ("score", "foveate", "run", "curves", "gallery", "study", "profile", "metrics", "methods", "displays"):
        assert f"fovqa.{name}" in examples or getattr(fovqa, name).__doc__.count(">>>"), name


def test_everything_public_is_documented():
    for name in fovqa.__all__:
        of = getattr(fovqa, name)
        if name == "__version__":
            continue
        assert of.__doc__, name
        members = inspect.getmembers(of) if inspect.isclass(of) else []
        own = [(key, value) for key, value in members if not key.startswith("_") and key in vars(of)]
        for key, value in own:
            assert inspect.getdoc(value), f"{name}.{key}"
        if inspect.isfunction(of):
            for parameter in inspect.signature(of).parameters:
                assert re.search(rf"(^|[ ,*]){parameter}(,|\n)", of.__doc__, re.MULTILINE), f"{name}: {parameter}"


def test_the_types_are_right(tmp_path):
    user = tmp_path / "user.py"
    user.write_text(
        """
import numpy as np
import fovqa

frame = np.zeros((64, 48, 3), np.uint8)
score: fovqa.Score = fovqa.score(frame, frame, metrics=["psnr"], view={"fov_vertical_deg": 60})
psnr: float | None = score.psnr
share: float = fovqa.foveate(frame, "rmfr", sigma=2.6).samples_share
svg: str = score.profile("psnr").svg
reveal_type(score.maps)
fovqa.score(frame)  # type: ignore[call-arg]
fovqa.score(frame, frame, maps="yes")  # type: ignore[arg-type]
"""
    )
    environment = {**os.environ, "MYPY_CACHE_DIR": str(tmp_path / "cache")}
    mypy = [sys.executable, "-m", "mypy", "--strict"]
    of_user = subprocess.run([*mypy, str(user)], capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert of_user.returncode == 0, of_user.stdout
    assert "dict[str, numpy.ndarray" in of_user.stdout
    of_package = subprocess.run([*mypy, "-p", "fovqa"], capture_output=True, text=True, cwd=tmp_path, env=environment)
    assert of_package.returncode == 0, of_package.stdout
    stubs = subprocess.run(
        [sys.executable, "-m", "mypy.stubtest", "fovqa._native"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env=environment,
    )
    assert stubs.returncode == 0, stubs.stdout


@pytest.mark.filterwarnings("ignore::fovqa.FovqaWarning")
@pytest.mark.parametrize("document", ["README.md", "docs/python.md", "crates/fovqa-py/README.md"])
def test_python_in_documents_runs(document, tmp_path, monkeypatch):
    """In a folder with the files of the repository, where results may be written."""
    for name in ("tests", "configs"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / document).read_text(), re.MULTILINE | re.DOTALL)
    assert blocks
    names: dict = {}
    for block in blocks:
        exec(compile(block, document, "exec"), names)
    assert (tmp_path / "figure.pdf").read_bytes().startswith(b"%PDF")


def test_the_notebook_runs_and_shows_pictures():
    """FOVQA_WRITE_NOTEBOOK=1 writes its outputs."""
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(NOTEBOOK, as_version=4)
    kept = [cell.get("outputs") for cell in notebook.cells]
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(ROOT)}}).execute()

    def texts(outputs):
        return [of["data"].get("text/plain") for of in outputs or [] if "data" in of]

    if os.environ.get("FOVQA_WRITE_NOTEBOOK"):
        for cell in notebook.cells:
            cell.metadata = {}
        notebook.metadata["language_info"] = {"name": "python"}
        nbformat.write(notebook, NOTEBOOK)
    else:
        assert [texts(of) for of in kept] == [texts(cell.get("outputs")) for cell in notebook.cells]
    data = [of["data"] for cell in notebook.cells for of in cell.get("outputs", []) if "data" in of]
    pictures = [base64.b64decode(of["image/png"]) for of in data if "image/png" in of]
    assert len(pictures) >= 2 and all(picture.startswith(b"\x89PNG") for picture in pictures)
    assert any("image/svg+xml" in of for of in data) and any("text/html" in of for of in data)
