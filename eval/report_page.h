#pragma once
#include "eval/report.h"

#include <string>

namespace daumier::eval {

/// index.html of a report: title and summary, tables, the pictures that lie beside it, and the facts
/// (eval/html_page.h).
std::string ReportPage(const ReportData& data);

}  // namespace daumier::eval
