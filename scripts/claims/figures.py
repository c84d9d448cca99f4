"""Whether the figures in the documents agree with the measured intervals, or say where they come from.

A figure that a row measures is followed by an HTML comment with the row's name, which does not show
in the rendered page: -1.46<!-- wall-sheared -->. The last number before the comment on its line is
the figure, as precise as it is written. Where its interval stands beside it, the interval is not read.

A figure that no row measures has its source in a comment on a line of its own, before its paragraph or
table: <!-- from bench/lenses.sh -->, or after a heading for the section: <!-- section from ... -->. A source
is a file of the tree, `ctest NAME`, or one of WORDS."""
import re

MARK = re.compile(r'<!-- ([a-z0-9-]+) -->')
SOURCE = re.compile(r'^<!-- (section )?from (.+) -->$')
NUMBER = re.compile(r'(?<![\w.])[-−]?\d+(?:\.\d+)?(?:e[-+−]?\d+)?|(?<=\^)[-−]?\d+(?:\.\d+)?')
MINUS = str.maketrans('−', '-')
# What looks like a figure of a gain or a slope.
CLAIMED = re.compile(r'N\^[-−]\d[\d.]*|\d(?:\.\d+)?(?= times)|(?<![\w.,^])[-−]\d\.\d+(?!\d*e)|(?<=factor of )\w+')
GENERATED = ('reproduction.md', 'settings.md')
# theory: derived, not measured. definition: chosen. machine: timings, on the machine that the page names.
# command: that of the page, given in the text. once: with code that is no more in the tree.
WORDS = ('theory', 'definition', 'machine', 'command', 'once')


def bounds(text):
    """The numbers that round to a figure as it is written."""
    digits, _, exponent = text.partition('e')
    places = len(digits.partition('.')[2])
    half = 0.5 * 10.0 ** (-places + int(exponent or 0))
    return float(text) - half, float(text) + half


def fault_of(line, mark, rows):
    """What is wrong with one marked figure, or None."""
    name, figures = mark.group(1), NUMBER.findall(line[:mark.start()])
    if name not in rows or not figures:
        return f'{name} is no row' if figures else f'no figure before {name}'
    low, high = bounds(figures[-1].translate(MINUS))
    if high < rows[name].low or low > rows[name].high:
        return (f'{figures[-1]} is not within {rows[name].low:.4g} … {rows[name].high:.4g}, which {name} '
                'measures')
    return None


def faults(paths, rows):
    """One line for each figure whose interval excludes it, and the number of figures."""
    wrong, count = [], 0
    for path in paths:
        for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
            for mark in MARK.finditer(line):
                count += 1
                fault = fault_of(line, mark, rows)
                if fault:
                    wrong.append(f'{path}:{number}: {fault}')
    return wrong, count


def prose(path):
    """(number, line, source) of the lines of text and tables; source is None where there is none."""
    fenced, section, block = False, None, None
    for number, line in enumerate(path.read_text(encoding='utf-8').splitlines(), 1):
        source = SOURCE.match(line)
        fenced ^= line.startswith('```')
        if line.startswith('#'):
            section = block = None
        elif not line.strip():
            block = None
        elif source and source.group(1):
            section = source.group(2)
        elif source:
            block = source.group(2)
        if not fenced and not line.startswith(('    ', '```', '<!--', '#')):
            yield number, line, block or section


def is_marked(line, figure):
    """Whether a row's name follows a figure, its interval, or the row of a table that it stands in."""
    rest = line[figure.end():]
    return bool(re.match(r'[\d.]*(<!--|[^|]{0,40}?\)?<!--)', rest)) or in_interval(line, figure)


def in_interval(line, figure):
    """Whether a figure is within (… … …) behind a marked one."""
    before, opened = line[:figure.start()], line.rfind('(', 0, figure.start())
    closed = line.find(')', opened)
    return (opened >= 0 and closed >= figure.end() and ' … ' in line[opened:closed]
            and bool(re.search(r'<!-- [a-z0-9-]+ --> $', before[:opened])))


def unmarked(path, whatever=False):
    """(number, line) of the lines with a figure of a gain or slope, or with any number at all, that is
    neither marked nor has a source."""
    pattern = NUMBER if whatever else CLAIMED
    for number, line, source in prose(path):
        if source is None and any(not is_marked(line, f) for f in pattern.finditer(MARK_TEXT.sub(blank, line))):
            yield number, line


MARK_TEXT = re.compile(r'`[^`]*`|\]\([^)]*\)')


def blank(match):
    """Code and addresses are no figures; the columns stay."""
    return ' ' * len(match.group())


def unsaid(paths, root):
    """One line for each figure that does not say where it comes from, and each source that is not there."""
    tests = (root / 'tests' / 'CMakeLists.txt').read_text(encoding='utf-8')
    wrong = []
    for path in (p for p in paths if p.name not in GENERATED):
        wrong += [f'{path}:{number}: a figure without a row or a source: {line.strip()[:60]}'
                  for number, line in unmarked(path)]
        for line in path.read_text(encoding='utf-8').splitlines():
            source = SOURCE.match(line)
            if source and not is_source(source.group(2), root, tests):
                wrong.append(f'{path}: there is no source {source.group(2)}')
    return wrong


def is_source(text, root, tests):
    first, *rest = text.split()
    if first == 'ctest':
        return bool(rest) and re.search(rf'\b{re.escape(rest[0])}\b', tests) is not None
    return first in WORDS or (root / first).is_file()
