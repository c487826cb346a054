"""Experiments, curves and studies give the files of the command."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
import tomllib

import fovqa
from conftest import ROOT, command

EXPERIMENT = ROOT / "configs" / "renders.toml"


def files(folder: Path) -> dict[str, bytes]:
    """All files of a folder that are the same in each run."""
    found = {str(path.relative_to(folder)): path for path in sorted(folder.rglob("*")) if path.is_file()}
    return {name: path.read_bytes() for name, path in found.items() if not name.endswith((".lock", "provenance.json"))}


def test_a_run_writes_the_files_of_the_command(tmp_path):
    command("run", EXPERIMENT, "--output", tmp_path / "command")
    told = []
    found = fovqa.run(EXPERIMENT, output=tmp_path / "python", progress=lambda *done: told.append(done))
    assert files(tmp_path / "python") == files(tmp_path / "command")
    assert found.scored > 0 and found.failures == [] and "drawing figures" in {what for _, _, what in told}
    assert found.report.is_file() and found.table.startswith("|") and found.table in found._repr_markdown_()
    assert len(found.figures) > 3 and found.figures["profile-psnr"].svg.startswith("<svg")
    assert "table" in found.tables
    assert found.to_dict() == json.loads((tmp_path / "command" / "summary.json").read_text())
    values = found.to_pandas()
    assert len(values) == len((tmp_path / "command" / "results.csv").read_text().splitlines()) - 1
    assert values["value"].tolist() == found.to_polars()["value"].to_list()
    again = fovqa.load(tmp_path / "python")
    assert again.table == found.table and again.scored is None
    with pytest.raises(fovqa.InputError, match="there is no run.json"):
        fovqa.load(tmp_path)
    with pytest.raises(KeyError, match="there is no figure profil-psnr; there are"):
        _ = found.figures["profil-psnr"]


def test_a_dict_is_an_experiment(tmp_path, monkeypatch):
    monkeypatch.chdir(EXPERIMENT.parent)
    table = tomllib.loads(EXPERIMENT.read_text())
    found = fovqa.run(table, output=tmp_path / "dict", progress=False)
    file = fovqa.run(EXPERIMENT, output=tmp_path / "file", progress=False)
    assert found.summary == file.summary and found.to_pandas().equals(file.to_pandas())
    first = fovqa.run(table, output=tmp_path / "1", shard="1/2", progress=False)
    assert first.scored < found.scored
    with pytest.raises(fovqa.RequestError, match="shard"):
        fovqa.run(table, output=tmp_path / "3", shard="3/2")


def test_mistakes_in_a_file_are_named_with_their_lines(tmp_path):
    path = tmp_path / "wrong.toml"
    path.write_text('name = "wrong"\n[metrics]\npsrn = {}\n')
    with pytest.raises(fovqa.ExperimentError) as caught:
        fovqa.run(path)
    assert f"{path}:3:1: [metrics] has no metric `psrn`; did you mean psnr?" in str(caught.value)
    assert len(caught.value.complaints) > 1 and isinstance(caught.value, ValueError)
    with pytest.raises(fovqa.ExperimentError, match="there is no such file"):
        fovqa.run(tmp_path / "nowhere.toml")
    with pytest.raises(fovqa.RequestError, match="\\[metrics\\] has no metric `psrn`"):
        fovqa.run({"name": "wrong", "metrics": {"psrn": {}}})
    with pytest.raises(fovqa.RequestError, match="this is a curve file"):
        fovqa.run(ROOT / "configs" / "curves" / "headset.toml")
    with pytest.raises(TypeError, match="the path of a TOML file or a dict"):
        fovqa.run(5)


def test_a_run_is_found_from_another_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = fovqa.run(EXPERIMENT, output="here", progress=False)
    opened = fovqa.load("here")
    monkeypatch.chdir("/")
    assert found.figures["profile-psnr"].svg == opened.figures["profile-psnr"].svg
    assert len(opened.to_pandas()) == len(found.to_pandas())
    with pytest.raises(fovqa.InputError, match="there is no run.json"):
        fovqa.load(EXPERIMENT)


def test_words_are_those_of_python(tmp_path):
    with pytest.raises(fovqa.RequestError) as caught:
        fovqa.run({"name": "one", "scene": {"name": "a", "reference": "b"}})
    assert ("scene cannot be a table", "give a list of dicts") in caught.value.complaints
    (tmp_path / "file").touch()
    with pytest.raises(fovqa.InputError) as caught:
        fovqa.run(EXPERIMENT, output=tmp_path / "file" / "folder", progress=False)
    assert "--" not in str(caught.value) and "output" in caught.value.help
    with pytest.raises(fovqa.RequestError, match="large array"):
        fovqa.run({"name": "x", "scene": [{"name": "x", "reference": np.zeros((2000, 2000, 3), np.uint8)}]})


def test_what_fails_in_a_run_is_warned_of(tmp_path):
    table = {
        "name": "half",
        "scene": [
            {"name": "there", "builtin": "pattern-a", "resolution": "64x48", "samples": 1},
            {"name": "lacking", "reference": "nowhere.png"},
        ],
        "method": [{"name": "A", "emulate": {"model": "rmfr"}}],
        "metrics": {"psnr": {}},
    }
    with pytest.warns(fovqa.FovqaWarning, match="nowhere.png"):
        found = fovqa.run(table, output=tmp_path, progress=False)
    assert found.scored == 1 and len(found.failures) == 1 and "1 errors" in repr(found)


def test_curves_are_those_of_the_command(tmp_path):
    path = ROOT / "configs" / "curves" / "headset.toml"
    command("curves", path, "--output", tmp_path / "command")
    found = fovqa.curves(path, output=tmp_path / "python")
    assert files(tmp_path / "python") == files(tmp_path / "command")
    assert fovqa.curves(path).to_csv() == found.to_csv() == (tmp_path / "command" / "curves.csv").read_text()
    assert list(found.figures) == ["density", "rates"] and found.figures["density"].svg in found._repr_html_()
    assert found.to_dict()["curves"] and len(found.to_pandas()) == len(found.to_polars())
    one = command("curves", "--method", "rmfr", "--set", "sigma=2.6", "--display", "vive-pro-eye", "--gaze", "900,700")
    curve = fovqa.curves(method="rmfr", sigma=2.6, view="vive-pro-eye", gaze=(900, 700)).to_pandas()
    for name in ("eccentricity_deg", "radial_cpd", "tangential_cpd"):
        column = one.splitlines()[0].split(",").index(name)
        wanted = [float(line.split(",")[column]) for line in one.splitlines()[1:]]
        assert curve[name].tolist() == wanted
    two = fovqa.curves(method=["rmfr", {"model": "rmfr", "sigma": 3}], acuity="piecewise", view="vive-pro-eye")
    assert {curve["name"] for curve in two.to_dict()["curves"]} == {"rmfr", "rmfr (2)", "piecewise"}
    for arguments, message in [
        ({}, "nothing to draw"),
        ({"method": "rmfr"}, "view"),
        ({"method": ["rmfr", "kfr"], "sigma": 2}, "sigma of 2 methods"),
        ({"source": path, "method": "rmfr"}, "method and a file"),
        ({"method": "rmrf", "view": "vive-pro-eye"}, "rmfr"),
    ]:
        with pytest.raises(fovqa.RequestError, match=message):
            fovqa.curves(**arguments)


def test_studies_are_those_of_the_command(tmp_path):
    path = ROOT / "configs" / "studies" / "votes.toml"
    command("study", path, "--output", tmp_path / "command")
    found = fovqa.study(path, output=tmp_path / "python")
    assert files(tmp_path / "python") == files(tmp_path / "command")
    assert len(found.figures) > 0 and len(found.tables) > 0
    table = ROOT / "configs" / "studies" / "data" / "votes.csv"
    wanted = json.loads(command("study", "pairs", table, "--by", "scene", "--reference", "full", "--format", "json"))
    import pandas
    import polars

    frame = pandas.read_csv(table)
    for given in (table, frame, polars.read_csv(table), frame.to_dict("list")):
        result = fovqa.study(given, "pairs", by="scene", reference="full").results[0]
        assert result["groups"] == wanted["groups"]
    with pytest.raises(fovqa.InputError, match='^analysis "pairs": table.csv, line 1: there is no column'):
        fovqa.study({"a": [1, 2]}, "pairs")
    with pytest.raises(fovqa.InputError, match="different lengths"):
        fovqa.study({"a": [1, 2], "b": [1]}, "pairs")
    with pytest.raises(fovqa.RequestError, match="cannot be"):
        fovqa.study(frame, "pears")
    with pytest.raises(fovqa.RequestError, match="without a kind"):
        fovqa.study(path, by="scene")
    with pytest.raises(TypeError, match="a data frame or a dict of columns"):
        fovqa.study(5, "pairs")
