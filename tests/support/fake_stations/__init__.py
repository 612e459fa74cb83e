"""Stations and managers that answer on a real socket of this machine, as the real ones do."""
