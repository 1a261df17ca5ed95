"""The facts of the problem set stand once."""

from suspension import problem
from suspension.course import Hgauss
from suspension.robot import Robot


def test_table_1_is_what_a_robot_is_by_default():
    assert Robot(800, 800, **problem.TABLE_1) == Robot(800, 800)
    assert list(problem.TABLE_1) == "g m Izz L1 L2 c1 c2".split()


def test_the_bump_is_that_of_the_courses_function():
    assert Hgauss(problem.BUMP.centre) == (0.0254, 0)


def test_a_facts_name_is_public_and_its_value_immutable():
    assert {type(getattr(problem, name)) for name in problem.__all__} <= {
        float,
        tuple,
        dict,
        type(problem.BUMP),
    }
