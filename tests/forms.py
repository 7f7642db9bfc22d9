"""Every form of constraint, once impossible and once binding: what each stage must do with it.

The rows are the table of `docs/forms.md`, which `tools/forms_table.py` writes. `tests/test_forms.py` fails where the
language has a node, an operator or a kind of moment that no row speaks of.
"""

from __future__ import annotations

from dataclasses import dataclass

_SYNCHRONISED = "A0x(t0) == conflict_point - 120\nA0(t1) == A1(t1)\nA0x(t1) == conflict_point - 30\n"
_STOPS = (
    f"{_SYNCHRONISED}A0x(t2) == conflict_point\nA1x(t1) == conflict_point - 25\n"
    "A1x(t2) == conflict_point - 5\nA1v(t2) == 0\n"
)
_FOLLOWS = "A0x(t0) == stop_line - 150\nA0(t1) == A1(t1)\nA0x(t1) == stop_line - 60\nA1v(t2) == 0\n"
_BASES = {  # routes of ego and hero, the hero's sketch, constraints
    "cross": ("W", "E, N", "t0, go, t1, dec, t2", _STOPS),
    "wait": ("W", "E, N", "t0, go, t1, dec, t2, stop, t3, acc, t4", f"{_STOPS}A1v(t4) == 5\n"),
    "follow": ("W", "W", "t0, go, t1, dec, t2", _FOLLOWS),
    "near": ("W", "W", "t0, go, t1, dec, t2", f"{_FOLLOWS}A1x(t1) == stop_line - 30\nA0v(t1) >= 5\n"),
}
PROBE = "probe"


@dataclass(frozen=True)
class Form:
    """One form of constraint.

    Attributes
    ----------
    base
        The scenario that it is added to, which is possible by itself.
    impossible, binding
        The form with numbers that nobody can meet, and with such that ask for something of their own.
    contrary
        A constraint with which the scenario is possible and breaks the binding one.
    parameter
        How the parameter that both speak of is declared in either, where there is one.
    """

    name: str
    base: str
    impossible: str
    binding: str
    contrary: str
    parameter: tuple[str, str] = ("", "")

    def impossible_program(self) -> str:
        return program(self.base, self.impossible, self.parameter[0])

    def binding_program(self) -> str:
        return program(self.base, self.binding, self.parameter[1])

    def contrary_program(self) -> str:
        """The binding constraint is not in it; its parameter is not either."""
        return program(self.base, self.contrary)


def program(base: str, constraint: str, parameter: str = "") -> str:
    """Return a scenario with one constraint more, called `probe`."""
    ego, hero, sketch, constraints = _BASES[base]
    head = f"parameters:\n- {parameter}\n\n" if parameter else ""
    actors = f"Actor 0 (ego):\n- {ego}\n- [t0, go, t1, go, t2]\n\nActor 1 (hero):\n- {hero}\n- [{sketch}]\n"
    return f"{head}{actors}\nConstraints:\n{constraints}{PROBE}: {constraint}\n"


# Of a product of three no solver is told: nobody plans it, and no check knows whether it can happen.
UNPLANNED = program("cross", "A1v(t1) * A1v(t1) * A1v(t1) == 300")


def _over(operator: str, interval: str, impossible: str, binding: str) -> tuple[str, str]:
    return f"{operator}[{interval}] ({impossible})", f"{operator}[{interval}] ({binding})"


_FAST, _SLOW = "A1v(t1) == 9", "A1v(t1) == 4"
_APPROACH, _BRAKING = "A1(t0), A1(t1)", "A1(t1), A1(t2)"
_SWIFT = "always[A1(t0), A1(t1)] (A1v >= 7)"
FORMS = (
    # states at a knot
    Form(
        "x ==",
        "cross",
        "A1x(t1) == conflict_point - 60",
        "A1x(t0) == conflict_point - 100",
        "A1x(t0) == conflict_point - 60",
    ),
    Form(
        "x <",
        "cross",
        "A1x(t1) > conflict_point + 50",
        "A1x(t0) >= conflict_point - 60",
        "A1x(t0) == conflict_point - 90",
    ),
    Form("v ==", "cross", "A1v(t1) == 50", "A1v(t1) == 5.5", _FAST),
    Form("v <", "cross", "A1v(t1) < 0", "A1v(t1) < 5.5", _FAST),
    Form("a", "cross", "A1a(t1) <= -20", "A1a(t1) <= -4", "A1v(t1) == 4 and always[A1(t1), A1(t2)] (A1a >= -1)"),
    Form("a at the last knot", "cross", "A1a(t2) >= 20", "A1a(t2) <= -2", "A1a(dec) == -1.5"),
    # places
    Form(
        "other landmark",
        "cross",
        "A1x(t1) >= turn_end + 50",
        "A1x(t0) >= A1.stop_line - 45",
        "A1x(t0) == conflict_point - 100",
    ),
    Form("turn", "cross", "A1x(t2) == turn", "A1x(t0) >= turn_start - 45", "A1x(t0) == conflict_point - 100"),
    Form(
        "junction",
        "cross",
        "A1x(t1) >= junction_end",
        "A1x(t0) >= junction_start - 45",
        "A1x(t0) == conflict_point - 100",
    ),
    Form(
        "intersection",
        "cross",
        "A1x(t2) == intersection",
        "A1x(t0) >= intersection - 60",
        "A1x(t0) == conflict_point - 90",
    ),
    Form(
        "just before",
        "cross",
        "A1x(t1) >= just before route_end",
        "A1x(t0) == just before stop_line - 40",
        "A1x(t0) == conflict_point - 90",
    ),
    Form(
        "conflict point with another",
        "cross",
        "A1x(t1) >= A1.conflict_point(A0) + 50",
        "A1x(t0) == A1.conflict_point(A0) - 100",
        "A1x(t0) == conflict_point - 60",
    ),
    # a whole piece
    Form(
        "x of a piece",
        "cross",
        "A1x(dec) >= conflict_point + 10",
        "A1x(go) >= conflict_point - 60",
        "A1x(t0) == conflict_point - 90",
    ),
    Form("v of a piece", "cross", "A1v(dec) >= 3", "A1v(dec) <= 5.5", _FAST),
    Form("v of a stop", "wait", "A1v(stop) >= 3", "A1v(acc) <= 5 and A1a(acc) >= 2.6", "A1a(acc) == 1"),
    Form("a of a piece ==", "cross", "A1a(dec) == -20", "A1a(dec) == -4", "A1a(dec) == -2"),
    Form("a of a piece <", "cross", "A1a(dec) <= -20", "A1a(dec) <= -3", "A1a(dec) == -1.5"),
    # times
    Form("time", "cross", "A1(t1) == 0.5", "A1(t1) == 18 s", "A1(t1) == 10"),
    Form("elapsed", "cross", "A1(t2) - A1(t1) <= 0.3", "A1(t2) - A1(t1) == 6 s", "A1(t2) - A1(t1) == 4"),
    Form("elapsed, standing", "wait", "A1(t3) - A1(t2) < 0", "A1(t3) - A1(t2) == 4 s", "A1(t3) - A1(t2) == 1.5"),
    Form("order of knots", "cross", "A1(t2) < A1(t1)", "A1(t2) < A0(t2)", "A1(t2) > A0(t2) + 1.5"),
    # other moments
    Form("v at another's knot", "cross", "A1v(A0(t2)) == 500", "A1v(A0(t2)) == 0", "A1v(A0(t2)) == 3"),
    Form("v at a time", "cross", "A1v(2.0) == 500", "A1v(2.0) == 4", "A1v(2.0) == 8"),
    Form(
        "x at a time",
        "cross",
        "A1x(2.0) >= conflict_point + 2000",
        "A1x(2.0) == conflict_point - 60",
        "A1x(2.0) == conflict_point - 80",
    ),
    Form("a at a time", "cross", "A1a(2.0) == 50", "A1a(2.0) == 1", "always[0, 4] (A1a <= -0.5)"),
    # two actors
    Form("gap", "follow", "gap(A0, A1, t1) == 900", "gap(A0, A1, t1) == 45", "gap(A0, A1, t1) == 30"),
    Form("gap at a time", "follow", "gap(A0, A1, 2.0) == 900", "gap(A0, A1, 2.0) == 45", "gap(A0, A1, 2.0) == 30"),
    Form("freespace", "follow", "freespace(A0, A1, t1) == 900", "freespace(A0, A1, t1) == 40", "gap(A0, A1, t1) == 30"),
    Form("headway", "near", "headway(A0, A1, t1) >= 60", "headway(A0, A1, t1) == 5", "headway(A0, A1, t1) == 2.5"),
    Form("ttc", "near", "ttc(A0, A1, t1) <= 0.2", "ttc(A0, A1, t1) == 6", "ttc(A0, A1, t1) == 12"),
    Form("tta", "cross", "tta(A1, conflict_point, t1) == 0.5", "tta(A1, conflict_point, t1) == 5", _FAST),
    Form(
        "tta at another's knot",
        "cross",
        "tta(A1, route_end, A0(t1)) == 0.5",
        "tta(A1, stop_line, A0(t1)) <= 1.2",
        _SLOW,
    ),
    Form("x - x of one", "cross", "A1x(t1) - A1x(t0) < 0", "A1x(t1) - A1x(t0) == 40", "A1x(t0) == conflict_point - 90"),
    Form("x - x of two", "follow", "A1x(t1) - A0x(t1) == 900", "A1x(t1) - A0x(t1) == 45", "gap(A0, A1, t1) == 30"),
    Form("v of two", "cross", "A1v(t1) - A0v(t1) == 100", "A1v(t1) == A0v(t1) - 6", "A1v(t1) == A0v(t1) - 2"),
    # arithmetic
    Form("product", "cross", "A1v(t1) * 2 s == 100 m", "A1v(t1) * 2 s == 11 m", _FAST),
    Form("quotient", "cross", "A1v(t1) / A1v(t0) == -1", "A1v(t1) / A1v(t0) <= 1/2", "A1v(t1) == A1v(t0)"),
    Form("negative", "cross", "-A1v(t1) >= 1", "-A1v(t1) >= -5.5", _FAST),
    # logic
    Form("and", "cross", "A1v(t1) == 5.5 and A1v(t1) == 9", "A1v(t1) == 5.5 and A1x(t0) <= conflict_point - 60", _FAST),
    Form("or", "cross", "A1v(t1) == 50 or A1v(t1) == 60", "A1v(t1) == 5.5 or A1v(t1) == 50", _FAST),
    Form(
        "implies",
        "cross",
        "A1x(t1) <= conflict_point implies A1v(t1) == 50",
        "A1x(t1) <= conflict_point implies A1v(t1) == 5.5",
        _FAST,
    ),
    Form("not", "cross", "not (A1v(t1) <= 50)", "not (A1v(t1) >= 5.5)", _FAST),
    Form("chain", "cross", "50 <= A1v(t1) <= 60", "5 <= A1v(t1) <= 6", _FAST),
    # intervals
    Form("always, knots", "cross", *_over("always", _BRAKING, "A1v >= 100", "A1v <= 5.5"), _FAST),
    Form("always, seconds", "cross", *_over("always", "1, 2", "A1v >= 100", "A1v <= 4"), "always[0, 3] (A1v >= 7)"),
    Form(
        "always, knot and seconds", "cross", *_over("always", "A1(t1) - 2, A1(t1)", "A1v >= 100", "A1v <= 5.5"), _FAST
    ),
    Form("always, ego's knots", "cross", *_over("always", "A0(t1), A0(t2)", "A1v >= 100", "A1v <= 5.5"), _FAST),
    Form("always, knots of two", "cross", *_over("always", "A0(t1), A1(t2)", "A1v >= 100", "A1v <= 5.5"), _FAST),
    Form("never, knots", "cross", *_over("never", _APPROACH, "A1v < 100", "A1v > 5.5"), _SWIFT),
    Form("never, seconds", "cross", *_over("never", "1, 2", "A1v < 100", "A1v > 4"), "always[0, 3] (A1v >= 7)"),
    Form("eventually, knots", "cross", *_over("eventually", _APPROACH, "A1v >= 100", "A1v <= 3"), _SWIFT),
    Form(
        "eventually, seconds",
        "cross",
        *_over("eventually", "1, 3", "A1v >= 100", "A1v <= 3"),
        "always[0, 4] (A1v >= 7)",
    ),
    Form("eventually, two sides", "cross", *_over("eventually", _APPROACH, "A1v == 100", "A1v == 4"), _SWIFT),
    Form(
        "always x",
        "cross",
        *_over("always", _APPROACH, "A1x >= conflict_point + 50", "A1x >= conflict_point - 60"),
        "A1x(t0) == conflict_point - 90",
    ),
    Form("always a", "cross", *_over("always", _BRAKING, "A1a <= -50", "A1a <= -3"), "A1a(dec) == -1.5"),
    Form(
        "always gap",
        "follow",
        *_over("always", _APPROACH, "gap(A0, A1) >= 900", "gap(A0, A1) >= 60"),
        "gap(A0, A1, t1) == 30",
    ),
    Form(
        "always headway",
        "near",
        *_over("always", _APPROACH, "headway(A0, A1) >= 90", "headway(A0, A1) >= 3"),
        "headway(A0, A1, t1) == 1.8",
    ),
    Form(
        "always tta",
        "cross",
        *_over("always", _APPROACH, "tta(A1, conflict_point) <= 0.1", "tta(A1, conflict_point) >= 5"),
        _FAST,
    ),
    Form(
        "always of two",
        "cross",
        *_over("always", _APPROACH, "A1v >= A0v + 100", "A1v <= A0v - 6"),
        "A1v(t1) == A0v(t1)",
    ),
    Form(
        "always implies",
        "cross",
        *_over(
            "always", _APPROACH, "A1x <= route_end implies A1v >= 100", "A1x >= conflict_point - 40 implies A1v <= 5.5"
        ),
        _FAST,
    ),
    Form("not always", "cross", *_over("not always", _BRAKING, "A1v <= 100", "A1v <= 5.5"), _SLOW),
    Form(
        "interval in logic",
        "cross",
        "A1v(t1) == 50 or always[1, 2] (A1v >= 100)",
        "A1v(t1) == 50 or always[A1(t0), A1(t1)] (A1v <= 5.5)",
        _SWIFT,
    ),
    Form(
        "interval in interval",
        "cross",
        "always[1, 2] (always[1, 2] (A1v >= 100))",
        "always[A1(t0), A1(t1)] (always[A1(t0), A1(t1)] (A1v <= 5.5))",
        _SWIFT,
    ),
    # parameters
    Form("parameter, value", "cross", "A1v(t1) == p_mps", "A1v(t1) == p_mps", _FAST, ("p_mps = 50", "p_mps = 5.5")),
    Form(
        "parameter, range",
        "cross",
        "A1v(t1) == p_mps",
        "A1v(t1) == p_mps",
        _FAST,
        ("p_mps in [50, 60]", "p_mps in [5, 6]"),
    ),
    Form("parameter, open", "cross", "A1v(t1) == p_mps and p_mps >= 50", "A1v(t1) == p_mps and p_mps <= 5.5", _FAST),
    # the ego, whom nobody controls
    Form("v of the ego", "cross", "A0v(t1) == 500", "A0v(t1) == 7", "A0v(t1) == 10"),
    Form("v of the ego at a time", "cross", "A0v(2.0) == 500", "A0v(2.0) == 7", "A0v(2.0) == 10"),
    Form("a of the ego at a time", "cross", "A0a(2.0) == 50", "A0a(2.0) <= -1", "always[0, 4] (A0a >= 0)"),
    Form(
        "always v of the ego",
        "cross",
        *_over("always", "A0(t0), A0(t1)", "A0v >= 500", "A0v <= 7"),
        "always[A0(t0), A0(t1)] (A0v >= 9)",
    ),
)
