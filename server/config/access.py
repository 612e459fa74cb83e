"""Who gets in, and under which names."""

from __future__ import annotations

from pydantic import Field

from server.config.section import Section


class AccessSettings(Section):
    """Accounts, and what the server answers to."""

    host_names: tuple[str, ...] = Field(
        (),
        description="Further names of this machine, such as robot.example.org. Addresses, "
        "localhost, names without a dot, and names that end in .local, .home.arpa or .internal "
        "need not be listed",
    )
    unused_device_days: int = Field(
        180, ge=1, le=400, description="A device that was not used for so long must be paired anew"
    )
    screen: bool = Field(
        default=False,
        description="The machine has a screen of its own: while nobody owns the robot, a page "
        "opened on the machine itself shows the QR code that makes a phone the owner's",
    )
    hsts_days: int = Field(
        0,
        ge=0,
        le=730,
        description="How long browsers shall insist on https for this name. Only for a "
        "certificate that all browsers trust: with another one, losing it locks everybody out",
    )
