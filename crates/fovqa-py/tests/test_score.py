"""Scores are those of the command, to the last bit."""

from __future__ import annotations

import json
import pickle
import re
import warnings

import numpy as np
import pytest
from PIL import Image

import fovqa
from conftest import ROOM, command

VIEW = {"fov_vertical_deg": 95, "bands_deg": [0, 5, 10, 20, 40]}
OPTIONS = ["--fov-vertical", 95, "--bands", "0,5,10,20,40"]
# What 8-bit stills have.
EVERYTHING = [name for name in fovqa.metrics() if name not in ("atd", "flicker", "hdr_flip")]


def as_arguments(text: str) -> str:
    """The output of the command with the names that arrays have."""
    return re.sub(r'"(reference|test)": "[^"]*"', r'"\1": "\1"', text)


def test_arrays_and_files_have_the_numbers_of_the_command(room):
    reference, test = room
    files = ROOM / "gt.png", ROOM / "rmfr.png"
    view = {**VIEW, "luminance": "htc-vive-pro"}
    options = [*OPTIONS, "--luminance", "htc-vive-pro", "--metrics", ",".join(EVERYTHING), "--gaze", "300,420"]
    for form, of in (("json", fovqa.Score.to_json), ("csv", fovqa.Score.to_csv)):
        wanted = command("score", *files, *options, "--format", form)
        by_path = fovqa.score(*files, metrics=EVERYTHING, view=view, gaze=(300, 420))
        by_array = fovqa.score(reference, test, metrics=EVERYTHING, view=view, gaze=np.array([300, 420]))
        assert of(by_path) == wanted
        assert of(by_array) == as_arguments(wanted)
    wanted = json.loads(command("score", *files, *options, "--format", "json"))
    assert by_array.psnr == wanted["summary"]["psnr"]["mean"]
    assert by_array.fvvdp == wanted["sequence"]["fvvdp"]["jod"]


def test_every_type_has_the_numbers_of_its_file(tmp_path, random):
    codes16 = random.integers(0, 65536, (2, 40, 56, 3), dtype=np.uint16)
    gray = random.integers(0, 256, (2, 40, 56), dtype=np.uint8)
    for array in (gray, codes16[..., 0]):
        files = [tmp_path / f"{nth}.png" for nth in range(2)]
        for nth, file in enumerate(files):
            Image.fromarray(array[nth]).save(file)
        wanted = command("score", *files, *OPTIONS, "--format", "json")
        assert fovqa.score(array[0], array[1], view=VIEW).to_json() == as_arguments(wanted)
        assert fovqa.score(array[0][..., None], array[1], view=VIEW).to_json() == as_arguments(wanted)
    # OpenEXR, whose floats are in planes: a scene that fovqa writes itself.
    command(
        "gallery",
        "--output",
        tmp_path / "hall",
        "--resolution",
        "90x80",
        "--fov-vertical",
        95,
        "--samples",
        1,
        "--frames",
        2,
    )
    files = [tmp_path / "hall" / "exr" / f"000{nth}.exr" for nth in range(2)]
    frames = [fovqa.read(file).image for file in files]
    assert [(frame.dtype.name, frame.shape) for frame in frames] == [("float16", (80, 90, 3))] * 2
    wanted = command("score", *files, *OPTIONS, "--tonemap", "reinhard", "--format", "json")
    signal = {"tonemap": "reinhard"}
    for of in (np.ascontiguousarray, np.asfortranarray):
        found = fovqa.score(of(frames[0]), of(frames[1]), view=VIEW, signal=signal)
        assert found.to_json() == as_arguments(wanted)
    # Emulated frames are kept in 32 bits.
    scene = {"name": "hall", "builtin": "gallery", "resolution": "90x80", "samples": 1}
    method = {"emulate": {"model": "rmfr", "keep_frames": True}}
    methods = [
        {"name": name, "emulate": {**method["emulate"], "sigma": sigma}} for name, sigma in (("A", 1.5), ("B", 3))
    ]
    fovqa.run(
        {"name": "kept", "view": {"fov_vertical_deg": 95}, "scene": [scene], "method": methods}, output=tmp_path / "run"
    )
    files = [tmp_path / "run" / "emulated" / "hall" / name / "0000.exr" for name in "AB"]
    frames = [fovqa.read(file).image for file in files]
    assert {frame.dtype.name for frame in frames} == {"float32"}
    wanted = command("score", *files, *OPTIONS, "--format", "json")
    assert fovqa.score(*frames, view=VIEW).to_json() == as_arguments(wanted)


def test_a_sequence_has_the_numbers_of_its_files(tmp_path):
    command(
        "gallery", "--output", tmp_path, "--resolution", "96x80", "--fov-vertical", 95, "--samples", 1, "--frames", 4
    )
    command(
        "foveate",
        tmp_path / "exr",
        tmp_path / "rmfr",
        "--method",
        "rmfr",
        "--gaze",
        tmp_path / "gaze.csv",
        "--fov-vertical",
        95,
    )
    options = [*OPTIONS, "--gaze", tmp_path / "gaze.csv", "--fps", 90, "--luminance", "htc-vive-pro"]
    options += ["--metrics", "psnr,ssim,atd,flicker,fvvdp", "--set", "flicker.frames=3"]
    wanted = json.loads(command("score", tmp_path / "exr", tmp_path / "rmfr", *options, "--format", "json"))
    read = [fovqa.read(path, guides=True) for path in sorted((tmp_path / "exr").iterdir())]
    references = [frame.image for frame in read]
    tests = [fovqa.read(path).image for path in sorted((tmp_path / "rmfr").iterdir())]
    gaze = np.loadtxt(tmp_path / "gaze.csv", delimiter=",", skiprows=1)[:, 1:]
    hall = fovqa.gallery(view={"fov_vertical_deg": 95}, resolution=(96, 80), samples=1, frames=4)
    assert np.array_equal(hall.gaze, gaze)

    class Dataset:
        """Fetches a frame when it is asked for."""

        def __len__(self):
            return len(tests)

        def __getitem__(self, nth):
            return tests[nth]

    for given in (tests, np.stack(tests), tuple(tests), Dataset(), sorted((tmp_path / "rmfr").iterdir())):
        found = fovqa.score(
            references,
            given,
            view={**VIEW, "luminance": "htc-vive-pro"},
            gaze=gaze,
            fps=90,
            metrics={"psnr": {}, "ssim": {}, "atd": {}, "flicker": {"frames": 3}, "fvvdp": {}},
            motion=[frame.motion for frame in read],
            depth=[frame.depth for frame in read],
        ).to_dict()
        assert found["sequence"] == wanted["sequence"]
        assert found["summary"] == wanted["summary"]
        assert found["summary_bands"] == wanted["summary_bands"]
    assert wanted["sequence"]["atd"]["motion"] == "reference", "the motion counts"
    # Files of a list bring their motion and depth.
    listed = sorted((tmp_path / "exr").iterdir())
    found = fovqa.score(listed, tests, view=VIEW, gaze=gaze, metrics="atd").to_dict()
    assert found["sequence"]["atd"] == wanted["sequence"]["atd"]


def test_both_eyes_have_the_numbers_of_the_command(room):
    files = [ROOM / name for name in ("gt.png", "rmfr.png", "gt.png", "vafr.png")]
    wanted = command(
        "score",
        files[0],
        files[1],
        "--right-reference",
        files[2],
        "--right-test",
        files[3],
        *OPTIONS,
        "--format",
        "csv",
    )
    reference, left = room
    right = np.asarray(Image.open(files[3]))
    score = fovqa.score(reference, left, right_reference=reference, right_test=right, view=VIEW)
    assert score.to_csv() == wanted
    assert score.has_two_eyes and list(score.eyes) == ["left", "right", "both"]
    assert score.psnr == score.eyes["both"]["psnr"]
    assert score.eyes["left"]["psnr"] == fovqa.score(reference, left, metrics="psnr").psnr
    with pytest.raises(fovqa.RequestError, match="no right_test"):
        fovqa.score(reference, left, right_reference=reference)


def test_masks_and_crops_are_those_of_the_command(room, tmp_path):
    reference, test = room
    files = ROOM / "gt.png", ROOM / "rmfr.png"
    mask = np.zeros(reference.shape[:2], bool)
    mask[100:500, 50:] = True
    Image.fromarray(mask.astype(np.uint8) * 255).save(tmp_path / "mask.png")
    wanted = command("score", *files, "--mask", tmp_path / "mask.png", "--crop", "10,20,600,700", "--format", "json")
    for given in (mask, mask.astype(np.uint8) * 255, mask.astype(np.float32), tmp_path / "mask.png"):
        found = fovqa.score(reference, test, mask=given, crop=(10, 20, 600, 700))
        assert found.to_json() == as_arguments(wanted)
    assert fovqa.score(reference, test, crop=(10, 20, 600, 700)).psnr != found.psnr


def test_maps_are_arrays_and_pictures(room, tmp_path):
    reference, test = room
    files = ROOM / "gt.png", ROOM / "rmfr.png"
    command("score", *files, *OPTIONS, "--metrics", "mse,ssim", "--maps", tmp_path)
    score = fovqa.score(reference, test, view=VIEW, metrics=["mse", "ssim"], maps=True)
    assert sorted(score.maps) == ["mse", "ssim"]
    for name, values in score.maps.items():
        written = fovqa.read(tmp_path / f"{name}-0000.exr").image
        assert values.dtype == np.float32 and values.shape == reference.shape[:2]
        assert np.array_equal(values.astype(written.dtype), written, equal_nan=True)
        picture = score.heat_map(name)
        assert picture.png == (tmp_path / f"{name}-0000.png").read_bytes()
        assert picture._repr_png_() == picture.png
        assert picture.save(tmp_path / "again.png").read_bytes() == picture.png
    # The squared error is of the display signal from 0 to 1.
    squared = ((reference.astype(float) - test) ** 2).mean(-1) / 255**2
    assert np.allclose(score.maps["mse"], squared, atol=1e-6)
    with pytest.raises(fovqa.RequestError, match="no map 'gmsd'"):
        score.map("gmsd")
    with pytest.raises(fovqa.RequestError, match="there are no maps"):
        fovqa.score(reference, test, metrics="ssim").map("ssim")
    with pytest.raises(fovqa.RequestError, match="none of the metrics has a map"):
        fovqa.score(reference, test, metrics="rms_contrast", view=VIEW, maps=True)


def test_results_become_tables(room):
    score = fovqa.score(*room, view=VIEW)
    values = [float(line.split(",")[-1]) for line in score.to_csv().splitlines()[1:]]
    pandas, polars = score.to_pandas(), score.to_polars()
    assert list(pandas.columns) == polars.columns == score.to_csv().splitlines()[0].split(",")
    # To the last bit: the table is the contract, not what a parser makes of it.
    assert pandas["value"].tolist() == polars["value"].to_list() == values
    psnr = pandas[(pandas.metric == "psnr") & pandas.from_deg.isna() & (pandas.statistic == "mean")]
    assert psnr["value"].tolist() == [score.psnr]


def test_identical_frames_are_infinitely_good(room):
    score = fovqa.score(room[0], room[0], metrics=["psnr", "mse"])
    assert score.psnr == float("inf") and score.mse == 0
    assert score.to_dict()["summary"]["psnr"]["mean"] == float("inf")
    assert json.loads(score.to_json())["summary"]["psnr"]["mean"] == "inf", "as the command prints it"
    assert np.isinf(score.to_pandas()["value"]).any()


def test_a_result_can_be_looked_at(room):
    score = fovqa.score(*room, view=VIEW, metrics=["psnr", "ssim", "rms_contrast"], maps=True)
    assert re.fullmatch(r"Score\(psnr=28\.65, ssim=0\.\d{4}\)", repr(score))
    assert str(score).startswith("test against reference")
    html = score._repr_html_()
    assert "PSNR (dB)" in html and "28.65" in html and "10°–20°" in html
    assert "psnr" in dir(score)
    with pytest.raises(AttributeError, match="fvvdp was not scored; scored are: psnr, ssim"):
        _ = score.fvvdp
    again = pickle.loads(pickle.dumps(score))
    assert again.to_json() == score.to_json() and np.array_equal(again.map("ssim"), score.map("ssim"), equal_nan=True)
    assert set(fovqa.metrics()) - {"rms_contrast", "haar", "spectrum"} <= set(fovqa.Score.__annotations__)


def test_linear_files_have_hdr_flip():
    files = [ROOM.parents[2] / "golden/more/in" / f"hdr_{side}.exr" for side in ("ref", "test")]
    score = fovqa.score(*files, metrics={"hdr_flip": {}, "flip": {"ppd": 67.0206}})
    assert abs(score.hdr_flip - 0.15198494164899415) < 2e-5
    assert score.frames[0]["metrics"]["hdr_flip_exposures"] == 10


def test_bands_and_profiles_show_the_values(room, tmp_path):
    score = fovqa.score(*room, view={**VIEW, "luminance": "htc-vive-pro"}, metrics=EVERYTHING)
    document = score.to_dict()
    for name in ("psnr", "ssim", "mse"):
        found = [band.value for band in score.bands(name)]
        assert found == [band[name] and band[name]["mean"] for band in document["summary_bands"]]
    assert score.bands("fvvdp")[0].value == document["sequence"]["fvvdp"]["shares"][0]["share"]
    sides = [score.bands("rms_contrast", image)[1].value for image in ("reference", "test", "ratio")]
    assert sides[2] == pytest.approx(sides[1] / sides[0])
    energy = [of for of in document["summary_haar"] if of["level"] == 2][0]["ratio"]["energy"]
    assert score.bands("haar", level=2)[0].value == (energy["mean"] if isinstance(energy, dict) else energy)
    spectrum = document["summary_spectrum"]
    assert [band.value for band in score.bands("spectrum")] == [band["cutoff_cpd"] for band in spectrum]
    whole = next(of for of in spectrum[1]["bins"] if of["cpd"] == 1.0)
    found = [score.bands("spectrum", image, 0, "power")[1].value for image in ("test", "ratio")]
    assert found == [whole["test"]["power"]["mean"], whole["ratio"]]
    assert "Spectrum, cut-off (cpd)" in score._repr_html_()
    for name in ("psnr", "rms_contrast", "haar", "fvvdp", "spectrum"):
        figure = score.profile(name, title="A room", width_in=4)
        assert "A room" in figure.svg and ("reference" in figure.svg) == (name in ("rms_contrast", "haar"))
    for ending, start in (("svg", b"<svg"), ("pdf", b"%PDF"), ("png", b"\x89PNG")):
        assert figure.save(tmp_path / f"figure.{ending}").read_bytes().startswith(start)
    both = fovqa.profile({"RMFR": score, "Again": score}, "ssim")
    assert "RMFR" in both.svg and "Again" in both._repr_svg_()
    assert pickle.loads(pickle.dumps(both)).pdf == both.pdf
    with pytest.raises(fovqa.RequestError, match="ssm was not scored; scored are: |help: scored are: mse"):
        score.bands("ssm")
    for wrong in ([score], {"A": 5}, score):
        with pytest.raises(TypeError, match="give scores by the names"):
            fovqa.profile(wrong)
    with pytest.raises(fovqa.FovqaError, match="cannot be written"):
        figure.save(tmp_path / "nowhere" / "figure.pdf")
    with pytest.raises(fovqa.RequestError, match="no values by eccentricity"):
        fovqa.score(*room, metrics="gmsd").profile("gmsd")
    with pytest.raises(fovqa.RequestError, match="did you mean width_in"):
        score.profile(width=3)
    with pytest.raises(fovqa.RequestError, match="SVG, PDF or PNG"):
        figure.save(tmp_path / "figure.jpg")


def test_warnings_are_python_warnings(room):
    reference, test = room
    with pytest.warns(fovqa.FovqaWarning, match="brighter|darker|exposure") as caught:
        score = fovqa.score(reference, test // 2, metrics="psnr")
    assert len(score.warnings) == 1
    assert caught[0].filename == __file__, "the line of the caller"
    assert fovqa.score(reference, test // 2, metrics="psnr", signal={"plausibility": "off"}).warnings == []
    # What nobody asked for is not warned of, but said.
    with warnings.catch_warnings():
        warnings.simplefilter("error", fovqa.FovqaWarning)
        assert len(fovqa.score(reference, test).warnings) == 3
    with pytest.warns(fovqa.FovqaWarning, match="needs a view"):
        fovqa.score(reference, test, view={"luminance": "htc-vive-pro"})


def test_frames_that_fail_do_not_hide_the_others(room):
    reference, test = room
    bad = reference.astype(np.float32) / 255
    bad[3, 4, 1] = np.nan
    good = test.astype(np.float32) / 255
    with pytest.warns(fovqa.FovqaWarning, match="frame 1 could not be scored"):
        score = fovqa.score([good, bad, good], [good, good, bad * 0], metrics="mse", signal={"plausibility": "off"})
    assert [failure.frame for failure in score.failures] == [1, 2]
    assert "channel G is NaN at pixel (4, 3)" in score.failures[0].message
    assert len(score.frames) == 1 and score.mse == 0
    with pytest.raises(fovqa.InputError, match="is NaN at pixel"):
        fovqa.score(bad, good)
    assert fovqa.score(bad, good, signal={"nonfinite": "mask"}, metrics="mse").mse >= 0
