"""Rows on what moves while the shutter is open: the spectrum over place and time, and the rate."""
import math
import pathlib
import statistics
import tempfile

import measure
import slices
from measure import Studies, clshear, interval, power, spectra
from rows import group, row

PIXELS = [(290, 180), (150, 150), (350, 250)]  # of the back wall
PLACES = [0.3, 0.5, 0.7]
STEP = 11.0  # of the camera to the right, units of the scene
MOVES = f'--camera-to {276.4 + STEP},274.4,800,{276.4 + STEP},274.4,0'
# A camera that is rolled sees edges of the wall at a slant; an edge along an axis is one-dimensional.
ROLLED = '--up 0.4,1,0'
ALONG_ROWS = '--camera-to 286.6134,270.3146,800,286.6134,270.3146,0'
DIAGONAL = '--camera-to 287.4,279.9,800,287.4,279.9,0'


def slice_of(pixel, at):
    """Values over x and time of a pinhole's picture, as slices.slice_of over x and u."""
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder, 'slice.exr')
        clshear(f'slice {slices.scene} {MOVES} --lens-radius 0 --pixel {pixel[0]},{pixel[1]} '
                f'--projection xt --resolution {slices.WIDTH},{slices.HEIGHT} --at {at} --no-line '
                f'--out {path}')
        return {place: statistics.fmean(rgb) for place, rgb in measure.pixels_of(path).items()}


def speed_px(pixel):
    """Of the wall to the left, while the camera goes STEP to the right: STEP / width of a pixel at
    the wall's depth."""
    width = 2.0 * slices.depth_at(pixel) * math.tan(math.radians(slices.FIELD_DEG) / 2.0)
    return STEP * slices.SIDE / width


@group
def motion():
    base = '--sampler mj --n 1024 --sets 40 --direction 1,-3'
    plain = spectra(f'{base} --projection xt')
    yield row('xt-slant', 'XT of pixel and time that are not sheared misses the line of what moves by 3 pixels, '
              'ω_t = -3 ω_x', '1', power(plain, 'along 1:-3', 8, 64), (0.97, 1.03),
              f'clshear spectrum {base} --projection xt')
    for plane, velocity in (('xt', '3,0'), ('yt', '0,3')):
        words = f'{base} --projection {plane} --velocity-px {velocity}'
        yield row(f'{plane}-sheared', f'sheared, those of {plane.upper()} lie on it', '→ 0',
                  power(spectra(words), 'along 1:-3', 8, 64), (0, 0.03), f'clshear spectrum {words}')
    speeds = [speed_px(pixel) for pixel in PIXELS]
    fits = [[slices.fitted(slice_of(pixel, at)) / speed for pixel, speed in zip(PIXELS, speeds)]
            for at in PLACES]
    yield row('xt-slice', 'velocity fitted to slices over x and time, over that of the camera and the depth', '1',
              interval([statistics.fmean(line) for line in fits]), (0.99, 1.01),
              f'clshear slice scenes/cornell.obj {MOVES} --lens-radius 0 --pixel 290,180 --projection xt')
    for name, lens, way, pixel, words in [
            ('pinhole', '0', DIAGONAL, '240,330', 'pinhole, a camera that moves'),
            ('lens', '30', ALONG_ROWS, '290,180', 'square lens, a camera that moves along the rows')]:
        command = (f'scenes/cornell.obj {ROLLED} {way} --lens-radius {lens} --focal-distance 900 --pixels {pixel} '
                   f'--sampler mj --shear none,equal-area --nsamps 64,256,1024 --nreps 1000')
        study = Studies(f'{command} --quiet')
        yield row(f'motion-{name}-unsheared', f'{words}: slope without shear', '-1', study.slope('none'), (-1.1, -0.9),
                  f'clshear converge {command}')
        yield row(f'motion-{name}-sheared', '… and with it; steeper while few strata meet an edge', '-1.5',
                  study.slope('equal-area'), (-2, -1.4),
                  f'clshear converge {command}')
