"""The list of rows: each is a claim, what the literature says, and a figure with its interval."""
import csv
import dataclasses
import math

COLUMNS = ['name', 'claim', 'literature', 'value', 'low', 'high', 'expected_low', 'expected_high',
           'command']


@dataclasses.dataclass
class Row:
    name: str        # documents refer to the row by it
    claim: str
    literature: str  # what is expected, in words
    value: float
    low: float       # 95 % interval
    high: float
    expected_low: float  # what counts as agreement
    expected_high: float
    command: str

    @property
    def verdict(self):
        """"agrees", "differs", "open" (the interval is too wide to tell) or "" (nothing is expected)."""
        ends = [math.isinf(self.expected_low), math.isinf(self.expected_high)]
        if all(ends):
            return ''
        if self.high < self.expected_low or self.low > self.expected_high:
            return 'differs'
        inside = self.expected_low <= self.low and self.high <= self.expected_high
        return 'agrees' if inside or not any(ends) else 'open'


groups = {}


def group(function):
    """Registers a function that yields rows."""
    groups[function.__name__] = function
    return function


def row(name, claim, literature, figure, expected, command):
    """`figure` is value, low, high; `expected` a number or a pair of bounds."""
    low, high = expected if isinstance(expected, tuple) else (expected, expected)
    return Row(name, claim, literature, *figure, low, high, command)


def read(path):
    with open(path, newline='', encoding='utf-8') as stream:
        return {line['name']: Row(**{k: v if k in ('name', 'claim', 'literature', 'command')
                                     else float(v) for k, v in line.items()})
                for line in csv.DictReader(stream)}


def write(path, rows):
    with open(path, 'w', newline='', encoding='utf-8') as stream:
        out = csv.writer(stream, lineterminator='\n')
        out.writerow(COLUMNS)
        for r in rows.values():
            out.writerow([f'{v:.4g}' if isinstance(v, float) else v for v in dataclasses.astuple(r)])


def shown(value):
    if value == 0 or math.isinf(value):
        return f'{value:g}'
    return f'{value:.2e}' if abs(value) < 1e-3 or abs(value) >= 1e4 else f'{value:.3g}'


def markdown(rows):
    lines = ['| row | claim | expected | measured | 95 % interval | | command |', '|---|---|---|---|---|---|---|']
    for r in rows.values():
        verdict = r.verdict if r.verdict in ('agrees', '') else f'**{r.verdict}**'
        lines.append(f'| {r.name} | {r.claim} | {r.literature} | {shown(r.value)} | {shown(r.low)} … '
                     f'{shown(r.high)} | {verdict} | `{r.command}` |')
    return '\n'.join(lines)
