"""Nine-point checks on paper."""
