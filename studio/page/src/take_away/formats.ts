// The formats: a sentence of what each is for, its choices, and the job that writes it.
import { avatarBody } from "../avatar/state";
import { kHairs } from "../head_options";
import type { IconName } from "../icons";
import { targetBody, type FormatId, type Target } from "./targets";

export interface Choice {
  key: string;
  /** Jobs of avatars have no such option. */
  notOfAvatars?: boolean;
  label: string;
  values: readonly { value: string; label: string }[];
}

export interface Format {
  id: FormatId;
  title: string;
  what: string;
  icon: IconName;
  /** What its button says. */
  make: string;
  doing: string;
  /** Ends of the names of the files that a person wants; the job's other files come after them. */
  wanted: readonly string[];
  choices: readonly Choice[];
  /** The body of the job for a target that `whyNot` allows; null where the file is read without a job. */
  body(target: Target, chosen: Readonly<Record<string, string>>): Record<string, unknown> | null;
}

const kNames: Choice = {
  key: "names",
  label: "Names",
  values: [
    { value: "arkit", label: "ARKit (web, Unity)" },
    { value: "unreal", label: "Unreal (Live Link)" },
    { value: "rpm", label: "Ready Player Me" },
    { value: "vrm", label: "VRM" },
    { value: "mediapipe", label: "MediaPipe" },
  ],
};
const kHair: Choice = {
  key: "hair",
  label: "Hair",
  values: [{ value: "", label: "As it is" }, ...kHairs.map((hair) => ({ value: hair, label: hair.charAt(0).toUpperCase() + hair.slice(1) }))],
};
const kTriangles: Choice = {
  key: "triangles",
  notOfAvatars: true,
  label: "Triangles",
  values: [
    { value: "", label: "All" },
    { value: "8000", label: "At most 8,000" },
    { value: "4000", label: "At most 4,000" },
    { value: "2000", label: "At most 2,000" },
  ],
};

/** An avatar is fitted again with other options; any other target is rigged. */
function head(target: Target, chosen: Readonly<Record<string, string>>, more: Record<string, unknown>): Record<string, unknown> {
  const options: Record<string, unknown> = { ...more };
  for (const key of ["names", "hair"]) if (chosen[key]) options[key] = chosen[key];
  if (chosen["triangles"] && target.kind !== "avatar") options["triangles"] = Number(chosen["triangles"]);
  if (target.kind !== "avatar") return { do: "head", ...targetBody(target), options };
  const body = avatarBody(target.state);
  return { ...body, options: { ...body.options, ...options } };
}

export const kFormats: readonly Format[] = [
  {
    id: "glb",
    title: "Head with expressions",
    what: "A .glb with 52 expressions, eyes, teeth and an animation, for games, films and web pages.",
    icon: "person",
    make: "Make the .glb",
    doing: "Making the head",
    wanted: [".glb"],
    choices: [kNames, kHair, kTriangles],
    body: (target, chosen) => head(target, chosen, {}),
  },
  {
    id: "vrm",
    title: "VRM avatar",
    what: "VRM 1.0 with its presets, for programs of VTubers and for three-vrm.",
    icon: "cube",
    make: "Make the .vrm",
    doing: "Making the avatar",
    wanted: [".vrm"],
    choices: [kHair],
    body: (target, chosen) => head(target, chosen, { vrm: true }),
  },
  {
    id: "stl",
    title: "3D print",
    what: "An .stl in millimetres, closed, with a flat base, for slicers of 3D printers.",
    icon: "layers",
    make: "Make the .stl",
    doing: "Closing the head for a print",
    wanted: [".stl"],
    choices: [],
    body: (target) => head(target, {}, { print: true }),
  },
  {
    id: "obj",
    title: "Mesh",
    what: "The plain surface in the order of the face model, for sculpting and other mesh programs.",
    icon: "mesh",
    make: "Make the mesh",
    doing: "Writing the mesh",
    wanted: [".obj", ".ply", ".mtl", "texture.png"],
    choices: [{ key: "format", label: "Format", values: [{ value: "obj", label: "OBJ" }, { value: "ply", label: "PLY" }] }],
    body: (target, chosen) => ({ do: "mesh", ...targetBody(target), format: chosen["format"] ?? "obj" }),
  },
  {
    id: "turntable",
    title: "Turntable pictures",
    what: "PNG pictures all around the head, for a film, a slide or a model sheet.",
    icon: "film",
    make: "Draw the pictures",
    doing: "Drawing the pictures",
    wanted: [".png"],
    choices: [
      { key: "frames", label: "Pictures", values: [{ value: "24", label: "24" }, { value: "8", label: "8" }, { value: "72", label: "72" }] },
      { key: "size", label: "Size", values: [{ value: "512", label: "512 px" }, { value: "256", label: "256 px" }, { value: "1024", label: "1024 px" }] },
    ],
    body: (target, chosen) => ({ do: "turntable", ...targetBody(target), options: { frames: Number(chosen["frames"] ?? 24), size: Number(chosen["size"] ?? 512) } }),
  },
  {
    id: "session",
    title: "Recorded drawing",
    what: "Every stroke and edit as .json: open it here later, or run it by the command line.",
    icon: "pen",
    make: "Download the recording",
    doing: "Reading the recording",
    wanted: [".json"],
    choices: [],
    body: () => null,
  },
];
