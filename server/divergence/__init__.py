"""Feeds the model beside the robot, and spreads the word when the two part."""

from server.divergence.watcher import DivergenceWatcher

__all__ = ["DivergenceWatcher"]
