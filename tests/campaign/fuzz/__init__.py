"""Sends whatever an attacker, a broken cable or a strange label may send, for as long as wanted."""
