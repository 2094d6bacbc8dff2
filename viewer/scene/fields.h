#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/scene/json_fields.h"

namespace volumen {

/// The archive of all JSON. Each struct has one list of its fields, which reads and writes it:
///   static void fields(Fields& f, FlatLook& look) { f("zoom", look.zoom, {0.001, 1000}); ... }
/// A type that is no object in JSON has `void field(Fields& f, const char* name, T& value)` instead. Writing
/// refuses values that reading would refuse. `Context` is what such functions need to know beside the JSON;
/// all lists of the program for one context must be of different structs.
template <class Context>
class FieldsWith : public JsonFields {
 public:
  explicit FieldsWith(JsonFields of, Context context = {})
      : JsonFields(std::move(of)), context_(std::move(context)) {}

  using JsonFields::operator();
  const Context& context() const { return context_; }

  template <class T>
  void operator()(const char* name, T& value) {
    if constexpr (requires { field(*this, name, value); })
      field(*this, name, value);
    else if (auto inside = object(name))
      whole(std::move(*inside), [&](FieldsWith& f) { fields(f, value); });
  }
  /// Writes an empty value as null, and reads null as one.
  template <class T, class... How>
  void operator()(const char* name, std::optional<T>& value, const How&... how) {
    if (!value) write(name, nullptr);
    unlessNone(name, value, how...);
  }
  template <class T>
  void operator()(const char* name, std::shared_ptr<const T>& value) {
    std::optional<T> copy = value && !reading() ? std::optional<T>(*value) : std::nullopt;
    (*this)(name, copy);
    if (reading() && copy) value = std::make_shared<const T>(std::move(*copy));
  }
  /// Reads or writes a list of structs. Elements to be read start as `first`.
  template <class T>
  void operator()(const char* name, std::vector<T>& items, const T& first = T()) {
    list(name, items, first, [](FieldsWith& f, T& item) { fields(f, item); });
  }
  /// Reads or writes such a list. `fieldsOf(f, item)` reads or writes the fields of one element.
  template <class T, class FieldsOf>
  void list(const char* name, std::vector<T>& items, const T& first, FieldsOf fieldsOf) {
    const nlohmann::json* const read = find(name, Kind::list);
    if (reading() && !read) return;
    if (read) items.assign(read->size(), first);
    Json written = Json::array();
    for (std::size_t n = 0; n < items.size(); ++n)
      whole(item(name, n, read, written), [&](FieldsWith& f) { fieldsOf(f, items[n]); });
    write(name, std::move(written));
  }

  /// Writes a value unless it is the usual one. `how` holds its limits or words.
  template <class T, class... How>
  void unless(const T& usual, const char* name, T& value, const How&... how) {
    if (reading() || value != usual) (*this)(name, value, how...);
  }
  /// Leaves out an empty value. Null is read as one.
  template <class T, class... How>
  void unlessNone(const char* name, std::optional<T>& value, const How&... how) {
    if (!reading() || given(name)) held(name, value, how...);
  }
  /// Leaves out an empty value as unlessNone() does, but refuses a field that is null.
  template <class T, class... How>
  void unlessMissing(const char* name, std::optional<T>& value, const How&... how) {
    if (!reading() || raw(name)) held(name, value, how...);
  }
  /// Refuses a missing field.
  template <class T, class... How>
  void needed(const char* name, T& value, const How&... how) {
    require(name, !reading() || raw(name), "is missing");
    (*this)(name, value, how...);
  }
  /// Writes a struct. Older files have a text instead, which is read into `text`, one of its members.
  template <class T>
  void onceText(const char* name, T& value, std::string& text) {
    const nlohmann::json* const read = raw(name);
    if (read && read->is_string())
      (*this)(name, text);
    else
      (*this)(name, value);
  }

 private:
  template <class T, class... How>
  void held(const char* name, std::optional<T>& value, const How&... how) {
    if (reading()) value.emplace();
    if (value) (*this)(name, *value, how...);
  }
  template <class FieldsOf>
  void whole(JsonFields of, FieldsOf fieldsOf) {
    FieldsWith f(std::move(of), context_);
    fieldsOf(f);
    f.refuseOthers();
  }

  Context context_;
};

struct NoContext {};
using Fields = FieldsWith<NoContext>;

/// Returns a struct as JSON. Its function fields() says which fields are written.
template <class T>
JsonFields::Json jsonOf(T value) {
  JsonFields::Json out;
  std::string problem;
  Fields f(JsonFields(out, "", problem));
  fields(f, value);
  return out;
}

}  // namespace volumen
