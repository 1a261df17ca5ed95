"""Sentences of Part II: the matrix, its modes, and what Crank-Nicolson makes of them."""

import numpy as np

from suspension.report.rows import matrix_rows, mode_name, mode_rows, table
from suspension.report.verdicts import stiffnesses
from suspension.report.words import (
    SPACE,
    Caption,
    count,
    fixed,
    join,
    number,
    percent,
    quantity,
)

__all__ = [
    "coarse",
    "coarse_caption",
    "eigenvalues",
    "halving",
    "matrix",
    "modes",
    "phase_error",
    "road_caption",
]

LIGHT = 0.2  # a damping ratio below it is called light
APPRECIABLE = 0.01  # a change by less than this part of the largest pitch is not
AS_EXPECTED = 0.05  # how far, relatively, an observed factor may be from the promised one
ROUNDOFF = 1e-9  # part of the largest error, below which an error is none
TOGETHER = 0.02  # an error by less than this part of the largest pitch cannot be seen
ABOUT = 0.05  # a rate that is wrong by less than this part of itself is about right
UNDAMPED = 1e-9  # a decay by less than this part of the size of lambda is roundoff of the solver
SAME_SHARE = 1e-9  # of heave: what roundoff may part in a conjugate pair
HARDLY = 0.2  # below this part of the true rate, a swing hardly dies away


def matrix(robot, fit):
    """Answer 3(i): the entries of A, and where the stiffnesses in them come from."""
    source = " from Part I,"
    if not robot.k1 == robot.k2 == float(fit.stiffness):
        source = f", chosen here (Part I found {quantity(fit.stiffness, 'N/m', 4)}),"
    sentence = f"With {stiffnesses(robot, 4)}{source} row $i$ and column $j$ of $A$ hold"
    return f"{sentence}\n\n{table(matrix_rows(robot.A))}"


def eigenvalues(robot):
    """Answer 3(ii): the eigenvalues of A, and which mode each belongs to."""
    kinds = {
        2: "two conjugate pairs, one for each mode",
        1: "one conjugate pair, a mode that swings, and two real numbers, a mode that creeps back",
        0: "four real numbers: neither mode swings",
    }
    pairs = int((robot.eigenvalues.imag > 0).sum())
    return f"The eigenvalues are {kinds[pairs]}:\n\n{table(mode_rows(robot))}"


def modes(robot):
    """What the eigenvalues mean for what follows: damping, and the mode that limits the step."""
    z = robot.eigenvalues
    ratios = -z.real / np.abs(z)
    shown = sorted({fixed(ratio, 3) for ratio in ratios})
    ratio = f"damping ratio{'s' if len(shown) > 1 else ''} {join(shown)}"
    if ratios.max() < UNDAMPED:
        damping = "The robot is *undamped*: the eigenvalues lie on the imaginary axis."
    elif ratios.max() < LIGHT:
        damping = (
            f"The robot is *lightly* damped ({ratio}): the eigenvalues lie close to the imaginary "
            "axis."
        )
    else:
        damping = f"The damping is not light ({ratio}): the eigenvalues lie off the imaginary axis."
    slow, fast = (mode_name(robot, int(k)) for k in (np.abs(z).argmin(), np.abs(z).argmax()))
    limit = f"And {fast} is the faster mode, so it is {fast} that limits the step."
    if fast == slow:
        limit = "Both modes mix heave and pitch, and the faster of the two limits the step."
    return f"{damping} {limit}"


def road_caption(speeds):
    """Caption of what a wheel feels of the bump at two speeds, m/s."""
    slow, fast = sorted(speeds)
    more = number(fast / slow, 2)
    text = (
        f"What a wheel feels of the bump at {slow:g} and at {fast:g}{SPACE}m/s: the height (left) "
        f"and its rate of change (right). With {more} times the speed the height passes in "
        f"1/{more} of the time, and the rate is {more} times as large."
    )
    alt = (
        "Two panels against time. Left, the height under a wheel, equally high at both speeds, but "
        f"narrower at {fast:g} m/s. Right, its rate: at {fast:g} m/s narrower and larger."
    )
    return Caption(text, alt)


def coarse(robot, scheme, dt):
    """What a long step makes of the pitch: a bold sentence, and the numbers behind it.

    Parameters
    ----------
    robot : Robot
    scheme : Scheme
    dt : float
        Step, s.
    """
    z = _pitch(robot) * dt
    R = complex(scheme.stability_function(z))
    step, kept, left = f"{dt:g}{SPACE}s", percent(np.exp(z.real)), percent(abs(R))
    decay, dies = np.log(abs(R)), z.real
    if z.imag == 0:
        flips = R.real < 0
        head = "flips its sign in every step" if flips else f"creeps back {_pace(decay, dies)}"
        return (
            f"**It {head}.** The robot's pitch does not swing. In {step} the faster part of it "
            f"shrinks to {kept}, the computed one to {left}{' and flips' if flips else ''}."
        )
    if dies > -UNDAMPED * abs(z):
        end = "never dies away, as it should not"
    elif decay > HARDLY * dies:
        end = "hardly dies away"
    else:
        end = f"dies away {_pace(decay, dies)}"
    turned = abs(np.angle(R))
    whose = "the mode that pitches most" if _is_mixed(robot) else "the robot's pitch"
    return (
        f"**It swings {_pace(turned, z.imag)}, and {end}.** In {step} {whose} makes "
        f"{_swings(z.imag)} and keeps {kept} of its size; the computed one makes "
        f"{_swings(turned)} and keeps {left}."
    )


def _pace(computed, true):
    """How fast something goes, beside how fast it should go."""
    ratio = computed / true
    if abs(ratio - 1) < ABOUT:
        return "as it should"
    return "too slowly" if ratio < 1 else "too fast"


def _swings(angle):
    """An angle, rad, in swings."""
    turns = angle / (2 * np.pi)
    return f"{number(turns, 2)} {'of a swing' if turns < 1 else 'swings'}"


def _is_mixed(robot):
    """Whether both modes make up the pitch."""
    return bool(robot.A[3, 0] or robot.A[3, 1])


def _pitch(robot):
    """Eigenvalue of the pitch, 1/s; of a robot that mixes its modes, of the one that pitches most.

    Of a pair the one with a positive imaginary part, of two real ones the faster.
    """
    if _is_mixed(robot):
        least = robot.heave_share.min()
        candidates = robot.eigenvalues[robot.heave_share < least + SAME_SHARE]
    else:
        candidates = np.linalg.eigvals(robot.A[2:, 2:]).astype(complex)
    return max(candidates, key=lambda z: (z.imag, abs(z)))


def coarse_caption(run, exact):
    """Caption of the pitch by very long steps beside the `exact` one at their times, rad."""
    many = count(len(run.T) - 1, "step")
    text = (
        f"The pitch in {many} of {run.dt:g}{SPACE}s by {run.scheme.name} (dots, joined for the "
        "eye), and the exact one (line)."
    )
    off = np.abs(run.W[2] - exact).max() > TOGETHER * np.abs(exact).max()
    lie = "do not lie on it" if off else "lie on it"
    alt = f"Pitch against time: the exact curve, and {many} by {run.scheme.name}, whose dots {lie}."
    return Caption(text, alt)


def halving(runs, exact):
    """Answer 5(iii): whether the result changes, and whether the error falls as it should.

    Parameters
    ----------
    runs : pair of Trajectory
        With a step, and with half of it.
    exact : pair of array_like
        Exact pitch at the times of each, rad.
    """
    pitch, end = runs[1].W[2], runs[1].W[2, -1]
    change, largest = abs(end - runs[0].W[2, -1]), np.abs(pitch).max()
    answer = "No" if change < APPRECIABLE * largest else "Yes"
    yardstick = ""
    if pitch.min() < 0 < pitch.max():
        yardstick = (
            " The first counts: the pitch swings through zero, and beside a value near zero any "
            "change looks large."
        )
    return (
        f"*Does it change appreciably? {answer}*: halving the step changes "
        rf"$\tilde\theta(t_\text{{final}})$ by {percent(change / largest)} of the largest pitch "
        f"and by {percent(change / abs(end))} of the value at that instant.{yardstick} *Does the "
        f"error decrease by the expected factor? {_factor(runs, exact)}"
    )


def _factor(runs, exact):
    """Whether the error falls by the expected factor, at the end and over the whole run."""
    coarse, fine = (np.abs(run.W[2] - theta) for run, theta in zip(runs, exact))
    expected = 2 ** runs[0].scheme.order
    overall = coarse.max() / fine.max()
    run = (
        f"the largest error of the whole run falls by a factor of {fixed(overall, 3)}, where a "
        f"method of second order promises {expected}"
    )
    verdict = "Yes*" if abs(overall / expected - 1) <= AS_EXPECTED else "No*"
    if coarse[-1] < ROUNDOFF * coarse.max():
        return f"{verdict}: {run}. At the end the robot is at rest, and no error left."
    at_end = coarse[-1] / fine[-1]
    text = rf"{verdict}: {run}, and the error at $t_\text{{final}}$ by {fixed(at_end, 2)}."
    if abs(at_end / expected - 1) > AS_EXPECTED:
        part = percent(coarse[-1] / coarse.max())
        text += f" The one instant misleads: there the error is {part} of its largest value."
    return text


def phase_error(robot, run, exact):
    """When the error of the pitch is largest, and what is left of it where the pitch turns.

    Parameters
    ----------
    robot : Robot
    run : Trajectory
        On flat ground, let go with a tilt.
    exact : array_like, shape (J+1,)
        Exact pitch at its times, rad.
    """
    error = np.abs(run.W[2] - exact)
    found = (
        rf"the largest error of the run with $\Delta t$ = {run.dt:g}{SPACE}s is "
        f"{quantity(error.max(), 'rad')}, at {fixed(run.T[error.argmax()], 2)}{SPACE}s"
    )
    if _is_mixed(robot):
        return f"Here two modes make up the pitch, each with a lag and a decay of its own: {found}."
    pitch = _pitch(robot)
    if pitch.imag == 0:
        return f"Here the pitch does not swing: it creeps back, and {found}."
    left = percent(-2 * pitch.real / pitch.imag)
    if -pitch.real < UNDAMPED * abs(pitch):
        return f"Here nothing dies away, and the error grows to the end: {found}."
    wins = rf"$1/\beta$ = {fixed(-1 / pitch.real, 2)}{SPACE}s"
    if -pitch.real * run.T[-1] < 1:
        end = quantity(run.T[-1], "s", 1)
        wins = rf"$1/\beta$ is longer than the {end} of the run, so the lag wins"
    return f"Here {wins}, and {found}. Where the pitch turns, {left} of the error's peak is left."
