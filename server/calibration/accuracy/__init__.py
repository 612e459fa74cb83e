"""The nine-point check: how exactly the robot goes where it is sent, in the terms of ISO 9283."""
