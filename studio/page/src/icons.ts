// Line drawings of buttons and panels, in a square of side 24, in the colour of the text; no screen reader sees them.
const kIcons = {
  brush: "M20 4c-5 2-9 6-10.5 9.5l2 2C15 14 18 9 20 4M9 14c-2 0-3.5 1.5-3.5 3.5 0 1-.7 1.8-1.5 2.5 4 .5 7-.8 7-3.5",
  chevron: "M9 6l6 6-6 6",
  close: "M6 6l12 12M18 6 6 18",
  copy: "M9 9h10.5v10.5H9zM15 9V4.5H4.5v10.5h4.5",
  cube: "M12 3l7.5 4.5v9l-7.5 4.5-7.5-4.5V7.5zM4.5 7.5l7.5 4.5 7.5-4.5M12 12v9",
  dice: "M4.5 4.5h15v15H4.5zM8.7 8.7h0.01M15.3 8.7h0.01M12 12h0.01M8.7 15.3h0.01M15.3 15.3h0.01",
  download: "M12 4v11M7.5 11 12 15.5 16.5 11M4 20h16",
  eraser: "M8 20h12M5 15l8.5-8.5a2 2 0 0 1 2.8 0l3.2 3.2a2 2 0 0 1 0 2.8L12 20H9l-4-4a.7.7 0 0 1 0-1M9.5 10.5l6 6",
  film: "M3.75 4.5h16.5v15h-16.5zM7.5 4.5v15M16.5 4.5v15M3.75 12h16.5",
  fit: "M4 9V4h5M20 9V4h-5M4 15v5h5M20 15v5h-5",
  folder: "M3 7a1 1 0 0 1 1-1h5l2 2h9a1 1 0 0 1 1 1v9a1 1 0 0 1-1 1H4a1 1 0 0 1-1-1z",
  gesture: "M3 15c3-8 6-8 6-3s-3 7-3 3 6-9 9-6 1 8-1 7 0-5 7-6",
  help: "M9 9a3 3 0 1 1 4.5 2.6c-1 .6-1.5 1.2-1.5 2.4M12 17.5v.1M22 12a10 10 0 1 1-20 0 10 10 0 0 1 20 0",
  lasso:
    "M8 15.5c-3-1-4-2.8-4-4.8C4 7 7.5 5 12 5s8 2 8 5.5-3.5 6-8 6c-1.5 0-2.5-.2-4-1M8 15.5a2 2 0 1 0-2 2.5c1.5 0 2-1 2-2.5M6 18c0 1.5.5 2.5 1.5 3.5",
  layers: "M12 3l9 4.5-9 4.5-9-4.5zM3 12l9 4.5 9-4.5M3 16.5l9 4.5 9-4.5",
  link: "M9.75 14.25l4.5-4.5M10.5 7.5l2.25-2.25a3.75 3.75 0 0 1 6 6L16.5 13.5M13.5 16.5l-2.25 2.25a3.75 3.75 0 0 1-6-6L7.5 10.5",
  mesh: "M12 3l8.25 15h-16.5zM12 3v15M7.8 10.5h8.4",
  minus: "M5 12h14",
  mirror: "M12 3v18M9 7 3 18h6zM15 7l6 11h-6z",
  moon: "M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5",
  move: "M12 3v18M3 12h18M9 6l3-3 3 3M9 18l3 3 3-3M6 9l-3 3 3 3M18 9l3 3-3 3",
  pause: "M7.5 4.5v15M16.5 4.5v15",
  pen: "M4 20l1-4L16 5l3 3L8 19zM13.5 7.5l3 3",
  person: "M12 3.75a3.75 3.75 0 1 0 0 7.5 3.75 3.75 0 0 0 0-7.5M4.5 20.25c0-4.5 3-6.75 7.5-6.75s7.5 2.25 7.5 6.75",
  picture: "M4 5h16v14H4zM4 16l5-5 4 4 3-3 4 4M15.5 9.5v.1",
  pin: "M9 4h6l-1 6 3 3v2H7v-2l3-3zM12 15v6",
  play: "M7.5 4.5l12 7.5-12 7.5z",
  plus: "M12 5v14M5 12h14",
  point: "M12 8.25a3.75 3.75 0 1 0 0 7.5 3.75 3.75 0 0 0 0-7.5M12 1.5v3M12 19.5v3M1.5 12h3M19.5 12h3",
  pull: "M5 21c0-6 6-6 6-11 0-3-2-5-6-7M14 12h7M18 9l3 3-3 3",
  redo: "M15 7l4.5 4.5L15 16M19 11.5h-9a5.5 5.5 0 0 0 0 11h3",
  rename: "M4 20h16M6 16l1-3.5L15.5 4l2.5 2.5L9.5 15z",
  reset: "M4.5 4.5v6h6M5.25 10.5a7.5 7.5 0 1 1-0.45 4.5",
  roll: "M3 18h18M6 18a6 6 0 0 1 12 0M12 8V3M9.5 5.5 12 3l2.5 2.5",
  search: "M10.5 4.5a6 6 0 1 0 0 12 6 6 0 0 0 0-12M15 15l5.25 5.25",
  settings: "M4 8h9M17 8h3M4 16h3M11 16h9M15 6v4a2 2 0 0 0 0-4M9 14a2 2 0 1 0 0 4 2 2 0 1 0 0-4M15 6a2 2 0 1 0 0 4",
  sun:
    "M12 4V2M12 22v-2M4 12H2M22 12h-2M6.3 6.3 4.9 4.9M19.1 19.1l-1.4-1.4M6.3 17.7l-1.4 1.4M19.1 4.9l-1.4 1.4M16 12a4 4 0 1 1-8 0 4 4 0 0 1 8 0",
  trash: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13M10.5 11v5M13.5 11v5",
  turn: "M20 12c0 2.2-3.6 4-8 4s-8-1.8-8-4 3.6-4 8-4c2 0 3.8.4 5.2 1M17.5 5l.5 4-4 .5",
  unbrush: "M5 12h14M22 12a10 10 0 1 1-20 0 10 10 0 0 1 20 0",
  undo: "M9 7 4.5 11.5 9 16M5 11.5h9a5.5 5.5 0 0 1 0 11h-3",
  upload: "M12 16.5V4.5M6.75 9L12 3.75 17.25 9M4.5 20.25h15",
} as const;
export type IconName = keyof typeof kIcons;

const kSvg = "http://www.w3.org/2000/svg";

export function iconOf(name: IconName): SVGSVGElement {
  const svg = document.createElementNS(kSvg, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS(kSvg, "path");
  path.setAttribute("d", kIcons[name]);
  svg.append(path);
  return svg;
}
