"""What Python's users expect beyond the headers: faces as hosts store them, matrices row by row."""

from __future__ import annotations

from typing import Any, Dict, Optional

import numpy as np

from . import _api, _raw
from ._errors import InvalidArgumentError, NullPointerError
from ._library import ArrayLike, converted, library, numbers


def _faces(faces: Any) -> Dict[str, Any]:
    """(m, k) corners, (offsets, corners) or (starts, sizes, corners) as the fields of hf_faces_desc."""
    if not isinstance(faces, tuple):
        around = numbers(faces, "faces")
        if around.ndim != 2 or around.shape[1] < 3:
            raise InvalidArgumentError(f"faces must have the shape (m, 3) or wider, not {around.shape}")
        return {"sizes": np.full(len(around), around.shape[1], np.uint32), "corners": around}
    if len(faces) not in (2, 3):
        raise InvalidArgumentError("faces must be (offsets, corners) or (starts, sizes, corners)")
    if faces[-1] is None or all(part is None for part in faces[:-1]):
        raise NullPointerError("faces holds no corners, or neither starts nor sizes")
    return {"starts": faces[0], "sizes": faces[1] if len(faces) == 3 else None, "corners": faces[-1]}


class Surface(_api.Surface):
    __doc__ = f"""{_api.Surface.__doc__}
    faces: (m, k) corners; (offsets, corners), m + 1 offsets; or (starts, sizes, corners) as Blender's loops, with None for
        starts where faces follow one another
    link_pieces: True joins the pieces of a character by links. tags: (n,) with it: pieces of different tags stay apart
    """

    def __init__(self, positions: ArrayLike, triangles: Optional[ArrayLike] = None, *, faces: Any = None, link_pieces: bool = False,
                 tags: Optional[ArrayLike] = None, **options: Any) -> None:
        if positions is None:
            raise NullPointerError("positions is None")
        if tags is not None and not link_pieces:
            raise InvalidArgumentError("tags need link_pieces=True")
        if link_pieces:
            options["links"] = {"mode": _api.LinkMode.PIECES, "tags": tags}
        super().__init__(positions, triangles, **options, faces=None if faces is None else _faces(faces))


class Pose(_api.Pose):
    __doc__ = _api.Pose.__doc__

    def set_matrices(self, handles: ArrayLike, matrices: ArrayLike) -> None:
        """Rigid 4 x 4 matrices rest -> posed, (k, 4, 4) in the usual row-by-row reading."""
        rows = converted(matrices, "matrices", "f8")
        if rows.size % 16:
            raise InvalidArgumentError(f"matrices must have the shape (k, 4, 4), not {rows.shape}")
        super().set_matrices(handles, rows.reshape(-1, 4, 4).transpose(0, 2, 1))


def version() -> tuple:
    """Version of the loaded library: (major, minor, patch)."""
    number = library().hf_version_get()
    return number // 1000000, number // 1000 % 1000, number % 1000


NO_INDEX = _raw.HF_NO_INDEX
__all__ = ["NO_INDEX", "Pose", "Surface", "version"]
