"""Read the HIERARCHY section of a BVH file."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from workbench.errors import MotionFormatError
from workbench.mocap.skeleton import POSITION_CHANNELS, ROTATION_CHANNELS, EndSite, Skeleton
from workbench.mocap.textfile import parse_number, quoted

_CHANNELS = {c.lower(): c for c in POSITION_CHANNELS + ROTATION_CHANNELS}
# A name runs to the end of its line or to the brace that opens its block, so that it may
# hold blanks, colons, dots and keywords.
_NAMED = re.compile(r"(root|joint|end\s+site)(?:\s+([^{}]*?))?\s*(?=[{}]|$)", re.IGNORECASE)


@dataclass
class _Block:
    """An open block: a joint, or an end site hanging on one."""

    joint: int
    name: str
    is_site: bool
    line: int
    braced: bool = False
    offset: list[float] | None = None
    channels: tuple[str, ...] | None = None


@dataclass
class _Joint:
    name: str
    parent: int
    block: _Block


@dataclass
class HierarchyParser:
    """Collect joints statement by statement; statements may share a line.

    Parameters
    ----------
    path : path-like
        The file, for messages.
    """

    path: str | Path
    line: int = 0
    _joints: list[_Joint] = field(default_factory=list)
    _sites: list[EndSite] = field(default_factory=list)
    _open: list[_Block] = field(default_factory=list)

    def parse(self, lines: Iterator[tuple[str, int]]) -> tuple[Skeleton, int, int]:
        """Read up to and including the line MOTION.

        Parameters
        ----------
        lines : iterator of (str, int)
            Stripped lines and the offsets after them, from the beginning of the file.

        Returns
        -------
        skeleton : Skeleton
        line : int
            Number of the line MOTION.
        end : int
            Offset of the byte after that line.

        Raises
        ------
        MotionFormatError
            If the section breaks the format.
        """
        started = False
        for text, end in lines:
            self.line += 1
            if not started:
                if text and text.lower() != "hierarchy":
                    raise self._fault(quoted(text), "HIERARCHY, which begins a BVH file")
                started = bool(text)
                continue
            if text.lower() == "motion" and not self._open and self._joints:
                return self._skeleton(), self.line, end
            while text:
                text = self._statement(text)
        raise self._fault("the end of the file", self._wanted_at_end())

    def _wanted_at_end(self) -> str:
        if self._open:
            block = self._open[-1]
            return f"'}}' to close the block of {_describe(block)} opened in line {block.line}"
        return "MOTION" if self._joints else "ROOT"

    def _statement(self, text: str) -> str:
        """Take one statement off a line and return the rest of the line."""
        block = self._open[-1] if self._open else None
        if block is not None and not block.braced:
            if not text.startswith("{"):
                raise self._fault(quoted(text), f"'{{' to open the block of {_describe(block)}")
            block.braced = True
            return text[1:].lstrip()
        if text.startswith("}"):
            if block is None:
                raise self._fault("'}' without a '{'", "MOTION" if self._joints else "ROOT")
            self._close(block)
            return text[1:].lstrip()
        named = _NAMED.match(text)
        if named:
            self._begin(named.group(1).lower(), (named.group(2) or "").strip(), block)
            return text[named.end() :]
        words = text.replace("{", " { ").replace("}", " } ").split()
        keyword = words[0].lower()
        if block is None:
            wanted = "MOTION" if self._joints else "ROOT and the name of a joint"
            raise self._fault(quoted(text), wanted)
        if keyword == "offset":
            return self._offset(block, words)
        if keyword == "channels" and not block.is_site:
            return self._channels(block, words)
        wanted = "OFFSET or '}'" if block.is_site else "OFFSET, CHANNELS, JOINT, End Site or '}'"
        raise self._fault(quoted(text), wanted)

    def _begin(self, keyword: str, name: str, block: _Block | None) -> None:
        if keyword == "root" and self._joints:
            raise self._fault(f"a second ROOT {quoted(name)}", "one ROOT in a file")
        if keyword != "root" and block is None:
            raise self._fault(
                f"{keyword.upper()} {quoted(name)} outside of a block",
                "MOTION" if self._joints else "ROOT",
            )
        if block is not None and block.is_site:
            raise self._fault(f"{keyword.upper()} inside an End Site", "OFFSET or '}'")
        parent = block.joint if block is not None else -1
        if keyword.startswith("end"):
            self._open.append(_Block(parent, name, True, self.line))
            return
        if not name:
            raise self._fault(f"{keyword.upper()} without a name", "the name of a joint")
        joint = _Block(len(self._joints), name, False, self.line)
        self._joints.append(_Joint(name, parent, joint))
        self._open.append(joint)

    def _offset(self, block: _Block, words: list[str]) -> str:
        if block.offset is not None:
            raise self._fault("a second OFFSET", f"one OFFSET for {_describe(block)}")
        values = []
        for word in words[1:4]:
            value = parse_number(word)
            if value is None:
                raise self._fault(quoted(word), "OFFSET with three finite decimal numbers")
            values.append(value)
        if len(values) != 3 or not _ends_statement(words[4:]):
            raise self._fault(quoted(" ".join(words)), "OFFSET with three numbers")
        block.offset = values
        return " ".join(words[4:])

    def _channels(self, block: _Block, words: list[str]) -> str:
        if block.channels is not None:
            raise self._fault("a second CHANNELS", f"one CHANNELS for {_describe(block)}")
        if len(words) < 2 or not words[1].isascii() or not words[1].isdigit():
            raise self._fault(quoted(" ".join(words[:2])), "CHANNELS and their number")
        end = 2
        while end < len(words) and not _ends_statement(words[end:]):
            end += 1
        names = words[2:end]
        for name in names:
            if name.lower() not in _CHANNELS:
                raise self._fault(
                    f"channel {quoted(name)}", "one of " + ", ".join(_CHANNELS.values())
                )
        # Compared as text first: int() refuses numbers of thousands of digits.
        if words[1].lstrip("0") != str(len(names)).lstrip("0"):
            raise self._fault(
                f"{len(names)} channel names", f"{words[1][:20]}, the number that CHANNELS gives"
            )
        channels = tuple(_CHANNELS[name.lower()] for name in names)
        for channel in channels:
            if channels.count(channel) > 1:
                raise self._fault(f"channel {channel} twice", "each channel of a joint once")
        block.channels = channels
        return " ".join(words[end:])

    def _close(self, block: _Block) -> None:
        if block.offset is None:
            raise self._fault("'}'", f"OFFSET of {_describe(block)} before it")
        if block.is_site:
            self._sites.append(EndSite(block.joint, np.array(block.offset), block.name))
        self._open.pop()

    def _skeleton(self) -> Skeleton:
        blocks = [joint.block for joint in self._joints]
        return Skeleton(
            names=tuple(joint.name for joint in self._joints),
            parents=np.array([joint.parent for joint in self._joints], dtype=np.intp),
            offsets=np.array([block.offset for block in blocks], dtype=np.float64),
            end_sites=tuple(self._sites),
            channels=tuple(block.channels or () for block in blocks),
        )

    def _fault(self, found: str, expected: str) -> MotionFormatError:
        return MotionFormatError(self.path, max(self.line, 1), found, expected)


def _ends_statement(words: list[str]) -> bool:
    """Tell whether what follows is no further argument but the next statement."""
    keywords = ("{", "}", "offset", "channels", "joint", "root", "end")
    return not words or words[0].lower() in keywords


def _describe(block: _Block) -> str:
    return "the End Site" if block.is_site else f"joint {quoted(block.name)}"
