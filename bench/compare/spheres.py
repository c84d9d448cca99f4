"""A scene of many triangles: spheres above a floor, near and far from the plane of focus.

python3 bench/compare/spheres.py FOLDER writes spheres.obj, .mtl and .flags there.
"""
import pathlib
import sys

import numpy as np

SPHERE_MATERIALS = {
    "brick": (0.65, 0.25, 0.18), "sand": (0.75, 0.65, 0.45), "moss": (0.3, 0.5, 0.22),
    "sea": (0.2, 0.4, 0.6), "plum": (0.45, 0.2, 0.4), "chalk": (0.8, 0.8, 0.78),
}
SPHERE_FLAGS = """--eye 0,5,13
--target 0,0.4,-0.5
--up 0,1,0
--fov 38
--focal-distance 14
--lens-radius 0.3
--light 7,11,9,320,300,280
"""


def unit_sphere(columns=32, bands=17):
    """Vertices and triangles (1024) of a sphere by longitude and latitude, poles on the Y axis."""
    height = np.pi * np.arange(1, bands)[:, None] / bands
    turn = 2 * np.pi * np.arange(columns)[None, :] / columns
    ring = np.stack(np.broadcast_arrays(np.sin(height) * np.cos(turn), np.cos(height),
                                        np.sin(height) * np.sin(turn)), axis=-1)
    vertices = np.vstack([[0, 1, 0], ring.reshape(-1, 3), [0, -1, 0]])
    here = np.arange(columns)
    after, last, lowest = (here + 1) % columns, len(vertices) - 1, 1 + (bands - 2) * columns
    triangles = [np.stack([0 * here, 1 + here, 1 + after], axis=1),
                 np.stack([0 * here + last, lowest + here, lowest + after], axis=1)]
    for band in range(bands - 2):
        a, b = 1 + band * columns, 1 + (band + 1) * columns
        triangles.append(np.stack([a + here, b + here, b + after], axis=1))
        triangles.append(np.stack([a + here, b + after, a + after], axis=1))
    return vertices, np.vstack(triangles)


def write_spheres(folder, columns=16, rows=15):
    """Spheres above a floor, one in each cell of a grid so that none touch; flat shading."""
    random = np.random.default_rng(1)
    vertices, triangles = unit_sphere()
    names = list(SPHERE_MATERIALS)
    with open(folder / "spheres.obj", "w", encoding="ascii") as obj:
        obj.write("mtllib spheres.mtl\nusemtl floor\n")
        obj.write("v -60 0 40\nv 60 0 40\nv 60 0 -60\nv -60 0 -60\nf 1 2 3 4\n")
        for i in range(columns * rows):
            radius = random.uniform(0.22, 0.45)
            slack = 0.49 - radius
            centre = [i % columns - 0.5 * columns + 0.5 + random.uniform(-slack, slack),
                      radius + random.choice([0.02, random.uniform(0.02, 1.5)]),
                      6 - i // columns + random.uniform(-slack, slack)]
            obj.write(f"usemtl {names[i * len(names) // (columns * rows)]}\n")
            np.savetxt(obj, radius * vertices + centre, "v %.7g %.7g %.7g")
            np.savetxt(obj, triangles + 5 + i * len(vertices), "f %d %d %d")
    with open(folder / "spheres.mtl", "w", encoding="ascii") as mtl:
        for name, colour in {"floor": (0.6, 0.6, 0.6), **SPHERE_MATERIALS}.items():
            mtl.write("newmtl {}\nKd {} {} {}\n".format(name, *colour))
    (folder / "spheres.flags").write_text(SPHERE_FLAGS)
    return folder / "spheres.obj"


if __name__ == "__main__":
    print(write_spheres(pathlib.Path(sys.argv[1])))
