"""From the modules of a code to its pose: measured edges, robust least squares, covariance."""
