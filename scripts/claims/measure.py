"""Runs clshear in independent batches and turns what they print into figures with intervals."""
import csv
import io
import math
import os
import pathlib
import statistics
import subprocess

root = pathlib.Path(__file__).resolve().parents[2]
program = os.environ.get('CLSHEAR', str(root / 'build' / 'clshear'))
BATCHES = 6
first_seed = 0  # of a run of scripts/reproduce; batches count up from it

# 97.5 % quantile of Student's t with 1, 2, ... degrees of freedom.
STUDENT = [12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262]


def clshear(words):
    """Standard output of `clshear WORDS`."""
    done = subprocess.run([program, *words.split()], cwd=root,
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f'clshear {words}: {done.stderr.strip()}')
    return done.stdout


def table(words):
    """The rows of a table in CSV."""
    return list(csv.DictReader(io.StringIO(clshear(words + ' --out -'))))


def seeds(batches=BATCHES):
    return range(1000 * first_seed, 1000 * first_seed + batches)


def interval(values):
    """Mean and 95 % interval of independent values, by Student's t."""
    mean = statistics.fmean(values)
    half = STUDENT[len(values) - 2] * statistics.stdev(values) / math.sqrt(len(values))
    return mean, mean - half, mean + half


def ratio(logarithms):
    """Interval of a ratio from independent values of its logarithm."""
    return tuple(math.exp(v) for v in interval(logarithms))


def spectra(words, batches=BATCHES):
    """The tables of `clshear spectrum`, one a seed."""
    return [table(f'spectrum {words} --seed {seed}') for seed in seeds(batches)]


def power(tables, column, low, high):
    """Mean of a column over radii low to high."""
    return interval([statistics.fmean(float(row[column]) for row in rows
                                      if low <= int(row['radius']) <= high) for rows in tables])


class Studies:
    """Variances from `clshear converge`, one study a seed. A curve is named by its shear, or by
    (sampler, shear) where there are several samplers."""

    def __init__(self, words, batches=BATCHES):
        self.batches = []
        for seed in seeds(batches):
            curves = {}
            for row in table(f'converge {words} --seed {seed}'):
                curve = curves.setdefault((row['sampler'], row['shear']), {})
                curve[int(row['n'])] = float(row['variance'])
            self.batches.append(curves)

    def curve(self, batch, name):
        if isinstance(name, tuple):
            return batch[name]
        return next(curve for (_, shear), curve in batch.items() if shear == name)

    def slope(self, name, low=0, high=math.inf):
        """Least squares of log variance over log N for low <= N <= high."""
        slopes = []
        for batch in self.batches:
            points = [(math.log(n), math.log(v)) for n, v in self.curve(batch, name).items()
                      if low <= n <= high]
            x, y = (statistics.fmean(p[i] for p in points) for i in (0, 1))
            slopes.append(sum((a - x) * (b - y) for a, b in points) /
                          sum((a - x) ** 2 for a, _ in points))
        return interval(slopes)

    def logarithms(self, name, n):
        return [math.log(self.curve(batch, name)[n]) for batch in self.batches]

    def gain(self, n, over='none', of='equal-area'):
        """Variance of the curve `over` as a multiple of that of the curve `of`."""
        return ratio([a - b for a, b in zip(self.logarithms(over, n), self.logarithms(of, n))])


def gain_between(one, other, n, name='none', other_name=None):
    """Variance in studies `one` as a multiple of that in studies `other`."""
    pairs = zip(one.logarithms(name, n), other.logarithms(other_name or name, n))
    return ratio([a - b for a, b in pairs])


def prediction(words):
    """Measured over predicted variance, with the interval of the measured one; and the table."""
    parts = {row['part']: float(row['variance'])
             for row in table(f'predict {words} --seed {1000 * first_seed}')}
    predicted = parts['predicted']
    return (parts['measured'] / predicted, parts['measured 95% low'] / predicted,
            parts['measured 95% high'] / predicted), parts


def pixels_of(path):
    """All values of an image file, by pixel: {(x, y): [values]}."""
    text = subprocess.run(['oiiotool', '--dumpdata', str(path)], capture_output=True, text=True,
                          check=True).stdout
    found = {}
    for line in text.splitlines():
        if 'Pixel (' in line:
            place, values = line.split('Pixel (')[1].split('):')
            x, y = place.split(',')[:2]
            found[int(x), int(y)] = [float(v) for v in values.split()]
    return found
