#include "ui/workspace/session_fields.h"

#include <algorithm>

#include "ui/workspace/workspace.h"
#include "viewer/measure/shape_json.h"
#include "viewer/scene/scene_json.h"

namespace volumen {

namespace {

void refuse(SessionFields& f, const char* name, std::string sentence) {
  if (sentence.ends_with('.')) sentence.pop_back();  // JsonFields::refuse() adds one
  f.refuse(f.pathOf(name) + ":", sentence);
}

// Reads the index of a series; empty if the field is missing, null or refused.
std::optional<std::size_t> readIndex(SessionFields& f, const char* name) {
  if (!f.given(name)) return {};
  const std::size_t count = f.context().series->keys.size();
  int number = -1;
  f(name, number);
  if (number >= 0 && std::size_t(number) < count) return std::size_t(number);
  f.refuse(f.pathOf(name), "must be the number of one of the " + std::to_string(count) +
                               " series, from 0, not " + std::to_string(number));
  return {};
}

// Writes the index of an item in a list; if it is in none, `other`.
template <class T>
void writeIndex(SessionFields& f, const char* name, const std::vector<T>& list, const T& item,
                JsonFields::Json other) {
  const auto found = std::ranges::find(list, item);
  f.write(name, found == list.end() ? std::move(other) : JsonFields::Json(found - list.begin()));
}

}  // namespace

void NumberedSeries::add(const Series& series) {
  keys.push_back(keyOf(series));
  frames.push_back(series.frameOfReferenceUid.empty() ? frameOfReference(series) : std::string());
}

void field(SessionFields& f, const char* name, SeriesKey& series) {
  const std::vector<SeriesKey>& keys = f.context().series->keys;
  if (!f.reading()) return writeIndex(f, name, keys, series, nullptr);
  if (const auto index = readIndex(f, name)) series = keys[*index];
}

void frameField(SessionFields& f, const char* name, std::string& frame) {
  const std::vector<std::string>& frames = f.context().series->frames;
  if (!f.reading() && !frame.empty()) return writeIndex(f, name, frames, frame, frame);
  const nlohmann::json* const read = f.raw(name);
  if (!read || !read->is_number()) return f(name, frame);
  if (const auto index = readIndex(f, name)) frame = frames[*index];
}

void field(SessionFields& f, const char* name, Scene& scene) {
  if (!f.reading()) {
    const Status valid = validateScene(scene);
    if (!valid) return refuse(f, name, valid.message());
    return f.write(name, JsonFields::Json::parse(sceneToJson(scene)));
  }
  const nlohmann::json* const part = f.raw(name);
  if (!part) return;
  Result<Scene> read = sceneFromJson(part->dump());
  if (read)
    scene = std::move(*read);
  else
    refuse(f, name, read.message());
}

void field(SessionFields& f, const char* name, Shape& shape) {
  auto object = f.object(name);
  if (!object) return;
  shapeFields(std::move(*object), shape);
  if (const Status valid = checkShape(shape); !valid) refuse(f, name, valid.message());
}

void stepsField(SessionFields& f, const SeriesKey& series, int map, const char* name,
                std::vector<Step>& steps) {
  if (!f.reading() && !steps.empty()) return f.write(name, JsonFields::Json::parse(stepsJson(steps)));
  const nlohmann::json* const list = f.raw(name);
  if (!list) return;
  Result<std::vector<Step>> read = readSteps(list->dump());
  if (read)
    steps = std::move(*read);
  else
    f.context().unread->push_back({series, map, read.message()});
}

}  // namespace volumen
