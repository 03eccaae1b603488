#pragma once
#include "reports/report.h"

#include <string>

namespace daumier::reports {

/// index.html of a report: title and summary, tables, the pictures in its folder, and the facts
/// (eval/html_page.h).
std::string ReportPage(const ReportData& data);

}  // namespace daumier::reports
