#include "cli/verb.h"
#include "core/files.h"
#include "core/options.h"
#include "ablation/ablation.h"
#include "systems/deform/train/ablation.h"
#include "systems/sketch/train/ablation.h"

#include <fmt/core.h>

#include <memory>

namespace daumier::cli {
namespace {

std::string Describe(ablation::RowState state) {
  switch (state) {
    case ablation::RowState::kToTrain:
      return "to train";
    case ablation::RowState::kToGoOn:
      return "to go on with";
    case ablation::RowState::kToEvaluate:
      return "to evaluate";
    case ablation::RowState::kDone:
      return "done";
  }
  return "";
}

void PrintPlan(const std::vector<ablation::AblationStep>& steps, bool as_json) {
  Json list = Json::array();
  for (const ablation::AblationStep& step : steps) {
    if (!as_json) fmt::print("seed {}  {:<8} {:<28} {}\n", step.seed, step.split, step.row, Describe(step.state));
    list.push_back({{"row", step.row}, {"split", step.split}, {"seed", step.seed}, {"state", Describe(step.state)}});
  }
  if (as_json) fmt::print("{}\n", list.dump(2));
}

/// For the kind of runs that the base config tells by its `product`.
std::unique_ptr<ablation::AblationTask> TaskOf(const ConfigArguments& config, const std::string& device) {
  const ablation::Ablation ablation = ablation::LoadAblation(config.file, config.overrides, {});
  if (ablation.rows.front().config.contains("product")) return std::make_unique<deform::DeformAblation>(device);
  return std::make_unique<sketch::SketchAblation>(device);
}

}  // namespace

Verb AblateVerb() {
  return {"ablate", "Train and evaluate every row of a table", [](CLI::App& command) {
            struct Arguments {
              ConfigArguments config;
              std::filesystem::path out;
              std::vector<std::string> only;
              std::string device = "cpu";
              bool dry_run = false, as_json = false;
            };
            auto arguments = std::make_shared<Arguments>();
            command.add_option("config", arguments->config.file, "TOML file of the table")->required();
            command.add_option("overrides", arguments->config.overrides,
                               "key=value or table.key=value, in TOML syntax: of every run, or seeds, splits, eval.*");
            command.add_option("--out", arguments->out, "Folder of runs, reports, table and pictures")->required();
            command.add_option("--only", arguments->only, "Rows to make, and what they need: NAME,NAME")
                ->delimiter(',')
                ->allow_extra_args(false);
            command.add_option("--device", arguments->device, "cpu or cuda")->capture_default_str();
            command.add_flag("--dry-run", arguments->dry_run, "Say what is done and what would be, and do nothing");
            command.add_flag("--json", arguments->as_json, "Machine-readable");
            command.footer("The table:\n" + HelpText<ablation::AblationOptions>() + "Each of its [[rows]]:\n" +
                           HelpText<ablation::AblationRowOptions>() +
                           "[config] and [eval] of the table or of a row override the base config and the defaults of "
                           "`daumier eval`; docs/formats.md tells more.");
            return [arguments] {
              const std::unique_ptr<ablation::AblationTask> task = TaskOf(arguments->config, arguments->device);
              const ablation::Ablation ablation =
                  ablation::LoadAblation(arguments->config.file, arguments->config.overrides, task->references());
              if (arguments->dry_run) {
                PrintPlan(ablation::PlanAblation(ablation, *task, arguments->out, arguments->only), arguments->as_json);
                return;
              }
              const Json table = ablation::RunAblation(ablation, *task, arguments->out, arguments->only);
              if (arguments->as_json) {
                fmt::print("{}\n", table.dump(2));
              } else {
                fmt::print("{}\npictures: {}\n", ReadFile(arguments->out / "table.md"),
                           (arguments->out / "index.html").string());
              }
            };
          }};
}

}  // namespace daumier::cli
