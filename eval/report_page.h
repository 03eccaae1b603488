#pragma once
#include "eval/report.h"

#include <string>
#include <string_view>

namespace daumier::eval {

/// The text with &, <, >, " and ' replaced by entities, so that it can stand in HTML between tags and in quotes.
std::string EscapeHtml(std::string_view text);

/// index.html of a report: title and summary, tables, the pictures that lie beside it, and the facts. It has a light
/// and a dark look and fits a telephone's width.
std::string ReportPage(const ReportData& data);

}  // namespace daumier::eval
