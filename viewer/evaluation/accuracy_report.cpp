#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "viewer/evaluation/accuracy_study.h"
#include "viewer/volume/parallel.h"

namespace volumen {

namespace {

using Json = nlohmann::ordered_json;

// Returns a row as named values. CSV and JSON are both written from these, so they never differ. Infinity
// (the PSNR of an exact picture) becomes null.
Json fieldsOf(const StudyRow& row) {
  const auto finite = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
  return {{"knob", row.setting.knob},
          {"value", row.setting.value},
          {"method", row.method},
          {"stepVoxels", row.stepVoxels},
          {"bits", row.bits},
          {"width", row.size.x},
          {"height", row.size.y},
          {"medianMs", row.medianMs},
          {"minimumMs", row.minimumMs},
          {"frames", row.frames},
          {"bytes", row.bytes},
          {"resampled", row.resampled},
          {"shaded", row.shaded},
          {"composited", row.composited},
          {"max", finite(row.error.maximum)},
          {"p99", finite(row.error.percentile99)},
          {"rmse", finite(row.error.rmse)},
          {"psnrDb", finite(row.error.psnrDb)},
          {"shareAbove2", row.error.shareAbove2},
          {"front", row.front}};
}

std::string csvCell(const Json& value) {
  if (value.is_null()) return "inf";
  if (!value.is_string()) return value.dump();
  std::string quoted;
  for (const char c : value.get<std::string>()) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted.find_first_of(",\"\n") == std::string::npos ? quoted : "\"" + quoted + "\"";
}

}  // namespace

std::string machineName() {
  std::ifstream info("/proc/cpuinfo");
  std::string name = "unknown processor";
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) {
      name = line.substr(line.find(':') + 2);
      break;
    }
  const int threads = allowedThreads();
  return name + ", " + std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

std::string studyCsv(const AccuracyStudy& study) {
  std::string out;
  for (const StudyRow& row : study.rows) {
    const Json fields = fieldsOf(row);
    std::string head, line;
    for (const auto& [key, value] : fields.items()) {
      head += (head.empty() ? "" : ",") + key;
      line += (line.empty() ? "" : ",") + csvCell(value);
    }
    if (out.empty()) out = head + "\n";
    out += line + "\n";
  }
  return out;
}

std::string studyJson(const AccuracyStudy& study, const StudyTitle& title) {
  Json rows = Json::array();
  for (const StudyRow& row : study.rows) rows.push_back(fieldsOf(row));
  const Json out{
      {"volume", title.volume},
      {"scene", title.scene},
      {"machine", title.machine},
      {"date", title.date},
      {"kernel", study.kernel},
      {"threads", study.threads},
      {"reference",
       {{"size", {study.truth.size.x, study.truth.size.y}},
        {"grid", {study.truth.grid.x, study.truth.grid.y}},
        {"pixels", study.truth.pixels.size()},
        {"illConditioned", study.truth.illConditioned()},
        {"ms", study.truth.ms},
        {"text", referenceText(study.truth)}}},
      {"errors", "in 1/255, over the reference's well-conditioned pixels; front: median ms and RMSE"},
      {"rows", rows},
      {"leftOut", study.leftOut}};
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string referenceText(const Truth& truth) {
  const long long all = static_cast<long long>(truth.size.x) * truth.size.y;
  char text[200];
  if (truth.grid == truth.size)
    std::snprintf(text, sizeof text, "all %lld pixels", all);
  else
    std::snprintf(text, sizeof text, "%zu of %lld pixels, one of each cell of a %d x %d grid",
                  truth.pixels.size(), all, truth.grid.x, truth.grid.y);
  const std::size_t ill = truth.illConditioned();
  return std::string(text) + "; " + std::to_string(ill) +
         (ill == 1 ? " ill-conditioned one left out" : " ill-conditioned ones left out");
}

}  // namespace volumen
