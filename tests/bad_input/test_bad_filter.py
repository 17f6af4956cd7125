# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input for the noise filter: limits of its settings and of pictures (cases_filter.py), film files, full disks."""

from __future__ import annotations

import contextlib
import json
import os
import re
import signal
import subprocess
from pathlib import Path

import pytest
from conftest import HERE, IS_CARDIOID, Blender, Case, finished
from live import Live

pytestmark = pytest.mark.skipif(not IS_CARDIOID, reason="only Cardioid keeps films")

# Share of the light that 4 samples may gain or lose at any limit. The published filter gains where nothing is alike;
# rejection without smoothing may withhold.
METHODS = {"clusters": 0.05, "thesis": 0.5, "cross_bilateral": 0.2, "none": 0.2}
CROPPED = ["border", "border_cropped"]
SIZES = ["size_1_1", "size_2_1", "size_1_9", "size_3_3", "size_9_8"]


@pytest.fixture(scope="module")
def cases(blender: Blender) -> dict[str, Case]:
    """Every case of cases_filter.py by name, from one Blender."""
    ended = blender.run("-b", "--factory-startup", "-noaudio", "--python", HERE / "cases_filter.py", seconds=150)
    pattern = re.compile(r"^CASE-BEGIN (\w+)\n(.*?)^CASE-END \1 (\{.*?\})$", re.MULTILINE | re.DOTALL)
    found = {name: Case(json.loads(data), text) for name, text, data in pattern.findall(ended.text)}
    assert found, f"exit code {ended.code}\n{ended.text[-3000:]}"
    return found


def brightness(data: dict, picture: str = "mean") -> float:
    return sum(data[picture][:3]) / 3


def same_light(data: dict, share: float) -> None:
    assert brightness(data) == pytest.approx(brightness(data, "raw"), rel=share), data


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("limit", ["smallest_size", "even_size", "largest_size", "no_sensitivity", "most_sensitivity",
                                   "no_removal", "no_layers"])
def test_limits_keep_the_light(cases, method: str, limit: str) -> None:
    same_light(finished(cases, f"{method}_{limit}"), METHODS[method])


@pytest.mark.parametrize("method", METHODS)
def test_an_even_size_is_the_next_odd_one(cases, method: str) -> None:
    even, odd = (finished(cases, f"{method}_{name}_size") for name in ("even", "odd"))
    assert even["mean"] == odd["mean"] and even["highest"] == odd["highest"]


@pytest.mark.parametrize("method", METHODS)
def test_most_removal_takes_light_away_and_breaks_nothing(cases, method: str) -> None:
    data = finished(cases, f"{method}_most_removal")
    assert 0 <= brightness(data) <= 1.05 * brightness(data, "raw")


@pytest.mark.parametrize("name", [*SIZES, *CROPPED, "one_sample"])
def test_small_and_cropped_pictures(cases, name: str) -> None:
    same_light(finished(cases, name), 0.1)


def test_emission_that_is_seen_is_left_alone(cases) -> None:
    data = finished(cases, "emission_alone")
    assert data["mean"][:3] == pytest.approx([0.25, 0.5, 0.75], abs=1e-5)
    assert data["lowest"] == pytest.approx(0.25, abs=1e-6) and data["highest"] == pytest.approx(0.75, abs=1e-6)


def test_nothing_stays_nothing(cases) -> None:
    assert finished(cases, "nothing_to_see")["highest"] == 0


def test_strange_light(cases) -> None:
    assert finished(cases, "brightest_lamp")["highest"] > 1
    dark = finished(cases, "negative_lamp")
    assert dark["highest"] <= 0 and brightness(dark) == pytest.approx(brightness(dark, "raw"), rel=0.1)
    finished(cases, "black_floor")
    clear = finished(cases, "transparent_film")
    assert clear["mean"][3] == clear["raw"][3] < 0.9


# Film files ---------------------------------------------------------------------------------------------------

SCENE = """
import bpy
scene = bpy.context.scene
scene.render.engine = "CARDIOID"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 64, 36, 100
scene.cardioid.samples, scene.cardioid.save_film = {samples}, True
bpy.ops.wm.save_as_mainfile(filepath={path!r})
"""

OPEN = """
import bpy
scene = bpy.context.scene
bpy.ops.render.render()
for path in {paths!r}:
    try:
        bpy.ops.cardioid.open_film(filepath=path)
        print("OPENED", path, flush=True)
    except RuntimeError as error:
        print("REFUSED", str(error).strip(), flush=True)
print("AGAIN", bpy.ops.cardioid.filter_again(), flush=True)
"""


def run_script(blender: Blender, folder: Path, text: str, *before: str | Path):
    script = folder / "script.py"
    script.write_text(text)
    arguments = ["-b", "--factory-startup", "-noaudio", "--addons", "cardioid", *before, "--python", script]
    ended = blender.run(*arguments)
    ended.check_clean()
    return ended


@pytest.fixture(scope="module")
def files(blender: Blender, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("films")
    for name, samples in (("short", 2), ("endless", 1 << 20)):
        run_script(blender, folder, SCENE.format(samples=samples, path=str(folder / f"{name}.blend")))
    return folder


@pytest.fixture(scope="module")
def film(blender: Blender, files: Path) -> Path:
    blender.render_file(files / "short.blend", files / "good_####").check_clean()
    return files / "good_0001.cardioid"


def test_a_film_lies_beside_its_frame(film: Path) -> None:
    assert film.stat().st_size > 1000 and film.with_suffix(".exr").exists()
    assert sorted(path.name for path in film.parent.glob("good_*")) == ["good_0001.cardioid", "good_0001.exr"]


def test_bad_film_files_are_named_and_change_nothing(blender, files, film, tmp_path: Path) -> None:
    """Cut off anywhere, with one bit changed, of another kind, empty, a folder, absent; then the film still filters."""
    content = film.read_bytes()
    bad = {f"cut{share}": content[: len(content) * share // 10] for share in (0, 3, 6, 9)}
    bad |= {f"bit{at}": content[:at] + bytes([content[at] ^ 4]) + content[at + 1 :] for at in (0, 9, 17, 1000, -2)}
    bad |= {"long": content + b"more", "picture": film.with_suffix(".exr").read_bytes(), "text": b"not a film\n" * 99}
    paths = []
    for name, data in bad.items():
        paths.append(str(tmp_path / f"{name}.cardioid"))
        Path(paths[-1]).write_bytes(data)
    (tmp_path / "folder.cardioid").mkdir()
    paths += [str(tmp_path / "folder.cardioid"), str(tmp_path / "absent.cardioid")]
    text = run_script(blender, tmp_path, OPEN.format(paths=paths), files / "short.blend").text
    refused = [line for line in text.splitlines() if line.startswith("REFUSED")]
    assert len(refused) == len(paths) and "OPENED" not in text, text[-3000:]
    for path, line in zip(paths, refused):
        assert Path(path).name in line and "Cardioid" in line, (path, line)
    assert "AGAIN {'FINISHED'}" in text


@pytest.fixture
def small_disk(tmp_path: Path):
    """A folder on a file system that takes the picture and not the film."""
    folder = tmp_path / "small"
    folder.mkdir()
    if os.geteuid() != 0 or subprocess.run(["mount", "-t", "tmpfs", "-o", "size=96k", "tmpfs", folder]).returncode != 0:
        pytest.skip("only root can mount a small disk")
    try:
        yield folder
    finally:
        subprocess.run(["umount", folder], check=True)


def test_a_disk_that_fills_leaves_the_picture_and_the_old_film(blender, files, film, small_disk: Path) -> None:
    assert film.stat().st_size > 96 << 10, "the film must not fit"
    old = small_disk / "p_0001.cardioid"
    old.write_bytes(b"last week's film")
    ended = blender.render_file(files / "short.blend", small_disk / "p_####")
    ended.check_clean()
    assert re.search(r"Cardioid: the film could not be saved: .*p_0001\.cardioid", ended.text), ended.text
    assert (small_disk / "p_0001.exr").stat().st_size > 1000
    assert old.read_bytes() == b"last week's film"
    assert sorted(path.name for path in small_disk.iterdir()) == ["p_0001.cardioid", "p_0001.exr"]


def test_a_folder_that_cannot_be_written(blender, files, tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    ended = blender.render_file(files / "short.blend", tmp_path / "p_####", "--cardioid-film",
                                str(tmp_path / "file" / "film.cardioid"))
    ended.check_clean()
    assert "the film could not be saved" in ended.text and (tmp_path / "p_0001.exr").exists()


def test_wrong_options_are_one_error(blender, files, tmp_path: Path) -> None:
    for option, value, message in (("--cardioid-filter", "yes", "on, off"), ("--cardioid-filter-size", "64", "1 to 63"),
                                   ("--cardioid-filter-method", "oidn", "clusters, thesis, cross_bilateral, none")):
        ended = blender.render_file(files / "short.blend", tmp_path / "p_####", option, value)
        ended.check_clean()
        errors = [line for line in ended.text.splitlines() if line.startswith("Error")]
        assert len(errors) == 1 and message in errors[0], ended.text
    assert not list(tmp_path.glob("p_*"))


def test_a_cancelled_render_ends_promptly_and_leaves_no_half_film(blender, files, tmp_path: Path) -> None:
    arguments = ["-b", "--factory-startup", "-noaudio", "--addons", "cardioid", files / "endless.blend"]
    process = blender.start(*arguments, "-o", tmp_path / "p_####", "-F", "OPEN_EXR", "-f", "1")
    with Live(process) as live:
        live.wait_for(r"Sample \d\d", 60)
        live.send(signal.SIGINT)
        assert live.wait_for_end(10) < 10
    with contextlib.suppress(FileNotFoundError):
        film = tmp_path / "p_0001.cardioid"
        script = OPEN.format(paths=[str(film)])
        assert film.stat().st_size == 0 or "OPENED" in run_script(blender, tmp_path, script, files / "short.blend").text
    assert not [path for path in tmp_path.iterdir() if path.suffix not in {".cardioid", ".exr", ".py"}]
