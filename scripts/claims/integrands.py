"""Rows on analytic integrands of the unit square."""
import math

from expectation import DARK, LESS, MUCH_MORE, NONE, ONE, OPEN, rate
from measure import Studies, clshear, gain_between, interval, part_over, predictions, ratio
from rows import group, row

FOURS = '--nsamps 16,64,256,1024,4096'


@group
def steps():
    base = f'--integrand step --size 0.137 --sampler nrooks {FOURS} --nreps 100'
    yield row('step-axis', 'N-rooks, step along an axis: slope', '-2',
              Studies(f'{base} --angle 0').slope('none'), rate(-2.0), f'clshear converge {base} --angle 0')
    yield row('step-slant', 'N-rooks, the same step at 30°: slope', '-1',
              Studies(f'{base} --angle 30').slope('none'), rate(-1.0), f'clshear converge {base} --angle 30')
    # At a third, every N cuts a row at a third or two thirds of it: no other N is luckier.
    words = ('--integrand step --size 0.33333333 --angle 1 --sampler nrooks --nsamps 4,16,1024,4096 '
             '--nreps 400')
    bent = Studies(words)
    command = f'clshear converge {words} --local-slopes'
    yield row('bend-first', 'a step at 1° has energy off the axis and bends: slope from 4 to 16', '→ -2',
              bent.slope('none', 4, 16), rate(-2.0), command)
    yield row('bend-last', '… and from 1024 to 4096', '→ -1', bent.slope('none', 1024, 4096), rate(-1.0),
              command)


@group
def predicted():
    base = '--integrand step --size 0.137 --n 256 --resolution 511'
    for sampler, angle, sets in [('nrooks', 0, 200), ('nrooks', 30, 200), ('poisson', 0, 64)]:
        fresh = ' --fresh-sets' if sampler == 'poisson' else ''
        words = f'{base} --angle {angle} --sampler {sampler} --sets {sets} --measure 1000{fresh}'
        parts = predictions(words)
        shown = f'clshear predict {words}'
        name = f'{angle}' if sampler == 'nrooks' else sampler
        yield row(f'predicted-step-{name}', f'measured over predicted variance: step at {angle}°, {sampler}',
                  '1', part_over(parts, 'measured'), ONE, shown)
        isotropic = part_over(parts, 'predicted as isotropic')
        if sampler == 'poisson':
            yield row('isotropic-holds', '… where the spectrum is isotropic and its radial mean is enough: '
                      'the isotropic formula over the whole prediction', '1', isotropic, ONE, shown)
        elif angle == 0:
            yield row('isotropic-fails', '… where the isotropic formula is too high by a factor of', '≫ 1',
                      part_over(parts, 'predicted as isotropic', 'measured'), MUCH_MORE, shown)
            yield from cones(parts, shown)


def cones(parts, shown):
    """The sum over cones goes to the whole sum as their number grows."""
    for count, expected, told in [(8, MUCH_MORE, '≫ 1'), (64, OPEN, '–'), (256, OPEN, '–')]:
        yield row(f'cones-{count}', f'… the sum over {count} cones of directions, over the whole prediction',
                  told, part_over(parts, f'predicted in {count} cones'), expected, shown)

    def excess(count):
        return [p[f'predicted in {count} cones'] - p['predicted'] for p in parts]

    yield row('cones-limit', '… what 256 cones are too high by, over what 8 are', '→ 0',
              ratio([math.log(a / b) for a, b in zip(excess(256), excess(8))]), DARK, shown)


@group
def isotropic_rates():
    """The radial formula gives the rate of samplers whose spectrum is isotropic."""
    for sampler, counts, expected, words in [('random', (64, 1024), rate(-1.0), '-1'),
                                             ('poisson', (64, 1024), OPEN, '–'),
                                             ('poisson', (1024, 4096), rate(-1.0), '→ -1'),
                                             ('ccvt', (36, 144), rate(-1.5), '-1.5')]:
        fresh = '' if sampler == 'random' else ' --fresh-sets'
        words_of = [f'--integrand disk --sampler {sampler} --n {n} --sets 64 --measure 1000{fresh}'
                    for n in counts]
        parts = [predictions(w) for w in words_of]

        def slopes(part, parts=parts, counts=counts):
            return [math.log(b[part] / a[part]) / math.log(counts[1] / counts[0]) for a, b in zip(*parts)]

        name = f'{sampler}-rate' + ('-last' if counts[0] == 1024 else '')
        shown = f'clshear predict {words_of[1]}'
        measured, radial = slopes('measured'), slopes('predicted as isotropic')
        yield row(name, f'{sampler}, disk: slope from {counts[0]} to {counts[1]}', words, interval(measured),
                  expected, shown)
        yield row(f'{name}-radial', '… less the slope that the radial formula predicts', '0',
                  interval([a - b for a, b in zip(measured, radial)]), NONE, shown)
        if sampler == 'ccvt':  # whose power rises within a ring
            yield row(f'{name}-whole', '… less the slope of the sum over all frequencies', '0',
                      interval([a - b for a, b in zip(measured, slopes('predicted'))]), NONE, shown)


@group
def few_samples():
    for name, words in [('', 'step --angle 30 --size 0.3333'), ('-disk', 'disk')]:
        base = f'--integrand {words} --nsamps 16,64 --nreps 400'
        studies = [Studies(f'{base} --sampler {sampler}') for sampler in ('poisson', 'jittered')]
        yield row(f'poisson-few{name}', 'Poisson disk is less noisy than jittering at N = 16: its variance, in units '
                  f'of jittering\'s, on a {"disk" if name else "slanted step"}', '< 1', gain_between(*studies, 16),
                  LESS, f'clshear converge {base} --sampler poisson,jittered')


def pictures(folder, _work, _mosaic):
    clshear('converge --integrand step --angle 30 --sampler random,nrooks,jittered,mj,sobol,sz '
            f'{FOURS} --plot {folder}/step.png')
