"""What counts as agreement with a claim: rules, each with its reason, that no row is fitted to.

An expectation is a pair of bounds. Where both are finite, the interval of a figure has to meet them;
where one is infinite (a claim of more or less) it has to lie within them whole."""
import math

# The rates that theory knows for pairs and for strata of four dimensions, with edges or without.
RATES = (-1.0, -1.25, -1.5, -2.0)


def rate(slope):
    """The slopes that are nearer to this rate than to the others; outside as far as inside."""
    place = RATES.index(slope)
    nearer = [abs(slope - other) / 2.0 for other in RATES[max(place - 1, 0):place + 2] if other != slope]
    above = nearer[0]
    below = nearer[-1]
    return slope - below, slope + above


STEEP = (-math.inf, rate(-1.5)[1])  # N^-1.5 or steeper
ONE = (0.95, 1.05)      # a ratio of 1; the sums of predictions and closed forms are truncated
NONE = (-0.05, 0.05)    # a difference of 0 between two slopes, alike
DARK = (-math.inf, 0.02)            # power that goes to 0: 17 dB below random points
NOT_DARK = (0.02, math.inf)
MUCH_LESS = (-math.inf, 0.1)
MUCH_MORE = (10.0, math.inf)        # also "tenfold", "an order of magnitude"
MORE = (1.0, math.inf)
LESS = (-math.inf, 1.0)
LITTLE = (0.5, 2.0)                 # a gain that is none or little
MOST = (0.5, math.inf)              # of a picture's pixels
FEW = (-math.inf, 0.1)
STEEPER = (-math.inf, 0.0)          # a difference of two slopes
OPEN = (-math.inf, math.inf)        # the literature says nothing
