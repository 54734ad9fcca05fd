// A film of six seconds (webm): what plays is filmed; a body that stands still is turned once. Loaded when it is asked for.

export const SECONDS = 6;
/** Pictures and bits a second, of films in a page: 4.5 MB for six seconds. */
const [RATE, BITS] = [30, 6e6];
/** The last picture gets so many milliseconds to reach the file. */
const LAST_MS = 1000;

/** Films the stage. Returns a webm file. */
export async function film(app) {
  const { view, timeline, tools } = app;
  const { say } = app.ui;
  if (!window.MediaRecorder?.isTypeSupported('video/webm')) throw new Error('This browser cannot write webm films. Open the studio in Chrome, Edge or Firefox.');
  const { canvas } = view;
  // the ground of the stage belongs to the page: the film gets it too
  const sheet = document.createElement('canvas');
  [sheet.width, sheet.height] = [canvas.width & ~1, canvas.height & ~1];
  const paint = sheet.getContext('2d', { alpha: false });
  const style = getComputedStyle(document.documentElement);
  const ground = paint.createLinearGradient(0, 0, 0, sheet.height);
  ground.addColorStop(0, style.getPropertyValue('--stage-top'));
  ground.addColorStop(1, style.getPropertyValue('--stage-low'));
  const copy = () => {
    paint.fillStyle = ground;
    paint.fillRect(0, 0, sheet.width, sheet.height);
    paint.drawImage(canvas, 0, 0);
  };

  const walking = app.tool === tools.transfer && tools.transfer.ready();
  const tested = app.tool === tools.weights && tools.weights.bend.clip;
  const moving = tested || walking || (app.tool === tools.pose && (timeline.clip || timeline.keys.length > 1));
  const turn = view.turn;
  if (walking) tools.transfer.play();
  else if (moving && !tested) timeline.play();
  // every picture is handed over: a busy machine must not leave the last seconds out
  const stream = sheet.captureStream(0);
  const [track] = stream.getVideoTracks();
  const recorder = new MediaRecorder(stream, { mimeType: 'video/webm', videoBitsPerSecond: BITS });
  const pieces = [];
  recorder.ondataavailable = ({ data }) => data.size && pieces.push(data);
  const ended = new Promise((resolve, reject) => {
    recorder.onstop = resolve;
    recorder.onerror = ({ error }) => reject(error ?? new Error('The film was not written. Try again.'));
  });
  const hand = () => (copy(), track.requestFrame());
  copy();
  const started = new Promise((resolve) => (recorder.onstart = resolve));
  recorder.start();
  await started;
  let begin = null; // of the first picture: a busy machine may draw it late
  let handed = -Infinity;
  await new Promise((resolve) => {
    const step = () => {
      const now = performance.now();
      begin ??= now;
      const time = (now - begin) / 1000;
      if (!moving) {
        view.turn = turn + (2 * Math.PI * Math.min(time, SECONDS)) / SECONDS;
        view.drawNow();
      }
      if (now - handed >= 900 / RATE || time >= SECONDS) {
        hand();
        handed = now;
      }
      say(`filming: ${Math.max(0, SECONDS - time).toFixed(0)} s`);
      time < SECONDS ? requestAnimationFrame(step) : resolve();
    };
    requestAnimationFrame(step);
  });
  await new Promise((resolve) => setTimeout(resolve, LAST_MS));
  recorder.stop();
  await ended;
  track.stop();
  view.turn = turn;
  if (walking) await tools.transfer.stop();
  else if (moving && !tested) timeline.begin();
  view.draw();
  return new Blob(pieces, { type: 'video/webm' });
}
