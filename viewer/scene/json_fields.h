#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
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

/// The range of a number, ends included.
struct Limits {
  double low, high;
};

/// How a list of points stands in a file: each as a list of `numbers` numbers.
struct PointRule {
  std::string sentence;     ///< refuses other values and longer lists
  std::size_t numbers = 3;  ///< 2 or 3
  std::size_t most = std::numeric_limits<std::size_t>::max();
  double withinMm = std::numeric_limits<double>::infinity();  ///< largest coordinate that can be read
};

/// Reads or writes the fields of one JSON object by name. When reading, missing fields leave the value
/// unchanged. The first problem is kept in `problem`, shared by all objects of one text, as a sentence with
/// the field's path ("lights[2].intensity"). Values read after it are meaningless.
class JsonFields {
 public:
  using Json = nlohmann::ordered_json;

  /// Reads `object`, which must outlive this.
  JsonFields(const nlohmann::json& object, std::string path, std::string& problem);
  /// Writes an object to `object`, which must outlive this.
  JsonFields(Json& object, std::string path, std::string& problem);

  /// Returns false if the fields are written.
  bool reading() const { return !out_; }

  void operator()(const char* name, bool& value);
  void operator()(const char* name, int& value);
  void operator()(const char* name, double& value);
  /// Rounds once; refuses values beyond float32. Writes the fewest digits.
  void operator()(const char* name, float& value);
  void operator()(const char* name, std::string& value);
  void operator()(const char* name, glm::dvec3& value);
  void operator()(const char* name, int& value, Limits limits);
  void operator()(const char* name, double& value, Limits limits);
  void operator()(const char* name, glm::dvec2& value, Limits limits);
  void operator()(const char* name, glm::dvec3& value, Limits limits);
  /// The list holds x and y of each point in turn.
  void operator()(const char* name, std::vector<glm::dvec2>& points, Limits limits);
  void operator()(const char* name, std::vector<glm::dvec3>& points, const PointRule& rule);
  /// Reads or writes a list of at most `most` texts. `sentence` refuses everything else.
  void texts(const char* name, std::vector<std::string>& texts, std::size_t most,
             const std::string& sentence);

  /// Reads or writes one of several words.
  template <class T>
  void operator()(const char* name, T& value, const Words<T>& words) {
    std::string word, allowed;
    for (const auto& [text, meaning] : words) {
      allowed += (allowed.empty() ? "" : " or ") + quoted(text);
      if (word.empty() && value == meaning) word = text;
    }
    (*this)(name, word);
    for (const auto& [text, meaning] : words)
      if (word == text) return void(value = meaning);
    refuse(pathOf(name), "must be " + allowed + ", not " + quoted(word));
  }

  /// Writes a field as it stands. Does nothing when reading.
  void write(const char* name, Json value) {
    if (out_) (*out_)[name] = std::move(value);
  }
  /// Returns the unchecked value of a field; null if missing or when writing.
  const nlohmann::json* raw(const char* name);
  /// Returns whether a field to be read has a value other than null.
  bool given(const char* name);
  /// Returns the object in a field, to be read or written; empty if it is missing.
  std::optional<JsonFields> object(const char* name);

  /// Reads `count` numbers from a list at `path`.
  void readNumbers(const nlohmann::json& list, const std::string& path, double* numbers, std::size_t count);

  /// Refuses a value that breaks a rule.
  void require(const char* name, bool kept, const std::string& sentence) {
    if (!kept) refuse(pathOf(name), sentence);
  }
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

 protected:
  enum class Kind { boolean, number, text, list, object };
  const nlohmann::json* find(const char* name, Kind kind);
  /// Returns one object of a list, which is read from `list` or added to `written`.
  JsonFields item(const char* name, std::size_t n, const nlohmann::json* list, Json& written);

 private:
  bool isKind(const nlohmann::json& value, const std::string& path, Kind kind);
  template <class T>
  void scalar(const char* name, Kind kind, T& value);
  void check(const std::string& path, double value, Limits limits);
  void numberList(const char* name, double* numbers, std::size_t count, Limits limits);

  const nlohmann::json* object_ = nullptr;
  Json* out_ = nullptr;
  std::string path_;
  std::string& problem_;
  std::vector<std::string> known_;
};

}  // namespace volumen
