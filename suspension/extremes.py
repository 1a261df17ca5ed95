"""The extremes, losses and flights of runs, from their samples and from looks between them.

Nothing is interpolated across a kink. What is interpolated between two samples is the *state*,
by the cubic with its values and its rates: a stop leaves it smooth to the second derivative, a
landing to the first. The forces at a place between samples come from that state by the law itself,
with its stop and with its ground that only pushes.
"""

import numpy as np

__all__ = ["Extremes"]

CELLS = 8  # of a step that is looked at closely
NEAR = 0.05  # of the load: a sampled dip this far above the least force cannot reach it
ALMOST = 0.998  # of a record: a lower sample has no higher value beside it
QUIET = 1e-9  # what rises by less is roundoff

_s = np.linspace(0, 1, CELLS + 1)
# Of the cubic through p0 and p1 with rates r0 and r1 per half step: rows for p0, r0, p1, r1.
CUBIC = np.array([(1 - _s) ** 2 * (1 + 2 * _s), 2 * _s * (1 - _s) ** 2,
                  _s**2 * (3 - 2 * _s), -2 * _s**2 * (1 - _s)])  # fmt: skip
RATE = np.array([-6 * _s * (1 - _s), 2 * (1 - _s) * (1 - 3 * _s),
                 6 * _s * (1 - _s), 2 * _s * (3 * _s - 2)]) / 2  # fmt: skip


class Extremes:
    """What is kept of n runs while they go on, a row of samples at a time.

    Parameters
    ----------
    motion
        With ``forces(p, r, case=None) -> f, N`` (Eq. 5 and what the ground does, N), ``m``, ``g``,
        and ``time``, of half a step, s (shape (n,)), ``loads`` (2, n), and ``pulls``.
    n : int
    dX : float
        Length of a step, m.
    """

    def __init__(self, motion, n, dX):
        self.motion, self.dX = motion, dX
        self.least = np.full(n, np.inf)
        self.places = np.full((2, n), np.inf)  # where each wheel is first lost, m
        # Largest acceleration, m/s^2, compression, m, extension, m, and pitch, rad.
        self.records = np.array([0, -np.inf, 0, 0])[:, None] * np.ones(n)
        self.airtime, self.flights = np.zeros((2, n)), np.zeros((2, n), dtype=int)  # in half steps

    def digest(self, first, p, r, f, N, theta, turn):
        """Take the next samples, of which the second is number `first` of the run.

        A step is decided when the samples before and after it are known too, so the first and the
        last are there for the sake of their neighbours: the next call brings the last three again.

        Parameters
        ----------
        p, r, f, N : ndarray, shape (K, 2, n)
            Compressions, m, their rates per half step, Eq. 5 and normal forces, N.
        theta, turn : ndarray, shape (K, n)
            Pitch, rad, and its rate per half step.
        """
        samples = first, p, r, theta, turn
        np.minimum(self.least, f.min(axis=(0, 1)), out=self.least)
        pressing = N > 0
        middle = f[1:-1]
        dip = (middle < f[:-2]) & (middle <= f[2:])
        dip &= middle < np.maximum(self.least, 0) + NEAR * self.motion.loads.min(axis=0)
        switch = pressing[1:-2] != pressing[2:-1]
        look = (switch | dip[:-1] | dip[1:]).any(axis=1)
        off = ~(pressing[1:-2] | pressing[2:-1])
        self.airtime += 2 * (off & ~look[:, None]).sum(axis=0)
        if first == 0:
            self.places[~pressing[1]] = 0.0
        self._look(look, *samples, decide=True)

        beyond = None
        if self.motion.pulls and np.isfinite(self.lost).any():
            X = self.dX * (first + np.arange(-1, len(p) - 1))
            beyond = X[:, None] > self.lost
        look[:] = False
        for record, value in zip(self.records, self._quantities(N, p, theta, axis=1)):
            if beyond is not None:
                value[beyond] = -np.inf
            best = value.max(axis=0)
            np.maximum(record, best, out=record)
            case = np.flatnonzero(best >= ALMOST * record)
            some = value[:, case]
            middle = some[1:-1]
            peak = (middle > some[:-2] + QUIET) & (middle >= some[2:])
            peak &= middle >= ALMOST * record[case]
            look[:, case] |= peak[:-1] | peak[1:]
        self._look(look, *samples, decide=False)

    def _quantities(self, N, p, theta, axis, case=slice(None)):
        """What records are kept of, in turn; the wheels are along `axis`."""
        (N1, N2), (p1, p2) = np.moveaxis(N, axis, 0), np.moveaxis(p, axis, 0)
        yield np.abs((N1 + N2) / self.motion.m[case] - self.motion.g[case])
        yield np.maximum(p1, p2)
        yield -np.minimum(p1, p2)
        yield np.abs(theta)

    @property
    def lost(self):
        """Where contact was first lost, m; inf if it was not. Shape (n,)."""
        return self.places.min(axis=0)

    def result(self):
        """The fields of a `suspension.sweep.Drive`, each of shape (n,) or (2, n)."""
        lost, pulls = self.lost, self.motion.pulls
        gone = np.isfinite(lost)
        margin = np.where(gone, np.minimum(self.least, 0) if pulls else 0.0, self.least)
        wheel = np.where(gone, 1 + self.places.argmin(axis=0), 0)
        airtime, flights = self.airtime * self.motion.time, self.flights
        if pulls:
            airtime, flights = np.where(gone, np.nan, 0.0) * airtime, 0 * flights
        return margin, lost, wheel, *self.records, airtime, flights

    def _look(self, look, first, p, r, theta, turn, decide):
        """Look closely at some steps, bool (K - 3, n), the first of which follows sample 1."""
        step, case = np.nonzero(look)
        if not step.size:
            return
        ends = step + 1, step + 2
        P = _between(CUBIC, *(x[i, :, case].T for i in ends for x in (p, r)))
        R = _between(RATE, *(x[i, :, case].T for i in ends for x in (p, r)))
        pitch = _between(CUBIC, *(x[i, case] for i in ends for x in (theta, turn)))
        f, N = self.motion.forces(P, R, case)
        X = self.dX * (first + step[:, None] + np.linspace(0, 1, CELLS + 1))
        if decide:
            np.minimum.at(self.least, case, f.min(axis=(0, 2)))
            self._decide(case, X, f, N > 0)
        beyond = X > self.lost[case, None] if self.motion.pulls else None
        values = self._quantities(N, P, pitch, axis=0, case=(case, None))
        for record, value in zip(self.records, values):
            if beyond is not None:
                value[beyond] = -np.inf
            np.maximum.at(record, case, value.max(axis=-1))

    def _decide(self, case, X, f, pressing):
        """Losses and flights in some steps: X of shape (S, cells + 1), forces (2, S, cells + 1)."""
        for i in (0, 1):
            lost = np.flatnonzero(~pressing[i].all(axis=1) & pressing[i, :, 0])
            k = np.argmin(pressing[i, lost], axis=1)
            before, after = f[i, lost, k - 1], np.minimum(f[i, lost, k], 0)
            place = X[lost, k] - (X[lost, k] - X[lost, k - 1]) * after / (after - before)
            np.minimum.at(self.places[i], case[lost], place)
            np.minimum.at(self.least, case[lost], 0.0)
            cells = (pressing[i, :, 1:].astype(float) + pressing[i, :, :-1]) / 2
            np.add.at(self.airtime[i], case, 2 * (1 - cells.mean(axis=1)))
            np.add.at(
                self.flights[i], case, (pressing[i, :, :-1] & ~pressing[i, :, 1:]).sum(axis=1)
            )


def _between(basis, p0, r0, p1, r1):
    """Values between the ends of steps, shape (..., S, cells + 1), from those at the ends."""
    return np.stack([p0, r0, p1, r1], axis=-1) @ basis
