#include "cli/study_arguments.h"

#include "core/error.h"

#include <fmt/format.h>

#include <charconv>

namespace daumier::cli {
namespace {

constexpr char kVoteBest[] = "best", kVoteRatings[] = "ratings";

}  // namespace

void AddStudyArguments(CLI::App& command, StudyArguments& arguments) {
  CLI::Option* const collect =
      command
          .add_option(
              "--collect", arguments.collect,
              "Collect drawings: the page shows the faces of this folder (of `daumier dataset faces`, or of meshes) "
              "one by one, front and side, and keeps what a person draws of them in --out")
          ->check(CLI::ExistingDirectory);
  CLI::Option* const study =
      command
          .add_option(
              "--study", arguments.study,
              "Compare methods: the page shows the items of this folder (FOLDER/NAME/source.png and METHOD.obj or "
              ".png) without the names of methods, and appends votes to the file --out")
          ->check(CLI::ExistingDirectory)
          ->excludes(collect);
  command.add_option("--out", arguments.out,
                     "With --collect the folder of drawings, with --study the file of votes (.csv); both are added to");
  command.add_option("--person", arguments.person,
                     "Who draws or votes: a number, which decides what is shown when. Without it 1, or in a study the "
                     "next number");
  command.add_option("--count", arguments.count, "How many faces the person draws; 0: all")
      ->check(CLI::Range(0, 1'000'000))
      ->needs(collect);
  command
      .add_option("--vote", arguments.vote,
                  "best (which one is the best) or ratings (aesthetics, accuracy and similarity of each, 1 to 5). "
                  "Without it ratings")
      ->check(CLI::IsMember({kVoteBest, kVoteRatings}))
      ->needs(study);
}

void CheckStudyArguments(const StudyArguments& arguments) {
  const bool has_mode = !arguments.collect.empty() || !arguments.study.empty();
  if (!has_mode && (!arguments.out.empty() || !arguments.person.empty()))
    throw UsageError("--out and --person belong to --collect or --study");
}

std::filesystem::path OutOfStudy(const StudyArguments& arguments) {
  if (arguments.out.empty())
    throw UsageError(arguments.study.empty() ? "--collect needs a folder for the drawings: --out DIR"
                                             : "--study needs a file for the votes: --out votes.csv");
  return std::filesystem::absolute(arguments.out);
}

studio::CollectorOptions CollectorOptionsOf(const StudyArguments& arguments) {
  studio::CollectorOptions options{.count = arguments.count};
  if (!arguments.person.empty()) options.person = arguments.person;
  return options;
}

studio::VoteKind VoteKindOf(const StudyArguments& arguments) {
  return arguments.vote == kVoteBest ? studio::VoteKind::kBest : studio::VoteKind::kRatings;
}

std::optional<int> ParticipantOf(const StudyArguments& arguments) {
  if (arguments.person.empty()) return std::nullopt;
  int number = 0;
  const std::string& text = arguments.person;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size())
    throw UsageError(fmt::format("--person is {}, expected a number in a study", text.substr(0, 40)));
  return number;
}

}  // namespace daumier::cli
