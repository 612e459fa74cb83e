"""Campaigns: many random situations in virtual time, with figures at the end."""
