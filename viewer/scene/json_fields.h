#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/volume/result.h"

namespace volumen {

/// Parses untrusted JSON text. The Error, one sentence, means: text above `mostMiB`, nesting deeper than 32,
/// a field given twice in one object (with its path), or not JSON (with line and column).
Result<nlohmann::json> parseJson(const std::string& text, std::size_t mostMiB = 4);

/// The words of an enumeration in a file.
template <class T>
using Words = std::vector<std::pair<const char*, T>>;

/// Reads the fields of one JSON object by name; missing fields leave the value unchanged. The first problem
/// is kept in `problem`, shared by all objects of one text, as a sentence with the field's path
/// ("lights[2].intensity"). Values read after it are meaningless. `object` must outlive this.
class JsonFields {
 public:
  JsonFields(const nlohmann::json& object, std::string path, std::string& problem);

  void read(const char* name, bool& value);
  void read(const char* name, int& value);
  void read(const char* name, double& value);
  /// Rounds once; refuses values beyond float32.
  void read(const char* name, float& value);
  void read(const char* name, std::string& value);
  /// Reads three numbers.
  void read(const char* name, glm::dvec3& value);

  /// Reads one of several words.
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

  /// Returns the object in a field; empty if missing.
  std::optional<JsonFields> object(const char* name);
  /// Does the same for a field that may be null.
  std::optional<JsonFields> objectOrNull(const char* name);
  /// Returns whether a field that may be null has a value.
  bool given(const char* name);
  /// Returns the unchecked value of a field; null if missing.
  const nlohmann::json* raw(const char* name);

  /// Reads a list of objects with `readItem(JsonFields)`; replaces `items` if the field exists.
  template <class T, class Read>
  void readList(const char* name, std::vector<T>& items, Read readItem) {
    const nlohmann::json* list = find(name, Kind::list);
    if (!list) return;
    items.clear();
    for (const nlohmann::json& item : *list)
      items.push_back(readItem(JsonFields(item, pathOf(name, items.size()), problem_)));
  }
  /// Reads `count` numbers from a list at `path`.
  void readNumbers(const nlohmann::json& list, const std::string& path, double* numbers, std::size_t count);

  /// Refuses all fields that were not asked for. Call it last.
  void refuseOthers();
  /// Makes "PATH SENTENCE." the problem, unless there is one already.
  void refuse(const std::string& path, const std::string& sentence);

  std::string pathOf(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }
  std::string pathOf(const std::string& name, std::size_t n) const {
    return pathOf(name) + "[" + std::to_string(n) + "]";
  }
  /// Returns text from a file in quotes and shortened, for use in a sentence.
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
