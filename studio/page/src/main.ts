// Starts the page: the token, the head, the tabs.
import { Api, takeToken } from "./api";
import { createAvatarTab } from "./avatar/avatar_tab";
import { CollectPage } from "./collect/collect_page";
import { el } from "./dom";
import { createDrawTab } from "./draw/draw_tab";
import { createShapeTab } from "./shape/shape_tab";
import { StudioPage } from "./studio";
import { StudyPage } from "./study/study_page";
import type { Tab } from "./tab";
import { createTakeAwayTab } from "./take_away/take_away_tab";

async function start(root: HTMLElement): Promise<void> {
  const api = new Api(takeToken());
  const { mode, sheet } = await api.info();
  if (mode === "collect" || mode === "study") {
    const other = mode === "collect" ? new CollectPage(api, sheet?.[0] ?? 512) : new StudyPage(api);
    root.replaceChildren(other.page.element);
    return other.start();
  }
  const studio = new StudioPage(api);
  const head = Promise.all([studio.api.head(), studio.api.triangles()]);
  for (const create of [createDrawTab, createShapeTab, createAvatarTab, createTakeAwayTab]) studio.add(create(studio));
  root.replaceChildren(studio.element);
  studio.open(studio.recall<Tab["id"]>("tab", "draw"));
  studio.faces.refresh().catch((error) => studio.fail(error));
  studio.viewer.setHead(...(await head));
}

const root = document.getElementById("studio");
if (root) {
  start(root).catch((error: unknown) => {
    console.error(error);
    const message = error instanceof Error ? error.message : String(error);
    root.replaceChildren(el("div", { class: "stopped", role: "alert" }, el("h1", {}, "The studio cannot start"), el("p", {}, message)));
  });
}
