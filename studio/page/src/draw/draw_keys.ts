// Keys of the tab Draw.
import type { Mode, SessionState } from "../api_types";
import { toolsOf, type ToolName } from "./tools";

export interface KeyHost {
  readonly gestures: boolean;
  setMode(mode: Mode): void;
  setTool(tool: ToolName): void;
  setPanning(on: boolean): void;
  zoom(factor: number): void;
  fit(): void;
  flipMirror(): void;
  /** True if the key turns the face on the paper. */
  turn(event: KeyboardEvent): boolean;
}

const kZoom = 1.25;

/** Does what a key means in the mode of a drawing; false: it means nothing. */
export function pressKey(event: KeyboardEvent, state: SessionState, host: KeyHost): boolean {
  // Space on a button presses the button.
  if (event.key === " " && !(event.target instanceof HTMLButtonElement)) {
    host.setPanning(true);
    return true;
  }
  if (state.mode === "refine" && host.turn(event)) return true;
  const key = event.key.toLowerCase();
  const actions: Record<string, () => void> = {
    "1": () => host.setMode("draw"),
    "2": () => host.setMode("follow_up"),
    "3": () => host.setMode("refine"),
    "+": () => host.zoom(kZoom),
    "=": () => host.zoom(kZoom),
    "-": () => host.zoom(1 / kZoom),
    "0": () => host.fit(),
  };
  if (state.mode !== "refine") actions["m"] = () => host.flipMirror();
  for (const tool of toolsOf(state.mode, host.gestures)) actions[tool.key.toLowerCase()] = () => host.setTool(tool.name);
  const act = actions[key];
  act?.();
  return act !== undefined;
}
