/** The words of parsed drawings: faces/drawing_terms.h. */

export const kLineLabels = ["silhouette", "ear", "brow", "upper_lid", "lower_lid", "iris", "nose", "upper_lip", "lower_lip", "inner_mouth", "wrinkle", "hair", "neck", "other"] as const;
export type LineLabel = (typeof kLineLabels)[number];

/** right: the face's own right side, on the left of a frontal picture. The first 24 are landmarks. */
export const kFacePoints = ["eye_right_outer", "eye_right_inner", "eye_right_top", "eye_right_bottom", "eye_left_inner", "eye_left_outer", "eye_left_top", "eye_left_bottom",
  "brow_right_outer", "brow_right_inner", "brow_left_inner", "brow_left_outer", "nose_bottom", "nose_wing_right", "nose_wing_left", "mouth_right", "mouth_left", "lip_top",
  "lip_bottom", "inner_top", "inner_bottom", "chin", "contour_right", "contour_left", "eye_right_centre", "eye_left_centre"] as const;
export type FacePoint = (typeof kFacePoints)[number];
export const kNumLandmarkPoints = 24;

export const kMouthStates = ["closed", "open", "teeth"] as const;
export const kEyeStates = ["open", "closed"] as const;
/** three-quarter-left looks to the left of the picture. */
export const kDrawnViews = ["front", "three-quarter-left", "three-quarter-right", "profile"] as const;

export function pointIndex(point: FacePoint): number {
  return kFacePoints.indexOf(point);
}

/** Of each point the one that the mirror image of a face has there. */
export const kMirroredPoints: readonly number[] = kFacePoints.map((name) => {
  const other = name.includes("right") ? name.replace("right", "left") : name.replace("left", "right");
  return pointIndex(other as FacePoint);
});

/** Whether a line shows the face: not hair, neck or other lines, nor ears. */
export function showsFace(label: LineLabel): boolean {
  return label !== "hair" && label !== "neck" && label !== "other" && label !== "ear";
}
