#include "ablation/measure.h"

#include "core/error.h"
#include "core/files.h"

namespace daumier::ablation {

AblationMeasure MeasureOf(const reports::MetricTable& table, const reports::MetricRow& row) {
  DAUMIER_CHECK(!row.face_errors.empty(),
                "its report is of an earlier version, without the errors of each face. Delete it; the same command "
                "makes it again");
  const reports::MetricRow& result = table.rows.at(table.result);
  AblationMeasure measure{.error = row.error().mean,
                          .interval = row.error().interval,
                          .of_run = row.name == result.name,
                          .is_result = &row == &result};
  if (!row.input.empty()) measure.more["shape_input"] = row.input;
  for (size_t i = 1; i < table.columns.size(); ++i)
    measure.more[table.columns[i].key] = row.values[i] ? Json(row.values[i]->mean) : Json();
  for (const auto& [key, value] : row.details.items()) measure.more[key] = value;
  measure.more["num_faces"] = row.face_errors.size();
  measure.more["data_hash"] = table.data_hash;
  if (row.face_errors.size() < table.faces.size()) return measure;
  measure.face_errors = row.face_errors;
  measure.groups = table.groups;
  return measure;
}

std::string TestSetId(const Json& metrics) {
  try {
    return fmt::format("{} faces of {}, faces {}, data {}", metrics.at("num_faces").dump(), metrics.at("split").dump(),
                       Sha256(metrics.at("faces").dump()).substr(0, 12), metrics.at("data_hash").dump());
  } catch (const Json::exception& error) {
    throw Error(fmt::format("the metrics of a report are malformed: {}", error.what()));
  }
}

}  // namespace daumier::ablation
