"""Measures which CPU time Cycles needs for a true error, in Blender:
blender -b --factory-startup --python cycles_time.py -- JOB.json

JOB: importer, model, flags, width, height, error (relative, to be reached), seeds, reference (its
samples over those of a picture with the error), folder, picture.
Writes FOLDER/cycles.json: the reference's samples and error, and a list of rungs for fixed samples
and for adaptive sampling, each with its threshold or samples, true error and CPU seconds. PICTURE is
the reference as PNG.

Terms: a picture's error is the root of the mean square difference to the reference over pixels and
colours, less the reference's own, over the mean of the reference: scripts/promise's.
"""
import json
import math
import pathlib
import sys
import time

import bpy
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import cycles_scene

PARTS = 4  # renders of other seeds that a reference is the mean of
MOST = 16  # samples in a pixel of adaptive sampling, over those of a picture with the error
FEWEST = 64  # samples of the first rung
COARSEST = 0.2  # threshold of the first rung


def set_up(job):
    """Unidirectional paths, as clshear's: no clamp, no filter of gloss, no denoiser, no cut-off."""
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("black")
    scene.world.color = (0, 0, 0)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = job["width"], job["height"]
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", 2
    render.use_persistent_data = True  # the hierarchy stays
    render.image_settings.file_format = "OPEN_EXR"
    render.image_settings.color_depth, render.image_settings.color_mode = "32", "RGB"
    cycles.device, cycles.use_denoising = "CPU", False
    cycles.pixel_filter_type = "BOX"
    bounces = int(job["flags"]["bounces"][0][0])
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = bounces
    cycles.transmission_bounces, cycles.transparent_max_bounces = bounces, 64
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.light_sampling_threshold = cycles.blur_glossy = 0.0


class Renderer:
    def __init__(self, job):
        self.job = job
        self.path = str(pathlib.Path(job["folder"]) / "cycles.exr")
        self.render(1, 1)
        self.overhead_s = min(self.render(1, 1)[1] for _ in range(3))

    def pixels(self):
        image = bpy.data.images.load(self.path)
        pixels = np.empty(len(image.pixels), dtype=np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
        return pixels.reshape(self.job["height"], self.job["width"], -1)[:, :, :3].astype(float)

    def render(self, samples, seed, threshold=None):
        """The pixels, and CPU seconds of all threads."""
        scene = bpy.context.scene
        cycles, scene.render.filepath = scene.cycles, self.path
        cycles.samples, cycles.seed = samples, seed
        cycles.use_adaptive_sampling = threshold is not None
        if threshold is not None:
            cycles.adaptive_threshold = threshold
        start = time.process_time()
        bpy.ops.render.render(write_still=True)
        used_s = time.process_time() - start
        return self.pixels(), used_s

    def several(self, samples, threshold=None):
        """Pictures of all seeds, and CPU seconds of one, without what one sample takes."""
        done = [self.render(samples, 1 + seed, threshold) for seed in range(self.job["seeds"])]
        seconds = sum(used for _, used in done) / len(done)
        return [pixels for pixels, _ in done], max(seconds - self.overhead_s, 1e-3)


def spread(pictures):
    """The expected square error of each of some pictures, from their differences."""
    return float(np.var(np.stack(pictures), axis=0, ddof=1).mean())


def samples_wanted(renderer, error):
    """Samples with which a picture has about the error: doubled until it has twice the error, and from
    there by the slope."""
    samples, last = FEWEST, math.inf
    while True:
        pictures, _ = renderer.several(samples)
        now = math.sqrt(spread(pictures)) / np.mean(pictures)
        print("pair", samples, now, flush=True)
        if now <= 2.0 * error:
            slope = 0.5 if math.isinf(last) else math.log(last / now) / math.log(2.0)
            return int(samples * (now / error) ** (1.0 / min(max(slope, 0.4), 1.0)))
        samples, last = 2 * samples, now


def make_reference(renderer, samples):
    parts = [renderer.render(samples // PARTS, 1000 + part)[0] for part in range(PARTS)]
    return np.mean(parts, axis=0), spread(parts) / PARTS


def true_error(pictures, reference, own):
    square = np.mean([np.mean((picture - reference) ** 2) for picture in pictures])
    return math.sqrt(max(square - own, 0.0)) / reference.mean()


def ladder(renderer, error, reference, own, first, step):
    """Rungs until the error is reached; `first` is (samples, threshold), `step` makes the next."""
    rungs, setting = [], first
    while not rungs or rungs[-1]["error"] > error:
        pictures, seconds = renderer.several(*setting)
        rungs.append({"samples": setting[0], "threshold": setting[1], "seconds": seconds,
                      "error": true_error(pictures, reference, own)})
        print("rung", rungs[-1], flush=True)
        setting = step(setting)
    return rungs


def show(pixels, path):
    """As an sRGB screen has them; the largest of most pixels is white."""
    scaled = np.clip(pixels / max(np.quantile(pixels, 0.98), 1e-9), 0.0, 1.0)
    coded = np.where(scaled <= 0.0031308, 12.92 * scaled, 1.055 * scaled ** (1 / 2.4) - 0.055)
    height, width = pixels.shape[:2]
    image = bpy.data.images.new("shown", width, height)
    image.pixels.foreach_set(np.dstack([coded, np.ones((height, width))]).astype(np.float32).ravel())
    image.filepath_raw, image.file_format = path, "PNG"
    image.save()


def main():
    job = json.loads(pathlib.Path(sys.argv[sys.argv.index("--") + 1]).read_text())
    cycles_scene.build(job["importer"], job["model"], job["flags"])
    set_up(job)
    renderer, error = Renderer(job), job["error"]
    samples = samples_wanted(renderer, error)
    reference, own = make_reference(renderer, job["reference"] * samples)
    show(reference, job["picture"])
    fixed = ladder(renderer, error, reference, own, (max(samples // 2, 1), None),
                   lambda setting: (math.ceil(1.5 * setting[0]), None))
    adaptive = ladder(renderer, error, reference, own, (MOST * samples, COARSEST),
                      lambda setting: (setting[0], setting[1] / 2.0))
    result = {"mean": reference.mean(axis=(0, 1)).tolist(), "samples": job["reference"] * samples,
              "own": math.sqrt(own) / reference.mean(), "overhead": renderer.overhead_s,
              "fixed": fixed, "adaptive": adaptive}
    (pathlib.Path(job["folder"]) / "cycles.json").write_text(json.dumps(result))


if __name__ == "__main__":
    main()
