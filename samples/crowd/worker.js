// Poses a share of the creatures. The first message has the body and answers with rows; others have a time and answer with
// the transforms of all clusters of the share.
import { apiOf } from './hf/wasm.js';
import factory from './hf_module.js';

let poses, tips, first, size;

async function start(message) {
  const answer = await fetch('hf.wasm');
  if (!answer.ok) throw new Error(`hf.wasm could not be loaded (${answer.status}).`);
  const hf = await apiOf(factory, await answer.arrayBuffer());
  const surface = new hf.Surface(message.positions, message.triangles);
  // fewer groups and bands than usual: a frame is cheaper, and a clone smaller
  const pose = new hf.Pose(surface, { groupCount: 60, bandCount: 5 });
  tips = [];
  for (const place of surface.proposeHandles()) {
    const handle = pose.addHandleAt(place.position, place.radius);
    if (place.pinned) continue;
    pose.setFreeRotations([handle], true); // the solve turns a head as it is pulled
    pose.setFollowing([handle], place.following);
    tips.push({ handle, reach: 0.25 * place.length });
  }
  pose.solve();
  const rows = pose.blendRows();
  const { clusterCount, centre } = pose.blendInfo;
  first = message.first;
  size = 12 * clusterCount;
  poses = Array.from({ length: message.count }, () => pose.clone()); // clones share fields and factors
  return { rows, clusterCount, centre };
}

function frame({ seconds, fresh }) {
  const begin = performance.now();
  const transforms = new Float32Array(size * poses.length);
  poses.forEach((pose, i) => {
    tips.forEach(({ handle, reach }, t) => {
      const turn = (2 + ((first + i) % 7) / 5) * seconds + 2.4 * (first + i) + t; // own speed and phase
      pose.setTransform(handle, { translation: [reach * Math.sin(turn), 0.5 * reach * Math.sin(0.7 * turn), 0] });
    });
    pose.solve(fresh ? 10 : 1, fresh); // a frame goes on from the last one, so one iteration will do
    transforms.set(pose.blendTransforms(), size * i);
  });
  return { transforms, milliseconds: performance.now() - begin };
}

onmessage = async ({ data }) => {
  try {
    const answer = data.positions ? await start(data) : frame(data);
    postMessage(answer, answer.transforms ? [answer.transforms.buffer] : []);
  } catch (error) {
    postMessage({ error: error.message });
  }
};
