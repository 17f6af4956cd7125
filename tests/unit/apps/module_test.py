# SPDX-License-Identifier: GPL-3.0-or-later
"""Films and filter jobs of cardioid._core, without Blender. usage: module_test.py FOLDER_OF_THE_MODULE"""

from __future__ import annotations

import sys
import tempfile
import threading
import time
import unittest
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, sys.argv.pop())
import _core


def scene(**settings: Any) -> Any:
    """A lamp over a grey floor that a camera looks down on."""
    s = _core.Scene()
    s.add_material({"name": "grey", "graph": {"nodes": [], "surface": None, "volume": None, "displacement": None}})
    corners = np.array([[-5, -5, 0], [5, -5, 0], [5, 5, 0], [-5, 5, 0]], np.float32)
    mesh = s.add_mesh("floor", corners, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    s.add_instance({"name": "floor", "mesh": mesh, "materials": [-1]})
    s.add_light({"name": "lamp", "energy": 100.0, "radius": 0.5, "transform": moved(1, 1, 2)})
    s.set_camera({"name": "camera", "transform": moved(0, 0, 4)})
    s.set_settings({"width": 48, "height": 36, "samples": 8, **settings})
    return s


def moved(x: float, y: float, z: float) -> list[list[float]]:
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z]]


def rendered(**settings: Any) -> Any:
    session = _core.Session(scene(**settings))
    assert session.film() is None, "there is no film yet"
    session.start()
    assert session.wait(60)
    return session


def filtered(film: Any, settings: dict[str, Any] | None = None, threads: int = 0) -> Any:
    job = _core.FilterJob(film, settings or {}, threads)
    job.start()
    assert job.wait(60)
    return job.frame()


def differing(a: Any, b: Any) -> list[str]:
    return [n for n in a.names() if not np.array_equal(a.array(n), b.array(n))]


class Films(unittest.TestCase):
    def setUp(self) -> None:
        self.session = rendered(use_filter=True, filter_size=7)
        self.film = self.session.film()
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = str(Path(self.folder.name) / "frame.cardioid")

    def test_what_a_film_tells(self) -> None:
        self.assertEqual((self.film.width, self.film.height, self.film.samples), (48, 36, 8))
        self.assertTrue(self.film.has_clusters)
        self.assertGreater(self.film.memory_bytes, 48 * 36 * 100)
        settings = self.film.filter_settings()
        self.assertEqual((settings["use_filter"], settings["filter_size"]), (True, 7))
        self.assertEqual(settings["filter_method"], "clusters")

    def test_it_gives_the_render_s_picture_and_others(self) -> None:
        frame = self.session.frame()
        del self.session
        self.assertEqual(differing(frame, filtered(self.film)), [])
        self.assertEqual(differing(frame, filtered(self.film, threads=1)), [])
        self.assertEqual(differing(frame, filtered(self.film, {"filter_size": 15})), ["Combined", "Filtered"])
        raw = filtered(self.film, {"use_filter": False})
        self.assertTrue(np.array_equal(raw.array("Combined")[..., :3], frame.array("Raw")))

    def test_saved_and_loaded(self) -> None:
        self.film.save(self.path)
        again = _core.Film.load(self.path)
        self.assertEqual(again.filter_settings(), self.film.filter_settings())
        self.assertEqual(differing(self.session.frame(), filtered(again)), [])

    def test_files_that_are_none(self) -> None:
        with self.assertRaisesRegex(_core.Error, "does not exist"):
            _core.Film.load(self.path)
        scene().save(self.path)
        with self.assertRaisesRegex(_core.Error, "scene"):
            _core.Film.load(self.path)
        with self.assertRaisesRegex(_core.Error, "no/folder"):
            self.film.save(self.folder.name + "/no/folder/x.cardioid")

    def test_settings_that_are_wrong(self) -> None:
        for key, value in {
            "filter_sise": 3,
            "filter_size": 65,
            "luminance_sensitivity": 1.0,
            "firefly_density": float("nan"),
            "filter_method": "magic",
            "width": 4,
        }.items():
            with self.assertRaisesRegex(_core.Error, key) as caught:
                _core.FilterJob(self.film, {key: value})
            self.assertEqual(len(caught.exception.problems), 1)
        with self.assertRaisesRegex(_core.Error, "no film"):
            _core.FilterJob(None, {})

    def test_a_film_without_clusters(self) -> None:
        film = rendered(record_clusters=False).film()
        self.assertFalse(film.has_clusters)
        with self.assertRaisesRegex(_core.Error, "record_clusters"):
            _core.FilterJob(film, {"use_filter": True})
        self.assertNotIn("Raw", filtered(film).names())


class Jobs(unittest.TestCase):
    def test_life_of_a_job(self) -> None:
        film = rendered().film()
        job = _core.FilterJob(film, {"use_filter": True})
        self.assertEqual(job.progress(), {"phase": "waiting", "fraction": 0, "message": "", "elapsed": 0})
        self.assertIsNone(job.frame())
        self.assertFalse(job.wait(0.01))
        job.start()
        self.assertTrue(job.wait(60))
        self.assertEqual((job.progress()["phase"], job.progress()["fraction"]), ("done", 1))
        stats = job.stats()
        for key in ("seconds", "cpu_seconds", "clusters", "film_bytes", "cluster_bytes"):
            self.assertGreater(stats[key], 0, key)
        for key in ("singles", "rejected", "outlier_share", "withheld_share"):
            self.assertGreaterEqual(stats[key], 0, key)

    def test_cancelled_and_dropped(self) -> None:
        film = rendered(width=600, height=600, samples=1).film()
        job = _core.FilterJob(film, {"use_filter": True, "filter_size": 63})
        job.start()
        job.cancel()
        self.assertTrue(job.wait(60))
        self.assertEqual(job.progress()["phase"], "cancelled")
        self.assertIsNone(job.frame())
        job = _core.FilterJob(film, {"use_filter": True, "filter_size": 63})
        job.start()
        start = time.monotonic()
        del job
        self.assertLess(time.monotonic() - start, 2)

    def test_waiting_lets_other_threads_run(self) -> None:
        job = _core.FilterJob(rendered().film(), {"use_filter": True})
        done = threading.Event()
        threading.Thread(target=lambda: (time.sleep(0.05), done.set())).start()
        # Never started: it waits in vain, and the other thread ends meanwhile.
        self.assertFalse(job.wait(2))
        self.assertTrue(done.is_set())


if __name__ == "__main__":
    unittest.main()
