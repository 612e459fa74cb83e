"""Webhooks: tell other programs what happens, signed, again and again until they have heard it."""
