# transillum: diffuse light by the transillumination method. GPL-3.0-or-later.
"""Numbers that a caller passes. Python would take True for 1."""

from __future__ import annotations

from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

T = TypeVar("T")


def number(name: str, value: T) -> T:
    """The value of an argument: a number, None, or a sequence of numbers.

    Raises TypeError where it is a boolean or contains one.
    """
    if _has_boolean(value):
        raise TypeError(f"{name}: expected a number, not {value!r}")
    return value


def array(name: str, value: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """The numbers of an argument as an array; raises TypeError as number() does."""
    return np.asarray(number(name, value), dtype=np.float64)


def _has_boolean(value: Any) -> bool:
    if isinstance(value, np.ndarray) and value.dtype != object:
        return value.dtype == np.bool_
    if isinstance(value, (list, tuple, np.ndarray)):
        return any(_has_boolean(item) for item in value)
    return isinstance(value, (bool, np.bool_))
