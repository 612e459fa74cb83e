"""Errors of the workspace.

WorkspaceError
├── EmptyWorkspaceError     the robot reaches no position at all
├── EmptyRegionError        a figure was asked of a region that has no points
├── InvalidRectangleError   the sizes or the place make no rectangle
├── InvalidGridError        the step makes no grid
├── RectangleOutsideError   a rectangle is not inside the workspace; says where it leaves it
└── SingularRectangleError  a rectangle touches a singularity, where the figure is infinite
"""

from __future__ import annotations

from typing import ClassVar

from twin.errors import TwinError


class WorkspaceError(TwinError):
    """A question about the workspace that has no answer."""

    code: ClassVar[str] = "workspace"
    remedy: ClassVar[str] = "Look at the workspace with `plugpilot workspace` and change the query."


class EmptyWorkspaceError(WorkspaceError):
    """No position of V has joint positions within their limits."""

    code: ClassVar[str] = "empty_workspace"
    remedy: ClassVar[str] = "Change the leg length, the offsets or the travels in [geometry]."


class EmptyRegionError(WorkspaceError):
    """A region without points has no extent."""

    code: ClassVar[str] = "empty_region"
    remedy: ClassVar[str] = "Ask whether the region is empty first; a smaller rectangle may fit."


class InvalidRectangleError(WorkspaceError):
    """Sizes or places that make no rectangle."""

    code: ClassVar[str] = "invalid_rectangle"
    remedy: ClassVar[str] = "Give finite numbers and sizes greater than zero."


class InvalidGridError(WorkspaceError):
    """A step that makes no grid."""

    code: ClassVar[str] = "invalid_grid"
    remedy: ClassVar[str] = "Give a finite step greater than zero."


class RectangleOutsideError(WorkspaceError):
    """A rectangle is not inside the workspace."""

    code: ClassVar[str] = "rectangle_outside"
    remedy: ClassVar[str] = "Choose a smaller rectangle, or a centre from the placement region."


class SingularRectangleError(WorkspaceError):
    """A rectangle touches a singularity, where forces and speeds have no bound."""

    code: ClassVar[str] = "singular_rectangle"
    remedy: ClassVar[str] = (
        "Move the rectangle away from the carriages and from the legs' full rise."
    )
