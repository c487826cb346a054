#!/usr/bin/env python3
"""Second implementation, no NumPy: verify golden.json against the .y4m files.

Per-pixel loops. Chroma samples are points at luma coordinates
    x = x0 + k*dx,  y = y0 + k*dy
and a value at a luma pixel is the linear interpolation between the two
nearest points by position (constant beyond the first and last point).
R'G'B' comes from inverting the 3x3 R'G'B' -> Y'CbCr matrix.
Exits 1 when anything differs by more than 1e-9.
"""
import json, math, os, re, struct, sys

HERE = os.path.dirname(os.path.abspath(__file__))
LIMIT = 1e-9


def geometry(tag):
    """bits, then None (mono) or ((x0, dx), (y0, dy)) of the chroma points."""
    m = re.fullmatch(r"(mono|420|422|444)(jpeg|mpeg2|paldv|p?(\d\d))?", tag)
    kind, suffix, digits = m.groups()
    bits = int(digits) if digits else 8
    if kind == "mono":
        return bits, None
    if kind == "444":
        return bits, ((0.0, 1), (0.0, 1))
    if kind == "422":
        return bits, ((0.0, 2), (0.0, 1))
    across = 0.5 if suffix in (None, "jpeg") else 0.0
    return bits, ((across, 2), (0.5, 2))


class Video:
    def __init__(self, name):
        with open(os.path.join(HERE, name), "rb") as f:
            words = f.readline().decode("ascii").rstrip("\n").split()
            if words.pop(0) != "YUV4MPEG2":
                raise ValueError(name + ": no magic")
            par = {}
            self.declared = None
            for wd in words:
                if wd[0] != "X":
                    par[wd[0]] = wd[1:]
                elif wd.split("=")[0] == "XCOLORRANGE":
                    self.declared = wd.split("=")[1]
            self.w, self.h = int(par["W"]), int(par["H"])
            self.tag = par.get("C", "420")
            self.bits, self.geo = geometry(self.tag)
            sizes = [(self.w, self.h)]
            if self.geo:
                dx, dy = self.geo[0][1], self.geo[1][1]
                sizes += [((self.w + dx - 1) // dx, (self.h + dy - 1) // dy)] * 2
            self.frames = []
            while True:
                line = f.readline()
                if not line:
                    break
                if line.split()[0] != b"FRAME" or line[-1:] != b"\n":
                    raise ValueError(name + ": bad frame line")
                planes = []
                for pw, ph in sizes:
                    step = 1 if self.bits == 8 else 2
                    raw = f.read(pw * ph * step)
                    if len(raw) != pw * ph * step:
                        raise ValueError(name + ": short")
                    v = struct.unpack("<%d%s" % (pw * ph, "B" if step == 1 else "H"), raw)
                    if max(v) > 2 ** self.bits - 1:
                        raise ValueError(name + ": code too great")
                    planes.append([v[r * pw:(r + 1) * pw] for r in range(ph)])
                self.frames.append(planes)


def weights(pos, start, step, count):
    """[(index, weight)] of the points start + k*step around pos."""
    points = [start + k * step for k in range(count)]
    if pos <= points[0]:
        return [(0, 1.0)]
    if pos >= points[-1]:
        return [(count - 1, 1.0)]
    k = max(j for j in range(max(0, int((pos - start) // step) - 1), count) if points[j] <= pos
            and (j + 1 == count or points[j + 1] > pos))
    part = (pos - points[k]) / (points[k + 1] - points[k])
    return [(k, 1.0 - part), (k + 1, part)]


def inverse3(m):
    (a, b, c), (d, e, f), (g, h, i) = m
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    adj = [[e * i - f * h, c * h - b * i, b * f - c * e],
           [f * g - d * i, a * i - c * g, c * d - a * f],
           [d * h - e * g, b * g - a * h, a * e - b * d]]
    return [[v / det for v in row] for row in adj]


def forward(matrix):
    r, b = {"bt601": (0.299, 0.114), "bt709": (0.2126, 0.0722), "bt2020": (0.2627, 0.0593)}[matrix]
    g = 1 - r - b
    pb, pr = 2 * (1 - b), 2 * (1 - r)
    return [[r, g, b], [-r / pb, -g / pb, (1 - b) / pb], [(1 - r) / pr, -g / pr, -b / pr]]


def scale(bits, full):
    """(offset, span) of luma and of chroma, in codes."""
    if full:
        return (0, (1 << bits) - 1), (1 << (bits - 1), (1 << bits) - 1)
    k = 1 << (bits - 8)
    return (16 * k, (235 - 16) * k), (128 * k, (240 - 16) * k)


def frame_rgb(v, n, range_opt, matrix_opt):
    if range_opt == "auto":
        full = (v.declared or "LIMITED") == "FULL"
    else:
        full = {"full": True, "limited": False}[range_opt]
    if matrix_opt == "auto":
        matrix_opt = "bt601" if v.h < 720 else "bt709"
    inv = inverse3(forward(matrix_opt))
    (yo, ys), (co, cs) = scale(v.bits, full)
    planes = v.frames[n]
    if v.geo:
        rows, cols = len(planes[1]), len(planes[1][0])
        wx = [weights(x, *v.geo[0], cols) for x in range(v.w)]
        wy = [weights(y, *v.geo[1], rows) for y in range(v.h)]
    out = []
    for y in range(v.h):
        line = []
        for x in range(v.w):
            luma = (planes[0][y][x] - yo) / ys
            if v.geo:
                ycc = [luma]
                for p in planes[1:]:
                    code = sum(a * b * p[j][i] for j, a in wy[y] for i, b in wx[x])
                    ycc.append((code - co) / cs)
                px = [sum(m * c for m, c in zip(row, ycc)) for row in inv]
            else:
                px = [luma] * 3
            line.append([min(1.0, max(0.0, c)) for c in px])
        out.append(line)
    return out


def main():
    with open(os.path.join(HERE, "golden.json")) as f:
        cases = json.load(f)["cases"]
    videos, rgbs, used, worst, bad, numbers = {}, {}, set(), {"psnr": 0.0, "rgb": 0.0}, [], 0

    def video(name):
        if name not in videos:
            videos[name] = Video(name)
        return videos[name]

    def rgb(name, n, *options):
        key = (name, n) + options
        if key not in rgbs:
            rgbs[key] = frame_rgb(video(name), n, *options)
        return rgbs[key]

    def compare(kind, where, got, want):
        nonlocal numbers
        numbers += 1
        d = abs(got - want)
        worst[kind] = max(worst[kind], d)
        if not d <= LIMIT:
            bad.append(f"{where}: {kind} {got!r}, golden {want!r}")

    for c in cases:
        r, t = video(c["reference"]), video(c["test"])
        used |= {c["reference"], c["test"]}
        facts = [(r.tag, c["colour"]), (t.tag, c["test_colour"] or c["colour"]),
                 ((r.w, r.h), (c["width"], c["height"])), ((t.w, t.h), (c["width"], c["height"])),
                 (len(r.frames), len(c["psnr"])), (len(t.frames), len(c["psnr"]))]
        bad += [f"{c['name']}: {a} is not {b}" for a, b in facts if a != b]
        opts = (c["range"], c["matrix"])
        for n, want in enumerate(c["psnr"]):
            a, b = rgb(c["reference"], n, *opts), rgb(c["test"], n, *opts)
            sq = math.fsum((p - q) ** 2 for la, lb in zip(a, b) for pa, pb in zip(la, lb) for p, q in zip(pa, pb))
            compare("psnr", f"{c['name']} frame {n}", -10 * math.log10(sq / (3 * r.w * r.h)), want)
        for p in c["pixels"]:
            got = rgb(c["test"], p["frame"], *opts)[p["y"]][p["x"]]
            for g, w in zip(got, p["rgb"], strict=True):
                compare("rgb", f"{c['name']} {p['frame']},{p['x']},{p['y']}", g, w)
    here = {n for n in os.listdir(HERE) if n.endswith(".y4m")}
    if here != used:
        bad.append(f"files and cases disagree: {sorted(here ^ used)}")
    print("\n".join(bad[:40]), end="\n" if bad else "")
    print(f"{len(cases)} cases, {len(used)} files, {numbers} numbers, {len(bad)} differences; greatest: "
          f"psnr {worst['psnr']:.3g} dB, rgb {worst['rgb']:.3g}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
