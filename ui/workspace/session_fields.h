#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/study/series_key.h"
#include "ui/workspace/shared_list.h"
#include "ui/workspace/shared_map.h"
#include "viewer/measure/shape.h"
#include "viewer/recipe/recipe.h"
#include "viewer/scene/json_fields.h"
#include "viewer/scene/scene.h"

namespace volumen {

struct Series;

/// The range of a number, ends included.
struct Limits {
  double low, high;
};
inline constexpr Limits mmLimits{-1e9, 1e9};
inline constexpr Limits valueLimits{-1e33, 1e33};  ///< volumes hold up to 1e30

/// The series of a session. Everything after their list refers to them by index in it, from 0.
struct NumberedSeries {
  std::vector<SeriesKey> keys;
  std::vector<std::string> frames;  ///< the frame of reference of a series without a UID for it; else empty

  void add(const Series& series);
};

// The archive of sessions and hanging protocols. FieldWriter and FieldReader have the same functions, so each
// struct has one list of its fields, which writes and reads it:
//   template <class Fields> void fields(Fields& f, FlatLook& look) { f("zoom", look.zoom, {0.001, 1000}); ...
//   }
// The writer refuses values that the reader would refuse. `problem` keeps the first error, as a sentence with
// the field's path.

/// Writes a struct as a JSON object.
class FieldWriter {
 public:
  using Json = nlohmann::ordered_json;
  FieldWriter(std::string path, NumberedSeries& series, std::string& problem)
      : path_(std::move(path)), series_(series), problem_(problem) {}

  void operator()(const char* name, bool& value) { json_[name] = value; }
  void operator()(const char* name, std::string& value) { json_[name] = value; }
  /// Writes a value unless it is the usual one. `how` holds its limits or words.
  template <class T, class... How>
  void unless(const T& usual, const char* name, T& value, const How&... how) {
    if (value != usual) (*this)(name, value, how...);
  }
  /// Writes a struct. Older sessions have a text instead, which is read into `text`, one of its members.
  template <class T>
  void onceText(const char* name, T& value, std::string&) {
    (*this)(name, value);
  }
  void operator()(const char* name, int& value, Limits limits);
  void operator()(const char* name, double& value, Limits limits);
  void operator()(const char* name, glm::dvec2& value, Limits limits);
  void operator()(const char* name, glm::dvec3& value, Limits limits);
  /// Writes x and y of each point in turn.
  void operator()(const char* name, std::vector<glm::dvec2>& points, Limits limits);
  void require(const char* name, bool kept, const std::string& sentence) {
    if (!kept && problem_.empty()) problem_ = pathOf(name) + " " + sentence + ".";
  }
  void operator()(const char* name, Scene& scene);
  void operator()(const char* name, Shape& shape);
  /// Writes how the segments of a map were made, as in a recipe. Left out if that is unknown.
  void stepsOf(const SeriesKey& series, int map, const char* name, std::vector<Step>& steps);
  /// Writes the index of a series in the list; null: no series.
  void operator()(const char* name, SeriesKey& series);
  /// Writes a frame of reference: its UID, or the index of the only series in it.
  void frame(const char* name, std::string& frame);

  template <class T>
  void operator()(const char* name, T& value, const Words<T>& words) {
    const auto word = std::ranges::find(words, value, &std::pair<const char*, T>::second);
    json_[name] = word->first;
  }
  template <class T>
  void operator()(const char* name, T& value) {
    json_[name] = objectOf(value, pathOf(name));
  }
  template <class T>
  void operator()(const char* name, std::optional<T>& value) {
    json_[name] = value ? objectOf(*value, pathOf(name)) : Json();
  }
  /// Leaves out an empty value.
  template <class T, class... How>
  void unlessNone(const char* name, std::optional<T>& value, const How&... how) {
    if (value) (*this)(name, *value, how...);
  }
  template <class T>
  void operator()(const char* name, std::shared_ptr<const T>& value) {
    std::optional<T> copy = value ? std::optional<T>(*value) : std::nullopt;
    (*this)(name, copy);
  }
  template <class T>
  void operator()(const char* name, std::vector<T>& items) {
    Json& list = json_[name] = Json::array();
    for (T& item : items) list.push_back(objectOf(item, pathOf(name, list.size())));
  }
  template <class T>
  void operator()(const char* name, SharedList<T>& items) {
    std::vector<T> copy(items.begin(), items.end());
    (*this)(name, copy);
  }
  /// Writes a map as a list of objects, each with the fields that `item(writer, key, value)` names.
  template <class Key, class T, class Item>
  void map(const char* name, SharedMap<Key, T>& items, Item item) {
    Json& list = json_[name] = Json::array();
    for (const auto& [key, value] : items) {
      FieldWriter writer(pathOf(name, list.size()), series_, problem_);
      Key keyCopy = key;
      T copy = value;
      item(writer, keyCopy, copy);
      list.push_back(std::move(writer.json_));
    }
  }

  const Json& json() const { return json_; }

 private:
  template <class T>
  Json objectOf(T& value, const std::string& path) {
    FieldWriter writer(path, series_, problem_);
    fields(writer, value);
    return std::move(writer.json_);
  }
  void check(const std::string& path, double value, Limits limits);
  Json listOf(const char* name, const double* numbers, int count, Limits limits);
  std::string pathOf(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }
  std::string pathOf(const std::string& name, std::size_t n) const {
    return pathOf(name) + "[" + std::to_string(n) + "]";
  }

  Json json_ = Json::object();
  std::string path_;
  NumberedSeries& series_;
  std::string& problem_;
};

/// The steps of a segment map that cannot be read, and why: a sentence about one step.
struct UnreadSteps {
  SeriesKey series;
  int map;  ///< number of the map
  std::string why;
};

/// Reads a JSON object into a struct. A missing field keeps the value that is there. Steps that cannot be
/// read are no error: they are left out and listed in `unread`.
class FieldReader {
 public:
  FieldReader(JsonFields& json, const NumberedSeries& series, std::vector<UnreadSteps>& unread)
      : json_(json), series_(series), unread_(unread) {}

  void operator()(const char* name, bool& value) { json_.read(name, value); }
  void operator()(const char* name, std::string& value) { json_.read(name, value); }
  template <class T, class... How>
  void unless(const T&, const char* name, T& value, const How&... how) {
    (*this)(name, value, how...);
  }
  template <class T>
  void onceText(const char* name, T& value, std::string& text) {
    const nlohmann::json* field = json_.raw(name);
    if (field && field->is_string()) return json_.read(name, text);
    (*this)(name, value);
  }
  void operator()(const char* name, int& value, Limits limits);
  void operator()(const char* name, double& value, Limits limits);
  void operator()(const char* name, glm::dvec2& value, Limits limits);
  void operator()(const char* name, glm::dvec3& value, Limits limits);
  void operator()(const char* name, std::vector<glm::dvec2>& points, Limits limits);
  void require(const char* name, bool kept, const std::string& sentence) {
    if (!kept) json_.refuse(json_.pathOf(name), sentence);
  }
  void operator()(const char* name, Scene& scene);
  void operator()(const char* name, Shape& shape);
  void stepsOf(const SeriesKey& series, int map, const char* name, std::vector<Step>& steps);
  void operator()(const char* name, SeriesKey& series);
  void frame(const char* name, std::string& frame);

  template <class T>
  void operator()(const char* name, T& value, const Words<T>& words) {
    json_.read(name, value, words);
  }
  template <class T>
  void operator()(const char* name, T& value) {
    if (auto object = json_.object(name)) read(*object, value);
  }
  template <class T>
  void operator()(const char* name, std::optional<T>& value) {
    if (auto object = json_.objectOrNull(name)) {
      T item;
      read(*object, item);
      value = std::move(item);
    }
  }
  template <class T, class... How>
  void unlessNone(const char* name, std::optional<T>& value, const How&... how) {
    if (!json_.given(name)) return;
    T item{};
    (*this)(name, item, how...);
    value = std::move(item);
  }
  template <class T>
  void operator()(const char* name, std::shared_ptr<const T>& value) {
    std::optional<T> copy;
    (*this)(name, copy);
    if (copy) value = std::make_shared<const T>(std::move(*copy));
  }
  template <class T>
  void operator()(const char* name, std::vector<T>& items) {
    json_.readList(name, items, [&](JsonFields object) {
      T item;
      read(object, item);
      return item;
    });
  }
  template <class T>
  void operator()(const char* name, SharedList<T>& items) {
    std::vector<T> list(items.begin(), items.end());
    (*this)(name, list);
    items.assign(list);
  }
  template <class Key, class T, class Item>
  void map(const char* name, SharedMap<Key, T>& items, Item item) {
    std::vector<std::pair<Key, T>> list;
    json_.readList(name, list, [&](JsonFields object) {
      std::pair<Key, T> entry;
      FieldReader reader(object, series_, unread_);
      item(reader, entry.first, entry.second);
      object.refuseOthers();
      return entry;
    });
    for (std::size_t n = 0; n < list.size(); ++n)
      if (!items.add(list[n].first, list[n].second)) json_.refuse(json_.pathOf(name, n), "is there twice");
  }

 private:
  template <class T>
  void read(JsonFields& object, T& value) {
    FieldReader reader(object, series_, unread_);
    fields(reader, value);
    object.refuseOthers();
  }
  void check(const std::string& path, double value, Limits limits);
  void readNumbers(const char* name, double* numbers, int count, Limits limits);
  std::optional<std::size_t> readNumber(const char* name);

  JsonFields& json_;
  const NumberedSeries& series_;
  std::vector<UnreadSteps>& unread_;
};

}  // namespace volumen
