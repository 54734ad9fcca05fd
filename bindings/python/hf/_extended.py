"""What Python's users expect beyond the headers: faces as hosts store them, matrices row by row."""

from typing import Any, Dict, Optional

import numpy as np

from . import _api, _errors
from ._library import ArrayLike, converted, numbers, require


def _faces(faces: Any) -> Dict[str, Any]:
    """(m, k) corners, (offsets, corners) or (starts, sizes, corners) as the fields of hf_faces_desc."""
    if not isinstance(faces, tuple):
        around = numbers(faces, "faces")
        require(around.ndim == 2 and around.shape[1] > 2, "faces need the shape (m, 3) or wider, not {}", around.shape)
        faces = None, np.full(len(around), around.shape[1], np.uint32), around
    require(len(faces) in (2, 3), "faces must be (offsets, corners) or (starts, sizes, corners)")
    return {"starts": faces[0], "sizes": faces[1] if len(faces) == 3 else None, "corners": faces[-1]}


class Surface(_api.Surface):
    __doc__ = f"""{_api.Surface.__doc__}
    faces: (m, k) corners; (offsets, corners), m + 1 offsets; or (starts, sizes, corners) as Blender's loops, with None
        for starts where faces follow one another
    link_pieces: True joins the pieces of a character by links. tags: (n,) with it: pieces of different tags stay apart
    """

    def __init__(self, positions: ArrayLike, triangles: Optional[ArrayLike] = None, *, faces: Any = None,
                 link_pieces: bool = False, tags: Optional[ArrayLike] = None, **options: Any) -> None:
        require(positions is not None, "positions is None", error=_errors.NullPointerError)
        require(link_pieces or tags is None, "tags need link_pieces=True")
        if link_pieces:
            options["links"] = {"mode": _api.LinkMode.PIECES, "tags": tags}
        super().__init__(positions, triangles, **options, faces=None if faces is None else _faces(faces))


class Pose(_api.Pose):
    __doc__ = _api.Pose.__doc__

    def set_matrices(self, handles: ArrayLike, matrices: ArrayLike) -> None:
        """Rigid 4 x 4 matrices rest -> posed, (k, 4, 4) in the usual row-by-row reading."""
        rows = converted(matrices, "matrices", "f8")
        require(rows.size % 16 == 0, "matrices must have the shape (k, 4, 4), not {}", rows.shape)
        super().set_matrices(handles, rows.reshape(-1, 4, 4).transpose(0, 2, 1))
