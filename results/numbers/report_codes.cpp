#include "results/numbers/report_codes.h"

#include <algorithm>

namespace volumen {

Code ucum(const char* value, const char* meaning) { return {value, "UCUM", meaning}; }

Code unitOfValues(const std::string& unit) {
  struct Row {
    const char* unit;
    Code code;
  };
  static const Row rows[] = {
      {"", ucum("1", "no units")},
      {"HU", ucum("[hnsf'U]", "Hounsfield Unit")},
      {"Bq/ml", ucum("Bq/ml", "Becquerels/milliliter")},
      {"SUVbw", ucum("g/ml{SUVbw}", "Standardized Uptake Value body weight")},
      {"SUVlbm", ucum("g/ml{SUVlbm}", "Standardized Uptake Value lean body mass (James)")},
      {"SUVbsa", ucum("cm2/ml{SUVbsa}", "Standardized Uptake Value body surface area")},
      {"%", ucum("%", "Percent")},
      {"Gy", ucum("Gy", "Gy")}};
  const auto* row = std::ranges::find(rows, unit, &Row::unit);
  if (row != std::end(rows)) return row->code;
  return {"{" + unit + "}", "UCUM", unit};  // UCUM's form for units of others
}

std::vector<ReportMeasurement> reportedValues(double mean, double sd, double min, double max,
                                              const Code& unit) {
  return {{meanCode, unit, mean, {}, {}},
          {deviationCode, unit, sd, {}, {}},
          {leastCode, unit, min, {}, {}},
          {mostCode, unit, max, {}, {}}};
}

}  // namespace volumen
