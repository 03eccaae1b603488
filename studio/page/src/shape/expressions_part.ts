// The 52 expressions, with a gain for each, and expressions that are stored under a name.
import type { Shape, ShapeInfo } from "../api_types";
import { el } from "../dom";
import { expressionRows, expressionTitle, kPresets, withinLimits, type ExpressionRow, type Weights } from "../expressions";
import { slider, sidesSlider } from "../slider";
import { button, checkbox, section } from "../widgets";
import type { Memory } from "./controls_part";
import { matches, withValues, type Editor, type Part } from "./editor";

const kGreatestGain = 3;

export interface Stored {
  name: string;
  weights: Weights;
}

export interface StoredExpressions {
  all(): Stored[];
  keep(stored: Stored[]): void;
}

export function expressionsPart(info: ShapeInfo, editor: Editor, folded: Memory, unlinked: Memory, stored: StoredExpressions): Part {
  const groups = Object.entries(info.expression_groups).map(([group, names]) => groupPart(group, names, editor, folded, unlinked));
  const known = new Set(info.expressions);
  const play = (name: string, weights: Weights) => {
    const kept = Object.fromEntries(Object.entries(withinLimits(weights)).filter(([key]) => known.has(key)));
    editor.change({ expressions: kept }, `expression ${name}`, true);
  };

  const presets = el(
    "div",
    { class: "p-chips", role: "group", "aria-label": "Expressions to begin with" },
    button("Neutral", () => play("neutral", {}), { kind: "quiet" }),
    ...kPresets.map((preset) => button(preset.name, () => play(preset.name, preset.weights), { kind: "quiet" })),
  );
  const list = el("div", { class: "p-chips", role: "group", "aria-label": "Stored expressions" });
  const name = el("input", { type: "text", class: "p-text", placeholder: "Name of this expression", "aria-label": "Name of this expression", maxlength: 40 });
  const store = el("form", { class: "p-row" }, name, button("Store", () => store.requestSubmit(), { name: "Store this expression" }));
  store.addEventListener("submit", (event) => {
    event.preventDefault();
    const title = name.value.trim() || `Expression ${stored.all().length + 1}`;
    const weights = { ...editor.document.expressions };
    stored.keep([...stored.all().filter((each) => each.name !== title), { name: title, weights }]);
    name.value = "";
    showStored();
  });
  const showStored = () => {
    list.hidden = stored.all().length === 0;
    list.replaceChildren(
      ...stored.all().map((each) =>
        el(
          "span",
          { class: "p-chip" },
          button(each.name, () => play(each.name, each.weights), { kind: "quiet" }),
          button("", () => {
            stored.keep(stored.all().filter((other) => other.name !== each.name));
            showStored();
          }, { kind: "quiet", icon: "close", name: `Forget ${each.name}` }),
        ),
      ),
    );
  };
  showStored();
  const gains = checkbox("Strength of each expression (gain): 2 doubles its movement", false, (on) => element.body.classList.toggle("p-with-gains", on));

  const element = section("expressions", folded.get("expressions") ?? false, (open) => {
    if (!searching) folded.set("expressions", open);
  });
  let searching = false;
  element.body.append(presets, list, store, gains, ...groups.map((group) => group.element));
  return {
    element: element.element,
    show: (document) => {
      for (const group of groups) group.show(document);
      const changed = Object.values(document.expressions ?? {}).filter((value) => value !== 0).length;
      element.note(changed ? `${changed} changed` : "");
    },
    search: (words) => {
      searching = words !== "";
      const found = groups.map((group) => group.search?.(words)).some(Boolean);
      element.element.hidden = !found;
      element.element.open = searching ? found : folded.get("expressions") ?? false;
      for (const each of [presets, store, gains]) each.hidden = searching;
      list.hidden = searching || stored.all().length === 0;
      return found;
    },
  };
}

function groupPart(group: string, names: string[], editor: Editor, folded: Memory, unlinked: Memory): Part {
  const key = `expressions ${group}`;
  let searching = false;
  const part = section(group, folded.get(key) ?? false, (open) => {
    if (!searching) folded.set(key, open);
  });
  const rows = expressionRows(names).map((row) => ({ row, ...rowOf(row, editor, unlinked) }));
  part.body.append(...rows.map((row) => row.element));
  part.element.classList.add("p-inner");
  return {
    element: part.element,
    show: (document) => {
      for (const row of rows) row.show(document);
      const changed = names.filter((name) => document.expressions?.[name]).length;
      part.note(changed ? `${changed} changed` : "");
    },
    search: (words) => {
      searching = words !== "";
      let found = false;
      for (const each of rows) {
        const hit = matches(`expression ${group} ${each.row.title} ${each.row.names.join(" ")}`, words);
        each.element.hidden = !hit;
        found ||= hit;
      }
      part.element.hidden = !found;
      part.element.open = searching ? found : folded.get(key) ?? false;
      return found;
    },
  };
}

function rowOf(row: ExpressionRow, editor: Editor, unlinked: Memory) {
  const [first, second] = row.names;
  const label = row.title.charAt(0).toUpperCase() + row.title.slice(1);
  const value = (document: Shape, name: string) => document.expressions?.[name] ?? 0;
  const change = (values: Weights, done: boolean) =>
    editor.change({ expressions: withValues(editor.document.expressions, values) }, `expression ${first}`, done);
  const gain = gainOf(row, editor);

  if (second === undefined) {
    const one = slider({ name: expressionTitle(first), label, least: 0, greatest: 1, change: (next, done) => change({ [first]: next }, done) });
    return {
      element: el("div", { class: "p-expression" }, one.element, gain.element),
      show: (document: Shape) => {
        one.set(value(document, first));
        gain.show(document);
      },
    };
  }
  const both = sidesSlider({
    name: row.title,
    label,
    least: 0,
    greatest: 1,
    linked: unlinked.get(first) !== true,
    onLink: (linked) => unlinked.set(first, !linked),
    change: (sides, done) => change({ [first]: sides.left, [second]: sides.right }, done),
  });
  return {
    element: el("div", { class: "p-expression" }, both.element, gain.element),
    show: (document: Shape) => {
      both.set({ left: value(document, first), right: value(document, second) });
      gain.show(document);
    },
  };
}

/** A factor of the shape's displacement; the two sides have the same. */
function gainOf(row: ExpressionRow, editor: Editor) {
  const field = el("input", { type: "number", class: "p-number", min: 0, max: kGreatestGain, step: 0.1, "aria-label": `gain of ${row.title}` });
  field.addEventListener("change", () => {
    const typed = Number.isFinite(field.valueAsNumber) ? field.valueAsNumber : 1;
    const gain = Math.min(kGreatestGain, Math.max(0, typed));
    const gains = withValues(editor.document.gains, Object.fromEntries(row.names.map((name) => [name, gain])));
    field.value = String(gain);
    editor.change({ gains }, `gain ${row.names[0]}`, true);
  });
  return {
    element: el("div", { class: "p-gain" }, el("span", { "aria-hidden": "true" }, "×"), field),
    show: (document: Shape) => {
      field.value = String(document.gains?.[row.names[0]] ?? 1);
    },
  };
}
