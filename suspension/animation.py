"""The problem set's ``animate_robot``, by its name; drawn in `suspension.figures.robot`."""

from suspension.figures.robot import animate_robot

__all__ = ["animate_robot"]
