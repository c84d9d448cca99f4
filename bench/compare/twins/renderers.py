"""Renders a scene with clshear and with Mitsuba: one camera, lens and film."""
import os
import resource
import subprocess

import drjit as dr
import mitsuba as mi
import numpy as np

from gltf import write_gltf

# With one thread Mitsuba's pool has no worker, and it waits for ever at the first EXR file.
if dr.thread_count() < 2:
    dr.set_thread_count(2)

EYE, TARGET, FOV, LENS, FOCUS = [0.0, 3.0, 5.0], [0.0, 0.6, 0.0], 40.0, 0.05, 5.2


# What Mitsuba's microfacets lack (light that meets several facets, shadowing and masking of one
# height) is compiled out of clshear's kernels by a macro, which PoCL takes from the environment.
FACETS_OF_MITSUBA = {"POCL_EXTRA_BUILD_FLAGS": "-DCS_FACETS_OF_MITSUBA"}


def planes_of(bitmap):
    """Planes by the names of their channels, whose order is the reader's, not that of the file."""
    planes = np.moveaxis(np.array(bitmap, dtype=np.float64), -1, 0)
    return {field.name: plane for field, plane in zip(bitmap.struct_(), planes)}


def run_clshear(options, folder, name, scene, flags, surroundings):
    """Planes of the picture by the names of their channels, and processor time in seconds, of
    loading and compiling too. `surroundings`: environment variables to add."""
    parts, lights, bounces = scene
    path, picture = folder / (name + ".gltf"), folder / (name + "-picture.exr")
    write_gltf(path, parts, [light for light, _ in lights if isinstance(light, tuple)])
    lit = [flag for light, _ in lights if isinstance(light, list) for flag in light]

    def joined(numbers):
        return ",".join(map(str, numbers))

    command = [options.program, path, *lit, "--eye", joined(EYE), "--target", joined(TARGET),
               "--up", "0,1,0", "--fov", FOV, "--lens-radius", LENS, "--focal-distance", FOCUS,
               "--aperture", "disk", "--width", options.size, "--height", options.size, "--bounces",
               bounces, "--quiet", *flags, "--out", picture]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([str(word) for word in command], check=True,
                   env=dict(os.environ, **surroundings))
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return planes_of(mi.Bitmap(str(picture))), (after.ru_utime + after.ru_stime) - (before.ru_utime + before.ru_stime)


def mesh(name, geometry, bsdf, emitter):
    """Flat triangles."""
    positions, triangles, coordinates = geometry
    properties = mi.Properties()
    properties["bsdf"] = mi.load_dict(bsdf)
    if emitter:
        properties["emitter"] = mi.load_dict(emitter[0])
    made = mi.Mesh(name, len(positions), len(triangles), has_vertex_normals=False,
                   has_vertex_texcoords=True, props=properties)
    parameters = mi.traverse(made)
    for key, values in (("vertex_positions", positions), ("vertex_texcoords", coordinates),
                        ("faces", triangles)):
        parameters[key] = type(parameters[key])(values.ravel())
    parameters.update()
    return made


def load_mitsuba(options, scene, spp, rr_depth=5):
    """The scene, and an integrator for its bounces, which plays roulette from vertex `rr_depth`
    on, Mitsuba's default if not given."""
    parts, lights, bounces = scene
    frame = mi.ScalarTransform4f().look_at(EYE, TARGET, [0, 1, 0])
    content = {"type": "scene", "sensor": {
        "type": "thinlens", "to_world": frame, "fov": FOV, "aperture_radius": LENS,
        "focus_distance": FOCUS, "near_clip": 1e-2, "far_clip": 1e5,
        "sampler": {"type": "independent", "sample_count": spp},
        "film": {"type": "hdrfilm", "width": options.size, "height": options.size,
                 "pixel_format": "rgb", "component_format": "float32",
                 "rfilter": {"type": "box"}}}}
    for i, (geometry, (_, bsdf, *emitter)) in enumerate(parts):
        content[f"part{i}"] = mesh(f"part{i}", geometry, bsdf, emitter)
    for i, (_, light) in enumerate(lights):
        content[f"light{i}"] = light
    return mi.load_dict(content), mi.load_dict({"type": "path", "max_depth": bounces + 2,
                                                "rr_depth": rr_depth})
