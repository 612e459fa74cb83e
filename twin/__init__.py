"""What the robot is: geometry, kinematics, statics, motion, and its picture in 3D.

This package imports neither ``drivers`` nor ``server``.
"""
