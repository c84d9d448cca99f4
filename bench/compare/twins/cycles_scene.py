"""Makes a scene in Blender that is the twin of one of clshear's: imported.py's triangles and
materials, and the camera, lens and lights of a .flags file. Everything stays in clshear's
coordinates and units.

Lambert's surfaces are Diffuse BSDFs, those of glTF Principled BSDFs, as Blender's own importers
make them. Their highlights are the same facets; their diffuse parts differ at grazing angles.
"""
import math

import bpy
import numpy as np
from mathutils import Matrix, Vector

import imported

UNDERSTOOD = {"eye", "target", "up", "fov", "focal-distance", "lens-radius", "light", "sun", "quad",
              "bounces", "filter"}


def fill(collection, attribute, values):
    collection.foreach_set(attribute, np.ascontiguousarray(values).reshape(-1))


def make_mesh(scene):
    """One mesh. Blender has a normal for each vertex of a smooth face, so that vertices that flat
    faces share with smooth ones are doubled."""
    count = len(scene.positions)
    smooth = (scene.flags & imported.SMOOTH) != 0
    corners = scene.triangles + np.where(smooth, 0, count)[:, None].astype(np.int32)
    used, corners = np.unique(corners, return_inverse=True)
    source = used % count
    mesh = bpy.data.meshes.new("scene")
    mesh.vertices.add(len(used))
    fill(mesh.vertices, "co", scene.positions[source])
    mesh.loops.add(corners.size)
    fill(mesh.loops, "vertex_index", corners.astype(np.int32))
    mesh.polygons.add(len(scene.triangles))
    fill(mesh.polygons, "loop_start", np.arange(0, corners.size, 3, dtype=np.int32))
    fill(mesh.polygons, "loop_total", np.full(len(scene.triangles), 3, dtype=np.int32))
    fill(mesh.polygons, "material_index", scene.material_of)
    fill(mesh.polygons, "use_smooth", smooth)
    layer = mesh.uv_layers.new(name="coordinates")
    fill(layer.data, "uv", scene.coordinates[source[corners.reshape(-1)]])
    mesh.update(calc_edges=True)
    if smooth.any():
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.pi
        mesh.normals_split_custom_set_from_vertices(scene.normals[source].tolist())
    return mesh


def make_image(number, texels):
    """Linear texels, as they are."""
    image = bpy.data.images.new(f"image{number}", texels.shape[1], texels.shape[0], alpha=True,
                                float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.alpha_mode = "CHANNEL_PACKED"
    image.pixels.foreach_set(np.ascontiguousarray(texels).reshape(-1))
    image.pack()
    return image


def base_colour(tree, given, pictures):
    """A socket with the albedo: the material's colour times its texture. None: the colour alone."""
    if given["texture"] < 0:
        return None
    image, wrap = pictures[given["texture"]]
    node, tint = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeMixRGB")
    node.image, node.extension, node.interpolation = image, wrap, "Linear"
    tint.blend_type = "MULTIPLY"
    tint.inputs["Fac"].default_value = 1.0
    tint.inputs["Color2"].default_value = (*map(float, given["diffuse"]), 1.0)
    tree.links.new(node.outputs["Color"], tint.inputs["Color1"])
    return tint.outputs["Color"]


def surface(tree, given):
    """The node of the BSDF and the name of its colour."""
    if given["bsdf"] == imported.LAMBERT:
        return tree.nodes.new("ShaderNodeBsdfDiffuse"), "Color"
    node = tree.nodes.new("ShaderNodeBsdfPrincipled")
    node.distribution = "GGX"
    node.inputs["Roughness"].default_value = float(given["roughness"])
    node.inputs["Metallic"].default_value = float(given["metallic"])
    node.inputs["Specular"].default_value = float(given["f0"]) / 0.08
    return node, "Base Color"


def make_material(number, given, pictures):
    material = bpy.data.materials.new(f"material{number}")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node, name = surface(tree, given)
    node.inputs[name].default_value = (*map(float, given["diffuse"]), 1.0)
    colour = base_colour(tree, given, pictures)
    if colour is not None:
        tree.links.new(colour, node.inputs[name])
    shown = node.outputs["BSDF"]
    if given["flags"] & imported.BLEND and given["alpha"] < 1:
        mix, clear = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeBsdfTransparent")
        mix.inputs["Fac"].default_value = float(given["alpha"])
        tree.links.new(clear.outputs["BSDF"], mix.inputs[1])
        tree.links.new(shown, mix.inputs[2])
        shown = mix.outputs["Shader"]
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shown, output.inputs["Surface"])
    return material


def place(name, data, frame):
    thing = bpy.data.objects.new(name, data)
    thing.matrix_world = frame
    bpy.context.collection.objects.link(thing)
    return thing


def frame_of(right, up, back, origin):
    frame = Matrix((right, up, back)).transposed().to_4x4()
    frame.translation = origin
    return frame


def new_light(kind, colour, watts):
    """A light of a colour, whose largest component is `watts`."""
    light = bpy.data.lights.new(kind, kind)
    light.energy = watts
    light.color = [value / max(colour) for value in colour]
    return light


def add_point(numbers):
    """Position, and intensity in W/sr."""
    light = new_light("POINT", numbers[3:], 4.0 * math.pi * max(numbers[3:]))
    light.shadow_soft_size = 0.0
    place("point", light, Matrix.Translation(numbers[:3]))


def add_sun(numbers):
    """The direction towards it, irradiance in W/m^2, diameter in degrees."""
    light = new_light("SUN", numbers[3:6], max(numbers[3:6]))
    light.angle = math.radians(numbers[6])
    place("sun", light, Vector(numbers[:3]).to_track_quat("Z", "Y").to_matrix().to_4x4())


def add_quad(numbers):
    """A corner, the edges from it, radiance. Blender takes a fourth of the power over the area."""
    corner, across, along = (Vector(numbers[i:i + 3]) for i in (0, 3, 6))
    area = across.cross(along)
    light = new_light("AREA", numbers[9:], 4.0 * area.length * max(numbers[9:]))
    light.shape = "RECTANGLE"
    light.size, light.size_y = across.length, along.length
    right, back = across.normalized(), -area.normalized()
    place("quad", light, frame_of(right, back.cross(right), back, corner + (across + along) / 2))


def add_camera(flags):
    """A thin lens; the field of view is that of the picture's lower side."""
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit, camera.sensor_height = "VERTICAL", 24.0
    camera.lens = 12.0 / math.tan(math.radians(flags["fov"][0][0]) / 2.0)
    camera.clip_start, camera.clip_end = 1e-3, 1e5
    camera.dof.use_dof = True
    camera.dof.focus_distance = flags["focal-distance"][0][0]
    camera.dof.aperture_fstop = 1e-3 * camera.lens / (2.0 * flags["lens-radius"][0][0])
    eye, up = Vector(flags["eye"][0]), Vector(flags["up"][0])
    back = (eye - Vector(flags["target"][0])).normalized()
    right = up.cross(back).normalized()
    bpy.context.scene.camera = place("camera", camera,
                                     frame_of(right, back.cross(right), back, eye))


def build(importer, model, flags):
    """The whole scene in an empty file."""
    strange = set(flags) - UNDERSTOOD
    if strange:
        raise SystemExit(f"{model}: no twin for --{sorted(strange)[0]}; take another scene")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = imported.Imported(importer, model)
    pictures = [(make_image(i, texels), wrap) for i, (texels, wrap) in enumerate(scene.images)]
    mesh = make_mesh(scene)
    for number, given in enumerate(scene.materials):
        mesh.materials.append(make_material(number, given, pictures))
    place("scene", mesh, Matrix.Identity(4))
    for name, add in (("light", add_point), ("sun", add_sun), ("quad", add_quad)):
        for numbers in flags.get(name, []):
            add(numbers)
    add_camera(flags)
