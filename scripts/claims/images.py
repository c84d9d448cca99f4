"""Rows on all pixels of an image, and on what predictions of pixels say."""
import math
import statistics

import measure
from expectation import DARK, FEW, MORE, MOST, NOT_DARK, ONE, OPEN
from measure import clshear, interval, maps, part_over, predictions
from rows import group, row
from scenes import BOX, WALL, WEDGE

FOCUS = '242,488'
BATCHES = 4  # images take longer than pixels


@group
def image():
    words = f'{BOX} --width 48 --height 48 --sampler mj --nsamps %s --nreps 12'
    for counts in ('16,64', '64,256,1024'):
        most = counts.split(',')[-1]
        gains = [[float(line['gain']) for line in lines
                  if line['shear'] == 'equal-area' and not math.isnan(float(line['gain']))]
                 for lines in maps(f'converge {words % counts}', BATCHES)]
        shown = f'clshear converge {words % counts} --map map.csv'
        name = 'image-median' if most == '1024' else f'image-median-{most}'
        yield row(name, f'the whole image: median of the pixels\' gains, N = {most}', '> 1',
                  interval([statistics.median(g) for g in gains]), MORE, shown)
    yield row('image-better', '… part of the pixels with a gain above 2', 'most',
              interval([sum(v > 2 for v in g) / len(g) for g in gains]), MOST, shown)
    yield row('image-worse', '… part of the pixels with a gain below 1/2', 'few',
              interval([sum(v < 0.5 for v in g) / len(g) for g in gains]), FEW, shown)


@group
def pixels_predicted():
    for pixel, name, what in [(FOCUS, 'focus', 'in focus'), (WALL, 'wall', 'out of focus'),
                              (WEDGE, 'wedge', 'double wedge')]:
        for shear in ('none', 'equal-area'):
            words = f'{BOX} --pixel {pixel} --shear {shear} --sampler mj --sets 50 --measure 400'
            parts = predictions(words, 5)
            shown = f'clshear predict {words}'
            yield row(f'predicted-{name}-{shear}', f'measured over predicted variance: {what}, shear {shear}, N = 1024',
                      '1', part_over(parts, 'measured'), ONE, shown)
            for plane, other, expected, told in PRODUCTS.get((name, shear), []):
                shares = [(p[plane] + p[other]) / p['predicted'] for p in parts]
                yield row(f'product-{name}-{shear}', f'… part of it that lies in {plane.upper()} and {other.upper()}',
                          told, interval(shares), expected, shown)


# Where the product of the two spectra lies: in the slanted planes out of focus, and there no more when
# the samples are sheared; in focus it never does.
PRODUCTS = {('focus', 'none'): [('xu', 'yv', DARK, '→ 0')],
            ('wall', 'none'): [('xu', 'yv', MOST, 'most')],
            ('wall', 'equal-area'): [('xu', 'yv', OPEN, '–')]}


@group
def image_predicted():
    words = (f'{BOX} --width 10 --height 10 --sampler mj --n 64 --sets 100 --resolution 63 --block 4 '
             f'--measure 200')
    held, ratios = [], []
    for lines in maps(f'predict {words}', BATCHES):
        pixels = [{k: float(v) for k, v in line.items()} for line in lines]
        lit = [p for p in pixels if p['measured'] > 0.0]  # the others are in shadow
        held.append(statistics.fmean(p['measured_low'] <= p['predicted'] <= p['measured_high'] for p in lit))
        ratios.append(statistics.median(p['measured'] / p['predicted'] for p in lit if p['predicted'] > 0.0))
    shown = f'clshear predict {words} --map map.csv'
    yield row('image-predicted', 'the whole image: part of the pixels whose 95 % interval of the measured '
              'variance holds the predicted one, N = 64', '0.95', interval(held), (0.9, 1.0), shown)
    yield row('image-predicted-ratio', '… median of measured over predicted variance', '1', interval(ratios), ONE,
              shown)


def pictures(folder, work, mosaic):
    clshear(f'predict {BOX} --width 24 --height 24 --sampler mj --n 64 --sets 100 --resolution 63 --block 4 '
            f'--measure 200 --plot {folder}/scatter.png')
    small = work / 'map.png'
    clshear(f'converge {BOX} --width 64 --height 64 --sampler mj --nsamps 64,256,1024 --nreps 32 --map {small}')
    mosaic([str(small)], '1x1', folder / 'map.png', ['--resize:filter=box', '768x256'])
