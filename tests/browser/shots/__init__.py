"""Pictures of every page in every state, to be looked at by people: ``make shots``."""
