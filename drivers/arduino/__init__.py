"""The robot's real motion board: an Arduino (Me Auriga) at the end of a USB cable."""
