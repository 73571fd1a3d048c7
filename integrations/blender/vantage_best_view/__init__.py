# SPDX-License-Identifier: MIT
"""Sets the scene's camera to the view that tells most about the selected objects, by the program `vantage`."""

import bpy

from . import camera, program, surface

bl_info = {
    "name": "Vantage: best view",
    "author": "The authors of Vantage",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Vantage",
    "description": "Camera to the best, worst or next best view of the selected objects, or round them",
    "category": "Camera",
}

AXES = [(axis, axis.upper(), "") for axis in ("x", "y", "z", "-x", "-y", "-z")]
AUTO = ("auto", "By shape", "What the shape says")
RANK = "vantage_rank"  # scene property: which of the best views the camera has
SUBJECT = "vantage_subject"  # scene property: the names of what it is a view of


class Preferences(bpy.types.AddonPreferences):
    """Where the program is."""
    bl_idname = __name__

    program: bpy.props.StringProperty(
        name="Program", default="vantage", subtype="FILE_PATH",
        description="Path of the program, or its name if it is on the PATH")
    seconds: bpy.props.IntProperty(
        name="Seconds", default=600, min=1, description="Stop the program after so long")

    def draw(self, _context):
        self.layout.prop(self, "program")
        self.layout.prop(self, "seconds")


class Frame(bpy.types.PropertyGroup):
    """How the objects stand."""
    up: bpy.props.EnumProperty(name="Up", items=[*AXES, AUTO], default="z",
                               description="World axis against gravity")
    front: bpy.props.EnumProperty(name="Front", items=[*AXES, AUTO], default="-y",
                                  description="World axis that points to a viewer in front")


class Asks:
    """What both operators do: ask the program about the selected objects and report what went wrong."""
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT" and bool(context.selected_objects)

    def asked(self, context, views):
        """The program's answer, or None after an error that the user has been shown."""
        preferences = context.preferences.addons[__name__].preferences
        frame = context.scene.vantage
        try:
            vertices, faces = surface.selected_surface(context)
            return program.answer(
                vertices, faces, up=frame.up, front=frame.front, views=views,
                size=camera.picture_size(context.scene), seconds=preferences.seconds,
                path=bpy.path.abspath(preferences.program))
        except (surface.NoSurface, program.Failed) as problem:
            self.report({"ERROR"}, str(problem))
            return None


def subject_of(context):
    return "\n".join(sorted(selected.name for selected in context.selected_objects))


class BestView(Asks, bpy.types.Operator):
    """Set the scene's camera to a view of the selected objects"""
    bl_idname = "vantage.best_view"
    bl_label = "Best view"

    which: bpy.props.EnumProperty(
        name="View", default="BEST",
        items=[("BEST", "Best", "The view that tells most"), ("WORST", "Worst", "The view that tells least"),
               ("NEXT", "Next best", "The view that shows most of what those before it do not")])

    def execute(self, context):
        scene = context.scene
        follows = self.which == "NEXT" and scene.get(SUBJECT) == subject_of(context)
        rank = scene.get(RANK, 0) + 1 if follows else 1
        result = self.asked(context, rank if self.which == "NEXT" else 0)
        if result is None:
            return {"CANCELLED"}
        view = result.view["worst" if self.which == "WORST" else "best"]
        if self.which == "NEXT":
            views = result.view["views"]
            if rank > len(views):
                self.report({"INFO"}, f"The {len(views)} views show all there is: the first again")
                rank = 1
            view = views[rank - 1]
        scene[RANK], scene[SUBJECT] = (0 if self.which == "WORST" else rank), subject_of(context)
        camera.set_view(scene, view, result.reach)
        for warning in result.view["warnings"]:
            self.report({"INFO"}, warning)
        if any(not constraint.mute for constraint in scene.camera.constraints):
            self.report({"WARNING"}, f"{scene.camera.name} has constraints, which may move it away again")
        return {"FINISHED"}


class Tour(Asks, bpy.types.Operator):
    """Let the scene's camera go round the selected objects, past the views that together show most"""
    bl_idname = "vantage.tour"
    bl_label = "Tour"

    views: bpy.props.IntProperty(name="Views", default=4, min=2, max=20)
    seconds: bpy.props.FloatProperty(name="Seconds", default=10.0, min=0.5, max=600.0)

    def execute(self, context):
        result = self.asked(context, self.views)
        if result is None:
            return {"CANCELLED"}
        if not result.tour:
            self.report({"ERROR"}, "One view shows all there is of this, so there is no round")
            return {"CANCELLED"}
        camera.set_tour(context.scene, result, self.seconds)
        return {"FINISHED"}


class Panel(bpy.types.Panel):
    """In the sidebar of the 3D view."""
    bl_label = "Vantage"
    bl_idname = "VIEW3D_PT_vantage"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Vantage"

    def draw(self, context):
        column = self.layout.column(align=True)
        for which, label in (("BEST", "Best view"), ("NEXT", "Next best view"), ("WORST", "Worst view")):
            column.operator(BestView.bl_idname, text=label).which = which
        column.operator(Tour.bl_idname)
        self.layout.prop(context.scene.vantage, "up")
        self.layout.prop(context.scene.vantage, "front")


CLASSES = (Preferences, Frame, BestView, Tour, Panel)


def register():
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.Scene.vantage = bpy.props.PointerProperty(type=Frame)


def unregister():
    del bpy.types.Scene.vantage
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
