// The tab Shape.
import { el } from "../dom";
import type { Studio, Tab } from "../tab";

export function createShapeTab(_studio: Studio): Tab {
  return { id: "shape", title: "Shape", element: el("div", {}, "Shape"), show: () => undefined, hide: () => undefined };
}
