"""An energy manager, or a station, that does the worst thing at the worst moment."""
