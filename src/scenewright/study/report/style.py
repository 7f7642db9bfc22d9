"""How figures look: two themes, one palette, and the way from a drawing to PNG bytes.

What enters: a function that draws on axes. What leaves: PNG. Matplotlib is imported here alone and only when something
is drawn; no window system is touched.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from scenewright.errors import MissingExtraError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DPI = 144


@dataclass(frozen=True, slots=True)
class Theme:
    """Colours of what is not data."""

    name: str
    ground: str
    ink: str
    soft: str
    line: str
    empty: str


LIGHT = Theme("light", "#ffffff", "#15191e", "#535c67", "#d3d8de", "#f1f3f5")
DARK = Theme("dark", "#171b20", "#e7ebef", "#9aa5b1", "#2d343c", "#222830")
THEMES = (LIGHT, DARK)

# Okabe and Ito's colours, which the colour-blind tell apart; on a light and on a dark ground.
_METHOD_COLOURS = {
    "scenewright": ("#0072b2", "#56a8e0"),
    "open-loop": ("#d55e00", "#e8813a"),
    "trigger-action": ("#009e73", "#2fbf96"),
    "synchronise": ("#cc79a7", "#dd94bd"),
    "rejection": ("#e69f00", "#eeb340"),
    "follower": ("#6b7480", "#a3adb8"),
}
_SPARE = (("#56b4e9", "#8ccdf2"), ("#a6761d", "#c79a45"), ("#7570b3", "#a5a1d6"))
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")


def method_colour(method: str, theme: Theme) -> str:
    """Return the colour of a method."""
    pair = _METHOD_COLOURS.get(method.partition(":")[0]) or _SPARE[sum(method.encode()) % len(_SPARE)]
    return pair[0 if theme.name == "light" else 1]


def method_marker(position: int) -> str:
    """Return the marker of the method at this position: shapes tell lines apart where colours do not."""
    return _MARKERS[position % len(_MARKERS)]


def require_matplotlib() -> None:
    """Raise MissingExtraError where matplotlib is not installed."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        raise MissingExtraError("matplotlib, which draws the figures,", "plots") from None


def new_figure(width_in: float, height_in: float, theme: Theme) -> Figure:
    """Return an empty figure that lays itself out."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width_in, height_in), facecolor=theme.ground, layout="constrained")


def render_png(draw: Callable[[Theme], Figure], theme: Theme, about: Mapping[str, str]) -> bytes:
    """Return a drawing as PNG; `about` goes into the file as its text chunks."""
    import matplotlib as mpl

    buffer = io.BytesIO()
    with mpl.rc_context(cast("Any", _settings(theme))), warnings.catch_warnings():
        # Constrained layout gives up on tiny figures with a warning; what it then draws is still readable.
        warnings.filterwarnings("ignore", message="constrained_layout not applied")
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")  # it draws a box in its place
        figure = draw(theme)
        figure.savefig(buffer, format="png", dpi=DPI, metadata={**about, "Software": "scenewright"})
    return buffer.getvalue()


def _settings(theme: Theme) -> dict[str, Any]:
    return {
        "font.family": "DejaVu Sans",
        "font.size": 9,
        "axes.titlesize": 9.5,
        "axes.titleweight": "bold",
        "axes.titlelocation": "left",
        "axes.labelsize": 9,
        "axes.edgecolor": theme.line,
        "axes.labelcolor": theme.ink,
        "axes.titlecolor": theme.ink,
        "axes.facecolor": theme.ground,
        "axes.axisbelow": True,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "grid.color": theme.line,
        "grid.linewidth": 0.6,
        "xtick.color": theme.soft,
        "ytick.color": theme.soft,
        "xtick.labelcolor": theme.ink,
        "ytick.labelcolor": theme.ink,
        "xtick.labelsize": 8.5,
        "ytick.labelsize": 8.5,
        "text.color": theme.ink,
        "legend.frameon": False,
        "legend.fontsize": 8.5,
        "hatch.linewidth": 0.6,
        "savefig.facecolor": theme.ground,
    }


def percent_axis(axes: Axes, which: str = "x") -> None:
    """Let an axis run from 0 to 100 %."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    (axes.set_xlim if which == "x" else axes.set_ylim)(0, 100)
    axis.set_ticks([0, 25, 50, 75, 100])
    axis.grid(True)


def say_empty(axes: Axes, text: str, theme: Theme) -> None:
    """Write into axes that there is nothing to draw."""
    axes.set_axis_off()
    axes.text(0.5, 0.5, text, ha="center", va="center", color=theme.soft, transform=axes.transAxes)
