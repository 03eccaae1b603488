#pragma once
#include "systems/shipped_weights.h"
#include "systems/system.h"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Which shipped weights predict which input, where no run is named.
namespace daumier::systems {

/// Inputs that the same weights predict.
struct WeightsChoice {
  std::filesystem::path weights;
  std::vector<std::filesystem::path> inputs;
  /// What its pictures show (PictureContent::plural), and how many there are; empty and 0 where nothing was decided by
  /// content.
  std::string_view content = {};
  int num_pictures = 0;
};

/// By extension, and pictures by their content (System::picture_content), where there are weights of tasks of different
/// content that both read one of the inputs; folders are then expanded (ExpandInputFolders), and a file's weights are
/// those of the task that suits its picture best, or whose shipped_rank is the largest where all suit equally, no
/// picture or no content distinguishes them. Choices are in the order of their first input. Otherwise one choice:
/// WeightsFor all inputs. A picture that cannot be read goes by rank, so that the prediction reports it.
/// @throws UsageError as WeightsFor.
std::vector<WeightsChoice> ChooseWeights(std::span<const std::filesystem::path> inputs, std::span<const System> systems,
                                         std::span<const ShippedWeights> shipped,
                                         std::span<const std::filesystem::path> places);

}  // namespace daumier::systems
