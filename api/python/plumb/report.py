"""What a step says of itself."""

from __future__ import annotations

import math
from typing import Dict, Optional

from . import _core
from .enums import Phase, Remark

UNKNOWN = 0xFFFFFFFF


class StepReport:
    """World.step's answer."""

    __slots__ = ("_core",)

    def __init__(self, core: _core.Report) -> None:
        self._core = core

    @property
    def step(self) -> int:
        """Steps done since the world was made."""
        return self._core.step

    @property
    def threads(self) -> int:
        """Used by this step."""
        return self._core.threads

    @property
    def bodies(self) -> int:
        """Alive, all motions."""
        return self._core.bodies

    @property
    def awake(self) -> int:
        """Dynamic bodies that do not sleep."""
        return self._core.awake

    @property
    def pairs(self) -> Optional[int]:
        """Candidates of the broad phase; None where the engine does not tell."""
        return None if self._core.pairs == UNKNOWN else self._core.pairs

    @property
    def contacts(self) -> int:
        """Points."""
        return self._core.contacts

    @property
    def joints(self) -> int:
        """Alive."""
        return self._core.joints

    @property
    def dropped(self) -> int:
        """Contacts, pairs or events that the engine found and lost."""
        return self._core.dropped

    @property
    def nonfinite(self) -> int:
        """Dynamic bodies whose pose or velocity is NaN or infinite."""
        return self._core.nonfinite

    @property
    def remarks(self) -> Remark:
        """What was unusual."""
        return Remark(self._core.remarks)

    @property
    def residual(self) -> Optional[float]:
        """Of the engine's own solver, in its own measure; None where it does not tell."""
        return None if math.isnan(self._core.residual) else self._core.residual

    @property
    def phase_seconds(self) -> Dict[Phase, float]:
        """Of the phases whose time the engine tells."""
        return {phase: s for phase, s in zip(Phase, self._core.phase_seconds()) if not math.isnan(s)}

    def __repr__(self) -> str:
        return f"<StepReport of step {self.step}: {self.bodies} bodies, {self.awake} awake, {self.contacts} contacts>"
