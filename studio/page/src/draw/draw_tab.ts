// The tab Draw.
import { el } from "../dom";
import type { Studio, Tab } from "../tab";

export function createDrawTab(_studio: Studio): Tab {
  return { id: "draw", title: "Draw", element: el("div", {}, "Draw"), show: () => undefined, hide: () => undefined };
}
