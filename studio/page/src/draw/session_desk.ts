// Drawings on the server: the first screen, begin, open, rename, read from a file.
import { ApiError, isAbort } from "../api";
import type { SessionState } from "../api_types";
import type { Studio } from "../tab";
import type { SessionClient } from "./session_client";
import { askNew } from "./new_dialog";
import { newName, StartScreen } from "./start_screen";

export const kNoFaceYet = "The face appears here with the first lines.";

export interface DeskHost {
  readonly studio: Studio;
  readonly session: SessionClient;
  /** The tab is shown. */
  readonly visible: boolean;
  /** Another drawing is about to be opened. */
  cleared(): void;
  opened(): void;
  renamed(state: SessionState): void;
  busy(is: boolean): void;
  /** The first screen has come or gone. */
  starting(is: boolean): void;
}

export class SessionDesk {
  readonly start: StartScreen;

  constructor(private readonly host: DeskHost) {
    this.start = new StartScreen({
      api: host.studio.api,
      begin: (options) => void this.create(options),
      openSession: (id) => void this.open(id),
      changed: (id, name) => this.changed(id, name),
      close: () => this.start.hide(),
      shown: (is) => host.starting(is),
      fail: (error) => host.studio.fail(error),
    });
  }

  get hasDrawing(): boolean {
    return this.host.session.state !== null;
  }

  /** The drawing of the last visit, or the first screen. */
  async resume(): Promise<void> {
    const { studio, session } = this.host;
    const last = studio.recall<string>("session", "");
    if (last !== "") {
      try {
        await session.open(await studio.api.session(last));
        return;
      } catch (error) {
        // A drawing that was deleted elsewhere is no error: the first screen offers the others.
        if (!(error instanceof ApiError) || error.status !== 404) studio.fail(error);
        else studio.remember("session", "");
      }
    }
    await this.showStart();
  }

  async create(options: { begin: string; name?: string; example?: string }): Promise<void> {
    this.host.busy(true);
    this.start.element.setAttribute("aria-busy", "true");
    try {
      await this.openState(await this.host.studio.api.createSession(options));
    } catch (error) {
      this.host.studio.fail(error);
    } finally {
      this.host.busy(false);
      this.start.element.removeAttribute("aria-busy");
    }
  }
  async rename(name: string): Promise<void> {
    const state = this.host.session.state;
    if (!state || name === "" || name === state.name) return;
    try {
      await this.host.studio.api.renameSession(state.id, name);
      this.changed(state.id, name);
    } catch (error) {
      this.host.studio.fail(error);
    }
  }
  /** A file of a drawing becomes a pinned face, and a drawing that begins with it. */
  async readDrawing(file: File): Promise<void> {
    const { studio } = this.host;
    this.host.busy(true);
    try {
      const upload = await studio.api.upload(file, file.name);
      const job = await studio.api.runJob({ do: "drawing", upload: upload.id }, () => undefined);
      await studio.faces.refresh();
      for (const warning of job.warnings) studio.say(warning, "warning");
      const face = job.result?.["face"];
      if (typeof face === "string") await this.create({ begin: face, name: file.name });
    } finally {
      this.host.busy(false);
    }
  }

  /** Free drawing is over in this drawing: another one can be begun. */
  async offerNew(): Promise<void> {
    if (!(await askNew())) return;
    await this.create({ begin: "blank", name: newName(await this.host.studio.api.sessions().catch(() => [])) });
  }
  /** Once: what becomes of the lines of a person. */
  sayOfLines(): void {
    const { studio } = this.host;
    if (studio.recall("draw.said", false)) return;
    studio.remember("draw.said", true);
    studio.say("The lines are those of the face now. Undo brings yours back.");
  }

  private async showStart(): Promise<void> {
    const { studio, session } = this.host;
    await this.start.show(false);
    try {
      const vertices = await studio.api.shapeVertices({ base: "mean" });
      if (!this.host.visible || session.state || !vertices) return;
      studio.viewer.setVertices(vertices);
      studio.viewer.lookFrom("three-quarter");
    } catch (error) {
      if (!isAbort(error)) studio.viewer.clear(kNoFaceYet);
    }
  }
  private async open(id: string): Promise<void> {
    try {
      await this.openState(await this.host.studio.api.session(id));
    } catch (error) {
      this.host.studio.fail(error);
    }
  }
  private async openState(state: SessionState): Promise<void> {
    await this.dropEmpty();
    this.host.session.close();
    this.host.cleared();
    this.start.hide();
    this.host.studio.viewer.lookFrom("front");
    await this.host.session.open(state);
    this.host.opened();
  }
  /** A sheet without a line is not kept among the drawings. */
  private async dropEmpty(): Promise<void> {
    const state = this.host.session.state;
    if (!state || state.mode !== "draw" || state.lines.length > 0 || state.can_undo || state.can_redo) return;
    await this.host.studio.api.deleteSession(state.id).catch(() => undefined);
  }
  /** name null: the drawing was deleted. */
  private changed(id: string, name: string | null): void {
    const state = this.host.session.state;
    if (!state || id !== state.id) return;
    if (name !== null) {
      state.name = name;
      this.host.renamed(state);
      return;
    }
    this.host.session.close();
    this.host.studio.remember("session", "");
    this.host.studio.subject = null;
    void this.showStart();
  }
}
