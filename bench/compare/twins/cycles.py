"""Renders a scene with Cycles, in Blender: blender -b --factory-startup --python cycles.py -- SCENE.json

The scene is moving.py's: everything is in its coordinates, and all moves linearly while the shutter
is open, from frame 1 to frame 2. Writes a picture for each seed, PICTURE-SEED.exr.
"""
import json
import math
import pathlib
import sys

import bpy
from mathutils import Matrix, Vector

OPEN, CLOSED = 1, 2  # frames


def linear(owner):
    """Everything that is keyed goes straight from key to key."""
    for curve in owner.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def move(thing, closed):
    thing.keyframe_insert("location", frame=OPEN)
    thing.location = closed
    thing.keyframe_insert("location", frame=CLOSED)
    linear(thing)


def deform(thing, positions):
    thing.shape_key_add(name="open")
    key = thing.shape_key_add(name="closed")
    for place, position in zip(key.data, positions):
        place.co = position
    for frame, value in ((OPEN, 0.0), (CLOSED, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    linear(thing.data.shape_keys)


def lambert(name, colour):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    bsdf, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    bsdf.inputs["Color"].default_value = (*colour, 1.0)
    material.node_tree.links.new(bsdf.outputs["BSDF"], output.inputs["Surface"])
    return material


def add_part(number, part):
    """Its `move` is a translation of the node, its `positions_to` are those of a shape."""
    mesh = bpy.data.meshes.new(f"part{number}")
    mesh.from_pydata(part["positions"], [], part["triangles"])
    mesh.materials.append(lambert(f"part{number}", part["colour"]))
    thing = bpy.data.objects.new(f"part{number}", mesh)
    bpy.context.collection.objects.link(thing)
    if "move" in part:
        move(thing, part["move"])
    if "positions_to" in part:
        deform(thing, part["positions_to"])


def add_light(position, intensity):
    """A point light of an intensity in W/sr, the same in all directions."""
    light = bpy.data.lights.new("light", "POINT")
    light.energy = 4.0 * math.pi * max(intensity)
    light.color = [value / max(intensity) for value in intensity]
    light.shadow_soft_size = 0.0
    thing = bpy.data.objects.new("light", light)
    thing.location = position
    bpy.context.collection.objects.link(thing)


def add_camera(given):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(given["fov"])
    camera.clip_start, camera.clip_end = 1e-2, 1e5
    if given["lens"] > 0:
        camera.dof.use_dof = True
        camera.dof.focus_distance = given["focus"]
        camera.dof.aperture_fstop = 1e-3 * camera.lens / (2.0 * given["lens"])
        camera.dof.aperture_blades = 0
    thing = bpy.data.objects.new("camera", camera)
    back = (Vector(given["eye"]) - Vector(given["target"])).normalized()
    right = Vector((0, 1, 0)).cross(back).normalized()
    frame = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    frame.translation = given["eye"]
    thing.matrix_world = frame
    bpy.context.collection.objects.link(thing)
    move(thing, Vector(given["eye"]) + Vector(given["move"]))
    bpy.context.scene.camera = thing


def set_up(given):
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = OPEN, CLOSED
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x = render.resolution_y = given["size"]
    render.resolution_percentage = 100
    render.use_motion_blur, render.motion_blur_shutter = True, 1.0
    cycles.motion_blur_position = "START"
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.color_mode = "RGB"
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = given["spp"], False, False
    cycles.pixel_filter_type = "BOX"
    cycles.max_bounces = cycles.diffuse_bounces = 0
    cycles.sample_clamp_direct, cycles.light_sampling_threshold = 0.0, 0.0


def main():
    path = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
    given = json.loads(path.read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    set_up(given)
    for number, part in enumerate(given["parts"]):
        add_part(number, part)
    add_light(given["light"]["position"], given["light"]["intensity"])
    add_camera(given["camera"])
    scene = bpy.context.scene
    scene.frame_set(OPEN)
    for seed in range(given["seeds"]):
        scene.cycles.seed = 1 + seed
        scene.render.filepath = f"{given['picture']}-{seed}.exr"
        bpy.ops.render.render(write_still=True)


main()
