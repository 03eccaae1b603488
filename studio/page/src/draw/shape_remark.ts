// What Draw says of a drawing that Shape has changed: its face here is without those changes.
import type { Shape } from "../api_types";
import type { HistoryState } from "../history";
import { isPlain } from "../shape/document";
import type { Studio } from "../tab";

export function remarkShape(studio: Studio, session: string): void {
  const shape = studio.recall<HistoryState<Shape> | null>("shape.history", null)?.present;
  if (shape?.base !== session || isPlain(shape)) studio.viewer.remark(null);
  else studio.viewer.remark({ text: "Without the changes of Shape.", label: "Show them", act: () => studio.open("shape") });
}
