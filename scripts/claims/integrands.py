"""Rows on analytic integrands of the unit square."""
import math

from measure import Studies, clshear, gain_between, prediction, seeds, table
from rows import group, row

FOURS = '--nsamps 16,64,256,1024,4096'


@group
def steps():
    base = f'--integrand step --size 0.137 --sampler nrooks {FOURS} --nreps 100'
    flat = Studies(f'{base} --angle 0')
    yield row('step-axis', 'N-rooks, step along an axis: slope', '-2', flat.slope('none'), (-2.1, -1.9),
              f'clshear converge {base} --angle 0')
    slanted = Studies(f'{base} --angle 30')
    yield row('step-slant', 'N-rooks, the same step at 30°: slope', '-1', slanted.slope('none'),
              (-1.05, -0.95), f'clshear converge {base} --angle 30')
    nearly = Studies(f'{base} --angle 1 --size 0.137')
    yield row('bend-first', 'a step at 1° has energy off the axis and bends: slope from 16 to 64', '→ -2',
              nearly.slope('none', 16, 64), (-2.2, -1.4), f'clshear converge {base} --angle 1 --local-slopes')
    yield row('bend-last', '… and from 1024 to 4096', '→ -1', nearly.slope('none', 1024, 4096),
              (-1.25, -0.95), f'clshear converge {base} --angle 1 --local-slopes')


@group
def predicted():
    for angle in (0, 30):
        words = (f'--integrand step --size 0.137 --angle {angle} --sampler nrooks --n 256 '
                 '--resolution 511 --measure 4000')
        figure, parts = prediction(words)
        yield row(f'predicted-step-{angle}', f'measured over predicted variance: step at {angle}°, N-rooks',
                  '1', figure, (0.97, 1.03), f'clshear predict {words}')
        if angle == 0:
            isotropic = parts['predicted as isotropic'] / parts['predicted']
            yield row('isotropic-fails', '… where the isotropic formula is too high by a factor of',
                      '≫ 1', (isotropic / figure[0], isotropic / figure[2], isotropic / figure[1]), (10, math.inf),
                      f'clshear predict {words}')
            for cones, expected, told in [(8, (5, math.inf), '≫ 1'), (256, (1, 1.2), '→ 1')]:
                value = parts[f'predicted in {cones} cones'] / parts['predicted']
                yield row(f'cones-{cones}', f'… the sum over {cones} cones of directions, over the whole prediction',
                          told, (value, value * 0.98, value * 1.02), expected, f'clshear predict {words}')


@group
def isotropic_rates():
    """The radial formula gives the rate of samplers whose spectrum is isotropic."""
    for sampler, expected, words in [('random', (-1.02, -0.98), '-1'), ('poisson', (-1.3, -1), '→ -1'),
                                     ('ccvt', (-1.6, -1.4), '-1.5')]:
        counts = (64, 256) if sampler == 'ccvt' else (64, 1024)
        predicted = []
        for n in counts:
            rows = table(f'predict --integrand disk --sampler {sampler} --n {n} --sets 200 '
                         f'--seed {seeds(1)[0]}')
            predicted += [float(r['variance']) for r in rows if r['part'] == 'predicted as isotropic']
        slope = math.log(predicted[1] / predicted[0]) / math.log(counts[1] / counts[0])
        study = Studies(f'--integrand disk --sampler {sampler} --nsamps {counts[0]},{counts[1]} --nreps 1000')
        value, low, high = study.slope('none')
        command = f'clshear converge --integrand disk --sampler {sampler} --nsamps {counts[0]},{counts[1]}'
        yield row(f'{sampler}-rate', f'{sampler}, disk: slope from {counts[0]} to {counts[1]}', words,
                  (value, low, high), expected, command)
        yield row(f'{sampler}-rate-radial', '… less the slope that the radial formula predicts', '0',
                  (value - slope, low - slope, high - slope), (-0.1, 0.1),
                  command.replace('converge', 'predict').split(' --nsamps')[0] + f' --n {counts[1]}')


@group
def few_samples():
    base = '--integrand step --angle 30 --size 0.3333 --nsamps 16,64 --nreps 400'
    jittered = Studies(f'{base} --sampler jittered')
    poisson = Studies(f'{base} --sampler poisson')
    yield row('poisson-few', 'Poisson disk is less noisy than jittering at N = 16: its variance, in units of '
              'jittering\'s, on a slanted step', '< 1', gain_between(poisson, jittered, 16),
              (0, 1), f'clshear converge {base} --sampler poisson,jittered')


def pictures(folder, _work, _mosaic):
    clshear('converge --integrand step --angle 30 --sampler random,nrooks,jittered,mj,sobol,sz '
            f'{FOURS} --plot {folder}/step.png')
