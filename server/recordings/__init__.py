"""One file for each job: what the robot did, measured and saw, to be watched again."""
