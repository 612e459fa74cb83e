"""How often an unknown address may try to get in."""

from __future__ import annotations

import ipaddress
from collections import OrderedDict
from dataclasses import dataclass

ATTEMPTS = 10
PER_S = 60.0
REMEMBERED = 4096
"""Addresses that are remembered; with more of them the oldest is forgotten."""

IPV6_NETWORK_BITS = 64
"""One household, or one attacker, has a whole network of this size."""


@dataclass(slots=True)
class _Bucket:
    left: float
    at_s: float


class Attempts:
    """A bucket of attempts for each address: some at once, then a steady few.

    Args:
        attempts: Size of the bucket.
        per_s: Time in which an empty bucket fills up [s of the clock that `allow` is told].
    """

    def __init__(self, attempts: int = ATTEMPTS, per_s: float = PER_S) -> None:
        self._attempts = attempts
        self._refill_per_s = attempts / per_s
        self._buckets: OrderedDict[str, _Bucket] = OrderedDict()

    def allow(self, address: str, now_s: float) -> bool:
        """Count an attempt; whether it may be made."""
        key = network_of(address)
        bucket = self._buckets.get(key)
        if bucket is None:
            bucket = self._buckets[key] = _Bucket(float(self._attempts), now_s)
            if len(self._buckets) > REMEMBERED:
                self._buckets.popitem(last=False)
        self._buckets.move_to_end(key)
        refilled = bucket.left + (now_s - bucket.at_s) * self._refill_per_s
        bucket.left, bucket.at_s = min(float(self._attempts), refilled), now_s
        if bucket.left < 1:
            return False
        bucket.left -= 1
        return True

    @property
    def wait_s(self) -> float:
        """How long an empty bucket takes to allow one attempt [s]."""
        return 1 / self._refill_per_s


def network_of(address: str) -> str:
    """The address, or its network where one person has many addresses (IPv6)."""
    try:
        ip = ipaddress.ip_address(address)
    except ValueError:
        return address
    if isinstance(ip, ipaddress.IPv6Address):
        if ip.ipv4_mapped is not None:
            return str(ip.ipv4_mapped)
        return str(ipaddress.ip_network((ip, IPV6_NETWORK_BITS), strict=False))
    return str(ip)
