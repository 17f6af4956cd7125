# SPDX-License-Identifier: GPL-3.0-or-later
"""One call of Blender's render(): a frame of one view layer, in each of its views."""

from __future__ import annotations

import time
from types import ModuleType
from typing import Any

import bpy

from . import (
    cli_args,
    core,
    export,
    film_stage,
    films,
    frame_size,
    messages,
    passes,
    render_loop,
    report,
    retune,
    sessions,
    stats_file,
)
from .messages import RenderProblem
from .render_result import Target
from .resolve import resolve, unsupported


def render(engine: bpy.types.RenderEngine, depsgraph: bpy.types.Depsgraph) -> None:
    """Renders into the engine's result. Raises RenderProblem with a sentence for the artist."""
    module = core.load()
    if module is None:
        raise RenderProblem(core.problem())
    arguments = cli_args.current()
    if arguments.problems:
        raise RenderProblem(messages.summary(arguments.problems))
    work = None if engine.is_preview else retune.current()
    with sessions.exclusive(preview=engine.is_preview):
        for view in _views(engine):
            kept = films.get(depsgraph.scene.name, depsgraph.view_layer.name, view) if work else None
            if kept is not None:
                _filter_view(engine, module, depsgraph, view, work, kept)
            elif not engine.test_break():
                _render_view(engine, module, depsgraph, view, arguments)


def _views(engine: bpy.types.RenderEngine) -> list[str]:
    """Names of the stereo or multi-view views that Blender wants; one empty name without them."""
    result = engine.get_result()
    names = [view.name for view in result.views] if result else []
    return names or [""]


def _overrides(engine: bpy.types.RenderEngine, scene: bpy.types.Scene, arguments: cli_args.Arguments) -> dict[str, Any]:
    """What wins over the scene's settings: the command line; lines of Freestyle are no light and are never filtered."""
    if engine.is_preview:
        return {}
    if scene.name not in bpy.data.scenes:
        return {**arguments.overrides, "use_filter": False, "keep_film": False, "save_film": False}
    return {**arguments.overrides, **({"save_film": True} if arguments.film else {})}


def _render_view(engine: bpy.types.RenderEngine, module: ModuleType, depsgraph: bpy.types.Depsgraph, view: str,
                 arguments: cli_args.Arguments) -> None:
    scene, layer = depsgraph.scene_eval, depsgraph.view_layer_eval
    overrides = _overrides(engine, scene, arguments)
    try:
        settings = resolve(scene, layer, overrides, preview=engine.is_preview)
    except ValueError as error:
        raise RenderProblem(str(error)) from error
    if view:
        engine.active_view_set(view)
    wanted = list(passes.enabled(layer))
    if not engine.is_preview:
        films.give_way(scene.name, layer.name, view)
    start = time.monotonic()
    exported = _export(engine, module, depsgraph, settings, wanted)
    if exported is None:
        return
    if not engine.is_preview:
        messages.warn(engine, exported.warnings + unsupported(scene, layer))
        if arguments.export:
            _save_scene(module, exported, arguments.export.replace("#", str(scene.frame_current)))
    shape = frame_size.shape(scene.render)
    target = Target(engine, layer.name, view, shape, wanted)
    entry = {"frame": scene.frame_current, "layer": layer.name, "view": view, "settings": settings,
             "export": exported.timings, "export_seconds": time.monotonic() - start}
    try:
        film = _run(engine, module, exported, target, entry)
    finally:
        target.close()
    if not engine.is_preview:
        if film is not None:
            taken = film_stage.Taken(film, view, shape, settings, entry)
            film_stage.finish(engine, module, depsgraph, taken, overrides, arguments.film)
        report.stamp(engine, layer.name, entry)
        _tell(engine, arguments, entry)


def _filter_view(engine: bpy.types.RenderEngine, module: ModuleType, depsgraph: bpy.types.Depsgraph, view: str,
                 work: retune.Work, kept: films.Kept) -> None:
    """Fills the result from a kept film by the filter's settings of now. Nothing is exported or traced."""
    layer = depsgraph.view_layer_eval
    if view:
        engine.active_view_set(view)
    shape = frame_size.shape(depsgraph.scene_eval.render)
    target = Target(engine, layer.name, view, shape, list(passes.enabled(layer)))
    try:
        film_stage.fill(engine, module, depsgraph.scene.name, work, kept, target)
    except module.Error as error:
        raise _engine_problem(error) from error
    finally:
        target.close()
    report.stamp(engine, layer.name, kept.entry)


def _export(engine: bpy.types.RenderEngine, module: ModuleType, depsgraph: bpy.types.Depsgraph,
            settings: dict[str, Any], wanted: list[passes.Pass]) -> export.Exported | None:
    """The exported scene, or None when the user stopped it."""
    render_settings = depsgraph.scene_eval.render
    if not engine.is_preview:
        engine.update_stats("", "Exporting the scene")
    options = export.ExportOptions(
        resolution=frame_size.resolution(render_settings), crop=frame_size.crop(render_settings), settings=settings,
        passes=tuple(one.engine for one in wanted), engine=engine, should_stop=engine.test_break)
    try:
        return export.build_scene(module, depsgraph, depsgraph.view_layer_eval, options)
    except export.ExportCancelled:
        return None
    except export.ExportError as error:
        raise RenderProblem(str(error)) from error
    except module.Error as error:
        raise _engine_problem(error) from error


def _run(engine: bpy.types.RenderEngine, module: ModuleType, exported: export.Exported, target: Target,
         entry: dict[str, Any]) -> Any:
    """The session's film, or None when it recorded none."""
    start = time.monotonic()
    try:
        with sessions.opened(module.Session(exported.scene)) as session:
            entry["complete"] = render_loop.run(engine, session, target, quiet=engine.is_preview)
            if not engine.is_preview:
                messages.warn(engine, session.warnings())
            entry["samples"] = session.progress().get("samples", 0)
            entry["engine"] = session.stats()
            film = session.film()
    except module.Error as error:
        raise _engine_problem(error) from error
    entry["render_seconds"] = time.monotonic() - start
    return film if film is not None and film.has_clusters else None


def _tell(engine: bpy.types.RenderEngine, arguments: cli_args.Arguments, entry: dict[str, Any]) -> None:
    """Statistics for the command line. A full disk costs them, never the picture."""
    if arguments.print_stats:
        print(report.table(entry), flush=True)
    if not arguments.stats:
        return
    try:
        stats_file.add(arguments.stats, entry, core.versions())
    except RenderProblem as problem:
        messages.warn(engine, [str(problem)])


def _save_scene(module: ModuleType, exported: export.Exported, path: str) -> None:
    """For the command line, bug reports and benchmarks: what the engine was told, in one file."""
    try:
        exported.scene.save(bpy.path.abspath(path))
    except module.Error as error:
        raise _engine_problem(error) from error


def _engine_problem(error: Exception) -> RenderProblem:
    return RenderProblem(messages.summary(getattr(error, "problems", None) or [str(error)]))
