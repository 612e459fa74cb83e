"""Guided procedures that measure this very robot.

`desk` runs one at a time and shows how far it is; `stand` moves the robot and looks at the label;
each routine is a module of its own. What a routine finds becomes a version that nobody uses yet.
"""
