"""Where the socket is: from a picture and the robot's position to a pose in the base frame."""
