// Pictures of the stages of an avatar, as a strip; a press shows one large.
import type { Api } from "../api";
import type { Job } from "../api_types";
import { el } from "../dom";
import { button } from "../widgets";

export class StagesStrip {
  readonly element = el("div", { class: "p-stages", role: "group", "aria-label": "Stages of this head", hidden: true });
  private addresses: string[] = [];

  constructor(private readonly api: Api) {}

  get isEmpty(): boolean {
    return this.element.childElementCount === 0;
  }

  async show(job: Job): Promise<void> {
    this.clear();
    const files = job.files.filter((file) => /^(stages\/.*|head)\.(png|jpg)$/i.test(file.name)).sort((a, b) => rank(a.name).localeCompare(rank(b.name)));
    this.element.hidden = files.length === 0;
    for (const file of files) {
      const title = stageTitle(file.name);
      const picture = el("img", { alt: "", width: 84, height: 84 });
      this.element.append(el("button", { type: "button", class: "p-stage", onclick: () => this.enlarge(picture.src, title) }, picture, el("span", {}, title)));
      const address = URL.createObjectURL(await this.api.jobFile(job.id, file.name));
      this.addresses.push(address);
      picture.src = address;
    }
  }
  clear(): void {
    for (const address of this.addresses) URL.revokeObjectURL(address);
    this.addresses = [];
    this.element.replaceChildren();
    this.element.hidden = true;
  }

  private enlarge(address: string, title: string): void {
    const dialog = el("dialog", { class: "p-large", "aria-label": title, onclose: () => dialog.remove() });
    dialog.append(
      el("div", { class: "p-row p-spread" }, el("h2", {}, title), button("Close", () => dialog.close())),
      el("img", { src: address, alt: title }),
    );
    dialog.addEventListener("click", (event) => {
      if (event.target === dialog) dialog.close();
    });
    document.body.append(dialog);
    dialog.showModal();
  }
}

/** The sheet of the whole head comes last. */
function rank(name: string): string {
  return name.includes("/") ? `0${name}` : `1${name}`;
}

/** "stages/02_landmarks.png" -> "Landmarks". */
export function stageTitle(name: string): string {
  if (!name.includes("/")) return "Head, all views";
  const words = (name.split("/").at(-1) ?? name).replace(/\.\w+$/, "").replace(/^\d+_/, "").replaceAll("_", " ");
  return words.charAt(0).toUpperCase() + words.slice(1);
}
