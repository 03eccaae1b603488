import { described, isObject } from "./arguments.js";
import { check, DaumierError, textOf } from "./error.js";

/** A folder that Daumier wrote, where the browser can read it. */
export interface Folder {
  /** For messages. */
  readonly name: string;
  /** @throws DaumierError if there is no such file. */
  read(file: string): Promise<Uint8Array>;
  /** The folder `name` next to this one. */
  neighbour(name: string): Folder;
}

/** Address of a folder, with or without the last slash; relative ones belong to the page. */
export type Place = string | URL | Folder;

const kServe = "Serve the whole folder that `daumier export` wrote, or that lies in weights/, at this address";

class ServedFolder implements Folder {
  readonly name: string;

  constructor(address: URL) {
    this.name = address.href.replace(/\/*$/, "");
  }

  async read(file: string): Promise<Uint8Array> {
    const address = `${this.name}/${file}`;
    let response: Response;
    try {
      response = await fetch(address);
    } catch (error) {
      throw new DaumierError(address, `it could not be fetched (${textOf(error)})`,
        "Check the address, the connection, and that a server of another origin allows this page to read it (CORS)", { cause: error });
    }
    check(response.ok, address, `the server has no such file (status ${response.status})`, kServe);
    check(!(response.headers.get("content-type") ?? "").startsWith("text/html"), address,
      "the server sent a web page in its place", kServe);
    try {
      return new Uint8Array(await response.arrayBuffer());
    } catch (error) {
      throw new DaumierError(address, `it ended before it was complete (${textOf(error)})`, "Load the page again", { cause: error });
    }
  }

  neighbour(name: string): Folder {
    return new ServedFolder(new URL(`${this.name}/../${name}`));
  }
}

export function folderAt(place: Place): Folder {
  if (typeof place !== "string" && !(place instanceof URL)) {
    const isFolder = isObject(place) && typeof place["read"] === "function" && typeof place["neighbour"] === "function";
    check(isFolder, "place", `it is ${described(place)} (expected the address of a folder, or {name, read(file), neighbour(name)})`, "Give an address such as /weights/sketch-ict");
    return place;
  }
  const base = typeof document === "undefined" ? (globalThis as { location?: { href: string } }).location?.href : document.baseURI;
  try {
    return new ServedFolder(new URL(place, base));
  } catch (error) {
    throw new DaumierError(String(place), "this is no address of a folder", "Give an address such as /weights/sketch-ict", { cause: error });
  }
}

/** The file as JSON. @throws DaumierError if it is missing or no JSON. */
export async function readJson(folder: Folder, file: string): Promise<unknown> {
  const text = new TextDecoder().decode(await folder.read(file));
  try {
    return JSON.parse(text) as unknown;
  } catch (error) {
    throw new DaumierError(`${folder.name}/${file}`, `this is no JSON (${textOf(error)})`, kServe, { cause: error });
  }
}
