// What a person sees before a drawing: examples, ways to begin, earlier drawings.
import type { Api } from "../api";
import type { Example, SessionEntry } from "../api_types";
import { button, el, iconButton } from "../dom";
import { iconOf } from "../icons";

export interface StartHost {
  readonly api: Api;
  begin(options: { begin: string; name?: string; example?: string }): void;
  openSession(id: string): void;
  /** The session was deleted or renamed. */
  changed(id: string, name: string | null): void;
  close(): void;
  /** The screen has come or gone. */
  shown(is: boolean): void;
  fail(error: unknown): void;
}

/** Doodle and words of an example by its name; others have the words of the server. */
const kExamples: Readonly<Record<string, { title: string; doodle: string }>> = {
  front: {
    title: "A portrait, drawn and corrected",
    doodle:
      "M20 34c0 20 8 34 20 34s20-14 20-34S52 12 40 12 20 20 20 34M28 36c3-3 6-3 9 0M43 36c3-3 6-3 9 0M39 40c-1 5-3 8-2 9s4 1 5 0M33 57c4 3 10 3 14 0",
  },
  side: {
    title: "A profile, pulled in 3-D",
    doodle:
      "M46 12c-14 0-20 9-20 18 0 4 1 6 0 9l-6 9c0 2 5 1 5 3l-1 4c3 2 0 3 1 5 1 4 5 4 10 3 2 3 2 6 2 9M33 32c3-2 5-2 7 0M52 40c4-3 7 0 6 4s-4 6-6 5",
  },
  wrinkles: {
    title: "Wrinkles of an old face",
    doodle:
      "M21 33c-1 21 9 36 19 36s20-15 19-36C58 18 50 12 40 12S22 18 21 33M28 38c3-3 6-3 9 0M43 38c3-3 6-3 9 0M39 41c-2 5-4 8-2 9s5 1 6 0M32 58c5 2 11 2 16 0M30 24c6-3 14-3 20 0M32 29c5-2 11-2 16 0M29 49c0 4 1 6 2 8M51 49c0 4-1 6-2 8",
  },
};
const kNumExamples = 3;

/** Counts the drawings that were numbered here: a number that was deleted comes back only as the last one. */
export function newName(sessions: readonly SessionEntry[]): string {
  return `Drawing ${1 + Math.max(0, ...sessions.map((session) => Number(/^Drawing (\d+)$/.exec(session.name)?.[1] ?? 0)))}`;
}

export class StartScreen {
  readonly element: HTMLElement;
  private readonly examples = el("div", { class: "start-examples" });
  private readonly sessions = el("ul", { class: "start-sessions" });
  private readonly earlier = el(
    "section",
    { class: "start-earlier", "aria-label": "Earlier drawings", hidden: true },
    el("h3", {}, "Earlier drawings"),
    this.sessions,
  );
  private readonly pinned = el("span", { hidden: true }, "or click a pinned face below");
  private nextName = newName([]);
  private readonly closeButton: HTMLButtonElement;

  constructor(private readonly host: StartHost) {
    this.closeButton = iconButton("close", "Back to the drawing", () => host.close(), "Escape");
    this.closeButton.classList.add("start-close");
    this.element = el(
      "div",
      { class: "start" },
      this.closeButton,
      el(
        "div",
        { class: "start-inner" },
        el("h2", {}, "Draw a face"),
        el(
          "p",
          { class: "start-lead" },
          "A few lines are enough: the 3-D face on the right follows every stroke. Try an example, or begin with an empty sheet.",
        ),
        this.examples,
        el(
          "div",
          { class: "start-begin" },
          button("Empty sheet", () => host.begin({ begin: "blank", name: this.nextName }), { class: "primary" }),
          button("An average face to redraw", () => host.begin({ begin: "mean", name: "From the average face" })),
          this.pinned,
        ),
        this.earlier,
      ),
    );
  }

  /** canClose: a drawing lies below. */
  async show(canClose: boolean): Promise<void> {
    this.element.hidden = false;
    this.host.shown(true);
    this.closeButton.hidden = !canClose;
    try {
      const { api } = this.host;
      const [examples, sessions, faces] = await Promise.all([api.examples(), api.sessions(), api.faces()]);
      this.pinned.hidden = faces.length === 0;
      this.showExamples(examples);
      this.showSessions(sessions);
    } catch (error) {
      this.host.fail(error);
    }
  }
  hide(): void {
    this.element.hidden = true;
    this.host.shown(false);
  }

  private showExamples(examples: readonly Example[]): void {
    const described = examples.filter((example) => example.name in kExamples);
    const shown = [...described, ...examples.filter((example) => !(example.name in kExamples))].slice(0, kNumExamples);
    this.examples.replaceChildren(
      ...shown.map((example) => {
        const { title, doodle } = kExamples[example.name] ?? { title: example.title, doodle: kExamples["front"]?.doodle ?? "" };
        return el(
          "button",
          {
            type: "button",
            class: "start-example",
            onclick: () => this.host.begin({ begin: "blank", example: example.name, name: title }),
          },
          drawing(doodle),
          el("span", {}, title),
        );
      }),
    );
  }
  private showSessions(sessions: readonly SessionEntry[]): void {
    this.nextName = newName(sessions);
    this.earlier.hidden = sessions.length === 0;
    this.sessions.replaceChildren(...sessions.map((session) => this.row(session)));
  }
  private row(session: SessionEntry): HTMLElement {
    const open = el(
      "button",
      { type: "button", class: "start-open", onclick: () => this.host.openSession(session.id) },
      iconOf("folder"),
      el("span", { class: "start-name" }, session.name),
      el("span", { class: "start-when" }, `${count(session.events)}, ${ago(session.changed)}`),
    );
    const row = el(
      "li",
      {},
      open,
      iconButton("rename", `Rename ${session.name}`, () => this.rename(session, row)),
      iconButton("trash", `Delete ${session.name}`, () => void this.remove(session)),
    );
    return row;
  }
  private rename(session: SessionEntry, row: HTMLElement): void {
    const field = el("input", { type: "text", value: session.name, "aria-label": "Name of the drawing", maxlength: 80 });
    const save = async () => {
      const name = field.value.trim();
      try {
        if (name !== "" && name !== session.name) {
          await this.host.api.renameSession(session.id, name);
          this.host.changed(session.id, name);
        }
        this.showSessions(await this.host.api.sessions());
      } catch (error) {
        this.host.fail(error);
      }
    };
    field.addEventListener("keydown", (event) => {
      if (event.key === "Enter") void save();
      if (event.key === "Escape") row.replaceWith(this.row(session));
    });
    row.replaceChildren(
      field,
      button("Save", () => void save()),
    );
    field.select();
  }
  private async remove(session: SessionEntry): Promise<void> {
    if (!confirm(`Delete the drawing "${session.name}"? This cannot be undone.`)) return;
    try {
      await this.host.api.deleteSession(session.id);
      this.host.changed(session.id, null);
      this.showSessions(await this.host.api.sessions());
    } catch (error) {
      this.host.fail(error);
    }
  }
}

function drawing(d: string): SVGSVGElement {
  const svg = iconOf("pen");
  svg.setAttribute("viewBox", "0 0 80 80");
  svg.firstElementChild?.setAttribute("d", d);
  return svg;
}
function count(events: number): string {
  return events === 1 ? "1 step" : `${events} steps`;
}
/** How long ago a time in seconds was. */
function ago(seconds: number): string {
  const minutes = Math.max(0, Date.now() / 1000 - seconds) / 60;
  if (minutes < 1) return "just now";
  const format = new Intl.RelativeTimeFormat("en", { numeric: "auto" });
  if (minutes < 60) return format.format(-Math.round(minutes), "minute");
  return minutes < 60 * 24 ? format.format(-Math.round(minutes / 60), "hour") : format.format(-Math.round(minutes / 60 / 24), "day");
}
