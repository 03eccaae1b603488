#pragma once
#include "studio/collector.h"
#include "studio/study.h"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace daumier::cli {

/// The options of `daumier studio` that open it to collect drawings, or for a study.
struct StudyArguments {
  std::filesystem::path collect, study, out;
  std::string person, vote;
  int count = 0;
};

void AddStudyArguments(CLI::App& command, StudyArguments& arguments);
/// @throws UsageError on an option of both modes without one of them; the options themselves refuse the rest.
void CheckStudyArguments(const StudyArguments& arguments);

/// Absolute. @throws UsageError if there is none.
std::filesystem::path OutOfStudy(const StudyArguments& arguments);
studio::CollectorOptions CollectorOptionsOf(const StudyArguments& arguments);
studio::VoteKind VoteKindOf(const StudyArguments& arguments);
/// @throws UsageError if --person is no number.
std::optional<int> ParticipantOf(const StudyArguments& arguments);

}  // namespace daumier::cli
