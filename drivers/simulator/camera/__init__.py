"""The simulated camera: renders what a real one would see, when a real one would see it.

``camera`` holds the driver, ``imaging`` and ``conditions`` its numbers. Nothing is imported here,
so that reading a configuration does not load the renderer.
"""
