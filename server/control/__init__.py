"""The one owner of the robot: who may move it, how it moves, and what stops it."""
