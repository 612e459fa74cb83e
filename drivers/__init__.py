"""What touches the world: robots, cameras and charging stations, each behind one small protocol.

This package imports ``twin`` and knows neither HTTP nor jobs.
"""
