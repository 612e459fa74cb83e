"""Jobs: what the robot is asked to do, phase by phase, with a journal that survives."""
