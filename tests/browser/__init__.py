"""Browser tests of the web pages, with the machine's Chromium."""
