#include "viewer/scene/json_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "viewer/scene/number_text.h"

namespace volumen {

using nlohmann::json;

namespace {

constexpr std::size_t deepestNesting = 32;

// Scans a text for properties that a parsed value no longer shows: its depth, duplicate fields, and numbers
// that overflow a double. A callback of json::parse would take quadratic time in the length of a list.
class Nesting : public nlohmann::json_sax<json> {
 public:
  std::string problem;
  std::optional<std::size_t> tooLargeAt;  // byte after the number; `problem` names it

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return start(false); }
  bool start_array(std::size_t) override { return start(true); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool key(string_t& name) override {
    Level& level = levels_.back();
    level.key = name;
    if (!level.keys.insert(name).second) problem = path() + " is given twice.";
    return problem.empty();
  }
  // json::parse reports all other errors.
  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& e) override {
    constexpr int numberOverflow = 406;
    if (e.id != numberOverflow) return false;
    tooLargeAt = byte;
    problem = (path().empty() ? "the number" : path()) + " is too large";
    return false;
  }

 private:
  struct Level {
    bool list;
    std::set<std::string> keys;
    std::string key;
    std::size_t index;
  };
  std::vector<Level> levels_;

  bool start(bool list) {
    if (levels_.size() == deepestNesting) problem = "The JSON is nested too deeply.";
    levels_.push_back({list, {}, {}, 0});
    return problem.empty();
  }
  bool end() {
    levels_.pop_back();
    return value();
  }
  bool value() {
    if (!levels_.empty()) ++levels_.back().index;
    return true;
  }

  std::string path() const {
    std::string text;
    for (const Level& level : levels_) {
      if (level.list)
        text.append("[").append(std::to_string(level.index)).append("]");
      else
        text.append(text.empty() ? "" : ".").append(level.key, 0, 60);
    }
    return text;
  }
};

std::string placeInText(const std::string& text, std::size_t byte) {
  byte = std::min(byte, text.size());
  const std::size_t lineStart = byte == 0 ? std::string::npos : text.rfind('\n', byte - 1);
  const auto line = 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(byte), '\n');
  const std::size_t column = lineStart == std::string::npos ? byte : byte - lineStart - 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(std::max<std::size_t>(column, 1));
}

// Returns the parser's reason without its number and without the quoted file text.
std::string reasonOf(const std::string& what) {
  const std::size_t from = what.rfind(": ", what.find(" - "));
  std::string reason = from == std::string::npos ? what : what.substr(from + 2);
  return reason.substr(0, reason.find("; last read"));
}

const char* kindName(const json& value) {
  switch (value.type()) {
    case json::value_t::null:
      return "null";
    case json::value_t::boolean:
      return "true or false";
    case json::value_t::string:
      return "a text";
    case json::value_t::array:
      return "a list";
    case json::value_t::object:
      return "an object";
    default:
      return "a number";
  }
}

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Result<json> parseJson(const std::string& text, std::size_t mostMiB) {
  if (text.size() > mostMiB << 20)
    return Error{"The JSON is larger than " + std::to_string(mostMiB) + " MiB."};
  Nesting nesting;
  json::sax_parse(text, &nesting);
  if (nesting.tooLargeAt)
    return Error{"Not JSON at " + placeInText(text, *nesting.tooLargeAt) + ": " + nesting.problem + "."};
  if (!nesting.problem.empty()) return Error{nesting.problem};
  try {
    return json::parse(text);
  } catch (const json::parse_error& e) {
    return Error{"Not JSON at " + placeInText(text, e.byte) + ": " + reasonOf(e.what()) + "."};
  }
}

JsonFields::JsonFields(const json& object, std::string path, std::string& problem)
    : object_(&object), path_(std::move(path)), problem_(problem) {
  static const json empty = json::object();
  if (!isKind(object, path_.empty() ? "The JSON" : path_, Kind::object)) object_ = &empty;
}

JsonFields::JsonFields(Json& object, std::string path, std::string& problem)
    : out_(&object), path_(std::move(path)), problem_(problem) {
  object = Json::object();
}

bool JsonFields::isKind(const json& value, const std::string& path, Kind kind) {
  switch (kind) {
    case Kind::boolean:
      if (value.is_boolean()) return true;
      break;
    case Kind::number:
      if (value.is_number()) return true;
      break;
    case Kind::text:
      if (value.is_string()) return true;
      break;
    case Kind::list:
      if (value.is_array()) return true;
      break;
    case Kind::object:
      if (value.is_object()) return true;
      break;
  }
  static constexpr const char* names[] = {"true or false", "a number", "a text", "a list", "an object"};
  refuse(path, std::string("must be ") + names[int(kind)] + ", not " + kindName(value));
  return false;
}

const json* JsonFields::raw(const char* name) {
  if (!reading()) return nullptr;
  if (std::find(known_.begin(), known_.end(), name) == known_.end()) known_.push_back(name);
  const auto found = object_->find(name);
  return found == object_->end() ? nullptr : &*found;
}

const json* JsonFields::find(const char* name, Kind kind) {
  const json* value = raw(name);
  return value && isKind(*value, pathOf(name), kind) ? value : nullptr;
}

bool JsonFields::given(const char* name) {
  const json* value = raw(name);
  return value && !value->is_null();
}

std::optional<JsonFields> JsonFields::object(const char* name) {
  if (!reading()) return JsonFields((*out_)[name], pathOf(name), problem_);
  const json* value = raw(name);
  if (!value) return {};
  return JsonFields(*value, pathOf(name), problem_);
}

JsonFields JsonFields::item(const char* name, std::size_t n, const json* list, Json& written) {
  if (list) return JsonFields((*list)[n], pathOf(name, n), problem_);
  return JsonFields(written.emplace_back(), pathOf(name, n), problem_);
}

template <class T>
void JsonFields::scalar(const char* name, Kind kind, T& value) {
  write(name, value);
  if (const json* field = find(name, kind)) value = field->get<T>();
}

void JsonFields::operator()(const char* name, bool& value) { scalar(name, Kind::boolean, value); }
void JsonFields::operator()(const char* name, double& value) { scalar(name, Kind::number, value); }
void JsonFields::operator()(const char* name, std::string& value) { scalar(name, Kind::text, value); }

void JsonFields::operator()(const char* name, int& value) {
  if (!reading()) return write(name, value);
  double number = value;
  (*this)(name, number);
  if (number != std::floor(number) || std::abs(number) > 1e9)
    return refuse(pathOf(name), "must be a small whole number, not " + numberText(number));
  value = int(number);
}

void JsonFields::operator()(const char* name, float& value) {
  double number = shortestDouble(value);
  (*this)(name, number);
  if (!reading()) return;
  if (std::abs(number) > double(std::numeric_limits<float>::max()))
    return refuse(pathOf(name), "must be within what float32 holds, not " + numberText(number));
  value = float(number);
}

void JsonFields::operator()(const char* name, glm::dvec3& value) {
  numberList(name, &value[0], 3, {-infinity, infinity});
}

void JsonFields::check(const std::string& path, double value, Limits limits) {
  // NaN is within no limits.
  if (!(value >= limits.low && value <= limits.high))
    refuse(path, "must be in " + numberText(limits.low) + " .. " + numberText(limits.high) + ", not " +
                     numberText(value));
}

void JsonFields::operator()(const char* name, int& value, Limits limits) {
  (*this)(name, value);
  check(pathOf(name), value, limits);
}

void JsonFields::operator()(const char* name, double& value, Limits limits) {
  (*this)(name, value);
  check(pathOf(name), value, limits);
}

void JsonFields::operator()(const char* name, glm::dvec2& value, Limits limits) {
  numberList(name, &value[0], 2, limits);
}

void JsonFields::operator()(const char* name, glm::dvec3& value, Limits limits) {
  numberList(name, &value[0], 3, limits);
}

void JsonFields::numberList(const char* name, double* numbers, std::size_t count, Limits limits) {
  const json* list = raw(name);
  if (reading() && !list) return;
  if (list) readNumbers(*list, pathOf(name), numbers, count);
  for (std::size_t n = 0; n < count; ++n) check(pathOf(name, n), numbers[n], limits);
  write(name, std::vector<double>(numbers, numbers + count));
}

void JsonFields::operator()(const char* name, std::vector<glm::dvec2>& points, Limits limits) {
  const json* list = raw(name);
  if (reading() && !list) return;
  if (list && (!list->is_array() || list->size() % 2))
    return refuse(pathOf(name), "must be a list of x, y, x, y ...");
  if (list) points.resize(list->size() / 2);
  std::vector<double> all(2 * points.size());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = points[n / 2][int(n % 2)];
  numberList(name, all.data(), all.size(), limits);
  for (std::size_t n = 0; n < all.size(); ++n) points[n / 2][int(n % 2)] = all[n];
}

void JsonFields::operator()(const char* name, std::vector<glm::dvec3>& points, const PointRule& rule) {
  const json* list = raw(name);
  if (reading() && !list) return;
  if (list && (!list->is_array() || list->size() > rule.most)) return refuse(pathOf(name), rule.sentence);
  if (list) points.assign(list->size(), glm::dvec3(0));
  Json written = Json::array();
  for (std::size_t n = 0; n < points.size(); ++n) {
    double* const numbers = &points[n][0];
    if (list) readNumbers((*list)[n], pathOf(name, n), numbers, rule.numbers);
    for (int axis = 0; list && axis < 3; ++axis)
      if (std::abs(numbers[axis]) > rule.withinMm)
        refuse(pathOf(name, n), "must be within " + numberText(rule.withinMm) + " mm");
    if (!list) written.push_back(std::vector<double>(numbers, numbers + rule.numbers));
  }
  write(name, std::move(written));
}

void JsonFields::texts(const char* name, std::vector<std::string>& texts, std::size_t most,
                       const std::string& sentence) {
  write(name, texts);
  const json* list = raw(name);
  if (!list) return;
  if (!list->is_array() || list->size() > most ||
      !std::all_of(list->begin(), list->end(), [](const json& one) { return one.is_string(); }))
    return refuse(pathOf(name), sentence);
  texts = list->get<std::vector<std::string>>();
}

void JsonFields::readNumbers(const json& list, const std::string& path, double* numbers, std::size_t count) {
  if (!isKind(list, path, Kind::list)) return;
  if (list.size() != count)
    return refuse(path, "must be a list of " + std::to_string(count) + " numbers, not of " +
                            std::to_string(list.size()));
  for (std::size_t n = 0; n < count; ++n)
    if (isKind(list[n], path + "[" + std::to_string(n) + "]", Kind::number))
      numbers[n] = list[n].get<double>();
}

void JsonFields::refuseOthers() {
  if (!reading()) return;
  for (const auto& [key, value] : object_->items()) {
    if (std::find(known_.begin(), known_.end(), key) != known_.end()) continue;
    std::string all;
    for (const std::string& name : known_) all += (all.empty() ? "" : ", ") + name;
    refuse(pathOf(key.substr(0, 60)), "is unknown; the fields here are " + all);
  }
}

void JsonFields::refuse(const std::string& path, const std::string& sentence) {
  if (problem_.empty()) problem_ = path + " " + sentence + ".";
}

std::string JsonFields::quoted(const std::string& text) { return "\"" + text.substr(0, 60) + "\""; }

}  // namespace volumen
