// Releasing all handles of refinement mode.
import type { View } from "../api_types";
import type { SessionClient } from "./session_client";

/** Sheet pixels, around the middle of the sheet: all of a face. */
const kAll = 2000;
/** A brush reaches what a view sees. */
const kViews: readonly View[] = [[0, 0], [90, 0], [-90, 0], [180, 0], [0, 60], [0, -60]];

export async function clearHandles(session: SessionClient): Promise<void> {
  let state = session.state;
  for (const view of kViews) {
    if (!state || state.handles.length === 0) return;
    const middle: [number, number] = [state.sheet[0] / 2, state.sheet[1] / 2];
    state = await session.send({ do: "unbrush", points: [middle], radius: kAll, view });
  }
}
