"""A server that dies at any instant, in a garage that does not: all in virtual time."""
