"""Versions of calibrations: kept for ever, put in force on purpose, rolled back in one step.

`values` says what the numbers in force mean for the parts, `comparing` by how much one is worse
than another, and `service` keeps, activates and rolls back.
"""
