"""Checks of the workbook's contact: road, forces, accelerations, the first loss."""

import numpy as np

from suspension.forces import first_loss as _first_loss
from suspension.practice.crank_nicolson import some_robot
from suspension.practice.feedback import (
    Wrong,
    check,
    compare,
    fits,
    name_mistake,
    near,
    off,
    several,
    told,
)
from suspension.road import GaussianBump

__all__ = [
    "check_accelerations",
    "check_first_loss",
    "check_normal_forces",
    "check_road_under_wheels",
]


def _drive(rng):
    """A robot, a bump and a moment at which both wheels are on it."""
    r, bump = some_robot(rng), GaussianBump(0.02, rng.uniform(0.1, 0.2), rng.uniform(0.2, 0.4))
    v = rng.uniform(1.5, 6)
    return r, bump, v, (bump.centre + rng.uniform(-0.1, 0.1)) / v


def _under(robot, road, v, t, rear=None, front=None, rate=None, at=None):
    """``[h1, h2, h1', h2']``, or with something in it changed."""
    x = v * t if at is None else at
    rear, front = -robot.L1 if rear is None else rear, robot.L2 if front is None else front
    (h1, slope1), (h2, slope2) = road(x + rear), road(x + front)
    rate = v if rate is None else rate
    return np.array([h1, h2, rate * slope1, rate * slope2])


@check(
    "road_under_wheels(robot, road, v, t)",
    "each wheel meets the road where it is, and the faster the robot the faster it rises.",
)
def check_road_under_wheels(road_under_wheels, rng):
    """Whether ``road_under_wheels(robot, road, v, t)`` gives h1, h2, h1', h2'."""
    names = ["h1", "h2", "h1'", "h2'"]

    def fails(answer, robot, road, v, t):
        wanted = _under(robot, road, v, t)
        i = int(off(answer, wanted).argmax())
        return (
            f"{names[i]} is {told(answer[i], wanted[i])}. The rear wheel is "
            "at vt − L1, the front one at vt + L2, and h' is v times the slope."
        )

    mistakes = {
        "Rear and front have changed places: wheel 1 is the rear one, at vt − L1.": (
            lambda *case: _under(*case)[[1, 0, 3, 2]],
            lambda r, *case: _under(r, *case, rear=r.L1, front=-r.L2),
        ),
        "The rates lack the speed: dH/dx is a slope, and a wheel climbs it at v times that.": (
            lambda *case: _under(*case, rate=1)
        ),
        "Both wheels are at vt, where the centre of mass is: the arms are missing.": (
            lambda *case: _under(*case, rear=0, front=0)
        ),
        "Both arms have the length L1: the front one is L2 long.": (
            lambda r, *case: _under(r, *case, front=r.L1)
        ),
        "Both arms have the length L2: the rear one is L1 long.": (
            lambda r, *case: _under(r, *case, rear=-r.L2)
        ),
        "Both wheels are ahead of the centre of mass: the rear one is at vt − L1.": (
            lambda r, *case: _under(r, *case, rear=r.L1)
        ),
        "The road is asked at the time t: it is a function of the place, vt.": (
            lambda r, road, v, t: _under(r, road, v, t, at=t)
        ),
        "The order is h1, h1', h2, h2' here; asked for are both heights first.": (
            lambda *case: _under(*case)[[0, 2, 1, 3]]
        ),
    }
    cases = [_drive(rng) for _ in range(4)]
    compare(road_under_wheels, cases, _under, mistakes, "h1, h2, h1', h2'", fails)


def _forces(r, w, h1, h2, hdot1, hdot2, sign=1, lift=(-1, 1), ground=1, damping=1, turning=1):
    """N1 and N2 by Eq. 5, or with something in it changed."""
    Y, Ydot, theta, thetadot = w
    rear, front = lift[0] * r.L1, lift[1] * r.L2
    N1 = r.k1 * (h1 - Y - rear * theta)
    N2 = r.k2 * (h2 - Y - front * theta)
    N1 += damping * r.c1 * (ground * hdot1 - Ydot - turning * rear * thetadot)
    N2 += damping * r.c2 * (ground * hdot2 - Ydot - turning * front * thetadot)
    return sign * np.array([N1, N2])


@check(
    "normal_forces(robot, w, h1, h2, hdot1, hdot2)",
    "springs and dampers press by how far and how fast they are squeezed.",
)
def check_normal_forces(normal_forces, rng):
    """Whether ``normal_forces(robot, w, h1, h2, hdot1, hdot2)`` gives N1 and N2 (Eq. 5)."""

    def with_(**changes):
        return lambda *case: _forces(*case, **changes)

    def fails(answer, r, *rest):
        rest_w, zero = np.array(r.equilibrium), (0.0, 0.0, 0.0, 0.0)
        carried = np.ravel(normal_forces(r, rest_w, *zero)).sum()
        if not near(carried, r.m * r.g, 1e-6):
            return (
                f"At rest the forces sum to {carried:.4g} N, and they carry the weight, "
                f"{r.m * r.g:.4g} N. Is each spring squeezed by h − (Y ∓ Lθ)?"
            )
        raised = np.ravel(normal_forces(r, rest_w, 0.001, 0.001, 0.0, 0.0)) - np.ravel(
            normal_forces(r, rest_w, *zero)
        )
        if not near(raised, [0.001 * r.k1, 0.001 * r.k2], 1e-6):
            return "Ground that rises by 1 mm should add 1 mm times its own k to each force."
        return (
            "At rest, and over ground that is higher, the forces are right. Is each damper "
            "squeezed at h' − (Y' ∓ Lθ'), with its own c and its own L?"
        )

    mistakes = {
        "The forces have the wrong sign: a spring that is squeezed, h above Y, pushes, "
        "N > 0.": with_(sign=-1),
        "The rates of the ground are missing: a damper feels how fast wheel and body approach, "
        "h' − Y'.": with_(ground=0),
        "The rates of the ground count with the wrong sign: h' − Y', as h − Y "
        "in the spring.": with_(ground=-1),
        "The dampers are missing: c times the rate at which each is squeezed.": with_(damping=0),
        "The dampers have the wrong sign: they resist, c (h' − Y' ...), like the springs.": with_(
            damping=-1
        ),
        "Front and rear rise the wrong way round: with θ > 0 the front is higher, Y + L2 θ.": with_(
            lift=(1, -1)
        ),
        "Both ends rise with θ: the rear one sinks, Y − L1 θ.": with_(lift=(1, 1)),
        "The turning of the body, Lθ', is missing in the dampers.": with_(turning=0),
        "N1 and N2 have changed places: wheel 1 is the rear one.": lambda *case: _forces(*case)[
            ::-1
        ],
        "The height of the ground is missing: a spring is squeezed by h − Y, not by −Y.": (
            lambda r, w, h1, h2, *rates: _forces(r, w, 0, 0, *rates)
        ),
        "θ is not multiplied by the arm: the end of the body rises by L θ.": lambda r, w, *u: (
            np.array(
                [
                    r.k1 * (u[0] - w[0] + w[2]) + r.c1 * (u[2] - w[1] + w[3]),
                    r.k2 * (u[1] - w[0] - w[2]) + r.c2 * (u[3] - w[1] - w[3]),
                ]
            )
        ),
    }
    cases = []
    for _ in range(4):
        r, road, v, t = _drive(rng)
        cases.append((r, rng.normal(0, [0.01, 0.2, 0.05, 1.0]), *_under(r, road, v, t).tolist()))
    compare(normal_forces, cases, _forces, mistakes, "N1 and N2", fails)


@check("accelerations(robot, N1, N2)", "forces over m, weight included, and moments over Izz.")
def check_accelerations(accelerations, rng):
    """Whether ``accelerations(robot, N1, N2)`` gives Y'' and θ'' (Eq. 6)."""

    def right(r, N1, N2):
        return np.array([(N1 + N2) / r.m - r.g, (r.L2 * N2 - r.L1 * N1) / r.Izz])

    def with_(heave=None, pitch=None):
        def wrong(r, N1, N2):
            pair = right(r, N1, N2)
            pair[0] = pair[0] if heave is None else heave(r, N1, N2)
            pair[1] = pair[1] if pitch is None else pitch(r, N1, N2)
            return pair

        return wrong

    def fails(answer, r, N1, N2):
        L = r.L1 + r.L2
        rest = np.ravel(accelerations(r, r.m * r.g * r.L2 / L, r.m * r.g * r.L1 / L))
        if abs(rest[0]) > 1e-6:
            return (
                f"With forces that carry the weight Y'' is {rest[0]:.4g} m/s², and should be "
                "0: is the weight there, and everything divided by m once?"
            )
        if abs(rest[1]) > 1e-6:
            return (
                f"With forces whose moments balance θ'' is {rest[1]:.4g} rad/s², and should be "
                "0: does each force have its own arm?"
            )
        return (
            "At rest both are right, for other forces they are not: Y'' is (N1 + N2)/m − g, θ'' is "
            "(L2 N2 − L1 N1)/Izz."
        )

    mistakes = {
        "The weight is missing: without a force the robot falls, at −g.": with_(
            lambda r, N1, N2: (N1 + N2) / r.m
        ),
        "The weight pushes upwards here: Y points up, so its acceleration is −g.": with_(
            lambda r, N1, N2: (N1 + N2) / r.m + r.g
        ),
        "g is divided by m as well: g is an acceleration already, m g the force.": with_(
            lambda r, N1, N2: (N1 + N2 - r.g) / r.m
        ),
        "Y'' is not divided by m: it is a force here.": with_(
            lambda r, N1, N2: N1 + N2 - r.m * r.g
        ),
        "The moment has the wrong sign: the front force, N2, lifts the front, θ > 0.": with_(
            pitch=lambda r, N1, N2: (r.L1 * N1 - r.L2 * N2) / r.Izz
        ),
        "The arms have changed places: N1 acts at L1, N2 at L2.": with_(
            pitch=lambda r, N1, N2: (r.L1 * N2 - r.L2 * N1) / r.Izz
        ),
        "The arms are missing: a moment is a force times its arm.": with_(
            pitch=lambda r, N1, N2: (N2 - N1) / r.Izz
        ),
        "θ'' is divided by m: moments are divided by the moment of inertia Izz.": with_(
            pitch=lambda r, N1, N2: (r.L2 * N2 - r.L1 * N1) / r.m
        ),
        "Both moments have one sign: the rear force lowers the front.": with_(
            pitch=lambda r, N1, N2: (r.L2 * N2 + r.L1 * N1) / r.Izz
        ),
    }
    cases = [(some_robot(rng), *rng.uniform(-3, 30, 2)) for _ in range(4)]
    compare(accelerations, cases, right, mistakes, "Y'' and θ''", fails)


def _forces_in_time(rng):
    """Times and forces, with losses of every kind."""
    T = np.cumsum(rng.uniform(0.001, 0.01, 30))
    kept = rng.uniform(0.01, 20, (2, 30))
    cases = [(T, kept)]
    for rear, front in (([12, 13, 20], []), ([], [5, 6]), ([17], [8, 9, 25]), ([4], [21, 22])):
        N = kept.copy()
        N[0, rear] -= 21
        N[1, front] -= 21
        cases.append((T, N))
    zero = kept.copy()
    zero[1, 14] = 0.0
    zero[1, 18] = -2.0
    return [*cases, (T, zero)]


@check("first_loss(T, N)", "the first force that is zero or less, its wheel and its time, or None.")
def check_first_loss(first_loss, rng):
    """Whether ``first_loss(T, N)`` gives wheel (1 or 2) and time of the first loss, or None."""
    cases = _forces_in_time(rng)
    answers = []
    for case in cases:
        result = first_loss(*case)
        if result is not None:
            wheel, t = several(result, ["wheel", "t"], "first_loss", ndim=1)
            if wheel.size != 1 or t.size != 1:
                raise Wrong("`first_loss` should return one wheel and one time.")
            result = wheel.item(), t.item()
        answers.append(np.array(result or ()))

    def right(T, N):
        return np.array(_first_loss(T, N) or ())

    def chosen(T, lost, number=None, when=lambda lost: lost.any(axis=0).argmax()):
        """Wheel and time of a chosen sample."""
        if not lost.any():
            return np.array(())
        j = when(lost)
        wheel = int(lost[:, j].argmax()) + 1 if number is None else number
        return np.array((wheel, T[j]))

    def alone(i):
        return lambda T, N: chosen(T, (N <= 0) & (np.arange(2) == i)[:, None])

    def rear_first(T, N):
        i = 0 if (N[0] <= 0).any() else 1
        return chosen(T, (N <= 0) & (np.arange(2) == i)[:, None])

    def deepest(T, N):
        i, j = np.unravel_index(N.argmin(), N.shape)
        return np.array((i + 1, T[j])) if N[i, j] <= 0 else np.array(())

    mistakes = {
        "A force of exactly zero counts as pressing here: a wheel that does not press has lost "
        "the ground, N <= 0.": lambda T, N: chosen(T, N < 0),
        "The wheels are counted from 0: they are 1, rear, and 2, front.": (
            lambda T, N: right(T, N) - [1, 0] if right(T, N).size else right(T, N)
        ),
        "This is the number of the sample: the time there, T[j], is asked for.": (
            lambda T, N: (
                np.array((right(T, N)[0], (N <= 0).any(axis=0).argmax()))
                if right(T, N).size
                else right(T, N)
            )
        ),
        "This is the last loss: the first is asked for.": lambda T, N: chosen(
            T, N <= 0, when=lambda lost: np.flatnonzero(lost.any(axis=0))[-1]
        ),
        "This is the time of the least force, when the wheel has long been in the air: the "
        "first sample with N <= 0 is asked for.": deepest,
        "Only the rear wheel is looked at.": alone(0),
        "Only the front wheel is looked at.": alone(1),
        "The rear wheel goes first here, even where the front one is lost earlier: take the "
        "earlier.": (rear_first),
        "Where both wheels press all the time there is a loss reported at the first sample: "
        "`argmax` of nothing but False is 0. Ask `any` before.": lambda T, N: (
            right(T, N) if (N <= 0).any() else np.array((1, T[0]))
        ),
        "The wheels have changed places: row 0 of N is wheel 1, the rear one.": (
            lambda T, N: [3, 0] + [-1, 1] * right(T, N) if right(T, N).size else right(T, N)
        ),
    }
    if fits(answers, cases, right):
        return
    name_mistake(answers, cases, mistakes)
    for answer, (T, N) in zip(answers, cases):
        wanted = right(T, N)
        if not near(answer, wanted):
            truth = (
                f"wheel {wanted[0]:.0f} does not press from {wanted[1]:.4g} s"
                if wanted.size
                else "both wheels press all the time"
            )
            got = f"{answer[0]:.0f}, {answer[1]:.4g}" if answer.size else "None"
            raise Wrong(f"Where {truth}, you return {got}.")
