# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators on films: filter again, save, open, free."""

from __future__ import annotations

import os

import bpy
from bpy.props import BoolProperty, StringProperty
from bpy_extras.io_utils import ExportHelper, ImportHelper

from .. import core, film_files, film_images, films, frame_size, retune
from .common import k_engine


def shown_film(context: bpy.types.Context) -> films.Kept | None:
    """The film behind the picture in this Image Editor, or else that of the active view layer or any other."""
    image = getattr(context.space_data, "image", None)
    opened = films.of_image(image.name) if image is not None else None
    if opened is not None:
        return opened
    kept = films.of_scene(context.scene.name)
    mine = [one for (layer, _), one in kept.items() if layer == context.view_layer.name]
    return (mine or list(kept.values()) or [None])[0]


class CARDIOID_OT_filter_again(bpy.types.Operator):
    """Filter the kept film by the settings of now and put the result where the compositor and Save As find it.
    Nothing is rendered again"""

    bl_idname = "cardioid.filter_again"
    bl_label = "Filter Again"

    write_still: BoolProperty(name="Write Still", default=False, options={"SKIP_SAVE"},
                              description="Save the picture as a render would; in the background alone")

    @classmethod
    def poll(cls, context):
        return context.scene.render.engine == k_engine and shown_film(context) is not None

    def execute(self, context):
        kept = shown_film(context)
        if kept.image:
            film_images.follow(context.scene)
            return {"FINISHED"}
        problem = retune.start(context.scene, write_still=self.write_still)
        if problem:
            self.report({"ERROR"}, f"Cardioid: {problem}")
            return {"CANCELLED"}
        return {"FINISHED"}


class CARDIOID_OT_save_film(bpy.types.Operator, ExportHelper):
    """Save the film in a file, to filter it again another day"""

    bl_idname = "cardioid.save_film"
    bl_label = "Save Film"

    filename_ext = film_files.k_extension
    filter_glob: StringProperty(default=f"*{film_files.k_extension}", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return shown_film(context) is not None

    def invoke(self, context, event):
        if not self.filepath:
            self.filepath = film_files.path_of(context.scene, context.view_layer.name, "", animation=True)
        return super().invoke(context, event)

    def execute(self, context):
        path = bpy.path.abspath(self.filepath)
        try:
            film_files.save(shown_film(context).film, path)
        except (core.load().Error, OSError) as error:
            self.report({"ERROR"}, f"Cardioid: the film could not be saved: {error}")
            return {"CANCELLED"}
        self.report({"INFO"}, f"Saved {os.path.basename(path)}")
        return {"FINISHED"}


class CARDIOID_OT_open_film(bpy.types.Operator, ImportHelper):
    """Open a saved film and filter it: as the render result where it has the size of the scene's frame, else as an
    image"""

    bl_idname = "cardioid.open_film"
    bl_label = "Open Film"

    filename_ext = film_files.k_extension
    filter_glob: StringProperty(default=f"*{film_files.k_extension}", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return context.scene.render.engine == k_engine and core.load() is not None

    def execute(self, context):
        module = core.load()
        path = bpy.path.abspath(self.filepath)
        try:
            film = module.Film.load(path)
        except (module.Error, OSError) as error:
            self.report({"ERROR"}, f"Cardioid: {error}")
            return {"CANCELLED"}
        if not film.has_clusters:
            self.report({"ERROR"}, f"Cardioid: {os.path.basename(path)} was saved without what the filter needs")
            return {"CANCELLED"}
        kept = films.Kept(film, frame_size.shape(context.scene.render), {}, source=os.path.basename(path))
        if self._fits(context.scene, kept):
            return self._into_result(context, kept)
        image = film_images.show(context.scene, kept, os.path.splitext(kept.source)[0])
        if context.area is not None and context.area.type == "IMAGE_EDITOR":
            context.space_data.image = image
        self.report({"INFO"}, f"{kept.source} is shown as the image {image.name}: its size is not that of the frame")
        return {"FINISHED"}

    @staticmethod
    def _fits(scene: bpy.types.Scene, kept: films.Kept) -> bool:
        """One layer and view of the film's size, and no render that needs the place."""
        area = kept.shape.area
        size = area[2:] if area[2] else kept.shape.size
        layers = sum(1 for one in scene.view_layers if one.use)
        return layers == 1 and not scene.render.use_multiview and size == (kept.film.width, kept.film.height)

    def _into_result(self, context, kept: films.Kept):
        scene = context.scene
        layer = next(one.name for one in scene.view_layers if one.use)
        films.drop(scene.name)
        films.keep(scene.name, layer, "", kept)
        problem = retune.start(scene)
        if problem:
            self.report({"ERROR"}, f"Cardioid: {problem}")
            return {"CANCELLED"}
        return {"FINISHED"}


class CARDIOID_OT_free_film(bpy.types.Operator):
    """Give the film's memory back. The picture stays, and its filter can be tuned no more"""

    bl_idname = "cardioid.free_film"
    bl_label = "Free Film"

    @classmethod
    def poll(cls, context):
        return shown_film(context) is not None

    def execute(self, context):
        kept = shown_film(context)
        if kept.image:
            films.drop_image(kept.image)
        else:
            films.drop(context.scene.name)
        return {"FINISHED"}


k_classes = (CARDIOID_OT_filter_again, CARDIOID_OT_save_film, CARDIOID_OT_open_film, CARDIOID_OT_free_film)
