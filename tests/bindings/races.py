"""races.py: threads that make, use, close and drop the same objects while the collector runs. Only the library's
own errors may come out, and none of them HF_ERROR_INTERNAL; a crash ends the program. 4,000 calls, 100,000 with HF_FULL_TESTS."""

import faulthandler
import gc
import os
import random
import sys
import threading

import numpy as np

import golden
import hf

THREADS = 4
mesh = golden.load_meshes()["bar"]
POSITIONS = np.array(mesh["positions"], np.float64).reshape(-1, 3)
TRIANGLES = np.array(mesh["triangles"], np.uint32).reshape(-1, 3)
N = len(POSITIONS)


class Race:
    def __init__(self, calls):
        self.slots = [None] * 12
        self.surfaces = [hf.Surface(POSITIONS, TRIANGLES) for _ in range(2)]
        self.refused, self.unexpected = {}, []
        self.left = [calls // THREADS] * THREADS

    def make(self, draw):
        surface = self.surfaces[draw.randrange(2)]
        kind = draw.randrange(8)
        if kind == 0:
            self.surfaces[draw.randrange(2)] = hf.Surface(POSITIONS, TRIANGLES)  # what stands on the old one goes on
        thing = (hf.Solver, hf.Solver, hf.Solver, hf.Pose, hf.Geodesics, hf.Region, hf.Direction, hf.Flow)[kind](surface)
        if kind == 3:
            thing.add_handles([range(12), range(N - 12, N)])
        if draw.random() < 0.3:
            thing.itself = thing  # a cycle: only the collector finds it
        return thing

    def use(self, draw, thing):
        kind = type(thing)
        if kind is hf.Solver:
            return draw.choice((lambda: thing.add_sites([draw.randrange(N)], [1.0]), lambda: thing.solve(),
                                lambda: thing.remove_sites([0]), lambda: thing.clone().solve(), lambda: thing.record(),
                                lambda: thing.undo(), lambda: thing.sites(), lambda: thing.site_count))()
        return {hf.Pose: thing.deform if kind is hf.Pose else None,
                hf.Geodesics: (lambda: thing.solve([0])), hf.Region: (lambda: thing.edit(add_vertices=[draw.randrange(N)])),
                hf.Direction: (lambda: thing.add_sites([0], [[1, 0, 0]])),
                hf.Flow: (lambda: thing.trace(POSITIONS[:, 1].copy(), wanted_count=2))}[kind]()

    def step(self, draw):
        at, action = draw.randrange(len(self.slots)), draw.random()
        thing = self.slots[at]
        if thing is None or action < 0.1:
            self.slots[at] = self.make(draw)  # drops what stood there
        elif action < 0.2:
            thing.close()
        elif action < 0.201:
            gc.collect()
        else:
            self.use(draw, thing)

    def run(self, number):
        draw = random.Random(number)
        for _ in range(self.left[number]):
            try:
                self.step(draw)
            except hf.InternalError as error:
                self.unexpected.append(repr(error))
            except hf.HfError as error:
                self.refused[error.name] = self.refused.get(error.name, 0) + 1
            except Exception as error:  # noqa: BLE001
                self.unexpected.append(repr(error))


def main():
    calls = 100000 if os.environ.get("HF_FULL_TESTS") else 4000
    faulthandler.enable()
    sys.setswitchinterval(1e-5)
    gc.set_threshold(50, 5, 5)
    race = Race(calls)
    threads = [threading.Thread(target=race.run, args=(i,)) for i in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    print(f"{calls} calls of {THREADS} threads; refused: {dict(sorted(race.refused.items()))}")
    assert not race.unexpected, race.unexpected[:5]
    assert race.refused.get("HF_ERROR_INVALID_OBJECT"), "nothing was ever used after it was closed"
    solver = hf.Solver(hf.Surface(POSITIONS, TRIANGLES))
    solver.add_sites([0, N - 1], [0.0, 1.0])
    assert np.isfinite(solver.solve()).all()


if __name__ == "__main__":
    main()
