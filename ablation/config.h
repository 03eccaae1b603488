#pragma once
#include "core/json.h"
#include "core/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace daumier::ablation {

struct AblationOptions {
  std::string base, compare_to;
  std::vector<uint64_t> seeds = {1};
  std::vector<std::string> splits = {"person"};
  bool evaluate = true;

  template <class V>
  void Visit(V&& visit) {
    visit("base", base, Text{}, "Config of the run of every row; a path relative to this file.");
    visit("compare_to", compare_to, Text{},
          "Reference row for paired differences. Default: the first row with per-face errors.");
    visit("seeds", seeds, Range{0, 9e15}, "Every row is trained once with each.");
    visit("splits", splits, Text{}, "Every row is trained once on each; the first is the headline.");
    visit("evaluate", evaluate, Flag{},
          "If not, rows are compared by their least validation errors and no test face is read, as in trials of "
          "options.");
  }
};

struct AblationRowOptions {
  std::string name;
  double paper = 0;
  std::string run_of, from, line, input;

  template <class V>
  void Visit(V&& visit) {
    visit("name", name, Text{}, "What the table calls the row.");
    visit("paper", paper, Range{0, 1e6}, "The paper's own error, in its own column; 0: it has none.");
    visit("run_of", run_of, Text{}, "Train nothing: evaluate the run of that row with the options of this one.");
    visit("from", from, Text{}, "Train and evaluate nothing: read the report of that row.");
    visit("line", line, Text{},
          "Which line of the report's table is the row's error; by default the run's own result.");
    visit("shape_input", input, Text{}, "The input of that line, if several lines have its name.");
  }
};

/// A row of the table: a run and its evaluation, or a line of another row's report.
struct AblationRow {
  AblationRowOptions options;
  Json config = Json::object();  ///< Of the run: the base config, overridden.
  Json eval = Json::object();    ///< Options of the evaluation; a reference to a row holds that row's name.

  const std::string& name() const { return options.name; }
  /// Whether it has a run of its own.
  bool trains() const { return options.run_of.empty() && options.from.empty(); }
  /// Whether it has a report of its own.
  bool evaluates() const { return options.from.empty(); }
};

/// A table to be made. In addition to AblationOptions its file holds
///   [config]   overrides of the base for every row
///   [eval]     options of the evaluation of every row
///   [[rows]]   AblationRowOptions and, of the row alone, the tables `config` and `eval`
struct Ablation {
  AblationOptions options;
  std::vector<AblationRow> rows;  ///< As the table shows them.

  /// @throws UsageError if there is no such row, naming the nearest.
  const AblationRow& row(const std::string& name, const std::string& who_asks) const;
};

/// Reads an ablation config; of the overrides, `seeds`, `splits`, `evaluate`, `base`, `compare_to` and `eval.*` are
/// the ablation's own, all others override the config of every row, the row's own words included. `references` are the
/// keys of `eval` that name another row, whose run the evaluation needs.
/// @throws UsageError as LoadConfig and ParseOptions, if there is no row, a row has no name or one that another row
/// has, a row that another one needs or that is compared to is not there (naming the nearest), rows need each other in
/// a circle, or a row trains nothing though no row is evaluated.
Ablation LoadAblation(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                      const std::vector<std::string>& references);

/// Whose run or report a row needs, each once.
std::vector<std::string> NeededRows(const AblationRow& row, const std::vector<std::string>& references);

/// The rows, by index, in an order in which what a row needs comes before it; otherwise in the order of the file. With
/// `only`: those rows and all that they need. @throws UsageError as LoadAblation, and on a name in `only` that no row
/// has.
std::vector<int> WorkingOrder(const Ablation& ablation, const std::vector<std::string>& references,
                              const std::vector<std::string>& only = {});

/// A row's name as a folder: letters, digits, '_', '-' and any '.' but the first character stay, all else
/// becomes '-'.
std::string FolderName(const std::string& row_name);

}  // namespace daumier::ablation
