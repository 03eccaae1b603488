import * as ort from "onnxruntime-web/wasm";
import { openSketchModel } from "daumier-web";
import { FaceView } from "./face_view.js";

const paper = document.getElementById("paper"), pen = paper.getContext("2d"), strokes = [];
const say = (text) => (document.getElementById("status").textContent = text);
const line = ({ offsetX, offsetY }) => {
  pen.lineTo(offsetX, offsetY);
  pen.stroke();
  strokes.at(-1).push([offsetX, offsetY]);
};
ort.env.wasm.wasmPaths = "/ort/";
try {
  const model = await openSketchModel(ort, "/weights/sketch-ict");
  const view = new FaceView(document.getElementById("view"), model.template);
  paper.onpointerdown = (event) => {
    paper.setPointerCapture(event.pointerId);
    pen.beginPath();
    strokes.push([]);
    line(event);
  };
  paper.onpointermove = (event) => event.buttons > 0 && line(event);
  paper.onpointerup = async () => {
    try {
      const { vertices, warnings } = await model.predict({ width: paper.width, height: paper.height, strokes });
      view.show(vertices);
      say(warnings[0] ?? "The face of your lines.");
    } catch (error) {
      say(error.message);  // Such as a tap as first line, which has no extent.
    }
  };
  say("Draw a face from the front.");
} catch (error) {
  say(error.message);  // File, cause and repair.
}
