"""Makes a scene in Mitsuba that is the twin of one of clshear's: imported.py's triangles and
materials, and the camera, lens and lights of a .flags file.

Lambert's surfaces are diffuse BSDFs, those of glTF are principled ones, with the same facets and
other diffuse parts at grazing angles. The pixel filter is a box, the aperture a disk.
"""
import mitsuba as mi
import numpy as np

import imported
from lights import panel, point, sun

UNDERSTOOD = {"eye", "target", "up", "fov", "focal-distance", "lens-radius", "light", "sun", "quad",
              "environment", "environment-strength", "bounces", "z-up"}
SKY_ROWS = 512


def bitmap(texels):
    """A texture of linear texels, (rows, columns, channels), row 0 at coordinate 0."""
    return {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(texels, dtype=np.float32)),
            "raw": True, "filter_type": "bilinear", "wrap_mode": "repeat"}


def colour(given, pictures):
    diffuse = given["diffuse"].astype(float)
    if given["texture"] < 0:
        return {"type": "rgb", "value": diffuse.tolist()}
    texels, wrap = pictures[given["texture"]]
    return {**bitmap(texels[:, :, :3] * diffuse),
            "wrap_mode": {"REPEAT": "repeat", "EXTEND": "clamp"}[wrap]}


def surface(given, pictures):
    if given["bsdf"] == imported.LAMBERT:
        shown = {"type": "diffuse", "reflectance": colour(given, pictures)}
    else:
        shown = {"type": "principled", "base_color": colour(given, pictures),
                 "roughness": float(given["roughness"]), "metallic": float(given["metallic"]),
                 "specular": min(float(given["f0"]) / 0.08, 1.0)}
    shown = {"type": "twosided", "nested": shown}
    if not given["flags"] & imported.BLEND:
        return shown
    alpha = float(given["alpha"])
    if given["texture"] >= 0:
        opacity = bitmap(pictures[given["texture"]][0][:, :, 3:] * alpha)
    else:
        opacity = alpha
    return {"type": "mask", "opacity": opacity, "nested": shown}


def make_mesh(name, scene, triangles, smooth, bsdf):
    """A mesh of some of the scene's triangles, flat ones or smooth ones."""
    used, corners = np.unique(scene.triangles[triangles], return_inverse=True)
    properties = mi.Properties()
    properties["bsdf"] = bsdf
    mesh = mi.Mesh(name, len(used), int(np.count_nonzero(triangles)), has_vertex_normals=smooth,
                   has_vertex_texcoords=True, props=properties)
    parameters = mi.traverse(mesh)
    arrays = {"vertex_positions": scene.positions[used], "faces": corners.astype(np.uint32),
              "vertex_texcoords": scene.coordinates[used]}
    if smooth:
        arrays["vertex_normals"] = scene.normals[used]
    for key, values in arrays.items():
        parameters[key] = type(parameters[key])(values.reshape(-1))
    parameters.update()
    return mesh


def meshes(scene):
    """A mesh for each material, and another for its smooth triangles."""
    for number, given in enumerate(scene.materials):
        bsdf = mi.load_dict(surface(given, scene.images))
        smooth = (scene.flags & imported.SMOOTH) != 0
        for which in (False, True):
            triangles = (scene.material_of == number) & (smooth == which)
            if triangles.any():
                name = f"mesh{number}{'smooth' if which else 'flat'}"
                yield name, make_mesh(name, scene, triangles, which, bsdf)


def gradient(words, strength, z_up):
    """clshear's gradient from the zenith to the horizon, which is what it has below, too."""
    numbers = np.array([float(word) for word in words.split(":")[1].split(",")])
    zenith, horizon = numbers[:3], numbers[3:]
    height = np.cos(np.pi * np.arange(SKY_ROWS) / (SKY_ROWS - 1))
    part = np.maximum(height, 0.0)[:, None, None]
    sky = {"type": "envmap", "scale": strength, "bitmap": mi.Bitmap(np.ascontiguousarray(
        np.repeat(horizon + (zenith - horizon) * part, 2, axis=1), dtype=np.float32))}
    if z_up:
        sky["to_world"] = mi.ScalarTransform4f().rotate([1, 0, 0], 90)
    return sky


def lights(flags):
    for numbers in flags.get("light", []):
        yield point(numbers[:3], numbers[3:])[1]
    for numbers in flags.get("sun", []):
        yield sun(numbers[:3], numbers[3:6], numbers[6])[1]
    for numbers in flags.get("quad", []):
        yield panel(numbers[:3], numbers[3:6], numbers[6:9], numbers[9:])[1]
    for words in flags.get("environment", []):
        yield gradient(words, flags.get("environment-strength", [[1.0]])[0][0], "z-up" in flags)


def make_sensor(flags, width, height, sampler):
    """The field of view is that of the picture's lower side."""
    frame = mi.ScalarTransform4f().look_at(flags["eye"][0], flags["target"][0],
                                           flags.get("up", [[0, 1, 0]])[0])
    return mi.load_dict({
        "type": "thinlens", "to_world": frame, "fov": flags["fov"][0][0], "fov_axis": "smaller",
        "aperture_radius": flags["lens-radius"][0][0],
        "focus_distance": flags["focal-distance"][0][0], "near_clip": 1e-4, "far_clip": 1e7,
        "sampler": {"type": sampler},
        "film": {"type": "hdrfilm", "width": width, "height": height, "pixel_format": "rgb",
                 "component_format": "float32", "rfilter": {"type": "box"}}})


def build(importer, model, flags):
    """The scene, and the integrator for its bounces."""
    strange = set(flags) - UNDERSTOOD
    if strange:
        raise SystemExit(f"{model}: no twin for --{sorted(strange)[0]}; take another scene")
    content = {"type": "scene", **dict(meshes(imported.Imported(importer, model)))}
    for number, light in enumerate(lights(flags)):
        content[f"light{number}"] = light
    bounces = int(flags.get("bounces", [[4.0]])[0][0])
    return mi.load_dict(content), mi.load_dict({"type": "path", "max_depth": bounces + 2})

