"""The calibration board before the camera, as the API shows it while pictures are collected."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from server.schema.base import Wire
from server.schema.inspection import Pixel

BoardNotice = Literal["no_board", "other_board", "show_more", "moving", "blurred", "known", "taken"]
"""What the newest picture is good for, from nothing at all to a new view."""

BoardPlace = Literal[
    "upper_left", "top", "upper_right", "left", "middle", "right", "lower_left", "bottom",
    "lower_right",
]  # fmt: skip

BoardAttitude = Literal[
    "left_away", "right_away", "top_away", "bottom_away", "turned", "nearer", "farther"
]


class BoardWish(Wire):
    """What would tell most about the camera next."""

    place: BoardPlace | None = Field(description="Part of the picture; null: nothing is missing")
    attitude: BoardAttitude | None = Field(
        description="Which edge to tip away from the camera, a quarter turn, or another distance"
    )


class BoardLook(Wire):
    """One picture of the board."""

    sequence: int = Field(ge=1, description="Grows; names the picture")
    width_px: int = Field(ge=1, description="Of the camera; the picture itself may be sent smaller")
    height_px: int = Field(ge=1)
    corners_px: list[Pixel] = Field(description="Corners of the board that were found")
    outline_px: list[Pixel] = Field(description="Around them, in order")
    notice: BoardNotice = Field(description="What the picture is good for")
    wish: BoardWish
    taken: int = Field(ge=0, description="Views that were kept so far")
    wanted: int = Field(ge=0, description="How many there should be in the end")
    coverage: list[list[int]] = Field(
        description="How many corners have been in each cell of a grid over the picture, by rows"
    )
