#pragma once
#include "core/device.h"
#include "core/json.h"
#include "systems/predictor.h"
#include "systems/sketch/drawing_parser.h"

#include <filesystem>
#include <memory>
#include <string>

namespace daumier::sketch {

struct ParserPredictOptions {
  DrawingParserOptions parser;

  template <class V>
  void Visit(V&& visit) {
    visit("parser", parser, Table{}, "How drawings are parsed.");
  }
};

/// {points: {NAME: {at: [x, y], confidence}}, mouth, eye_right, eye_left, view: {CLASS: probability}}, pixels of the
/// sheet.
Json ParsedToJson(const ParsedDrawing& drawing);

/// Parses drawings: results without a mesh; record and file .json as ParsedToJson, the picture `parsing`.
class ParserPredictor : public systems::Predictor {
 public:
  explicit ParserPredictor(DrawingParser parser) : parser_(std::move(parser)) {}

  /// Drawings, and images of line drawings (render::TraceLineDrawing). @throws Error if an input is neither, or as
  /// DrawingParser.
  std::vector<systems::FaceResult> Predict(std::span<const systems::Input> inputs,
                                           const Task& task = {}) const override;

 private:
  DrawingParser parser_;
};

/// The run or weights that `name` names, a folder or shipped weights; empty: the shipped weights of the task
/// drawing_parser. @throws UsageError saying where shipped weights are searched, if there are none of that name or task.
std::filesystem::path ParserFolder(const std::string& name);

/// The parser of a finished run or of shipped weights. @throws Error as ReadParserNetworkOptions and
/// LoadTrainingLibrary.
DrawingParser OpenDrawingParser(const std::filesystem::path& run_or_weights, const Device& device,
                                const DrawingParserOptions& options = {});

std::unique_ptr<systems::Predictor> OpenParserPredictor(const std::filesystem::path& run, const Device& device,
                                                        const Json& options);

}  // namespace daumier::sketch
