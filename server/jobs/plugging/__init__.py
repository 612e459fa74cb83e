"""The plug and its socket: one push in, one pull out, and how to try again."""
