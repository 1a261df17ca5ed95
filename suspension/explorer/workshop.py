"""The workshop of schemes: a Butcher tableau to type into, and all that follows from it."""

import matplotlib.pyplot as plt
import numpy as np
import traitlets
from scipy.optimize import minimize_scalar

from suspension import _checks
from suspension.explorer.bundle import PAGE, bundle, style
from suspension.explorer.instrument import LABORATORY, Instrument
from suspension.explorer.settings import REFERENCE
from suspension.explorer.still import svg
from suspension.explorer.tables import unit_bump
from suspension.figures import plot_stability
from suspension.least_force import distance_over
from suspension.road import GaussianBump
from suspension.robot import Robot
from suspension.schemes import RK4, Scheme

__all__ = ["KNOWN", "Workshop"]

# As one writes them: rows of a and the weights b; c are the row sums.
KNOWN = {
    "Euler": ("0", "1"),
    "Midpoint": ("0 0; 1/2 0", "0 1"),
    "Heun": ("0 0; 1 0", "1/2 1/2"),
    "Kutta, order 3": ("0 0 0; 1/2 0 0; -1 2 0", "1/6 2/3 1/6"),
    "RK4": ("0 0 0 0; 1/2 0 0 0; 0 1/2 0 0; 0 0 1 0", "1/6 1/3 1/3 1/6"),
    "3/8 rule": ("0 0 0 0; 1/3 0 0 0; -1/3 1 0 0; 1 -1 1 0", "1/8 3/8 3/8 1/8"),
    "Butcher, order 5": (
        "0 0 0 0 0 0; 1/4 0 0 0 0 0; 1/8 1/8 0 0 0 0; 0 -1/2 1 0 0 0;"
        "3/16 0 0 9/16 0 0; -3/7 2/7 12/7 -12/7 8/7 0",
        "7/90 0 16/45 2/15 16/45 7/90",
    ),
    "Backward Euler": ("1", "1"),
    "Implicit midpoint": ("1/2", "1"),
    "Crank-Nicolson": ("0 0; 1/2 1/2", "1/2 1/2"),
    "SDIRK, order 2": ("1-√2/2 0; √2/2 1-√2/2", "√2/2 1-√2/2"),
    "Gauss-Legendre, order 4": ("1/4 1/4-√3/6; 1/4+√3/6 1/4", "1/2 1/2"),
    "Radau IIA, order 3": ("5/12 -1/12; 3/4 1/4", "3/4 1/4"),
    "Lobatto IIIA, order 4": ("0 0 0; 5/24 1/3 -1/24; 1/6 2/3 1/6", "1/6 2/3 1/6"),
}
SPEEDS = (0.25, 10.0)  # m/s, what the slider offers
STEPS = (0.001, 0.2)  # s


class Workshop(Instrument):
    """A one-step method as a table of numbers that one changes: order, stability, a run.

    In JupyterLab and in a built page the same module draws it.

    Parameters
    ----------
    robot : Robot
        Whose modes and whose run over the bump are shown.
    bump : GaussianBump
    v : float
        Speed, m/s, 0.25 to 10.
    dt : float
        Time step, s, 0.001 to 0.2.
    """

    _esm = bundle(PAGE, "workshop_widget")
    _css = style("explorer", "workshop")

    kind = f"{LABORATORY} se-workshop"
    to = "type into it"

    tableau = traitlets.Dict().tag(sync=True)  # a, b, c as they are typed; does c follow a?
    kept = traitlets.Dict().tag(sync=True)  # one to compare with, or empty
    numbers = traitlets.Dict().tag(sync=True)  # what is typed means; set by the page
    v = traitlets.Float().tag(sync=True)
    dt = traitlets.Float().tag(sync=True)

    def __init__(self, robot, bump, v=1.2, dt=0.02):
        self.robot = _checks.instance("robot", robot, Robot)
        _checks.instance("bump", bump, GaussianBump)
        v, dt = _within("v", v, SPEEDS), _within("dt", dt, STEPS)
        schemes = [
            {"name": name, "a": [row.split() for row in a.split(";")], "b": b.split()}
            for name, (a, b) in KNOWN.items()
        ]
        start = next(scheme for scheme in schemes if scheme["name"] == RK4.name)
        distance = distance_over(robot, bump)
        super().__init__(
            facts={
                "schemes": schemes,
                "ranges": {"v": SPEEDS, "dt": STEPS},
                "robot": {
                    "A": robot.A.tolist(),
                    "C": robot.C.tolist(),
                    "D": robot.D.tolist(),
                    "P": robot.P.tolist(),
                    "equilibrium": robot.equilibrium.tolist(),
                    "weight": (robot.C @ robot.equilibrium).tolist(),
                    "modes": [[z.real, z.imag] for z in robot.eigenvalues],
                },
                "wheels": robot.arms.tolist(),
                "distance": distance,
                "bump": {"height": bump.height, "sigma": bump.sigma},
                "road": unit_bump(bump),
                "reference": {name: getattr(REFERENCE, name).tolist() for name in "abc"},
                "traded": longest_of_order_two(robot.eigenvalues),
            },
            tableau={
                "a": start["a"],
                "b": start["b"],
                "c": [""] * len(start["b"]),
                "follows": True,
            },
            v=v,
            dt=dt,
        )

    @traitlets.validate("v", "dt")
    def _validate(self, proposal):
        name = proposal["trait"].name
        return _within(name, proposal["value"], {"v": SPEEDS, "dt": STEPS}[name])

    @property
    def alt(self):
        """What the still picture shows."""
        stable = RK4.is_stable(self.robot.eigenvalues, self.dt)
        return (
            f"The region of absolute stability of RK4 and the robot's modes at a step of "
            f"{1000 * self.dt:g} ms, which is {'stable' if stable else 'unstable'}."
        )

    @property
    def scheme(self):
        """What is typed, as a `Scheme`; the order is that of the conditions, 5 at most.

        Raises
        ------
        ValueError
            If it is not consistent, or before anything was shown.
        """
        if not self.numbers:
            raise ValueError("numbers must come from the table: display the workshop first")
        return Scheme(**self.numbers)

    def _state(self):
        own = {name: getattr(self, name) for name in ("tableau", "kept", "v", "dt")}
        return super()._state() | own

    def _draw(self):
        with plt.style.context("suspension.figures.report"):
            figure, ax = plt.subplots(figsize=(7.2, 4.2))
            plot_stability(RK4, self.robot.eigenvalues, [self.dt], (-6, 4, -4.5, 4.5), ax=ax)
        return svg(figure)


def _within(name, value, ends):
    low, high = ends
    return _checks.number(name, value, f"from {low:g} to {high:g}", lambda x: low <= x <= high)


def longest_of_order_two(eigenvalues):
    """The longest stable step of an explicit method with three stages and order 2, s.

    Its stability function is ``1 + z + z^2 / 2 + kappa z^3``, and kappa is free.

    Parameters
    ----------
    eigenvalues : array_like
        1/s.
    """

    def limit(alpha):
        a = [[0, 0, 0], [alpha, 0, 0], [0, 1 / 2, 0]]
        return Scheme("", 2, a, [0, 0, 1], [0, alpha, 1 / 2]).max_stable_dt(eigenvalues)

    tried = np.linspace(0, 1, 201)
    best = tried[np.argmax([limit(alpha) for alpha in tried])]
    ends = (best - tried[1], best + tried[1])
    found = minimize_scalar(lambda alpha: -limit(alpha), bounds=ends, method="bounded")
    return float(max(limit(best), -found.fun))
