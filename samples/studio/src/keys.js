// Keys: the transforms of the handles at times. Between two keys translations go along lines and rotations along arcs.
import { Quaternion } from 'three';

/** Two keys are one when they are nearer than this part of the length: two steps of the slider, one frame of a clip of four seconds. */
const SAME = 1 / 120;
const rest = { rotation: [0, 0, 0, 1], translation: [0, 0, 0] };

export const keyNear = (keys, time, length) => keys.find((key) => Math.abs(key.time - time) < SAME * length) ?? null;

/** The keys with one more, or with the one at that time replaced. Sorted by time. */
export function withKey(keys, time, length, handles) {
  const old = keyNear(keys, time, length);
  const transforms = Object.fromEntries(
    handles.map(({ id, rotation, translation }) => [id, { rotation, translation }]),
  );
  const key = { time: old?.time ?? time, transforms };
  return [...keys.filter((other) => other !== old), key].sort((a, b) => a.time - b.time);
}

/** The handles at a time. A handle that a key does not know is at rest there; no keys: as they are. */
export function blended(handles, keys, time) {
  if (!keys.length) return handles;
  const after = keys.findIndex((key) => key.time > time);
  const [a, b] = after < 0 ? [keys.at(-1), keys.at(-1)] : [keys[Math.max(0, after - 1)], keys[after]];
  const t = b.time > a.time ? Math.max(0, (time - a.time) / (b.time - a.time)) : 0;
  return handles.map((handle) => {
    const [from, to] = [a.transforms[handle.id] ?? rest, b.transforms[handle.id] ?? rest];
    return {
      ...handle,
      translation: from.translation.map((x, k) => x + t * (to.translation[k] - x)),
      rotation: new Quaternion(...from.rotation).slerp(new Quaternion(...to.rotation), t).toArray(),
    };
  });
}
