"""Runs clshear in independent batches and turns what they print into figures with intervals."""
import concurrent.futures
import csv
import functools
import io
import math
import os
import pathlib
import statistics
import subprocess
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
program = os.environ.get('CLSHEAR', str(root / 'build' / 'clshear'))
BATCHES = 6
first_seed = 0  # of a run of scripts/reproduce; batches count up from it
jobs = 1        # batches at once, each on one core

# 97.5 % quantile of Student's t with 1, 2, ... degrees of freedom.
STUDENT = [12.71, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262]


@functools.lru_cache(maxsize=None)
def clshear(words):
    """Standard output of `clshear WORDS`; the same words run once."""
    alone = {} if jobs == 1 else {'POCL_MAX_PTHREAD_COUNT': '1'}
    done = subprocess.run([program, *words.split()], cwd=root, env={**os.environ, **alone},
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f'clshear {words}: {done.stderr.strip()}')
    return done.stdout


def at_once(function, values):
    """[function(v) for v in values], some at a time."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(function, values))


def table(words):
    """The rows of a table in CSV."""
    return list(csv.DictReader(io.StringIO(clshear(words + ' --out -'))))


def seeds(batches=BATCHES):
    """Every other one: `predict` measures with the next."""
    return range(1000 * first_seed, 1000 * first_seed + 2 * batches, 2)


def tables(words, batches=BATCHES):
    """The tables of `clshear WORDS`, one a seed."""
    return at_once(lambda seed: table(f'{words} --seed {seed}'), seeds(batches))


def interval(values):
    """Mean and 95 % interval of independent values, by Student's t."""
    mean = statistics.fmean(values)
    half = STUDENT[len(values) - 2] * statistics.stdev(values) / math.sqrt(len(values))
    return mean, mean - half, mean + half


def ratio(logarithms):
    """Interval of a ratio from independent values of its logarithm."""
    return tuple(math.exp(v) for v in interval(logarithms))


def ratio_of(above, below):
    """Interval of the mean of one list of positive values over that of another, pair by pair."""
    return ratio([math.log(a) - math.log(b) for a, b in zip(above, below)])


def spectra(words, batches=BATCHES):
    """The tables of `clshear spectrum`, one a seed."""
    return tables(f'spectrum {words}', batches)


def power(measured, column, low, high):
    """Mean of a column over radii low to high."""
    return interval([statistics.fmean(float(row[column]) for row in rows
                                      if low <= int(row['radius']) <= high) for rows in measured])


class Studies:
    """Variances from `clshear converge`, one study a seed. A curve is named by its shear, or by
    (sampler, shear) where there are several samplers."""

    def __init__(self, words, target=None, batches=BATCHES):
        self.batches = []
        for lines in tables(f'converge {words}', batches):
            curves = {}
            for row in lines:
                if target in (None, row['target']):
                    curve = curves.setdefault((row['sampler'], row['shear']), {})
                    curve[int(row['n'])] = float(row['variance'])
            self.batches.append(curves)

    def curve(self, batch, name):
        if isinstance(name, tuple):
            return batch[name]
        return next(curve for (_, shear), curve in batch.items() if shear == name)

    def slopes(self, name, low=0, high=math.inf):
        """Least squares of log variance over log N for low <= N <= high, of each batch."""
        found = []
        for batch in self.batches:
            points = [(math.log(n), math.log(v)) for n, v in self.curve(batch, name).items()
                      if low <= n <= high]
            x, y = (statistics.fmean(p[i] for p in points) for i in (0, 1))
            found.append(sum((a - x) * (b - y) for a, b in points) /
                         sum((a - x) ** 2 for a, _ in points))
        return found

    def slope(self, name, low=0, high=math.inf):
        return interval(self.slopes(name, low, high))

    def steeper(self, name='equal-area', than='none'):
        """Difference of two slopes."""
        return interval([a - b for a, b in zip(self.slopes(name), self.slopes(than))])

    def logarithms(self, name, n):
        return [math.log(self.curve(batch, name)[n]) for batch in self.batches]

    def gain(self, n, over='none', of='equal-area'):
        """Variance of the curve `over` as a multiple of that of the curve `of`."""
        return ratio([a - b for a, b in zip(self.logarithms(over, n), self.logarithms(of, n))])


def gain_between(one, other, n, name='none', other_name=None):
    """Variance in studies `one` as a multiple of that in studies `other`."""
    pairs = zip(one.logarithms(name, n), other.logarithms(other_name or name, n))
    return ratio([a - b for a, b in pairs])


def predictions(words, batches=BATCHES):
    """The parts of `clshear predict`, one {part: variance} a seed."""
    return [{row['part']: float(row['variance']) for row in lines}
            for lines in tables(f'predict {words}', batches)]


def part_over(parts, above, below='predicted'):
    """Interval of one part over another."""
    return ratio_of([p[above] for p in parts], [p[below] for p in parts])


def maps(words, batches):
    """The lines of the map that `clshear WORDS` writes, one list of {column: text} a seed."""
    def one(seed):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, 'map.csv')
            clshear(f'{words} --seed {seed} --map {path}')
            with open(path, newline='', encoding='utf-8') as stream:
                return list(csv.DictReader(stream))
    return at_once(one, seeds(batches))


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
