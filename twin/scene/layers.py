"""Depths of the parts in front of the wall, and places of the room [mm, base frame].

The published design says where the joints are in the wall plane, not how its parts are stacked
in depth. These are this picture's own choices; no calculation uses them. The bars run behind the
camera, whose mount is part of the robot's configuration.
"""

WALL_Z = -165.0
RAIL_BACK_Z, RAIL_FRONT_Z = -150.0, -112.0
CARRIAGE_BACK_Z, CARRIAGE_FRONT_Z = -110.0, -94.0
BAR_BACK_Z, BAR_FRONT_Z = -88.0, -72.0
PLATFORM_BACK_Z, PLATFORM_FRONT_Z = -68.0, -54.0

RAIL_OVERHANG = 100.0
"""Length of the rails beyond the ends of the base, so that 1300 mm of base make 1500 mm."""

FLOOR_Y = -330.0

WALLBOX_GAP = 190.0
"""Distance of the charging station's middle from the end of the base."""
WALLBOX_Y = 560.0
