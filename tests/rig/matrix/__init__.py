"""Everything that may go wrong, in everything that may be going on."""
