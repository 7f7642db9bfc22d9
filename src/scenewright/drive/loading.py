"""Find a policy by name, or a user's own class, and build it with options.

What enters: ``NAME[:k=v,...]`` or ``module:Class[:k=v,...]``. What leaves: a policy, its name and the options given.
Policies are not imported before they are asked for. This module drives nothing and guards nothing (see `guarded`).
"""

from __future__ import annotations

import inspect
import sys
import types
from collections.abc import Callable
from difflib import get_close_matches
from importlib import import_module
from importlib.metadata import entry_points
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any, Literal, NamedTuple, Union, cast, get_args, get_origin, get_type_hints

from scenewright.drive.protocol import EgoPolicy
from scenewright.errors import PolicyError, told_by

GROUP = "scenewright.policies"
OptionValue = float | int | bool | str | None


class BuiltIn(NamedTuple):
    """Where a policy of ours lives, and what it does in one line."""

    module: str
    class_name: str
    description: str


BUILT_IN: dict[str, BuiltIn] = {
    "constant": BuiltIn("scenewright.drive.constant", "Constant", "holds its speed and sees nobody"),
    "idm": BuiltIn("scenewright.drive.idm", "Idm", "careful driver: follows, stops at the line, yields, takes gaps"),
    "speeder": BuiltIn("scenewright.drive.hostile", "Speeder", "30 to 50 % too fast, ignores stop line and priority"),
    "dawdler": BuiltIn("scenewright.drive.hostile", "Dawdler", "40 to 60 % of the limit, accelerates gently, yields"),
    "staller": BuiltIn("scenewright.drive.hostile", "Staller", "careful, but stops at random moments for 1.5 to 4 s"),
    "stop-and-go": BuiltIn("scenewright.drive.hostile", "StopAndGo", "careful, but changes between crawling and going"),
    "noisy": BuiltIn("scenewright.drive.hostile", "Noisy", "careful, with an unsteady foot on the pedal"),
    "delayed": BuiltIn("scenewright.drive.hostile", "Delayed", "careful, but acts on what it saw 0.4 s ago"),
}


class LoadedPolicy(NamedTuple):
    """A policy, the name it goes by, and the options that it was built with."""

    policy: EgoPolicy
    name: str
    options: dict[str, OptionValue]


def policy_descriptions() -> dict[str, str]:
    """Return every policy that can be named, with one line about it; nothing is imported for that."""
    ours = {name: entry.description for name, entry in BUILT_IN.items()}
    theirs = {point.name: f"from {point.value}" for point in entry_points(group=GROUP) if point.name not in ours}
    return ours | theirs


def load_policy(spec: str) -> LoadedPolicy:
    """Build the policy that a specification names.

    Parameters
    ----------
    spec
        ``NAME[:k=v,...]`` for a policy of ours or of an installed package (entry-point group
        ``scenewright.policies``); ``module:Class[:k=v,...]`` for a class of the user's, sought in the current folder
        too; ``folder/file.py:Class[:k=v,...]`` for one in a file.

    Returns
    -------
    LoadedPolicy
        The policy, not yet reset, its name and its options.

    Raises
    ------
    PolicyError
        If there is no such policy, it cannot be imported, an option does not exist or has the wrong type, or its
        constructor raises.

    Examples
    --------
    >>> policy, name, options = load_policy("constant:speed_mps=12")
    >>> name, options
    ('constant', {'speed_mps': 12.0})
    """
    head, *rest = (part.strip() for part in spec.strip().split(":"))
    if rest and rest[0] and "=" not in rest[0] and head not in BUILT_IN:
        name, options_text = f"{head}:{rest[0]}", ":".join(rest[1:])
        make = _users_class(head, rest[0])
    else:
        name, options_text = head, ":".join(rest)
        make = _named_class(head)
    options = _options(name, make, options_text)
    return LoadedPolicy(_build(name, make, options), name, options)


def _named_class(name: str) -> Callable[..., object]:
    if name in BUILT_IN:
        entry = BUILT_IN[name]
        return cast("Callable[..., object]", getattr(import_module(entry.module), entry.class_name))
    for point in entry_points(group=GROUP):
        if point.name == name:
            try:
                return cast("Callable[..., object]", point.load())
            except (Exception, SystemExit) as error:  # whatever a plug-in does at import is its fault
                raise PolicyError(
                    f"the policy {name!r} cannot be imported",
                    found=told_by(error),
                    fix=f"repair or reinstall the package that offers {point.value}",
                ) from error
    known = sorted(policy_descriptions())
    raise PolicyError(
        "there is no such ego policy",
        found=repr(name),
        expected=", ".join(known) + ", or module:Class for one of your own",
        fix=_did_you_mean(name, known) or "take one of these, or name your own class as module:Class",
    )


def _users_class(module_name: str, class_name: str) -> Callable[..., object]:
    # The folder stays on the path: a policy may import its own parts later, when it runs.
    file = Path(module_name).resolve() if module_name.endswith(".py") else None
    folder, stem = (file.parent, file.stem) if file is not None else (Path.cwd(), module_name)
    if str(folder) not in sys.path:
        sys.path.insert(0, str(folder))
    try:
        module = import_module(stem) if file is None else _module_in(file)
    except ModuleNotFoundError as error:
        if error.name is None or not (stem == error.name or stem.startswith(error.name + ".")):
            raise _import_fault(module_name, error) from error
        here = f"neither {stem.replace('.', '/')}.py in the current folder nor an installed module"
        raise PolicyError(
            f"there is no module {stem!r}",
            found=here if file is None else f"no file {module_name}",
            expected="module:Class, with the module in the current folder or installed",
            fix=_did_you_mean(stem, [path.stem for path in folder.glob("*.py")]) or "check the name and the folder",
        ) from error
    except (Exception, SystemExit) as error:  # a user's module may do anything at import
        raise _import_fault(module_name, error) from error
    made = getattr(module, class_name, None)
    if made is None or not callable(made):
        classes = [name for name, value in vars(module).items() if inspect.isclass(value) and hasattr(value, "step")]
        raise PolicyError(
            f"{stem!r} ({getattr(module, '__file__', 'no file')}) has no class {class_name!r}",
            found="something that cannot be called" if made is not None else None,
            expected="one of its policies: " + ", ".join(classes) if classes else "a class with reset() and step()",
            fix=_did_you_mean(class_name, classes) or "check the name of the class",
        )
    return cast("Callable[..., object]", made)


def _module_in(file: Path) -> types.ModuleType:
    """Return the module that a file is; by its whole path, for others may have its name."""
    name = str(file)
    if name in sys.modules:
        return sys.modules[name]
    spec = spec_from_file_location(name, file)
    if spec is None or spec.loader is None or not file.is_file():
        raise ModuleNotFoundError(name=file.stem)
    sys.modules[name] = module = module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except BaseException:
        del sys.modules[name]
        raise
    return module


def _import_fault(module_name: str, error: BaseException) -> PolicyError:
    alone = module_name if module_name.endswith(".py") else f'-c "import {module_name}"'
    return PolicyError(
        f"the module {module_name!r} cannot be imported",
        found=told_by(error),
        fix=f"make `python {alone}` work first",
    )


def _options(name: str, make: Callable[..., object], text: str) -> dict[str, OptionValue]:
    """Read ``k=v,...`` by what the constructor takes."""
    known = _constructor_options(make)
    listing = ", ".join(f"{key} ({_type_name(kind)})" for key, kind in known.items()) or "no options"
    options: dict[str, OptionValue] = {}
    for item in filter(None, (part.strip() for part in text.split(","))):
        key, equals, value = (part.strip() for part in item.partition("="))
        if not equals:
            raise PolicyError(
                f"an option of {name!r} is not of the form name=value",
                found=repr(item),
                expected=listing,
                fix=f"write {name}:{key}=VALUE",
            )
        if key not in known:
            raise PolicyError(
                f"{name!r} has no option {key!r}",
                found=repr(item),
                expected=listing,
                fix=_did_you_mean(key, list(known)) or "leave it out, or take one of these",
            )
        if key in options:
            raise PolicyError(f"option {key!r} of {name!r} is given twice", found=repr(text), fix="give it once")
        try:
            options[key] = _read_value(value, known[key])
        except ValueError as error:
            raise PolicyError(
                f"option {key!r} of {name!r} has the wrong type",
                found=repr(value),
                expected=_type_name(known[key]),
                fix=_how_to_write(key, known[key]),
            ) from error
    return options


def _constructor_options(make: Callable[..., object]) -> dict[str, Any]:
    """Return the type of every argument that a constructor takes by name; `Any` where it names none."""
    try:
        parameters = inspect.signature(make).parameters.values()
    except (TypeError, ValueError):
        return {}
    hinted = make.__init__ if inspect.isclass(make) and "__init__" in vars(make) else make
    try:
        hints = get_type_hints(hinted)
    except Exception:  # annotations that do not resolve at run time say nothing; values are then read as they look
        hints = {}
    fixed = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.VAR_POSITIONAL, inspect.Parameter.VAR_KEYWORD)
    return {
        parameter.name: hints.get(
            parameter.name, Any if parameter.default in (inspect.Parameter.empty, None) else type(parameter.default)
        )
        for parameter in parameters
        if parameter.kind not in fixed
    }


def _read_value(text: str, kind: Any) -> OptionValue:
    choices = _choices(kind)
    if type(None) in choices and text.lower() == "none":
        return None
    for named in (each for choice in choices if get_origin(choice) is Literal for each in get_args(choice)):
        if str(named) == text:
            return cast("OptionValue", named)
    for choice in (bool, int, float):  # narrow before wide: 1 is an int where both would do
        if choice in choices or Any in choices:
            try:
                return _read_bool(text) if choice is bool else _finite(choice(text))
            except ValueError:
                continue
    if str in choices or Any in choices:
        return text
    raise ValueError(text)


def _read_bool(text: str) -> bool:
    if text.lower() in ("true", "yes", "on", "false", "no", "off"):
        return text.lower() in ("true", "yes", "on")
    raise ValueError(text)


def _finite(value: float | int) -> float | int:
    if value != value or value in (float("inf"), float("-inf")):
        raise ValueError("not a finite number")
    return value


def _build(name: str, make: Callable[..., object], options: dict[str, OptionValue]) -> EgoPolicy:
    try:
        policy = make(**options)
        missing = [method for method in ("reset", "step") if not callable(getattr(policy, method, None))]
    except PolicyError:
        raise
    except (Exception, SystemExit) as error:  # a user's constructor may do anything
        raise PolicyError(
            f"the policy {name!r} cannot be built",
            found=told_by(error),
            expected="a constructor that takes " + (", ".join(_constructor_options(make)) or "no arguments"),
            fix="check the options, or the policy's constructor",
        ) from error
    if missing:
        raise PolicyError(
            f"{name!r} is not a policy",
            found=f"a {type(policy).__name__} without {' and '.join(f'{method}()' for method in missing)}",
            expected="reset(start) and step(observation, dt_s), see scenewright.drive.protocol",
            fix="add the missing method" + ("s" if len(missing) > 1 else ""),
        )
    return cast("EgoPolicy", policy)


def _did_you_mean(word: str, known: list[str]) -> str | None:
    close = get_close_matches(word.lower(), known, n=1) or get_close_matches(word, known, n=1)
    return f"did you mean {close[0]!r}?" if close else None


def _choices(kind: Any) -> tuple[Any, ...]:
    return get_args(kind) if get_origin(kind) in (Union, types.UnionType) else (kind,)


def _type_name(kind: Any) -> str:
    names = {float: "number", int: "whole number", bool: "true or false", str: "text", type(None): "none", Any: "value"}
    told = (get_args(choice) if get_origin(choice) is Literal else (choice,) for choice in _choices(kind))
    return " or ".join(names.get(each, getattr(each, "__name__", str(each))) for some in told for each in some)


def _how_to_write(key: str, kind: Any) -> str:
    first = _choices(kind)[0]
    named = get_args(first)[0] if get_origin(first) is Literal else None
    example = named or {float: "1.5", int: "1", bool: "true", str: "text"}.get(first)
    if example is None:
        return f"annotate {key!r} as a number, bool, str or Literal to give it here"
    return f"write {key}={example}, for instance"
