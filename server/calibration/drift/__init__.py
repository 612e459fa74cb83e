"""Every successful job is also a measurement.

`belts` learns from its looks how the belts change, slowly and within bounds; `observing` collects
what a job sees and feels; `service` keeps that, puts small corrections in force as versions of
their own, and says aloud when something has changed by more than was proven.
"""
