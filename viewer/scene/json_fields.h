#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Parses JSON text that nobody has checked. Refused in one sentence: texts above `mostMiB`, nesting deeper
/// than 32, a field given twice in one object (with its path), anything that is not JSON (with line and
/// column).
Result<nlohmann::json> parseJson(const std::string& text, std::size_t mostMiB = 4);

/// The words of an enumeration in a file.
template <class T>
using Words = std::vector<std::pair<const char*, T>>;

/// The fields of one JSON object, each asked for by name; a missing field leaves the value as it is. The
/// first thing that is wrong is kept in `problem`, shared by all objects of one text, as a sentence with the
/// field's path ("lights[2].intensity"); what is read after it has no meaning. `object` must outlive this.
class JsonFields {
 public:
  JsonFields(const nlohmann::json& object, std::string path, std::string& problem);

  void read(const char* name, bool& value);
  void read(const char* name, int& value);
  void read(const char* name, double& value);
  /// Rounded once; what float32 cannot hold is refused.
  void read(const char* name, float& value);
  void read(const char* name, std::string& value);
  /// Three numbers.
  void read(const char* name, glm::dvec3& value);

  /// One of some words.
  template <class T>
  void read(const char* name, T& value, const Words<T>& words) {
    std::string word, allowed;
    for (const auto& [text, meaning] : words) {
      allowed += (allowed.empty() ? "" : " or ") + quoted(text);
      if (value == meaning) word = text;
    }
    read(name, word);
    for (const auto& [text, meaning] : words)
      if (word == text) return void(value = meaning);
    refuse(pathOf(name), "must be " + allowed + ", not " + quoted(word));
  }

  /// The object in a field; none where it is missing.
  std::optional<JsonFields> object(const char* name);
  /// The same for a field that may also be null.
  std::optional<JsonFields> objectOrNull(const char* name);
  /// Whether a field that may be null has a value.
  bool given(const char* name);
  /// What is in a field, unchecked; nullptr where it is missing.
  const nlohmann::json* raw(const char* name);

  /// A list of objects, each read by `readItem(JsonFields)`; replaces `items` where the field is there.
  template <class T, class Read>
  void readList(const char* name, std::vector<T>& items, Read readItem) {
    const nlohmann::json* list = find(name, Kind::list);
    if (!list) return;
    items.clear();
    for (const nlohmann::json& item : *list)
      items.push_back(readItem(JsonFields(item, pathOf(name, items.size()), problem_)));
  }
  /// `count` numbers of a list at `path`.
  void readNumbers(const nlohmann::json& list, const std::string& path, double* numbers, std::size_t count);

  /// Refuses the fields that nobody has asked for. To be called last.
  void refuseOthers();
  /// "PATH SENTENCE." becomes the problem, unless something was wrong before.
  void refuse(const std::string& path, const std::string& sentence);

  std::string pathOf(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }
  std::string pathOf(const std::string& name, std::size_t n) const {
    return pathOf(name) + "[" + std::to_string(n) + "]";
  }
  /// Text of a file as it may stand in a sentence: in quotes, shortened.
  static std::string quoted(const std::string& text);

 private:
  enum class Kind { boolean, number, text, list, object };
  const nlohmann::json* find(const char* name, Kind kind);
  bool isKind(const nlohmann::json& value, const std::string& path, Kind kind);

  const nlohmann::json* object_;
  std::string path_;
  std::string& problem_;
  std::vector<std::string> known_;
};

}  // namespace volumen
