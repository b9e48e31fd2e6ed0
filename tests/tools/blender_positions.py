# Writes the vertex positions that Blender sees: blender -b --factory-startup -P blender_positions.py -- JOB.json
# SPDX-License-Identifier: MIT
#
# JOB.json: {"scene": FILE.glb, "clip": NAME or ""} or {"mesh": FILE.obj, "cache": FILE.pc2 | FILE.mdd};
#           "fps": rate, "times": [seconds, ...] (glTF) or "frames": [number, ...] (cache); "out": FILE
# out: for each time the positions of all vertices of all meshes, x y z float32, in the axes of the input file.
import json
import sys

import numpy as np

np.bool = bool  # Blender 3.4's glTF importer still says np.bool

import bpy  # noqa: E402


def load_scene(job):
    bpy.context.scene.render.fps = job["fps"]
    bpy.ops.import_scene.gltf(filepath=job["scene"])
    for owner in list(bpy.data.objects) + list(bpy.data.shape_keys):
        animation = owner.animation_data
        if not animation or not job["clip"]:
            continue
        animation.action = None
        for track in animation.nla_tracks:
            track.mute = True
            if track.name == job["clip"]:
                animation.action = track.strips[0].action


def load_cache(job):
    bpy.ops.wm.obj_import(filepath=job["mesh"], forward_axis="Y", up_axis="Z")
    body = bpy.context.selected_objects[0]
    cache = body.modifiers.new("cache", "MESH_CACHE")
    cache.cache_format = job["cache"][-3:].upper()
    cache.filepath = job["cache"]
    cache.forward_axis, cache.up_axis = "POS_Y", "POS_Z"
    cache.interpolation = "NONE"
    cache.frame_start = 0.0


def positions(frame, turned):
    bpy.context.scene.frame_set(int(frame // 1), subframe=float(frame % 1))
    graph = bpy.context.evaluated_depsgraph_get()
    parts = []
    for body in bpy.context.scene.objects:
        if body.type != "MESH" or body.name.startswith("Icosphere"):  # the importer's bone shape
            continue
        seen = body.evaluated_get(graph)
        mesh = seen.to_mesh()
        local = np.empty(len(mesh.vertices) * 3, np.float32)
        mesh.vertices.foreach_get("co", local)
        world = np.array(seen.matrix_world, np.float64)
        parts.append(local.reshape(-1, 3).astype(np.float64) @ world[:3, :3].T + world[:3, 3])
        seen.to_mesh_clear()
    xyz = np.concatenate(parts)
    if turned:  # Blender's z is up, glTF's y
        xyz = np.stack([xyz[:, 0], xyz[:, 2], -xyz[:, 1]], axis=1)
    return xyz.astype(np.float32)


def main():
    with open(sys.argv[sys.argv.index("--") + 1]) as file:
        job = json.load(file)
    for leftover in list(bpy.data.objects):
        bpy.data.objects.remove(leftover)
    scene = "scene" in job
    if scene:
        load_scene(job)
    else:
        load_cache(job)
    frames = [time * job["fps"] for time in job["times"]] if scene else job["frames"]
    np.concatenate([positions(frame, scene) for frame in frames]).tofile(job["out"])


main()
