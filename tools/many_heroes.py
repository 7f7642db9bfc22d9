"""Drives many heroes at once, and says how long planning took, what was met, and how near anybody came to another.

    python tools/many_heroes.py                          the table of docs/evaluation.md
    python tools/many_heroes.py platoon:8 chain:3 idm    these programs and egos only
"""

from __future__ import annotations


def platoon(count: int) -> str:
    """Return a program in which all ahead of the ego brake in turn: the foremost at the trigger, then one by one."""
    heroes = [f"Actor {k} (car{k}):\n- W\n- [t0, go, t1, dec, t2]\n" for k in range(1, count + 1)]
    rows = [
        f"A0(t{1 + count - k}) == A{k}(t1)\nA0x(t{1 + count - k}) == {60 + 12 * (count - k)}\nA{k}x(t1) == {80 + 12 * (count - k) + 22 * k}\nA{k}v(t2) == 3"
        for k in range(count, 0, -1)
    ]
    knots = ", go, ".join(f"t{k}" for k in range(count + 2))
    return f"Actor 0 (ego):\n- W\n- [{knots}]\n\n" + "\n".join(heroes) + "\nConstraints:\n" + "\n".join(rows) + "\n"


def crossing(count: int) -> str:
    """Return a program in which cars of four lanes are to be at places short of the junction when the ego is."""
    ways = ("E, N", "E", "S, W", "S, E")
    heroes, rows, later = [], [], []
    for k in range(1, count + 1):
        way, row = ways[k % 4], (k - 1) // 4
        heroes.append(f"Actor {k} (car{k}):\n- {way}\n- [t0, go, t1, dec, t2]\n")
        rows.append(f"A0(t1) == A{k}(t1)\nA{k}x(t1) == stop_line - {14 + 16 * row + 7 * (k % 4 in (1, 3))}\nA{k}v(t2) == 2")
    return (
        "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\n"
        + "\n".join(heroes)
        + "\nConstraints:\nA0x(t1) == stop_line - 60\n"
        + "\n".join(rows)
        + "\n"
    )


def chain(count: int) -> str:
    """Return a program in which the car ahead brakes, and each behind the one before 1.5 s after that began."""
    heroes = [f"Actor {k} (car{k}):\n- W\n- [t0, go, t1, dec, t2]\n" for k in range(1, count + 1)]
    rows = ["A0(t1) == A1(t1)", "A0x(t1) == stop_line - 200", f"A1x(t1) == stop_line - {180-18*(count-1)-18}"]
    rows += [f"A{k}(t1) == A{k - 1}(t1) + 1.5 s\ngap(A{k},A{k-1},t1) == 16\nA{k}a(dec) == -2" for k in range(2, count + 1)]
    return "Actor 0 (ego):\n- W\n- [t0, go, t1, go, t2]\n\n" + "\n".join(heroes) + "\nConstraints:\n" + "\n".join(rows) + "\n"
