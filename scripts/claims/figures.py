"""Whether the figures in the documents agree with the measured intervals.

A figure that a row measures is followed by an HTML comment with the row's name, which does not show
in the rendered page: -1.46<!-- wall-sheared -->. The last number before the comment on its line is
the figure, as precise as it is written."""
import re

MARK = re.compile(r'<!-- ([a-z0-9-]+) -->')
NUMBER = re.compile(r'(?<![\w.])[-−]?\d+(?:\.\d+)?(?:e[-+−]?\d+)?|(?<=\^)[-−]?\d+(?:\.\d+)?')
MINUS = str.maketrans('−', '-')


def bounds(text):
    """The numbers that round to a figure as it is written."""
    digits, _, exponent = text.partition('e')
    places = len(digits.partition('.')[2])
    half = 0.5 * 10.0 ** (-places + int(exponent or 0))
    return float(text) - half, float(text) + half


def faults(paths, rows):
    """One line for each figure whose interval excludes it, and the number of figures."""
    wrong, count = [], 0
    for path in paths:
        for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
            for mark in MARK.finditer(line):
                count += 1
                place, name = f'{path}:{number}', mark.group(1)
                figures = NUMBER.findall(line[:mark.start()])
                if name not in rows or not figures:
                    wrong.append(f'{place}: {name} is no row' if figures else f'{place}: no figure before {name}')
                    continue
                low, high = bounds(figures[-1].translate(MINUS))
                if high < rows[name].low or low > rows[name].high:
                    wrong.append(f'{place}: {figures[-1]} is not within {rows[name].low:.4g} … '
                                 f'{rows[name].high:.4g}, which {name} measures')
    return wrong, count
