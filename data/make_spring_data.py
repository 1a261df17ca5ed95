"""Write spring_data.csv, the synthetic stand-in for the course's spring_data.mat.

Run from anywhere, with NumPy alone: ``python data/make_spring_data.py``.

21 displacements; a linear spring without preload; Gaussian noise; readings rounded to 0.02 N,
which is a scale that reads to 1 g, doubled as in the course's file. The seed was fixed once and
never tuned.
"""

from pathlib import Path

import numpy as np

TRUE_STIFFNESS = 800.0  # N/m, of the spring pair
DELTA_MAX = 0.0165  # m
NOISE = 0.12  # N, standard deviation
RESOLUTION = 0.02  # N
SEED = 2086


def table():
    """The text of spring_data.csv."""
    x = np.linspace(0, 1, 21).round(2)
    noise = np.random.default_rng(SEED).normal(0, NOISE, x.size)
    force = TRUE_STIFFNESS * DELTA_MAX * x + noise
    force = (RESOLUTION * np.round(force / RESOLUTION)).round(2)
    rows = [f"{float(a)},{float(b)}" for a, b in zip(x, force)]
    return "\n".join(["delta_over_delta_max,force", *rows, ""])


if __name__ == "__main__":
    target = Path(__file__).with_name("spring_data.csv")
    target.write_text(table(), encoding="utf-8", newline="\n")
