// Modes and tools of the tab Draw, with their words.
import type { IconName } from "../icons";
import type { Mode, SessionState } from "../api_types";

export type ToolName = "pen" | "eraser" | "turn" | "region" | "brush" | "unbrush" | "translate" | "pull" | "gesture";

export interface Tool {
  name: ToolName;
  icon: IconName;
  label: string;
  /** Below the icon. */
  word: string;
  key: string;
}

export const kModes: readonly { mode: Mode; label: string; key: string; about: string }[] = [
  { mode: "draw", label: "Sketch", key: "1", about: "Draw a face with a few lines" },
  { mode: "follow_up", label: "Redraw", key: "2", about: "Erase a line of the face and draw it again" },
  { mode: "refine", label: "Sculpt", key: "3", about: "Turn the face and move its surface" },
];

const kPen: Tool = { name: "pen", icon: "pen", label: "Pen", word: "Pen", key: "B" };
const kEraser: Tool = { name: "eraser", icon: "eraser", label: "Eraser", word: "Eraser", key: "E" };

export function toolsOf(mode: Mode, gestures: boolean): readonly Tool[] {
  if (mode !== "refine") return [kPen, kEraser];
  const tools: Tool[] = [
    { name: "turn", icon: "turn", label: "Turn the face", word: "Turn", key: "T" },
    { name: "brush", icon: "brush", label: "Brush handles", word: "Brush", key: "B" },
    { name: "unbrush", icon: "unbrush", label: "Release handles", word: "Release", key: "E" },
    { name: "translate", icon: "move", label: "Move handles", word: "Move", key: "V" },
    { name: "pull", icon: "pull", label: "Pull an outline", word: "Pull", key: "P" },
    { name: "region", icon: "lasso", label: "Enclose a region", word: "Region", key: "R" },
  ];
  if (gestures) tools.push({ name: "gesture", icon: "gesture", label: "Free gesture", word: "Gesture", key: "G" });
  return tools;
}

/** The tool that a person needs first in a mode. */
export function firstTool(state: SessionState): ToolName {
  if (state.mode === "draw") return "pen";
  if (state.mode === "refine") return "brush";
  return state.open_ends.length > 0 ? "pen" : "eraser";
}

/** What a person draws first, and what may follow; both eyes are one thing to draw. */
const kNeeded = ["the outline", "both eyes", "the nose", "the mouth"];
const kWelcome = ["brows", "ears"];
const kIsTouch = matchMedia("(hover: none)").matches;

/** A tablet has no keys. */
export function withoutKeys(text: string): string {
  return kIsTouch ? text.replace(/ \((?:[A-Z]|Ctrl\+Z)\)/g, "") : text;
}

/** What a person can do now, in one or two sentences. erased: lines of the face wait to be drawn again. */
export function hintOf(state: SessionState, tool: ToolName, erased: boolean): string {
  if (state.mode === "draw") {
    if (tool === "eraser") return "Rub over lines to cut them.";
    if (state.lines.length === 0)
      return "Draw the outline of a face, then eyes, nose and mouth. The face on the right follows every stroke.";
    if (!state.has_face) return "These lines are no face yet. Add the outline, eyes, nose or mouth.";
    const missing = kNeeded.filter((part) => !isDrawn(part, state.drawn_parts));
    if (missing.length > 0) return `Still missing: ${listOf(missing)}. In any order.`;
    const welcome = kWelcome.filter((part) => !isDrawn(part, state.drawn_parts));
    const more = welcome.length > 0 ? `You may add ${welcome.join(" and ")}. ` : "All parts are there. ";
    return `${more}Redraw corrects single lines: yours then become the lines of the face, until you undo it.`;
  }
  if (state.mode === "follow_up") {
    const gaps = state.open_ends.length;
    if (tool === "eraser")
      return gaps > 0 || erased
        ? "Erase more, or take the pen (B) and draw the new line from dot to dot."
        : "Rub over the part of a line that you want to change. Then draw its new path.";
    return gaps > 0
      ? "Draw from one orange dot to the other, or a whole eye as one closed line. The eraser (E) takes more."
      : erased
        ? "Draw the erased line again, near its old place."
        : "A stroke on the skin becomes a wrinkle. To change a line, erase it first (E).";
  }
  const handles = state.handles.length;
  switch (tool) {
    case "turn":
      return "Drag to turn the face, or choose a side. The arrow keys turn it, too.";
    case "brush":
      return handles > 0
        ? "Paint more, move the blue handles (V), or bulge them with the buttons at the side."
        : "Paint over the skin that you want to move.";
    case "unbrush":
      return "Paint over handles to release them.";
    case "translate":
      return handles > 0 ? "Drag: the handles move as far as the pen does." : "There are no handles. Paint some with the brush (B) first.";
    case "pull":
      return "Draw a new outline close to the old one: jaw, cheek, or the profile in a side view. The old one moves to it.";
    case "region":
      return "Draw a closed line: only what lies inside moves. Undo frees the whole head again.";
    default:
      return "Closed line: region. Straight line: move or pull. Arrow left or right: undo or redo. Loops that rise or fall: bulge or hollow.";
  }
}

function isDrawn(part: string, drawn: readonly string[]): boolean {
  return part === "both eyes" ? drawn.includes("right eye") && drawn.includes("left eye") : drawn.includes(part.replace("the ", ""));
}
/** "both eyes, the nose and the mouth". */
function listOf(parts: readonly string[]): string {
  return parts.length === 1 ? (parts[0] ?? "") : `${parts.slice(0, -1).join(", ")} and ${parts.at(-1)}`;
}

/** Tools that act on the handles: with others these are hidden. */
export function usesHandles(tool: ToolName): boolean {
  return tool !== "pull" && tool !== "region";
}

/** The cursor over the paper: a class of draw.css. */
export function cursorOf(tool: ToolName): string {
  if (tool === "turn") return "grab";
  if (tool === "eraser" || tool === "brush" || tool === "unbrush") return "none";
  return tool === "translate" ? "move" : "crosshair";
}

/** What the server has recognised in a free gesture, in words. */
export function gestureWords(gesture: string): string {
  const roll = /^(up|down)_roll_(\d)$/.exec(gesture);
  if (roll) return roll[1] === "up" ? `Bulged, level ${roll[2]} of 3.` : `Hollowed, level ${roll[2]} of 3.`;
  const words: Record<string, string> = {
    line: "A line: handles are moved, or the nearest outline is pulled.",
    region: "A region: only what it encloses moves.",
    left_arrow: "An arrow to the left: undo.",
    right_arrow: "An arrow to the right: redo.",
    none: "No gesture was recognised. Try a closed line, a straight line, an arrow, or loops.",
  };
  return words[gesture] ?? `Understood: ${gesture}.`;
}
