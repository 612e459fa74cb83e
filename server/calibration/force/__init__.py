"""The slide as a force gauge, and what good insertions feel like.

`gauge` finds friction, offset and scale from strokes; `insertions` learns the band of a vehicle's
good insertions and notices when they take more than they did.
"""
