"""Calls: the interpreter's lock, interrupts, callbacks, threads and processes."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

import fovqa


def test_ten_threads_at_once_get_the_same_bytes(room):
    reference, test = room
    call = lambda _: fovqa.score(reference, test, view={"fov_vertical_deg": 95}, maps=True)
    wanted = call(None)
    with ThreadPoolExecutor(10) as pool:
        found = list(pool.map(call, range(10)))
    assert {of.to_json() for of in found} == {wanted.to_json()}
    assert {of.map("ssim").tobytes() for of in found} == {wanted.map("ssim").tobytes()}


def test_other_threads_run_meanwhile(room):
    reference, test = room
    counted = 0
    done = threading.Event()

    def count():
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    counter = threading.Thread(target=count)
    counter.start()
    before = counted
    fovqa.score([reference] * 12, [test] * 12, metrics=["ssim", "ms_ssim", "gmsd"], progress=False)
    during = counted - before
    done.set()
    counter.join()
    assert during > 20, "the lock is released"


INTERRUPTED = """
import numpy as np, os, signal, sys, threading, time
import fovqa
# A shell ignores the signal in what it runs in the background.
signal.signal(signal.SIGINT, signal.default_int_handler)
frames = [np.zeros((2000, 2000, 3), np.uint8)] * 2000
def interrupt():
    time.sleep(1)
    os.kill(os.getpid(), signal.SIGINT)
threading.Thread(target=interrupt).start()
begin = time.monotonic()
try:
    if sys.argv[1] == "score":
        fovqa.score(frames, frames, metrics=["mse"], signal={"plausibility": "off"}, progress=False)
    elif sys.argv[1] == "draw":
        fovqa.gallery(view={"fov_vertical_deg": 100}, resolution=(4000, 4000), samples=200)[0].image
    else:
        scene = {"name": "hall", "builtin": "gallery", "resolution": "400x400", "frames": 2000, "samples": 16}
        fovqa.run({
            "name": "long", "view": {"fov_vertical_deg": 100}, "scene": [scene],
            "method": [{"name": "RMFR", "emulate": {"model": "rmfr"}}], "metrics": {"psnr": {}},
        }, output=sys.argv[2], progress=False)
except KeyboardInterrupt:
    print("interrupted", time.monotonic() - begin)
# The interpreter can go on.
print(fovqa.score(frames[0][:50, :50], frames[0][:50, :50] + 1, metrics=["mse"]).mse > 0)
"""


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
@pytest.mark.parametrize("what", ["score", "run", "draw"])
def test_an_interrupt_ends_a_long_call(what, tmp_path):
    done = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, what, str(tmp_path)], capture_output=True, text=True, timeout=120
    )
    assert done.returncode == 0, done.stderr
    first, second = done.stdout.splitlines()
    assert first.startswith("interrupted") and float(first.split()[1]) < 60
    assert second == "True"
    if what == "run":
        # Finished frames are not lost.
        assert (tmp_path / "journal.jsonl").stat().st_size > 0


ENDING = """
import sys, threading, time
import numpy as np, fovqa
frame = np.zeros((200, 200), np.uint8)
class Slow:
    def __len__(self):
        return 100000
    def __getitem__(self, nth):
        time.sleep(0.002)
        return frame
calls = {
    "fetched": lambda: fovqa.score(Slow(), Slow(), metrics="mse", progress=False),
    "known": lambda: fovqa.score([frame] * 100000, [frame] * 100000, metrics="mse", progress=False),
    "drawn": lambda: fovqa.gallery("csf-chart", resolution=(4000, 4000), samples=200)[0].image,
    "told": lambda: fovqa.score([frame] * 100000, [frame] * 100000, progress=lambda *of: time.sleep(0.002)),
}
threading.Thread(target=calls[sys.argv[1]], daemon=True).start()
time.sleep(0.7)
print("main ends")
"""


@pytest.mark.parametrize("what", ["fetched", "known", "drawn", "told"])
def test_the_interpreter_ends_while_a_thread_works(what):
    done = subprocess.run([sys.executable, "-c", ENDING, what], capture_output=True, text=True, timeout=60)
    assert (done.returncode, done.stdout, done.stderr) == (0, "main ends\n", "")


def test_progress_is_told_to_the_caller(room):
    reference, test = room
    told = []
    thread = threading.get_ident()

    def tell(done, total, what):
        assert threading.get_ident() == thread
        told.append((done, total, what))

    fovqa.score([reference] * 3, [test] * 3, metrics="mse", progress=tell)
    assert told[-1] == (3, 3, "frames") and [done for done, _, _ in told] == sorted(done for done, _, _ in told)

    def stop(done, total, what):
        if done == 2:
            raise StopIteration("enough")

    with pytest.raises(StopIteration, match="enough"):
        fovqa.score([reference] * 50, [test] * 50, metrics="mse", progress=stop)


def test_a_bar_is_shown_if_tqdm_is_there(room, capsys, monkeypatch):
    reference, test = room
    monkeypatch.setattr("fovqa._progress.DELAY_S", 0)
    fovqa.score([reference] * 3, [test] * 3, metrics="mse")
    assert "fovqa: frames" in capsys.readouterr().err
    fovqa.score([reference] * 3, [test] * 3, metrics="mse", progress=False)
    fovqa.score(reference, test, metrics="mse")
    assert capsys.readouterr().err == ""
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    fovqa.score([reference] * 3, [test] * 3, metrics="mse")
    assert capsys.readouterr().err == ""


def test_a_sequence_may_use_the_package_itself():
    """Frames are fetched while the threads work, and the code that makes them needs the same threads."""
    view = {"fov_vertical_deg": 100}
    hall = fovqa.gallery(view=view, resolution=(120, 100), frames=6, samples=1)

    class Foveated:
        def __len__(self):
            return len(hall)

        def __getitem__(self, nth):
            return fovqa.foveate(hall.encoded[nth], "rmfr", view=view).image

    lazy = fovqa.score(hall.encoded, Foveated(), view=view, progress=False)
    known = fovqa.score(list(hall.encoded), [Foveated()[nth] for nth in range(6)], view=view, progress=False)
    assert lazy.to_json() == known.to_json()


FORKED = """
import multiprocessing, numpy as np, sys, fovqa
frame = np.zeros((40, 40), np.uint8)
def child(_):
    try:
        return fovqa.score(frame, frame + 1, metrics="mse", progress=False).mse
    except fovqa.FovqaError as error:
        return str(error)
if __name__ == "__main__":
    if sys.argv[1] == "before":
        child(0)
    with multiprocessing.get_context(sys.argv[2]).Pool(1) as pool:
        print(pool.map(child, [0])[0])
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes are not forked")
@pytest.mark.parametrize(("used", "start"), [("before", "fork"), ("never", "fork"), ("before", "spawn")])
def test_a_forked_process_says_that_it_has_no_threads(used, start, tmp_path):
    program = tmp_path / "program.py"
    program.write_text(FORKED)
    command = [sys.executable, str(program), used, start]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    if (used, start) == ("before", "fork"):
        assert "was forked" in done.stdout and "spawn" in done.stdout
    else:
        assert float(done.stdout) > 0


def test_the_number_of_threads_does_not_change_a_byte(tmp_path):
    program = """
import sys, numpy as np, fovqa
fovqa.set_threads(int(sys.argv[1]))
frames = np.random.default_rng(3).integers(0, 256, (2, 300, 400, 3), dtype=np.uint8)
print(fovqa.score(*frames, view={"fov_vertical_deg": 60}).to_json())
try:
    fovqa.set_threads(7)
except fovqa.RequestError as error:
    print(error)
"""
    run = lambda threads: (
        subprocess.run(
            [sys.executable, "-c", program, threads], capture_output=True, text=True, timeout=60, check=True
        ).stdout
    )
    one, five = run("1"), run("5")
    assert one.splitlines()[:-2] == five.splitlines()[:-2] and len(one) > 1000
    assert "started already: 1" in one and "started already: 5" in five
    with pytest.raises(fovqa.RequestError, match="0 threads"):
        fovqa.set_threads(0)


def test_importing_brings_nothing_heavy():
    program = (
        "import sys, fovqa; print([name for name in ('numpy', 'pandas', 'polars', 'tqdm') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
