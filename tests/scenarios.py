"""Example scenarios as one table: what parser, printer, checker, structure, grounding and solver must agree on."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from scenewright.motion.limits import Limits, limits_on
from scenewright.program.structure import Structure, read_structure
from scenewright.program.text import parse_program
from scenewright.program.types import Program
from scenewright.roads.grounding import Scene, ground
from scenewright.roads.load import load_map
from scenewright.solve.feasibility import EgoBounds, Feasibility, Question, check_feasibility

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
INITIAL, TRIGGER, INTERACTION, OUTCOME = "initial", "trigger", "interaction", "outcome"


@dataclass(frozen=True)
class Example:
    """A scenario and facts about it.

    `roles` are those of the constraints, in order; `trigger` the knots of the hero's trigger; `clashes` what a proof of
    infeasibility must name, where it cannot happen.
    """

    name: str
    text: str
    roles: tuple[str, ...]
    trigger: frozenset[tuple[int, str]] = frozenset({(0, "t1"), (1, "t1")})
    parameters: dict[str, float | str] = field(default_factory=dict)
    clashes: tuple[str, ...] = ()

    @property
    def feasible(self) -> bool:
        return not self.clashes

    def program(self) -> Program:
        return parse_program(self.text, self.name)

    def scene(self) -> Scene:
        program = self.program()
        return ground(program, load_map(program.map_name), self.parameters)


def example(hero_route: str, hero_sketch: str, constraints: str, ego_route: str = "W") -> str:
    return (
        f"Actor 0 (ego):\n- {ego_route}\n- [t0, go, t1, go, t2]\n\n"
        f"Actor 1 (hero):\n- {hero_route}\n- [{hero_sketch}]\n\nConstraints:\n{constraints.strip()}\n"
    )


BRAKES = Example(
    "brakes at a rate",
    example(
        "W",
        "t0, go, t1, dec, t2",
        """
A0x(t0) == intersection - 120
A0(t1) == A1(t1)
gap(A0, A1, t1) == ego_distance_behind_hero_m
A1a(dec) == -hero_deceleration_mpss
A1v(t2) == 0
""",
    ),
    (INITIAL, TRIGGER, TRIGGER, INTERACTION, INTERACTION),
    parameters={"ego_distance_behind_hero_m": 20, "hero_deceleration_mpss": 3},
)

YIELDS = Example(
    "yields",
    example(
        "E, N",
        "t0, go, t1, dec, t2",
        """
A1v(t0) == 8 m/s
A0(t1) == A1(t1)
A0x(t1) == stop_line - ego_distance_m
A1x(t1) == conflict_point - hero_distance_m
A1x(t2) == conflict_point - end_distance_m
A1v(t2) == 0
""",
    ),
    (INITIAL, TRIGGER, TRIGGER, TRIGGER, INTERACTION, INTERACTION),
    parameters={"ego_distance_m": 25, "hero_distance_m": "20", "end_distance_m": 6.5},
)

NOT_YIELDING = Example(
    "does not yield",
    example(
        "E, N",
        "t0, go, t1, acc, t2",
        """
A0(t1) == A1(t1)
tta(A0, stop_line, t1) == 3.5 s
A1x(t1) == conflict_point - 18
A1x(t2) == conflict_point
A0x(t2) == conflict_point
A1(t2) < A0(t2)
""",
    ),
    (TRIGGER, TRIGGER, TRIGGER, INTERACTION, OUTCOME, OUTCOME),
)

YIELDS_THEN_GOES = Example(
    "yields then goes",
    example(
        "W",
        "t0, go, t1, dec, t2, stop, t3, acc, t4",
        """
A0(t1) == A1(t1)
A0x(t1) == stop_line - 15
A1x(t1) == conflict_point - 40
A1x(t2) == just before conflict_point
A1v(t2) == 0
A1v(stop) == 0
A1x(t4) == conflict_point
A0x(t2) == turn_start
A1(t4) < A0(t2)
""",
        ego_route="S, W",
    ),
    (TRIGGER, TRIGGER, TRIGGER, INTERACTION, INTERACTION, INTERACTION, INTERACTION, OUTCOME, OUTCOME),
)

ONE_SIDED = Example(
    "trigger at the hero's own knot",
    example(
        "W",
        "t0, go, t1, dec, t2",
        "A0v(t0) == 9\ngap(A0, A1, A1(t1)) == 25\nA1a(dec) == -2.5\nA1v(t2) == 0",
    ),
    (INITIAL, TRIGGER, INTERACTION, INTERACTION),
    trigger=frozenset({(1, "t1")}),
)

BOUNDED = Example(
    "bounded all along",
    example(
        "E, N",
        "t0, go, t1, dec, t2",
        """
A0(t1) == A1(t1)
A0x(t1) == stop_line - 30
A1x(t1) == conflict_point - 25
A1v(t2) == 0
never[A1(t0), A1(t1)](A1v > 40 km/h)
always[A1(t1), A1(t2)](A1a <= -0.8 and A1a >= -5)
A1v(t1) >= 4 or A0v(t1) <= 10
""",
    ),
    (TRIGGER, TRIGGER, TRIGGER, INTERACTION, INTERACTION, INTERACTION, TRIGGER),
)

TOO_FAST = Example(
    "cannot stop in time",
    example(
        "E, N",
        "t0, go, t1, dec, t2",
        """
together: A0(t1) == A1(t1)
ego_place: A0x(t1) == stop_line - 25
fast: A1v(t1) == 12
hero_place: A1x(t1) == conflict_point - 12
stops: A1x(t2) == conflict_point - 5
stands: A1v(t2) == 0
""",
    ),
    (TRIGGER, TRIGGER, TRIGGER, TRIGGER, INTERACTION, INTERACTION),
    clashes=("fast", "hero_place", "stops", "stands"),
)

TOO_HARD = Example(
    "brakes too hard for the way it has",
    example(
        "W",
        "t0, go, t1, dec, t2",
        """
together: A0(t1) == A1(t1)
gap: gap(A0, A1, t1) == 20
speed: A1v(t1) == 10
rate: A1a(dec) == -rate_mpss
stands: A1v(t2) == 0
place: A1x(t2) - A1x(t1) == braking_m
""",
    ),
    (TRIGGER, TRIGGER, TRIGGER, INTERACTION, INTERACTION, INTERACTION),
    parameters={"rate_mpss": 2, "braking_m": 46},
    clashes=("speed", "rate", "place"),
)

BEHIND_ITSELF = Example(
    "stops before it begins to brake",
    example(
        "E, N",
        "t0, go, t1, dec, t2",
        """
together: A0(t1) == A1(t1)
ego_place: A0x(t1) == stop_line - 25
hero_place: A1x(t1) == conflict_point - 4
stops: A1x(t2) == conflict_point - 9
stands: A1v(t2) == 0
""",
    ),
    (TRIGGER, TRIGGER, TRIGGER, INTERACTION, INTERACTION),
    clashes=("hero_place", "stops"),
)


def _verbatim(name: str) -> str:
    return (EXAMPLES / f"{name}.scene").read_text(encoding="utf-8")


PAPER_TURNS = Example(
    "paper: lead turns into driveway",
    _verbatim("lead_turns_into_driveway"),
    (INITIAL, INITIAL, INITIAL, TRIGGER, TRIGGER, INTERACTION, TRIGGER),
    parameters={"ego_initial_speed_mps": 9, "initial_speed_mps": 8, "distance_ahead_of_ego_m": 30},
)
PAPER_HESITATES = Example(
    "paper: hesitates and goes",
    _verbatim("hesitates_and_goes"),
    (
        *(INITIAL, INITIAL, INTERACTION, TRIGGER, TRIGGER, INTERACTION, INTERACTION),
        *(TRIGGER, TRIGGER, OUTCOME, INTERACTION),
    ),
    parameters={
        "ego_initial_speed_mps": 6,
        "initial_speed_mps": 8,
        "deceleration_mpss": -2,
        "distance_to_driveway_m": 12,
    },
)

EXAMPLE_TABLE = (
    BRAKES,
    YIELDS,
    NOT_YIELDING,
    YIELDS_THEN_GOES,
    ONE_SIDED,
    BOUNDED,
    PAPER_TURNS,
    PAPER_HESITATES,
    TOO_FAST,
    TOO_HARD,
    BEHIND_ITSELF,
)
FEASIBLE = tuple(e for e in EXAMPLE_TABLE if e.feasible)
INFEASIBLE = tuple(e for e in EXAMPLE_TABLE if not e.feasible)


def limits_of(scene: Scene) -> dict[int, Limits]:
    return {actor: limits_on(route, scene.road_map) for actor, route in scene.routes.items()}


def feasibility(
    scene: Scene, structure: Structure | None = None, ego: EgoBounds | None = None, explain: bool = True
) -> Feasibility:
    structure = structure or read_structure(scene.program)
    return check_feasibility(Question(scene, structure, limits_of(scene), ego or EgoBounds()), explain)
