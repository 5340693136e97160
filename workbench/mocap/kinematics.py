"""Forward kinematics: from joint rotations to joint positions."""

from __future__ import annotations
