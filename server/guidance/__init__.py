"""Parking guidance: tells a driver how far to go. See README.md beside this file."""
