"""Power spectra by band with NumPy, from their definition alone.

python3 spectrum.py REFERENCE TEST FOV_VERTICAL BANDS BLOCK [X,Y]

Prints the paths and values that golden.json holds for a case."""

import json
import sys

import numpy as np
from PIL import Image


def luma(path):
    return np.asarray(Image.open(path).convert("RGB"), float) / 255 @ [0.2126, 0.7152, 0.0722]


def blocks(plane, fov_deg, gaze, side):
    """For each block: its eccentricity, pixels per degree, and power with u and v from -B/2 to B/2 - 1."""
    height, width = plane.shape
    focal = height / 2 / np.tan(np.radians(fov_deg) / 2)
    centre = np.array([width / 2, height / 2])
    ray = lambda at: np.append((np.asarray(at) - centre) / focal, 1.0)
    window = np.sin(np.pi * (np.arange(side) + 0.5) / side) ** 2
    window = np.outer(window, window)
    for y in range(0, height - side + 1, side // 2):
        for x in range(0, width - side + 1, side // 2):
            at, to = ray([x + side / 2, y + side / 2]), ray(gaze if gaze is not None else centre)
            deg = np.degrees(np.arctan2(np.linalg.norm(np.cross(at, to)), at @ to))
            ppd = focal * np.pi / 180 * (at @ at) ** 0.75
            part = plane[y : y + side, x : x + side]
            q = window * (part - (window * part).sum() / window.sum())
            power = np.abs(np.fft.fftshift(np.fft.fft2(q))) ** 2 / (side**2 * (window**2).sum())
            yield deg, ppd, power


def spectrum(plane, fov_deg, gaze, edges, side):
    """For each band: its blocks, and power, density and samples of each half octave."""
    bands = [(0, {}) for _ in edges[1:]]
    v, u = np.meshgrid(np.arange(-side // 2, side // 2), np.arange(-side // 2, side // 2), indexing="ij")
    for deg, ppd, power in blocks(plane, fov_deg, gaze, side):
        index = np.searchsorted(edges, deg, side="right") - 1
        if not 0 <= index < len(bands):
            continue
        count, bins = bands[index]
        frequency = np.hypot(u, v) / side * ppd
        half_octave = np.floor(2 * np.log2(np.where(frequency > 0, frequency, 1)) + 0.5).astype(int)
        for k in np.unique(half_octave[frequency > 0]):
            inside = (half_octave == k) & (frequency > 0)
            sums = bins.setdefault(int(k), np.zeros(3))
            sums += [power[inside].sum(), power[inside].sum() / (ppd / side) ** 2, inside.sum()]
        bands[index] = (count + 1, bins)
    of = lambda count, sums: {"power": sums[0] / count, "density": sums[1] / sums[2], "samples": int(sums[2])}
    return [(count, {k: of(count, bins[k]) for k in sorted(bins)}) for count, bins in bands]


def cutoff(reference, test):
    last = None
    for k in reference:
        if reference[k]["power"] < 1e-12:
            continue
        if test[k]["power"] / reference[k]["power"] < 0.5:
            return last
        last = 2 ** (k / 2)
    return last


def main(reference, test, fov, edges, side, gaze=None):
    gaze = gaze and [float(at) for at in gaze.split(",")]
    edges = [float(edge) for edge in edges.split(",")]
    of = [spectrum(luma(path), float(fov), gaze, edges, int(side)) for path in (reference, test)]
    expect = []
    for band, ((count, bins), (_, of_test)) in enumerate(zip(*of)):
        place = f"frames[0].spectrum[{band}]"
        expect.append([f"{place}.blocks", count, 0])
        expect.append([f"{place}.cutoff_cpd", cutoff(bins, of_test), 1e-9])
        for index, k in enumerate(bins):
            bin_ = f"{place}.bins[{index}]"
            expect.append([f"{bin_}.cpd", 2 ** (k / 2), 1e-9])
            expect.append([f"{bin_}.samples", bins[k]["samples"], 0])
            for statistic in ("power", "density"):
                expect.append([f"{bin_}.reference.{statistic}", bins[k][statistic], -1e-5])
                expect.append([f"{bin_}.test.{statistic}", of_test[k][statistic], -1e-5])
    print(json.dumps(expect))


main(*sys.argv[1:])
