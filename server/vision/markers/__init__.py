"""Kinds of markers: what is found and read in a picture, before anything is measured."""
