"""The facts of the problem set, and nothing else: what belongs to its robot, road and runs.

General tools take such facts as arguments. Table 1 is typed once, as the defaults of `Robot`, and
the bump of `Hgauss` once, as those of `GaussianBump`; here they can be read.
"""

from dataclasses import MISSING, fields

from suspension.road import GaussianBump
from suspension.robot import Robot

__all__ = [
    "BUMP",
    "DELTA_MAX",
    "DISTANCE",
    "DURATION",
    "HALVED_STEPS",
    "SPEEDS",
    "START",
    "STEPS",
    "TABLE_1",
]

TABLE_1 = {
    field.name: field.default
    for field in fields(Robot)
    if field.init and field.default is not MISSING
}  # SI units; the stiffnesses come from Part I
BUMP = GaussianBump()  # Appendix, item 3: `Hgauss`
SPEEDS = (0.25, 1.2, 5.0, 10.0)  # m/s, Questions 2, 3, 6 and 10
STEPS = (0.2, 0.1, 0.001)  # s, Questions 4, 7 and 9
HALVED_STEPS = (0.001, 0.0005)  # s, Questions 5 and 6; the first is that of Question 10, too
START = (0.0, 0.0, 0.1, 0.0)  # [m, m/s, rad, rad/s], the initial state of Questions 5 and 9
DURATION = 2.0  # s, Questions 5 and 9
DISTANCE = 1.25  # m, Questions 6 and 10: a run ends at t = 1.25 / v
DELTA_MAX = 0.0165  # m, Appendix, item 2: the largest displacement that was measured
