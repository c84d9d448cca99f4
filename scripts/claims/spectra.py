"""Rows on the spectra of samplers. Power is 1 for random points."""
import cmath
import functools
import math
import statistics

from expectation import DARK, MUCH_LESS, NOT_DARK, ONE
from measure import clshear, interval, power, spectra
from rows import group, row


def sinc2(x):
    return 1.0 if x == 0 else (math.sin(math.pi * x) / (math.pi * x)) ** 2


def over_closed_form(tables, column, radii, form):
    """Mean ratio of measured to expected power over radii."""
    return interval([statistics.fmean(float(r[column]) / form(int(r['radius'])) for r in rows
                                      if int(r['radius']) in radii) for rows in tables])


@group
def planar():
    words = 'spectrum --n 1024 --sets 40 --projection xy'
    random = spectra('--sampler random --n 1024 --sets 40')
    yield row('random-white', 'random points are white', '1', power(random, 'mean', 8, 64),
              ONE, f'clshear {words} --sampler random')
    yield row('spectrum-is-a-mean', 'an expected spectrum is a mean over realisations: the variance that '
              'is left over a ring at 40 sets, in units of a single set\'s over 40, radii 8 to 64', '1',
              scatter(random), ONE, f'clshear {words} --sampler random')
    rooks = spectra('--sampler nrooks --n 1024 --sets 40 --direction 1,2 --resolution 512')
    command = f'clshear {words} --sampler nrooks --direction 1,2 --resolution 512'
    yield row('nrooks-axis', 'N-rooks: dark lines along the axes …', '→ 0',
              power(rooks, 'along 1:0', 8, 64), DARK, command)
    yield row('nrooks-profile', '… where the power is 1D jitter\'s, 1 - sinc²(f / N), over radii 32 to 255',
              '1 × that', over_closed_form(rooks, 'along 1:0', range(32, 256),
                                           lambda f: 1 - sinc2(f / 1024)), ONE, command)
    yield row('nrooks-elsewhere', '… and white elsewhere', '1', power(rooks, 'along 1:2', 8, 64),
              ONE, command)
    jittered = spectra('--sampler jittered --n 1024 --sets 40')
    yield row('jittered-centre', 'jittered: a dark centre; power on the diagonal over 1 - sinc²(x / 32) sinc²(y / 32), '
              'radii 2 to 24', '1 × that',
              over_closed_form(jittered, 'along 1:1', range(2, 25), on_diagonal), ONE,
              f'clshear {words} --sampler jittered')
    for plane in ('xy', 'uv'):
        mj = spectra(f'--sampler mj --n 1024 --sets 40 --projection {plane}')
        command = f'clshear spectrum --n 1024 --sets 40 --projection {plane} --sampler mj'
        first = '' if plane == 'xy' else 'uv-'
        yield row(f'{first}mj-cross', f'multi-jittered, {plane.upper()}: the cross, radii 8 to 64 along {plane[0]}',
                  '→ 0', power(mj, 'along 1:0', 8, 64), DARK, command)
        yield row(f'{first}mj-centre', '… and the dark centre, radii 1 to 8 on the diagonal', '≪ 1',
                  power(mj, 'along 1:1', 1, 8), MUCH_LESS, command)
        yield row(f'{first}mj-outside', '… and white outside both, radii 48 to 64 on the diagonal', '1',
                  power(mj, 'along 1:1', 48, 64), ONE, command)


def scatter(tables):
    """Variance over a ring, in units of the square of its mean, times the number of sets: 1 where a single
    set's power has an exponential distribution. The column is in decibels, and as for ten sets."""
    return interval([10.0 * statistics.fmean(10.0 ** (float(row['anisotropy_db']) / 10.0) for row in rows
                                             if 8 <= int(row['radius']) <= 64) for rows in tables])


def on_diagonal(radius):
    """Closed form of jittering in 32 x 32 strata at the frequency next to the diagonal."""
    f = round(radius / math.sqrt(2.0))
    return 1.0 - sinc2(f / 32.0) ** 2


def fibre(a, shear):
    """t for which the part `a` of all x + shear u is below t: the inverse of a trapezoid's distribution."""
    low, high = min(1.0, shear), max(1.0, shear)
    ramp = low / (2.0 * high)
    if a < ramp:
        return math.sqrt(2.0 * low * high * a)
    if a <= 1.0 - ramp:
        return low + (a - ramp) * high
    return 1.0 + shear - math.sqrt(2.0 * low * high * (1.0 - a))


@functools.lru_cache(maxsize=None)
def on_the_line(radius, shear=3, strata=1024, steps=8):
    """Power at (f, shear f), the frequency next to `radius`, of points whose first coordinate a is jittered in
    strata: 1 less the mean over strata of the squared mean of exp(2 pi i f t(a)) in each (equal-area.md)."""
    f = max(1, round(radius / math.hypot(1, shear)))
    kept = 0.0
    for stratum in range(strata):
        waves = [cmath.exp(2j * math.pi * f * fibre((stratum + (k + 0.5) / steps) / strata, shear))
                 for k in range(steps)]
        kept += abs(sum(waves) / steps) ** 2
    return 1.0 - kept / strata


@group
def blue_noise():
    for sampler, count, low, high, expected, words in [
            ('poisson', 1024, 1, 8, NOT_DARK, 'some power'), ('ccvt', 144, 1, 3, DARK, '→ 0')]:
        tables = spectra(f'--sampler {sampler} --n {count} --sets 64 --fresh-sets --resolution 64')
        yield row(f'{sampler}-centre', f'{sampler}: power left in the centre, radii {low} to {high}',
                  words, power(tables, 'mean', low, high), expected,
                  f'clshear spectrum --sampler {sampler} --n {count} --sets 64 --fresh-sets --resolution 64')


@group
def pairs():
    base = '--sampler mj --n 1024 --sets 40 --direction 1,3'
    plain = spectra(f'{base} --projection xu')
    command = f'clshear spectrum {base} --projection xu'
    yield row('xu-axes', 'multi-jittered pairs, XU: hairlines along the axes …', '→ 0',
              power(plain, 'along 1:0', 8, 64), DARK, command)
    yield row('xu-centre', '… and no dark centre, radii 1 to 8 on the diagonal', '1',
              power(plain, 'along 1:1', 1, 8), ONE, command)
    yield row('xu-slant', '… which miss the line of an integrand at a slant, ω_u = 3 ω_x', '1',
              power(plain, 'along 1:3', 8, 64), ONE, command)
    for plane in ('xu', 'yv'):
        tables = spectra(f'{base} --projection {plane} --shear-px 3')
        yield row(f'{plane}-sheared', f'sheared by 3 pixels, those of {plane.upper()} lie on it', '→ 0',
                  power(tables, 'along 1:3', 8, 64), DARK,
                  f'clshear spectrum {base} --projection {plane} --shear-px 3')
        yield row(f'{plane}-sheared-profile', '… where its power is that of its closed form', '1 × that',
                  over_closed_form(tables, 'along 1:3', range(8, 65), on_the_line), ONE,
                  f'clshear spectrum {base} --projection {plane} --shear-px 3')
    for plane in ('xv', 'yu'):
        tables = spectra(f'{base} --projection {plane} --shear-px 3')
        yield row(f'{plane}-white', f'no others are sheared: {plane.upper()} stays white on that line',
                  '1', power(tables, 'along 1:3', 8, 64), ONE,
                  f'clshear spectrum {base} --projection {plane} --shear-px 3')


def pictures(folder, work, mosaic):
    """Planes of power, and profiles along directions."""
    names = []
    for sampler, plane, more in [('nrooks', 'xy', ''), ('jittered', 'xy', ''), ('mj', 'xy', ''),
                                 ('mj', 'xu', ''), ('mj', 'xu', '--shear-px 3')]:
        names.append(str(work / f'spectrum-{len(names)}.png'))
        clshear(f'spectrum --sampler {sampler} --n 256 --projection {plane} --sets 400 --resolution 128 '
                f'{more} --out {names[-1]}')
    mosaic(names, '5x1', folder / 'spectra.png', ['--resize:filter=box', '1312x256'])
    clshear('spectrum --sampler mj --n 1024 --projection xu --shear-px 3 --direction 1,3 --sets 400 '
            f'--plot {folder}/profiles.png')
