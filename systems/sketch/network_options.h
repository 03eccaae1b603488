#pragma once
#include "core/options.h"

#include <string>
#include <vector>

namespace daumier::sketch {

/// What a trunk reads of a sketch.
enum class TrunkInput { kPicture, kPoints, kCurves };

/// A row of the table of trunks, which is in network_options.cpp. models/sketch_trunks.cpp has the other half of the row,
/// the layers.
struct TrunkKind {
  std::string name;  ///< `network.trunk`.
  TrunkInput input = TrunkInput::kPicture;
  /// All channels of all convolutions are multiples of 8 iff `network.width` is a multiple of this.
  int width_step = 8;
  std::string help = "convolutions of its picture";  ///< "a point network on its strokes"
};
const std::vector<TrunkKind>& TrunkKinds();
std::vector<std::string> TrunkNames();
/// @throws UsageError if there is no trunk of that name.
const TrunkKind& TrunkNamed(const std::string& name);
/// Of `network.trunk`: the names with what they are.
std::string TrunkHelp();

/// Which network; the presets of configs/sketch/ name the rows of DeepSketch2Face's Table 2 in these words.
struct SketchNetworkOptions {
  std::string trunk = "compact";
  std::string shape_input = "none";
  std::string branches = "two";
  int resolution = 128;
  int width = 16;
  bool batch_norm = true;
  int hidden = 256;
  int branch = 256;
  int identity_layers = 2;
  int expression_layers = 0;
  int shape_hidden = 512;
  int num_points = 256;
  int residual = 0;
  std::string basis = "faces";

  static constexpr int kMaxWidth = 256;

  template <class V>
  void Visit(V&& visit) {
    visit("trunk", trunk, Choices{TrunkNames()}, TrunkHelp());
    visit("shape_input", shape_input, Choices{{"none", "late", "early"}},
          "Where the curve coefficients join the features of the trunk. none: nowhere; late: before the output of each "
          "branch, as published; early: before the branches.");
    visit("branches", branches, Choices{{"two", "one"}}, "Two branches, one each for u and v, or one branch for both.");
    visit("resolution", resolution, Range{32, 512}, "Side of the square input sketch, in pixels.");
    visit("width", width, Range{1, kMaxWidth},
          "Channels of the first convolution; those of the others scale with it. A training requires a multiple of 8 "
          "(trunk alexnet: 24, trunk points: 4), so that every convolution has a multiple of 8 channels.");
    visit("batch_norm", batch_norm, Flag{},
          "Batch normalisation after each convolution of trunk alexnet; the other trunks always have it.");
    visit("hidden", hidden, Range{1, 8192}, "Number of features that the trunk returns.");
    visit("branch", branch, Range{1, 8192}, "Neurons in a layer of the branches.");
    visit("identity_layers", identity_layers, Range{0, 8},
          "Fully connected layers before the output of the u branch (or of the one branch).");
    visit("expression_layers", expression_layers, Range{0, 8},
          "Fully connected layers before the output of the v branch.");
    visit("shape_hidden", shape_hidden, Range{1, 8192}, "Neurons of the layer that reads the curve coefficients.");
    visit("num_points", num_points, Range{16, 4096}, "Number of stroke points that trunk points reads.");
    visit("residual", residual, Range{0, 1000},
          "Number of vectors of a linear basis of faces. The network predicts a residual in this basis, which is added "
          "to the bilinear face; the bilinear face is projected onto the basis, too. 0: no residual.");
    visit("basis", basis, Choices{{"faces", "gaussian"}},
          "Of that basis. faces: the directions that explain most of training faces; gaussian: those of their normal "
          "distribution, from which fits to drawings start; `residual` is then 1 more than its components. Shipped "
          "weights need gaussian.");
  }

  bool reads_image() const { return TrunkNamed(trunk).input == TrunkInput::kPicture; }
  bool reads_points() const { return TrunkNamed(trunk).input == TrunkInput::kPoints; }
  bool reads_shape() const { return TrunkNamed(trunk).input == TrunkInput::kCurves || shape_input != "none"; }
  int width_step() const { return TrunkNamed(trunk).width_step; }
  bool has_whole_blocks() const { return width % width_step() == 0; }
};

/// Numbers of a network that come from the models of its run.
struct SketchNetworkSizes {
  int num_identity = 0, num_expression = 0;  ///< Ku, Kv of the bilinear model.
  int num_shape = 0;                         ///< Ku + Kv of the curve model.
  int num_vertices = 0;

  template <class V>
  void Visit(V&& visit) {
    visit("num_identity", num_identity, Range{1, 1e6}, "Identity weights.");
    visit("num_expression", num_expression, Range{1, 1e6}, "Expression weights.");
    visit("num_shape", num_shape, Range{1, 1e6}, "Curve coefficients.");
    visit("num_vertices", num_vertices, Range{1, 1e7}, "Vertices.");
  }
};

/// Refuses a training with channels that are no multiples of 8: oneDNN computes 8 at a time, and its AVX2 code (2.6.3)
/// for weight gradients of strided 1 x 1 convolutions in channels-last writes past its buffers if they read fewer.
/// @throws UsageError with the nearest allowed widths, unless options.has_whole_blocks().
void RequireWholeBlocks(const SketchNetworkOptions& options);

}  // namespace daumier::sketch
