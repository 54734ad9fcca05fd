// All that the user has set: the state, what each tool keeps beside it, the clip and the view. Links and sessions hold it.

export function settingsOf(app) {
  const { history, body, tool, view, timeline } = app;
  const tools = Object.entries(app.tools).flatMap(([key, one]) => (one.settings ? [[key, one.settings()]] : []));
  return {
    name: body.name,
    vertexCount: body.vertexCount,
    state: history.state,
    tool: tool.constructor.key,
    tools: Object.fromEntries(tools),
    clip: timeline.clips.indexOf(timeline.clip),
    view: [view.turn, view.lift],
    eye: view.framed ? null : [view.distance, ...view.target.toArray()],
  };
}

/** Brings the body that is open to settings of it. */
export async function adoptSettings(app, settings) {
  await app.take(settings.state);
  const { timeline, view } = app;
  [view.turn, view.lift] = settings.view;
  if (settings.clip !== undefined && settings.clip !== timeline.clips.indexOf(timeline.clip)) {
    timeline.clip = timeline.clips[settings.clip] ?? null;
    timeline.draw();
  }
  // what a tool does not take it has as from the start
  for (const [key, own] of Object.entries(settings.tools ?? {}))
    await app
      .need(key)
      .then((one) => one.adopt?.(own))
      .catch(() => {});
  if (app.tools[settings.tool] || app.later[settings.tool]) await app.use(settings.tool);
  app.frame();
  if (settings.eye) {
    view.framed = null;
    [view.distance] = settings.eye;
    view.target.fromArray(settings.eye, 1);
  }
  app.refresh();
}
