"""Emulated frames, built-in scenes and files are those of the command."""

from __future__ import annotations

import json

import numpy as np
import pytest
from PIL import Image

import fovqa
from conftest import ROOM, command

VIEW = {"fov_vertical_deg": 95}


@pytest.mark.parametrize(
    ("options", "arguments"),
    [
        ("--method rmfr --set sigma=2.6", {"method": "rmfr", "sigma": 2.6}),
        ("--method rmfr --budget 0.15 --gaze 200,300", {"method": "rmfr", "budget": 0.15, "gaze": (200, 300)}),
        (
            "--method vafr --fov-vertical 95 --filter own",
            {"method": {"model": "vafr"}, "view": VIEW, "filter": "own"},
        ),
        (
            "--method deamp --fov-vertical 95 --sampling area --jitter halton --space linear",
            {"method": "deamp", "view": VIEW, "sampling": "area", "jitter": "halton", "space": "linear"},
        ),
        ("--method kfr --crop 10,20,300,400", {"method": "kfr", "crop": (10, 20, 300, 400)}),
    ],
)
def test_a_frame_is_that_of_the_command(options, arguments, tmp_path):
    source = ROOM / "gt.png"
    text = command("foveate", source, tmp_path / "shown.png", *options.split(), "--format", "json")
    wanted = json.loads(text)
    found = fovqa.foveate(np.asarray(Image.open(source)), **arguments)
    assert np.array_equal(found.image, np.asarray(Image.open(tmp_path / "shown.png")))
    document = found.to_dict()
    for frame in (document["frames"][0], wanted["frames"][0]):
        frame.pop("input")
        frame.pop("output", None)
    assert document == wanted
    assert found.samples == wanted["frames"][0]["samples"] and found.parameters == wanted["parameters"]


def test_the_type_of_the_input_is_kept(random):
    codes = random.integers(0, 256, (64, 80, 3), dtype=np.uint8)
    for frame, kind in [
        (codes, "uint8"),
        (codes[..., 0], "uint8"),
        (codes.astype(np.uint16) * 257, "uint16"),
        (codes.astype(np.float16) / 255, "float32"),
        (codes.astype(np.float32) * 4, "float32"),
    ]:
        found = fovqa.foveate(frame, "rmfr", budget=0.3)
        assert found.image.dtype == kind and found.image.shape == frame.shape
        full = fovqa.foveate(frame, "full")
        assert np.array_equal(full.image, frame), "the whole frame, beyond white as well"
    encoded = fovqa.foveate(codes.astype(np.float32) / 255, "full", signal={"transfer": "srgb"})
    assert np.allclose(encoded.image * 255, codes, atol=1e-4)


def test_buffers_are_given_if_asked_for(room):
    found = fovqa.foveate(room[0], "guenter", view=VIEW, buffers=True)
    sizes = [list(buffer.shape[1::-1]) for buffer in found.buffers]
    assert len(sizes) == 3 and sizes == found.to_dict()["frames"][0]["buffers"]
    assert fovqa.foveate(room[0], "rmfr").buffers == []
    with pytest.raises(fovqa.FovqaError, match="buffer"):
        fovqa.foveate(room[0], "cps", view=VIEW, buffers=True)


def test_a_sequence_is_filtered_along_its_motion():
    hall = fovqa.gallery(view=VIEW, resolution=(160, 140), frames=4, samples=1)
    still = fovqa.foveate(hall.encoded, "rmfr", view=VIEW, gaze=hall.gaze, budget=0.2, jitter="halton")
    moved = fovqa.foveate(
        hall.encoded, "rmfr", view=VIEW, gaze=hall.gaze, budget=0.2, jitter="halton", temporal=True, motion=hall.motion
    )
    assert len(moved) == 4 and moved.numbers == [0, 1, 2, 3] and len(moved.images) == 4
    error = [
        fovqa.score(hall.encoded, of.images, view=VIEW, metrics="mse", progress=False).mse for of in (still, moved)
    ]
    assert error[1] < error[0]
    assert fovqa.foveate(hall.encoded, "rmfr", frames="1..3").numbers == [1, 2]
    assert fovqa.foveate(hall.encoded, "rmfr", frames=range(0, 4, 2)).numbers == [0, 2]


def test_mistakes_are_explained(room):
    for arguments, message in [
        ({"method": "rmrf"}, 'did you mean "rmfr"'),
        ({"method": "rmfr", "sigma": -1}, "sigma cannot be -1"),
        ({"method": "rmfr", "sgma": 1}, "sgma"),
        ({"method": {"sigma": 1}}, "has no model"),
        ({"method": {"model": "rmfr", "sigma": 2}, "sigma": 3}, "sigma in the method and as an argument"),
        ({"method": "rmfr", "budget": 5000}, "budget"),
        ({"method": "guenter"}, "view"),
        ({"method": "rmfr", "frames": "5..9"}, "frames"),
    ]:
        with pytest.raises(fovqa.FovqaError) as caught:
            fovqa.foveate(room[0], **arguments)
        assert message in str(caught.value), caught.value
    bad = room[0].astype(np.float32)
    bad[5, 6] = np.inf
    with pytest.raises(fovqa.InputError, match="at pixel \\(6, 5\\)"):
        fovqa.foveate(bad, "rmfr")


def test_a_built_in_scene_is_that_of_the_command(tmp_path):
    options = "--resolution 96x80 --fov-vertical 95 --samples 2 --frames 2 --seed 5"
    command("gallery", "--output", tmp_path / "files", *options.split())
    hall = fovqa.gallery(view=VIEW, resolution="96x80", samples=2, frames=2, seed=5)
    assert hall.write(tmp_path / "again", progress=False) == 2
    for path in sorted((tmp_path / "files").rglob("*.*")):
        assert path.read_bytes() == (tmp_path / "again" / path.relative_to(tmp_path / "files")).read_bytes()
    for nth, frame in enumerate(hall):
        read = fovqa.read(tmp_path / "files" / "exr" / f"000{nth}.exr", guides=True)
        assert np.array_equal(frame.image.astype(np.float16), read.image)
        assert np.array_equal(frame.motion, read.motion) and np.array_equal(frame.depth, read.depth)
        assert np.array_equal(frame.encoded, np.asarray(Image.open(tmp_path / "files" / "png" / f"000{nth}.png")))
        assert frame.gaze == tuple(hall.gaze[nth])
    assert len(hall) == 2 and hall.fps == 90 and "2 frames of 96x80" in repr(hall)
    assert len(hall[1:]) == 1 and np.array_equal(hall[-1].image, hall.images[1])
    with pytest.raises(IndexError):
        _ = hall[2]
    left, right = (fovqa.gallery(view=VIEW, resolution=(96, 80), samples=1, eye=eye) for eye in ("left", "right"))
    assert left[0].gaze[0] > right[0].gaze[0], "the eyes converge"
    chart = fovqa.gallery("csf-chart", resolution=(64, 48), samples=1)
    assert chart[0].image.shape == (48, 64, 3)
    for arguments, message in [
        ({}, "view"),
        ({"view": VIEW}, "size of the frames"),
        ({"scene": "hall"}, "cannot be"),
        ({"view": VIEW, "resolution": (5, -5)}, "resolution"),
        ({"view": VIEW, "resolution": (50, 50), "eye": "third"}, "eye"),
        ({"view": VIEW, "resolution": (50, 50), "samples": 0}, "samples"),
    ]:
        with pytest.raises(fovqa.RequestError, match=message):
            fovqa.gallery(**arguments)


def test_files_are_read_as_the_metrics_read_them(tmp_path, random):
    codes = random.integers(0, 65536, (20, 30), dtype=np.uint16)
    Image.fromarray(codes).save(tmp_path / "deep.png")
    frame = fovqa.read(tmp_path / "deep.png")
    assert np.array_equal(frame.image, codes) and frame.motion is None and repr(frame) == "Frame(20 x 30 of uint16)"
    assert np.array_equal(fovqa.read(tmp_path / "deep.png", crop=(3, 4, 5, 6)).image, codes[4:10, 3:8])
    alpha = random.integers(0, 256, (20, 30, 4), dtype=np.uint8)
    Image.fromarray(alpha).save(tmp_path / "alpha.png")
    with pytest.raises(fovqa.InputError, match="alpha") as caught:
        fovqa.read(tmp_path / "alpha.png")
    assert 'signal={"alpha": "ignore"}' in caught.value.help
    assert np.array_equal(fovqa.read(tmp_path / "alpha.png", alpha="ignore").image, alpha[..., :3])
    with pytest.raises(fovqa.InputError, match="there are 2 frames"):
        fovqa.read(tmp_path / "*.png")
    assert fovqa.read(tmp_path / "*.png", frame=1).image.dtype == np.uint16
    with pytest.raises(fovqa.InputError, match="there is no frame 2"):
        fovqa.read(tmp_path / "*.png", frame=2)
    for wrong in ({"alhpa": "ignore"}, {"tonemap": "reinhard"}):
        with pytest.raises(fovqa.RequestError, match="read has no"):
            fovqa.read(tmp_path / "alpha.png", **wrong)
    with pytest.raises(fovqa.InputError, match="there is no frame -1"):
        fovqa.read(tmp_path / "*.png", frame=-1)


def test_frames_are_shown_as_pictures(room, tmp_path):
    path = fovqa.show(room[0]).save(tmp_path / "shown.png")
    assert np.array_equal(np.asarray(Image.open(path)), room[0])
    light = np.full((4, 5), 0.2158605, np.float32)
    dark = fovqa.show(light, signal={"exposure_stops": -1}).save(tmp_path / "dark.png")
    assert np.asarray(Image.open(fovqa.show(light).save(path))).max() == 128
    assert np.asarray(Image.open(dark)).max() < 128
    assert fovqa.foveate(room[0], "full")._repr_png_()[:4] == b"\x89PNG"
