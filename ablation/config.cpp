#include "ablation/config.h"

#include "core/config.h"
#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>

namespace daumier::ablation {
namespace {

namespace fs = std::filesystem;

/// The table of that name, taken out of a larger one; empty if it is not there.
Json TakeTable(Json& json, const std::string& key, const std::string& where) {
  if (!json.is_object() || !json.contains(key)) return Json::object();
  Json table = json[key];
  json.erase(key);
  if (!table.is_object()) throw UsageError(fmt::format("{}: '{}' is {}, expected a table", where, key, table.dump()));
  return table;
}

Json Merged(Json base, const Json& over) {
  base.merge_patch(over);
  return base;
}

/// Moves the keys that an ablation has of its own from the overrides into its config.
void TakeOwnOverrides(Json& overrides, Json& config) {
  for (const char* key : {"base", "compare_to", "seeds", "splits", "evaluate", "eval"}) {
    if (!overrides.contains(key)) continue;
    config.merge_patch({{key, overrides[key]}});
    overrides.erase(key);
  }
}

void CheckRow(const AblationRow& row, const std::string& where) {
  const auto refuse = [&](const std::string& why) { throw UsageError(fmt::format("{}: {}", where, why)); };
  if (row.name().empty()) refuse("a row needs a name");
  if (!row.options.run_of.empty() && !row.options.from.empty()) refuse("'run_of' and 'from' exclude each other");
  if (!row.trains() && !row.config.empty()) refuse("it trains nothing, so that its 'config' would change nothing");
  if (!row.evaluates() && !row.eval.empty()) refuse("it evaluates nothing, so that its 'eval' would change nothing");
}

void CheckNames(const std::vector<AblationRow>& rows, const std::string& where) {
  std::set<std::string> folders;
  for (const AblationRow& row : rows) {
    if (!folders.insert(FolderName(row.name())).second)
      throw UsageError(fmt::format("{}: two rows are named '{}'", where, row.name()));
  }
}

std::string Requester(const AblationRow& row) {
  return fmt::format("row '{}'", row.name());
}

void CheckKinds(const Ablation& ablation) {
  for (const AblationRow& row : ablation.rows) {
    if (!row.trains() && !ablation.options.evaluate)
      throw UsageError(fmt::format("row '{}' trains nothing, so that it needs evaluate=true", row.name()));
    if (!row.options.run_of.empty() && !ablation.row(row.options.run_of, Requester(row)).trains())
      throw UsageError(
          fmt::format("row '{}': 'run_of' names '{}', which has no run of its own", row.name(), row.options.run_of));
    if (!row.options.from.empty() && !ablation.row(row.options.from, Requester(row)).evaluates())
      throw UsageError(
          fmt::format("row '{}': 'from' names '{}', which has no report of its own", row.name(), row.options.from));
  }
}

}  // namespace

const AblationRow& Ablation::row(const std::string& name, const std::string& who_asks) const {
  std::set<std::string> names;
  for (const AblationRow& row : rows) {
    if (row.name() == name) return row;
    names.insert(row.name());
  }
  const std::string nearest = NearestWord(name, names);
  throw UsageError(fmt::format("{}: there is no row '{}'; {}", who_asks, name,
                               nearest.empty() ? fmt::format("rows are: '{}'", fmt::join(names, "', '"))
                                               : fmt::format("did you mean '{}'?", nearest)));
}

Ablation LoadAblation(const fs::path& file, const std::vector<std::string>& overrides,
                      const std::vector<std::string>& references) {
  const std::string where = file.string();
  Json json = LoadConfig(file), of_runs = LoadConfig("", overrides);
  TakeOwnOverrides(of_runs, json);
  const Json rows = json.value("rows", Json::array());
  json.erase("rows");
  if (!rows.is_array() || rows.empty())
    throw UsageError(fmt::format("{}: a table needs rows: [[rows]] with name = \"...\"", where));
  const Json config = TakeTable(json, "config", where), eval = TakeTable(json, "eval", where);

  Ablation ablation{ParseOptions<AblationOptions>(json, where), {}};
  if (ablation.options.seeds.empty() || ablation.options.splits.empty())
    throw UsageError(fmt::format("{}: a table needs at least one of 'seeds' and one of 'splits'", where));
  Json base = Json::object();
  if (!ablation.options.base.empty()) base = LoadConfig(file.parent_path() / ablation.options.base);
  for (Json row_json : rows) {
    const std::string row_where = fmt::format("{}, row {}", where, ablation.rows.size() + 1);
    AblationRow row;
    row.config = TakeTable(row_json, "config", row_where);
    row.eval = TakeTable(row_json, "eval", row_where);
    row.options = ParseOptions<AblationRowOptions>(row_json, row_where);
    CheckRow(row, row_where);
    if (row.trains()) row.config = Merged(Merged(Merged(base, config), row.config), of_runs);
    if (row.evaluates()) row.eval = Merged(eval, row.eval);
    ablation.rows.push_back(std::move(row));
  }
  CheckNames(ablation.rows, where);
  CheckKinds(ablation);
  if (!ablation.options.compare_to.empty()) ablation.row(ablation.options.compare_to, where + ": compare_to");
  WorkingOrder(ablation, references);
  return ablation;
}

std::vector<std::string> NeededRows(const AblationRow& row, const std::vector<std::string>& references) {
  std::vector<std::string> needed;
  const auto add = [&](const std::string& name) {
    if (!name.empty() && std::find(needed.begin(), needed.end(), name) == needed.end()) needed.push_back(name);
  };
  add(row.options.run_of);
  add(row.options.from);
  for (const std::string& key : references)
    if (row.eval.contains(key) && row.eval[key].is_string()) add(row.eval[key].get<std::string>());
  return needed;
}

std::vector<int> WorkingOrder(const Ablation& ablation, const std::vector<std::string>& references,
                              const std::vector<std::string>& only) {
  std::vector<int> order;
  std::vector<std::string> path;
  const std::function<void(const AblationRow&)> visit = [&](const AblationRow& row) {
    const int index = int(&row - ablation.rows.data());
    if (std::find(order.begin(), order.end(), index) != order.end()) return;
    if (std::find(path.begin(), path.end(), row.name()) != path.end())
      throw UsageError(fmt::format("rows need each other in a circle: {} -> {}", fmt::join(path, " -> "), row.name()));
    path.push_back(row.name());
    for (const std::string& name : NeededRows(row, references))
      if (name != row.name()) visit(ablation.row(name, Requester(row)));
    path.pop_back();
    order.push_back(index);
  };
  if (only.empty())
    for (const AblationRow& row : ablation.rows) visit(row);
  for (const std::string& name : only) visit(ablation.row(name, "--only"));
  return order;
}

std::string FolderName(const std::string& row_name) {
  std::string folder = row_name;
  for (char& c : folder)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("._-").find(c) == std::string_view::npos)
      c = '-';
  if (folder.starts_with('.')) folder[0] = '-';
  return folder;
}

}  // namespace daumier::ablation
