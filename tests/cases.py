"""Other springs for the report's tests, and what no sentence of the report may contain."""

import re

import numpy as np
import pandas as pd

from suspension.springs import fit_spring

DELTA_MAX = 0.0165  # m
STIFFNESSES = (250, 405, 500, 793, 987, 1000, 2300)  # N/m
FORBIDDEN = {
    "a number that is none": r"\b(nan|inf|None(?! of)|True|False)\b",
    "no speeds with a unit": r"(none|no speed)\s*m/s",
    "an exponent as in a program": r"\d[eE][-+−]?\d",
    "a percentage of zero": r"(?<![\d.])0(\.0+)?\s*%",
    "a p-value of zero": r"p\s=\s0(\.0+)?(?![.\d])",
    "more digits than anyone knows": r"\d\.\d{11}",
    "a hyphen for a minus sign": r"(?<![\w)*\]])-\d",
    "a gap": r"\S  +\S| [,.;:](\s|$)|\(\s|\s\)",
    "a doubled word or stop": r"\b(\w+) \1\b|\.\.|,,",
    "an unfilled place": r"\{\w*\}",
}


def readings(stiffness, preload=0.0, curvature=0.0, noise=0.05, points=21):
    """A table of readings: preload and curvature in N, noise in N, the same in every run."""
    x = np.linspace(0, 1, points)
    scatter = np.random.default_rng(1).normal(0, noise, points)
    force = preload + stiffness * DELTA_MAX * x + curvature * x**2 + scatter
    data = pd.DataFrame({"delta_over_delta_max": x, "force": force})
    data.attrs["source"] = "spring_data.mat"
    return data


def loading_and_unloading(stiffness=800, apart=0.5):
    """Forces in N and displacements of a spring that gives back less than it took."""
    x = np.r_[np.linspace(0, 1, 11), np.linspace(0.95, 0.05, 10)]
    way = np.r_[np.ones(11), -np.ones(10)]
    scatter = np.random.default_rng(1).normal(0, 0.05, x.size)
    return stiffness * DELTA_MAX * x + apart * way * np.sqrt(x * (1 - x)) + scatter, x


def fitted(stiffness, **how):
    """The fit of such readings."""
    return fit_spring(readings(stiffness, **how), DELTA_MAX)


def prose(text):
    """Markdown without its code, its mathematics, its links' targets and its table rules."""
    text = re.sub(r"```.*?```", " code ", text, flags=re.DOTALL)
    text = re.sub(r"\$[^$]*\$", "math", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    text = re.sub(r"`[^`]*`", "code", text)
    return "\n".join(line for line in text.splitlines() if not line.startswith("|:-"))


def faults(text):
    """What a text of the report contains of `FORBIDDEN`, each with its place."""
    text = prose(text)
    found = []
    for fault, pattern in FORBIDDEN.items():
        for match in re.finditer(pattern, text):
            found.append(f"{fault}: {text[max(match.start() - 30, 0) : match.end() + 10]!r}")
    if text.count("**") % 2:
        found.append(f"an odd number of ** in {text!r}")
    return found
