"""Measures fovqa.ray: the gain of a second worker, and what a unit costs the driver. Prints Markdown.

Each measurement is a process of its own, because the largest memory of a process never falls again.
"""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

HEAD = """name = "bench"
plausibility = "off"
[view]
fov_vertical_deg = 60
[[scene]]
name = "s"
reference = "gt/*.png"
[[method]]
name = "A"
test = "a/*.png"
"""
#: Small frames: all that remains is what a unit costs.
TINY = HEAD + "[metrics]\npsnr = {}\nssim = {}\n"
#: Full-HD frames. The page has no pictures, because each would be taken by one process.
LARGE = (
    HEAD + "[metrics]\npsnr = {}\nssim = {}\nms_ssim = {}\nfpsnr = {}\ngmsd = {}\nhaar = {}\n[report]\nframes = []\n"
)


def write_pair(folder: Path, reference: np.ndarray, test: np.ndarray, number: int) -> None:
    for name, image in (("gt", reference), ("a", test)):
        (folder / name).mkdir(exist_ok=True)
        Image.fromarray(image).save(folder / name / f"{number:06}.png", compress_level=1)


def tiny(folder: Path, frames: int) -> None:
    rng = np.random.default_rng(1)
    base = rng.integers(0, 256, (24, 24, 3), dtype=np.uint8)
    for frame in range(frames):
        image = base.copy()
        image[0, 0] = frame % 251, frame // 251 % 251, frame % 7
        write_pair(folder, image, image // 8 * 8, frame)
    (folder / "e.toml").write_text(TINY)


def large(folder: Path, frames: int) -> None:
    rng = np.random.default_rng(1)
    y, x = np.mgrid[0:1080, 0:1920]
    waves = 127 + 60 * np.sin(x / 17) + 40 * np.cos(y / 23)
    image = (waves[..., None] + rng.normal(0, 12, (1080, 1920, 3))).clip(0, 255).astype(np.uint8)
    half = Image.fromarray(image).resize((960, 540), Image.Resampling.BILINEAR)
    write_pair(folder, image, np.asarray(half.resize((1920, 1080), Image.Resampling.BILINEAR)), 0)
    for name in ("gt", "a"):
        for frame in range(1, frames):
            (folder / name / f"{frame:06}.png").symlink_to("000000.png")
    (folder / "e.toml").write_text(LARGE)


def cpu_s() -> float:
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def measure(folder: str, output: str, workers: int, frames: int, per_unit: int) -> None:
    """Runs one experiment, and prints what it took."""
    import ray
    import ray.data

    import fovqa.ray

    ray.init(
        address="local", num_cpus=workers, object_store_memory=256 << 20, include_dashboard=False, log_to_driver=False
    )
    at_first: list[float] = []

    def progress(done: int, total: int, what: str) -> None:
        # Before the first unit is finished, workers start.
        if what == "units" and not at_first:
            at_first.append(cpu_s())

    done = fovqa.ray.run(
        Path(folder) / "e.toml",
        output=output,
        workers=workers,
        frames=f"0..{frames}",
        frames_per_unit=per_unit,
        progress=progress,
    )
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    result = {
        "units": done.units,
        "scoring_s": done.scoring_s,
        "cpu_s": done.cpu_s,
        "merging_s": done.merging_s,
        "driver_s": cpu_s() - at_first[0],
        "peak_mib": peak / 1024,
    }
    print(json.dumps(result))
    ray.shutdown()


def measured(folder: Path, workers: int, frames: int, per_unit: int) -> dict[str, Any]:
    with tempfile.TemporaryDirectory() as output:
        line = [sys.executable, __file__, str(folder), output, str(workers), str(frames), str(per_unit)]
        out = subprocess.run(line, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout
    result: dict[str, Any] = json.loads(out.splitlines()[-1])
    return result


def main() -> None:
    print(f"{os.cpu_count()} cores\n")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        large(folder, 2000)
        print("| workers | units | CPU seconds of a unit | seconds for all | times as fast |\n|" + " --- |" * 5)
        runs = {workers: measured(folder, workers, 2000, 5) for workers in (1, 2)}
        for workers, run in runs.items():
            gain = runs[1]["scoring_s"] / run["scoring_s"]
            each = run["cpu_s"] / run["units"]
            print(f"| {workers} | {run['units']} | {each:.2f} | {run['scoring_s']:.1f} | {gain:.2f} |", flush=True)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        tiny(folder, 20_000)
        print("\n| frames | units | driver's CPU ms per unit | driver's memory (MiB) | merging (s) |\n|" + " --- |" * 5)
        for frames, per_unit in ((200, 2), (2000, 2), (20_000, 2), (1000, 16), (20_000, 16)):
            run = measured(folder, 2, frames, per_unit)
            each = run["driver_s"] / run["units"] * 1000
            memory, merging = run["peak_mib"], run["merging_s"]
            print(f"| {frames} | {run['units']} | {each:.1f} | {memory:.0f} | {merging:.1f} |", flush=True)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        measure(sys.argv[1], sys.argv[2], *map(int, sys.argv[3:]))
    else:
        main()
