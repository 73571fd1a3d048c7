# SPDX-License-Identifier: MIT
"""The surface of the selected objects, as they are evaluated, in world space."""

import numpy as np

SURFACES = {"MESH", "CURVE", "SURFACE", "META", "FONT"}


class NoSurface(Exception):
    """Nothing selected has faces."""


def selected_surface(context):
    """(n, 3) float64 and (m, 3) int32 of all selected objects together, modifiers and instances included."""
    graph = context.evaluated_depsgraph_get()
    wanted = {selected.name_full for selected in context.selected_objects}
    vertices, faces, count = [], [], 0
    for instance in graph.object_instances:
        # What an object instances (collections, particles, geometry nodes) belongs to that object.
        owner = instance.parent if instance.is_instance else instance.object
        if owner is None or owner.original.name_full not in wanted or instance.object.type not in SURFACES:
            continue
        mesh = instance.object.to_mesh()
        if mesh is None:
            continue
        corners = world_vertices(mesh, instance.matrix_world)
        triangles = triangles_of(mesh)
        instance.object.to_mesh_clear()
        if len(triangles):
            vertices.append(corners)
            faces.append(triangles + count)
            count += len(corners)
    if not faces:
        raise NoSurface("Select an object that has faces")
    return np.concatenate(vertices), np.concatenate(faces)


def world_vertices(mesh, matrix):
    local = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", local)
    turn = np.array(matrix, np.float64)
    return local.reshape(-1, 3).astype(np.float64) @ turn[:3, :3].T + turn[:3, 3]


def triangles_of(mesh):
    mesh.calc_loop_triangles()
    triangles = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    return triangles.reshape(-1, 3)
