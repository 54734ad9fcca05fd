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

/**
 * Brings the body that is open to settings of it. Answers with the tools that did not take theirs, each with the reason: they are
 * as from the start. Throws when the state itself is refused.
 */
export async function adoptSettings(app, settings) {
  const refused = [];
  await app.take(settings.state);
  const { timeline, view } = app;
  [view.turn, view.lift] = settings.view;
  if (settings.clip !== undefined && settings.clip !== timeline.clips.indexOf(timeline.clip)) {
    timeline.clip = timeline.clips[settings.clip] ?? null;
    timeline.draw();
  }
  for (const [key, own] of Object.entries(settings.tools ?? {})) {
    if (!app.tools[key] && !app.later[key]) continue; // of another version of the studio
    try {
      const tool = await app.need(key);
      await tool.adopt?.(own);
    } catch (error) {
      refused.push(`${key}: ${error.message}`);
    }
  }
  if (app.tools[settings.tool] || app.later[settings.tool]) await app.use(settings.tool);
  app.frame();
  if (settings.eye) {
    view.framed = null;
    [view.distance] = settings.eye;
    view.target.fromArray(settings.eye, 1);
  }
  app.refresh();
  return refused;
}
