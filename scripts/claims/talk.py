"""The claims of the 2017 talk in its order, and the rows that hold each against measurements."""
import fnmatch

# Number, claim, patterns of the names of rows.
CLAIMS = [
    (1, 'an in-focus pixel has a two-dimensional integrand', ['focus-slope', 'focus-along-u']),
    (2, 'an out-of-focus pixel has a four-dimensional one and is noisier', ['blur-*']),
    (3, 'jitter in four dimensions converges with N^-1.25', ['jittered4d*']),
    (4, 'Poisson disks are less noisy at few samples, with the rate -1', ['poisson-few*', 'poisson-rate-last']),
    (5, 'variance is the integral of sampling spectrum times integrand spectrum', ['predicted-*', 'image-predicted*']),
    (6, 'expected spectra are means over realisations', ['spectrum-is-a-mean']),
    (7, 'isotropic spectra need a radial integral only', ['isotropic-holds', 'isotropic-fails']),
    (8, 'the rates of random, Poisson and CCVT follow from it', ['*-rate', '*-rate-radial', '*-rate-last*',
                                                                 'poisson-centre', 'ccvt-centre']),
    (9, 'N-rooks: a dark cross along the axes', ['nrooks-axis', 'nrooks-elsewhere']),
    (10, 'jittered: a dark centre', ['jittered-centre']),
    (11, 'multi-jittered: cross and dark centre', ['mj-*']),
    (12, 'pairs at random: XU has the cross only, XY and UV have all', ['xu-axes', 'xu-centre', 'uv-mj-*']),
    (13, 'anisotropic variance is a sum over cones, in the limit of many', ['cones-*']),
    (14, 'N-rooks: the jittered profile on the axes, constant elsewhere', ['nrooks-profile', 'nrooks-elsewhere']),
    (15, 'a step along an axis: rate -2', ['step-axis']),
    (16, 'energy in all directions: two regimes, then -1', ['step-slant', 'bend-*']),
    (17, 'the product of spectra explains it, for two pixels', ['product-*']),
    (18, 'multi-jittered pairs miss slanted spectra', ['xu-slant', 'wall-none']),
    (19, 'depth and focal distance give the shear', ['depth-*']),
    (20, 'in focus: no variation along U', ['focus-along-u']),
    (21, 'the shear grows with depth, on both sides of the focus', ['depth-*']),
    (22, 'shear in XU and YV only', ['xu-sheared', 'yv-sheared', 'xv-white', 'yu-white']),
    (23, 'an out-of-focus wall: -1 becomes -1.5', ['wall-none', 'wall-sheared', 'wall-toroidal', 'wall-toroidal-cost',
                                                 'left-*', 'floor-*', 'right-*', 'edge-*', 'plain-*',
                                                 'wall-disk-*', 'wall-hexagon-*', 'wall-anamorphic-*',
                                                 'wall-gaussian-*']),
    (24, 'some pixels: ten times less variance without the rate', ['constant-*']),
    (25, 'Halton and Sobol improve alike', ['wall-halton-*', 'wall-sobol-*', 'wall-sz-*']),
    (26, 'hairlines are thin, so large N only', ['wall-gain-*', 'image-median*']),
    (27, 'all depends on the accuracy of the oracle', ['oracle-*']),
    (28, 'double wedges: little is gained', ['wedge-gain', 'wedge-side', 'wedge-top']),
    (29, 'wider anisotropic structures would help', ['wedge-oa', 'wedge-sz']),
    (30, 'other effects, such as motion blur', ['motion-*']),
]


def of_claim(patterns, rows):
    return [r for r in rows.values() if any(fnmatch.fnmatch(r.name, p) for p in patterns)]


def markdown(rows):
    """A table of the claims: how many of the rows of each agree, and which do not."""
    lines = ['| | claim | rows that agree | that differ or are open |', '|---|---|---|---|']
    for number, claim, patterns in CLAIMS:
        judged = [r for r in of_claim(patterns, rows) if r.verdict]
        good = [r.name for r in judged if r.verdict == 'agrees']
        others = [f'{r.name}{"" if r.verdict == "differs" else " (open)"}' for r in judged if r.name not in good]
        lines.append(f'| {number} | {claim} | {len(good)} of {len(judged)} | {", ".join(others)} |')
    return '\n'.join(lines)


def faults(rows, page):
    """One line for each claim without a row, and for each row that differs and is not explained."""
    wrong = [f'claim {number} has no row' for number, _, patterns in CLAIMS
             if not of_claim(patterns, rows) and number != 30]
    wrong += [f'{r.name} {r.verdict}, and the page does not explain it' for r in rows.values()
              if r.verdict in ('differs', 'open') and f'`{r.name}`' not in page]
    return wrong
