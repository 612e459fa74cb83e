"""Who may do what: people and their devices, keys for machines, invitations, the audit trail.

See the README beside this file.
"""

from server.access.access import Access
from server.access.model import Caller
from server.access.operations import MESSAGES, OPERATIONS, TWIN_MESSAGES
from server.access.rights import Need, Role, Scope

__all__ = ["MESSAGES", "OPERATIONS", "TWIN_MESSAGES", "Access", "Caller", "Need", "Role", "Scope"]
