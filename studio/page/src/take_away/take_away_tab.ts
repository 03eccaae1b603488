// The tab Take away.
import { el } from "../dom";
import type { Studio, Tab } from "../tab";

export function createTakeAwayTab(_studio: Studio): Tab {
  return { id: "take-away", title: "Take away", element: el("div", {}, "Take away"), show: () => undefined, hide: () => undefined };
}
