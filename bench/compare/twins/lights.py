"""Lights as clshear's flags, or as light of the file, and as Mitsuba's emitter: (ours, theirs)."""
import math

import mitsuba as mi
import numpy as np

from surfaces import diffuse, rgb


def point(position, intensity):
    numbers = ",".join(map(str, [*position, *intensity]))
    return ["--light", numbers], {"type": "point", "position": position,
                                  "intensity": rgb(intensity)}


def directional(towards, irradiance):
    numbers = ",".join(map(str, [*towards, *irradiance, 0]))
    return ["--sun", numbers], {"type": "directional", "direction": [-x for x in towards],
                                "irradiance": rgb(irradiance)}


def sun(towards, irradiance, degrees):
    """Mitsuba's is a disk of the same angle, so far away that moving by 5 changes its irradiance by
    1e-5."""
    far, half = 1e6, math.radians(degrees / 2)
    place = far * np.array(towards) / np.linalg.norm(towards)
    radiance = [value / (math.pi * math.sin(half) ** 2) for value in irradiance]
    frame = mi.ScalarTransform4f().look_at(place.tolist(), [0, 0, 0], [0, 0, 1]).scale(
        far * math.tan(half))
    numbers = ",".join(map(str, [*towards, *irradiance, degrees]))
    return ["--sun", numbers], {"type": "disk", "to_world": frame, "bsdf": diffuse(0, 0, 0)[1],
                                "emitter": {"type": "area", "radiance": rgb(radiance)}}


def sphere(centre, radius, radiance):
    numbers = ",".join(map(str, [*centre, radius, *radiance]))
    return ["--sphere", numbers], {"type": "sphere", "center": centre, "radius": radius,
                                   "bsdf": diffuse(0, 0, 0)[1],
                                   "emitter": {"type": "area", "radiance": rgb(radiance)}}


def panel(corner, edge, other, radiance):
    """Shines on the side from which `edge` turns to `other` against the clock. Mitsuba's rectangle
    goes from -1 to 1."""
    corner, edge, other = map(np.array, (corner, edge, other))
    normal = np.cross(edge, other)
    frame = np.eye(4)
    frame[:3] = np.stack([edge / 2, other / 2, normal / np.linalg.norm(normal),
                          corner + (edge + other) / 2], axis=1)
    numbers = ",".join(map(str, [*corner, *edge, *other, *radiance]))
    return ["--quad", numbers], {"type": "rectangle", "to_world": mi.ScalarTransform4f(frame),
                                 "bsdf": diffuse(0, 0, 0)[1],
                                 "emitter": {"type": "area", "radiance": rgb(radiance)}}


def environment(folder, brightest=1.0):
    """Radiance that is linear in the angle from the pole, where Mitsuba's rows are elsewhere, and
    random in longitude. The middle of clshear's image is the edge of Mitsuba's. brightest: by how
    much one of its columns is brighter: an image that is even has no tables in clshear."""
    width, height = 32, 256
    across = np.random.default_rng(7).uniform(0.2, 2.0, (1, width, 3))
    across[0, 9] *= brightest

    def image(places):
        return (across * (2.0 - 1.5 * places[:, None, None])).astype(np.float32)

    path = folder / f"environment{brightest:g}.exr"
    mi.Bitmap(image((np.arange(height) + 0.5) / height)).write(str(path))
    theirs = np.roll(image(np.arange(height) / (height - 1)), -width // 2, axis=1)
    return ["--environment", str(path)], {"type": "envmap", "bitmap": mi.Bitmap(
        np.ascontiguousarray(theirs))}


def spot(position, intensity, degrees):
    """Shines down. Between inner and outer angle the falloffs differ, glTF's by the cosine,
    Mitsuba's by the angle; so the edge is too narrow for a pixel to show. The light is in the
    file."""
    half, edge = math.radians(degrees / 2), 1e-4
    most = max(intensity)
    file = {"type": "spot", "color": [value / most for value in intensity], "intensity": most,
            "spot": {"innerConeAngle": half - edge, "outerConeAngle": half}}
    frame = mi.ScalarTransform4f().look_at(position, [position[0], 0, position[2]], [0, 0, 1])
    return (file, position), {"type": "spot", "to_world": frame, "intensity": rgb(intensity),
                              "cutoff_angle": degrees / 2,
                              "beam_width": degrees / 2 - math.degrees(edge)}
