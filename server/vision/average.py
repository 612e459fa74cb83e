"""Several poses of a label at standstill become one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from server.vision.label_pose import LabelPose, PoseSource
from server.vision.projection import Array, perturbed, rotation_vector


@dataclass(frozen=True, slots=True)
class CommonErrors:
    """Errors that all pictures of a standstill share, so that averaging cannot remove them.

    They come from the light and from the place of the edges on the pixel grid, which do not
    change while nothing moves. Standard deviations; about four times what is left in rendered
    pictures (tests.bench.vision), because real light is less even.

    Attributes:
        rotation_rad: About each axis.
        lateral_mm: Along the picture.
        depth_mm: Along the optical axis.
    """

    rotation_rad: float = 2e-4
    lateral_mm: float = 0.001
    depth_mm: float = 0.01

    @property
    def covariance(self) -> Array:
        """Covariance of (omega, tau), shape (6, 6)."""
        sigma = [self.rotation_rad] * 3 + [self.lateral_mm, self.lateral_mm, self.depth_mm]
        return np.diag(np.square(sigma))


def combine(
    poses: Sequence[LabelPose],
    common: CommonErrors | None = None,
    calibration: Array | None = None,
) -> LabelPose:
    """Average poses by their information (inverse covariances).

    The rotations are averaged in the tangent space of the first, which is exact enough for
    poses of a label that stands still. Where the poses scatter more than they promise, the
    covariance grows by chi^2 per degree of freedom (Birge 1932).

    Args:
        poses: Of the same label at standstill in the same camera.
        common: What averaging cannot remove; added to the covariance once.
        calibration: Covariance of what a wrong calibration does to all of them, shape (6, 6), as
            ``CalibrationErrors`` gives it; left out where poses are compared with a taught one.

    Raises:
        ValueError: there is no pose, or the poses are of different labels.
    """
    if not poses:
        message = "there is no pose to combine"
        raise ValueError(message)
    if len({pose.payload for pose in poses}) > 1:
        message = "poses of different labels cannot be combined"
        raise ValueError(message)
    reference = poses[0].T_camera_label
    offsets = np.array([_offset(pose.T_camera_label, reference) for pose in poses])
    information = np.array([np.linalg.inv(pose.covariance) for pose in poses])
    covariance = np.linalg.inv(information.sum(axis=0))
    mean = covariance @ np.einsum("nij,nj->i", information, offsets)
    if len(poses) > 1:
        scatter = offsets - mean
        chi2 = float(np.einsum("ni,nij,nj->", scatter, information, scatter))
        covariance = covariance * max(1.0, chi2 / (6 * (len(poses) - 1)))
    covariance = covariance + (common or CommonErrors()).covariance
    if calibration is not None:
        covariance = covariance + calibration
    counts = np.array([pose.edge_count for pose in poses])
    edges_only = all(pose.source is PoseSource.EDGES for pose in poses)
    return LabelPose(
        payload=poses[0].payload,
        T_camera_label=perturbed(reference, np.asarray(mean, dtype=np.float64)),
        covariance=np.asarray(covariance, dtype=np.float64),
        rms_px=float(np.sqrt(np.mean([pose.rms_px**2 for pose in poses]))),
        inlier_share=float(np.average([pose.inlier_share for pose in poses], weights=counts)),
        edge_count=int(counts.sum()),
        spread_px=float(np.mean([pose.spread_px for pose in poses])),
        source=PoseSource.EDGES if edges_only else PoseSource.CORNERS,
    )


def _offset(pose: Array, reference: Array) -> Array:
    """The (omega, tau) that leads from the reference to a pose, shape (6,)."""
    turn = rotation_vector(pose[:3, :3] @ reference[:3, :3].T)
    return np.concatenate((turn, pose[:3, 3] - reference[:3, 3]))
