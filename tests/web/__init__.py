"""Tests of the web pages (``npm test`` in web/), of their build and of how they are served."""
