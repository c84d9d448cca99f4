"""Compares clshear with Mitsuba 3 on the same scenes: agreement, speed and noise.

Renders an OBJ with the camera, lens and point light that clshear reads from the .flags file beside
it, with clshear and with Mitsuba (llvm_ad_rgb, thin lens, direct light only), and prints Markdown
tables. bench/compare/mitsuba.sh installs what this needs and runs it.

Terms: a pixel's value is its mean radiance; a render's variance is that of a pixel's value across
seeds, averaged over pixels and colours (the MSE of the image, as both renderers are unbiased).
"""
import argparse
import json
import math
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

from flags import read_flags
from spheres import write_spheres

# This file is called like the package, which must not find it first.
HERE = pathlib.Path(__file__).resolve().parent
sys.path[:] = [folder for folder in sys.path if pathlib.Path(folder).resolve() != HERE]

import drjit as dr
import mitsuba as mi
import numpy as np

mi.set_variant("llvm_ad_rgb")
mi.set_log_level(mi.LogLevel.Error)
sys.path.append(str(HERE / "twins"))

from mitsuba_scene import make_sensor

SAMPLERS = ["independent", "stratified", "multijitter", "orthogonal", "ldsampler"]
CLSHEAR_SPP = [16, 32, 64, 128, 256, 512, 1024]
CLSHEAR_SETTINGS = {"default": [], "--adaptive": ["--adaptive"]}

# "path" with two vertices also traces the ray of a BSDF sample, which never meets a point light;
# "direct" without BSDF samples traces what clshear does: a camera ray and a shadow ray.
INTEGRATORS = {
    "path": {"type": "path", "max_depth": 2},
    "direct": {"type": "direct", "emitter_samples": 1, "bsdf_samples": 0},
}

# --- The scene in Mitsuba's terms ---


def read_mtl(path):
    """Materials by name: words of each line by keyword."""
    materials, current = {}, None
    for words in map(str.split, path.read_text().splitlines()):
        if words and words[0] == "newmtl":
            current = materials.setdefault(words[1], {})
        elif words and current is not None:
            current[words[0]] = words[1:]
    return materials


def read_obj(path):
    """Positions, texture coordinates, materials, and by material the corners of its triangles as
    (position, texture coordinate) indices. Only what the scenes here use: no normals, no negative
    indices. Quads are cut as Assimp cuts them, which matters for the texture."""
    positions, coordinates, corners, materials, current = [], [(0.0, 0.0)], {}, {}, None
    for words in map(str.split, path.read_text().splitlines()):
        if not words or words[0] not in ("v", "vt", "f", "usemtl", "mtllib"):
            continue
        if words[0] == "v":
            positions.append([float(word) for word in words[1:4]])
        elif words[0] == "vt":
            coordinates.append([float(word) for word in words[1:3]])
        elif words[0] == "mtllib":
            materials = read_mtl(path.parent / words[1])
        elif words[0] == "usemtl":
            current = corners.setdefault(words[1], [])
        else:
            face = [([int(i) for i in word.split("/")] + [0])[:2] for word in words[1:]]
            for i in range(1, len(face) - 1):
                current += [face[0], face[i], face[i + 1]]
    return np.array(positions), np.array(coordinates), corners, materials


def reflectance(material, folder):
    """clshear multiplies Kd by the texture, whose texels are linear and rounded to half floats.
    Row 0 of Mitsuba's images is at texture coordinate 0, that of clshear's at 1."""
    diffuse = np.array([float(word) for word in material["Kd"]])
    if "map_Kd" not in material:
        return {"type": "rgb", "value": diffuse.tolist()}
    coded = np.array(mi.Bitmap(str(folder / material["map_Kd"][0]))) / 255.0
    linear = np.where(coded <= 0.04045, coded / 12.92, ((coded + 0.055) / 1.055) ** 2.4)
    texels = linear.reshape(*linear.shape[:2], -1).astype(np.float16)[::-1]
    return {"type": "bitmap", "bitmap": mi.Bitmap((texels * diffuse).astype(np.float32)),
            "raw": True, "filter_type": "bilinear", "wrap_mode": "repeat"}


def make_mesh(name, positions, coordinates, corners, bsdf):
    """A mesh without normals: faces are flat."""
    used, indices = np.unique(np.array(corners), axis=0, return_inverse=True)
    properties = mi.Properties()
    properties["bsdf"] = bsdf
    mesh = mi.Mesh(name, len(used), len(corners) // 3, has_vertex_normals=False,
                   has_vertex_texcoords=True, props=properties)
    parameters = mi.traverse(mesh)
    parameters["vertex_positions"] = mi.Float(positions[used[:, 0] - 1].ravel())
    parameters["vertex_texcoords"] = mi.Float(coordinates[used[:, 1]].ravel())
    parameters["faces"] = mi.UInt32(indices.ravel())
    parameters.update()
    return mesh


class World:
    """A scene as both renderers have it."""

    def __init__(self, path, options):
        positions, coordinates, corners, materials = read_obj(path)
        self.path, self.options, self.sensors = path, options, {}
        self.flags = read_flags(path.with_suffix(".flags"))
        self.triangles = sum(map(len, corners.values())) // 3
        content = {"type": "scene"}
        for name, used in corners.items():
            bsdf = mi.load_dict({"type": "twosided", "nested": {
                "type": "diffuse", "reflectance": reflectance(materials[name], path.parent)}})
            content[name] = make_mesh(name, positions, coordinates, used, bsdf)
        for i, light in enumerate(self.flags["light"]):
            content[f"light{i}"] = {"type": "point", "position": light[:3],
                                    "intensity": {"type": "rgb", "value": light[3:]}}
        self.scene = mi.load_dict(content)
        self.integrators = {name: mi.load_dict(what) for name, what in INTEGRATORS.items()}

    def mitsuba(self, sampler, seed, integrator=None):
        """The pixels, how long they took, and the samples per pixel that the sampler made of it."""
        if sampler not in self.sensors:
            self.sensors[sampler] = make_sensor(self.flags, self.options.size,
                                                self.options.size, sampler)
        sensor = self.sensors[sampler]
        dr.sync_thread()
        start = time.perf_counter()
        image = mi.render(self.scene, sensor=sensor, spp=self.options.spp, seed=seed,
                          integrator=self.integrators[integrator or self.options.integrator])
        dr.eval(image)
        dr.sync_thread()
        seconds = time.perf_counter() - start
        return np.array(image)[:, :, :3], seconds, sensor.sampler().sample_count()

    def clshear(self, spp, seed, *flags):
        """The pixels, the variance of their values if there is one, seconds of the render (depths
        and pilot included, loading and compiling not), and samples per second of the kernels."""
        with tempfile.NamedTemporaryFile(suffix=".exr") as file:
            command = [self.options.program, self.path, "--aperture", "disk", "--width",
                       self.options.size, "--height", self.options.size, "--spp", spp, "--seed",
                       seed, *flags, "--quiet", "--stats", "--out", file.name]
            stats = subprocess.run([str(word) for word in command], check=True, text=True,
                                   stdout=subprocess.PIPE).stdout
            bitmap = mi.Bitmap(file.name)
        # The order of channels is the reader's; it is not that of the file.
        place = {field.name: i for i, field in enumerate(bitmap.struct_())}
        planes = np.array(bitmap)
        pixels = planes[:, :, [place[c] for c in "RGB"]]
        variance = (planes[:, :, [place["Variance." + c] for c in "RGB"]]
                    if "Variance.R" in place else None)
        rate = float(re.search(r"^samples .* ([\d.]+) M/s", stats, re.M)[1]) * 1e6
        # The seconds that --stats prints, with more digits.
        return pixels, variance, float(bitmap.metadata()["renderTimeSeconds"]), rate


# --- What is measured ---


def moments(images):
    """Mean image, and the variance of one, from renders with different seeds."""
    stack = np.stack(images).astype(np.float64)
    return stack.mean(axis=0), stack.var(axis=0, ddof=1)


def agreement(world):
    """z of every pixel's green: clshear's variance is of 16 replicates, Mitsuba's of its seeds.

    If both render the same, z is Student-like with at least 15 degrees of freedom, of deviation at
    most 1.1, so that its mean over P pixels has the deviation 1.1 / sqrt(P): beyond five of them
    once in 1.7 million comparisons. A deviation above 1.3 means differences of single pixels."""
    pixels, variance, _, _ = world.clshear(16 * world.options.spp, 101, "--replicates", 16)
    seeds = [world.mitsuba("multijitter", 1000 + seed)[0]
             for seed in range(max(16, world.options.seeds))]
    mean, spread = moments(seeds)
    error = variance[:, :, 1] + spread[:, :, 1] / len(seeds)
    seen = error > 0
    z = (pixels[:, :, 1] - mean[:, :, 1])[seen] / np.sqrt(error[seen])
    result = {"pixels": int(seen.sum()), "mean_z": float(z.mean()), "deviation_z": float(z.std()),
              "beyond_3": float((abs(z) > 3).mean())}
    result["agree"] = bool(abs(result["mean_z"]) < 5 * 1.1 / math.sqrt(len(z)) and
                           result["deviation_z"] < 1.3)
    return result


def speed(world):
    """Samples per second of both, rounds interleaved, and the median of the rounds' ratios."""
    world.mitsuba("independent", 0)
    rates, ratios = ([], []), {name: [] for name in INTEGRATORS}
    for seed in range(world.options.rounds):
        ours = world.clshear(world.options.spp, seed)[3]
        rates[0].append(ours)
        for name in INTEGRATORS:
            world.mitsuba("independent", seed, name)
            _, seconds, spp = world.mitsuba("independent", seed + 50, name)
            theirs = spp * world.options.size ** 2 / seconds
            ratios[name].append(ours / theirs)
            if name == world.options.integrator:
                rates[1].append(theirs)
    result = {"clshear": statistics.median(rates[0]), "mitsuba": statistics.median(rates[1])}
    result.update({"ratio_" + name: statistics.median(all_of) for name, all_of in ratios.items()})
    return result


def noise(world):
    """MSE and seconds of whole renders, in turn: of Mitsuba by sampler, of clshear by its settings
    and samples per pixel. Samplers that refuse are told of and left out.

    clshear spends its samples on one pattern, as Mitsuba does: neither gives an error estimate."""
    theirs, ours = {}, {}
    for sampler in SAMPLERS:
        try:
            world.mitsuba(sampler, 0)
            theirs[sampler] = []
        except RuntimeError as error:
            print(f"{sampler}: {str(error).splitlines()[0]}", file=sys.stderr)
    for seed in range(world.options.seeds):
        for sampler, renders in theirs.items():
            renders.append(world.mitsuba(sampler, seed))
        for setting, flags in CLSHEAR_SETTINGS.items():
            for spp in CLSHEAR_SPP:
                image, _, seconds, _ = world.clshear(spp, seed, "--replicates", 1, *flags)
                ours.setdefault((setting, spp), []).append((image, seconds, spp))

    def summary(renders):
        return {"mse": float(moments([r[0] for r in renders])[1].mean()),
                "seconds": statistics.median(r[1] for r in renders), "spp": renders[0][2]}

    by_setting = {setting: {spp: summary(ours[setting, spp]) for spp in CLSHEAR_SPP}
                  for setting in CLSHEAR_SETTINGS}
    return {sampler: summary(renders) for sampler, renders in theirs.items()}, by_setting


def seconds_to_reach(mse, renders):
    """Seconds that clshear needs, between its own renders on a line in logarithms; and whether that
    is exact, or less because its smallest render is better already. None: beyond the largest."""
    points = sorted((r["seconds"], r["mse"]) for r in renders.values())
    if points[0][1] <= mse:
        return points[0][0], False
    for (fast, coarse), (slow, fine) in zip(points, points[1:]):
        if fine <= mse:
            part = math.log(coarse / mse) / math.log(coarse / fine)
            return fast * (slow / fast) ** part, True
    return None, False


# --- Tables ---


def print_noise(theirs, ours):
    """Times to the same noise, which are added to what is known of Mitsuba, and what they are of."""
    settings = list(CLSHEAR_SETTINGS)
    print("| Mitsuba's sampler | samples | MSE | seconds | clshear gets there in | times faster | "
          + " | ".join(f"{setting} | times faster" for setting in settings[1:]) + " |\n"
          + "|---" * (4 + 2 * len(settings)) + "|")
    for sampler, reached in theirs.items():
        line = (f"| {sampler} | {reached['spp']} | {reached['mse']:.2e} | "
                f"{reached['seconds']:.2f} |")
        for setting in settings:
            seconds, exact = seconds_to_reach(reached["mse"], ours[setting])
            reached[setting] = {"seconds": seconds, "exact": exact}
            if seconds is None:
                line += " - | - |"
                continue
            reached[setting]["times"] = times = reached["seconds"] / seconds
            sign = ("", "") if exact else ("less than ", "more than ")
            line += f" {sign[0]}{seconds:.4f} | {sign[1]}{times:.0f} |"
        print(line)
    print("\n| clshear, samples |" + "".join(f" {setting}: MSE | seconds |" for setting in settings)
          + "\n|---" + "|---" * (2 * len(settings)) + "|")
    for spp in CLSHEAR_SPP:
        print(f"| {spp} |" + "".join(f" {ours[setting][spp]['mse']:.2e} | "
                                     f"{ours[setting][spp]['seconds']:.4f} |"
                                     for setting in settings))


def study(world, name):
    """Everything about one scene, printed as it comes."""
    print(f"\n### {name}, {world.triangles} triangles, {world.options.size} x "
          f"{world.options.size} pixels\n")
    same = agreement(world)
    print("Pictures {}: z of {pixels} pixels has mean {mean_z:.4f}, deviation {deviation_z:.3f}; "
          "{:.2%} beyond 3\n".format("agree" if same["agree"] else "DIFFER", same["beyond_3"],
                                     **same))
    rates = speed(world)
    print("| | M samples/s | clshear is faster than path, than direct |\n|---|---|---|")
    print(f"| clshear | {rates['clshear'] / 1e6:.1f} | |\n| Mitsuba, {world.options.integrator} | "
          f"{rates['mitsuba'] / 1e6:.2f} | {rates['ratio_path']:.1f}, "
          f"{rates['ratio_direct']:.1f} |\n")
    theirs, ours = noise(world)
    print_noise(theirs, ours)
    return {"scene": name, "triangles": world.triangles, "agreement": same, "speed": rates,
            "mitsuba": theirs, "clshear": ours}


def main():
    """Reads the flags, studies the scenes, writes JSON; exits with 1 if pictures differ."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=128, help="pixels along a side")
    parser.add_argument("--seeds", type=int, default=16, help="renders whose variance is taken")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--spp", type=int, default=1024, help="of Mitsuba's renders")
    parser.add_argument("--integrator", choices=INTEGRATORS, default="path")
    parser.add_argument("--quick", action="store_true", help="only sees whether all works")
    parser.add_argument("--scene", choices=["cornell", "spheres"], help="only this one")
    parser.add_argument("--out", help="results as JSON")
    parser.add_argument("--program", default=str(HERE.parent.parent / "build" / "clshear"))
    options = parser.parse_args()
    if options.quick:
        options.size, options.seeds, options.rounds, options.spp = 32, 4, 1, 64
    with tempfile.TemporaryDirectory() as folder:
        scenes = {"cornell": HERE.parent.parent / "scenes" / "cornell.obj",
                  "spheres": write_spheres(pathlib.Path(folder))}
        results = [study(World(path, options), name) for name, path in scenes.items()
                   if options.scene in (None, name)]
    if options.out:
        pathlib.Path(options.out).write_text(json.dumps(results, indent=1) + "\n")
    return 0 if all(result["agreement"]["agree"] for result in results) else 1


if __name__ == "__main__":
    sys.exit(main())
