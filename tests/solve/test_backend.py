"""What any solver backend must keep to: answers as data, models that satisfy, cores that are needed, repeatable."""

from __future__ import annotations

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import smtlib
from scenewright.motion.algebra import Symbol, compare
from scenewright.solve.backends.z3_backend import Z3Backend
from scenewright.solve.problem import Backend, Problem, Satisfiable, Unknown, Unsatisfiable

BACKENDS = [Z3Backend()]
TIMEOUT_S = 20.0
every_backend = pytest.mark.parametrize("backend", BACKENDS, ids=lambda backend: backend.name)


def small() -> tuple[Problem, Symbol, Symbol]:
    problem = Problem()
    return problem, problem.unknown("p"), problem.unknown("q")


def holds(problem: Problem, model: dict[str, Fraction]) -> bool:
    return all(
        condition if isinstance(condition, bool) else smtlib.value(condition, model)
        for condition in (assertion.condition for assertion in problem.assertions)
    )


@every_backend
@settings(max_examples=40)
@given(coefficients=st.lists(st.tuples(*[st.integers(-5, 5)] * 3), min_size=1, max_size=5))
def test_a_model_satisfies_every_assertion(backend: Backend, coefficients: list[tuple[int, int, int]]) -> None:
    problem, p, q = small()
    for number, (a, b, c) in enumerate(coefficients):
        problem.require(compare("<=", Fraction(a) * p + Fraction(b) * q, Fraction(c)), f"row {number}")
    problem.bound(p, -9, Fraction(19, 2), "p's range")
    problem.bound(q, None, 7, "q's range")
    problem.bound(q, -7, None, "q's range")
    result = backend.solve(problem, TIMEOUT_S)
    assert not isinstance(result, Unknown)
    if isinstance(result, Satisfiable):
        assert holds(problem, dict(result.model))
    else:
        core = backend.solve(problem, TIMEOUT_S, want_core=True)
        assert isinstance(core, Unsatisfiable)
        check_core(backend, problem, core.core)


def check_core(backend: Backend, problem: Problem, core: tuple[str, ...]) -> None:
    """A core alone has no solution, and has one as soon as any member is left out."""
    origins = {assertion.origin for assertion in problem.assertions}
    assert set(core) <= origins
    assert len(set(core)) == len(core) > 0
    assert isinstance(backend.solve(problem.without(origins - set(core)), TIMEOUT_S), Unsatisfiable)
    for left_out in core:
        rest = problem.without((origins - set(core)) | {left_out})
        assert isinstance(backend.solve(rest, TIMEOUT_S), Satisfiable)


@every_backend
def test_a_core_names_what_clashes_and_nothing_else(backend: Backend) -> None:
    problem, p, q = small()
    problem.require(compare(">=", p, Fraction(3)), "far enough")
    problem.require(compare("==", q, Fraction(1)), "beside the point")
    problem.require(compare("<=", p * p, Fraction(4)), "near enough")
    problem.require(compare(">=", p, Fraction(-100)), "hardly a bound")
    result = backend.solve(problem, TIMEOUT_S, want_core=True)
    assert result == Unsatisfiable(("far enough", "near enough"))
    check_core(backend, problem, ("far enough", "near enough"))
    assert backend.solve(problem, TIMEOUT_S) == Unsatisfiable(())


@every_backend
def test_what_is_false_by_itself_is_named(backend: Backend) -> None:
    problem, p, _ = small()
    problem.require(compare(">=", p, Fraction(3)), "a bound")
    problem.require(compare("<", Fraction(2), Fraction(1)), "nonsense")
    assert backend.solve(problem, TIMEOUT_S, want_core=True) == Unsatisfiable(("nonsense",))
    assert isinstance(backend.solve(problem.without({"nonsense"}), TIMEOUT_S), Satisfiable)


@every_backend
def test_products_and_choices(backend: Backend) -> None:
    problem, p, q = small()
    problem.require(compare("==", p * q, Fraction(6)), "product")
    problem.require(f"(or {compare('<', p, Fraction(-10))} {compare('==', p, Fraction(4))})", "choice")
    problem.require(compare(">", q, Fraction(0)), "sign")
    result = backend.solve(problem, TIMEOUT_S)
    assert isinstance(result, Satisfiable)
    assert result.model == {"p": 4, "q": Fraction(3, 2)}


@every_backend
def test_irrational_solutions_come_close(backend: Backend) -> None:
    problem, p, _ = small()
    problem.require(compare("==", p * p, Fraction(2)), "square")
    problem.require(compare(">", p, Fraction(0)), "sign")
    result = backend.solve(problem, TIMEOUT_S)
    assert isinstance(result, Satisfiable)
    assert abs(result.model["p"] ** 2 - 2) < Fraction(1, 10**9)


@every_backend
def test_no_time_is_no_answer(backend: Backend) -> None:
    """Twelve bilinear chains that must meet: far more than can be decided in a few milliseconds."""
    problem = Problem()
    names = [problem.unknown(f"u{k}") for k in range(24)]
    for k, unknown in enumerate(names):
        problem.bound(unknown, Fraction(1, 7), 9, "range")
        first, second, third = (names[(k * step + 1) % 24] for step in (5, 7, 11))
        problem.require(compare("==", unknown * first * second + third * third, Fraction(11 + k, 3)), f"chain {k}")
    result = backend.solve(problem, 0.02)
    assert result == Unknown("timeout")


@every_backend
def test_the_same_problem_has_the_same_answer(backend: Backend) -> None:
    """Whatever was solved in between. (A model found while a core was wanted is not promised to be the same.)"""

    def build(low: int = 0) -> Problem:
        problem, p, q = small()
        problem.require(compare("==", p * q + p, Fraction(17, 3)), "curve")
        problem.bound(p, low, 50, "range")
        problem.bound(q, -3, 50, "range")
        return problem

    first = backend.solve(build(), TIMEOUT_S)
    backend.solve(build(low=2), TIMEOUT_S, want_core=True)
    second = backend.solve(build(), TIMEOUT_S)
    assert isinstance(first, Satisfiable)
    assert first == second
    assert holds(build(), dict(first.model))


def test_a_satisfiable_result_without_a_model_cannot_be_built() -> None:
    with pytest.raises(TypeError):
        Satisfiable()  # type: ignore[call-arg]
    with pytest.raises(ValueError, match="needs a model"):
        Satisfiable(None)  # type: ignore[arg-type]


def test_what_holds_anyway_is_left_out() -> None:
    problem, p, _ = small()
    problem.require(compare("<", Fraction(1), Fraction(2)), "trivial")
    problem.bound(p, None, None, "no bound")
    assert problem.assertions == []
    assert problem.smtlib(named=False) == "(declare-const p Real)\n(declare-const q Real)"


@settings(max_examples=25, deadline=None)
@given(
    rest_m=st.fractions(2, 60, max_denominator=10),
    speeds=st.tuples(st.integers(0, 6), st.integers(7, 18)),
    time_s=st.fractions(1, 15, max_denominator=10),
    gentle=st.integers(1, 4),
)
def test_both_ways_of_asking_agree_on_braking_to_a_stop_in_time(
    rest_m: Fraction, speeds: tuple[int, int], time_s: Fraction, gentle: int
) -> None:
    problem = Problem()
    speed, brake_s, stand_s = (problem.unknown(name) for name in ("v", "d", "w"))
    problem.bound(speed, *speeds, "speed")
    problem.require(compare("==", 2 * rest_m, speed * brake_s), "the laws of motion")
    problem.require(compare(">=", speed, Fraction(gentle, 2) * brake_s), "brakes")
    problem.require(compare("<=", speed, Fraction(8) * brake_s), "brakes")
    problem.require(compare(">=", stand_s, Fraction(1, 2)), "stands")
    problem.require(compare("<=", brake_s + stand_s, time_s), "in time")
    answers = [Z3Backend().solve(problem, TIMEOUT_S, want_core=core) for core in (False, True)]
    assert type(answers[0]) is type(answers[1])
    # By arithmetic: as fast as its speed and its brakes allow.
    fastest = min(speeds[1], (16 * float(rest_m)) ** 0.5)
    slowest = max(speeds[0], (gentle * float(rest_m)) ** 0.5)
    if fastest > slowest + 1e-6 and abs(2 * float(rest_m) / fastest + 0.5 - float(time_s)) > 1e-6:
        possible = 2 * float(rest_m) / fastest + 0.5 < float(time_s)
        assert isinstance(answers[0], Satisfiable) == possible
