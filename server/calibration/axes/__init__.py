"""One axis at a time: its switch, its belt, its play."""
