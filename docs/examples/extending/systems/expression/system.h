#pragma once
#include "reports/metric_table.h"
#include "systems/system.h"

#include <vector>

namespace daumier::expression {

/// The row of the table in cli/system_table.cpp.
systems::System ExpressionSystem();

/// Columns of the task's table of results: the share of faces whose expression is wrong.
std::vector<reports::Metric> ErrorColumns();

}  // namespace daumier::expression
