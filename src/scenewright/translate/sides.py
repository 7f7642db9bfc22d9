"""Reads left and right as one vehicle sees the other: "from the ego's left", "out of the driveway on its right".

What enters: the reader's state at such words. What leaves: a relation between the two ways, in the event it belongs to.
"""

from __future__ import annotations

from dataclasses import dataclass

from scenewright.translate.events import EGO_ID
from scenewright.translate.reader import ReaderState


@dataclass(slots=True)
class SideReader(ReaderState):
    """Reads sides."""

    def _from_whose_side(self, at: int) -> tuple[str, int] | None:
        """Read "from the AV's left [side]"; return the side and the position after it."""
        if self.phrases.tag(at, "preposition") not in ("out", "on", "to"):
            return None
        phrase = self.phrases.noun_phrase(at + 1)
        if phrase is None or phrase.kind == "pronoun" or self.phrases.tag(phrase.end, "genitive") is None:
            return None
        direction = self.phrases.tag(phrase.end + 1, "direction")
        if direction not in ("left", "right"):
            return None
        end = phrase.end + 2 + (self.phrases.tag(phrase.end + 2, "side_noun") is not None)
        return f"from_{direction}" if self.phrases.tag(at, "preposition") == "out" else f"on_{direction}", end

    def _side(self) -> bool:
        """Read "from the ego's left" and "on its right": where a vehicle comes from, as the other one sees it."""
        side, end = self._tag("from_side"), self.at + 1
        if side is None and (found := self._from_whose_side(self.at)):
            side, end = found
        host = self.current or (self._host() if side is not None and self.subject_span is not None else None)
        if side is None or host is None or host.actor is None or (self.links and self.subject_span is None):
            return False
        if self.links and host is self.current:
            host = self._host()
        if host is None or host.actor is None:
            return False
        if self.phrases.tag(end, "preposition") == "of":
            phrase = self.phrases.noun_phrase(end + 1)
            if phrase is None or (phrase.kind != "pronoun" and self.phrases.resolve(phrase) == host.actor):
                return False
            end = phrase.end
        side_of = host.actor
        if side.startswith("on_") and host.verb == "approach" and "towards" not in host.notes:
            host.relations.append((f"driveway_{side.rpartition('_')[2]}", host.actor, self.phrases.span(self.at, end)))
            self.at = end
            self._grow()
            return True
        if side.startswith("on_") and host.areas and host.areas[-1].kind == "driveway":
            named = self.phrases.last_named
            if named is not None and self.phrases.tokens[self.at].text.lower().startswith(("on", "to", "at")):
                whose = self._from_whose_side(self.at)
                side_of = named[0] if whose is not None else host.actor
            if host.areas[-1].role == "into":
                relation = f"driveway_{side.rpartition('_')[2]}"
                host.relations.append((relation, side_of, self.phrases.span(self.at, end)))
                self.at = end
                self._grow()
                return True
        on_driveway = any(area.kind == "driveway" for area in host.areas)
        seen_by_itself = side.startswith("on_") and on_driveway and host.actor == EGO_ID
        if seen_by_itself or (side.startswith("on_") and not on_driveway and host.verb != "pull_out"):
            return False
        host.relations.append((f"from_{side.rpartition('_')[2]}", host.actor, self.phrases.span(self.at, end)))
        self.at = end
        self._grow()
        return True
