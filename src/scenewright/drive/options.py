"""What the options of policies may be.

What enters: a policy with its options set. What leaves: nothing, or a `PolicyError` that names the option. Types are
checked earlier, when the text of an option is read (see `loading`).
"""

from __future__ import annotations

from scenewright.errors import PolicyError

SPEED_MAX_MPS = 60.0  # the fastest that a program may speak of


def require(
    name: str, policy: object, options: tuple[str, ...], *, above: float | None = None, least: float | None = None
) -> None:
    """Refuse options of a policy that are out of range; None passes.

    Raises
    ------
    PolicyError
        If an option is not above `above` or is below `least`.
    """
    for option in options:
        value = getattr(policy, option)
        if value is None:
            continue
        if (above is not None and not value > above) or (least is not None and not value >= least):
            raise PolicyError(
                f"option {option!r} of {name!r} is out of range",
                found=f"{value:g}",
                expected=f"more than {above:g}" if above is not None else f"{least:g} or more",
                fix="give a larger value, or leave the option out",
            )
