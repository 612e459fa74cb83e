"""One simulated garage behind the robot, camera and station protocols."""
