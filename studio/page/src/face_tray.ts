// The tray of pinned faces at the bottom of the page.
import type { Face } from "./api_types";
import type { FaceTray, Subject } from "./tab";
import type { Api } from "./api";
import { el, iconButton } from "./dom";
import { iconOf } from "./icons";

/** What the tray needs of the page. */
export interface TrayOwner {
  readonly api: Api;
  readonly subject: Subject | null;
  say(message: string, kind?: "info" | "warning" | "error"): void;
  fail(error: unknown): void;
  /** A sentence why nothing can be pinned now, or null. */
  whyNoPin(): string | null;
  /** The action of a click on a face, and its words; null where the shown tab has none. */
  faceAction(): { label: string; use: (face: Face) => void } | null;
}

export class Tray implements FaceTray {
  faces: Face[] = [];
  readonly element: HTMLElement;
  private readonly list = el("ul", { class: "tray-list" });
  private readonly pinButton: HTMLButtonElement;
  private readonly listeners: (() => void)[] = [];
  private readonly thumbnails = new Map<string, string>();

  constructor(private readonly owner: TrayOwner) {
    this.pinButton = el(
      "button",
      { type: "button", class: "tray-pin", onclick: () => void this.pin() },
      iconOf("pin"),
      el("span", {}, "Pin this face"),
    );
    this.element = el("section", { class: "tray", "aria-label": "Pinned faces" }, this.pinButton, this.list);
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }
  async refresh(): Promise<void> {
    this.faces = await this.owner.api.faces();
    this.show();
    for (const listener of this.listeners) listener();
  }

  /** The button pins a drawing or a shape; where it cannot, it says why. */
  update(): void {
    const no = this.owner.whyNoPin();
    this.pinButton.setAttribute("aria-disabled", String(no !== null));
    this.pinButton.title = no ?? "Keeps the face that is shown";
    const action = this.owner.faceAction();
    for (const face of this.list.querySelectorAll<HTMLButtonElement>(".tray-face")) {
      face.disabled = action === null;
      const name = face.dataset["name"] ?? "";
      face.title = action ? `${action.label} ${name}` : name;
      face.setAttribute("aria-label", face.title);
    }
  }

  async pin(): Promise<void> {
    const { subject } = this.owner;
    const no = this.owner.whyNoPin();
    if (no !== null) this.owner.say(no);
    if (no !== null || !subject || "face" in subject.body) return;
    try {
      const face = await this.owner.api.pinFace(subject.body);
      await this.refresh();
      this.owner.say(`${face.name} is pinned in the tray.`);
    } catch (error) {
      this.owner.fail(error);
    }
  }

  private show(): void {
    if (this.faces.length === 0) {
      this.list.replaceChildren(el("li", { class: "tray-empty" }, "Pinned faces appear here: to compare, to mix, and to begin with."));
      this.update();
      return;
    }
    this.list.replaceChildren(
      ...this.faces.map((face) => {
        const picture = el("img", { alt: "", width: 56, height: 56 });
        void this.fill(picture, face.id);
        const use = el(
          "button",
          { type: "button", class: "tray-face", "data-name": face.name, onclick: () => this.owner.faceAction()?.use(face) },
          picture,
          el("span", {}, face.name),
        );
        return el(
          "li",
          {},
          use,
          iconButton("close", `Delete ${face.name}`, () => void this.remove(face)),
        );
      }),
    );
    this.update();
  }
  private async fill(picture: HTMLImageElement, id: string): Promise<void> {
    try {
      let address = this.thumbnails.get(id);
      if (!address) {
        address = URL.createObjectURL(await this.owner.api.thumbnail(id));
        this.thumbnails.set(id, address);
      }
      picture.src = address;
    } catch {
      picture.classList.add("missing");
    }
  }
  private async remove(face: Face): Promise<void> {
    if (!confirm(`Delete ${face.name}? This cannot be undone.`)) return;
    try {
      await this.owner.api.deleteFace(face.id);
      const address = this.thumbnails.get(face.id);
      if (address) URL.revokeObjectURL(address);
      this.thumbnails.delete(face.id);
      await this.refresh();
      this.owner.say(`${face.name} is deleted.`);
    } catch (error) {
      this.owner.fail(error);
    }
  }
}
