"""The test rig: the real firmware in a simulated microcontroller, with motors and switches."""
