"""Web Push: tells phones that a job has ended, failed, or that the robot needs a person."""
