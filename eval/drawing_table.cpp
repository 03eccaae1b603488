#include "eval/drawing_table.h"

#include "core/statistics.h"

#include <fmt/format.h>

#include <algorithm>

namespace daumier::eval {
namespace {

constexpr const char* kDash = "-";

double PercentNme(const PointErrors& errors) {
  return 100 * MeanOf(errors).value();
}

std::optional<double> PercentOfPart(const PointErrors& errors, int part) {
  const std::optional<double> mean = MeanOf(errors, part);
  return mean ? std::optional(100 * *mean) : std::nullopt;
}

std::string NumberText(std::optional<double> percent) {
  return percent ? fmt::format("{:.1f}", *percent) : kDash;
}

std::string YesNo(std::optional<bool> value, const char* yes, const char* no) {
  return !value ? kDash : *value ? yes : no;
}

Json NullableNumber(std::optional<double> value) {
  return value ? Json(*value) : Json();
}

Json NullableFlag(std::optional<bool> value) {
  return value ? Json(*value) : Json();
}

DrawingGroup GroupOf(const std::string& name, std::span<const DrawingScore> scores) {
  DrawingGroup group{.name = name};
  std::vector<double> nme, mean_face, aligned;
  std::array<std::vector<double>, kNumDrawnParts> parts, mean_face_parts;
  for (const DrawingScore& score : scores) {
    if (score.group != name) continue;
    nme.push_back(PercentNme(score.errors));
    mean_face.push_back(PercentNme(score.mean_face));
    aligned.push_back(PercentNme(score.aligned));
    for (int part = 0; part < kNumDrawnParts; ++part) {
      if (const auto percent = PercentOfPart(score.errors, part)) parts[size_t(part)].push_back(*percent);
      if (const auto percent = PercentOfPart(score.mean_face, part)) mean_face_parts[size_t(part)].push_back(*percent);
    }
    ++group.num_drawings;
    group.num_predicted += score.is_predicted ? 1 : 0;
    group.num_better += nme.back() < mean_face.back() ? 1 : 0;
    group.mouth_known += score.mouth_is_right ? 1 : 0;
    group.mouth_right += score.mouth_is_right.value_or(false) ? 1 : 0;
    group.eyes_known += score.eyes_are_right ? 1 : 0;
    group.eyes_right += score.eyes_are_right.value_or(false) ? 1 : 0;
    group.num_crossed_lips += score.states.lips_cross() ? 1 : 0;
    group.num_recognised += score.is_recognised.value_or(false) ? 1 : 0;
  }
  group.nme = Mean(nme);
  group.median_nme = Median(nme);
  group.mean_face_nme = Mean(mean_face);
  group.aligned_nme = Mean(aligned);
  for (size_t part = 0; part < parts.size(); ++part) {
    if (parts[part].empty()) continue;
    group.parts[part] = Mean(parts[part]);
    group.mean_face_parts[part] = Mean(mean_face_parts[part]);
  }
  return group;
}

Json GroupToJson(const DrawingGroup& group) {
  Json parts = Json::object(), mean_face_parts = Json::object();
  for (size_t part = 0; part < kNumDrawnParts; ++part) {
    parts[kDrawnPartNames[part]] = NullableNumber(group.parts[part]);
    mean_face_parts[kDrawnPartNames[part]] = NullableNumber(group.mean_face_parts[part]);
  }
  return {{"name", group.name},
          {"num_drawings", group.num_drawings},
          {"num_predicted", group.num_predicted},
          {"nme", group.nme},
          {"median_nme", group.median_nme},
          {"mean_face_nme", group.mean_face_nme},
          {"aligned_nme", group.aligned_nme},
          {"num_better_than_mean_face", group.num_better},
          {"parts", parts},
          {"mean_face_parts", mean_face_parts},
          {"mouth_right", group.mouth_right},
          {"mouth_known", group.mouth_known},
          {"eyes_right", group.eyes_right},
          {"eyes_known", group.eyes_known},
          {"num_crossed_lips", group.num_crossed_lips},
          {"num_recognised", group.num_recognised}};
}

Json ScoreToJson(const DrawingScore& score) {
  Json parts = Json::object();
  for (int part = 0; part < kNumDrawnParts; ++part)
    parts[kDrawnPartNames[size_t(part)]] = NullableNumber(PercentOfPart(score.errors, part));
  return {{"name", score.name},
          {"group", score.group},
          {"predicted", score.is_predicted},
          {"nme", PercentNme(score.errors)},
          {"mean_face_nme", PercentNme(score.mean_face)},
          {"aligned_nme", PercentNme(score.aligned)},
          {"parts", parts},
          {"mouth_right", NullableFlag(score.mouth_is_right)},
          {"eyes_right", NullableFlag(score.eyes_are_right)},
          {"lip_gap_mm", score.states.lip_gap_mm},
          {"lid_gap_mm", score.states.lid_gap_mm},
          {"lips_cross", score.states.lips_cross()},
          {"recognised", NullableFlag(score.is_recognised)}};
}

}  // namespace

std::vector<DrawingGroup> GroupScores(std::span<const DrawingScore> scores) {
  std::vector<DrawingGroup> groups;
  for (const DrawingScore& score : scores)
    if (std::ranges::find(groups, score.group, &DrawingGroup::name) == groups.end())
      groups.push_back(GroupOf(score.group, scores));
  return groups;
}

reports::ReportTable DrawingTable(std::span<const DrawingScore> scores) {
  reports::ReportTable table{"Drawings", {"drawing", "NME", "placed best", "mean face placed best"}, {}};
  for (const std::string_view part : kDrawnPartNames) table.header.emplace_back(part);
  table.header.insert(table.header.end(), {"mouth state", "lid state", "lips", "recognised"});
  for (const DrawingScore& score : scores) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {score.is_predicted ? score.name : score.name + " (mean face)", NumberText(PercentNme(score.errors)),
           NumberText(PercentNme(score.aligned)), NumberText(PercentNme(score.mean_face))};
    for (int part = 0; part < kNumDrawnParts; ++part) row.push_back(NumberText(PercentOfPart(score.errors, part)));
    row.push_back(YesNo(score.mouth_is_right, "right", "wrong"));
    row.push_back(YesNo(score.eyes_are_right, "right", "wrong"));
    row.push_back(score.states.lips_cross() ? "crossed" : "fine");
    row.push_back(YesNo(score.is_recognised, "yes", "no"));
  }
  return table;
}

reports::ReportTable DrawingGroupTable(std::span<const DrawingGroup> groups) {
  reports::ReportTable table{"Groups", {"group", "drawings", "NME", "median", "placed best", "better"}, {}};
  for (const std::string_view part : kDrawnPartNames) table.header.emplace_back(part);
  table.header.insert(table.header.end(), {"mouth state", "lid state", "crossed lips", "recognised"});
  for (const DrawingGroup& group : groups) {
    std::vector<std::string> row = {group.name,
                                    fmt::format("{}", group.num_drawings),
                                    NumberText(group.nme),
                                    NumberText(group.median_nme),
                                    NumberText(group.aligned_nme),
                                    fmt::format("{}/{}", group.num_better, group.num_drawings)};
    for (const auto& part : group.parts) row.push_back(NumberText(part));
    row.push_back(fmt::format("{}/{}", group.mouth_right, group.mouth_known));
    row.push_back(fmt::format("{}/{}", group.eyes_right, group.eyes_known));
    row.push_back(fmt::format("{}", group.num_crossed_lips));
    row.push_back(fmt::format("{}/{}", group.num_recognised, group.num_drawings));
    table.rows.push_back(std::move(row));
    std::vector<std::string> mean_face(table.header.size(), kDash);
    mean_face[0] = "  mean face placed best";
    mean_face[2] = NumberText(group.mean_face_nme);
    for (size_t part = 0; part < kNumDrawnParts; ++part) mean_face[6 + part] = NumberText(group.mean_face_parts[part]);
    table.rows.push_back(std::move(mean_face));
  }
  return table;
}

Json DrawingScoresToJson(std::span<const DrawingScore> scores) {
  Json groups = Json::array(), drawings = Json::array();
  for (const DrawingGroup& group : GroupScores(scores)) groups.push_back(GroupToJson(group));
  for (const DrawingScore& score : scores) drawings.push_back(ScoreToJson(score));
  return {{"unit", "% of the distance of the outer corners of the eyes"}, {"groups", groups}, {"drawings", drawings}};
}

}  // namespace daumier::eval
