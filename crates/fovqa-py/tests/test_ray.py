"""Runs on Ray have the bytes of one process, whatever dies on the way."""

from __future__ import annotations

import json
import os
import random
import re
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import pytest

if os.environ.get("FOVQA_REQUIRE_RAY") != "1":
    pytest.importorskip("ray", reason="tests of fovqa.ray need Ray: make test-ray")

import fovqa
import fovqa.ray
from conftest import ROOM, ROOT
from fovqa.ray import _driver, _job, _scorer
from test_run import files

T = TypeVar("T")

#: Measures over time, two eyes, a method with a temporal filter, and a scene whose frames are files.
EXPERIMENT = f"""
name = "units"
[view]
display = "htc-vive-pro"
[[scene]]
name = "walk"
builtin = "gallery"
resolution = "96x80"
samples = 1
frames = 7
fps = 24
[[scene]]
name = "room"
reference = "{ROOM}/gt.png"
fps = 24
[[scene]]
name = "eyes"
fps = 24
reference = {{ left = "left.png", right = "right.png" }}
[[method]]
name = "RMFR"
emulate = {{ model = "rmfr", budget = 0.15 }}
[[method]]
name = "KFR"
emulate = {{ model = "kfr", budget = 0.1 }}
[metrics]
psnr = {{}}
ssim = {{}}
atd = {{}}
flicker = {{ frames = 4 }}
spectrum = {{ block = 32 }}
fvvdp = {{}}
"""

#: Units that take long enough to be interrupted.
SLOW = """
name = "slow"
[view]
fov_vertical_deg = 100
[[scene]]
name = "walk"
builtin = "gallery"
resolution = "500x500"
samples = 4
frames = 8
[[method]]
name = "RMFR"
emulate = { model = "rmfr", budget = 0.15 }
[metrics]
psnr = {}
[report]
frames = []
[[plot]]
kind = "table"
"""


@pytest.fixture(scope="module")
def own_ray() -> Iterator[None]:
    """One Ray for several runs."""
    import ray

    ray.init(address="local", num_cpus=2, object_store_memory=256 << 20, include_dashboard=False, log_to_driver=False)
    yield
    ray.shutdown()


@pytest.fixture
def experiment(tmp_path: Path) -> Path:
    for eye in ("left", "right"):
        (tmp_path / f"{eye}.png").write_bytes((ROOM / "gt.png").read_bytes())
    (tmp_path / "e.toml").write_text(EXPERIMENT)
    return tmp_path / "e.toml"


@pytest.fixture
def slow(tmp_path: Path) -> Path:
    (tmp_path / "slow.toml").write_text(SLOW)
    fovqa.run(tmp_path / "slow.toml", output=tmp_path / "whole", progress=False)
    return tmp_path / "slow.toml"


def results(folder: Path) -> dict[str, bytes]:
    """The files that a run without Ray writes as well."""
    return {name: data for name, data in files(folder).items() if not name.startswith(("units/", "values/"))}


def record(folder: Path, unit: int, units: int) -> dict[str, Any]:
    path = folder / "units" / f"{unit:05}-of-{units:05}" / "unit.json"
    return json.loads(path.read_text()) if path.exists() else {}


def module(*arguments: object, address: str = "") -> subprocess.Popen[str]:
    """``python -m fovqa.ray`` with one worker."""
    line = [sys.executable, "-m", "fovqa.ray", *map(str, arguments), "--workers", "1", "--frames-per-unit", "2"]
    # The head of a cluster in these tests asks for no token.
    environment = {**os.environ, "RAY_ADDRESS": address} | ({"RAY_AUTH_MODE": "disabled"} if address else {})
    return subprocess.Popen(
        line,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        # A shell ignores the signal of Ctrl-C in what it runs in the background.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )


def ended(process: subprocess.Popen[str], code: int) -> str:
    """What a process has printed."""
    out, err = process.communicate(timeout=300)
    assert process.returncode == code, err
    return out + err


def until(is_so: Callable[[], T], seconds: float = 120) -> T:
    begin = time.monotonic()
    while not (found := is_so()):
        assert time.monotonic() - begin < seconds
        time.sleep(0.005)
    return found


def worker_of(folder: Path, unit: int, units: int, nth: int) -> int | None:
    """The process that tries a unit for the n-th time."""
    found = record(folder, unit, units)
    return found["pid"] if found.get("tries") == nth and "outcome" not in found else None


def kill_worker_of(folder: Path, unit: int, units: int, tries: int) -> None:
    """Kills the worker of a unit in the middle of its first tries."""
    for nth in range(1, tries + 1):
        process = until(partial(worker_of, folder, unit, units, nth))
        assert process is not None
        os.kill(process, signal.SIGKILL)


@pytest.mark.usefixtures("own_ray")
@pytest.mark.parametrize(("workers", "per_unit", "units"), [(1, 1, 10), (2, 2, 5)])
def test_bytes_are_those_of_one_process(experiment, tmp_path, monkeypatch, workers, per_unit, units):
    fovqa.run(experiment, output=tmp_path / "whole", maps=tmp_path / "maps", progress=False)

    def shuffled(folder: Path, units: int) -> list[dict[str, Any]]:
        order = list(_job.rows(folder, units))
        random.Random(workers).shuffle(order)
        return order

    monkeypatch.setattr(_driver, "rows", shuffled)
    monkeypatch.chdir(tmp_path)
    told: list[tuple[int, int, str]] = []
    done = fovqa.ray.run(
        "e.toml",
        output="out",
        workers=workers,
        frames_per_unit=per_unit,
        maps="maps-of-units",
        progress=lambda *of: told.append(of),
    )
    wanted = results(tmp_path / "whole")
    # The journal names the folder of the maps.
    wanted["journal.jsonl"] = results(tmp_path / "out")["journal.jsonl"]
    assert results(tmp_path / "out") == wanted
    assert files(tmp_path / "maps-of-units") == files(tmp_path / "maps")
    assert (done.units, done.known, done.scored, done.failures) == (units, 0, 20, [])
    assert (units, units, "units") in told and done.scoring_s > 0 and done.cpu_s > 0 and done.merging_s > 0
    assert done.table == (tmp_path / "whole" / "table.md").read_text()


@pytest.mark.usefixtures("own_ray")
def test_values_are_one_data_set(experiment, tmp_path):
    import duckdb
    import polars

    done = fovqa.ray.run(experiment, output=tmp_path / "out", frames_per_unit=2, progress=False)
    pattern = str(tmp_path / "out" / "values" / "*.parquet")
    of_units = polars.read_parquet(pattern)
    wanted = done.to_polars().with_columns(polars.col("value").cast(polars.Float64))
    assert of_units.columns == wanted.columns and len(of_units) == len(wanted) > 500

    def in_order(frame: polars.DataFrame) -> polars.DataFrame:
        texts = [name for name, kind in frame.schema.items() if kind == polars.String]
        return frame.with_columns(polars.col(texts).fill_null("")).sort(frame.columns)

    assert in_order(of_units).equals(in_order(wanted.cast(dict(of_units.schema))))
    mean = duckdb.sql(
        f"select avg(value) from '{pattern}' where metric = 'psnr' and statistic is null and from_deg is null"
        " and scene = 'walk' and method = 'RMFR' and frame is not null"
    ).fetchall()
    summary = next(of for of in done.summary["comparisons"] if (of["scene"], of["method"]) == ("walk", "RMFR"))
    assert mean[0][0] == pytest.approx(summary["metrics"]["psnr"]["mean"], rel=1e-12)
    # While units are scored, the files are those in their folders.
    assert len(list((tmp_path / "out" / "units").glob("*/values.parquet"))) == done.units


@pytest.mark.usefixtures("own_ray")
def test_finished_units_are_not_scored_again(experiment, tmp_path):
    def run(**more: Any) -> fovqa.ray.ClusterRun:
        return fovqa.ray.run(experiment, output=tmp_path / "out", progress=False, **more)

    first = run(frames_per_unit=2)
    before = results(tmp_path / "out")
    # The number of units is that of the first call.
    second = run()
    assert (first.units, first.known, second.units, second.known) == (5, 0, 5, 5)
    assert results(tmp_path / "out") == before
    # A frame that has changed is scored again, and so is what depends on it.
    from PIL import Image

    left = Image.open(tmp_path / "left.png").convert("RGB").rotate(180)
    left.save(tmp_path / "left.png")
    with pytest.warns(fovqa.FovqaWarning, match="left.png has changed"):
        third = run()
    assert (third.units, third.known) == (5, 4)
    fovqa.run(experiment, output=tmp_path / "whole", progress=False)
    assert results(tmp_path / "out") == results(tmp_path / "whole")
    # Another division, and another experiment.
    assert (run(frames_per_unit=1).known, len(list((tmp_path / "out" / "units").glob("*-of-*")))) == (0, 10)
    experiment.write_text(EXPERIMENT.replace("ssim = {}\n", ""))
    assert (run().known, run().known) == (0, 10) or run().units == 1
    fovqa.run(experiment, output=tmp_path / "whole", progress=False)
    assert results(tmp_path / "out") == results(tmp_path / "whole")


@pytest.mark.usefixtures("own_ray")
def test_what_cannot_be_scored_is_an_error_of_its_frame(experiment, tmp_path):
    experiment.write_text(EXPERIMENT.replace('"left.png"', '"e.toml"'))
    with pytest.warns(fovqa.FovqaWarning, match=r"eyes, (RMFR|KFR), left"):
        done = fovqa.ray.run(experiment, output=tmp_path / "out", frames_per_unit=2, progress=False)
    with pytest.warns(fovqa.FovqaWarning):
        whole = fovqa.run(experiment, output=tmp_path / "whole", progress=False)
    assert len(done.failures) == len(whole.failures) == 2 and done.scored == whole.scored == 18
    assert results(tmp_path / "out") == results(tmp_path / "whole")


@pytest.mark.usefixtures("own_ray")
def test_a_unit_that_always_fails_is_reported(experiment, tmp_path, monkeypatch):
    units = tmp_path / "out" / "units"
    units.mkdir(parents=True)
    (units / "00002-of-00005").write_text("no folder")
    with pytest.raises(fovqa.ray.UnitsError, match="unit 2/5: ") as caught:
        fovqa.ray.run(experiment, output=tmp_path / "out", frames_per_unit=2, progress=False)
    assert list(caught.value.failed) == ["2/5"] and "call again" in caught.value.help
    assert isinstance(caught.value, fovqa.InputError) and not (tmp_path / "out" / "run.json").exists()
    (units / "00002-of-00005").unlink()
    done = fovqa.ray.run(experiment, output=tmp_path / "out", progress=False)
    assert (done.units, done.known) == (5, 4)


def test_a_worker_that_dies_loses_nothing(slow, tmp_path):
    process = module(slow, "--output", tmp_path / "out")
    kill_worker_of(tmp_path / "out", 2, 4, tries=1)
    said = ended(process, 0)
    assert record(tmp_path / "out", 2, 4)["tries"] == 2
    assert [record(tmp_path / "out", unit, 4)["outcome"]["tries"] for unit in (1, 3, 4)] == [1, 1, 1]
    assert results(tmp_path / "out") == results(tmp_path / "whole")
    assert "note: 4 units, 1 of them in more than one try, " in said and "report.html" in said


def test_a_unit_whose_worker_always_dies_is_reported(slow, tmp_path):
    process = module(slow, "--output", tmp_path / "out")
    kill_worker_of(tmp_path / "out", 2, 4, tries=3)
    said = ended(process, 3)
    assert "error: unit 2/4: its worker died each of the 3 times that it was tried" in said
    assert "died each of the 3 times" in record(tmp_path / "out", 2, 4)["outcome"]["failed"]
    assert all("outcome" in record(tmp_path / "out", unit, 4) for unit in (1, 3, 4))
    assert "4 units, 3 of them finished before" in ended(module(slow, "--output", tmp_path / "out"), 0)
    assert results(tmp_path / "out") == results(tmp_path / "whole")


def test_a_second_call_goes_on_after_a_driver_that_died(slow, tmp_path):
    process = module(slow, "--output", tmp_path / "out")
    # Units may be scored in any order.
    until(lambda: sum("outcome" in record(tmp_path / "out", unit, 4) for unit in range(1, 5)) >= 2)
    process.kill()
    process.communicate(timeout=60)
    said = ended(module(slow, "--output", tmp_path / "out"), 0)
    known = re.search(r"4 units, (\d) of them finished before", said)
    assert known is not None and int(known[1]) >= 2, said
    assert results(tmp_path / "out") == results(tmp_path / "whole")


def test_without_frames_there_are_errors_and_no_ray(experiment, tmp_path, monkeypatch):
    experiment.write_text(
        EXPERIMENT[: EXPERIMENT.index("[[scene]]")] + EXPERIMENT[EXPERIMENT.index('[[scene]]\nname = "eyes') :]
    )
    (tmp_path / "left.png").unlink()
    (tmp_path / "right.png").unlink()
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.warns(fovqa.FovqaWarning, match=r"left\.png"):
        done = fovqa.ray.run(experiment, output=tmp_path / "out", progress=False)
    with pytest.warns(fovqa.FovqaWarning):
        fovqa.run(experiment, output=tmp_path / "whole", progress=False)
    assert (done.scored, len(done.failures)) == (0, 4)
    assert results(tmp_path / "out") == results(tmp_path / "whole")
    said = ended(module(experiment, "--output", tmp_path / "out"), 3)
    assert said.count("left.png") == 2 and "error: 4 errors, and nothing was scored" in said and "warning" not in said


def test_an_interrupted_command_says_how_to_go_on(slow, tmp_path):
    process = module(slow, "--output", tmp_path / "out")
    until(lambda: record(tmp_path / "out", 1, 4) or record(tmp_path / "out", 2, 4))
    process.send_signal(signal.SIGINT)
    assert "note: interrupted; the same command goes on" in ended(process, 130)


def test_a_cluster_that_does_not_answer_is_told(experiment, tmp_path):
    said = ended(module(experiment, "--output", tmp_path / "out", address="127.0.0.1:1"), 3)
    assert "error: the cluster at 127.0.0.1:1 (RAY_ADDRESS) cannot be joined" in said and "RAY_ADDRESS out" in said


def test_a_cluster_is_joined(experiment, tmp_path):
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    environment = {**os.environ, "RAY_AUTH_MODE": "disabled"}
    line = ["--head", "--block", "--port", str(port), "--num-cpus", "2", "--include-dashboard", "false"]
    script = [str(Path(sys.executable).parent / "ray"), "start", *line, "--object-store-memory", str(256 << 20)]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    head = subprocess.Popen(script, env=environment, start_new_session=True, **quiet)
    try:

        def answers() -> bool:
            with socket.socket() as there:
                return there.connect_ex(("127.0.0.1", port)) == 0

        until(answers)
        said = ended(module(experiment, "--output", tmp_path / "out", address=f"127.0.0.1:{port}"), 0)
        assert "note: 5 units, " in said
        # The cluster is still there for the next run.
        assert head.poll() is None and answers()
        said = ended(module(experiment, "--output", tmp_path / "out", address=f"127.0.0.1:{port}"), 0)
        assert "5 units, 5 of them finished before" in said
    finally:
        # Its processes, which would take half a minute to end by themselves.
        os.killpg(head.pid, signal.SIGKILL)
        head.wait(timeout=60)
    fovqa.run(experiment, output=tmp_path / "whole", progress=False)
    assert results(tmp_path / "out") == results(tmp_path / "whole")


def test_a_folder_has_one_call_at_a_time(experiment, tmp_path):
    lock = fovqa._native.Lock(tmp_path / "out" / "units")
    with pytest.raises(fovqa.InputError, match="another run is writing to this folder"):
        fovqa.ray.run(experiment, output=tmp_path / "out", progress=False)
    lock.release()


def test_a_worker_that_sees_other_frames_scores_nothing(experiment, tmp_path):
    # The threads of this process may have been started already, with this number.
    threads = _driver._cores()
    job = _job.Job("call", str(experiment), experiment.read_text(), None, None, True, threads, "other", True)
    row = next(_job.rows(tmp_path / "units", 1))
    assert "differ from those of the driver" in json.loads(_scorer.Scorer(job)(row)["outcome"])["fault"]
    assert not (tmp_path / "units").exists()


def test_the_reason_of_a_unit_that_was_given_up_is_kept(experiment, tmp_path, monkeypatch):
    class Full:
        def score(self, *_: object, **__: object) -> None:
            raise fovqa.InputError("the disk is full")

    monkeypatch.setattr(_scorer, "_PAUSES_S", (0, 0))
    fingerprint = fovqa._native.Sharded(experiment).fingerprint
    threads = _driver._cores()
    job = _job.Job("call", str(experiment), experiment.read_text(), None, None, True, threads, fingerprint, True)
    row = next(_job.rows(tmp_path / "units", 1))
    for _ in range(2):
        # The second time, another worker has it, because the first one died on the next unit.
        scorer = _scorer.Scorer(job)
        scorer._sharded = Full()
        assert json.loads(scorer(row)["outcome"])["failed"] == "the disk is full"
    assert record(tmp_path, 1, 1)["tries"] == 3


def test_mistakes_are_told_before_ray_starts(experiment, tmp_path, monkeypatch):
    for argument in ("workers", "threads", "frames_per_unit"):
        for number in (0, 1.5, "2"):
            with pytest.raises(fovqa.RequestError, match=f"{argument} is {number!r}"):
                fovqa.ray.run(experiment, **{argument: number})
    with pytest.raises(TypeError, match="the path of a TOML file or a dict"):
        fovqa.ray.run(5)
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(fovqa.RequestError, match="pip install"):
        fovqa.ray.run(experiment, output=tmp_path / "out")
    (tmp_path / "wrong.toml").write_text("name = 3\n")
    assert "wrong.toml:1:8" in ended(module(tmp_path / "wrong.toml", "--output", tmp_path / "x"), 2)
    assert "there is no such file" in ended(module(tmp_path / "nowhere.toml", "--output", tmp_path / "x"), 2)


def test_units_have_room_for_frames_before_them(experiment):
    found = fovqa._native.Sharded(experiment)
    assert (found.frames, found.pairs, found.reads_frames_before) == (10, 20, True)
    assert [_driver._units(found, per_unit) for per_unit in (None, 1, 3, 100)] == [1, 10, 4, 1]
    long = EXPERIMENT.replace("frames = 7", "frames = 65")
    experiment.write_text(long)
    assert _driver._units(fovqa._native.Sharded(experiment), None) == 2
    for over_time in ("atd = {}\n", "flicker = { frames = 4 }\n", "fvvdp = {}\n"):
        long = long.replace(over_time, "")
    experiment.write_text(long.replace('model = "kfr"', 'model = "rmfr"'))
    found = fovqa._native.Sharded(experiment)
    assert not found.reads_frames_before and _driver._units(found, None) == 5


def test_the_script_for_slurm_scores_all_shards(experiment, tmp_path, monkeypatch):
    text = (ROOT / "docs" / "cluster.md").read_text()
    script = re.search(r"```bash\n(#!/bin/bash\n#SBATCH .*?)```", text, re.DOTALL)
    assert script is not None
    (tmp_path / "array.sh").write_text(script[1].replace("experiment.toml", "e.toml"))
    path = f"{Path(sys.executable).parent}:{os.environ['PATH']}"
    for task in (1, 2, 3):
        array = {"SLURM_ARRAY_TASK_ID": str(task), "SLURM_ARRAY_TASK_COUNT": "3", "SLURM_CPUS_PER_TASK": "1"}
        environment = {**os.environ, "PATH": path, **array}
        subprocess.run(["bash", "array.sh"], cwd=tmp_path, env=environment, check=True, timeout=120)
    merge = re.search(r"^fovqa merge (.*)$", text, re.MULTILINE)
    assert merge is not None
    line = f"fovqa merge {merge[1].replace('experiment.toml', 'e.toml')}"
    subprocess.run(["bash", "-c", line], cwd=tmp_path, env={**os.environ, "PATH": path}, check=True, timeout=120)
    fovqa.run(experiment, output=tmp_path / "whole", progress=False)
    merged = next((tmp_path / "reports").glob("*/run.json")).parent
    assert results(merged) == results(tmp_path / "whole")
