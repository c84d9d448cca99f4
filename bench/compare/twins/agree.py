"""Compares pictures of clshear with those of Mitsuba 3, scene by scene, and prints a table.

Each scene is written as glTF for clshear and described to Mitsuba: the same triangles, camera, lens,
lights, and surfaces of the same formulas. scripts/agreement installs what this needs and runs it.

Criterion: z of each pixel and colour by the errors that both renderers' 16 independent renders have.
If the pictures agree, z is Student-like with 15 to 30 degrees of freedom, of which mean |z| is 0.82
and the deviation at most 1.1.
"""
import argparse
import math
import pathlib
import sys
import tempfile

import mitsuba as mi

mi.set_variant("scalar_rgb")
mi.set_log_level(mi.LogLevel.Error)

import numpy as np

from renderers import FACETS_OF_MITSUBA, load_mitsuba, run_clshear
from scenes import scenes

HEAD = ("| scene | mean of \\|z\\| | mean z | beyond 3 | pixels with noise | mean of clshear | "
        "of Mitsuba | |\n|---|---|---|---|---|---|---|---|")
ROOT = pathlib.Path(__file__).resolve().parents[3]
REPLICATES = 16
# |z| has a deviation of 0.62, its mean over pixels a seventh of the distance from 0.82.
MOST_MEAN_SIZE = 0.9
# The mean of z over pixels goes beyond five of its deviations once in 1.7 million comparisons.
MOST_MEAN_DEVIATIONS = 5 * 1.1
# Some pixels are free of noise, such as a floor in full view of one directional light. Their
# replicates differ by the rounding of float32 (6e-8) in some 20 steps, which differs between the
# programs but not between renders, and z would be of that. Below 1e-5 of the value, values are
# compared themselves, within ten times as much.
LEAST_NOISE, MOST_ROUNDING = 1e-5, 1e-4


def of_clshear(options, folder, name, scene):
    """Pixels and the variance of their values."""
    flags = ["--spp", options.spp, "--replicates", REPLICATES, "--seed", 11]
    planes, _ = run_clshear(options, folder, name, scene, flags, FACETS_OF_MITSUBA)
    return (np.stack([planes[c] for c in "RGB"], axis=-1),
            np.stack([planes["Variance." + c] for c in "RGB"], axis=-1))


def of_mitsuba(options, scene):
    """The same, from renders with different seeds."""
    spp = options.spp // REPLICATES
    # "path" plays roulette for all of a path's throughput, which is rare noise.
    world, integrator = load_mitsuba(options, scene, spp, rr_depth=1000)
    stack = np.stack([np.array(mi.render(world, integrator=integrator, seed=100 + seed, spp=spp),
                               dtype=np.float64)[:, :, :3] for seed in range(REPLICATES)])
    return stack.mean(axis=0), stack.var(axis=0, ddof=1) / REPLICATES


def keep(folder, name, ours, theirs):
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    for word, image in (("ours", ours), ("theirs", theirs)):
        mi.Bitmap(image.astype(np.float32)).convert(
            mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, True).write(
                str(pathlib.Path(folder) / f"{name}-{word}.png"))


def row(options, name, ours, theirs):
    """Prints a row of the table, of (picture, variance of its values) each; whether they agree."""
    (ours, variance), (theirs, spread) = ours, theirs
    if options.keep:
        keep(options.keep, name, ours, theirs)
    noise = np.sqrt(variance + spread)
    seen = noise > LEAST_NOISE * abs(theirs)
    z = (ours - theirs)[seen] / noise[seen]
    pixels = len(z) / 3  # the colours of a pixel are one draw
    mean, size = z.mean(), abs(z).mean()
    same = size < MOST_MEAN_SIZE and abs(mean) < MOST_MEAN_DEVIATIONS / math.sqrt(pixels)
    same = same and np.allclose(ours[~seen], theirs[~seen], rtol=MOST_ROUNDING, atol=1e-6)
    print(f"| {name} | {size:.3f} | {mean:+.4f} | {(abs(z) > 3).mean():.2%} | {seen.mean():.0%} | "
          f"{ours.mean():.5f} | {theirs.mean():.5f} | {'agrees' if same else 'DIFFERS'} |",
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
        known = scenes(pathlib.Path(folder))
        unknown = set(options.scene or []) - set(known)
        if unknown:
            parser.error(f"no scene {', '.join(sorted(unknown))}; there are {', '.join(known)}")
        print(HEAD, flush=True)
        results = [row(options, name, of_clshear(options, pathlib.Path(folder), name, scene),
                       of_mitsuba(options, scene))
                   for name, scene in known.items() if name in (options.scene or known)]
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
