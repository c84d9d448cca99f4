"""Puts furniture into a room: one OBJ and one MTL out of many.

    assemble.py ROOM.txt FURNITURE OUT.obj

A room file has the line `room WIDTH HEIGHT DEPTH` (cm; the floor is y = 0, the middle of it the
origin, the front, z = DEPTH / 2, is open) and lines `MODEL ANGLE X Z [Y]`: an OBJ below the folder
FURNITURE without its suffix, turned by ANGLE degrees about its middle, which is put to X, Z; its
lowest point is put to Y, or to the floor.
"""
import math
import pathlib
import sys

WALL = "newmtl wall\nKd .72 .7 .66\nnewmtl floor\nKd .45 .33 .24\n"


def walls(width, height, depth):
    """The room's five sides as OBJ text and the number of vertices it has."""
    x, y, z = width / 2, height, depth / 2
    corners = [(sx * x, sy, sz * z) for sy in (0, y) for sz in (-1, 1) for sx in (-1, 1)]
    lines = ["v %g %g %g" % corner for corner in corners]
    lines += ["usemtl floor", "f 1 3 4 2", "usemtl wall", "f 5 6 8 7", "f 1 2 6 5", "f 1 5 7 3",
              "f 2 4 8 6"]
    return lines, len(corners)


class Model:
    """An OBJ, turned and put in its place."""

    def __init__(self, path, angle, place):
        self.path = path
        self.words = [line.split() for line in path.read_text(errors="replace").splitlines()]
        self.turn = (math.cos(math.radians(angle)), math.sin(math.radians(angle)))
        points = [tuple(map(float, w[1:4])) for w in self.words if w[:1] == ["v"]]
        low, high = map(min, zip(*points)), map(max, zip(*points))
        low, high = tuple(low), tuple(high)
        self.middle = ((low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2)
        self.place = place

    def turned(self, vector):
        cosine, sine = self.turn
        x, y, z = vector
        return cosine * x + sine * z, y, cosine * z - sine * x

    def moved(self, point):
        offset = self.turned(tuple(p - m for p, m in zip(point, self.middle)))
        return tuple(o + p for o, p in zip(offset, self.place))

    def materials(self, prefix):
        """The lines of its material files, with names that begin with `prefix`."""
        for words in self.words:
            if words[:1] != ["mtllib"]:
                continue
            library = self.path.parent / " ".join(words[1:])
            for line in library.read_text(errors="replace").splitlines():
                parts = line.split()
                if parts[:1] == ["newmtl"]:
                    line = "newmtl " + prefix + parts[-1]
                elif parts and parts[0].lower().startswith("map_"):
                    texture = library.parent / parts[-1].replace("\\", "/")
                    line = " ".join(parts[:-1] + [str(texture)])
                yield line

    def lines(self, prefix, before):
        """Its lines, where `before` counts the positions, coordinates and normals above it."""
        for words in self.words:
            kind = words[0] if words else ""
            if kind == "v":
                yield "v %.7g %.7g %.7g" % self.moved(tuple(map(float, words[1:4])))
            elif kind == "vn":
                yield "vn %.5g %.5g %.5g" % self.turned(tuple(map(float, words[1:4])))
            elif kind == "vt":
                yield " ".join(words[:3])
            elif kind == "usemtl":
                yield "usemtl " + prefix + words[-1]
            elif kind == "f":
                yield "f " + " ".join(corner_after(word, before) for word in words[1:])

    def counts(self):
        return [sum(w[:1] == [kind] for w in self.words) for kind in ("v", "vt", "vn")]


def corner_after(word, before):
    """A corner "v/vt/vn", renumbered; the furniture has no negative numbers."""
    return "/".join(str(int(part) + b) if part else "" for part, b in zip(word.split("/"), before))


def main(room, furniture, out):
    obj, before, mtl = [], [0, 0, 0], [WALL]
    for number, line in enumerate(pathlib.Path(room).read_text().splitlines()):
        words = line.split()
        if not words or words[0] == "#":
            continue
        if words[0] == "room":
            lines, before[0] = walls(*map(float, words[1:4]))
            obj += lines
            continue
        angle, x, z, *y = map(float, words[1:])
        model = Model(pathlib.Path(furniture).resolve() / (words[0] + ".obj"), angle,
                      (x, y[0] if y else 0.0, z))
        prefix = "%d_" % number
        obj += model.lines(prefix, before)
        mtl += model.materials(prefix)
        before = [b + c for b, c in zip(before, model.counts())]
    out = pathlib.Path(out)
    out.with_suffix(".mtl").write_text("\n".join(mtl) + "\n")
    out.write_text("\n".join(["mtllib " + out.with_suffix(".mtl").name] + obj) + "\n")


main(*sys.argv[1:])
