"""Pictures, where matplotlib is installed."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .maps import StabilityMap
    from .subject import Scheme


def waves(scheme: Scheme, phases: Any, values: dict[str, Any], axes: Any) -> Any:
    """Gain, phase error and group speed over the phase."""
    if scheme.dimension != 1:
        raise ValueError(f"{scheme.name} has {scheme.dimension} space dimensions: waves are drawn in one")
    import matplotlib.pyplot as plt

    phase = np.asarray(phases[0]) if phases else np.linspace(0, np.pi, 201)[1:]
    if axes is None:
        _, axes = plt.subplots(1, 3, figsize=(10, 3), layout="constrained")
    label = ", ".join(f"{name} = {value}" for name, value in values.items())
    of = [
        ("largest |z|", scheme.gain(phase, **values)),
        ("phase error", scheme.phase_error(phase, **values)),
        ("group speed / exact", scheme.group_speed(phase, **values)),
    ]
    for ax, (name, curve) in zip(axes, of):
        ax.plot(phase, curve, label=label or None)
        ax.set(xlabel="phase φ (rad per cell)", ylabel=name)
    axes[0].figure.suptitle(scheme.title)
    return axes[0].figure


def stability_map(found: StabilityMap, ax: Any) -> Any:
    """The gain in colours, red where a wave grows, and the limit as a line."""
    import matplotlib.pyplot as plt
    from matplotlib.colors import TwoSlopeNorm

    if ax is None:
        _, ax = plt.subplots(layout="constrained")
    largest, lowest = np.asarray(found.largest), np.asarray(found.lowest)
    shown = np.where(largest > 1 + 1e-9, largest, lowest)
    norm = TwoSlopeNorm(vcenter=1.0, vmin=0.0, vmax=max(2.0, float(np.nanmin([np.nanmax(shown), 5.0]))))
    mesh = ax.pcolormesh(found.x, found.y, shown.T, norm=norm, cmap="RdBu_r", shading="nearest")
    ax.figure.colorbar(mesh, ax=ax, label="|z| of the most damped wave below 1, of the fastest growing one above")
    if found.limits is not None:
        limit = np.asarray(found.limits["value"])
        inside = np.where((limit > 0) & (limit <= found.y.max()), limit, np.nan)
        ax.plot(found.x, inside, color="black", linewidth=2, label="limit, decided")
        ax.legend(loc="upper left")
    ax.set(xlabel=found.x_name, ylabel=found.y_name)
    ax.set_title(found.scheme.title, fontsize="small", wrap=True)
    return ax
