"""Reads the settings files of scenes (.flags)."""
import re


def read_flags(path):
    """Flags of a .flags file: name to list of values, each a list of numbers or a word, empty where
    the flag has none."""
    flags = {}
    for line in path.read_text().splitlines():
        if line.startswith("--"):
            name, value = (line[2:].split() + [""])[:2]
            numbers = re.fullmatch(r"[-+.,\deE]+", value)
            flags.setdefault(name, []).append(
                [float(part) for part in value.split(",")] if numbers else value)
    return flags
