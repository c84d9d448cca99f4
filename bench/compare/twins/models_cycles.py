"""Renders a model file with Cycles, in Blender, for models.py:
blender -b --factory-startup --python models_cycles.py -- JOB.json

Lights and cameras of the file are left out; an even white sky lights it.
"""
import json
import math
import pathlib
import sys

import bpy
import numpy
from io_scene_fbx import parse_fbx
from mathutils import Matrix, Vector

# Blender 3.4's importer of glTF uses names that newer versions of numpy do not have.
for name, kind in (("bool", bool), ("int", int), ("float", float)):
    if name not in numpy.__dict__:
        setattr(numpy, name, kind)

CENTIMETRES = 0.01  # the unit of FBX, which a factor in the file multiplies


def unit_of_fbx(path):
    """In metres, which Blender's coordinates are."""
    def find(element, name):
        return next((inner for inner in element.elems if inner and inner.id == name), None)

    root, _ = parse_fbx.parse(str(path), use_namedtuple=True)
    settings = find(root, b"GlobalSettings")
    properties = settings and find(settings, b"Properties70")
    factors = [inner.props[-1] for inner in (properties.elems if properties else [])
               if inner.props[0] == b"UnitScaleFactor"]
    return CENTIMETRES * (factors[0] if factors else 1.0)


def read(path):
    """Reads the model; returns what turns clshear's coordinates, the file's, into Blender's."""
    turned = Matrix.Rotation(math.radians(90), 4, "X")  # +Y up becomes +Z up
    kind = path.suffix.lower()
    if kind in (".gltf", ".glb"):
        bpy.ops.import_scene.gltf(filepath=str(path))
        return turned
    if kind == ".obj":
        bpy.ops.wm.obj_import(filepath=str(path))
        return turned
    if kind == ".fbx":
        bpy.ops.import_scene.fbx(filepath=str(path))
        return Matrix.Scale(unit_of_fbx(path), 4) @ turned
    if kind == ".dae":
        bpy.ops.wm.collada_import(filepath=str(path))
        return turned  # clshear turns +Z up, as Blender turns +Y up; both count in metres
    if kind == ".ply":
        bpy.ops.import_mesh.ply(filepath=str(path))
        return Matrix.Identity(4)
    if kind == ".stl":
        bpy.ops.import_mesh.stl(filepath=str(path))
        return Matrix.Identity(4)
    sys.exit(f"{path}: Blender has no importer for this kind")


def plain_material(grey, colours):
    """Lambert's, grey, or with the colours of vertices that are called so."""
    plain = bpy.data.materials.new("plain")
    plain.use_nodes = True
    nodes, links = plain.node_tree.nodes, plain.node_tree.links
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (grey, grey, grey, 1)
    links.new(diffuse.outputs[0], output.inputs[0])
    if colours:
        of_vertices = nodes.new("ShaderNodeVertexColor")
        of_vertices.layer_name = colours
        links.new(of_vertices.outputs["Color"], diffuse.inputs["Color"])
    return plain


def dress(kind):
    """Gives surfaces what clshear takes where a file says nothing, or Blender does not listen."""
    grey = 1.0 if kind in (".gltf", ".glb") else 0.5
    for thing in bpy.context.scene.objects:
        if thing.type == "MESH" and not any(slot.material for slot in thing.material_slots):
            mesh = thing.data
            colours = mesh.color_attributes[0].name if len(mesh.color_attributes) else ""
            mesh.materials.clear()
            mesh.materials.append(plain_material(grey, colours))
    for material in bpy.data.materials:
        surface = material.use_nodes and material.node_tree.nodes.get("Principled BSDF")
        if kind == ".fbx" and surface and surface.inputs["Alpha"].default_value == 0:
            surface.inputs["Alpha"].default_value = 1  # which Blender makes of no opacity


def add_camera(given, turn):
    eye, target = (turn @ Vector(given[name]) for name in ("eye", "target"))
    back = (eye - target).normalized()
    right = (turn.to_3x3() @ Vector(given["up"])).cross(back).normalized()
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "HORIZONTAL"
    camera.angle = math.radians(given["fov"])
    # The target of a file's camera may be a step away, so that its distance is no size of the scene.
    camera.clip_start, camera.clip_end = 1e-3 * (eye - target).length, 1e9 * (eye - target).length
    thing = bpy.data.objects.new("camera", camera)
    frame = Matrix((right, back.cross(right), back)).transposed().to_4x4()
    frame.translation = eye
    thing.matrix_world = frame
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def set_up(given):
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("white")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x = render.resolution_y = given["size"]
    render.resolution_percentage = 100
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth = "32"
    render.image_settings.color_mode = "RGB"
    render.filepath = given["picture"]
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = given["spp"], False, False
    cycles.pixel_filter_type = "BOX"
    cycles.max_bounces, cycles.transparent_max_bounces = 8, 64
    cycles.sample_clamp_indirect = 0.0


def main():
    given = json.loads(pathlib.Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    turn = read(pathlib.Path(given["model"]))
    if not any(thing.type == "MESH" for thing in bpy.context.scene.objects):
        sys.exit(f"{given['model']}: Blender finds no mesh in it")
    for thing in list(bpy.context.scene.objects):
        if thing.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(thing)
    dress(pathlib.Path(given["model"]).suffix.lower())
    set_up(given)
    add_camera(given["camera"], turn)
    bpy.context.scene.frame_set(1)
    bpy.ops.render.render(write_still=True)


main()
