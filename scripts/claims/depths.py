"""Rows on the shear of a pixel: how it follows from depth and focus."""
import slices
from measure import interval
from rows import group, row

# Pixels that see one surface, on both sides of the plane in focus.
PIXELS = [(302, 130), (146, 330), (60, 256), (302, 40), (256, 505), (505, 256), (300, 500)]
PLACES = (0.25, 0.5, 0.75)  # of y and v in a slice
COMMAND = f'clshear slice {slices.scene} --pixel 302,130 --resolution 32,128'


@group
def depths():
    formula = [slices.of_depth(slices.depth_at(p)) for p in PIXELS]
    fits = [[slices.fitted(slices.slice_of(p, at)) for p in PIXELS] for at in PLACES]

    def coefficient(fit, keep):
        chosen = [(s, f) for s, f in zip(formula, fit) if keep(s)]
        return sum(s * f for s, f in chosen) / sum(s * s for s, _ in chosen)

    for name, what, keep in [('depth-behind', 'behind the focus', lambda s: s < 0),
                             ('depth-before', 'before the focus, where its sign is the other',
                              lambda s: s > 0)]:
        yield row(name, f'shear fitted to slices over (A/w)(F/z - 1), {what}', '1',
                  interval([coefficient(fit, keep) for fit in fits]), 1, COMMAND)
    in_focus = [slices.share_along_u(slices.slice_of((242, 488), at)) for at in PLACES]
    yield row('focus-along-u', 'in focus: part of a slice\'s variance that is along u', '0',
              interval(in_focus), (0, 0.01), COMMAND.replace('302,130', '242,488'))
