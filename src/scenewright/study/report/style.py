"""How figures look: one palette, and the way from a drawing to PNG bytes.

What enters: a function that draws. What leaves: PNG. Matplotlib is imported here alone and only when something is
drawn; no window system is touched.
"""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, cast

from scenewright.errors import MissingExtraError
from scenewright.study.causes import INFEASIBLE, NEVER_MET, NO_ROOM

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

DPI = 144
GROUND, INK, SOFT, LINE, EMPTY = "#ffffff", "#15191e", "#535c67", "#d3d8de", "#f1f3f5"
# Okabe and Ito's colours, which the colour-blind tell apart.
_METHODS = {
    "scenewright": "#0072b2",
    "open-loop": "#d55e00",
    "trigger-action": "#009e73",
    "synchronise": "#cc79a7",
    "rejection": "#e69f00",
    "follower": "#6b7480",
}
_SPARE = ("#56b4e9", "#a6761d", "#7570b3")
_MARKERS = ("o", "s", "^", "D", "v", "P", "X", "*")
LATER = "success in a later take"
# In the order in which legends show them.
CAUSE_COLOURS = {
    "success": "#0072b2",
    LATER: "#7fc4ee",
    "loose only": "#f0e442",
    "missed": "#d55e00",
    "gave up": "#1a1a1a",
    "error": "#cc79a7",
    NO_ROOM: "#009e73",
    NEVER_MET: "#e69f00",
    INFEASIBLE: "#b8bec6",
}


def method_colour(method: str) -> str:
    """Return the colour of a method."""
    return _METHODS.get(method.partition(":")[0]) or _SPARE[sum(method.encode()) % len(_SPARE)]


def method_marker(position: int) -> str:
    """Return the marker of the method at this position: shapes tell lines apart where colours do not."""
    return _MARKERS[position % len(_MARKERS)]


def cause_colour(cause: str) -> str:
    """Return the colour of a cause."""
    return CAUSE_COLOURS.get(cause, "#999999")


def require_matplotlib() -> None:
    """Raise MissingExtraError where matplotlib is not installed."""
    try:
        import matplotlib  # noqa: F401
    except ImportError:
        raise MissingExtraError("matplotlib, which draws the figures,", "plots") from None


def new_figure(width_in: float, height_in: float) -> Figure:
    """Return an empty figure that lays itself out."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width_in, height_in), facecolor=GROUND, layout="constrained")


def render_png(draw: Callable[[], Figure], about: Mapping[str, str]) -> bytes:
    """Return a drawing as PNG; `about` goes into the file as its text chunks."""
    import matplotlib as mpl

    buffer = io.BytesIO()
    with mpl.rc_context(cast("Any", _SETTINGS)), warnings.catch_warnings():
        # Constrained layout gives up on tiny figures with a warning; what it then draws is still readable.
        warnings.filterwarnings("ignore", message="constrained_layout not applied")
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")  # it draws a box in its place
        draw().savefig(buffer, format="png", dpi=DPI, metadata={**about, "Software": "scenewright"})
    return buffer.getvalue()


_SETTINGS: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.titlesize": 9.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9,
    "axes.edgecolor": LINE,
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": LINE,
    "grid.linewidth": 0.6,
    "xtick.color": SOFT,
    "ytick.color": SOFT,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.labelsize": 8.5,
    "ytick.labelsize": 8.5,
    "text.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "hatch.linewidth": 0.6,
}


def percent_axis(axes: Axes, which: str = "x") -> None:
    """Let an axis run from 0 to 100 %."""
    axis = axes.xaxis if which == "x" else axes.yaxis
    (axes.set_xlim if which == "x" else axes.set_ylim)(0, 100)
    axis.set_ticks([0, 25, 50, 75, 100])
    axis.grid(True)


def bare(axes: Axes) -> None:
    """Take ticks and frame away: what is drawn are fields."""
    axes.tick_params(length=0)
    for side in axes.spines.values():
        side.set_visible(False)


def say_empty(axes: Axes, text: str) -> None:
    """Write into axes that there is nothing to draw."""
    axes.set_axis_off()
    axes.text(0.5, 0.5, text, ha="center", va="center", color=SOFT, transform=axes.transAxes)
