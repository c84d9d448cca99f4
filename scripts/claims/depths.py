"""Rows on the shear of a pixel: how it follows from depth and focus."""
import random
import statistics

import measure
import slices
from expectation import DARK, ONE
from measure import at_once, interval
from rows import group, row

# Pixels that see one surface, on both sides of the plane in focus.
PIXELS = [(302, 130), (146, 330), (60, 256), (302, 40), (256, 505), (505, 256), (300, 500)]
COMMAND = f'clshear slice {slices.scene} --pixel 302,130 --resolution 32,128'


@group
def depths():
    formula = at_once(lambda p: slices.of_depth(slices.depth_at(p)), PIXELS)
    chance = random.Random(measure.first_seed)  # of the place (y, v) of a slice, one of each part of [0, 1)
    places = [round((k + chance.random()) / measure.BATCHES, 4) for k in range(measure.BATCHES)]
    fits = [at_once(lambda p, at=at: slices.fitted(slices.slice_of(p, at)), PIXELS) for at in places]

    def coefficient(fit, keep):
        chosen = [(s, f) for s, f in zip(formula, fit) if keep(s)]
        return sum(s * f for s, f in chosen) / sum(s * s for s, _ in chosen)

    for name, what, keep in [('depth-behind', 'behind the focus', lambda s: s < 0),
                             ('depth-before', 'before the focus, where its sign is the other',
                              lambda s: s > 0)]:
        yield row(name, f'shear fitted to slices over (A/w)(F/z - 1), {what}', '1',
                  interval([coefficient(fit, keep) for fit in fits]), ONE, COMMAND)
    parts = at_once(lambda at: slices.along_u(slices.slice_of((242, 488), at)), places)
    whole = statistics.fmean(total for _, total in parts)
    yield row('focus-along-u', 'in focus: part of a pixel\'s variance that is along u', '0',
              interval([along / whole for along, _ in parts]), DARK, COMMAND.replace('302,130', '242,488'))
