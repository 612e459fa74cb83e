"""Calibration: from what was measured to the numbers of this very robot."""
