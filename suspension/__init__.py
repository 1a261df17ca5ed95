"""A half-robot on springs and dampers that drives over a bump (MIT 2.086, Problem Set 4)."""
