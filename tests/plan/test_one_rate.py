"""One rate a piece: what a solver finds is driven as the paper's equations say, and gives way only so far."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import pytest
from situations import EGO_MPS, EGO_S_M, HERO

from scenarios import BRAKES, NOT_YIELDING, YIELDS, YIELDS_THEN_GOES, Example, limits_of
from scenewright.judge.tolerance import TIGHT, dimension_of
from scenewright.motion.profile import Profile, Segment
from scenewright.plan.one_rate import OneRate, Past, Question
from scenewright.program.types import EGO
from scenewright.solve.holding import not_held
from scenewright.solve.proofs.events import EgoBounds
from scenewright.solve.proofs.refuters import Answer
from scenewright.solve.proofs.z3_engine import Z3

EASY = (BRAKES, YIELDS, NOT_YIELDING, YIELDS_THEN_GOES)
SLOW_MPS = 2.0  # so that a hero that stops first is through before it
OFF_M = 0.5  # one tight tolerance


def motions_of(case: Example, ego: EgoBounds | None = None) -> OneRate:
    scene = case.scene()
    return OneRate(scene, limits_of(scene), ego or EgoBounds())


def asked(question: Question) -> Answer:
    return Z3(500_000).ask(question.unknowns, question.formulas, 10.0)


def first_of(motions: OneRate, case: Example) -> tuple[Question, list[float], dict[int, Profile]]:
    """Return a first plan, with an ego that starts where its program says and holds its speed."""
    start = {
        BRAKES.name: (motions.scene.landmark_m(EGO, "intersection", None) - 120, EGO_MPS),
        YIELDS_THEN_GOES.name: (60.0, SLOW_MPS),
    }
    question = motions.first(start.get(case.name, (EGO_S_M, EGO_MPS)), even=True)
    answer = asked(question)
    assert answer.kind == "met"
    values = question.values(answer.values)
    return question, values, {a.id: motions.profile(a, question, values, None) for a in motions.scene.program.actors}


@pytest.mark.parametrize("case", EASY, ids=lambda case: case.name)
def test_what_is_found_does_what_the_program_asks(case: Example) -> None:
    motions = motions_of(case)
    _, _, profiles = first_of(motions, case)
    assert [str(each) for each in not_held(motions.scene, profiles, dimension_of, TIGHT.of)] == []


@pytest.mark.parametrize("case", EASY, ids=lambda case: case.name)
def test_every_piece_has_one_rate_and_nothing_jumps(case: Example) -> None:
    motions = motions_of(case)
    _, _, profiles = first_of(motions, case)
    settled = float(motions.scene.program.manner.settled_s)
    for actor, profile in profiles.items():
        by_piece: dict[int, list[Segment]] = {}
        for segment in profile.segments:
            by_piece.setdefault(segment.piece, []).append(segment)
        for early, late in pairwise(profile.segments):
            assert early.end_s == pytest.approx(late.start_s)
            assert early.end_s_m == pytest.approx(late.s_m, abs=1e-6)
            assert early.end_speed_mps == pytest.approx(late.speed_mps, abs=1e-6)
        for parts in by_piece.values():  # only who is to be settled before it pulls has a second part, an even one
            assert len(parts) == 1 or (actor == HERO and parts[1].accel_mpss == 0 and parts[1].duration_s >= settled)


# -- what has happened, and how far it may give way -------------------------------------------------------------------
def before_the_trigger(off: float, hero_mps: float = 0.0) -> tuple[OneRate, Past]:
    """Return motions of the hero that yields, and a past until just before its trigger, with the hero further along.

    It is `off` by what both sides of the trigger, one too early and one too late, make up for with one tolerance each.
    """
    motions = motions_of(YIELDS, EgoBounds(holds_speed=True))
    _, values, profiles = first_of(motions, YIELDS)
    moments_s = motions.moments_s(values)
    trigger_s = profiles[HERO].knot_times_s["t1"]
    ego, hero = profiles[EGO].state, profiles[HERO].state
    hero_m = off * OFF_M * (1 + hero(trigger_s)[1] / EGO_MPS)

    def moved(time_s: float) -> tuple[float, float, float]:
        s_m, speed_mps, accel_mpss = hero(time_s)
        return s_m + hero_m, speed_mps + hero_mps, accel_mpss

    return motions, Past(trigger_s - 0.3, moments_s, {EGO: ego, HERO: moved})


@pytest.mark.parametrize(("off", "needed"), [(0.0, 0), (0.9, 1), (1.1, 2), (1.9, 2), (3.8, 4), (4.2, None)])
def test_a_trigger_gives_way_by_as_many_tolerances_as_it_is_off(off: float, needed: int | None) -> None:
    motions, past = before_the_trigger(off)
    kinds = [asked(motions.again(past, Fraction(k), even=True)).kind for k in (0, 1, 2, 4)]
    met = [k for k, kind in zip((0, 1, 2, 4), kinds, strict=True) if kind == "met"]
    assert (met[0] if met else None) == needed
    assert set(kinds) <= {"met", "refuted"}


def test_what_went_before_cannot_be_mended_and_is_named() -> None:
    motions, past = before_the_trigger(0.0, 1.0)  # it began faster than asked
    question = motions.again(past, Fraction(0), even=True)
    assert question.broken == ("c1",)
    assert motions.again(before_the_trigger(0.0)[1], Fraction(0), even=True).broken == ()
