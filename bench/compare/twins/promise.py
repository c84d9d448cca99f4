"""The CPU time that clshear's --noise needs for a true error, and Cycles' adaptive sampling for the
same: a row of a table for each scene of DoF-20 that is named. scripts/promise-cycles runs it.

Both render the twin of the scene (cycles_scene.py) with two threads, the same size and bounces and a
box filter. Each is judged by a reference of its own with sixteen times the samples, whose own error
is taken off (so that --reference 4 is enough for Cycles'). CPU time is that of all threads, less
that of loading: the median of a render of 4 x 3 pixels with clshear, so that the depth prepass and
the pilot count; one sample per pixel with Cycles, which keeps its scene in memory.
"""
import argparse
import json
import math
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from flags import read_flags  # noqa: E402

ROOT = HERE.parents[2]
SCENES = ROOT / "bench" / "dof20"
MODELS = ROOT / "build" / "dof20" / "models"
REPEATS = 3  # of each of clshear's renders, for its time
HEAD = """| scene | samples | true error | CPU s | Cycles, fixed: CPU s | ratio | adaptive: threshold | CPU s | ratio | mean over Cycles' |
|---|---|---|---|---|---|---|---|---|---|"""


def flags_of(path):
    """Flags of a .flags file, with the defaults that the twin has to be told."""
    flags = read_flags(path)
    flags.setdefault("bounces", [[4.0]])
    flags.setdefault("up", [[0.0, 1.0, 0.0]])
    return flags


def model_of(name):
    for line in (SCENES / "scenes.txt").read_text().splitlines():
        if line.split()[:1] == [name]:
            return MODELS / line.split()[2]
    sys.exit(f"{name}: no scene of {SCENES / 'scenes.txt'}; take a name from there")


def settings_of(name):
    own = SCENES / "scenes" / f"{name}.flags"
    return own if own.exists() else ROOT / "scenes" / f"{name}.flags"


def averages(path, channels):
    """Mean of three channels of a picture, each. oiiotool prints six decimals, too few for a
    variance."""
    told = subprocess.run(["oiiotool", path, "--ch", channels, "--mulc", "1e6", "--printstats"],
                          check=True, text=True, stdout=subprocess.PIPE).stdout
    return [1e-6 * float(word) for word in re.search(r"Stats Avg: (.*) \(", told)[1].split()]


def difference(one, other):
    """Root of the mean square over pixels and colours. oiiotool's status tells whether there is any."""
    told = subprocess.run(["oiiotool", one, "--ch", "R,G,B", other, "--ch", "R,G,B", "--diff",
                           "--fail", "0", "--warn", "0"], check=False, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout
    return float(re.search(r"RMS error = (\S+)", told)[1])


def metadata(path, name):
    told = subprocess.run(["oiiotool", "--info", "-v", path], check=True, text=True,
                          stdout=subprocess.PIPE).stdout
    return float(re.search(rf"{name}: (\S+)", told)[1])


class Clshear:
    """One scene, rendered by clshear."""

    def __init__(self, options, name, folder):
        self.command = [options.program, model_of(name), "--settings", settings_of(name),
                        "--filter", "box", "--quiet"]
        self.size = ["--width", options.width, "--height", options.height]
        self.folder, self.options = folder, options

    def render(self, *flags):
        """CPU seconds of it and of its importer."""
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([str(word) for word in [*self.command, *flags]], check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def measure(self):
        """Samples per pixel, true error and CPU seconds of renders that --noise ends, and the
        reference's mean colour."""
        reference, picture = self.folder / "reference.exr", self.folder / "picture.exr"
        tiny = ["--width", 4, "--height", 3, "--spp", 16, "--out", picture]
        self.render(*tiny)  # compiles the kernels
        loading, seconds, squares, samples = [], [], [], []
        for seed in range(1, self.options.seeds + 1):
            for _ in range(REPEATS):
                loading.append(self.render(*tiny))
                seconds.append(self.render(*self.size, "--noise", self.options.noise, "--seed",
                                           seed, "--out", picture))
            samples.append(metadata(picture, "samplesPerPixel"))
            if seed == 1:
                self.render(*self.size, "--spp", int(16 * samples[0]), "--seed", 1000, "--out",
                            reference, "--out", self.folder / "clshear.png", "--auto-exposure")
                own = sum(averages(reference, "Variance.R,Variance.G,Variance.B")) / 3
                colour = averages(reference, "R,G,B")
            squares.append(difference(picture, reference) ** 2 - own)
        error = math.sqrt(max(mean(squares), 0.0)) / mean(colour)
        seconds = statistics.median(seconds) - statistics.median(loading)
        return mean(samples), error, seconds, colour


def mean(values):
    return sum(values) / len(values)


def at_error(rungs, error, name):
    """A quantity where a ladder has the error, between its last rungs, in logarithms."""
    above = [rung for rung in rungs if rung["error"] > error]
    low, high = rungs[-1], (above[-1] if above else rungs[-1])
    if high is low or low["error"] <= 0:
        return low[name]
    part = math.log(high["error"] / error) / math.log(high["error"] / low["error"])
    return high[name] * (low[name] / high[name]) ** part


def of_cycles(options, name, folder, error):
    job = {"importer": str(pathlib.Path(options.program).with_name("clshear-import")),
           "model": str(model_of(name)), "flags": flags_of(settings_of(name)),
           "width": options.width, "height": options.height, "error": error,
           "seeds": max(options.seeds, 2), "reference": options.reference, "folder": str(folder),
           "picture": str(folder / "cycles.png")}
    (folder / "job.json").write_text(json.dumps(job))
    with open(folder / "blender.log", "w", encoding="utf-8") as log:
        done = subprocess.run([options.blender, "-b", "--factory-startup", "--python-exit-code", "1",
                               "--python", HERE / "cycles_time.py", "--", folder / "job.json"],
                              check=False, stdout=log, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{name}: Blender failed: "
                 + "\n".join((folder / "blender.log").read_text().splitlines()[-12:]))
    return json.loads((folder / "cycles.json").read_text())


def row(options, name, folder):
    samples, error, seconds, colour = Clshear(options, name, folder).measure()
    theirs = of_cycles(options, name, folder, error)
    fixed = at_error(theirs["fixed"], error, "seconds")
    adaptive = at_error(theirs["adaptive"], error, "seconds")
    threshold = at_error(theirs["adaptive"], error, "threshold")
    print(f"| {name} | {samples:.0f} | {100 * error:.2f} % | {seconds:.2f} | {fixed:.2f} "
          f"| {fixed / seconds:.1f} | {threshold:.2g} | {adaptive:.2f} | {adaptive / seconds:.1f} "
          f"| {mean(colour) / mean(theirs['mean']):.3f} |", flush=True)


def main():
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("scenes", nargs="*",
                        default=["chess", "counter", "dragon", "living", "evening"])
    parser.add_argument("--noise", type=float, default=0.01, help="what clshear promises")
    parser.add_argument("--width", type=int, default=80)
    parser.add_argument("--height", type=int, default=60)
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--reference", type=int, default=16,
                        help="samples of Cycles' reference over those of a picture with the error")
    parser.add_argument("--keep", help="folder for pictures, rungs and logs of both")
    parser.add_argument("--blender", default="blender")
    parser.add_argument("--program", default=str(ROOT / "build" / "clshear"))
    options = parser.parse_args()
    print(HEAD, flush=True)
    for name in options.scenes:
        with tempfile.TemporaryDirectory() as folder:
            row(options, name, pathlib.Path(folder))
            if options.keep:
                shutil.copytree(folder, pathlib.Path(options.keep) / name, dirs_exist_ok=True)


if __name__ == "__main__":
    main()
