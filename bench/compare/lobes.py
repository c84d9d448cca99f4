"""Compares what clshear shows of a plane with the published formulas of its lobes.

Mitsuba has no twin of glTF's dielectric over a base, clear coat and sheen. So this evaluates them in
numpy, from the papers and not from the kernels: a plane of each surface under a point light, where
the radiance is one value of the BSDF, and under a sky, where it is an integral over the hemisphere.

Sources: GGX and its height-correlated shadowing, Walter et al. 2007 and Heitz 2014 (equation 99);
light that meets several facets, Kulla & Conty 2017; the base under a dielectric, the same authors'
(1 - E(out)) (1 - E(in)) / (1 - mean E); sheen, Estevez & Kulla 2017 (equation 2) with the
visibility of Neubelt & Pettineo 2013; how layers are stacked, KHR_materials_clearcoat and _sheen,
with albedos for the Fresnel reflectance at the view direction.
"""
import argparse
import base64
import json
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
EYE, TARGET, FOV, SIZE = np.array([0.0, 2.0, 2.0]), np.array([0.0, 0.0, 0.2]), 70.0, 32
LAMP, INTENSITY = np.array([1.0, 1.5, -0.5]), 8.0
ZENITH, HORIZON = 0.5, 1.5  # radiance of the sky, linear in the sine of the elevation between
SPP, REPLICATES = {"lamp": 1024, "sky": 4096}, 16
COAT_F0 = 0.04

# Tables of albedos are linear between 64 cosines and 32 roughnesses: a part of the value.
MOST_OF_TABLES = 1e-3
# Student's t with 15 degrees of freedom goes beyond 8.6 once in 3 million draws; a run has 61000.
MOST_DEVIATIONS = 8.6

WHITE = (1.0, 1.0, 1.0)


def layered(colour, roughness, metal=0.0, f0=0.04, specular=1.0, coat=0.0, coat_roughness=0.0,
            sheen=None, sheen_roughness=0.0):
    return {"colour": np.array(colour), "roughness": roughness, "metal": metal, "f0": specular * f0,
            "f90": specular, "coat": coat, "coat_roughness": coat_roughness,
            "sheen": np.array(sheen or (0.0, 0.0, 0.0)), "sheen_roughness": sheen_roughness}


SURFACES = {
    "dielectric-polished": layered((0.8, 0.5, 0.2), 0.3),
    "dielectric-rough": layered((0.8, 0.5, 0.2), 0.8),
    "dielectric-dense": layered((0.3, 0.6, 0.9), 0.5, f0=(1.0 / 3.0) ** 2),
    "dielectric-weak": layered((0.3, 0.6, 0.9), 0.5, specular=0.4),
    "metal": layered((0.9, 0.6, 0.3), 0.85, metal=1.0),
    "coat-on-diffuse": layered((0.8, 0.5, 0.2), 0.5, specular=0.0, coat=1.0, coat_roughness=0.3),
    "coat-on-metal": layered((0.9, 0.6, 0.3), 0.7, metal=1.0, coat=0.6, coat_roughness=0.4),
    "sheen-on-diffuse": layered((0.4, 0.2, 0.1), 0.5, specular=0.0, sheen=(0.3, 0.6, 0.9),
                                sheen_roughness=0.4),
    "sheen-on-dielectric": layered((0.4, 0.2, 0.1), 0.6, sheen=(0.9, 0.9, 0.9),
                                   sheen_roughness=0.8),
    "all": layered((0.8, 0.5, 0.2), 0.6, coat=0.8, coat_roughness=0.35, sheen=(0.2, 0.5, 0.5),
                   sheen_roughness=0.6),
}

# With --quick: surfaces that have every lobe, and fewer samples.
QUICK = ("dielectric-dense", "coat-on-metal", "sheen-on-diffuse", "all")
QUICK_SPP = {"lamp": 1024, "sky": 1024}


# ----- Formulas. Cosines are those to the normal, above 0; directions have the normal as last axis.

def facets(cos_half, cos_out, cos_in, roughness):
    """Distribution and visibility of facets, per steradian and cosine."""
    square = roughness ** 4
    density = square / (np.pi * (cos_half ** 2 * (square - 1.0) + 1.0) ** 2)
    slants = (cos_in * np.sqrt(square + (1.0 - square) * cos_out ** 2)
              + cos_out * np.sqrt(square + (1.0 - square) * cos_in ** 2))
    return density * 0.5 / slants


def schlick(cosine):
    return (1.0 - cosine) ** 5


def fibres(cos_half, cos_out, cos_in, roughness):
    """White sheen."""
    power = 1.0 / roughness ** 2
    density = (2.0 + power) * (1.0 - cos_half ** 2) ** (0.5 * power) / (2.0 * np.pi)
    return density / (4.0 * (cos_out + cos_in - cos_out * cos_in))


def hemisphere(around=200, up=400):
    """Directions and their projected solid angles, of the half that the other mirrors in the plane
    of the normal and `out`: midpoints in azimuth, and nodes in the square root of the height over
    the horizon, which crowds them there, where `out` may see a highlight."""
    turn = np.pi * (np.arange(around) + 0.5) / around
    nodes, weights = np.polynomial.legendre.leggauss(up)
    height = 0.25 * (nodes + 1.0) ** 2
    weights = weights * 0.5 * (nodes + 1.0)  # of the height
    cosine, turn = np.meshgrid(height, turn, indexing="ij")
    sine = np.sqrt(1.0 - cosine ** 2)
    directions = np.stack([sine * np.cos(turn), sine * np.sin(turn), cosine], axis=-1)
    angles = (weights * height * 2.0 * np.pi / around)[:, None] + 0.0 * turn
    return directions.reshape(-1, 3), angles.reshape(-1)


ALL_IN = hemisphere()
COSINES = 0.5 * (1.0 - np.cos(np.pi * np.arange(1, 65) / 64.0))  # nodes, closer at both ends


def angles_of(out, directions):
    """Cosines of the half vector to the normal and to `out`, and of the directions."""
    half = out + directions
    half = half / np.linalg.norm(half, axis=-1, keepdims=True)
    return half[..., 2], np.sum(half * out, axis=-1), directions[..., 2]


def integral(function, cosine):
    """Over all directions: function(cos_half, cos_facet, cos_out, cos_in) times the cosine."""
    directions, weights = ALL_IN
    out = np.array([np.sqrt(max(0.0, 1.0 - cosine ** 2)), 0.0, cosine])
    half, facet, cos_in = angles_of(out, directions)
    return function(half, facet, cosine, cos_in) @ weights


class Albedo:
    """Albedo of facets that reflect all, and of those that reflect Schlick's term alone."""

    def __init__(self, roughness):
        def whole(half, facet, out, cos_in):
            value = facets(half, out, cos_in, roughness)
            return np.stack([value, value * schlick(facet)])
        found = np.array([integral(whole, cosine) for cosine in COSINES])
        self.planes = [lambda c, v=found[:, p]: np.interp(c, COSINES, v) for p in range(2)]
        nodes, weights = np.polynomial.legendre.leggauss(32)
        means = 0.5 * (nodes + 1.0)
        self.mean = [float((weights * means) @ plane(means)) for plane in self.planes]


def again(f0, f90, mean):
    """Part of the light that no single facet lets go which the others do (Kulla & Conty)."""
    reflected = f0 + (f90 - f0) / 21.0
    return reflected ** 2 * mean / (1.0 - reflected * (1.0 - mean))


class Surface:
    """The BSDF of one surface."""

    def __init__(self, s):
        self.s = s
        self.albedo = Albedo(s["roughness"])
        self.coat = Albedo(s["coat_roughness"]) if s["coat"] > 0.0 else None
        self.sheen = None
        if s["sheen"].max() > 0.0:
            found = [integral(lambda half, _, out, cos_in: fibres(
                half, out, cos_in, s["sheen_roughness"]), c) for c in COSINES]
            self.sheen = lambda c: np.interp(c, COSINES, found)

    def dielectric(self, all_of_it, grazing):
        s = self.s
        repeated = again(s["f0"], s["f90"], self.albedo.mean[0])
        return (s["f0"] * all_of_it + (s["f90"] - s["f0"]) * grazing
                + repeated * (1.0 - all_of_it))

    def base(self, out, cos_in):
        """What is under the facets of a dielectric, by its colour."""
        of = [self.dielectric(*[plane(c) for plane in self.albedo.planes]) for c in (out, cos_in)]
        return (1.0 - of[0]) * (1.0 - of[1]) / (np.pi * (1.0 - self.dielectric(*self.albedo.mean)))

    def value(self, half, facet, out, cos_in):
        """Per colour (first axis)."""
        s, (all_of_it, _), mean = self.s, self.albedo.planes, self.albedo.mean[0]
        once = facets(half, out, cos_in, s["roughness"])
        lost = (1.0 - all_of_it(out)) * (1.0 - all_of_it(cos_in)) / (np.pi * (1.0 - mean))
        values, below = [], 1.0
        coat = sheen = 0.0
        if self.coat is not None:
            reflected = COAT_F0 + (1.0 - COAT_F0) * schlick(facet)
            coat = s["coat"] * facets(half, out, cos_in, s["coat_roughness"]) * reflected
            below = 1.0 - s["coat"] * (COAT_F0 * self.coat.planes[0](out)
                                       + (1.0 - COAT_F0) * self.coat.planes[1](out))
        if self.sheen is not None:
            of = self.sheen(out)
            sheen = (below / np.maximum(of, 1.0)) * fibres(half, out, cos_in, s["sheen_roughness"])
            below = below * (1.0 - s["sheen"].max() * np.minimum(of, 1.0))
        for colour, tint in zip(s["colour"], s["sheen"]):
            metal = colour + (1.0 - colour) * schlick(facet)
            of_metal = once * metal + lost * again(colour, 1.0, mean)
            fresnel = s["f0"] + (s["f90"] - s["f0"]) * schlick(facet)
            of_rest = (once * fresnel + lost * again(s["f0"], s["f90"], mean)
                       + colour * self.base(out, cos_in))
            under = s["metal"] * of_metal + (1.0 - s["metal"]) * of_rest
            values.append(below * under + coat + tint * sheen)
        return np.stack(values)


# ----- The picture that the formulas ask for

def points_on_plane(cuts=12):
    """Where rays through cuts x cuts places of each pixel meet the plane y = 0, and the directions
    to the eye."""
    ahead = (TARGET - EYE) / np.linalg.norm(TARGET - EYE)
    right = np.cross(ahead, [0.0, 1.0, 0.0])
    right /= np.linalg.norm(right)
    up = np.cross(right, ahead)
    steps = ((np.arange(SIZE * cuts) + 0.5) / (SIZE * cuts) - 0.5) * 2.0 * np.tan(
        np.radians(FOV) / 2.0)
    rays = ahead + steps[None, :, None] * right - steps[:, None, None] * up
    points = EYE - rays * (EYE[1] / rays[..., 1])[..., None]
    out = EYE - points
    return points, out / np.linalg.norm(out, axis=-1, keepdims=True)


def pixels_of(values):
    cuts = values.shape[1] // SIZE
    return values.reshape(3, SIZE, cuts, SIZE, cuts).mean(axis=(2, 4)).transpose(1, 2, 0)


def upright(directions):
    """The normal, +Y, as last axis."""
    return directions[..., [2, 0, 1]]


def under_the_lamp(surface):
    points, out = points_on_plane()
    towards = LAMP - points
    distance = np.linalg.norm(towards, axis=-1)
    directions = upright(towards / distance[..., None])
    half, facet, cos_in = angles_of(upright(out), directions)
    return pixels_of(surface.value(half, facet, out[..., 1], cos_in)
                     * INTENSITY * cos_in / distance ** 2)


def under_the_sky(surface):
    def light(half, facet, out, cos_in):
        return surface.value(half, facet, out, cos_in) * (
            cos_in * ZENITH + (1.0 - cos_in) * HORIZON)
    seen = np.linspace(0.15, 1.0, 40)
    found = np.array([integral(light, cosine) for cosine in seen])
    _, out = points_on_plane(4)
    return pixels_of(np.stack([np.interp(out[..., 1], seen, found[:, c]) for c in range(3)]))


# ----- The picture of clshear

def write_plane(path, s):
    corners = np.array([[-60, 0, 60], [60, 0, 60], [60, 0, -60], [-60, 0, -60]], dtype=np.float32)
    data = corners.tobytes() + np.array([0, 1, 2, 0, 2, 3], dtype=np.uint16).tobytes()
    index = (1.0 + np.sqrt(s["f0"] / max(s["f90"], 1e-9))) / (1.0 - np.sqrt(
        s["f0"] / max(s["f90"], 1e-9)))
    extensions = {"ior": {"ior": index if s["f90"] > 0.0 else 1.5},
                  "specular": {"specularFactor": s["f90"]}}
    if s["coat"] > 0.0:
        extensions["clearcoat"] = {"clearcoatFactor": s["coat"],
                                   "clearcoatRoughnessFactor": s["coat_roughness"]}
    if s["sheen"].max() > 0.0:
        extensions["sheen"] = {"sheenColorFactor": s["sheen"].tolist(),
                               "sheenRoughnessFactor": s["sheen_roughness"]}
    material = {"pbrMetallicRoughness": {
        "baseColorFactor": [*s["colour"].tolist(), 1.0], "metallicFactor": s["metal"],
        "roughnessFactor": s["roughness"]},
        "extensions": {"KHR_materials_" + name: value for name, value in extensions.items()}}
    path.write_text(json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "materials": [material],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 4,
                       "min": corners.min(axis=0).tolist(), "max": corners.max(axis=0).tolist()},
                      {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": 6}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
                        {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
        "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,"
                     + base64.b64encode(data).decode()}]}))


def planes_of(picture):
    """Pixels and the variance of their values."""
    def tool(*words):
        return subprocess.run(["oiiotool", *words, picture], check=True, capture_output=True,
                              text=True).stdout

    names = re.search("channel list: (.*)", tool("--info", "-v")).group(1).split(", ")
    rows = [line.split(":")[1].split() for line in tool("--dumpdata").splitlines()
            if "Pixel (" in line]
    values = np.array(rows, dtype=float).reshape(SIZE, SIZE, len(names))
    return (values[..., [names.index(c) for c in "RGB"]],
            values[..., [names.index("Variance." + c) for c in "RGB"]])


def render(options, folder, s, light, spp):
    scene, picture = folder / "plane.gltf", folder / "plane.exr"
    write_plane(scene, s)

    def joined(numbers):
        return ",".join(f"{number:g}" for number in numbers)

    command = [options.program, scene, *light, "--eye", joined(EYE), "--target", joined(TARGET),
               "--up", "0,1,0", "--fov", FOV, "--lens-radius", 0, "--focal-distance", 3,
               "--width", SIZE, "--height", SIZE, "--bounces", 0, "--spp", spp, "--replicates", REPLICATES,
               "--seed", 5, "--quiet", "--out", picture]
    subprocess.run([str(word) for word in command], check=True)
    return planes_of(picture)


def judge(name, light, ours, variance, wanted):
    """Prints a row; whether all pixels agree."""
    noise = np.sqrt(variance)
    off = abs(ours - wanted)
    same = off <= MOST_DEVIATIONS * noise + MOST_OF_TABLES * wanted
    # The mean over pixels, whose colours are one draw; beyond six deviations never by chance.
    of_mean = np.sqrt(variance.mean(axis=2).sum()) / SIZE ** 2
    same &= abs(ours.mean() - wanted.mean()) <= 6 * of_mean + 0.5 * MOST_OF_TABLES * wanted.mean()
    print(f"| {name} | {light} | {ours.mean():.5f} | {wanted.mean():.5f} | "
          f"{(ours.mean() / wanted.mean() - 1.0):+.2%} | {(off / wanted).max():.2%} | "
          f"{'agrees' if same.all() else 'DIFFERS'} |", flush=True)
    return same.all()


def main():
    """Exits with 1 if a surface differs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default=str(ROOT / "build" / "clshear"))
    parser.add_argument("--surface", action="append", choices=SURFACES)
    parser.add_argument("--quick", action="store_true", help="four surfaces, fewer samples")
    options = parser.parse_args()
    joined = ",".join
    lights = {"lamp": (["--light", joined(map(str, [*LAMP, *[INTENSITY] * 3]))], under_the_lamp),
              "sky": (["--environment",
                       "gradient:" + joined([str(ZENITH)] * 3 + [str(HORIZON)] * 3)],
                      under_the_sky)}
    print("| surface | light | mean of clshear | of the formulas | apart | largest of a pixel | |\n"
          "|---|---|---|---|---|---|---|")
    same = True
    with tempfile.TemporaryDirectory() as folder:
        for name in options.surface or (QUICK if options.quick else SURFACES):
            surface = Surface(SURFACES[name])
            for word, (flags, formula) in lights.items():
                ours, variance = render(options, pathlib.Path(folder), SURFACES[name], flags,
                                        (QUICK_SPP if options.quick else SPP)[word])
                same &= judge(name, word, ours, variance, formula(surface))
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
