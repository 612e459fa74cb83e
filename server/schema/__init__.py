"""The wire models: what is said over the network, and how it is spelled."""
