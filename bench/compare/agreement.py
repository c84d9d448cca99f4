"""Compares pictures of clshear with those of Mitsuba 3, scene by scene.

Each scene is written as glTF for clshear and described to Mitsuba: the same triangles, camera, lens,
lights, and surfaces of the same formulas. What Mitsuba's microfacets lack (light that meets several
facets, shadowing and masking of one height) is compiled out of clshear's kernels by a macro, which
PoCL takes from the environment. scripts/agreement installs what this needs and runs it.

Criterion: z of each pixel and colour by the errors that both renderers' 16 independent renders have.
If the pictures agree, z is Student-like with 15 to 30 degrees of freedom, mean |z| about 0.82.
"""
import argparse
import base64
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

# A file beside this one is called like the package, which must not find it first.
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:] = [folder for folder in sys.path if pathlib.Path(folder).resolve() != HERE]

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)

ROOT = HERE.parent.parent
REPLICATES = 16
EYE, TARGET, FOV, LENS, FOCUS = [0.0, 3.0, 5.0], [0.0, 0.6, 0.0], 40.0, 0.05, 5.2
MOST_Z = 0.9  # mean |z|: 0.82 has a deviation of 0.62 / sqrt(pixels), a seventh of the distance

# --- Geometry: positions, triangles, texture coordinates ---


def quad(corners):
    """A quad, seen from the side from which its corners run against the clock."""
    return (np.array(corners, np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.uint32),
            np.array([[0, 1], [1, 1], [1, 0], [0, 0]], np.float32))


def ground(size=6.0):
    return quad([[-size, 0, size], [size, 0, size], [size, 0, -size], [-size, 0, -size]])


def card(height=1.2, size=1.2):
    return quad([[-size, height, size], [size, height, size], [size, height, -size],
                 [-size, height, -size]])


def lamp():
    return quad([[-1, 3.5, -1], [1, 3.5, -1], [1, 3.5, 1], [-1, 3.5, 1]])


def ball(radius=0.9, height=1.0):
    """An icosahedron, each face cut into 16: flat facets."""
    golden = (1 + math.sqrt(5)) / 2
    points = [np.array(p, float) for p in
              [(-1, golden, 0), (1, golden, 0), (-1, -golden, 0), (1, -golden, 0),
               (0, -1, golden), (0, 1, golden), (0, -1, -golden), (0, 1, -golden),
               (golden, 0, -1), (golden, 0, 1), (-golden, 0, -1), (-golden, 0, 1)]]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(2):
        middles, finer = {}, []

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append((points[a] + points[b]) / 2)
            return middles[key]

        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            finer += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = finer
    placed = np.array([radius * p / np.linalg.norm(p) + [0, height, 0] for p in points])
    return (placed.astype(np.float32), np.array(faces, np.uint32),
            np.zeros((len(points), 2), np.float32))


# --- Surfaces: glTF's material and Mitsuba's BSDF ---


def rgb(colour):
    return {"type": "rgb", "value": list(colour)}


def two_sided(bsdf):
    return {"type": "twosided", "nested": bsdf}


def surface(colour, metallic=0.0, roughness=1.0, **extensions):
    return {"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1.0], "metallicFactor": metallic,
                                     "roughnessFactor": roughness},
            "extensions": {"KHR_materials_" + name: value for name, value in extensions.items()}}


def diffuse(*colour):
    return (surface(colour, specular={"specularFactor": 0.0}),
            two_sided({"type": "diffuse", "reflectance": rgb(colour)}))


def white_metal(roughness):
    return (surface((1, 1, 1), 1.0, roughness),
            two_sided({"type": "roughconductor", "distribution": "ggx", "material": "none",
                       "alpha": roughness ** 2}))


def tinted_metal(roughness, *colour):
    return (surface(colour, 1.0, roughness),
            two_sided({"type": "principled", "base_color": rgb(colour), "metallic": 1.0,
                       "roughness": roughness}))


def glass(roughness, index=1.5):
    twin = {"type": "dielectric", "int_ior": index, "ext_ior": 1.0}
    if roughness > 0.0:
        twin.update({"type": "roughdielectric", "distribution": "ggx", "alpha": roughness ** 2})
    return (surface((1, 1, 1), 0.0, roughness, ior={"ior": index},
                    transmission={"transmissionFactor": 1.0}, volume={"thicknessFactor": 1.0}),
            twin)


def foil(*colour):
    """A coloured wall without reflection."""
    return (surface(colour, 0.0, 0.0, specular={"specularFactor": 0.0},
                    transmission={"transmissionFactor": 1.0}),
            {"type": "thindielectric", "int_ior": 1.0, "ext_ior": 1.0,
             "specular_transmittance": rgb(colour)})


def shining(*radiance):
    """Its BSDF is black; Mitsuba's emitter is added where the triangles are."""
    material, twin = diffuse(0, 0, 0)
    material["emissiveFactor"] = [value / max(radiance) for value in radiance]
    material["extensions"]["KHR_materials_emissive_strength"] = {
        "emissiveStrength": max(radiance)}
    return material, twin, {"type": "area", "radiance": rgb(radiance)}


def checks():
    """8 x 8 texels of random colours that are all 0 or 255, which no curve changes; half of them
    are open."""
    texels = np.random.default_rng(5).integers(0, 2, (8, 8, 4)) * 255
    return texels.astype(np.uint8)


def textured(transform=None, cut=False):
    """Mitsuba's images have row 0 at coordinate 0 of v, which grows upwards: glTF's grows down."""
    scale, offset = transform or ([1, 1], [0, 0])
    texels = checks()
    material, _ = diffuse(1, 1, 1)
    material["texels"] = texels
    material["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0, "extensions": {
        "KHR_texture_transform": {"scale": scale, "offset": offset}}}
    values = texels.astype(np.float32) / 255.0

    def bitmap(data):
        frame = mi.ScalarTransform4f().translate([*offset, 0]).scale([*scale, 1])
        return {"type": "bitmap", "bitmap": mi.Bitmap(np.ascontiguousarray(data)), "raw": True,
                "filter_type": "bilinear", "wrap_mode": "repeat", "to_uv": frame}

    if not cut:
        material["alphaMode"] = "OPAQUE"
        return material, two_sided({"type": "diffuse", "reflectance": bitmap(values[:, :, :3])})
    # Half of bilinear opacity: glTF cuts there, so Mitsuba's mask is of many texels of 0 or 1.
    material["alphaMode"], material["alphaCutoff"] = "BLEND", 0.5
    material["pbrMetallicRoughness"]["baseColorFactor"] = [0, 0, 0, 1]
    return material, {"type": "mask", "opacity": bitmap(values[:, :, 3:]),
                      "nested": diffuse(0, 0, 0)[1]}


# --- Lights: clshear's flags, and Mitsuba's emitters ---


def point(position, intensity):
    numbers = ",".join(map(str, [*position, *intensity]))
    return ["--light", numbers], {"type": "point", "position": position,
                                  "intensity": rgb(intensity)}


def directional(towards, irradiance):
    numbers = ",".join(map(str, [*towards, *irradiance, 0]))
    return ["--sun", numbers], {"type": "directional", "direction": [-x for x in towards],
                                "irradiance": rgb(irradiance)}


def sun(towards, irradiance, degrees):
    """Mitsuba's is a disk, far away, of the same angle."""
    far, half = 1000.0, math.radians(degrees / 2)
    place = far * np.array(towards) / np.linalg.norm(towards)
    radiance = [value / (math.pi * math.sin(half) ** 2) for value in irradiance]
    frame = mi.ScalarTransform4f().look_at(place.tolist(), [0, 0, 0], [0, 0, 1]).scale(
        far * math.tan(half))
    numbers = ",".join(map(str, [*towards, *irradiance, degrees]))
    return ["--sun", numbers], {"type": "disk", "to_world": frame, "bsdf": diffuse(0, 0, 0)[1],
                                "emitter": {"type": "area", "radiance": rgb(radiance)}}


def environment(folder):
    """Radiance that is linear in the angle from the pole, where Mitsuba's rows are elsewhere, and
    random in longitude. The middle of clshear's image is the edge of Mitsuba's."""
    width, height = 32, 256
    across = np.random.default_rng(7).uniform(0.2, 2.0, (1, width, 3))

    def image(places):
        return (across * (2.0 - 1.5 * places[:, None, None])).astype(np.float32)

    path = folder / "environment.exr"
    mi.Bitmap(image((np.arange(height) + 0.5) / height)).write(str(path))
    theirs = np.roll(image(np.arange(height) / (height - 1)), -width // 2, axis=1)
    return ["--environment", str(path)], {"type": "envmap", "bitmap": mi.Bitmap(
        np.ascontiguousarray(theirs))}


def spot(position, intensity, degrees):
    """Shines down; within the cone, which has a sharp edge, it is a point. The light is in the
    file."""
    half, edge = math.radians(degrees / 2), 1e-4
    most = max(intensity)
    file = {"type": "spot", "color": [value / most for value in intensity], "intensity": most,
            "spot": {"innerConeAngle": half - edge, "outerConeAngle": half}}
    frame = mi.ScalarTransform4f().look_at(position, [position[0], 0, position[2]], [0, 0, 1])
    return (file, position), {"type": "spot", "to_world": frame, "intensity": rgb(intensity),
                              "cutoff_angle": degrees / 2,
                              "beam_width": degrees / 2 - math.degrees(edge)}


def scenes(folder):
    """Name: parts (geometry, surface), lights, bounces."""
    grey, sky = (ground(), diffuse(0.5, 0.4, 0.3)), environment(folder)
    lit = point([2.0, 4.0, 1.0], [30.0, 25.0, 20.0])
    solid = [grey, (ball(), diffuse(0.8, 0.2, 0.4))]

    def with_ball(of):
        return [grey, (ball(), of)]

    return {
        "point": (solid, [lit], 0),
        "spot": (solid, [spot([0.5, 4.0, 0.5], [30.0, 25.0, 20.0], 40.0)], 0),
        "directional": (solid, [directional([0.6, 0.8, 0.0], [3.0, 2.0, 1.0])], 1),
        "sun": (solid, [sun([0.6, 0.8, 0.0], [3.0, 2.0, 1.0], 20.0)], 1),
        "area": ([*solid, (lamp(), shining(8.0, 6.0, 4.0))], [], 1),
        "environment": (solid, [sky], 1),
        "four-bounces": ([*solid, (card(2.2, 2.0), diffuse(0.9, 0.9, 0.9))],
                         [point([2.0, 0.4, 1.5], [8.0, 8.0, 8.0])], 4),
        "metal-polished": (with_ball(white_metal(0.25)), [sky], 2),
        "metal-rough": (with_ball(white_metal(0.7)), [sky, lit], 2),
        "metal-tinted": (with_ball(tinted_metal(0.5, 0.9, 0.5, 0.2)), [sky, lit], 2),
        "glass-smooth": (with_ball(glass(0.0)), [sky], 12),
        "glass-rough": (with_ball(glass(0.5)), [sky], 12),
        "foil": ([grey, (card(), foil(0.9, 0.5, 0.2))], [sky], 8),
        "alpha": ([grey, (card(), textured(cut=True))], [sky], 8),
        "texture-transform": ([(ground(2.0), textured(([2.5, 1.5], [0.3, 0.1])))], [lit], 0),
    }


# --- Rendering ---


def png(texels):
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        mi.Bitmap(texels).write(file.name)
        return pathlib.Path(file.name).read_bytes()


def write_gltf(path, parts, lights):
    """All in one file. Light in the file: (KHR light, position), shining down."""
    data, views, accessors, meshes, materials, images, nodes = b"", [], [], [], [], [], []

    def accessor(array, kind, component):
        nonlocal data
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": array.nbytes})
        data += array.tobytes()
        entry = {"bufferView": len(views) - 1, "componentType": component, "type": kind,
                 "count": len(array)}
        if kind == "VEC3":
            entry.update(min=array.min(axis=0).tolist(), max=array.max(axis=0).tolist())
        accessors.append(entry)
        return len(accessors) - 1

    for (positions, triangles, coordinates), (material, *_) in parts:
        material = dict(material, doubleSided=True)
        texels = material.pop("texels", None)
        if texels is not None:
            images.append({"uri": "data:image/png;base64," + base64.b64encode(png(texels)).decode()})
        meshes.append({"primitives": [{
            "attributes": {"POSITION": accessor(positions, "VEC3", 5126),
                           "TEXCOORD_0": accessor(coordinates, "VEC2", 5126)},
            "indices": accessor(triangles.reshape(-1), "SCALAR", 5125),
            "material": len(materials)}]})
        nodes.append({"mesh": len(meshes) - 1})
        materials.append(material)
    turned = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]  # -Z becomes -Y
    for i, (_, position) in enumerate(lights):
        nodes.append({"translation": position, "rotation": turned,
                      "extensions": {"KHR_lights_punctual": {"light": i}}})
    content = {"asset": {"version": "2.0"}, "scene": 0,
               "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes, "meshes": meshes,
               "materials": materials, "accessors": accessors, "bufferViews": views,
               "buffers": [{"byteLength": len(data), "uri":
                            "data:application/octet-stream;base64,"
                            + base64.b64encode(data).decode()}]}
    if images:
        content.update(images=images, textures=[{"source": 0}])
    if lights:
        content["extensions"] = {"KHR_lights_punctual": {"lights": [light for light, _ in lights]}}
    path.write_text(json.dumps(content))


def of_clshear(options, folder, name, parts, lights, bounces):
    """Pixels and the variance of their values."""
    path, picture = folder / (name + ".gltf"), folder / (name + ".exr")
    write_gltf(path, parts, [light for light, _ in lights if isinstance(light, tuple)])
    flags = [flag for light, _ in lights if isinstance(light, list) for flag in light]

    def joined(numbers):
        return ",".join(map(str, numbers))

    command = [options.program, path, *flags, "--eye", joined(EYE), "--target", joined(TARGET),
               "--up", "0,1,0", "--fov", FOV, "--lens-radius", LENS, "--focal-distance", FOCUS,
               "--aperture", "disk", "--width", options.size, "--height", options.size, "--spp",
               options.spp, "--replicates", REPLICATES, "--bounces", bounces, "--seed", 11,
               "--quiet", "--out", picture]
    surroundings = dict(os.environ, POCL_EXTRA_BUILD_FLAGS="-DCS_FACETS_OF_MITSUBA")
    subprocess.run([str(word) for word in command], check=True, env=surroundings)
    bitmap = mi.Bitmap(str(picture))
    place = {field.name: i for i, field in enumerate(bitmap.struct_())}
    planes = np.array(bitmap, dtype=np.float64)
    return (planes[:, :, [place[c] for c in "RGB"]],
            planes[:, :, [place["Variance." + c] for c in "RGB"]])


def of_mitsuba(options, parts, lights, bounces):
    """The same, from renders with different seeds."""
    frame = mi.ScalarTransform4f().look_at(EYE, TARGET, [0, 1, 0])
    content = {"type": "scene", "sensor": {
        "type": "thinlens", "to_world": frame, "fov": FOV, "aperture_radius": LENS,
        "focus_distance": FOCUS, "near_clip": 1e-2, "far_clip": 1e5,
        "sampler": {"type": "independent", "sample_count": options.spp // REPLICATES},
        "film": {"type": "hdrfilm", "width": options.size, "height": options.size,
                 "pixel_format": "rgb", "component_format": "float32",
                 "rfilter": {"type": "box"}}}}
    for i, ((positions, triangles, coordinates), (_, bsdf, *emitter)) in enumerate(parts):
        properties = mi.Properties()
        properties["bsdf"] = mi.load_dict(bsdf)
        if emitter:
            properties["emitter"] = mi.load_dict(emitter[0])
        mesh = mi.Mesh(f"part{i}", len(positions), len(triangles), has_vertex_normals=False,
                       has_vertex_texcoords=True, props=properties)
        parameters = mi.traverse(mesh)
        parameters["vertex_positions"] = positions.ravel()
        parameters["vertex_texcoords"] = coordinates.ravel()
        parameters["faces"] = triangles.ravel()
        parameters.update()
        content[f"part{i}"] = mesh
    for i, (_, light) in enumerate(lights):
        content[f"light{i}"] = light
    scene = mi.load_dict(content)
    # No roulette: "path" plays it for all of a path's throughput, which is rare noise.
    integrator = mi.load_dict({"type": "path", "max_depth": bounces + 2, "rr_depth": 1000})
    stack = np.stack([np.array(mi.render(scene, integrator=integrator, seed=100 + seed,
                                         spp=options.spp // REPLICATES), dtype=np.float64)[:, :, :3]
                      for seed in range(REPLICATES)])
    return stack.mean(axis=0), stack.var(axis=0, ddof=1) / REPLICATES


def agree(options, folder, name, scene):
    ours, variance = of_clshear(options, folder, name, *scene)
    theirs, spread = of_mitsuba(options, *scene)
    if options.keep:
        kept = pathlib.Path(options.keep)
        for word, image in (("ours", ours), ("theirs", theirs)):
            mi.Bitmap(image.astype(np.float32)).convert(
                mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, True).write(
                    str(kept / f"{name}-{word}.png"))
    noise = variance + spread
    seen = noise > 0
    z = (ours - theirs)[seen] / np.sqrt(noise[seen])
    pixels = len(z) / 3  # the colours of a pixel are one draw
    mean, size = z.mean(), abs(z).mean()
    same = size < MOST_Z and abs(mean) < 5 * 1.1 / math.sqrt(pixels)
    same = same and np.allclose(ours[~seen], theirs[~seen], rtol=1e-3, atol=1e-5)
    print(f"{'agrees' if same else 'DIFFERS':8} {name:18} mean |z| {size:.3f}, mean z {mean:+.4f}, "
          f"beyond 3 {(abs(z) > 3).mean():.2%}, means {ours.mean():.5f} {theirs.mean():.5f}",
          flush=True)
    return same


def main():
    """Exits with 1 if a scene differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=48, help="pixels along a side")
    parser.add_argument("--spp", type=int, default=1024, help="of both, in 16 renders")
    parser.add_argument("--scene", action="append", help="only this one; may be repeated")
    parser.add_argument("--keep", help="folder for pictures of both")
    parser.add_argument("--program", default=str(ROOT / "build" / "clshear"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        chosen = {name: scene for name, scene in scenes(pathlib.Path(folder)).items()
                  if options.scene is None or name in options.scene}
        results = [agree(options, pathlib.Path(folder), name, scene)
                   for name, scene in chosen.items()]
    return 0 if results and all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
