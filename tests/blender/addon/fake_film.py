# SPDX-License-Identifier: GPL-3.0-or-later
"""Films and filter jobs of the fake engine. Blue of a filtered picture is the filter's size, of a raw one -1."""

from __future__ import annotations

import json
import threading
import time
from types import SimpleNamespace

import numpy as np

k_defaults = {"use_filter": False, "filter_method": "clusters", "firefly_density": 0.0661157,
              "luminance_sensitivity": 0.5, "filter_size": 11, "filter_direct": True, "filter_indirect": True,
              "filter_deep": True, "texture_width": 0.1}

behaviour = SimpleNamespace()
jobs: list[FilterJob] = []


def reset() -> None:
    behaviour.filter_seconds = 0.0   # time that a job takes
    behaviour.fail = ""              # message of a job that fails: of all that smooth
    behaviour.full_disk = False
    jobs.clear()


class Error(Exception):
    def __init__(self, problems):
        super().__init__("; ".join(problems))
        self.problems = list(problems)


class Film:
    alive = 0

    def __init__(self, width, height, samples, settings, has_clusters=True):
        self.width, self.height, self.samples, self.has_clusters = width, height, samples, has_clusters
        self.memory_bytes = 250 << 20
        self._settings = {key: settings.get(key, value) for key, value in k_defaults.items()}
        Film.alive += 1

    def __del__(self):
        Film.alive -= 1

    def filter_settings(self):
        return dict(self._settings)

    def save(self, path):
        if behaviour.full_disk:
            raise Error([f"{path}: no space left on device"])
        with open(path, "w") as file:
            json.dump([self.width, self.height, self.samples, self._settings, self.has_clusters], file)

    @staticmethod
    def load(path):
        try:
            with open(path) as file:
                return Film(*json.load(file))
        except ValueError as error:
            raise Error([f"{path} is damaged"]) from error
        except OSError as error:
            raise Error([f"{path} cannot be read: {error.strerror}"]) from error


class FilmFrame:
    """x in red, y in green, blue by the filter."""

    k_channels = {"Combined": 4, "Depth": 1, "Normal": 3, "D1": 3, "D2": 3, "D3": 3, "C1": 3, "C2": 3, "Raw": 3,
                  "Filtered": 3, "Withheld": 3}

    def __init__(self, film, settings):
        self.width, self.height, self.samples = film.width, film.height, film.samples
        self._settings = settings

    def names(self):
        return list(self.k_channels)

    def array(self, name):
        y, x = np.mgrid[0:self.height, 0:self.width].astype(np.float32)
        picture = np.ones((self.height, self.width, self.k_channels[name]), np.float32)
        if name == "Depth":
            return picture
        filtered = self._settings["use_filter"] if name == "Combined" else name == "Filtered"
        picture[..., 0], picture[..., 1] = (x + 0.5) / self.width, (y + 0.5) / self.height
        picture[..., 2] = self._settings["filter_size"] if filtered else -1
        return picture


class FilterJob:
    def __init__(self, film, settings, threads=0):
        unknown = set(settings) - set(k_defaults)
        if unknown:
            raise Error([f"filter: unknown key {key}" for key in unknown])
        if settings["filter_size"] % 2 == 0:
            raise Error(["filter_size is even"])
        self.film, self.settings, self.threads = film, settings, threads
        self.cancelled = False
        self._seconds = behaviour.filter_seconds if settings["use_filter"] else 0.0
        self._cancel, self._done = threading.Event(), threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        jobs.append(self)

    def start(self):
        self._start = time.monotonic()
        self._thread.start()

    def wait(self, seconds):
        return self._done.wait(seconds)

    def cancel(self):
        self.cancelled = not self._done.is_set()
        self._cancel.set()

    def progress(self):
        phase = "render" if not self._done.is_set() else "failed" if self._fails() else (
            "cancelled" if self.cancelled else "done")
        share = min(1.0, (time.monotonic() - self._start) / self._seconds) if self._seconds else 1.0
        return {"phase": phase, "fraction": share, "message": behaviour.fail}

    def frame(self):
        if not self._done.is_set() or self.cancelled or self._fails():
            return None
        return FilmFrame(self.film, self.settings)

    def stats(self):
        return {"seconds": 0.75, "cpu_seconds": 1.5, "clusters": 4000, "singles": 300, "rejected": 100,
                "rejected_samples": 120, "outlier_share": 0.025, "withheld_share": 0.0125}

    def _fails(self):
        return behaviour.fail and self.settings["filter_method"] != "none"

    def _run(self):
        self._cancel.wait(self._seconds)
        self._done.set()


reset()
