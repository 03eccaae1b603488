/** Daumier's networks in the browser, by onnxruntime-web. */
export { type DeformModel, openDeformModel } from "./deform_model.js";
export { type Drawing, kSketchCanvas, type Placement, type Point, type Stroke } from "./drawing.js";
export { type FacePoint, kDrawnViews, kEyeStates, kFacePoints, kLineLabels, kMouthStates, type LineLabel } from "./drawing_terms.js";
export { DaumierError } from "./error.js";
export type { FaceTemplate } from "./face_template.js";
export type { Folder, Place } from "./folder.js";
export type { FloatArray, OrtModule, SessionOptions } from "./network.js";
export { confidenceOf, type ParsedDrawing } from "./parsed_drawing.js";
export { drawingOfPicture, type Picture } from "./picture.js";
export { openPortraitModel, type PortraitFace, type PortraitModel } from "./portrait_model.js";
export type { PictureMap } from "./portrait_crop.js";
export { inkOf, rasteriseStrokes } from "./raster.js";
export { openSketchModel, type SketchFace, type SketchModel, type SketchOptions } from "./sketch_model.js";
