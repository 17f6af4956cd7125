# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand-in for `cardioid._core`: accepts any scene and renders a gradient, pass by pass, on a thread of its own.

What a test wants it to do is set in `behaviour`; what the add-on asked for is in `scenes` and `sessions`.
"""

from __future__ import annotations

import threading
import time
from types import SimpleNamespace

import fake_film
import numpy as np
from fake_film import Error, Film, FilterJob  # noqa: F401  (a part of the module that this stands for)

behaviour = SimpleNamespace()
scenes: list[Scene] = []
sessions: list[Session] = []

k_channels = {"Combined": 4, "Depth": 1, "Normal": 3, "D1": 3, "D2": 3, "D3": 3, "C1": 3, "C2": 3}
k_blue = {"Normal": 1, "D1": 10, "D2": 20, "D3": 30, "C1": 40, "C2": 50}
k_emitted, k_stored = 250_000, 37_500  # photons of a sample


def reset() -> None:
    behaviour.sample_seconds = 0.0     # time that a sample takes
    behaviour.build_seconds = 0.0
    behaviour.fail = ""                # message of a render that fails
    behaviour.refuse = []              # problems of a scene that cannot be rendered
    behaviour.warnings = []
    behaviour.integrators = ["PTPPM", "PT", "SPPM"]
    behaviour.whole_frame = False      # pictures of the whole frame although a crop was asked for
    behaviour.on_sample = None         # called with the session after each sample
    scenes.clear()
    sessions.clear()
    fake_film.reset()


def integrators():
    return list(behaviour.integrators)


def version():
    return {"engine": "0.0.fake", "embree": "none", "isa": "none"}


class Scene:
    """Records each call as (method, arguments); `add_…` return running indices."""

    def __init__(self):
        self.calls = []
        self.settings = {}
        self._counts = {}
        scenes.append(self)

    def set_settings(self, settings):
        self.settings.update(settings)

    def problems(self):
        return []

    def memory_estimate(self):
        return 1 << 20

    def __getattr__(self, name):
        if not name.startswith(("add_", "set_")):
            raise AttributeError(name)

        def record(*arguments, **keywords):
            self.calls.append((name, arguments, keywords))
            self._counts[name] = self._counts.get(name, -1) + 1
            return self._counts[name]

        return record


class Frame:
    def __init__(self, size, samples):
        self.width, self.height = size
        self.samples = samples

    def names(self):
        return list(k_channels)

    def array(self, name):
        """x in red, y in green, the share of finished samples in blue; depth: x + y in pixels."""
        y, x = np.mgrid[0:self.height, 0:self.width].astype(np.float32)
        if name == "Depth":
            return (x + y)[..., None]
        picture = np.empty((self.height, self.width, k_channels[name]), np.float32)
        picture[..., 0] = (x + 0.5) / self.width
        picture[..., 1] = (y + 0.5) / self.height
        picture[..., 2] = self.samples if name == "Combined" else k_blue[name]
        if picture.shape[2] == 4:
            picture[..., 3] = 1
        return picture


class Session:
    def __init__(self, scene):
        if behaviour.refuse:
            raise Error(behaviour.refuse)
        self.settings = scene.settings
        self.cancelled_at = None
        self.finished_at = None
        self._cancel, self._done = threading.Event(), threading.Event()
        self._samples = 0
        self._phase = "build"
        self._start = time.monotonic()
        self._thread = threading.Thread(target=self._render, daemon=True)
        sessions.append(self)

    def start(self):
        self._thread.start()

    def wait(self, seconds):
        return self._done.wait(seconds)

    def cancel(self):
        if self.cancelled_at is None:
            self.cancelled_at = time.monotonic()
        self._cancel.set()

    def progress(self):
        total = self.settings["samples"]
        elapsed = time.monotonic() - self._start
        return {"phase": self._phase, "fraction": self._samples / total, "samples": self._samples,
                "total_samples": total, "elapsed": elapsed, "remaining": 43.0, "memory_bytes": 512 << 20,
                "message": behaviour.fail if self._phase == "failed" else "", "revision": self._samples,
                **self._photon_progress()}

    def _photon_progress(self):
        if self.settings["integrator"] == "path_tracing":
            return {"passes": 0, "photons_emitted": 0, "photons_stored": 0}
        return {"passes": self._samples // 2, "photons_emitted": self._samples * k_emitted,
                "photons_stored": self._samples * k_stored}

    def frame(self):
        if self._samples == 0:
            return None
        whole = self.settings["width"], self.settings["height"]
        crop = tuple(self.settings.get("crop", (0, 0, 0, 0)))
        return Frame(crop[2:] if crop[2] and not behaviour.whole_frame else whole, self._samples)

    def film(self):
        frame = self.frame()
        if frame is None or not self.settings.get("record_clusters", True):
            return None
        return Film(frame.width, frame.height, frame.samples, self.settings)

    def warnings(self):
        return list(behaviour.warnings)

    def stats(self):
        told = {"samples": self._samples, "seconds": {"render": time.monotonic() - self._start},
                "counts": {"non_finite_dropped": 0}, "bytes": {"film": 1 << 20}}
        if self.settings["integrator"] != "path_tracing":
            told["photons"] = {"passes": self._samples // 2, "skipped_passes": 0, "training_passes": 1,
                               "emitted": self._samples * k_emitted, "stored": self._samples * k_stored,
                               "gathered": 12_345_678, "rays": 3_000_000, "per_sample": k_emitted}
            told["seconds"].update(photon_trace=1.25, photon_index=0.5, camera=7.75)
            told["bytes"]["photons"] = 3 << 20
        return told

    def _render(self):
        self._cancel.wait(behaviour.build_seconds)
        self._phase = "render"
        while self._samples < self.settings["samples"] and not behaviour.fail:
            if self._cancel.wait(behaviour.sample_seconds):
                break
            self._samples += 1
            if behaviour.on_sample:
                behaviour.on_sample(self)
        self._phase = "failed" if behaviour.fail else "cancelled" if self._cancel.is_set() else "done"
        self.finished_at = time.monotonic()
        self._done.set()


reset()
