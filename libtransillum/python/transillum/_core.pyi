# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""The compiled part. Its names may change at any time: use those of `transillum`."""

from typing import Any, Callable, Optional, Sequence

import numpy as np
import numpy.typing as npt

Values = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int32]
Rows = tuple[Values, Indices, npt.NDArray[np.int64]]
Triple = tuple[float, float, float]
Progress = Optional[Callable[[dict[str, Any]], Any]]

__version__: str

class InputError(ValueError): ...

class Scene:
    name: str
    points: Values
    outlines: tuple[npt.NDArray[np.int64], Indices]
    area: Values
    normal: Values
    center: Values
    reflectance: Values
    exitance: Values
    face: Indices
    group: Indices
    groups: list[str]
    warnings: list[str]
    def __len__(self) -> int: ...

class Solution:
    scene: Scene
    radiosity: Values
    corner_radiosity: Values
    irradiance: Values
    standard_error: Optional[Values]
    quantile: float
    rms_error: Optional[float]
    complete: bool
    statistics: dict[str, Any]

class Run:
    progress: dict[str, Any]
    radiosity: Values
    directions: Values
    def __init__(self, scene: Scene, options: dict[str, Any]) -> None: ...
    def advance(self, until: str, progress: Progress) -> bool: ...
    def solution(self) -> Solution: ...
    def form_factors(self) -> Rows: ...

class VisibilityMap:
    scene: Scene
    frame: tuple[Triple, Triple, Triple, Triple]
    polygons: list[tuple[int, bool, float, Values]]
    def svg(self, size: int) -> str: ...

def options() -> list[tuple[str, str, str, str]]: ...
def built_in_scenes() -> list[tuple[str, str, str]]: ...
def load(
    spec: str,
    two_sided: bool,
    max_patch_area: float,
    patches: int,
    scale: float,
    join: Optional[bool],
    default_reflectance: float,
) -> Scene: ...
def build(
    points: Values,
    faces: Sequence[Sequence[int]],
    reflectance: Values,
    exitance: Values,
    two_sided: bool,
    max_patch_area: float,
    patches: int,
    name: str,
) -> Scene: ...
def solve(scene: Scene, options: dict[str, Any], progress: Progress) -> Solution: ...
def form_factors(scene: Scene, options: dict[str, Any], progress: Progress) -> Rows: ...
def transfers(scene: Scene, direction: Values, options: dict[str, Any]) -> dict[str, Any]: ...
def visibility_map(scene: Scene, direction: Values, patch: Optional[int]) -> VisibilityMap: ...
