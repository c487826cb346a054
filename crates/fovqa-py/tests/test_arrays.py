"""Arrays: which are taken, which are copied, and what is said of the others."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest

import fovqa
from conftest import ROOM

PEAK = """
import numpy as np, fovqa
def kib(name):
    return int(next(line for line in open("/proc/self/status") if line.startswith(name)).split()[1])
frames = [np.full((2000, 3000, 3), value, {kind!r}) for value in (1, 0)]
if not {contiguous}:
    frames = [frame[:, ::-1] for frame in frames]
score = lambda frames: fovqa.score(*frames, metrics="mse", signal={{"plausibility": "off"}})
score([frame[:100, :100].copy() for frame in frames])
open("/proc/self/clear_refs", "w").write("5")
before = kib("VmRSS")
score(frames)
print((kib("VmHWM") - before) * 1024 / frames[0].nbytes)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="the peak memory is read from /proc")
@pytest.mark.parametrize("kind", ["uint8", "uint16", "float16", "float32"])
def test_a_contiguous_array_is_not_copied(kind):
    def peak(contiguous: bool) -> float:
        program = PEAK.format(kind=kind, contiguous=contiguous)
        done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True, timeout=120)
        return float(done.stdout)

    # As a share of one array. Both arrays are copied if they are not contiguous.
    assert peak(True) < 0.7
    assert peak(False) > 1.7


def test_layouts_do_not_matter(random):
    frames = random.integers(0, 256, (2, 60, 70, 3), dtype=np.uint8)
    wanted = fovqa.score(*frames).to_json()
    wide = np.zeros((2, 60, 140, 3), np.uint8)
    wide[:, :, ::2] = frames
    backwards = np.ascontiguousarray(frames[:, ::-1])[:, ::-1]
    odd = np.zeros(frames.nbytes + 1, np.uint8)[1:].reshape(frames.shape)
    odd[:] = frames
    read_only = frames.copy()
    read_only.flags.writeable = False
    for given in (wide[:, :, ::2], backwards, odd, read_only, np.asfortranarray(frames)):
        assert fovqa.score(given[0], given[1]).to_json() == wanted
    # Floats that are not aligned in memory.
    floats = frames.astype(np.float32)
    raw = np.zeros(floats.nbytes + 2, np.uint8)[2:].view(np.uint8)
    unaligned = np.frombuffer(raw.data, np.uint8).view(np.float32).reshape(floats.shape)
    unaligned[:] = floats
    assert not unaligned.flags.aligned
    signal = {"plausibility": "off"}
    assert fovqa.score(*unaligned, signal=signal).to_json() == fovqa.score(*floats, signal=signal).to_json()


def test_what_becomes_an_array_is_taken(random):
    from PIL import Image

    frames = random.integers(0, 256, (2, 60, 70, 3), dtype=np.uint8)
    pictures = [Image.fromarray(frame) for frame in frames]
    assert fovqa.score(*pictures).to_json() == fovqa.score(*frames).to_json()

    class Tensor:
        def __init__(self, array):
            self.array = array

        def __array__(self, dtype=None, copy=None):
            return self.array

    assert fovqa.score(*map(Tensor, frames)).to_json() == fovqa.score(*frames).to_json()


GOOD = np.zeros((64, 48, 3), np.uint8)
WRONG = [
    (np.zeros((64, 48, 3)), "array of float64", "float32"),
    (np.zeros((64, 48, 3), np.int64), "array of int64", "uint8"),
    (np.zeros((64, 48), bool), "array of bool", "255"),
    (np.zeros((64, 48), complex), "array of complex128", "uint8"),
    (np.zeros((64, 48), "U3"), "array of str", "uint8"),
    (np.zeros((64, 48), object), "array of object", "uint8"),
    (np.zeros((64, 48), ">u2"), "foreign byte order", "astype"),
    (np.zeros((64, 48, 4), np.uint8), "64 x 48 x 4", "leave alpha out"),
    (np.zeros((64, 48, 2), np.uint8), "64 x 48 x 2", "leave alpha out"),
    (np.zeros((3, 64, 48), np.uint8), "3 x 64 x 48", "moveaxis"),
    (np.zeros((64,), np.uint8), "has the shape 64", "height x width"),
    (np.zeros((), np.uint8), "of a single number", "height x width"),
    (np.zeros((1, 1, 1, 1, 1), np.uint8), "1 x 1 x 1 x 1 x 1", "height x width"),
    (np.zeros((0, 48, 3), np.uint8), "48x0 has no pixels", "with pixels"),
    (np.zeros((2, 0, 48, 3), np.uint8), "no pixels", "with pixels"),
    (np.zeros((0, 64, 48, 3), np.uint8), "no frames", "at least one"),
    ([], "no frames", "at least one"),
    (np.broadcast_to(np.uint8(3), (200_000, 200_000, 3)), "more than 256 million", "max_megapixels"),
    (np.broadcast_to(np.float32(3), (2**40, 2**20)), "more than 256 million", "max_megapixels"),
    (GOOD[:32], "48x64 pixels, but .* 48x32", "does not resample"),
    (np.ma.masked_array(np.zeros((64, 48), np.uint8), True), "is a masked array", "mask=~array.mask"),
    ("nowhere.png", "nowhere.png: there is no such file", "check the path"),
]


@pytest.mark.parametrize(("wrong", "message", "help"), WRONG, ids=[of[1] for of in WRONG])
def test_a_wrong_array_is_explained(wrong, message, help):
    for call in (lambda: fovqa.score(GOOD, wrong), lambda: fovqa.score(wrong, GOOD)):
        with pytest.raises(fovqa.InputError) as caught:
            call()
        assert help in caught.value.help, caught.value
    assert pytest.raises(fovqa.InputError, fovqa.score, GOOD, wrong).match(message)


@pytest.mark.parametrize("wrong", [5, None, {"a": 1}, {1, 2}, object(), lambda: None, b"x.png", bytearray(9)])
def test_what_is_no_frame_is_a_type_error(wrong):
    with pytest.raises(TypeError, match="give a numpy array"):
        fovqa.score(GOOD, wrong)


def test_wrong_arguments_are_explained(room):
    reference, test = room
    score = lambda **arguments: fovqa.score(reference, test, **arguments)
    for arguments, message in [
        ({"metrics": ["psrn"]}, "no metric `psrn`; did you mean psnr"),
        ({"metrics": {"ssim": {"sigma": -1}}}, "metrics.ssim.sigma cannot be -1"),
        ({"view": "vive-pro-ey"}, "vive-pro-ey"),
        ({"view": {"fov_vertcal_deg": 60}}, "did you mean fov_vertical_deg"),
        ({"view": {"fov_vertical_deg": float("nan")}}, "fov_vertical_deg"),
        ({"view": {"fov_vertical_deg": 10**400}}, "too large"),
        ({"signal": {"tonemap": "aec"}}, "signal.tonemap cannot be"),
        ({"gaze": (3, 4)}, "a gaze needs a view"),
        ({"metrics": "fvvdp"}, "needs a view"),
        ({"crop": (0, 0, 5)}, "crop"),
        ({"fps": -1}, "fps"),
    ]:
        with pytest.raises(fovqa.RequestError) as caught:
            score(**arguments)
        assert message in str(caught.value) and 'test".' not in str(caught.value), caught.value
    for arguments, message in [
        ({"gaze": np.zeros((3, 3)), "view": "vive-pro-eye"}, "the gaze has the shape 3 x 3"),
        ({"gaze": [(1, 2), (3, 4)], "view": "vive-pro-eye"}, "the number of gaze points is 2, but that of frames is 1"),
        ({"gaze": (np.nan, 3), "view": "vive-pro-eye"}, "gaze cannot be nan"),
        ({"gaze": [(np.nan, 3)], "view": "vive-pro-eye"}, "the gaze has NaN"),
        ({"mask": np.zeros((5, 5), bool)}, "mask"),
        ({"crop": (0, 0, 5000, 5)}, "reaches beyond the frame"),
        ({"frames": "7..9"}, "the selection contains no frame"),
        ({"motion": [np.zeros((5, 5, 2))] * 2}, "2 arrays of motion for 1 frame"),
    ]:
        with pytest.raises(fovqa.FovqaError) as caught:
            score(**arguments)
        assert message in str(caught.value), caught.value
    stereo = {"right_reference": reference, "right_test": test, "view": "vive-pro-eye"}
    with pytest.raises(fovqa.RequestError, match="for two eyes"):
        score(**stereo, motion=[np.zeros((800, 720, 2))])
    with pytest.raises(fovqa.RequestError, match="but a path is given"):
        fovqa.score(ROOM / "gt.png", test, motion=[np.zeros((800, 720, 2))])
    for arguments in ({"view": 5}, {"metrics": 5}, {"signal": {"channels": object()}}, {"signal": {5: 5}}):
        with pytest.raises(TypeError):
            score(**arguments)
    loop: dict = {}
    loop["view"] = loop
    for arguments in ({"view": loop}, {"signal": loop}, {"metrics": {"ssim": loop}}):
        with pytest.raises(fovqa.RequestError, match="nested too deeply"):
            score(**arguments)
    large = {"crop": np.zeros((2000, 2000, 3), np.uint8)}
    with pytest.raises(fovqa.RequestError, match="crop is a large array"):
        score(signal=large)
    for arguments, message in [
        ({"signal": "srgb"}, "signal is a dict"),
        ({"maps": "ssim"}, "maps is True or False"),
        ({"progress": "yes"}, "progress is a function"),
        ({"gaze": [[1, 2], [3]]}, "no array of numbers"),
        ({"mask": np.ones((800, 720), np.uint8)}, "0 and 1 alone"),
    ]:
        with pytest.raises((TypeError, fovqa.InputError), match=message):
            score(**arguments)


def test_a_sequence_that_fails_says_why():
    class Broken:
        def __len__(self):
            return 2

        def __getitem__(self, nth):
            if nth == 1:
                raise OSError("the disk is gone")
            return GOOD

    with pytest.warns(fovqa.FovqaWarning, match="test, frame 1: the disk is gone"):
        score = fovqa.score([GOOD, GOOD], Broken(), metrics="mse", signal={"plausibility": "off"})
    assert score.mse == 0 and [of.frame for of in score.failures] == [1]


def test_names_of_metrics_may_be_as_on_the_command_line(room):
    wanted = fovqa.score(*room, metrics=["ms_ssim", "psnr"]).to_json()
    assert fovqa.score(*room, metrics="ms-ssim,psnr").to_json() == wanted
    assert fovqa.score(*room, metrics=("ms-ssim", "psnr")).to_json() == wanted


def test_floats_that_are_codes_are_warned_of(room):
    reference, test = room
    with pytest.warns(fovqa.FovqaWarning, match="reference: its floats are whole numbers, up to"):
        fovqa.score(reference.astype(np.float32), test.astype(np.float32), metrics="psnr")
    for fine in (reference.astype(np.float32) / 255, np.ones((64, 64), np.float32), reference * np.float32(1.3)):
        assert not [text for text in fovqa.score(fine, fine, metrics="psnr").warnings if "whole numbers" in text]


def test_own_types_are_frames(room):
    reference, test = room
    read = fovqa.read(ROOM / "gt.png")
    shown = fovqa.foveate(read, "rmfr")
    assert fovqa.score(read, test).to_json() == fovqa.score(reference, test).to_json()
    assert fovqa.score(read, shown).to_json() == fovqa.score(reference, shown.image).to_json()
    assert fovqa.show(read).png == fovqa.show(reference).png == read._repr_png_()
    assert fovqa.score(memoryview(reference), test).to_json() == fovqa.score(reference, test).to_json()


class Lazy:
    """A sequence of one frame that is as long as it says."""

    def __init__(self, frame, length):
        self.frame, self.length = frame, length
        self.asked: list[int] = []

    def __len__(self):
        return self.length

    def __getitem__(self, nth):
        self.asked.append(nth)
        return self.frame


def test_only_frames_that_exist_are_asked_for():
    paths = Lazy(str(ROOM / "gt.png"), 3)
    assert len(fovqa.score(paths, paths, metrics="mse", progress=False).frames) == 3
    assert max(paths.asked) == 2
    with pytest.raises(fovqa.InputError, match="more than 10000000"):
        fovqa.score(Lazy(GOOD, 2**62), GOOD)
