"""The time that clshear's default needs for the error that Mitsuba's best sampler has at 1024
samples, on twins of the scenes of DoF-20: a row of a table for each scene.

bench/compare/mitsuba.sh bench/dof20/against_mitsuba.py [SCENE]... [--seeds N] [--keep FOLDER]

bench/compare/mitsuba.sh installs what this needs; bench/dof20/fetch gets the scenes. Scenes that
Mitsuba's twin (bench/compare/twins/mitsuba_scene.py) would lack something of are left out, with a
line that names it. Both have a disk for aperture, a box for filter, and the same bounces.

Errors are root mean squares over pixels and colours, relative to the picture's mean: of Mitsuba by
the variance across seeds, of clshear against a reference of its own (bench_dof20). CPU time is that
of all threads while a picture is rendered, clshear's prepass and pilots included; loading and
compiling are not counted. Between numbers of samples, and beyond 1024, logarithms are linear.
"""
import argparse
import csv
import math
import pathlib
import re
import statistics
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path += [str(ROOT / "bench" / "compare"), str(ROOT / "bench" / "compare" / "twins")]

import drjit as dr  # noqa: E402
import mitsuba as mi  # noqa: E402
import numpy as np  # noqa: E402

mi.set_variant("llvm_ad_rgb")
mi.set_log_level(mi.LogLevel.Error)

import mitsuba_scene  # noqa: E402
from flags import read_flags  # noqa: E402

SAMPLERS = ["independent", "stratified", "multijitter", "orthogonal", "ldsampler"]
WIDTH, HEIGHT = 120, 90
COUNTS = [16, 64, 256, 1024]
HEAD = """| scene | Mitsuba's best sampler | error | CPU s | clshear: samples | CPU s | times shorter | error of 1024 samples | CPU s | Mitsuba's CPU s for it | times shorter | mean over Mitsuba's |
|---|---|---|---|---|---|---|---|---|---|---|---|"""


def scenes():
    """Names and model files."""
    lines = (HERE / "scenes.txt").read_text().splitlines()
    return {line.split()[0]: line.split()[2] for line in lines if line and line[0] != "#"}


def twin_settings(name, folder):
    """A settings file for both: that of the scene, without its filter and aperture."""
    own = HERE / "scenes" / f"{name}.flags"
    text = (own if own.exists() else ROOT / "scenes" / f"{name}.flags").read_text()
    path = folder / f"{name}.flags"
    path.write_text(re.sub(r"^--(filter|aperture|blades|blade-rotation) .*\n", "", text,
                           flags=re.M) + "--aperture disk\n")
    return path


class Point:
    """A number of samples, its relative error and CPU seconds."""

    def __init__(self, samples, error, seconds):
        self.samples, self.error, self.seconds = samples, error, seconds


def at(points, error, name):
    """A quantity where the error is reached, by the line through the logarithms of the two points
    around it, or of the nearest two."""
    after = next((i for i, point in enumerate(points) if point.error <= error), len(points) - 1)
    low, high = points[max(after, 1) - 1], points[max(after, 1)]
    slope = math.log(getattr(high, name) / getattr(low, name)) / math.log(high.error / low.error)
    return getattr(high, name) * (error / high.error) ** slope


class Mitsuba:
    def __init__(self, options, name, settings):
        flags = read_flags(settings)
        del flags["aperture"]
        self.options, self.flags, self.name = options, flags, name
        self.scene, self.integrator = mitsuba_scene.build(
            str(pathlib.Path(options.program).with_name("clshear-import")),
            str(options.models / scenes()[name]), flags)

    def render(self, sensor, seed):
        """The picture, and CPU seconds."""
        dr.sync_thread()
        start = time.process_time()
        image = mi.render(self.scene, sensor=sensor, integrator=self.integrator, seed=seed,
                          spp=sensor.sampler().sample_count())
        dr.eval(image)
        dr.sync_thread()
        return np.array(image)[:, :, :3].astype(np.float64), time.process_time() - start

    def measure(self, sampler, samples):
        """The point of one sampler, and the mean picture."""
        sensor = mitsuba_scene.make_sensor(self.flags, WIDTH, HEIGHT, sampler)
        sensor.sampler().set_sample_count(samples)
        self.render(sensor, 0)  # compiles
        pictures, seconds = zip(*(self.render(sensor, 1 + seed)
                                  for seed in range(self.options.seeds)))
        mean = np.mean(pictures, axis=0)
        error = math.sqrt(np.var(pictures, axis=0, ddof=1).mean()) / mean.mean()
        return Point(sensor.sampler().sample_count(), error, statistics.median(seconds)), mean

    def best(self):
        """The name of the sampler with the least error at 1024 samples, its points at 256 and 1024,
        and its picture."""
        found = {sampler: self.measure(sampler, COUNTS[-1]) for sampler in SAMPLERS}
        name = min(found, key=lambda sampler: found[sampler][0].error)
        point, picture = found[name]
        return name, [self.measure(name, COUNTS[-2])[0], point], picture


def of_clshear(options, name, settings, folder):
    """Points of the default, shared out from 16 samples on, and the picture's mean."""
    rows = folder / f"{name}.csv"
    if not rows.exists():
        rows.write_text("scene,method,samples,seed,mse,relative,cpu_s,variance,mean\n")
    subprocess.run([options.bench, "--name", name, "--model", options.models / scenes()[name],
                    "--settings", settings, "--reference", folder / f"{name}.exr", "--csv", rows,
                    "--methods", "adaptive", "--samples", ",".join(map(str, COUNTS)), "--seeds",
                    str(options.seeds), "--reference-samples", "4096"], check=True,
                   stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    with open(rows, newline="", encoding="utf-8") as file:
        found = [{key: float(row[key]) for key in ("samples", "mse", "cpu_s", "mean")}
                 for row in csv.DictReader(file)]
    points, mean = [], statistics.fmean(row["mean"] for row in found)
    for samples in COUNTS:
        those = [row for row in found if row["samples"] == samples]
        error = math.sqrt(max(statistics.fmean(row["mse"] for row in those), 1e-20))
        points.append(Point(samples, error / mean, statistics.median(r["cpu_s"] for r in those)))
    return points, mean


def compare(options, name, folder):
    """Prints the scene's row; the logarithms of its two ratios, or nothing if the pictures are not
    alike."""
    settings = twin_settings(name, folder)
    theirs = Mitsuba(options, name, settings)
    sampler, ladder, picture = theirs.best()
    mi.Bitmap(picture.astype(np.float32)).write(str(folder / f"{name}-mitsuba.exr"))
    ours, mean = of_clshear(options, name, settings, folder)
    target, final = ladder[-1], ours[-1]
    seconds, needed = at(ours, target.error, "seconds"), at(ladder, final.error, "seconds")
    ratios = [target.seconds / seconds, needed / final.seconds]
    print(f"| {name} | {sampler} | {100 * target.error:.2f} % | {target.seconds:.2f} "
          f"| {at(ours, target.error, 'samples'):.0f} | {seconds:.2f} | **{ratios[0]:.1f}** "
          f"| {100 * final.error:.2f} % | {final.seconds:.2f} | {needed:.0f} | **{ratios[1]:.1f}** "
          f"| {mean / picture.mean():.3f} |", flush=True)
    if abs(math.log(mean / picture.mean())) > math.log(1.25):
        print(f"{name}: the pictures differ; not part of the geometric mean", file=sys.stderr)
        return None
    return [math.log(ratio) for ratio in ratios]


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("scenes", nargs="*", default=list(scenes()))
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--keep", help="folder for references, rows and pictures; rows that it has "
                        "are not measured again", default=str(ROOT / "build" / "dof20" / "mitsuba"))
    parser.add_argument("--models", type=pathlib.Path, default=ROOT / "build" / "dof20" / "models")
    parser.add_argument("--program", default=str(ROOT / "build" / "clshear"))
    parser.add_argument("--bench", default=str(ROOT / "build" / "bench" / "bench_dof20"))
    options = parser.parse_args()
    folder = pathlib.Path(options.keep)
    folder.mkdir(parents=True, exist_ok=True)
    print(HEAD, flush=True)
    logs = []
    for name in options.scenes:
        try:
            found = compare(options, name, folder)
            logs += [found] if found else []
        except SystemExit as lacks:
            print(f"{name}: {lacks}", file=sys.stderr)
    if logs:
        means = [math.exp(statistics.fmean(column)) for column in zip(*logs)]
        print(f"| **all**, geometric mean | | | | | | **{means[0]:.1f}** | | | | **{means[1]:.1f}** "
              "| |")


if __name__ == "__main__":
    main()
