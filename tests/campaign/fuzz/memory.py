"""Whether a process grows while it is fuzzed."""

from __future__ import annotations

from statistics import median

import psutil

MIB = 1 << 20

FRUGAL_ALLOCATOR = {
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_MMAP_THRESHOLD_": str(1 << 16),
    "MALLOC_TRIM_THRESHOLD_": str(1 << 17),
}
"""Environment of glibc in which memory that is free goes back at once: what a process holds then
tells what it keeps, and not how pictures of threads lay beside each other. With the defaults the
server settles 70 MiB higher, and in steps."""

SETTLED = 0.4
"""Share of the run after which caches are full."""

MOST_GROWTH = 0.15
MOST_GROWTH_MIB = 40.0


class MemoryWatch:
    """Looks at a process from time to time.

    Args:
        pid: Of the process.
    """

    def __init__(self, pid: int) -> None:
        self._process = psutil.Process(pid)
        self.seen_mib: list[float] = []

    def look(self) -> None:
        """Take a sample of what the process holds itself (resident, without swap)."""
        self.seen_mib.append(self._process.memory_info().rss / MIB)

    @property
    def growth_mib(self) -> float:
        """Median of the last fifth of the samples, less that of those after the first while."""
        count = len(self.seen_mib)
        if count < 10:
            return 0.0
        fifth, settled = count // 5, int(SETTLED * count)
        settled_mib = self.seen_mib[settled : settled + fifth]
        return median(self.seen_mib[-fifth:]) - median(settled_mib)

    @property
    def grows(self) -> bool:
        """More than a process does that forgets what it is done with."""
        allowed = max(MOST_GROWTH_MIB, MOST_GROWTH * self.seen_mib[0]) if self.seen_mib else 0.0
        return self.growth_mib > allowed

    def __str__(self) -> str:
        first, last = self.seen_mib[0], self.seen_mib[-1]
        return (
            f"{first:.0f} MiB at first, {last:.0f} at last, at most {max(self.seen_mib):.0f}; "
            f"{self.growth_mib:+.1f} since it settled"
        )
