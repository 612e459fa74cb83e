"""Tests of the web pages: the pages themselves (``npm test`` in web/), how they are served, built."""
