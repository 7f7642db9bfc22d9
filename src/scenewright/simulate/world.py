"""What stays the same all through one request: the scene, the ego and its promises, limits, rates, the solver.

What enters: a scene and how it is to be run. What leaves: a `World`. Nothing is planned or driven here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from fractions import Fraction

from scenewright.drive.guarded import GuardedPolicy
from scenewright.drive.loading import load_policy
from scenewright.motion.limits import Limits, Signs, limits_on
from scenewright.plan.alternatives import planned_for
from scenewright.plan.prediction import ConstantSpeed, Predictor, Rehearsed, predictor_called
from scenewright.program.structure import Structure, read_structure
from scenewright.program.types import EGO
from scenewright.roads.grounding import Scene
from scenewright.simulate.ego_start import EgoFirstState, told_speed_mps
from scenewright.simulate.loop import Rates
from scenewright.simulate.port import SIMULATORS
from scenewright.simulate.vehicles import EgoVehicle
from scenewright.solve.arrival import ego_begins_between, linear_conditions
from scenewright.solve.feasibility import EgoBounds, Feasibility, Question
from scenewright.solve.parameters import settle
from scenewright.solve.proofs.refuters import SOLVERS
from scenewright.solve.proofs.witness import Witness


class World:
    """One scene with an ego, ready to be planned and driven again and again.

    Policy (with its options), predictor, solver (of what refutes) and simulator are given by name; the seed is that of
    the policy. A simulator that drives the ego itself keeps no promise of the policy's.

    `planned` is the scene as heroes are planned in it: what lasts is decided. `witness` is how it can happen, if a
    check has found that. Parameters that are not `given` may be chosen, and chosen again. `alone` is how the ego drives
    alone from first states that it was driven from; None where it drives otherwise each time.

    Raises
    ------
    ScenewrightError
        Where there is no such policy, predictor, solver or simulator.
    """

    def __init__(
        self,
        scene: Scene,
        ego: str,
        seed: int,
        rates: Rates,
        predictor: str = "road",
        solver: str = "z3",
        simulator: str = "builtin",
    ) -> None:
        self.scene = self.planned = scene
        self.witness: Witness | None = None
        self.alone: dict[EgoFirstState, Rehearsed | None] = {}
        self.given = scene.parameters
        self.rates = rates
        self.policy = load_policy(ego)
        guarded = GuardedPolicy(self.policy.policy, self.policy.name)
        self.ego = EgoVehicle(guarded, scene.routes[EGO], scene.road_map, seed)
        self.structure: Structure = read_structure(scene.program)
        self.limits: dict[int, Limits] = {i: limits_on(route, scene.road_map) for i, route in scene.routes.items()}
        self.refuter = SOLVERS.called(solver)
        self.simulator = SIMULATORS.called(simulator)
        told_mps = told_speed_mps(scene, linear_conditions(scene, self.structure))
        least_mps, most_mps = ego_begins_between(scene)[1]
        if told_mps is None and guarded.envelope is not None and least_mps > guarded.envelope.speed_max_mps:
            told_mps = most_mps  # it begins faster than it would: of its fastest start it promises least
        begins = None if told_mps is None else self.ego.start_at(0.0, told_mps)
        promise = None if self.simulator.capabilities.drives_ego else guarded.promise_from(begins)
        self.ego_bounds = (
            EgoBounds(promise.speed_max_mps, promise.accel_max_mpss, -promise.accel_min_mpss, promise.holds_speed)
            if promise is not None
            else EgoBounds()
        )
        chosen = predictor_called(predictor, scene.routes[EGO], Signs.of(scene.routes[EGO], scene.road_map))
        # Who has promised to hold its speed needs no foresight, and where nobody looks again it would be in vain.
        steady = rates.replan_s is None or self.ego_bounds.holds_speed
        self.predictor: Predictor = ConstantSpeed() if steady else chosen

    def choose_and_check(self, explain: bool = True) -> Feasibility:
        """Give open parameters values, and ask whether the scenario can happen with them; with `explain`, why not."""
        asked = Question(self.scene, self.structure, self.limits, self.ego_bounds, refuter=self.refuter)
        self.scene, answer = settle(asked, explain)
        self.witness = answer.witness
        self.planned = planned_for(self.scene, self.witness)
        return answer

    def choose(self, parameters: Mapping[str, Fraction]) -> None:
        """Let all parameters have other values (SI)."""
        self.scene, self.planned = (replace(scene, parameters=parameters) for scene in (self.scene, self.planned))
