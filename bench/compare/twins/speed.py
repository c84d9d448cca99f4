"""Samples per second of processor time: clshear against Mitsuba's `path` (llvm_ad_rgb), on scenes
with GGX facets, an environment and four bounces. Prints a table.

bench/compare/mitsuba.sh installs what this needs and runs it:
bench/compare/mitsuba.sh bench/compare/twins/speed.py [--size PIXELS] [--spp N] [--rounds N]

Processor time, summed over threads, says more than the clock on a machine that others use. Rounds
are interleaved; a ratio is the median of theirs. Both times are the difference between a render with
all samples and one with an eighth of them, so that loading and compiling are not counted. Each
renderer has its own defaults: its sampler, its roulette, and clshear's light between facets; but
clshear draws as many samples in each pixel, as Mitsuba does, since those that are shared out go
where samples cost more.
"""
import argparse
import pathlib
import statistics
import sys
import tempfile
import time

import mitsuba as mi

mi.set_variant("llvm_ad_rgb")
mi.set_log_level(mi.LogLevel.Error)

import drjit as dr

from renderers import load_mitsuba, run_clshear
from scenes import showcase

ROOT = pathlib.Path(__file__).resolve().parents[3]


def of_clshear(options, folder, name, scene, spp, seed):
    flags = ["--spp", spp, "--seed", seed, "--adaptive=0"]
    return run_clshear(options, folder, name, scene, flags, {})[1]


def of_mitsuba(world, integrator, spp, seed):
    dr.sync_thread()
    start = time.process_time()
    dr.eval(mi.render(world, integrator=integrator, spp=spp, seed=seed))
    dr.sync_thread()
    return time.process_time() - start


def compare(options, folder, name, scene):
    """Prints the scene's row; the ratio of its rates."""
    few = options.spp // 8
    world, integrator = load_mitsuba(options, scene, options.spp)
    for spp in (few, options.spp):  # compiles
        of_clshear(options, folder, name, scene, spp, 0)
        of_mitsuba(world, integrator, spp, 0)
    samples, ours, theirs = (options.spp - few) * options.size ** 2, [], []
    for seed in range(1, options.rounds + 1):
        ours.append(samples / (of_clshear(options, folder, name, scene, options.spp, seed)
                               - of_clshear(options, folder, name, scene, few, seed)))
        theirs.append(samples / (of_mitsuba(world, integrator, options.spp, seed)
                                 - of_mitsuba(world, integrator, few, seed)))
    ratios = [mine / other for mine, other in zip(ours, theirs)]
    triangles = sum(len(triangles) for (_, triangles, _), _ in scene[0])
    print(f"| {name} | {triangles} | {statistics.median(ours) / 1e6:.2f} | "
          f"{statistics.median(theirs) / 1e6:.2f} | {statistics.median(ratios):.2f} "
          f"({min(ratios):.2f} … {max(ratios):.2f}) |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--size", type=int, default=128, help="pixels along a side")
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--scene", action="append", help="only this one; may be repeated")
    parser.add_argument("--program", default=str(ROOT / "build" / "clshear"))
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        print("| scene | triangles | clshear, M samples per second of processor time | Mitsuba | "
              "ratio |\n|---|---|---|---|---|", flush=True)
        for name, scene in showcase(pathlib.Path(folder)).items():
            if name in (options.scene or [name]):
                compare(options, pathlib.Path(folder), name, scene)
    return 0


if __name__ == "__main__":
    sys.exit(main())
