"""Rows on pixels of scenes: convergence, gains, the oracle's error."""
import measure
from expectation import LESS, LITTLE, MORE, MOST, MUCH_MORE, ONE, OPEN, STEEP, STEEPER, rate
from measure import Studies, clshear, gain_between, interval, part_over, predictions, ratio_of
from rows import group, row

BOX = 'scenes/cornell.obj --quiet'
WALL, EDGE, WEDGE = '302,130', '146,330', '154,213'
FOURS = '--nsamps 64,256,1024,4096'


def command(pixel, words, scene=BOX):
    return f'clshear converge {scene} --pixels {pixel} {words}'


def study(pixel, words, scene=BOX, batches=measure.BATCHES):
    """One pixel, or one of several 'X,Y;X,Y' that are measured by one run: pixel is (one, all)."""
    one, several = pixel if isinstance(pixel, tuple) else (pixel, pixel)
    return Studies(f'{scene} --pixels {several} {words}', 'pixel ' + one.replace(',', ':'), batches)


@group
def wall():
    words = ('--sampler mj --oracle centre --shear none,equal-area,toroidal '
             '--nsamps 16,64,128,256,512,1024,2048,4096 --nreps 400')
    s = study(WALL, words)
    shown = command(WALL, words)
    yield row('wall-none', 'a wall out of focus, mj, no shear: slope from 64', '-1', s.slope('none', 64),
              rate(-1.0), shown)
    yield row('wall-sheared', '… equal-area shear', '-1.5', s.slope('equal-area', 64), rate(-1.5), shown)
    yield row('wall-toroidal', '… the literal, toroidal shear', '-1.5', s.slope('toroidal', 64),
              rate(-1.5), shown)
    for name, low, high in [('zeroth', 16, 64), ('first', 64, 256), ('second', 256, 1024), ('third', 1024, 4096)]:
        yield row(f'wall-sheared-{name}', f'… equal-area shear, from {low} to {high}', '–',
                  s.slope('equal-area', low, high), OPEN, shown)
        yield row(f'wall-toroidal-{name}', f'… toroidal shear, from {low} to {high}', '–',
                  s.slope('toroidal', low, high), OPEN, shown)
    for n, expected, told in [(16, LITTLE, 'little'), (1024, MUCH_MORE, '10 and more'),
                              (4096, MUCH_MORE, '10 and more')]:
        yield row(f'wall-gain-{n}', f'… variance without over with the equal-area shear at N = {n}',
                  told, s.gain(n), expected, shown)
    yield row('wall-toroidal-cost', '… variance with the toroidal shear over that without, N = 1024', '< 1',
              s.gain(1024, 'toroidal', 'none'), LESS, shown)


@group
def nets():
    for sampler in ('halton', 'sobol', 'sz'):
        words = f'--sampler {sampler} {FOURS} --nreps 100'
        s = study(WALL, words)
        shown = command(WALL, words)
        yield row(f'wall-{sampler}-none', f'the same wall, {sampler}, no shear: slope', '–', s.slope('none'), OPEN,
                  shown)
        yield row(f'wall-{sampler}-sheared', '… sheared', '–', s.slope('equal-area'), OPEN, shown)
        yield row(f'wall-{sampler}-steeper', '… the latter less the former', '< 0', s.steeper(), STEEPER, shown)
        yield row(f'wall-{sampler}-gain', '… variance without over with shear, N = 1024', '> 1', s.gain(1024),
                  MORE, shown)


@group
def jittered4d():
    words = '--sampler jittered4d --shear none --nsamps 16,256,4096 --nreps 200'
    both = f'{EDGE};{WALL}'
    for name, pixel, what in [('', EDGE, 'edge'), ('-wall', WALL, 'wall')]:
        yield row(f'jittered4d{name}', f'4D jitter, an {what} out of focus, no shear: slope'.replace('an w', 'a w'),
                  '-1.25', study((pixel, both), words).slope('none'), rate(-1.25), command(pixel, words))


@group
def focus():
    words = f'--sampler mj --shear none {FOURS} --nreps 100'
    focused = words + ' --focal-distance 1359.2'
    pixel = '295,112'
    sharp, soft = study(pixel, focused), study(pixel, words)
    yield row('focus-slope', 'the wall\'s texture in focus has a 2D integrand: slope, mj', '≤ -1.5',
              sharp.slope('none'), STEEP, command(pixel, focused))
    yield row('blur-slope', '… the same pixel out of focus has a 4D one: slope', '-1', soft.slope('none'),
              rate(-1.0), command(pixel, words))
    yield row('blur-slope-late', '… from 1024 to 4096', '-1', soft.slope('none', 1024), rate(-1.0),
              command(pixel, words))
    yield row('blur-costs', '… and is noisier, N = 1024, by a factor of', '> 1', gain_between(soft, sharp, 1024),
              MORE, command(pixel, words))


PLACES = [('left', '60,256', 'left wall'), ('floor', '256,505', 'floor before the focus'),
          ('right', '505,256', 'right wall before the focus'), ('edge-square', EDGE, 'an edge of the tall box')]


@group
def elsewhere():
    """Walls, floor, an edge, on both sides of the focus: no claim should hang on one pixel."""
    words = f'--sampler mj {FOURS} --nreps 100'
    several = ';'.join(pixel for _, pixel, _ in PLACES)
    for name, pixel, what in PLACES:
        yield from place(name, what, study((pixel, several), words), command(pixel, words))
    plain = 'scenes/wheel.gltf --quiet --width 400 --height 400 --bounces 0 --aperture square'
    yield from place('plain', 'no texture: the border of a shadow out of focus', study('42,258', words, plain),
                     command('42,258', words, plain), gain=('> 1', MORE))
    words += ' --width 64 --height 64'
    s = study('58,24', words)
    yield row('constant-gain', 'a pixel whose variance falls tenfold, N = 1024 …', '10', s.gain(1024), MUCH_MORE,
              command('58,24', words))
    yield row('constant-rate', '… and whose rate does not improve: slope, sheared', '-1',
              s.slope('equal-area'), rate(-1.0), command('58,24', words))


def place(name, what, s, shown, gain=('10 and more', MUCH_MORE)):
    yield row(f'{name}-none', f'{what}, mj, no shear: slope', '-1', s.slope('none'), rate(-1.0), shown)
    yield row(f'{name}-sheared', '… sheared', '≤ -1.5', s.slope('equal-area'), STEEP, shown)
    yield row(f'{name}-gain', '… gain at N = 1024', gain[0], s.gain(1024), gain[1], shown)


LENSES = [('disk', '--aperture disk', 'a disk'), ('hexagon', '--blades 6', 'a hexagon'),
          ('anamorphic', '--aperture disk --anamorphic 2', 'half a disk\'s width'),
          ('gaussian', '--aperture disk --filter gaussian', 'a disk, gaussian filter')]


@group
def lenses():
    """An edge and the wall through other lenses than the square one of the literature."""
    for name, flags, what in LENSES:
        words = f'--sampler mj {flags} {FOURS} --nreps 100'
        for where, pixel in [('edge', EDGE), ('wall', WALL)]:
            s = study((pixel, f'{EDGE};{WALL}'), words)
            shown = command(pixel, words)
            yield row(f'{where}-{name}-none', f'the {where} through {what}, mj, no shear: slope', '-1',
                      s.slope('none'), rate(-1.0), shown)
            yield row(f'{where}-{name}-sheared', '… sheared', '≤ -1.5', s.slope('equal-area'), STEEP, shown)
            yield row(f'{where}-{name}-gain', '… gain at N = 1024', '> 1', s.gain(1024), MORE, shown)


@group
def wedge():
    mj = None
    for sampler in ('mj', 'oa', 'sz'):
        words = f'--sampler {sampler} --nsamps 256,1024 --nreps 150'
        s = study(WEDGE, words)
        if sampler == 'mj':
            mj = s
            yield row('wedge-gain', 'two depths in one pixel, a double wedge: gain, mj, N = 1024', 'little',
                      s.gain(1024), LITTLE, command(WEDGE, words))
            continue
        n = next(n for n in s.batches[0][sampler, 'none'] if n >= 1024)
        figure = ratio_of([b['mj', 'equal-area'][1024] for b in mj.batches],
                          [b[sampler, 'equal-area'][n] for b in s.batches])
        yield row(f'wedge-{sampler}', f'… structures wider than hairlines help: variance of mj over that of {sampler}, '
                  'both sheared', '> 1', figure, MORE, command(WEDGE, words))
    words = '--sampler mj --nsamps 256,1024 --nreps 150'
    for name, pixel, what in [('side', '267,250', 'the side of the tall box'), ('top', '320,339', 'the top of the low box')]:
        yield row(f'wedge-{name}', f'two depths elsewhere, at {what}: gain, mj, N = 1024', 'little',
                  study((pixel, '267,250;320,339'), words).gain(1024), LITTLE, command(pixel, words))


@group
def oracle():
    """Variance with a shear that is off, in units of that with the surface's own."""
    words = '--sampler mj --shear equal-area --nsamps 64,1024 --nreps 100 --shear-px='
    for where, pixel, own, errors in [
            ('', WALL, -13, [('pixel', -12, 'a pixel off'), ('four', -17, 'four pixels off'),
                             ('twice', -27, 'twice the shear'), ('none', 0, 'no shear'),
                             ('opposite', 13, 'the opposite shear')]),
            ('-floor', '256,505', 3.1, [('pixel', 4.1, 'a pixel off')])]:
        right = study(pixel, words + str(own))
        for name, shear, what in errors:
            yield row(f'oracle{where}-{name}', f'all depends on the oracle: {what}, {"floor" if where else "wall"}, '
                      f'N = 1024; variance over that at {own} px', '> 1',
                      gain_between(study(pixel, words + str(shear)), right, 1024, 'equal-area'),
                      MORE, command(pixel, words + str(shear)))


@group
def calm():
    pixel = '43,53'
    words = '--width 64 --height 64 --sampler mj --shear none,toroidal,equal-area --nsamps 256,1024 --nreps 100'
    s = study(pixel, words)
    yield row('calm-toroidal', 'a calm pixel: variance with the toroidal shear over that without, N = 1024', '–',
              s.gain(1024, 'toroidal', 'none'), OPEN, command(pixel, words))
    words = (f'{BOX} --pixel {pixel} --width 64 --height 64 --shear toroidal --sampler mj --sets 30 '
             '--measure 300')
    parts = predictions(words, 4)
    shown = f'clshear predict {words}'
    yield row('calm-seam', '… measured over predicted, toroidal', '1', part_over(parts, 'measured'), ONE, shown)
    yield row('calm-seam-planes', '… part of the prediction that lies in XU and YV', 'most',
              interval([(p['xu'] + p['yv']) / p['predicted'] for p in parts]), MOST, shown)


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
