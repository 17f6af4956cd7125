# SPDX-License-Identifier: GPL-3.0-or-later
"""The film at the end of a render: saved beside the frame and kept; later it is filtered again into the result."""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType
from typing import Any

import bpy

from . import film_files, films, messages, report, retune
from .frame_size import Shape
from .refilter import Refilter, run
from .render_result import Target
from .settings_table import k_tuning


@dataclass
class Taken:
    """A film as its render left it. settings: the engine's. entry: as for --cardioid-stats."""

    film: Any
    view: str
    shape: Shape
    settings: dict[str, Any]
    entry: dict[str, Any]


def finish(engine: bpy.types.RenderEngine, module: ModuleType, depsgraph: bpy.types.Depsgraph, taken: Taken,
           overrides: dict[str, Any], path: str) -> None:
    """Saves and keeps the film as the artist wishes. One that cannot be saved costs a warning, never the picture."""
    scene, layer = depsgraph.scene_eval, depsgraph.view_layer_eval.name
    if overrides.get("save_film", scene.cardioid.save_film):
        path = film_files.path_of(scene, layer, taken.view, animation=engine.is_animation, given=path)
        try:
            film_files.save(taken.film, path)
        except (module.Error, OSError) as error:
            messages.warn(engine, [f"the film could not be saved: {error}"])
    if overrides.get("keep_film", scene.cardioid.keep_film):
        shown = {setting.key: taken.settings[setting.key] for setting in k_tuning}
        kept = films.Kept(taken.film, taken.shape, shown, report.filter_stats(taken.entry), taken.entry)
        films.keep(scene.name, layer, taken.view, kept)


def fill(engine: bpy.types.RenderEngine, module: ModuleType, scene: str, work: retune.Work, kept: films.Kept,
         target: Target) -> None:
    """Filters a kept film into the result, following the artist's changes while there are any. Esc and a filter that
    fails leave the noisy picture, because Blender has thrown away the old one by then. Raises the engine's Error."""
    filtering = Refilter(module, kept, work.settings_for(scene, kept), work.threads)
    pending = True

    def show(frame: Any) -> None:
        nonlocal pending
        target.show(frame)
        pending = False

    def tell(share: float) -> None:
        filtering.want(work.settings_for(scene, kept))
        work.share = share
        engine.update_progress(share)

    engine.update_stats("", "Filtering")
    try:
        run(filtering, show, engine.test_break, tell, work.linger)
    except module.Error as error:
        work.failure = str(error)
        raise
    finally:
        if pending:
            raw = Refilter(module, kept, {**filtering.wanted, "use_filter": False}, work.threads)
            run(raw, target.show, lambda: False, lambda share: None, 0.0)
    kept.entry["filter"] = kept.stats if kept.settings["use_filter"] else {"seconds": 0}
