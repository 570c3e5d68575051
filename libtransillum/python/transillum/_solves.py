# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Solves and their results."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._numbers import array, number
from ._scenes import Scene

if TYPE_CHECKING:
    import scipy.sparse

Values = npt.NDArray[np.float64]
Progress = Callable[[dict[str, Any]], Any]


class Solution:
    """The radiosity of every patch, and how it was found."""

    def __init__(self, core: _core.Solution, scene: Scene) -> None:
        self._core = core
        self._scene = scene

    def __repr__(self) -> str:
        state = "" if self.complete else ", incomplete"
        return f"<transillum.Solution of {len(self._scene)} patches{state}>"

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self._scene

    @property
    def radiosity(self) -> Values:
        """B, (N, 3), W/m²."""
        return self._core.radiosity

    @property
    def corner_radiosity(self) -> list[Values]:
        """B at the corners of each patch, (K, 3), W/m²: with basis="linear" its linear function,
        which may be below 0; else B of the patch."""
        begin, _ = self._scene._core.outlines
        return np.split(self._core.corner_radiosity, begin[1:-1])

    @property
    def irradiance(self) -> Values:
        """H, (N, 3), W/m²."""
        return self._core.irradiance

    @property
    def standard_error(self) -> Union[Values, None]:
        """The standard error of B, (N, 3), W/m², estimated from replicas; None without replicas."""
        return self._core.standard_error

    @property
    def confidence(self) -> Union[Values, None]:
        """Half the width of the 95 % confidence interval of B, (N, 3), W/m²; None without
        replicas."""
        error = self._core.standard_error
        return None if error is None else self._core.quantile * error

    @property
    def rms_error(self) -> Union[float, None]:
        """The limit of the relative RMS error of B in 95 % of all runs, of the color channel
        that is off the most; None without replicas."""
        return self._core.rms_error

    @property
    def surface_errors(self) -> Union[dict[str, float], None]:
        """The limit of the relative RMS error of B - E on each surface (group, material or
        connected component) in 95 % of all runs, of the color channel that is off the most,
        by the surface's name; None without replicas."""
        return self._core.surface_errors

    @property
    def accuracy(self) -> Union[dict[str, Any], None]:
        """How a solve to an accuracy has ended; None without one: whether it was `reached`, the
        `error`, the worst `surface` (empty where the error is of none), `passes` and the
        `obstacle` (`accuracy.obstacle` in FILES.md)."""
        return self._core.accuracy

    @property
    def complete(self) -> bool:
        """False: stopped early; radiosity is the best estimate so far."""
        return self._core.complete

    @property
    def statistics(self) -> dict[str, Any]:
        """Statistics of the solve."""
        return self._core.statistics


def solve(scene: Scene, *, progress: Union[Progress, None] = None, **options: Any) -> Solution:
    """Solves B_i = E_i + rho_i sum_j F_ij B_j.

    progress: called several times a second with a dict: iteration, direction (passes made in it),
        passes, passes_per_second, seconds_left, change, stage, stage_share. What it raises ends
        the solve.
    options: names and values as in options().
    """
    return Solution(_core.solve(scene._core, options, progress), scene)


def form_factors(
    scene: Scene, *, progress: Union[Progress, None] = None, **options: Any
) -> scipy.sparse.csr_matrix:
    """The matrix F of form factors, (N, N): F[i, j] is the fraction of what leaves patch i that
    reaches patch j. Without a sky, B = E + rho * (F @ B); with two-way passes, and unless rows are
    normalized, A_i F[i, j] = A_j F[j, i].

    progress: as for solve().
    options: names and values as in options(), only of directions, engine, normalization and
        memory.
    """
    return _to_csr(_core.form_factors(scene._core, options, progress), len(scene))


def picture(
    solution: Solution,
    eye: npt.ArrayLike,
    target: Union[npt.ArrayLike, None] = None,
    *,
    up: npt.ArrayLike = (0, 0, 1),
    fov: Union[float, None] = None,
    size: tuple[int, int] = (1280, 960),
    samples: int = 4,
    gather: int = 0,
) -> npt.NDArray[np.float32]:
    """The mean radiance of each pixel, (height, width, 3), W/(m² sr), rows from the top: a
    solution as an eye sees it, with sharp shadows.

    eye, target: points, m; the target, in the middle, is the center of the scene by default.
    up: the direction that is up in the picture.
    fov: vertical angle of view, degrees; None: the whole scene, up to 75.
    size: width and height.
    samples: points at which each pixel is sampled.
    gather: rays from each sample that gather the reflected light; with 0 it is interpolated.
    """
    points = [
        None if point is None else array(name, point)
        for name, point in (("eye", eye), ("target", target), ("up", up))
    ]
    return _core.picture(
        solution._core,
        *points,
        number("fov", fov),
        number("size", size),
        number("samples", samples),
        number("gather", gather),
    )


class Run:
    """A solve that is advanced pass by pass.

    >>> run = transillum.Run(scene, directions=4096)
    >>> while run.advance("direction"):
    ...     plot(run.radiosity)
    """

    def __init__(self, scene: Scene, **options: Any) -> None:
        """options: names and values as in options(), for engines that make passes."""
        self._scene = scene
        self._core = _core.Run(scene._core, options)

    @property
    def scene(self) -> Scene:
        """The scene."""
        return self._scene

    def advance(
        self, until: str = "iteration", *, progress: Union[Progress, None] = None
    ) -> bool:
        """Continues until the end of a "direction" (one pass), an "iteration", or "finished".

        With an accuracy, the next stage, with more directions, follows a stage that has ended;
        then radiosity and directions belong to the new stage, and solution() to the last
        finished one. Returns whether the solve is unfinished. Ctrl-C, and what progress raises,
        pause it after the pass under way: the next call continues. progress must not read the
        run.
        """
        return self._core.advance(until, progress)

    @property
    def progress(self) -> dict[str, Any]:
        """iteration, direction, passes, finished, change, passes_per_second, seconds_left; with
        lobes also stage ("passes", "scaling lobes" or "reflecting") and stage_share, 0 to 1."""
        return self._core.progress

    @property
    def radiosity(self) -> Values:
        """B, (N, 3), W/m², estimated from the passes made so far."""
        return self._core.radiosity

    @property
    def directions(self) -> Values:
        """The direction of each pass of the iteration, (M, 3)."""
        return self._core.directions

    def solution(self) -> Solution:
        """The result so far."""
        return Solution(self._core.solution(), self._scene)

    def form_factors(self) -> scipy.sparse.csr_matrix:
        """F, as of form_factors(), from the passes of finished iterations."""
        return _to_csr(self._core.form_factors(), len(self._scene))


def options() -> dict[str, str]:
    """The options of solve(), Run and form_factors(), each with its meaning and default."""
    return {
        name: f"{description} ({kind}; default: {default})"
        for name, kind, description, default in _core.options()
    }


def _to_csr(rows: tuple[Any, Any, Any], size: int) -> scipy.sparse.csr_matrix:
    from scipy.sparse import csr_matrix

    return csr_matrix(rows, shape=(size, size))
