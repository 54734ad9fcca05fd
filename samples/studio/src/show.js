// The picture of a state: the Worker is asked for the shape and the field, and the answers are shown.

/** Brings the picture to a state: only what changed is asked for. way: of the pose, see worker_pose.js. */
export async function show(app, state, way) {
  const { skin } = app;
  const exact = way === 'exact';
  const shown = app.shownState;
  app.shownState = state;
  const wanted = [];
  const moving = app.moving && way !== 'follow';
  const { handles, lengths, detail, stiffness } = state;
  const same = ['handles', 'lengths', 'detail'].every((part) => shown?.[part] === state[part]);
  const stroke = shown?.stiffness !== stiffness;
  if (stroke && way === 'follow') app.moving = true;
  // a stroke does not move a body at rest: its pose follows when the stroke ends
  if (exact || moving || !same || (stroke && (way !== 'follow' || app.tools.pose.posed(handles)))) {
    app.moving = way === 'follow';
    wanted.push(
      app.client.frame('shape', { handles, lengths, detail, stiffness, way }).then((answer) => {
        if (!answer || app.skin !== skin) return;
        app.shape = { positions: answer.positions, normals: answer.normals };
        app.told = answer.told;
        for (const { id, centroid, rotation } of answer.told.handles) {
          app.centres.set(id, centroid);
          app.turns.set(id, Array.from(rotation));
        }
        ++app.figures.frames;
        app.figures.shape = answer.told.milliseconds;
        app.timeline.show();
        app.tool?.shaped?.();
        app.marksLayer.update();
      }),
    );
  }
  if (state.sites.length && (exact || stroke || shown?.sites !== state.sites))
    wanted.push(
      app.client.frame('field', { sites: state.sites, stiffness, at: exact }).then((answer) => {
        if (!answer || app.skin !== skin) return;
        app.fieldTold = answer.told;
        app.figures.field = answer.told.milliseconds;
        skin.setField(answer.values, answer.reached);
      }),
    );
  if (stroke && !wanted.length) wanted.push(app.client.frame('stiffen', { stiffness }));
  try {
    await Promise.all(wanted);
  } catch (error) {
    app.shownState = null;
    throw error;
  }
}
