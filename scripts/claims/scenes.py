"""Rows on pixels of the Cornell box: convergence, gains, predictions."""
import math
import statistics
import tempfile

import measure
from measure import Studies, clshear, gain_between, interval, prediction, ratio
from rows import group, row

BOX = 'scenes/cornell.obj --quiet'
WALL, EDGE, WEDGE, FOCUS = '302,130', '146,330', '154,213', '242,488'
FOURS = '--nsamps 64,256,1024,4096'


def study(pixel, words, batches=measure.BATCHES):
    return Studies(f'{BOX} --pixels {pixel} {words}', batches)


def command(pixel, words):
    return f'clshear converge {BOX} --pixels {pixel} {words}'


@group
def wall():
    words = ('--sampler mj --oracle centre --shear none,equal-area,toroidal '
             '--nsamps 16,64,128,256,512,1024,2048,4096 --nreps 400')
    s = study(WALL, words)
    shown = command(WALL, words)
    yield row('wall-none', 'a wall out of focus, mj, no shear: slope from 64', '-1', s.slope('none', 64),
              (-1.05, -0.95), shown)
    yield row('wall-sheared', '… equal-area shear', '-1.5', s.slope('equal-area', 64), (-1.55, -1.4), shown)
    yield row('wall-toroidal', '… the literal, toroidal shear', '-1.5', s.slope('toroidal', 64),
              (-1.55, -1.4), shown)
    yield row('wall-sheared-first', '… which is no power of N: equal-area shear, from 64 to 256', 'varies',
              s.slope('equal-area', 64, 256), (-2.2, -1), shown)
    yield row('wall-sheared-second', '… and from 256 to 1024', 'varies',
              s.slope('equal-area', 256, 1024), (-2.2, -1), shown)
    for n, expected, words in [(16, (0.8, 2), 'none'), (1024, (8, math.inf), '10 and more'),
                               (4096, (10, math.inf), 'more')]:
        yield row(f'wall-gain-{n}', f'… variance without over with the equal-area shear at N = {n}',
                  words, s.gain(n), expected, shown)
    yield row('wall-toroidal-cost', '… variance with the toroidal shear over that without, N = 1024', '< 1',
              s.gain(1024, 'toroidal', 'none'), (0, 1), shown)


@group
def nets():
    for sampler in ('halton', 'sobol', 'sz'):
        words = f'--sampler {sampler} {FOURS} --nreps 100'
        s = study(WALL, words)
        yield row(f'wall-{sampler}-none', f'the same wall, {sampler}, no shear: slope', '–', s.slope('none'),
                  (-math.inf, -1), command(WALL, words))
        yield row(f'wall-{sampler}-sheared', '… sheared', 'steeper', s.slope('equal-area'),
                  (-math.inf, s.slope('none')[0]), command(WALL, words))
        yield row(f'wall-{sampler}-gain', '… variance without over with shear, N = 1024', '> 1', s.gain(1024),
                  (1.1, math.inf), command(WALL, words))


@group
def edges():
    for aperture in ('square', 'disk'):
        words = f'--sampler mj --aperture {aperture} {FOURS} --nreps 100'
        s = study(EDGE, words)
        yield row(f'edge-{aperture}-none', f'an edge out of focus, {aperture} lens, mj, no shear: slope', '-1',
                  s.slope('none'), (-1.05, -0.95), command(EDGE, words))
        yield row(f'edge-{aperture}-sheared', '… sheared', '≤ -1.5', s.slope('equal-area'), (-2.1, -1.45),
                  command(EDGE, words))
        yield row(f'edge-{aperture}-gain', '… gain at N = 1024', '10 and more', s.gain(1024), (10, math.inf),
                  command(EDGE, words))
    words = '--sampler jittered4d --shear none --nsamps 16,256,4096 --nreps 200'
    yield row('jittered4d', 'the edge with 4D jitter, no shear: slope', '-1.25',
              study(EDGE, words).slope('none'), (-1.3, -1.2), command(EDGE, words))


@group
def focus():
    words = f'--sampler mj --shear none {FOURS} --nreps 100'
    focused = words + ' --focal-distance 1359.2'
    pixel = '295,112'
    sharp, soft = study(pixel, focused), study(pixel, words)
    yield row('focus-slope', 'the wall\'s texture in focus has a 2D integrand: slope, mj', '≤ -1.5',
              sharp.slope('none'), (-2.6, -1.45), command(pixel, focused))
    yield row('blur-slope', '… the same pixel out of focus has a 4D one: slope', '-1', soft.slope('none'),
              (-1.05, -0.95), command(pixel, words))
    yield row('blur-costs', '… and is noisier, N = 1024, by a factor of', '> 1', gain_between(soft, sharp, 1024),
              (1, math.inf), command(pixel, words))


@group
def elsewhere():
    """Walls and floor, on both sides of the focus: no claim should hang on one pixel."""
    for name, pixel, what in [('left', '60,256', 'left wall'), ('floor', '256,505', 'floor before the focus'),
                              ('right', '505,256', 'right wall before the focus')]:
        words = f'--sampler mj {FOURS} --nreps 100'
        s = study(pixel, words)
        yield row(f'{name}-none', f'{what}, mj, no shear: slope', '-1', s.slope('none'), (-1.1, -0.9),
                  command(pixel, words))
        yield row(f'{name}-sheared', '… sheared', '≤ -1.5', s.slope('equal-area'), (-2.1, -1.45),
                  command(pixel, words))
        yield row(f'{name}-gain', '… gain at N = 1024', '> 1', s.gain(1024), (1, math.inf),
                  command(pixel, words))
    words = f'--width 64 --height 64 --sampler mj {FOURS} --nreps 100'
    s = study('58,24', words)
    yield row('constant-gain', 'a pixel whose variance falls tenfold, N = 1024 …', '10', s.gain(1024), (8, math.inf),
              command('58,24', words))
    yield row('constant-rate', '… and whose rate does not improve: slope, sheared', '-1',
              s.slope('equal-area'), (-1.1, -0.9), command('58,24', words))


@group
def wedge():
    for sampler in ('mj', 'oa', 'sz'):
        words = f'--sampler {sampler} --nsamps 256,1024 --nreps 150'
        s = study(WEDGE, words)
        if sampler == 'mj':
            mj = s
            yield row('wedge-gain', 'two depths in one pixel, a double wedge: gain, mj, N = 1024', 'little',
                      s.gain(1024), (1, 2.5), command(WEDGE, words))
            continue
        n = next(n for n in s.batches[0][sampler, 'none'] if n >= 1024)
        figure = ratio([math.log(a) - math.log(b[sampler, 'equal-area'][n]) for a, b in
                        zip((x['mj', 'equal-area'][1024] for x in mj.batches), s.batches)])
        yield row(f'wedge-{sampler}', f'… structures wider than hairlines help: variance of mj over that of {sampler}, '
                  'both sheared', '> 1', figure, (1, math.inf), command(WEDGE, words))


@group
def oracle():
    """Variance with a shear that is off, in units of that with the wall's own, -13 pixels."""
    words = '--sampler mj --shear equal-area --nsamps 64,1024 --nreps 100 --shear-px='
    right = study(WALL, words + '-13')
    for name, shear, expected, what in [
            ('pixel', -12, (1, 2), 'a pixel off'), ('four', -17, (1.5, 5), 'four pixels off'),
            ('twice', -27, (3, 30), 'twice the shear'), ('none', 0, (5, 50), 'no shear'),
            ('opposite', 13, (5, 100), 'the opposite shear')]:
        yield row(f'oracle-{name}', f'all depends on the oracle: {what}, N = 1024; variance over that at -13 px',
                  '> 1', gain_between(study(WALL, words + str(shear)), right, 1024, 'equal-area'),
                  expected, command(WALL, words + str(shear)))


@group
def calm():
    pixel = '43,53'
    words = '--width 64 --height 64 --sampler mj --shear none,toroidal,equal-area --nsamps 256,1024 --nreps 100'
    s = study(pixel, words)
    yield row('calm-toroidal', 'a calm pixel: variance with the toroidal shear over that without, N = 1024', '–',
              s.gain(1024, 'toroidal', 'none'), (1, math.inf), command(pixel, words))


@group
def image():
    words = f'{BOX} --width 48 --height 48 --sampler mj --nsamps 64,256,1024 --nreps 12'
    medians, better, worse = [], [], []
    for seed in measure.seeds(4):
        with tempfile.TemporaryDirectory() as folder:
            clshear(f'converge {words} --seed {seed} --map {folder}/map.csv')
            with open(f'{folder}/map.csv', encoding='utf-8') as stream:
                lines = [line.split(',') for line in stream.read().split()[1:]]
        gains = [float(line[5]) for line in lines if line[3] == 'equal-area']
        gains = [g for g in gains if not math.isnan(g)]
        medians.append(statistics.median(gains))
        better.append(sum(g > 2 for g in gains) / len(gains))
        worse.append(sum(g < 0.5 for g in gains) / len(gains))
    shown = f'clshear converge {words} --map map.csv'
    yield row('image-median', 'the whole image: median of the pixels\' gains, N = 1024', '> 1', interval(medians),
              (2, math.inf), shown)
    yield row('image-better', '… part of the pixels with a gain above 2', 'most', interval(better), (0.5, 1), shown)
    yield row('image-worse', '… part of the pixels with a gain below 1/2', 'few', interval(worse), (0, 0.1), shown)


@group
def pixels_predicted():
    for pixel, name, what in [(FOCUS, 'focus', 'in focus'), (WALL, 'wall', 'out of focus'),
                              (WEDGE, 'wedge', 'double wedge')]:
        for shear in ('none', 'equal-area'):
            words = f'{BOX} --pixel {pixel} --shear {shear} --sampler mj --sets 300 --measure 600'
            yield row(f'predicted-{name}-{shear}', f'measured over predicted variance: {what}, shear {shear}, N = 1024',
                      '1', prediction(words)[0], (0.95, 1.05), f'clshear predict {words}')


@group
def image_predicted():
    words = (f'{BOX} --width 16 --height 16 --sampler mj --n 64 --sets 100 --resolution 63 --block 4 '
             f'--measure 200')
    with tempfile.TemporaryDirectory() as folder:
        clshear(f'predict {words} --seed {measure.seeds()[0]} --map {folder}/map.csv')
        with open(f'{folder}/map.csv', encoding='utf-8') as stream:
            lines = [[float(v) for v in line.split(',')] for line in stream.read().split()[1:]]
    lines = [line for line in lines if line[3] > 0.0]  # without variance: in shadow
    held = sum(line[4] <= line[2] <= line[5] for line in lines) / len(lines)
    half = 1.96 * math.sqrt(held * (1.0 - held) / len(lines))
    yield row('image-predicted', 'the whole image: part of the pixels whose 95 % interval of the measured '
              'variance holds the predicted one, N = 64', '→ 0.95', (held, held - half, held + half), (0.85, 1),
              f'clshear predict {words} --map map.csv')
    ratios = interval([statistics.median(line[3] / line[2] for line in lines[k::4] if line[2] > 0.0)
                       for k in range(4)])
    yield row('image-predicted-ratio', '… median of measured over predicted variance', '1', ratios, (0.95, 1.05),
              f'clshear predict {words} --map map.csv')


def pictures(folder, work, mosaic):
    slices, energies = [], []
    for pixel, plane in [(WALL, 'xu'), (EDGE, 'xu'), (WEDGE, 'yv')]:  # the edge of the box's top is level
        slices.append(str(work / f'slice-{pixel}.png'))
        energies.append(str(work / f'energy-{pixel}.png'))
        clshear(f'slice {BOX} --pixel {pixel} --projection {plane} --out {slices[-1]} --spectrum {energies[-1]}')
    mosaic(slices + energies, '3x2', folder / 'slices.png', [])
    for name, pixel in [('wall', WALL), ('wedge', WEDGE)]:
        clshear(f'converge {BOX} --pixels {pixel} --sampler mj --nsamps 16,64,256,1024,4096 --nreps 400 '
                f'--plot {folder}/{name}.png')
    clshear(f'predict {BOX} --width 24 --height 24 --sampler mj --n 64 --sets 100 --resolution 63 --block 4 '
            f'--measure 200 --plot {folder}/scatter.png')
    small = work / 'map.png'
    clshear(f'converge {BOX} --width 64 --height 64 --sampler mj --nsamps 64,256,1024 --nreps 32 --map {small}')
    mosaic([str(small)], '1x1', folder / 'map.png', ['--resize:filter=box', '768x256'])
