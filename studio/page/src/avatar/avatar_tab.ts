// The tab Avatar.
import { el } from "../dom";
import type { Studio, Tab } from "../tab";

export function createAvatarTab(_studio: Studio): Tab {
  return { id: "avatar", title: "Avatar", element: el("div", {}, "Avatar"), show: () => undefined, hide: () => undefined };
}
