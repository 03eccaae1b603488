// Client of the server's API: one method a request. Every failure is an ApiError whose message is a sentence for people.
import type {
  Example,
  Face,
  Head,
  Info,
  Job,
  SessionEntry,
  SessionEvent,
  SessionState,
  Shape,
  ShapeInfo,
  SheetCamera,
  Upload,
} from "./api_types";

export class ApiError extends Error {
  /** status 0: the server did not respond. */
  constructor(
    message: string,
    readonly status: number,
  ) {
    super(message);
  }
}

/** True of a request that the page itself aborted. */
export function isAbort(error: unknown): boolean {
  return error instanceof DOMException && error.name === "AbortError";
}

/** The token of the address' fragment, kept for reloads of this browser tab and removed from the address. */
export function takeToken(): string {
  const fragment = new URLSearchParams(location.hash.slice(1));
  const given = fragment.get("token");
  if (given) {
    sessionStorage.setItem("daumier-token", given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return given ?? sessionStorage.getItem("daumier-token") ?? "";
}

type Body = { json: unknown } | { bytes: Blob };

export class Api {
  constructor(private readonly token: string) {}

  private async request(method: string, path: string, body?: Body, signal?: AbortSignal): Promise<Response> {
    const headers: Record<string, string> = { Authorization: `Bearer ${this.token}` };
    if (body) headers["Content-Type"] = "json" in body ? "application/json" : "application/octet-stream";
    const content = body === undefined ? null : "json" in body ? JSON.stringify(body.json) : body.bytes;
    let response: Response;
    try {
      response = await fetch(path, { method, headers, body: content, signal: signal ?? null, cache: "no-store" });
    } catch (error) {
      if (isAbort(error)) throw error;
      throw new ApiError("The server does not respond. Start `daumier studio` again; your drawings are kept.", 0);
    }
    if (response.ok) return response;
    if (response.status === 401) throw new ApiError("The server was restarted. Open the address that it printed.", 401);
    let message = `The server failed (status ${response.status}).`;
    try {
      const parsed = (await response.json()) as { error?: unknown };
      if (typeof parsed.error === "string") message = parsed.error;
    } catch {
      // The body is no JSON: the status alone is reported.
    }
    throw new ApiError(message, response.status);
  }

  async get<T>(path: string, signal?: AbortSignal): Promise<T> {
    return (await this.request("GET", path, undefined, signal)).json() as Promise<T>;
  }
  async post<T>(path: string, json: unknown = {}, signal?: AbortSignal): Promise<T> {
    return (await this.request("POST", path, { json }, signal)).json() as Promise<T>;
  }
  async patch<T>(path: string, json: unknown): Promise<T> {
    return (await this.request("PATCH", path, { json })).json() as Promise<T>;
  }
  async remove<T>(path: string): Promise<T> {
    return (await this.request("DELETE", path)).json() as Promise<T>;
  }
  /** A file of the server, for a link or a picture: these need the header too, so an address alone does not do. */
  async blob(path: string, signal?: AbortSignal): Promise<Blob> {
    return (await this.request("GET", path, undefined, signal)).blob();
  }
  async bytes(path: string, signal?: AbortSignal): Promise<ArrayBuffer> {
    return (await this.request("GET", path, undefined, signal)).arrayBuffer();
  }
  /** JSON, or null of status 204. */
  async getOrNull<T>(path: string, signal?: AbortSignal): Promise<T | null> {
    const response = await this.request("GET", path, undefined, signal);
    return response.status === 204 ? null : (response.json() as Promise<T>);
  }
  private async floats(response: Promise<Response>): Promise<Float32Array | null> {
    const arrived = await response;
    return arrived.status === 204 ? null : new Float32Array(await arrived.arrayBuffer());
  }

  info(): Promise<Info> {
    return this.get("/api/info");
  }
  head(): Promise<Head> {
    return this.get("/api/head");
  }
  async triangles(): Promise<Uint32Array> {
    return new Uint32Array(await this.bytes("/api/head/triangles"));
  }

  async sessions(): Promise<SessionEntry[]> {
    return (await this.get<{ sessions: SessionEntry[] }>("/api/sessions")).sessions;
  }
  async examples(): Promise<Example[]> {
    return (await this.get<{ examples: Example[] }>("/api/examples")).examples;
  }
  createSession(options: { begin: string; name?: string; example?: string }): Promise<SessionState> {
    return this.post("/api/sessions", options);
  }
  session(id: string): Promise<SessionState> {
    return this.get(`/api/sessions/${id}`);
  }
  renameSession(id: string, name: string): Promise<SessionState> {
    return this.patch(`/api/sessions/${id}`, { name });
  }
  deleteSession(id: string): Promise<unknown> {
    return this.remove(`/api/sessions/${id}`);
  }
  /** The new state and its face, N x 3 vertices in cm; null while there is none. */
  async sendEvent(id: string, event: SessionEvent): Promise<{ state: SessionState; vertices: Float32Array | null }> {
    const response = await this.request("POST", `/api/sessions/${id}/events?face=1`, { json: event });
    const bytes = await response.arrayBuffer();
    const kLength = 4;
    const length = new DataView(bytes).getUint32(0, true);
    const state = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, kLength, length))) as SessionState;
    return { state, vertices: bytes.byteLength > kLength + length ? new Float32Array(bytes, kLength + length) : null };
  }
  /** N x 3 vertices in cm, or null while there is no face. */
  sessionVertices(id: string, revision: number, signal?: AbortSignal): Promise<Float32Array | null> {
    return this.floats(this.request("GET", `/api/sessions/${id}/vertices?revision=${revision}`, undefined, signal));
  }
  /** The face while the pen is down: of a stroke of Sketch, or of an operation of Sculpt. */
  preview(id: string, event: SessionEvent, signal?: AbortSignal): Promise<Float32Array | null> {
    return this.floats(this.request("POST", `/api/sessions/${id}/preview`, { json: event }, signal));
  }
  camera(id: string, yaw: number, pitch: number, signal?: AbortSignal): Promise<SheetCamera> {
    return this.get(`/api/sessions/${id}/camera?yaw=${yaw}&pitch=${pitch}`, signal);
  }

  async faces(): Promise<Face[]> {
    return (await this.get<{ faces: Face[] }>("/api/faces")).faces;
  }
  pinFace(body: { name?: string } & ({ session: string } | { shape: unknown })): Promise<Face> {
    return this.post("/api/faces", body);
  }
  faceVertices(id: string, signal?: AbortSignal): Promise<Float32Array | null> {
    return this.floats(this.request("GET", `/api/faces/${id}/vertices`, undefined, signal));
  }
  thumbnail(id: string): Promise<Blob> {
    return this.blob(`/api/faces/${id}/thumbnail.png`);
  }
  deleteFace(id: string): Promise<unknown> {
    return this.remove(`/api/faces/${id}`);
  }

  shapeInfo(): Promise<ShapeInfo> {
    return this.get("/api/shape");
  }
  shapeVertices(shape: Shape, signal?: AbortSignal): Promise<Float32Array | null> {
    return this.floats(this.request("POST", "/api/shape", { json: shape }, signal));
  }
  randomShape(seed: number, spread: number): Promise<{ controls: Record<string, number> }> {
    return this.post("/api/shape/random", { seed, spread });
  }

  async upload(file: Blob, name: string): Promise<Upload> {
    const response = await this.request("POST", `/api/uploads?name=${encodeURIComponent(name)}`, { bytes: file });
    return response.json() as Promise<Upload>;
  }
  /** Starts a job and polls until it ends. Aborting the signal cancels it. Throws of a job that failed. */
  async runJob(body: unknown, progress: (job: Job) => void, signal?: AbortSignal): Promise<Job> {
    let job = await this.post<Job>("/api/jobs", body, signal);
    while (job.state === "queued" || job.state === "running") {
      progress(job);
      await new Promise((done) => setTimeout(done, 300));
      job = signal?.aborted ? await this.remove<Job>(`/api/jobs/${job.id}`) : await this.get<Job>(`/api/jobs/${job.id}`);
    }
    progress(job);
    if (job.state === "failed") throw new ApiError(job.error ?? "The job failed.", 500);
    if (job.state === "cancelled") throw new DOMException("cancelled", "AbortError");
    return job;
  }
  jobFile(id: string, name: string): Promise<Blob> {
    return this.blob(`/api/jobs/${id}/files/${name.split("/").map(encodeURIComponent).join("/")}`);
  }
}
