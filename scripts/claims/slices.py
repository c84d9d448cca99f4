"""The shear of a pixel, measured in slices of its integrand and given by depth and focus."""
import math
import pathlib
import statistics
import subprocess
import tempfile

import measure

scene = 'scenes/cornell.obj --quiet'
# scenes/cornell.flags
FOCUS, RADIUS, FIELD_DEG, SIDE = 930.0, 25.0, 36.0, 512
WIDTH, HEIGHT = 32, 128  # values over x and u
BIN = 1.0 / WIDTH        # px


def of_depth(depth):
    """s = (A / w) (F / z - 1) in pixels per width A of the lens, with w the width of a pixel in the
    plane in focus (Singh & Jarosz 2017)."""
    pixel = 2.0 * FOCUS * math.tan(math.radians(FIELD_DEG) / 2.0) / SIDE
    return 2.0 * RADIUS / pixel * (FOCUS / depth - 1.0)


def depth_at(pixel):
    """Depth at the pixel's centre, from the channel Z."""
    x, y = pixel
    with tempfile.TemporaryDirectory() as folder:
        image, plane = pathlib.Path(folder, 'z.exr'), pathlib.Path(folder, 'plane.exr')
        measure.clshear(f'{scene} --spp 1 --crop {x},{x + 1},{y},{y + 1} --out {image}')
        subprocess.run(['oiiotool', str(image), '--ch', 'Z', '-o', str(plane)], check=True)
        return next(iter(measure.pixels_of(plane).values()))[0]


def slice_of(pixel, at):
    """Values over x (0 to 1 px) and u (-1/2 to 1/2): {(column, row): grey}."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, 'slice.exr')
        measure.clshear(f'slice {scene} --pixel {pixel[0]},{pixel[1]} --resolution {WIDTH},{HEIGHT} '
                        f'--at {at} --no-line --out {path}')
        return {place: statistics.fmean(rgb) for place, rgb in measure.pixels_of(path).items()}


def spread(values, shear):
    """Mean square of what is left of L(x, u) after the mean over each fibre x + shear u."""
    fibres = {}  # bin: count, sum, sum of squares
    for (column, row), value in values.items():
        place = (column + 0.5) / WIDTH + shear * ((row + 0.5) / HEIGHT - 0.5)
        fibre = fibres.setdefault(math.floor(place / BIN), [0, 0.0, 0.0])
        fibre[0] += 1
        fibre[1] += value
        fibre[2] += value * value
    rest = sum(squares - total * total / count for count, total, squares in fibres.values())
    return rest / (len(values) - len(fibres))


def fitted(values):
    """The shear for which the slice varies least along its fibres: a scan, then golden sections."""
    mean = statistics.fmean(values.values())
    centred = {place: value - mean for place, value in values.items()}

    def left(shear):
        return spread(centred, shear)

    step, golden = 0.75, 0.5 * (math.sqrt(5.0) - 1.0)
    best = min(range(-27, 14), key=lambda k: left(k * step)) * step
    low, high = best - step, best + step
    inner = [high - golden * (high - low), low + golden * (high - low)]
    levels = [left(s) for s in inner]
    while high - low > 0.01:
        if levels[0] < levels[1]:
            high = inner[1]
            inner = [high - golden * (high - low), inner[0]]
            levels = [left(inner[0]), levels[0]]
        else:
            low = inner[0]
            inner = [inner[1], low + golden * (high - low)]
            levels = [levels[1], left(inner[1])]
    return 0.5 * (low + high)


def along_u(values):
    """Variance along u at one x, in the mean over x, and the whole variance of a slice."""
    columns = {}
    for (column, _), value in values.items():
        columns.setdefault(column, []).append(value)
    within = statistics.fmean(statistics.pvariance(v) for v in columns.values())
    return within, statistics.pvariance(values.values())
