// Choices of a head's file that Avatar and Take away share. The spellings are those of `daumier rig` and `daumier avatar`.
import { choice } from "./widgets";

export const kHairs = ["short", "bob", "long", "bun", "ponytail", "spiky", "curly", "parted", "fringe", "receding"] as const;

/** Hair of a head; "auto" only where a picture shows it. */
export function hairChoice(withAuto: boolean, value: string, change: (value: string) => void) {
  const field = choice("Hair", change);
  field.set(
    [
      { value: "none", label: "None" },
      ...(withAuto ? [{ value: "auto", label: "As in the picture" }] : []),
      ...kHairs.map((hair) => ({ value: hair, label: hair.charAt(0).toUpperCase() + hair.slice(1) })),
    ],
    value,
  );
  return field;
}
