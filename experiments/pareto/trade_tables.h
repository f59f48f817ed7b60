#pragma once

#include "experiments/pareto/pareto.h"
#include "verification/report/result_table.h"

namespace irradiff {

/// A row for each family and method: errors, times, whether it is on the front.
ResultTable tradeTable(const Pareto& pareto);
/// The errors alone, a row for each family, method and quantity.
ResultTable errorTable(const Pareto& pareto);
/// A row for each family and tolerance.
ResultTable regretTable(const Pareto& pareto);
/// A row for each estimator, quantity and number of rays.
ResultTable estimatorTable(const Pareto& pareto);

}  // namespace irradiff
