"""One job, the deaths of its servers, and how it ended."""

from __future__ import annotations

import math
import tempfile
import threading
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from server.config.settings import Settings
from server.config.simulation import SimulationSettings
from tests.campaign.kill.host import NOBODY_DIES, Death, GarageHost
from tests.campaign.kill.lives import Life, ServerDiedError, Written, alive, launch, written

POLL_S = 0.2
STORY_S = 600.0
ENERGY_WH = 25.0
IN_A_LIFE_S = 30.0
"""Simulated time within which a killed server dies: a whole job with a recovery in it."""
STARTING_SHARE = 0.1
"""Of servers that are killed before they are ready, ..."""
STARTING_S = 4.0
"""... at an instant within so much wall time."""
DARK_SHARE = 0.3
SOME_LATERAL_MM = 0.01
DECISIONS = {"resumed", "person_needed", "turned_back"}
ENDED = {"succeeded", "failed", "cancelled"}
PLUGGED_MM = 38.0


@dataclass(frozen=True, slots=True)
class Kill:
    """One death.

    Attributes:
        phase: Of the job then, as it was on disk; "" before it was accepted.
        dark: It was a power cut.
        depth_mm: Of the plug in the socket then; negative outside.
        decided_s: From the next launch to the decision how the job goes on; NaN when that server
            was killed before, or nothing was to be decided.
        starting_s: Of that, until the server was ready.
    """

    phase: str
    dark: bool
    depth_mm: float
    decided_s: float = math.nan
    starting_s: float = math.nan


@dataclass(slots=True)
class Story:
    """What became of one job.

    Attributes:
        seed: Of its garage.
        kind: Of job.
        kills: All deaths.
        outcome: In words.
        broken: What must never happen, and did.
        asked: Codes of what a person was asked.
    """

    seed: int
    kind: str
    kills: list[Kill] = field(default_factory=list)
    outcome: str = ""
    broken: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)


def tell(seed: int, kills: int, speed: float) -> Story:
    """Carry one job through a number of deaths to its end.

    Args:
        seed: Of the garage and the instants.
        kills: Most deaths; a job may end sooner.
        speed: Simulated seconds per second.
    """
    with tempfile.TemporaryDirectory() as scratch:
        teller = _Teller(seed, speed, Path(scratch))
        try:
            return teller.tell(kills)
        finally:
            teller.host.close()


class _Teller:
    def __init__(self, seed: int, speed: float, scratch: Path) -> None:
        self._rng = np.random.default_rng(seed)
        kind = str(self._rng.choice(["charge", "charge", "plug_in", "unplug"]))
        self._story = Story(seed, kind)
        self._speed = speed
        self._folder = scratch / "data"
        self._folder.mkdir()
        self._socket = scratch / "garage"
        settings = Settings(simulation=SimulationSettings(seed=seed))
        self.host = GarageHost(settings, self._socket)
        self.host.start()
        self._job_id = ""
        self._requested = False

    def tell(self, kills: int) -> Story:
        deadline_s = time.monotonic() + STORY_S
        while time.monotonic() < deadline_s:
            dies = len(self._story.kills) < kills
            self.host.death = self._next_death() if dies else NOBODY_DIES
            if self._live(dies=dies):
                self._judge()
                return self._story
        self._story.broken.append("the job has not ended")
        return self._story

    def _next_death(self) -> Death:
        return Death(
            after_s=float(self._rng.uniform(0.0, IN_A_LIFE_S)),
            dark=bool(self._rng.random() < DARK_SHARE),
            absent_s=float(self._rng.uniform(0.3, 20.0)),
        )

    def _live(self, *, dies: bool) -> bool:
        """One life; True when the job has ended in it."""
        if not self._requested:
            self.host.death, death = NOBODY_DIES, self.host.death
        launched_at = time.time()
        process = launch(self._socket, self._folder, self._speed)
        self.host.pid = process.pid
        early: threading.Timer | None = None
        if dies and self._requested and self._rng.random() < STARTING_SHARE:
            early = threading.Timer(float(self._rng.uniform(0.0, STARTING_S)), process.kill)
            early.start()
        try:
            with alive(process, launched_at, self._folder) as life:
                if not self._requested:
                    self._request(life)
                    if dies:
                        self.host.death = death
                ended = self._watch(life)
                self._note_decision(life)
                if ended:
                    return True
        except ServerDiedError:
            if not (dies and self._requested):
                raise  # nobody has killed it
        finally:
            if early is not None:
                early.cancel()
        self._note_death(launched_at)
        return False

    def _request(self, life: Life) -> None:
        """Tell the server about the car, and what to do with it."""
        car = self.host.do(lambda garage: garage.world.car)
        offset = car.known_offset
        vehicle = {
            "name": "The car",
            "label_size_mm": car.label_size_mm,
            "socket": {
                "x_mm": offset.x_mm,
                "y_mm": offset.y_mm,
                "z_mm": offset.z_mm,
                "rotation_x_rad": offset.rotation_x_rad,
                "rotation_y_rad": offset.rotation_y_rad,
            },
        }
        answer = life.client.put(f"vehicles/{car.vehicle_id}", json=vehicle)
        payload = answer.raise_for_status().json()["label_payload"]
        self.host.do(lambda garage: garage.world.stick_label(payload))
        self._until(life, lambda robot: robot["mode"] != "offline")
        if self._story.kind == "unplug":
            first = life.client.post("jobs", json={"type": "plug_in"}).raise_for_status().json()
            self._until_job(life, first["id"])
        body: dict[str, Any] = {"type": self._story.kind}
        if self._story.kind == "charge":
            body["target_energy_wh"] = ENERGY_WH
        job = life.client.post("jobs", json=body).raise_for_status().json()
        self._job_id = job["id"]
        self._requested = True

    def _until(self, life: Life, condition: Any) -> None:  # noqa: ANN401 - of a JSON object
        while not condition(life.client.get("robot").raise_for_status().json()):
            time.sleep(POLL_S)

    def _until_job(self, life: Life, job_id: str) -> dict[str, Any]:
        while True:
            job: dict[str, Any] = life.client.get(f"jobs/{job_id}").raise_for_status().json()
            if job["state"] in ENDED:
                return job
            time.sleep(POLL_S)

    def _watch(self, life: Life) -> bool:
        """Be the person in front of it, until the job has ended."""
        while True:
            job = life.client.get(f"jobs/{self._job_id}").raise_for_status().json()
            if job["state"] in ENDED:
                return True
            needs = job["needs_person"]
            if needs is not None and needs["choices"]:
                self._story.asked.append(needs["code"])
                if needs["code"] == "robot_fault":
                    life.client.post("robot/reset")
                life.client.post(f"jobs/{self._job_id}/resume").raise_for_status()
            time.sleep(POLL_S)

    def _note_decision(self, life: Life) -> None:
        known = written(self._folder)
        kills = self._story.kills
        if known is None or not kills or not math.isnan(kills[-1].decided_s):
            return
        decided = [
            at for kind, _, at in known.events if kind in DECISIONS and at >= life.launched_at
        ]
        if decided:
            last = kills[-1]
            kills[-1] = Kill(
                last.phase,
                last.dark,
                last.depth_mm,
                decided[0] - life.launched_at,
                life.ready_at - life.launched_at,
            )

    def _note_death(self, launched_at: float) -> None:
        known = written(self._folder)
        if known is None and self._requested:
            self._story.broken.append("a job that was accepted is lost")
        truth = self.host.truth()
        self._judge_motion()
        phase = known.phase if known is not None else ""
        self._note_late_decision(known, launched_at)
        self._story.kills.append(Kill(phase, self.host.death.dark, truth.insertion_depth_mm))

    def _note_late_decision(self, known: Written | None, launched_at: float) -> None:
        """The server that has just died may have decided before."""
        kills = self._story.kills
        if known is None or not kills or not math.isnan(kills[-1].decided_s):
            return
        decided = [at for kind, _, at in known.events if kind in DECISIONS and at >= launched_at]
        if decided:
            last = kills[-1]
            kills[-1] = Kill(last.phase, last.dark, last.depth_mm, decided[0] - launched_at)

    def _judge_motion(self) -> None:
        truth = self.host.truth()
        if truth.lateral_violation_mm > SOME_LATERAL_MM:
            self._story.broken.append(f"{truth.lateral_violation_mm:.3f} mm sideways when plugged")
        if truth.load_breaks:
            self._story.broken.append("pulled under load")

    def _judge(self) -> None:
        """Judge the end by the truth, not by the server's word."""
        self._judge_motion()
        known, truth = written(self._folder), self.host.truth()
        assert known is not None
        depth_mm = truth.insertion_depth_mm
        where = "plugged" if depth_mm > PLUGGED_MM else "half in" if depth_mm > 0 else "out"
        self._story.outcome = f"{known.state}, plug {known.plug}, truly {where}"
        fits = {
            "parked": depth_mm < 0,
            "free": depth_mm < 0,
            "inserted": depth_mm > 0,
            "unknown": True,
        }
        if not fits[known.plug]:
            self._story.broken.append(f"the plug is {known.plug}, but {depth_mm:.1f} mm deep")
        if known.state != "succeeded":
            self._story.broken.append(f"ended as {known.state}")
        wanted = "plugged" if self._story.kind == "plug_in" else "out"
        if known.state == "succeeded" and where != wanted:
            self._story.broken.append(f"succeeded, and the plug is {where}")
