"""The pose that a mesh shows already. A session that is made anew, after an edit or in a file that was opened, goes on from it.

Where free handles stand does not tell the pose: solved from rest, a hand that was pulled a long way can end half a turn off.
So each carrier keeps the whole motion that its handle had in the last pose (PLACED), and a new session begins with these
motions. What is then left to the shown shape is added to the pose. It goes as handles move, as a crossfade of the library does.
"""

import math

import numpy as np
from mathutils import Quaternion

from . import carriers

PLACED = carriers.PLACED
# The shape that was shown is gone when a handle has moved this share of the box, and TURN_SHARE of the box counts as one
# radian: as crossfade_reach and crossfade_turn of the library, where the trade is measured.
REACH, TURN_SHARE = 0.05, 0.25
# Iterations of the first solve, which has no drag before it: it then differs from the shown arm of a mannequin by 0.3 to 1.5 mm.
# Half of it is as near, with 10 it is 10 mm; double changes nothing.
SETTLING = 50
# A handle that goes this share of the box, or turns so far in radians, between two solves has jumped: a drag moves less in an
# event.
JUMP, TURN_JUMP = 0.01, 0.1


def motion_found(pose, number, matrix):
    """The motion of a handle in the last pose: its middle goes where the matrix puts it, the rotation is that of the pose."""
    info = pose.handle(number)
    x, y, z, w = info.rotation
    out, middle = np.eye(4), np.array(info.centroid)
    out[:3, :3] = np.array(Quaternion((w, x, y, z)).to_matrix())
    out[:3, 3] = (matrix @ np.append(middle, 1))[:3] - out[:3, :3] @ middle
    return out


def keep(session, found, given, sent):
    """Writes the motion of each handle into its carrier, and the one that the carrier gave. Undo, a copy and a saved file take
    them along."""
    for (i, carrier), matrix, motion in zip(found.items(), given, sent):
        motion = motion_found(session.pose, session.numbers[i], motion) if i in session.free else motion
        carrier[PLACED] = [*motion.ravel().tolist(), *matrix.ravel().tolist()]


def start(session, obj, shown, stays=True):
    """Poses a session as its mesh shows it, with the handles that were in that pose. Returns what is left, a Standing, or None
    where the carriers do not tell the pose. stays: False: a handle of that pose is gone, so the shape is not to stay."""
    found = session.sync(obj, posed=True)
    if not found:
        return None
    both = {i: np.array(carrier[PLACED]).reshape(2, 4, 4) for i, carrier in found.items()}
    session.set_limbs(found)
    session.pose.set_matrices([session.numbers[i] for i in found], np.array([motion for motion, _ in both.values()]))
    session.pose.deform(session.posed, iteration_count=SETTLING)
    session.free = {i for i, carrier in found.items() if carrier.get(carriers.FREE)}
    if session.free:  # the rotation that was found is where the next solve begins
        session.pose.set_free_rotations([session.numbers[i] for i in found if i in session.free], True)
    standing = Standing(session, both)
    session.pose.set_matrices([session.numbers[i] for i in found], standing.shifted(standing.given, 1, session.free))
    session.pose.deform(session.posed, info=session.info, refine=session.steps())
    standing.offset = shown.astype(np.float64) - session.posed
    standing.offset[slice(None) if not stays else session.painted] = 0  # new pins hold at their rest places
    session.posed[:] = session.posed + standing.offset
    session.placed, session.told = dict(standing.given), session.conditions(found)
    return standing


class Standing:
    """How far the shown shape is from the pose, and where the handles stood then."""

    def __init__(self, session, both):
        """both: by id, the motion of a handle in the pose, and the motion that its carrier gave."""
        self.offset = None  # by vertex, of the shown shape from the pose
        self.middles = {i: np.append(session.pose.handle(session.numbers[i]).centroid, 1) for i in both}
        self.diagonal = session.surface.report.bounding_box_diagonal or 1.0
        self.given, self.rest = {i: given for i, (_, given) in both.items()}, dict.fromkeys(both, np.eye(4))
        # an edit that changes a region changes its middle, and a free handle is told where its middle goes
        self.shift = {i: ((motion - given) @ self.middles[i])[:3] for i, (motion, given) in both.items() if i in session.free}
        self.from_rest = self.way(self.rest, self.given, session.free)

    def way(self, before, now, free):
        """The largest way of a handle, in boxes. The rotation of a free one does not count."""
        out = 0.0
        for i in before.keys() & now.keys():
            way = np.linalg.norm(((now[i] - before[i]) @ self.middles[i])[:3]) / self.diagonal
            chord = 0 if i in free else np.linalg.norm((now[i] - before[i])[:3, :3]) / math.sqrt(8)
            out = max(out, way + TURN_SHARE * 2 * math.asin(min(chord, 1)))
        return out

    def share(self, now, free):
        """The share of the difference that is still shown. It goes on the way to rest too, so that rest is the rest shape."""
        left = max(0.0, 1 - self.way(self.given, now, free) / REACH)
        return left * left * (min(1.0, self.way(self.rest, now, free) / self.from_rest) if self.from_rest > 0 else 1.0)

    def shifted(self, now, share, free):
        """The motions to pose with, in the order of now."""
        out = np.array(list(now.values()))
        for matrix, i in zip(out, now):
            if i in free and i in self.shift:
                matrix[:3, 3] += share * self.shift[i]
        return out
