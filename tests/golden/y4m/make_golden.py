#!/usr/bin/env python3
"""Write small .y4m files and golden.json (R'G'B' pixels, PSNR per frame).

The golden values are computed by reading the written files back (read_y4m,
to_rgb, psnr below); the generator part only invents the sample codes.
"""
import json, math, os, zlib
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))

# tag: (bits, chroma kind, left-sited across)
TAGS = {
    "mono": (8, "mono", False), "mono10": (10, "mono", False), "mono12": (12, "mono", False),
    "420": (8, "420", False), "420jpeg": (8, "420", False),
    "420mpeg2": (8, "420", True), "420paldv": (8, "420", True),
    "420p10": (10, "420", True), "420p12": (12, "420", True),
    "422": (8, "422", True), "422p10": (10, "422", True), "422p12": (12, "422", True),
    "444": (8, "444", False), "444p10": (10, "444", False), "444p12": (12, "444", False),
}
KR_KB = {"bt601": (.299, .114), "bt709": (.2126, .0722), "bt2020": (.2627, .0593)}


def plane_shapes(tag, w, h):
    kind = TAGS[tag][1]
    cw, ch = -(-w // 2), -(-h // 2)
    c = {"mono": None, "420": (ch, cw), "422": (h, cw), "444": (h, w)}[kind]
    return [(h, w)] if c is None else [(h, w), c, c]


# ------------------------------------------------------------- the reference
def read_y4m(path):
    data = open(path, "rb").read()
    end = data.index(b"\n")
    fields = data[:end].decode("ascii").split(" ")
    assert fields[0] == "YUV4MPEG2"
    head = {"C": "420", "range": None}
    for f in fields[1:]:
        if f[0] in "WH":
            head[f[0]] = int(f[1:])
        elif f[0] == "C":
            head["C"] = f[1:]
        elif f.startswith("XCOLORRANGE="):
            head["range"] = f[12:]
    tag = head["C"]
    dtype = np.dtype("u1" if TAGS[tag][0] == 8 else "<u2")
    frames, pos = [], end + 1
    while pos < len(data):
        end = data.index(b"\n", pos)
        line = data[pos:end]
        assert line == b"FRAME" or line.startswith(b"FRAME "), line
        pos, planes = end + 1, []
        for shape in plane_shapes(tag, head["W"], head["H"]):
            n = shape[0] * shape[1]
            planes.append(np.frombuffer(data, dtype, n, pos).reshape(shape))
            pos += n * dtype.itemsize
        frames.append(planes)
    return head, frames


def up_axis(c, n, axis, left):
    """Bilinear doubling of one axis to n samples, edges repeated."""
    c = np.moveaxis(c, axis, 0)
    last = c.shape[0] - 1
    x = np.arange(n)
    i = x // 2
    here = c[i]
    after, before = c[np.minimum(i + 1, last)], c[np.maximum(i - 1, 0)]
    odd = (x % 2 == 1).reshape(-1, *[1] * (c.ndim - 1))
    if left:
        out = np.where(odd, .5 * here + .5 * after, here)
    else:
        out = np.where(odd, .75 * here + .25 * after, .25 * before + .75 * here)
    return np.moveaxis(out, 0, axis)


def to_rgb(head, planes, range_opt, matrix_opt):
    tag, w, h = head["C"], head["W"], head["H"]
    bits, kind, left = TAGS[tag]
    full = range_opt == "full" or (range_opt == "auto" and head["range"] == "FULL")
    s, top = 2.0 ** (bits - 8), 2.0 ** bits - 1
    p = [q.astype(np.float64) for q in planes]
    y = p[0] / top if full else (p[0] - 16 * s) / (219 * s)
    if kind == "mono":
        rgb = np.stack([y, y, y], -1)
    else:
        chroma = []
        for c in p[1:]:
            c = (c - 2.0 ** (bits - 1)) / top if full else (c - 128 * s) / (224 * s)
            if kind == "420":
                c = up_axis(c, h, 0, False)
            if kind in ("420", "422"):
                c = up_axis(c, w, 1, left)
            chroma.append(c)
        cb, cr = chroma
        if matrix_opt == "auto":
            matrix_opt = "bt709" if h >= 720 else "bt601"
        kr, kb = KR_KB[matrix_opt]
        r = y + 2 * (1 - kr) * cr
        b = y + 2 * (1 - kb) * cb
        g = (y - kr * r - kb * b) / (1 - kr - kb)
        rgb = np.stack([r, g, b], -1)
    return np.clip(rgb, 0.0, 1.0)


def psnr(a, b):
    return float(10 * np.log10(1 / np.mean((a - b) ** 2)))


# ------------------------------------------------------------- the generator
def scene(seed, u, v, t):
    """Smooth R'G'B' at normalised positions, frame t."""
    ph = np.random.default_rng(seed).uniform(0, 6.28, (3, 2))
    return [.5 + .26 * np.sin(4.1 * u + 1.7 * v + .6 * t + ph[k, 0])
            + .14 * np.cos(2.3 * u - 5.3 * v + ph[k, 1]) for k in range(3)]


def scene_planes(tag, w, h, t, full, matrix, seed):
    bits, kind, left = TAGS[tag]
    kr, kb = KR_KB[matrix]
    s, top = 2.0 ** (bits - 8), 2.0 ** bits - 1
    out = []
    for k, (ph, pw) in enumerate(plane_shapes(tag, w, h)):
        x, y = np.arange(pw) * 1.0, np.arange(ph) * 1.0
        if k and kind in ("420", "422"):
            x = 2 * x if left else 2 * x + .5
        if k and kind == "420":
            y = 2 * y + .5
        r, g, b = scene(seed, ((x + .5) / w)[None, :], ((y + .5) / h)[:, None], t)
        luma = kr * r + (1 - kr - kb) * g + kb * b
        c = [luma, (b - luma) / (2 - 2 * kb), (r - luma) / (2 - 2 * kr)][k]
        if full:
            out.append(c * top + (2.0 ** (bits - 1) if k else 0))
        else:
            out.append(c * (224 if k else 219) * s + (128 if k else 16) * s)
    return out


def add(planes, tag, rng, sigma, extremes):
    """Noise of sigma 8-bit codes, some samples set to 0 or the greatest code."""
    bits = TAGS[tag][0]
    top, out = 2 ** bits - 1, []
    for p in planes:
        q = np.clip(np.rint(p + rng.normal(0, sigma * 2.0 ** (bits - 8), p.shape)), 0, top)
        keep = (p == 0) | (p == top)            # extremes of the base stay
        q = np.where(keep, p, q)
        hit = rng.random(p.shape) < extremes
        q = np.where(hit, np.where(rng.random(p.shape) < .5, 0, top), q)
        out.append(q.astype(np.int64))
    return out


def header(tag, w, h, rng_tag):
    f = [f"W{w}", f"H{h}", "F30:1", "Ip", "A1:1", f"C{tag}"]
    return f + ([f"XCOLORRANGE={rng_tag}"] if rng_tag else [])


FILES = {}                                      # name -> (tag, w, h, list of planes)


def write(name, tag, w, h, frames, rng_tag, fields=None, frame_lines=("FRAME",)):
    name += ".y4m"
    assert name not in FILES, name
    line = " ".join(["YUV4MPEG2"] + (fields or header(tag, w, h, rng_tag)))
    dtype = "u1" if TAGS[tag][0] == 8 else "<u2"
    blob = line.encode() + b"\n"
    for t, planes in enumerate(frames):
        blob += frame_lines[t % len(frame_lines)].encode() + b"\n"
        blob += b"".join(p.astype(dtype).tobytes() for p in planes)
    open(os.path.join(HERE, name), "wb").write(blob)
    FILES[name] = (tag, w, h, frames)
    return name


def rng_for(name):
    return np.random.default_rng([20240607, zlib.crc32(name.encode())])


def make_ref(name, tag, w, h, n, rng_tag, matrix="bt601", seed=1, sigma=2, extremes=.02, **kw):
    rng = rng_for(name)
    fr = [add(scene_planes(tag, w, h, t, rng_tag == "FULL", matrix, seed), tag, rng, sigma, extremes)
          for t in range(n)]
    return write(name, tag, w, h, fr, rng_tag, **kw)


def make_test(name, ref, rng_tag, sigma=5, extremes=.01, **kw):
    """Same format as ref: its codes plus noise and a few new extremes."""
    tag, w, h, frames = FILES[ref]
    rng = rng_for(name)
    return write(name, tag, w, h, [add(p, tag, rng, sigma, extremes) for p in frames], rng_tag, **kw)


CASES = []
CACHE = {}


def load(name):
    if name not in CACHE:
        CACHE[name] = read_y4m(os.path.join(HERE, name))
    return CACHE[name]


def case(name, ref, test, range_opt="auto", matrix_opt="auto", pixels=6):
    (rh, rf), (th, tf) = load(ref), load(test)
    assert (rh["W"], rh["H"], len(rf)) == (th["W"], th["H"], len(tf)) and len(tf)
    w, h = th["W"], th["H"]
    a = [to_rgb(rh, p, range_opt, matrix_opt) for p in rf]
    b = [to_rgb(th, p, range_opt, matrix_opt) for p in tf]
    rng = rng_for("pixels " + name)
    corners = [(0, 0), (w - 1, h - 1), (w - 1, 0), (0, h - 1)]
    turn = len(CASES) % 4
    spots = corners[turn:] + corners[:turn]
    spots = spots[:3 if pixels > 4 else 2]
    edges = [(w // 2, 0), (w - 1, h // 2), (w // 3, h - 1), (0, h // 3)]
    spots.append(edges[turn])
    while len(spots) < pixels:                  # inside, of alternating parity
        par = len(spots) % 2
        x, y = int(rng.integers(0, w)), int(rng.integers(0, h))
        spots.append((min(x // 2 * 2 + par, w - 1), min(y // 2 * 2 + 1 - par, h - 1)))
    chosen = []
    for k, (x, y) in enumerate(spots):
        item = ((k + turn) % len(b), x, y)
        if item not in chosen:
            chosen.append(item)
    CASES.append({
        "name": name, "reference": ref, "test": test,
        "colour": rh["C"], "test_colour": None if th["C"] == rh["C"] else th["C"],
        "width": w, "height": h, "range": range_opt, "matrix": matrix_opt,
        "psnr": [psnr(p, q) for p, q in zip(a, b)],
        "pixels": [{"frame": f, "x": x, "y": y, "rgb": [float(c) for c in b[f][y, x]]}
                   for f, x, y in chosen]})


def main():
    # Every tag: limited by header, no XCOLORRANGE, full by header.
    ref, full, plain = {}, {}, {}
    for k, tag in enumerate(TAGS):
        deep = TAGS[tag][0] > 8
        w, h = (9, 7) if deep else (15, 11)
        if tag == "444":
            w, h = 12, 10
        two = 2 if tag in ("420", "420mpeg2", "422", "420p10", "mono") else 1
        ref[tag] = make_ref(f"{tag}_lim_ref", tag, w, h, two, "LIMITED", seed=k)
        t = make_test(f"{tag}_lim_test", ref[tag], "LIMITED", sigma=4 + k % 5)
        case(f"{tag}_limited", ref[tag], t)
        plain[tag] = make_test(f"{tag}_none_test", ref[tag], None, sigma=3 + k % 7)
        case(f"{tag}_none", ref[tag], plain[tag], pixels=4)
        w, h = (8, 6) if deep else (10, 8)
        two = 2 if tag in ("420jpeg", "422p12", "444p10") else 1
        r = make_ref(f"{tag}_full_ref", tag, w, h, two, "FULL", seed=50 + k)
        full[tag] = (r, make_test(f"{tag}_full_test", r, "FULL", sigma=4 + k % 6))
        case(f"{tag}_full", *full[tag], pixels=5)
    # The range option overrides the header.
    for tag in ("420jpeg", "444p10"):
        case(f"{tag}_full_as_limited", *full[tag], range_opt="limited", pixels=4)
    for tag in ("420mpeg2", "422p10", "mono12"):
        case(f"{tag}_limited_as_full", ref[tag], f"{tag}_lim_test.y4m", range_opt="full", pixels=4)
    case("420_none_as_full", ref["420"], plain["420"], range_opt="full", pixels=4)
    # Each matrix option.
    for m in KR_KB:
        for tag in ("420", "444", "420p12") if m != "bt601" else ("444",):
            case(f"{tag}_{m}", ref[tag], f"{tag}_lim_test.y4m", matrix_opt=m, pixels=4)
        case(f"422p12_full_{m}", *full["422p12"], matrix_opt=m, pixels=4)
    case("mono10_bt2020", ref["mono10"], "mono10_lim_test.y4m", matrix_opt="bt2020", pixels=4)
    case("444p10_bt709_full_as_limited", *full["444p10"], "limited", "bt709", pixels=4)
    # auto matrix by the number of lines.
    r = make_ref("h720_ref", "420", 3, 720, 1, "LIMITED", "bt709", 90, .6, .01)
    t = make_test("h720_test", r, "LIMITED", 6, .01)
    case("h720_auto", r, t)
    case("h720_bt601", r, t, matrix_opt="bt601", pixels=4)
    r = make_ref("h719_ref", "420mpeg2", 1, 719, 1, "LIMITED", "bt601", 91, .6, .01)
    case("h719_auto", r, make_test("h719_test", r, "LIMITED", 6, .01))
    r = make_ref("w720_ref", "422", 720, 1, 1, "FULL", "bt601", 92, .6, .01)
    case("w720_h1_auto", r, make_test("w720_test", r, "FULL", 6, .01))
    # Mixed pairs of one scene.
    mix = {}
    for tag, rt in (("444", "LIMITED"), ("420p10", "LIMITED"), ("420p12", "FULL"), ("420jpeg", None),
                    ("422", "FULL"), ("420paldv", "LIMITED"), ("mono", None), ("mono12", "FULL")):
        mix[tag] = make_ref(f"mix_{tag}", tag, 9, 7, 1, rt, seed=95, sigma=3, extremes=.01)
    for a, b in (("444", "420p10"), ("420p10", "422"), ("420jpeg", "420paldv"), ("420jpeg", "420p12"),
                 ("422", "444"), ("mono", "mono12")):
        case(f"mix_{a}_{b}", mix[a], mix[b])
    # Very small frames.
    for tag, w, h in (("420", 1, 1), ("420", 2, 1), ("420", 1, 2), ("420", 3, 3), ("420mpeg2", 1, 3),
                      ("420mpeg2", 3, 3), ("422", 3, 1), ("420p10", 1, 1), ("420p10", 2, 3)):
        n = f"{tag}_{w}x{h}"
        r = make_ref(n + "_ref", tag, w, h, 2, "LIMITED", seed=110 + w, extremes=0)
        case(n, r, make_test(n + "_test", r, "LIMITED", 9, 0), pixels=5)
    # Headers and frame lines.
    r = make_ref("hdr_ref", "420jpeg", 5, 4, 2, None, seed=130)
    hdr = {
        "no_c": ["W5", "H4", "F30:1", "Ip", "A1:1"],
        "no_a": ["W5", "H4", "F30:1", "Ip", "C420jpeg"],
        "no_f": ["W5", "H4", "Ip", "A1:1", "C420jpeg"],
        "order": ["XCOLORRANGE=LIMITED", "C420jpeg", "A1:1", "H4", "Ip", "F30:1", "W5"],
        "only_size": ["H4", "W5"],
        "other_x": ["W5", "H4", "F30:1", "Ip", "A1:1", "C420jpeg", "XYSCSS=420JPEG", "XCOLORRANGE=LIMITED"],
    }
    for n, f in hdr.items():
        case("hdr_" + n, r, make_test("hdr_" + n, r, None, extremes=0, fields=f), pixels=4)
    case("hdr_frame_par", r, make_test("hdr_frame_par", r, None, extremes=0, frame_lines=("FRAME Ip", "FRAME Ip Xabc")), pixels=4)
    r = make_ref("hdr_full_ref", "422", 5, 4, 1, "FULL", seed=131)
    t = make_test("hdr_order_full", r, "FULL", fields=["XCOLORRANGE=FULL", "A1:1", "H4", "C422", "W5", "Ip", "F30:1"])
    case("hdr_order_full", r, t, pixels=4)
    # Codes over the whole scale, beyond the nominal limited range.
    for tag, m in (("420", "auto"), ("444p10", "bt709"), ("422p12", "bt2020")):
        rng = rng_for("wide " + tag)
        top = 2 ** TAGS[tag][0] - 1
        fr = [[rng.integers(0, top + 1, s) for s in plane_shapes(tag, 9, 7)]]
        r = write(f"wide_{tag}_ref", tag, 9, 7, fr, "LIMITED")
        case(f"wide_{tag}", r, make_test(f"wide_{tag}_test", r, "LIMITED", 9, .01), matrix_opt=m, pixels=5)

    assert len({c["name"] for c in CASES}) == len(CASES)
    with open(os.path.join(HERE, "golden.json"), "w") as f:
        f.write('{"cases":[\n')
        f.write(",\n".join(json.dumps(c, separators=(",", ":"), allow_nan=False) for c in CASES))
        f.write("\n]}\n")
    p = [v for c in CASES for v in c["psnr"]]
    px = [v for c in CASES for q in c["pixels"] for v in q["rgb"]]
    print(f"{len(CASES)} cases, {len(FILES)} files, psnr {min(p):.2f}..{max(p):.2f} dB, "
          f"{len(px) // 3} pixels, clamped components {sum(v in (0, 1) for v in px)} of {len(px)}")
    for c in CASES:
        if not all(15 <= v <= 40 for v in c["psnr"]):
            print("  outside 15..40 dB:", c["name"], [round(v, 2) for v in c["psnr"]])


if __name__ == "__main__":
    main()
