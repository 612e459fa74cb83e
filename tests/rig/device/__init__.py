"""The real serial driver at a pseudo terminal, in real time: only what lock step leaves out."""
