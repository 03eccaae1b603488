#include "systems/weights_choice.h"

#include "core/error.h"
#include "core/log.h"
#include "systems/predict_inputs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace daumier::systems {
namespace {

namespace fs = std::filesystem;

using SuitsPicture = double (*)(const render::Image&);

/// Weights that this program can predict by.
struct Candidate {
  const ShippedWeights* weights;
  const System* system;
};

std::vector<Candidate> CandidatesOf(std::span<const System> systems, std::span<const ShippedWeights> shipped) {
  std::vector<Candidate> candidates;
  for (const ShippedWeights& weights : shipped) {
    const auto system = std::ranges::find(systems, weights.system, &System::name);
    if (system != systems.end() && system->open != nullptr) candidates.push_back({&weights, &*system});
  }
  return candidates;
}

std::vector<Candidate> ReadersOf(const fs::path& file, std::span<const Candidate> candidates) {
  std::vector<Candidate> readers;
  for (const Candidate& candidate : candidates)
    if (IsInputFile(*candidate.system, file)) readers.push_back(candidate);
  return readers;
}

/// Whether content decides between candidates.
bool DifferInContent(std::span<const Candidate> candidates) {
  std::set<SuitsPicture> contents;
  for (const Candidate& candidate : candidates)
    if (candidate.system->picture_content.suits != nullptr) contents.insert(candidate.system->picture_content.suits);
  return contents.size() > 1;
}

/// Files in place of folders; a folder in which no candidate reads a file stays.
std::vector<fs::path> FilesOf(std::span<const fs::path> inputs, std::span<const Candidate> candidates) {
  System any{};  // Reads what any of them reads.
  for (const Candidate& candidate : candidates)
    any.input_extensions.insert(any.input_extensions.end(), candidate.system->input_extensions.begin(),
                                candidate.system->input_extensions.end());
  return ExpandInputFolders(any, {inputs.begin(), inputs.end()});
}

std::optional<render::Image> PictureIn(const fs::path& file) {
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return std::nullopt;
  try {
    return render::ReadImage(file);
  } catch (const Error&) {  // The prediction reports it.
    return std::nullopt;
  }
}

/// How well each reader suits the file.
std::vector<double> SuitOf(const fs::path& file, std::span<const Candidate> readers) {
  std::vector<double> suit(readers.size(), 0);
  if (!DifferInContent(readers)) return suit;
  const std::optional<render::Image> picture = PictureIn(file);
  if (!picture) return suit;
  std::map<SuitsPicture, double> known{{nullptr, 0}};
  for (size_t i = 0; i < readers.size(); ++i) {
    const SuitsPicture suits = readers[i].system->picture_content.suits;
    const auto found = known.find(suits);
    suit[i] = found != known.end() ? found->second : known.emplace(suits, suits(*picture)).first->second;
  }
  return suit;
}

}  // namespace

std::vector<WeightsChoice> ChooseWeights(std::span<const fs::path> inputs, std::span<const System> systems,
                                         std::span<const ShippedWeights> shipped, std::span<const fs::path> places) {
  const auto by_extension = [&](std::span<const fs::path> of) { return WeightsFor(of, systems, shipped, places); };
  const std::vector<Candidate> candidates = CandidatesOf(systems, shipped);
  if (!DifferInContent(candidates)) return {{by_extension(inputs), {inputs.begin(), inputs.end()}}};
  const std::vector<fs::path> files = FilesOf(inputs, candidates);
  if (std::ranges::none_of(files, [&](const fs::path& file) { return DifferInContent(ReadersOf(file, candidates)); }))
    return {{by_extension(inputs), {inputs.begin(), inputs.end()}}};
  std::vector<WeightsChoice> choices;
  for (const fs::path& file : files) {
    const std::vector<Candidate> readers = ReadersOf(file, candidates);
    if (readers.empty()) by_extension({&file, 1});  // Throws, naming the file.
    const std::vector<double> suit = SuitOf(file, readers);
    size_t best = 0;
    for (size_t i = 1; i < readers.size(); ++i) {
      const bool is_better = suit[i] > suit[best] || (suit[i] == suit[best] && readers[i].system->shipped_rank >
                                                                                   readers[best].system->shipped_rank);
      if (is_better) best = i;
    }
    const fs::path& weights = readers[best].weights->directory;
    auto choice = std::ranges::find(choices, weights, &WeightsChoice::weights);
    if (choice == choices.end()) choice = choices.insert(choices.end(), {weights, {}});
    choice->inputs.push_back(file);
    if (suit[best] == 0) continue;
    choice->content = readers[best].system->picture_content.plural;
    ++choice->num_pictures;
  }
  return choices;
}

}  // namespace daumier::systems
