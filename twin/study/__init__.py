"""Study of a robot's design: its figures, the requirements it meets, and a smaller robot.

See README.md beside this file. The figures are drawn by `twin.study.plots`, which loads matplotlib
and is imported only by who draws.
"""
