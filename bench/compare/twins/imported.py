"""Reads a scene file as clshear does: through its own importer, so that the twin of a scene has the
same triangles, normals, texture coordinates and materials. Needs numpy only.

What comes through the pipe is host/import/transfer.h's records; the arrays and their order are
cs_scene_arrays', the structs those of cl/kernels/scene.h.
"""
import struct
import subprocess

import numpy as np

SMOOTH, TEXTURED = 1, 2  # CS_FACE_ bits
BLEND, MASK, UNLIT = 1, 2, 4  # CS_MATERIAL_ bits
LAMBERT, STANDARD = 0, 1  # CS_BSDF_ kinds
WRAPS = {0: "REPEAT", 1: "EXTEND"}  # CS_TEXTURE_ kinds, in Blender's words
ARRAYS = ["positions", "vertices", "colours", "indices", "triangle_materials", "triangle_flags",
          "materials", "textures", "texels", "lights", "cameras", "positions_to", "normals_to"]

VERTEX = np.dtype([("normal", "<f4", 3), ("texture", "<f4", 2)])
TEXTURE = np.dtype([("first", "<u4"), ("width", "<u4"), ("height", "<u4"), ("lookup", "<u4")])
MATERIAL = np.dtype([
    ("diffuse", "<f4", 3), ("texture", "<i4"), ("emission", "<f4", 3), ("bsdf", "<u4"),
    ("roughness", "<f4"), ("metallic", "<f4"), ("f0", "<f4"), ("f90", "<f4"),
    ("transmission", "<f4"), ("coat", "<f4"), ("coat_roughness", "<f4"), ("sheen", "<f4", 3),
    ("others", "<f4", 6), ("alpha", "<f4"), ("cutoff", "<f4"), ("flags", "<u4"),
    ("facets_texture", "<u4"), ("normal_texture", "<u4"), ("emission_texture", "<u4"),
    ("normal_scale", "<f4"), ("padding", "<f4")])


def records(stream):
    """Tags and bytes of all records of the importer's output."""
    at = 0
    while at < len(stream):
        tag, _, size = struct.unpack_from("<4sIQ", stream, at)
        at += 16
        yield tag, stream[at:at + size]
        at += size


def raw_arrays(importer, path):
    """Bytes of the scene's arrays by name. -1: faces without normals are smooth where the file says
    so, as by default."""
    stream = subprocess.run([importer, path, "-1", "-"], stdout=subprocess.PIPE, check=False).stdout
    arrays = []
    for tag, content in records(stream):
        if tag == b"FAIL":
            raise SystemExit(content[4:].decode())
        if tag == b"ARRA":
            arrays.append(content)
    if len(arrays) != len(ARRAYS):
        raise SystemExit(f"{path}: {importer} sent {len(arrays)} arrays, not {len(ARRAYS)}; "
                         "build clshear and its importer anew")
    return dict(zip(ARRAYS, arrays))


def images(arrays):
    """The textures: texels (rows from the bottom up, as Blender has them; linear), and the wrap."""
    texels = np.frombuffer(arrays["texels"], "<f2").reshape(-1, 4).astype(np.float32)
    for one in np.frombuffer(arrays["textures"], TEXTURE):
        first, width, height = int(one["first"]), int(one["width"]), int(one["height"])
        if one["lookup"] & 3 not in WRAPS or one["lookup"] & 3 != one["lookup"] >> 2:
            raise SystemExit("mirrored textures, of two wraps or of nearest texels have no twin")
        rows = texels[first:first + width * height].reshape(height, width, 4)
        yield rows[::-1], WRAPS[int(one["lookup"]) & 3]


def check(path, arrays, materials):
    """Ends the program, with a line, for what the twin cannot have."""
    lacking = [
        ("emissive materials", np.any(materials["emission"] > 0)),
        ("glass, coats or sheen", np.any((materials["bsdf"] > STANDARD)
                                         | (materials["transmission"] > 0)
                                         | (materials["coat"] > 0)) or np.any(materials["sheen"])),
        ("maps of facets, normals or alpha", np.any(materials["facets_texture"])
         or np.any(materials["normal_texture"]) or np.any(materials["flags"] & (MASK | UNLIT))),
        ("colours of vertices", len(arrays["colours"]) > 0),
        ("lights of its own", len(arrays["lights"]) > 0),
        ("motion", len(arrays["positions_to"]) > 0)]
    for name, is_there in lacking:
        if is_there:
            raise SystemExit(f"{path}: has {name}, which its twin would lack; take another scene")


class Imported:
    """positions, normals: float (n, 3); coordinates: float (n, 2), upwards; triangles: int (m, 3);
    material_of, flags: int (m); materials: MATERIAL; images: list of (texels, wrap)."""

    def __init__(self, importer, path):
        arrays = raw_arrays(importer, path)
        self.materials = np.frombuffer(arrays["materials"], MATERIAL)
        check(path, arrays, self.materials)
        vertices = np.frombuffer(arrays["vertices"], VERTEX)
        self.positions = np.frombuffer(arrays["positions"], "<f4").reshape(-1, 3)
        self.normals, self.coordinates = vertices["normal"], vertices["texture"]
        self.triangles = np.frombuffer(arrays["indices"], "<u4").reshape(-1, 3).astype(np.int32)
        self.material_of = np.frombuffer(arrays["triangle_materials"], "<u4").astype(np.int32)
        self.flags = np.frombuffer(arrays["triangle_flags"], np.uint8)
        self.images = list(images(arrays))
