#include "ui/workspace/session_fields.h"

#include "ui/workspace/workspace.h"
#include "viewer/measure/shape_json.h"
#include "viewer/scene/number_text.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

namespace {

std::string outside(double value, Limits limits) {
  return "must be in " + numberText(limits.low) + " .. " + numberText(limits.high) + ", not " +
         numberText(value);
}

// NaN is within no limits.
bool within(double value, Limits limits) { return value >= limits.low && value <= limits.high; }

// Removes the full stop that refuse() adds.
std::string unended(std::string sentence) {
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

}  // namespace

void NumberedSeries::add(const Series& series) {
  keys.push_back(keyOf(series));
  frames.push_back(series.frameOfReferenceUid.empty() ? frameOfReference(series) : std::string());
}

void FieldWriter::check(const std::string& path, double value, Limits limits) {
  if (problem_.empty() && !within(value, limits)) problem_ = path + " " + outside(value, limits) + ".";
}

FieldWriter::Json FieldWriter::listOf(const char* name, const double* numbers, int count, Limits limits) {
  Json list = Json::array();
  for (int n = 0; n < count; ++n) {
    check(pathOf(name, std::size_t(n)), numbers[n], limits);
    list.push_back(numbers[n]);
  }
  return list;
}

void FieldWriter::operator()(const char* name, int& value, Limits limits) {
  check(pathOf(name), value, limits);
  json_[name] = value;
}

void FieldWriter::operator()(const char* name, double& value, Limits limits) {
  check(pathOf(name), value, limits);
  json_[name] = value;
}

void FieldWriter::operator()(const char* name, glm::dvec2& value, Limits limits) {
  json_[name] = listOf(name, &value[0], 2, limits);
}

void FieldWriter::operator()(const char* name, glm::dvec3& value, Limits limits) {
  json_[name] = listOf(name, &value[0], 3, limits);
}

void FieldWriter::operator()(const char* name, std::vector<glm::dvec2>& points, Limits limits) {
  std::vector<double> numbers;
  for (const glm::dvec2 p : points) numbers.insert(numbers.end(), {p.x, p.y});
  json_[name] = listOf(name, numbers.data(), int(numbers.size()), limits);
}

void FieldWriter::operator()(const char* name, Scene& scene) {
  const Status valid = validateScene(scene);
  if (valid)
    json_[name] = Json::parse(sceneToJson(scene));
  else if (problem_.empty())
    problem_ = pathOf(name) + ": " + valid.message();
}

void FieldWriter::operator()(const char* name, Shape& shape) {
  const Status valid = checkShape(shape);
  if (valid)
    json_[name] = shapeToJson(shape);
  else if (problem_.empty())
    problem_ = pathOf(name) + ": " + valid.message();
}

void FieldWriter::stepsOf(const SeriesKey&, int, const char* name, std::vector<Step>& steps) {
  if (!steps.empty()) json_[name] = Json::parse(stepsJson(steps));
}

void FieldWriter::operator()(const char* name, SeriesKey& series) {
  const auto found = std::ranges::find(series_.keys, series);
  json_[name] = found == series_.keys.end() ? Json() : Json(found - series_.keys.begin());
}

void FieldWriter::frame(const char* name, std::string& frame) {
  const auto own = std::ranges::find(series_.frames, frame);
  json_[name] =
      own == series_.frames.end() || frame.empty() ? Json(frame) : Json(own - series_.frames.begin());
}

void FieldReader::check(const std::string& path, double value, Limits limits) {
  if (!within(value, limits)) json_.refuse(path, outside(value, limits));
}

void FieldReader::readNumbers(const char* name, double* numbers, int count, Limits limits) {
  const nlohmann::json* list = json_.raw(name);
  if (!list) return;
  json_.readNumbers(*list, json_.pathOf(name), numbers, std::size_t(count));
  for (int n = 0; n < count; ++n) check(json_.pathOf(name, std::size_t(n)), numbers[n], limits);
}

void FieldReader::operator()(const char* name, int& value, Limits limits) {
  json_.read(name, value);
  check(json_.pathOf(name), value, limits);
}

void FieldReader::operator()(const char* name, double& value, Limits limits) {
  json_.read(name, value);
  check(json_.pathOf(name), value, limits);
}

void FieldReader::operator()(const char* name, glm::dvec2& value, Limits limits) {
  readNumbers(name, &value[0], 2, limits);
}

void FieldReader::operator()(const char* name, glm::dvec3& value, Limits limits) {
  readNumbers(name, &value[0], 3, limits);
}

void FieldReader::operator()(const char* name, std::vector<glm::dvec2>& points, Limits limits) {
  const nlohmann::json* list = json_.raw(name);
  if (!list) return;
  const std::size_t count = list->is_array() ? list->size() : 0;
  if (!list->is_array() || count % 2)
    return json_.refuse(json_.pathOf(name), "must be a list of x, y, x, y ...");
  std::vector<double> numbers(count);
  readNumbers(name, numbers.data(), int(count), limits);
  points.clear();
  for (std::size_t n = 0; n < count; n += 2) points.emplace_back(numbers[n], numbers[n + 1]);
}

void FieldReader::operator()(const char* name, Scene& scene) {
  const nlohmann::json* part = json_.raw(name);
  if (!part) return;
  Result<Scene> read = sceneFromJson(part->dump());
  if (read)
    scene = std::move(*read);
  else
    json_.refuse(json_.pathOf(name) + ":", unended(read.message()));
}

void FieldReader::operator()(const char* name, Shape& shape) {
  const auto object = json_.object(name);
  if (!object) return;
  shape = readShape(*object);
  if (const Status valid = checkShape(shape); !valid)
    json_.refuse(json_.pathOf(name) + ":", unended(valid.message()));
}

void FieldReader::stepsOf(const SeriesKey& series, int map, const char* name, std::vector<Step>& steps) {
  const nlohmann::json* list = json_.raw(name);
  if (!list) return;
  Result<std::vector<Step>> read = readSteps(list->dump());
  if (read)
    steps = std::move(*read);
  else
    unread_.push_back({series, map, read.message()});
}

// Reads the index of a series; empty if the field is missing, null or refused.
std::optional<std::size_t> FieldReader::readNumber(const char* name) {
  if (!json_.given(name)) return {};
  int number = -1;
  json_.read(name, number);
  if (number >= 0 && std::size_t(number) < series_.keys.size()) return std::size_t(number);
  json_.refuse(json_.pathOf(name), "must be the number of one of the " + std::to_string(series_.keys.size()) +
                                       " series, from 0, not " + std::to_string(number));
  return {};
}

void FieldReader::operator()(const char* name, SeriesKey& series) {
  if (const auto number = readNumber(name)) series = series_.keys[*number];
}

void FieldReader::frame(const char* name, std::string& frame) {
  const nlohmann::json* field = json_.raw(name);
  if (!field || !field->is_number()) return json_.read(name, frame);
  if (const auto number = readNumber(name)) frame = series_.frames[*number];
}

}  // namespace volumen
