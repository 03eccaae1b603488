#include "benchmark/baselines.h"
#include "benchmark/make.h"
#include "benchmark/record.h"
#include "benchmark/rows.h"
#include "cli/config_kind.h"
#include "cli/verb.h"
#include "core/error.h"
#include "core/log.h"
#include "core/process_task.h"
#include "reports/report_table.h"
#include "systems/shipped_weights.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace daumier::cli {
namespace {

namespace fs = std::filesystem;

/// Persons of a small kit of that many: half train, a quarter each the others, each at least one.
benchmark::PersonCounts SmallCounts(int persons) {
  const int quarter = std::max(1, persons / 4);
  return {.train = persons - 2 * quarter, .validation = quarter, .test = quarter};
}

faces::FaceModel KitModel(faces::SourceOptions source) {
  if (source.name == "ict" && source.path.empty()) {
    const std::vector<fs::path> places = systems::WeightsPlaces();
    source.path = systems::WeightsNamed("face-ict", systems::ListWeights(places), places).string();
  }
  return faces::LoadFaceModel(source);
}

std::function<void()> AddMake(CLI::App& parent) {
  struct Arguments {
    ConfigArguments config;
    fs::path out;
    int persons = 0;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = parent.add_subcommand(
      "make", "Inputs and truth of the benchmark: drawings, landmarks of caricatures, portraits; split by person");
  AddConfigArguments(*command, arguments->config);
  command
      ->add_option("--persons", arguments->persons,
                   "A small kit of this many persons, half of them for training, to try; not the benchmark")
      ->check(CLI::Range(3, 10000));
  command->add_option("-o,--out", arguments->out, "Folder to write")->required();
  command->footer("Options:\n" + HelpText<benchmark::BenchmarkOptions>());
  return [arguments] {
    auto options = ReadConfigOf("benchmark make", arguments->config.file, [&] {
      return ParseOptions<benchmark::BenchmarkOptions>(arguments->config.Load(), arguments->config.Where());
    });
    if (arguments->persons > 0) {
      options.persons = SmallCounts(arguments->persons);
      options.name += fmt::format("-of-{}-persons", arguments->persons);
    }
    benchmark::MakeBenchmark(KitModel(options.faces.source), options, arguments->out, TaskOfProcess());
    fmt::print("{}: {}, {} persons, hash {}\n", arguments->out.string(), options.name, options.persons.all(),
               DataHash(arguments->out));
  };
}

void PrintNames(const char* what, const std::vector<std::string>& names) {
  constexpr size_t kMostNames = 20;
  for (size_t i = 0; i < std::min(names.size(), kMostNames); ++i) fmt::print("{}: {}\n", what, names[i]);
  if (names.size() > kMostNames) fmt::print("{}: {} more\n", what, names.size() - kMostNames);
}

Json ComparisonToJson(const benchmark::RecordComparison& comparison) {
  return {{"same", comparison.num_same},
          {"equivalent", comparison.equivalent},
          {"different", comparison.different},
          {"largest_share_of_tolerance", comparison.largest_share}};
}

void Check(const fs::path& kit, const fs::path& against, bool as_json) {
  const benchmark::KitDamage damage = benchmark::CheckKit(kit);
  Json result = {
      {"hash", DataHash(kit)}, {"missing", damage.missing}, {"changed", damage.changed}, {"extra", damage.extra}};
  std::optional<benchmark::RecordComparison> comparison;
  if (damage.none() && !against.empty()) {
    const fs::path record = fs::is_directory(against) ? against / benchmark::kRecordFile : against;
    const benchmark::KitRecord expected = benchmark::ReadRecord(record),
                               found = benchmark::ReadRecord(kit / benchmark::kRecordFile);
    comparison = benchmark::CompareRecords(expected, found);
    result["against"] = ComparisonToJson(*comparison);
  }
  if (as_json) {
    PrintResult(result, true);
  } else {
    PrintNames("missing", damage.missing);
    PrintNames("changed", damage.changed);
    PrintNames("not of the kit", damage.extra);
    if (comparison) {
      PrintNames("equivalent", comparison->equivalent);
      PrintNames("different", comparison->different);
      fmt::print("{} entries are the same bytes, {} equivalent, {} different\n", comparison->num_same,
                 comparison->equivalent.size(), comparison->different.size());
    }
    fmt::print("hash {}\n", result.at("hash").get<std::string>());
  }
  DAUMIER_CHECK(damage.none(),
                "{}: {} files are missing, {} changed, {} are not of the kit. Make it again: daumier benchmark make",
                kit.string(), damage.missing.size(), damage.changed.size(), damage.extra.size());
  DAUMIER_CHECK(!comparison || comparison->different.empty(),
                "{} is another kit than {}: {} of its entries differ. Was it made of another definition or source?",
                kit.string(), against.string(), comparison->different.size());
}

std::function<void()> AddCheck(CLI::App& parent) {
  struct Arguments {
    fs::path kit, against;
    bool as_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      parent.add_subcommand("check", "Whether every file of a kit is as it was made, and as it has to be");
  command->add_option("kit", arguments->kit, "Folder that `benchmark make` wrote")->required();
  command
      ->add_option("--against", arguments->against,
                   "Another kit or its record.json, such as configs/benchmark/benchmark-1.record.json: entries are the "
                   "same bytes, equivalent (numbers within 0.0002 mm, 0.002 pixels or 0.05 grey values on average) or "
                   "different")
      ->check(CLI::ExistingPath);
  command->add_flag("--json", arguments->as_json, "Print the result as JSON");
  return [arguments] { Check(arguments->kit, arguments->against, arguments->as_json); };
}

std::function<void()> AddBaseline(CLI::App& parent) {
  struct Arguments {
    fs::path kit, out;
    std::string task, split = "test", method;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      parent.add_subcommand("baseline", "Predictions of a baseline, which `score` measures as any others");
  command->add_option("kit", arguments->kit, "Folder that `benchmark make` wrote")->required();
  command->add_option("--task", arguments->task, "drawings, caricatures, portraits or landmarks")->required();
  command
      ->add_option(
          "--method", arguments->method,
          "mean; nearest (the truth of the nearest training input); regression (linear, chosen on validation); "
          "shape_model and shape_model_3d (of caricatures: principal components fitted to the landmarks in the "
          "picture, or in space); mean_placed (of "
          "landmarks: a bound that reads the truth)")
      ->required();
  command->add_option("--split", arguments->split, "train, validation or test")->capture_default_str();
  command->add_option("-o,--out", arguments->out, "Folder to write")->required();
  return [arguments] {
    const benchmark::KitTask task = benchmark::KitTaskNamed(arguments->task);
    const benchmark::KitSplit split = benchmark::KitSplitNamed(arguments->split);
    const benchmark::Baseline baseline = benchmark::BaselineNamed(arguments->method);
    benchmark::WriteBaseline(benchmark::Kit(arguments->kit), task, split, baseline, arguments->out, TaskOfProcess());
  };
}

std::function<void()> AddRows(CLI::App& parent) {
  struct Arguments {
    std::vector<fs::path> rows;
    bool as_json = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      parent.add_subcommand("rows", "Table of several rows of one task, least error first, compared item by item");
  command->add_option("rows", arguments->rows, "Files that `daumier score --benchmark KIT --json` printed")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_flag("--json", arguments->as_json, "Print the rows without their items as JSON");
  return [arguments] {
    std::vector<Json> rows;
    for (const fs::path& file : arguments->rows) rows.push_back(ReadJson(file));
    const Json summary = benchmark::SummariseRows(rows);
    if (arguments->as_json) return PrintResult(summary, true);
    fmt::print("{}", reports::TableText(benchmark::RowsTable(summary)));
  };
}

}  // namespace

Verb BenchmarkVerb() {
  return {"benchmark", "Frozen inputs and truth by which methods are compared, and baselines (docs/benchmark.md)",
          [](CLI::App& command) {
            command.require_subcommand(1);
            const std::vector<std::pair<std::string, std::function<void()>>> actions = {
                {"make", AddMake(command)},
                {"check", AddCheck(command)},
                {"baseline", AddBaseline(command)},
                {"rows", AddRows(command)}};
            return [&command, actions] {
              for (const auto& [name, action] : actions)
                if (command.got_subcommand(name)) return action();
            };
          }};
}

}  // namespace daumier::cli
