#include "rig/expression_map_file.h"

#include "core/error.h"
#include "rig/arkit_names.h"

#include <algorithm>
#include <cmath>

namespace daumier::rig {
namespace {

constexpr const char* kFormula =
    "weights = sum over expressions e of max(c_e, 0) positive_e + max(-c_e, 0) negative_e, then clamped to 0 .. 1; "
    "then "
    "eyeBlink <= 1 - 0.25 eyeSquint - 0.35 eyeLookDown of its side, jawOpen <= 1 - 0.3 tongueOut, mouthClose <= "
    "jawOpen";

/// To six decimals, so that files are short.
double Rounded(double value) {
  return std::round(1e6 * value) / 1e6;
}

Json Rows(const Eigen::MatrixXf& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(Rounded(matrix(r, c)));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json ErrorsJson(const ExpressionMap& map) {
  Json rows = Json::array();
  for (const MappedExpression& mapped : map.mapped) {
    Json row = {{"expression", mapped.name}, {"coefficient", mapped.is_negative ? -1 : 1}};
    const auto set = [&](const char* key, double cm) { row[key] = Rounded(map.mm_per_cm * cm); };
    set("rms_mm", mapped.error.rms_cm);
    set("max_mm", mapped.error.greatest_cm);
    set("no_motion_rms_mm", mapped.no_motion.rms_cm);
    set("no_motion_max_mm", mapped.no_motion.greatest_cm);
    const auto explained = mapped.explained();
    row["explained"] = explained ? Json(Rounded(*explained)) : Json();
    row["gain"] = Rounded(mapped.gain);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// The E x 52 numbers below a key.
Eigen::MatrixXf MatrixOf(const Json& json, const char* key, Eigen::Index num_rows, const std::string& name) {
  const Json& rows = json.at(key);
  DAUMIER_CHECK(rows.is_array() && std::ssize(rows) == num_rows, "{}: '{}' has {} rows, expected one an expression: {}",
                name, key, rows.size(), num_rows);
  Eigen::MatrixXf matrix(num_rows, kNumArkitNames);
  for (Eigen::Index r = 0; r < num_rows; ++r) {
    const auto row = rows[size_t(r)].get<std::vector<float>>();
    DAUMIER_CHECK(std::ssize(row) == kNumArkitNames, "{}: row {} of '{}' has {} numbers, expected {}", name, r, key,
                  row.size(), kNumArkitNames);
    matrix.row(r) = Eigen::Map<const Eigen::RowVectorXf>(row.data(), kNumArkitNames);
  }
  DAUMIER_CHECK(matrix.allFinite() && (matrix.array() >= 0).all(),
                "{}: '{}' has a number that is negative or not finite", name, key);
  return matrix;
}

std::vector<MappedExpression> MappedOf(const Json& rows, const ExpressionMap& map, const std::string& name) {
  const Eigen::Index expected = map.positive.rows() + map.negative.rows();
  DAUMIER_CHECK(rows.is_array() && std::ssize(rows) == expected, "{}: 'errors' has {} rows, expected {}", name,
                rows.size(), expected);
  std::vector<MappedExpression> mapped;
  for (size_t i = 0; i < rows.size(); ++i) {
    const auto cm = [&](const char* key) { return rows[i].at(key).get<double>() / map.mm_per_cm; };
    mapped.push_back({map.expressions[i % map.expressions.size()],
                      i >= map.expressions.size(),
                      {cm("rms_mm"), cm("max_mm")},
                      {cm("no_motion_rms_mm"), cm("no_motion_max_mm")},
                      rows[i].at("gain").get<double>()});
    const double gain = mapped.back().gain;
    DAUMIER_CHECK(gain >= 1 && gain <= kMostGain, "{}: 'errors' has a gain of {}, expected 1 to {}", name, gain,
                  kMostGain);
  }
  return mapped;
}

Json ProvenanceOf(const Json& json, const char* key, const std::string& name) {
  const Json& provenance = json.at(key);
  for (const char* text : {"name", "version", "licence"})
    DAUMIER_CHECK(provenance.is_object() && provenance.value(text, Json("")).is_string(),
                  "{}: '{}' is no origin (expected name, version and licence)", name, key);
  return provenance;
}

ExpressionMap Parsed(const Json& json, const std::string& name) {
  const auto targets = json.at("names").get<std::vector<std::string>>();
  DAUMIER_CHECK(std::ranges::equal(targets, ArkitNames()), "{}: 'names' are not the 52 of ARKit in their order", name);
  ExpressionMap map;
  map.expressions = json.at("expressions").get<std::vector<std::string>>();
  const auto num_expressions = Eigen::Index(map.expressions.size());
  DAUMIER_CHECK(num_expressions > 0, "{}: 'expressions' is empty", name);
  const std::string kind = json.at("coefficients").get<std::string>();
  DAUMIER_CHECK(kind == "signed" || kind == "blend", "{}: 'coefficients' is '{}', expected signed or blend", name,
                kind);
  map.kind = kind == "signed" ? CoefficientKind::kSigned : CoefficientKind::kBlend;
  map.positive = MatrixOf(json, "positive", num_expressions, name);
  map.negative = Eigen::MatrixXf(0, kNumArkitNames);
  if (map.kind == CoefficientKind::kSigned) map.negative = MatrixOf(json, "negative", num_expressions, name);
  if (json.contains("constant") && !json.at("constant").is_null()) {
    const auto found = std::ranges::find(map.expressions, json.at("constant").get<std::string>());
    DAUMIER_CHECK(found != map.expressions.end(), "{}: 'constant' is no expression of the map", name);
    map.constant = int(found - map.expressions.begin());
  }
  map.mapped = MappedOf(json.at("errors"), map, name);
  map.model = ProvenanceOf(json, "model", name);
  map.targets = ProvenanceOf(json, "targets", name);
  return map;
}

}  // namespace

Json ExpressionMapJson(const ExpressionMap& map) {
  const bool is_signed = map.kind == CoefficientKind::kSigned;
  Json json = {{"format_version", kExpressionMapVersion},
               {"kind", kExpressionMapKind},
               {"model", map.model},
               {"targets", map.targets},
               {"formula", kFormula},
               {"coefficients", is_signed ? "signed" : "blend"},
               {"expressions", map.expressions},
               {"constant", map.constant ? Json(map.expressions[size_t(*map.constant)]) : Json()},
               {"names", std::vector<std::string>(ArkitNames().begin(), ArkitNames().end())},
               {"positive", Rows(map.positive)}};
  if (is_signed) json["negative"] = Rows(map.negative);
  json["unit"] = "mm at 200 mm from chin to hairline; root mean square over the area of the face";
  json["errors"] = ErrorsJson(map);
  return json;
}

ExpressionMap ParseExpressionMap(const Json& json, const std::string& name) {
  DAUMIER_CHECK(json.is_object() && json.value("kind", Json()) == kExpressionMapKind,
                "{}: is no map of expressions (expected a file that `daumier rig --map MODEL` wrote)", name);
  DAUMIER_CHECK(json.value("format_version", Json()) == kExpressionMapVersion,
                "{}: is of format version {}, expected {}. Write it again with `daumier rig --map MODEL`", name,
                json.value("format_version", Json()).dump(), kExpressionMapVersion);
  try {
    return Parsed(json, name);
  } catch (const Json::exception& error) {
    throw Error(fmt::format("{}: {}. Write it again with `daumier rig --map MODEL`", name, TextOf(error)));
  }
}

}  // namespace daumier::rig
