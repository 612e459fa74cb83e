"""What takes minutes: `make rig` runs it, plain pytest does not."""
