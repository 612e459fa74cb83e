"""The camera's own numbers, from pictures of the ChArUco board."""
