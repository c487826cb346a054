"""FWQI with NumPy and PyWavelets, from its definition alone: python3 fwqi.py REFERENCE TEST FOV_VERTICAL [X,Y]"""

import sys

import numpy as np
import pywt
from PIL import Image

LOW = [0.852698679008894, 0.377402855612831, -0.110624404418437, -0.023849465019557, 0.037828455507264]
PEAKS = {
    "edges": [0.672341, 0.413174, 0.227267, 0.117925],
    "corners": [0.727095, 0.494284, 0.286881, 0.152145],
    "means": [None, None, None, 0.091401],
}
ORIENTATION = {"edges": 1.0, "corners": 0.534, "means": 1.501}


def luma(path):
    codes = np.asarray(Image.open(path).convert("RGB"), float) / 255
    height, width = (side // 16 * 16 for side in codes.shape[:2])
    return (codes @ [0.2126, 0.7152, 0.0722])[:height, :width]


def level(plane):
    """The subbands of one level: PyWavelets' transform, without what it adds beyond the borders."""
    height, width = plane.shape
    found = pywt.dwtn(plane, "bior4.4", mode="reflect")
    return {key: of[2 : 2 + height // 2, 2 : 2 + width // 2] for key, of in found.items()}


def windows(plane):
    return np.lib.stride_tricks.sliding_window_view(plane, (11, 11))


def quality(a, b):
    a, b = windows(a), windows(b)
    mean_a, mean_b = a.mean((2, 3)), b.mean((2, 3))
    both = ((a - mean_a[..., None, None]) * (b - mean_b[..., None, None])).mean((2, 3))
    spread = a.var((2, 3)) + b.var((2, 3))
    brightness = mean_a**2 + mean_b**2

    def factor(above, below):
        return np.where(below < 1e-12, 1.0, above / np.where(below < 1e-12, 1.0, below))

    return factor(2 * both, spread) * factor(2 * mean_a * mean_b, brightness)


def fwqi(reference, test, fov_vertical_deg, gaze=None):
    full = Image.open(reference).size
    a, b = luma(reference), luma(test)
    focal = full[1] / 2 / np.tan(np.radians(fov_vertical_deg / 2))
    centre = np.array(full) / 2
    gaze = centre if gaze is None else np.array(gaze)
    ppd = focal * np.pi / 180
    upper = lower = 0.0
    for number in range(1, 5):
        a, b = level(a), level(b)
        kinds = [("ad", "edges"), ("da", "edges"), ("dd", "corners")] + ([("aa", "means")] if number == 4 else [])
        height, width = a["aa"].shape
        y, x = np.mgrid[5 : height - 5, 5 : width - 5]
        ray = np.stack([*(((np.stack([x, y], -1) + 0.5) * 2**number - centre) / focal).transpose(2, 0, 1), np.ones(x.shape)], -1)
        to = np.array([*((gaze - centre) / focal), 1.0])
        e = np.degrees(np.arctan2(np.linalg.norm(np.cross(ray, to), axis=-1), ray @ to))
        f = ppd / 2**number
        visible = f <= 2.3 * np.log(64) / (0.106 * (e + 2.3))
        s_f = np.where(visible, np.exp(-0.0461 * f * e), 0.0)
        for key, kind in kinds:
            octaves = np.log10(2**number * 0.401 * ORIENTATION[kind] / ppd)
            s_w = PEAKS[kind][number - 1] / (0.495 * 10 ** (0.466 * octaves**2))
            weight = s_w * s_f**2.5 * np.abs(a[key][5:-5, 5:-5])
            upper += (weight * quality(a[key], b[key])).sum()
            lower += weight.sum()
        a, b = a["aa"], b["aa"]
    return upper / lower


if __name__ == "__main__":
    reference, test, fov = sys.argv[1], sys.argv[2], float(sys.argv[3])
    gaze = [float(part) for part in sys.argv[4].split(",")] if len(sys.argv) > 4 else None
    print(repr(float(fwqi(reference, test, fov, gaze))))
